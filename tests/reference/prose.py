"""The prose of a page of Markdown, without code, formulas and pictures."""
import re

FENCE = re.compile(r"^( *)(```|~~~).*?^ *\2[^\n]*$", re.M | re.S)
INDENTED = re.compile(r"(?:(?<=\n\n)|\A)(?:(?: {4}|\t)[^\n]*(?:\n|\Z)|[ \t]*\n(?= {4}|\t))+")
LINK = re.compile(r"!?\[([^\]]*)\]\([^()\s]*\)")
CODE = re.compile(r"``.*?``|`[^`\n]*(?:\n[^`\n]*)?`")
ITEM = re.compile(r"^ *(?:[-*+]|\d+[.)]) +")
END = re.compile(r"(?<=[.!?])[)\"*_]*\s+(?=[\"(*_`\[]*[A-Z0-9`])")
SHORT = re.compile(r"\b(?:e\.g|i\.e|cf|Fig|Eqs?|Sec|No|vs)\.$")


def blank(match):
    return re.sub(r"[^\n]", " ", match.group(0))


def without_code(text):
    """The text with blocks of code blanked; line numbers are kept."""
    return INDENTED.sub(blank, FENCE.sub(blank, text))


def blocks(text):
    """(line, text) of each paragraph, item of a list, heading and cell of a table."""
    start, lines = 0, []
    for number, line in enumerate(without_code(text).split("\n") + [""], 1):
        row = line.lstrip().startswith("|")
        alone = row or line.startswith("#") or not line.strip()
        if lines and (alone or ITEM.match(line)):
            yield start, " ".join(lines)
            lines = []
        if row:
            for cell in re.split(r"(?<!\\)\|", line.strip().strip("|")):
                yield number, cell
        elif line.startswith("#"):
            yield number, line.strip("# ")
        elif line.strip():
            start = start if lines else number
            lines.append(ITEM.sub("", line).strip())


def sentences(text, end=END):
    """(line where its block begins, sentence)."""
    for line, block in blocks(text):
        block = CODE.sub("Code", LINK.sub(r"\1", block))
        held = ""
        for part in end.split(block):
            held = (held + " " + part).strip()
            if SHORT.search(held):
                continue
            yield line, held
            held = ""
        if held:
            yield line, held


def words(sentence):
    """Its words: what stands between blanks and holds a letter or a digit."""
    return [word for word in sentence.split() if re.search(r"\w", word)]
