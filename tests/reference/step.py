#!/usr/bin/python3
"""The calls of a step, their numbers and their order: step.py SOURCE.

Solver::step, its description (-describe_step) and the table of doc/theory/step.md name the same.
"""
import os
import re
import sys


def calls(source, name, pattern):
    with open(os.path.join(source, name), encoding="utf-8") as file:
        return re.findall(pattern, file.read(), re.MULTILINE)


def main():
    source = sys.argv[1]
    code = calls(source, "libfsi/solver/solver.cpp", r"^  (?:for \(.*?\) )?(\w+)\(.*\);\s*// \((\d+)\)$")
    page = calls(source, "doc/theory/step.md", r"^\| (\d+) \| `(\w+)` \|")
    told = calls(source, "libfsi/solver/description.cpp", r'^ {6}\{"(\w+)",')
    expected = [name for name, number in code]
    failures = 0
    for name, found in (
        ("the numbers in solver.cpp", [int(number) for _, number in code] == list(range(1, len(code) + 1))),
        ("the table of step.md", [(int(n), c) for n, c in page] == list(enumerate(expected, 1))),
        ("description.cpp", told == expected),
    ):
        if not found:
            failures += 1
            print(f"FAIL {name}: other calls or another order than Solver::step {expected}")
    print(f"{len(expected)} calls of a step, {failures} of 3 lists differ")
    return 1 if failures or not expected else 0


if __name__ == "__main__":
    sys.exit(main())
