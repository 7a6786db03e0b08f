#!/usr/bin/python3
"""The Debian packages: run.py CPACK BUILD VERSION COMPILER FOLDER

cpack makes them; they name the packages they need; taken apart, their programs run, their man pages are
without a warning, and a program is built against the library by pkg-config.
"""
import glob
import os
import shutil
import subprocess
import sys

PROGRAMS = ("advect", "cavity", "mesh", "mpiexec", "pipe", "shear", "stenosis", "vessel")
NEEDS = {"fsi": ("openmpi-bin", "libpetsc-real3", "libhdf5-openmpi", "libmetis5", "libopenmpi3"),
         "libfsi-dev": ("libpetsc-real-dev", "libmetis-dev", "libhdf5-openmpi-dev", "libopenmpi-dev")}
MINE = """#include <libfsi/fsi.hpp>
#include <iostream>
int main() { std::cout << fsi::version() << '\\n'; }
"""
failures = []


def check(holds, sentence):
    print("ok  " if holds else "FAIL", sentence)
    if not holds:
        failures.append(sentence)


def run(*words, **more):
    return subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, **more)


def take_apart(folder, version):
    """All packages in one tree, whose usr is returned."""
    tree = os.path.join(folder, "tree")
    for name, needs in NEEDS.items():
        found = glob.glob(os.path.join(folder, f"{name}_{version}_*.deb"))
        check(len(found) == 1, f"there is one package {name} of version {version}: {found}")
        if not found:
            continue
        told = run("dpkg-deb", "-f", found[0], "Depends").stdout
        for need in needs:
            check(need in told, f"{name} depends on {need}")
        check(run("dpkg-deb", "-x", found[0], tree).returncode == 0, f"{name} can be taken apart")
    return os.path.join(tree, "usr")


def check_programs(usr, version):
    for name in PROGRAMS:
        program = os.path.join(usr, "bin", "fsi-" + name)
        page = os.path.join(usr, "share", "man", "man1", f"fsi-{name}.1")
        check(os.access(program, os.X_OK), f"fsi-{name} is there")
        check(os.path.exists(page), f"fsi-{name} has a man page")
        if name != "mpiexec":
            told = run(program, "-version").stdout
            check(told.startswith(f"fsi-{name} {version}, commit "), f"fsi-{name} tells {version}: {told.strip()}")
        if shutil.which("groff"):
            told = run("groff", "-man", "-Tutf8", "-ww", page).stderr
            check(told == "", f"the man page of fsi-{name} is without a warning {told}")
    check("patches" in run("cat", os.path.join(usr, "share", "man", "man1", "fsi-vessel.1")).stdout,
          "the man page of fsi-vessel lists the options of patches")


def check_library(usr, version, compiler, folder):
    """A program built by pkg-config against the tree."""
    pc = glob.glob(os.path.join(usr, "**", "fsi.pc"), recursive=True)
    check(len(pc) == 1, "fsi.pc is there")
    environment = dict(os.environ, PKG_CONFIG_PATH=os.path.dirname(pc[0]))
    check(run("pkg-config", "--modversion", "fsi", env=environment).stdout.strip() == version,
          f"pkg-config tells {version}")
    flags = run("pkg-config", "--cflags", "--libs", "fsi", env=environment).stdout.split()
    with open(os.path.join(folder, "mine.cpp"), "w", encoding="utf-8") as file:
        file.write(MINE)
    mine = os.path.join(folder, "mine")
    said = run(compiler, "-std=c++20", mine + ".cpp", "-o", mine, *flags)
    check(said.returncode == 0, "a program is built by pkg-config " + said.stderr[-500:])
    check(said.returncode == 0 and run(mine).stdout.strip() == version, "and tells the version")


def main():
    cpack, build, version, compiler, folder = sys.argv[1:6]
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    said = run(cpack, "-G", "DEB", "-B", folder, cwd=build)
    check(said.returncode == 0, "cpack makes the packages " + said.stderr[-500:])
    usr = take_apart(folder, version)
    check_programs(usr, version)
    check_library(usr, version, compiler, folder)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
