#!/usr/bin/python3
"""What .ci/setup says where packages are missing: setup.py SOURCE FOLDER. apt-get is a stand-in."""
import os
import shutil
import subprocess
import sys

STAND_INS = {
    "dpkg-query": 'case " $MISSING " in *" all "* | *" $4 "*) echo not-installed ;; *) echo installed ;; esac',
    "apt-get": 'for i in $(seq 300); do echo "Setting up package $i"; done; echo "$*" >>"$CALLS"; '
               'case "$*" in *$UNKNOWN*) exit 100 ;; esac; [ ! -e "$BROKEN" ]',
    "sudo": 'exec "$@"',
}
failures = []


def check(holds, sentence):
    print("ok  " if holds else "FAIL", sentence)
    if not holds:
        failures.append(sentence)


def set_up(folder, broken="", missing="all", unknown="none", **more):
    """The set-up where `missing` is not installed, apt-get fails or does not know one package; `calls` of apt-get."""
    calls = os.path.join(folder, "calls")
    with open(calls, "w", encoding="utf-8"):
        pass
    environment = {**os.environ, "PATH": os.path.join(folder, "bin") + os.pathsep + os.environ["PATH"],
                   "BROKEN": broken or os.path.join(folder, "none"), "MISSING": missing, "UNKNOWN": unknown,
                   "CALLS": calls, **more}
    said = subprocess.run(["bash", "-c", f"source {folder}/.ci/setup && fsi_wait && echo set up"], env=environment,
                          capture_output=True, text=True, stdin=subprocess.DEVNULL)
    with open(calls, encoding="utf-8") as file:
        said.calls = file.read().splitlines()
    return said


def check_wishes(folder):
    """VTK for the examples: installed with the rest, and done without where that cannot be."""
    said = set_up(folder, FSI_FOR="examples")
    check(said.returncode == 0 and "python3-vtk9 xvfb" in said.stdout and "libgtest-dev" not in said.stdout and
          len(said.calls) == 4 and "matplotlib" not in said.calls[1] and "matplotlib" in said.calls[3],
          f"with what draws, and without the tests' packages: {said.stdout}{said.calls}")
    check("python3-vtk9" not in set_up(folder).stdout, "the tests do not ask for it")
    said = set_up(folder, missing="python3-h5py", broken=folder, FSI_FOR="examples")
    check(said.returncode != 0 and "set up" not in said.stdout and "Setting up package 300" in said.stderr,
          "what fails beside ends the set-up")
    said = set_up(folder, missing="", FSI_FOR="examples")
    check(said.returncode == 0 and said.stdout == "set up\n" and not said.calls, "no network where nothing is missing")
    said = set_up(folder, unknown="python3-vtk9", FSI_FOR="examples")
    check(said.returncode == 0 and "done without: python3-vtk9 xvfb" in said.stdout and "set up" in said.stdout,
          f"goes on where it is not to be had: {said.stdout}{said.stderr}")
    said = set_up(folder, broken=folder, missing="xvfb", FSI_FOR="examples")
    check(said.returncode == 0 and "done without: xvfb" in said.stdout and len(said.calls) == 1,
          f"goes on where it alone is missing, without a network: {said.stdout}{said.calls}")
    said = set_up(folder, missing="xvfb", FSI_FOR="examples", FSI_WISHES="")
    check(said.returncode == 0 and not said.calls, "FSI_WISHES= leaves it out")


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
    check_wishes(folder)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
