#!/usr/bin/python3
"""Lays out what mkdocs builds the site from: stage.py SOURCE STAGE SITE

The pages are doc/ and README.md; doc/README.md gives their order. A link to a file elsewhere in the tree
leads to a copy of that file as text. The gallery is made from the heads of examples/*.yaml.
"""
import json
import os
import re
import shutil
import sys

import gallery

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tests", "reference"))
import prose  # noqa: E402

LINK = re.compile(r"(?<=\]\()([^()\s]+)(?=\))")
ELSEWHERE = re.compile(r"[a-z][a-z0-9+.-]*:")
MATHJAX = "/usr/share/javascript/mathjax"
MATHJAX_PARTS = ("MathJax.js", "config/TeX-AMS_SVG.js", "extensions", "jax/element", "jax/input/TeX",
                 "jax/output/SVG/autoload", "jax/output/SVG/fonts/TeX", "jax/output/SVG/config.js",
                 "jax/output/SVG/jax.js")


class Stage:
    """The pages of the site, and where a path of the repository is found among them."""

    def __init__(self, source, folder):
        self.source, self.folder = source, os.path.join(folder, "pages")
        self.wanted = set()  # paths of the tree that links lead to and that doc/ does not hold
        self.written = set()

    def place(self, path):
        """The page of a path of the repository, by its name within the site."""
        if path == "README.md":
            return "index.md"
        if path == "doc/README.md":
            return "contents.md"
        if path == "doc/verification":
            return "verification/README.md"
        if path.startswith("doc/"):
            inner = path[len("doc/"):]
            return inner if "." in os.path.basename(inner) else self.show(path)
        return self.show(path)

    def show(self, path):
        """The name of a page of its own for a file or folder outside doc/; it is made in show_wanted."""
        self.wanted.add(path)
        name = "source/" + (path.lstrip(".") or "tree")  # mkdocs leaves dot-files out
        return name + ("/index.md" if os.path.isdir(os.path.join(self.source, path)) else ".txt")

    def relinked(self, page, text, here):
        """The text with its links as they are within the site."""
        code = prose.CODE.sub(prose.blank, prose.without_code(text))

        def replace(match):
            link = match.group(1)
            if ELSEWHERE.match(link) or link.startswith("#") or code[match.start()] == " ":
                return link
            name, _, anchor = link.partition("#")
            path = os.path.normpath(os.path.join(os.path.dirname(page), name))
            target = self.place("" if path == "." else path)
            return os.path.relpath(target, os.path.dirname(here) or ".") + ("#" + anchor if anchor else "")

        return LINK.sub(replace, text)

    def write(self, name, text):
        target = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        with open(target, "w", encoding="utf-8") as file:
            file.write(text)
        self.written.add(name)

    def page(self, path):
        """A page of doc/ or the front page."""
        here = self.place(path)
        with open(os.path.join(self.source, path), encoding="utf-8") as file:
            self.write(here, self.relinked(path, file.read(), here))
        return here

    def copy(self, path, name):
        target = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        shutil.copyfile(os.path.join(self.source, path), target)

    def show_wanted(self):
        """What the pages lead to outside doc/: a folder as a page, a file as text."""
        made = set()
        while self.wanted - made:
            path = (self.wanted - made).pop()
            made.add(path)
            full, name = os.path.join(self.source, path), self.show(path)
            if os.path.isdir(full):
                entries = [(entry, os.path.relpath(self.place(os.path.join(path, entry)), os.path.dirname(name)))
                           for entry in entries_of(self.source, path)]
                text = "\n".join(f"- [{entry}]({link})" for entry, link in entries)
                self.write(name, f"# {path or 'The tree'}\n\n{text}\n")
            else:
                self.copy(path, name)


def entries_of(source, folder):
    """The entries of a folder, without what git does not keep."""
    return sorted(name for name in os.listdir(os.path.join(source, folder))
                  if not re.match(r"\.|build[^.]*$|out$|__pycache__$|.*\.(?:log|msh|h5)$", name))


