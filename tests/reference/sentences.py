#!/usr/bin/python3
"""Sentences of more than 35 words in the documents: sentences.py SOURCE.

None may stand in README.md and doc/, but for doc/notebook. LEFT names pages that still hold some, and
how many.
"""
import glob
import os
import sys

import prose

LONGEST = 35
LEFT_OUT = ("doc/notebook/",)
LEFT = {"doc/verification/shape.md": 1}


def long_sentences(path):
    with open(path, encoding="utf-8") as file:
        for line, sentence in prose.sentences(file.read()):
            count = len(prose.words(sentence))
            if count > LONGEST:
                yield line, count, sentence


def pages(source):
    found = glob.glob(os.path.join(source, "doc", "**", "*.md"), recursive=True)
    names = ["README.md"] + sorted(os.path.relpath(path, source) for path in found)
    return [name for name in names if not name.startswith(LEFT_OUT)]


def main():
    source = sys.argv[1]
    failures = 0
    for name in pages(source):
        found = list(long_sentences(os.path.join(source, name)))
        if len(found) <= LEFT.get(name, 0):
            continue
        failures += 1
        for line, count, sentence in found:
            print(f"FAIL {name}:{line}: {count} words: {sentence}")
    print(f"{failures} pages with sentences of more than {LONGEST} words")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
