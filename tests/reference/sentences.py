#!/usr/bin/python3
"""Sentences of more than 35 words in the documents and in comments: sentences.py SOURCE.

None may stand in README.md and doc/, but for doc/notebook, and none in the comments of the library, the
drivers, the meshes, the examples and the Python package.
"""
import glob
import os
import sys

import comments
import prose

LONGEST = 35
LEFT_OUT = ("doc/notebook/",)
CODE = ("libfsi", "drivers", "meshes", "examples", "python")


def sentences(name, text):
    """(line, sentence) of a page, or of the comments of a file of code."""
    written_in = comments.language(name, text)
    if name.endswith(".md"):
        return prose.sentences(text)
    return comments.sentences(text, written_in) if written_in else ()


def long_sentences(name, text):
    """(line, number of words, sentence) of those of a file that are too long."""
    for line, sentence in sentences(name, text):
        count = len(prose.words(sentence))
        if count > LONGEST:
            yield line, count, sentence


def files(source):
    """The names of the pages and of the files of code."""
    pages = glob.glob(os.path.join(source, "doc", "**", "*.md"), recursive=True)
    code = [path for folder in CODE for path in glob.glob(os.path.join(source, folder, "**", "*"), recursive=True)
            if path.endswith((".hpp", ".cpp", ".geo", ".py")) or "." not in os.path.basename(path)]
    names = ["README.md"] + sorted(os.path.relpath(path, source) for path in pages + code if os.path.isfile(path))
    return [name for name in names if not name.startswith(LEFT_OUT)]


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def main():
    failures = 0
    source = sys.argv[1]
    for name in files(source):
        found = list(long_sentences(name, read(os.path.join(source, name))))
        failures += len(found) > 0
        for line, count, sentence in found:
            print(f"FAIL {name}:{line}: {count} words: {sentence}")
    print(f"{failures} files with sentences of more than {LONGEST} words")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
