#!/usr/bin/env python3
"""clang-tidy over sources of a build: run.py CLANG_TIDY BUILD JOBS FOLDER... prints each finding once.

FOLDER: relative to the root of the source; all its sources that the build compiles are looked at, and
with them the headers of libfsi that they include. Where the build joins sources into one (CMAKE_UNITY_BUILD),
the joined ones that hold a source of the folders are looked at whole. The checks are those of .clang-tidy. What the
compiler of this build takes and clang does not, errors in headers of the standard library among
them, is no finding; the checks go on after it.
"""
import json
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

FINDING = re.compile(r"^(/[^\s:]+):(\d+):(\d+): (?:warning|error): .*", re.M)
JOINED = re.compile(r"/Unity/unity_\d+_cxx\.cxx$")


def parts(path):
    """The sources that a joined source includes, or the source itself."""
    if not JOINED.search(path):
        return [path]
    with open(path, encoding="utf-8") as file:
        return re.findall(r'^#include "(/[^"]+)"', file.read(), re.M)


def sources(build, root, folders):
    """The files to compile, and how many sources of the folders are in them."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        found = {os.path.realpath(command["file"]) for command in json.load(file)}
    wanted = tuple(folder + "/" for folder in folders)
    inside = {path: sum(os.path.relpath(part, root).startswith(wanted) for part in parts(path))
              for path in found}
    return sorted(path for path in found if inside[path]), sum(inside.values())


def main():
    tool, build, jobs, folders = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4:]
    root = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
    paths, n_sources = sources(build, root, folders)

    def look_at(path):
        command = [tool, "-p", build, "--quiet", "--warnings-as-errors=*",
                   "--config-file=" + os.path.join(root, ".clang-tidy"), path]
        if JOINED.search(path):  # which includes sources, and whose names of one file shadow another's
            command[1:1] = ["--checks=-bugprone-suspicious-include", "--extra-arg=-Wno-shadow"]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    findings, failed = set(), False
    with ThreadPoolExecutor(jobs) as pool:
        for path, result in zip(paths, pool.map(look_at, paths)):
            here = {match.group(0) for match in FINDING.finditer(result.stdout)}
            findings |= {line for line in here if "[clang-diagnostic-error]" not in line}
            if result.returncode != 0 and not here:
                failed = True
                print(f"{path}: clang-tidy ended with {result.returncode}\n{result.stderr}")
    print("\n".join(sorted(findings)))
    print(f"{n_sources} sources, {len(findings)} findings")
    return 1 if failed or findings or not paths else 0


if __name__ == "__main__":
    sys.exit(main())
