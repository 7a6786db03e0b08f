#!/usr/bin/python3
"""What .ci/setup says where packages are missing: setup.py SOURCE FOLDER. apt-get is a stand-in."""
import os
import shutil
import subprocess
import sys

STAND_INS = {
    "dpkg-query": "echo not-installed",
    "apt-get": 'for i in $(seq 300); do echo "Setting up package $i"; done; [ ! -e "$BROKEN" ]',
    "sudo": 'exec "$@"',
}
failures = []


def check(holds, sentence):
    print("ok  " if holds else "FAIL", sentence)
    if not holds:
        failures.append(sentence)


def set_up(folder, broken=""):
    environment = {**os.environ, "PATH": os.path.join(folder, "bin") + os.pathsep + os.environ["PATH"],
                   "BROKEN": broken or os.path.join(folder, "none")}
    return subprocess.run(["bash", "-c", f"source {folder}/.ci/setup && echo set up"], env=environment,
                          capture_output=True, text=True, stdin=subprocess.DEVNULL)


def main():
    source, folder = (os.path.abspath(word) for word in sys.argv[1:3])
    shutil.rmtree(folder, ignore_errors=True)
    for name in ("bin", ".ci"):
        os.makedirs(os.path.join(folder, name))
    shutil.copy(os.path.join(source, ".ci", "setup"), os.path.join(folder, ".ci"))
    for name, text in STAND_INS.items():
        path = os.path.join(folder, "bin", name)
        with open(path, "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\n" + text + "\n")
        os.chmod(path, 0o755)
    said = set_up(folder)
    with open(os.path.join(folder, "build-setup.log"), encoding="utf-8") as file:
        logged = file.read().count("\n")
    check(said.returncode == 0 and said.stdout.count("\n") == 2 and "== installing: g++" in said.stdout and
          said.stderr == "", f"two lines, of what is installed and that it is: {said.stdout}{said.stderr}")
    check(logged == 600, f"what apt-get prints stands in build-setup.log: {logged} lines")
    said = set_up(folder, broken=folder)
    check(said.returncode != 0 and "set up" not in said.stdout and "Setting up package 300" in said.stderr and
          said.stderr.count("\n") <= 41, "where it fails, its last lines are shown and the set-up ends")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
