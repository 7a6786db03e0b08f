#!/usr/bin/python3
"""The site as doc/site/build makes it: run.py SOURCE FOLDER

It builds without a warning of mkdocs or Doxygen, shows every case and every header, finds words, and loads
nothing from elsewhere.
"""
import glob
import json
import os
import re
import subprocess
import sys

failures = []
# What a browser fetches by itself, and what it does so from another host.
LOADED = re.compile(r"<(?:script|img|link|iframe)\b[^>]*\b(?:src|href)=\"(?:https?:)?//[^\"]*\"[^>]*>")


def check(holds, sentence):
    print("ok  " if holds else "FAIL", sentence)
    if not holds:
        failures.append(sentence)


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def main():
    source, site = (os.path.abspath(word) for word in sys.argv[1:3])
    said = subprocess.run([os.path.join(source, "doc", "site", "build"), site], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True)
    print(said.stdout, said.stderr)
    check(said.returncode == 0, "doc/site/build makes it without a warning")
    if said.returncode:
        return 1
    gallery = read(site, "gallery.html")
    for case in glob.glob(os.path.join(source, "examples", "*.yaml")):
        name = os.path.splitext(os.path.basename(case))[0]
        check(f"examples/run {name}\n" in gallery, f"the gallery shows {name}")
    for header in re.findall(r'#include "(\S+)"', read(source, "libfsi", "fsi.hpp")):
        check(f">{header}<" in read(site, "api.html"), f"the API lists {header}")
    texts = " ".join(entry["text"] for entry in json.loads(read(site, "search", "search_index.json"))["docs"])
    check("windkessel" in texts and "log_conformation" in texts, "the search knows the words of the pages")
    pages = [page for page in glob.glob(os.path.join(site, "**", "*.html"), recursive=True)
             if not page.startswith(os.path.join(site, "api") + os.sep)]
    outside = {match for page in pages for match in LOADED.findall(read(page)) if 'rel="canonical"' not in match}
    check(not outside, f"{len(pages)} pages load nothing from elsewhere {sorted(outside)}")
    wrong = [os.path.basename(page) for page in pages if "<em> " in read(page)]
    check(not wrong, f"a star with a blank beside it is a star {wrong}")
    check('class="arithmatex"' in read(site, "theory", "flow.html"), "formulas are set")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
