#!/usr/bin/python3
"""Every relative link of README.md and doc/ leads to a file, and to a heading where it names one. No
page holds the marks of a merge that was not finished.

    links.py SOURCE
"""
import glob
import os
import re
import sys

import prose

LINK = re.compile(r"\[[^\]]*\]\(([^()\s]+)\)")
MERGE = re.compile(r"^(<<<<<<< |>>>>>>> )", re.M)
ELSEWHERE = re.compile(r"[a-z][a-z0-9+.-]*:")


def anchors(path):
    """The names that the headings of a page have in links."""
    with open(path, encoding="utf-8") as file:
        heads = re.findall(r"^#+ +(.*?) *$", prose.without_code(file.read()), re.M)
    return {re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^()]*\)", r"\1", head).lower())
            .replace(" ", "-") for head in heads}


def faults(page, text):
    """(line, link) of the links that lead nowhere."""
    text = prose.CODE.sub(prose.blank, prose.without_code(text))
    for match in LINK.finditer(text):
        link = match.group(1)
        if ELSEWHERE.match(link):
            continue
        name, _, anchor = link.partition("#")
        target = os.path.normpath(os.path.join(os.path.dirname(page), name)) if name else page
        good = os.path.exists(target)
        if good and anchor and target.endswith(".md"):
            good = anchor in anchors(target)
        if not good:
            yield text.count("\n", 0, match.start()) + 1, link


def main():
    source = sys.argv[1]
    pages = [os.path.join(source, "README.md")]
    pages += sorted(glob.glob(os.path.join(source, "doc", "**", "*.md"), recursive=True))
    failures = 0
    for page in pages:
        with open(page, encoding="utf-8") as file:
            text = file.read()
        for line, link in faults(page, text):
            failures += 1
            print(f"FAIL {os.path.relpath(page, source)}:{line}: {link} leads nowhere")
        for mark in MERGE.finditer(text):
            failures += 1
            print(f"FAIL {os.path.relpath(page, source)}:{text.count(chr(10), 0, mark.start()) + 1}: mark of a merge")
    print(f"{len(pages)} pages, {failures} links that lead nowhere or marks of a merge")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