def navigation(stage, contents):
    """Sections and pages in the order of doc/README.md; a folder's own pages below its first."""
    nav, named = [{"libfsi": "index.md"}, {"Gallery": "gallery.md"}], set()
    for part in re.split(r"^## +", contents, flags=re.M)[1:]:
        title = part.split("\n")[0].split(":")[0].strip()
        items = re.findall(r"^- \[.*(?:\n {2}.*)*", part, re.M)  # an entry and its further lines
        pages = [stage.place(os.path.normpath(os.path.join("doc", link)))
                 for item in items for link in re.findall(r"\]\(([^()\s#:]+)\)", item)]
        for page in list(pages):
            if os.path.basename(page) == "README.md":
                folder = os.path.dirname(page)
                more = sorted(name for name in stage.written
                              if os.path.dirname(name) == folder and name not in pages)
                pages[pages.index(page) + 1:pages.index(page) + 1] = more
        named.update(pages)
        nav.append({title: pages})
    nav.insert(-1, {"API": "api.md"})
    left = {name for name in stage.written if not name.startswith("source/")}
    left -= named | {"index.md", "contents.md", "gallery.md", "api.md"}
    if left:
        sys.exit(f"doc/README.md does not lead to {', '.join(sorted(left))}")
    return nav


def api(source):
    """The headers that fsi.hpp includes, what each is about, and the way to its names."""
    with open(os.path.join(source, "libfsi", "fsi.hpp"), encoding="utf-8") as file:
        headers = re.findall(r'#include "(\S+)"', file.read())
    rows = []
    for header in headers:
        with open(os.path.join(source, header), encoding="utf-8") as file:
            head = re.match(r"#pragma once\n((?://[^\n]*\n)+)", file.read()).group(1)
        about = re.match(r".*?\.(?=\s|$)", " ".join(head.replace("//", "").split())).group(0)
        name = os.path.basename(header).replace("_", "__").replace(".", "_8") + ".html"
        rows.append(f"| [{header}](api/{name}) | {about} |")
    return ("# API\n\nA driver includes `libfsi/fsi.hpp`, which includes these. "
            "[All classes](api/annotated.html), [all files](api/files.html), "
            "[all names](api/namespacemembers.html).\n\n| header | about |\n|---|---|\n" + "\n".join(rows) + "\n")


def main():
    source, folder, site = (os.path.abspath(word) for word in sys.argv[1:4])
    stage = Stage(source, folder)
    for base, _, files in os.walk(os.path.join(source, "doc")):
        for name in files:
            path = os.path.relpath(os.path.join(base, name), source)
            if path.startswith("doc/site/"):
                continue
            if name.endswith(".md"):
                stage.page(path)
            elif name.endswith(".png"):
                stage.copy(path, stage.place(path))
    stage.page("README.md")
    stage.write("gallery.md", stage.relinked("doc/gallery.md", gallery.page(source), "gallery.md"))
    stage.write("api.md", api(source))
    stage.show_wanted()
    with open(os.path.join(source, "doc", "README.md"), encoding="utf-8") as file:
        nav = navigation(stage, file.read())
    for name in ("mathjax_setup.js", "site.css"):
        stage.copy(os.path.join("doc", "site", name), "assets/" + name)
    for part in MATHJAX_PARTS:
        copy = shutil.copytree if os.path.isdir(os.path.join(MATHJAX, part)) else shutil.copyfile
        target = os.path.join(stage.folder, "assets", "mathjax", part)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        copy(os.path.join(MATHJAX, part), target)
    with open(os.path.join(folder, "mkdocs.yml"), "w", encoding="utf-8") as file:
        json.dump({"INHERIT": os.path.join(source, "doc", "site", "mkdocs.yml"), "docs_dir": stage.folder,
                   "site_dir": site, "nav": nav}, file)


if __name__ == "__main__":
    main()
