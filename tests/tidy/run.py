#!/usr/bin/env python3
"""clang-tidy over sources of a build: run.py CLANG_TIDY BUILD JOBS FOLDER... prints each finding once.

FOLDER: relative to the root of the source; all its sources that the build compiles are looked at, and
with them the headers of libfsi that they include. The checks are those of .clang-tidy. What the
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


def sources(build, root, folders):
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        found = {os.path.realpath(command["file"]) for command in json.load(file)}
    return sorted(path for path in found
                  if os.path.relpath(path, root).startswith(tuple(f + "/" for f in folders)))


def main():
    tool, build, jobs, folders = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4:]
    root = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
    paths = sources(build, root, folders)

    def look_at(path):
        command = [tool, "-p", build, "--quiet", "--warnings-as-errors=*", path]
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
    print(f"{len(paths)} sources, {len(findings)} findings")
    return 1 if failed or findings or not paths else 0


if __name__ == "__main__":
    sys.exit(main())
