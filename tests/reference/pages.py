#!/usr/bin/python3
"""The pages of doc/verification hold one table, one picture and a command each: pages.py SOURCE

The table has at most 15 rows, the page at most 150 lines. A picture that doc/verification/plots.py
drew is of the table as it stands. README.md, which leads to the pages, is left out. A page of doc/theory has
at most 150 lines, too.
"""
import hashlib
import os
import re
import sys

import prose

ROWS, LINES = 15, 150
TABLE = re.compile(r"^\|.*\n\|[-:| ]+\|\n(?:\|.*\n)*", re.M)
PICTURE = re.compile(r"!\[[^\]]*\]\(([^()\s]+)\)")
COMMAND = re.compile(r"^ *(?:ctest|gmsh|mpiexec|tests/run|fsi-\w+|(?:examples|build)/\S+)", re.M)


def tables(text):
    """The tables of a page, each with its head."""
    return [match.group(0) for match in TABLE.finditer(prose.without_code(text))]


def mark(table):
    """What plots.py writes into the picture that it draws from a table."""
    return "table " + hashlib.sha256(table.encode()).hexdigest()[:16]


def code(text):
    """The indented and fenced lines of a page."""
    lines = zip(text.split("\n"), prose.without_code(text).split("\n"))
    return "\n".join(line for line, left in lines if not left.strip())


def faults(text, drawn=lambda name: b""):
    """What a page holds too much or too little of; drawn(name) is the content of a picture."""
    found, pictures = tables(text), PICTURE.findall(prose.without_code(text))
    if len(found) != 1:
        yield f"{len(found)} tables in place of one"
    for count in (len(table.splitlines()) - 2 for table in found):
        if count > ROWS:
            yield f"a table of {count} rows, more than {ROWS}"
    if len(pictures) != 1:
        yield f"{len(pictures)} pictures in place of one"
    for name in pictures:
        content, marks = drawn(name), [mark(table).encode() for table in found]
        if b"table " in content and not any(known in content for known in marks):
            yield f"{name} is of another table: doc/verification/plots.py draws it anew"
    if not COMMAND.search(code(text)):
        yield "no command"
    if len(text.splitlines()) > LINES:
        yield f"{len(text.splitlines())} lines, more than {LINES}"


def main():
    folder, failures = os.path.join(sys.argv[1], "doc", "verification"), 0
    names = [name for name in sorted(os.listdir(folder))
             if name.endswith(".md") and name != "README.md"]

    def drawn(name):
        path = os.path.join(folder, name)
        if not os.path.exists(path):  # links.py tells
            return b""
        with open(path, "rb") as file:
            return file.read()

    for page in names:
        with open(os.path.join(folder, page), encoding="utf-8") as file:
            for fault in faults(file.read(), drawn):
                failures += 1
                print(f"FAIL doc/verification/{page}: {fault}")
    theory = os.path.join(sys.argv[1], "doc", "theory")
    for page in sorted(os.listdir(theory)):
        with open(os.path.join(theory, page), encoding="utf-8") as file:
            lines = len(file.readlines())
        if lines > LINES:
            failures += 1
            print(f"FAIL doc/theory/{page}: {lines} lines, more than {LINES}")
    print(f"{len(names)} pages, {failures} faults")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
