#!/usr/bin/python3
"""What the tutorials tell a reader to write and to run: tutorial.py SOURCE DRIVERS OWN_DRIVER FOLDER

The files of own_vessel.md and own_driver.md are taken from the pages and run, on coarse meshes for a
few steps; the program that own_driver.md shows is the one in examples/own_driver.
"""
import csv
import math
import os
import re
import shutil
import subprocess
import sys

# What `file `NAME`` announces: the block of code that follows.
FILE = re.compile(r"file `([\w.]+)`:\n\n```\w*\n(.*?)```", re.S)
failures = []


def check(holds, sentence):
    print("ok  " if holds else "FAIL", sentence)
    if not holds:
        failures.append(sentence)


def files_of(source, page, folder):
    """Writes the files that a page shows into the folder; {name: text}."""
    with open(os.path.join(source, "doc", "tutorial", page), encoding="utf-8") as file:
        shown = dict(FILE.findall(file.read()))
    os.makedirs(folder)
    for name, text in shown.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    return shown


def run(folder, *words):
    said = subprocess.run(words, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    check(said.returncode == 0, f"{os.path.basename(words[0])} ends with {said.returncode}")
    if said.returncode:
        print(said.stdout[-1000:], said.stderr[-1000:])
    return said.stdout


def own_vessel(source, drivers, folder):
    shown = files_of(source, "own_vessel.md", folder)
    check(set(shown) == {"cad.geo", "vessel.geo", "vessel.yaml", "inflow.csv"},
          f"own_vessel.md shows its files: {sorted(shown)}")
    run(folder, "gmsh", "-", "cad.geo")
    run(folder, "gmsh", "-3", "-bin", "-setnumber", "h", "0.8", "vessel.geo", "-o", "vessel.msh")
    told = run(folder, os.path.join(drivers, "fsi-mesh"), "check", "vessel.msh")
    area = re.search(r"^inlet +\d+ +(\S+) .*flat$", told, re.M)
    check(area and 1.1e-5 < float(area.group(1)) < 1.26e-5, "the mesh is in metres, the inlet flat")
    told = run(folder, os.path.join(drivers, "fsi-vessel"), "vessel.yaml", "-mesh", "vessel.msh",
               "-time_end", "0.002")
    check("solid on the centre line from inlet to main" in told and "complete at t = 0.002" in told,
          "the case runs")


def own_driver(source, program, folder):
    shown = files_of(source, "own_driver.md", folder)
    with open(os.path.join(source, "examples", "own_driver", "pulsed_channel.cpp"),
              encoding="utf-8") as file:
        check(shown.get("pulsed_channel.cpp") == file.read(),
              "own_driver.md shows examples/own_driver/pulsed_channel.cpp")
    run(folder, "gmsh", "-2", "-setnumber", "n", "16", "-setnumber", "lx", "2", "-setnumber", "lz", "0",
        os.path.join(source, "meshes", "box.geo"), "-o", "plates.msh")
    told = run(folder, program, "pulsed.yaml", "-mesh", "plates.msh", "-time_end", "0.5")
    check("complete at t = 0.5" in told, "the driver runs")
    with open(os.path.join(folder, "out", "pulsed-channel", "flow.csv"), encoding="utf-8") as file:
        last = list(csv.DictReader(file))[-1]
    force = 0.08 * (1 + math.cos(2 * math.pi * 0.5 / 4))
    check(abs(float(last["force"]) - force) < 1e-12 and float(last["largest_speed"]) > 0,
          f"flow.csv holds its own columns: {last['force']}, {last['largest_speed']}")
    # The force is in the equation: with parabola and plates the energy is 4/15 rho U^2 V.
    run(folder, program, "-mesh", "plates.msh", "-mesh_periodic", "left,right", "-force_swing", "0",
        "-time_end", "60", "-sample_interval", "20", "-output_dir", "steady")
    with open(os.path.join(folder, "steady", "flow.csv"), encoding="utf-8") as file:
        rows = [line.split(",") for line in file.read().splitlines()]
    energy = float(rows[-1][rows[0].index("kinetic_energy")])
    check(abs(energy / (8 / 15) - 1) < 0.01, f"a steady force makes a parabola: energy {energy}")


def main():
    source, drivers, program, folder = (os.path.abspath(word) for word in sys.argv[1:5])
    folder = os.path.join(folder, "tutorial")
    shutil.rmtree(folder, ignore_errors=True)
    own_vessel(source, drivers, os.path.join(folder, "vessel"))
    own_driver(source, program, os.path.join(folder, "driver"))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
