"""The comments of a source file of C++ or Python as prose: paragraphs, without formulas.

A line indented by three blanks or more after // or # is a formula, or code, and counts as one word. The sentence
around it goes on if the line does not end with a stop.
"""
import ast
import io
import re
import tokenize

import prose

STRING = re.compile(r"""R"\(.*?\)"|"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*'""")
FORMULA = re.compile(r"^ {2,}\S.*?(?=\.?$)")
ABSOLUTE = re.compile(r"^(?=[|#])")  # |u| at the head of a line begins no table, and #include no heading
# A symbol may begin a sentence, in lower case; the blank before the dot of a . b tells it from a stop.
END = re.compile(r"(?<=[^\s.][.!?])[)\"*_`]*\s+(?=\S)")


def language(name, text):
    """That of a file whose comments are read here, else None."""
    if name.endswith((".hpp", ".cpp", ".geo")):
        return "c++"
    return "python" if name.endswith(".py") or re.match(r"#!\S*(/| )python3?\n", text) else None


def of_cpp(text):
    """(line, column, whether code stands before it, comment) of each line that has one."""
    for number, line in enumerate(text.split("\n"), 1):
        at = STRING.sub(lambda match: "x" * len(match.group(0)), line).find("//")
        if at >= 0:
            yield number, at, line[:at].strip() != "", re.sub(r"^//+<? ?", "", line[at:])


def of_python(text):
    """The same of # comments."""
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT and not token.string.startswith("#!"):
            (number, at), line = token.start, token.line
            yield number, at, line[:at].strip() != "", re.sub(r"^#+ ?", "", token.string)


def docstrings(text):
    """(line, docstring) of a module of Python, its classes and functions."""
    places = [node for node in ast.walk(ast.parse(text)) if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef))]
    return [(node.body[0].lineno, ast.get_docstring(node)) for node in places if ast.get_docstring(node)]


def paragraphs(lines):
    """(line, text) of the comments that go on below each other."""
    start = last = column = None
    held = []
    for number, at, behind_code, comment in lines:
        goes_on = number == (last or 0) + 1 and at == column and not behind_code
        if held and not (goes_on and comment.strip()):
            yield start, "\n".join(held)
            held = []
        if not held:
            start, column = number, at
        last = number
        if comment.strip():
            held.append(ABSOLUTE.sub("'", FORMULA.sub("Formula", comment)))
    if held:
        yield start, "\n".join(held)


def sentences(text, written_in):
    """(line where its paragraph begins, sentence) of all comments of a text in one of the languages."""
    if written_in == "python":
        found = docstrings(text) + list(paragraphs(of_python(text)))
    else:
        found = paragraphs(of_cpp(text))
    for start, comment in sorted(found):
        for line, sentence in prose.sentences(comment, END):
            yield start + line - 1, sentence
