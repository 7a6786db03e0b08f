#!/usr/bin/python3
"""A header as Doxygen reads it, line by line in the place it has: doxygen_filter.py HEADER

The first comment, beside `#pragma once`, is the file's. What is said of several variables that one line
declares is said of each of them.
"""
import re
import sys

SEVERAL = re.compile(r"^( *)((?:static |inline |constexpr |const |mutable )*[A-Za-z_][\w:]*(?:<[^;=]*>)?[&*]?) "
                     r"([a-z_A-Z]\w*(?:\s*=[^;,]*|\{[^;]*?\})?(?:, \w+(?: *=[^;,]*|\{[^;]*?\})?)+);(.*)$")
AFTER = re.compile(r"\s*///< ?(.*)$")
BEFORE = re.compile(r"^\s*/// ?(.*)$")


def split(text):
    """The parts between commas that stand in no bracket."""
    parts, depth = [""], 0
    for char in text:
        depth += (char in "({[<") - (char in ")}]>")
        if char == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += char
    return [part.strip() for part in parts]


def several(lines, n):
    """Line n with one declaration a variable, where it declares several and something is said of them."""
    match = SEVERAL.match(lines[n])
    if not match:
        return lines[n]
    indent, kind, names, rest = match.groups()
    said, after = [], AFTER.match(rest)
    if after:
        said = [after.group(1)]
    elif not rest.strip():
        k = n - 1
        while k >= 0 and BEFORE.match(lines[k]) and not AFTER.match(lines[k]):
            said.insert(0, BEFORE.match(lines[k]).group(1))
            k -= 1
    if not said:
        return lines[n]
    note = " /**< " + " ".join(said) + " */"
    parts = [f"{kind} {name};" for name in split(names)]
    return indent + (note + " ").join(parts) + note


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        lines = file.read().split("\n")
    out = [several(lines, n) for n in range(len(lines))]
    out[0] = "/// \\file"
    for n in range(1, len(lines)):
        if not lines[n].startswith("//"):
            break
        out[n] = "/" + lines[n]
    print("\n".join(out))


if __name__ == "__main__":
    main()
