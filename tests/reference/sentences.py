#!/usr/bin/python3
"""Sentences of more than 35 words in the documents: sentences.py SOURCE [--list].

None may stand in README.md, doc/README.md, doc/tutorial, doc/howto and doc/reference. Elsewhere in
doc/ (but for doc/notebook and doc/adr) they are counted, and there may not be more than COUNTED, a
number that may only fall. --list prints these too.
"""
import glob
import os
import sys

import prose

LONGEST = 35
NONE_IN = ("README.md", "doc/README.md", "doc/tutorial/", "doc/howto/", "doc/reference/")
LEFT_OUT = ("doc/notebook/", "doc/adr/")
COUNTED = 106


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
    failures = counted = 0
    for name in pages(source):
        strict = name.startswith(NONE_IN)
        for line, count, sentence in long_sentences(os.path.join(source, name)):
            failures, counted = failures + strict, counted + (not strict)
            if strict or "--list" in sys.argv[2:]:
                print(f"{'FAIL' if strict else 'long'} {name}:{line}: {count} words: {sentence}")
    print(f"{failures} sentences of more than {LONGEST} words where none may be, {counted} elsewhere")
    if counted > COUNTED:
        print(f"FAIL elsewhere there were {COUNTED}: their number may only fall; --list prints them")
    if counted < COUNTED:
        print(f"elsewhere there were {COUNTED}: COUNTED may now be {counted}")
    return 1 if failures or counted > COUNTED else 0


if __name__ == "__main__":
    sys.exit(main())
