#!/usr/bin/python3
"""One version everywhere: version.py SOURCE PROGRAM. It is that of CMakeLists.txt; CITATION.cff, the newest
heading of the changelog, the recipe for Spack and -version tell it too."""
import os
import re
import subprocess
import sys

PLACES = (("CITATION.cff", r"^version: (\S+)$"), ("doc/changelog.md", r"^## (\d[\d.]*)"),
          (".ci/spack/packages/libfsi/package.py", r'^    version\("([\d.]+)"'))


def main():
    source, program = sys.argv[1:3]

    def told(path, pattern):
        with open(os.path.join(source, path), encoding="utf-8") as file:
            return re.search(pattern, file.read(), re.M).group(1)

    version = told("CMakeLists.txt", r"^project\(fsi VERSION (\S+)")
    found = {path: told(path, pattern) for path, pattern in PLACES}
    said = subprocess.run([program, "-version"], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=True).stdout
    found["-version"] = said.split()[1].rstrip(",")
    wrong = {place: other for place, other in found.items() if other != version}
    for place, other in wrong.items():
        print(f"FAIL {place} tells {other}, CMakeLists.txt {version}")
    print(f"{version} in {1 + len(found) - len(wrong)} of {1 + len(found)} places")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
