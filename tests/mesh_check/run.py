#!/usr/bin/python3
"""fsi-mesh check on a mesh of tets as they come, on 1, 2 and 3 ranks; what drivers say of it.

    run.py SOURCE DRIVERS FOLDER MPIEXEC...

The report holds the cells, patches and figures that the mesh file and the file of the worst cells tell;
a driver prints its line and warns, and a flow that is too fast ends with place, cell and term.
"""
import os
import re
import subprocess
import sys

import h5py
import numpy as np

failures = []


def check(holds, sentence):
    print("ok  " if holds else "FAIL", sentence)
    if not holds:
        failures.append(sentence)


def run(command):
    return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)


def gmsh(source, name, target, dimension, *settings):
    subprocess.run(["gmsh", f"-{dimension}", os.path.join(source, "meshes", name + ".geo"), *settings,
                    "-format", "msh2", "-o", target], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL)


def elements_of_type(path, kind):
    with open(path, encoding="utf-8") as file:
        lines = file.read().split("$Elements\n")[1].split("$EndElements")[0].splitlines()[1:]
    return sum(line.split()[1] == kind for line in lines)


def check_report(text, mesh):
    lines = text.splitlines()
    tets = elements_of_type(mesh, "4")
    check(f"cells  tet {tets}" in lines, f"it counts {tets} tets")
    patches = {line.split()[0]: line for line in lines if re.match(r"(inlet|outlet|wall) ", line)}
    area = {name: float(line.split()[2]) for name, line in patches.items()}
    check(abs(area["inlet"] - area["outlet"]) < 1e-9 and 0.6 < area["inlet"] < np.pi / 4,
          f"inlet and outlet have the area of a polygon in the circle: {area}")
    diameter = {name: float(line.split()[3]) for name, line in patches.items()}
    check(all(abs(diameter[name] - (4 * area[name] / np.pi)**0.5) < 1e-4 for name in area),
          f"the diameter is that of a circle of the same area: {diameter}")
    centre = {name: [float(x) for x in re.search(r"\((.*?)\)", line).group(1).split(",")]
              for name, line in patches.items()}
    check(all(np.allclose(centre[name], (x, 0.5, 0.5), atol=0.02)
              for name, x in (("inlet", 0), ("wall", 2.5), ("outlet", 5))), f"and its centre: {centre}")
    check("(-1, 0, 0)" in patches["inlet"] and "(1, 0, 0)" in patches["outlet"] and
          patches["inlet"].endswith("flat") and patches["wall"].endswith("closed round, or opposite sides"),
          "normals point outward, the pipe's wall closes round")
    check(any("from wall to wall" in line and line.startswith("cells across") for line in lines),
          "the passage is told from wall to wall")
    check("give gmsh a smaller size, " in text, "and what to change where it holds few cells")
    check("divide them by the Mesh.ScalingFactor" in text, "in the unit of the mesh, which need not be that of the geometry")
    for words in ("are irregular", "upwind share beta", "theta_f", "may take steps of", "in gmsh: "):
        check(words in text, f"it tells: {words}")


def check_worst(text, path):
    listed = re.findall(r"^(\d+) +tet +(\S+) +(\S+) +(\S+) +(\S+)  \(", text, re.M)
    with h5py.File(path) as file:
        data = file["VTKHDF/CellData"]
        ids = [int(i) for i in data["cell"][:]]
        rows = {i: [data[name][k] for name in ("non_orthogonality", "skewness", "volume_ratio",
                                               "aspect_ratio")] for k, i in enumerate(ids)}
        check(file["VTKHDF"].attrs["Type"] in (b"UnstructuredGrid", "UnstructuredGrid") and
              file["VTKHDF/NumberOfCells"][0] == 12 and set(file["VTKHDF/Types"][:]) == {10},
              "the file holds twelve tets")
        x, corners = file["VTKHDF/Points"][:], file["VTKHDF/Connectivity"][:].reshape(-1, 4)
    check(ids == sorted(ids) and set(ids) == {int(row[0]) for row in listed},
          "those that are listed, in the order of the mesh")
    check(all(np.allclose([float(word) for word in row[1:]], rows[int(row[0])], rtol=1e-3)
              for row in listed), "with the same figures")
    # Longest edge over least height, by the volume.
    for k, i in enumerate(ids):
        p = x[corners[k]]
        edges = max(np.linalg.norm(p[a] - p[b]) for a in range(4) for b in range(a))
        areas = [np.linalg.norm(np.cross(p[b] - p[a], p[c] - p[a])) / 2
                 for a, b, c in ((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3))]
        volume = abs(np.dot(p[1] - p[0], np.cross(p[2] - p[0], p[3] - p[0]))) / 6
        ratio = edges * max(areas) / (3 * volume) / np.sqrt(1.5)
        if abs(ratio / rows[i][3] - 1) > 1e-9:
            check(False, f"cell {i} has the aspect ratio {ratio}, not {rows[i][3]}")


def main():
    source, drivers, folder = (os.path.abspath(word) for word in sys.argv[1:4])
    launcher = sys.argv[4:]
    os.makedirs(folder, exist_ok=True)
    tets, quads = os.path.join(folder, "tets.msh"), os.path.join(folder, "quads.msh")
    gmsh(source, "cylinder", tets, 3, "-setnumber", "n", "5", "-setnumber", "optimise", "0")
    gmsh(source, "cavity", quads, 2, "-setnumber", "n", "16")
    doctor = [os.path.join(drivers, "fsi-mesh"), "check"]
    reports = []
    for ranks in (1, 2, 3):
        worst = os.path.join(folder, f"worst_{ranks}.hdf")
        command = doctor + [tets, "-worst", "12", "-worst_file", worst]
        said = run(command if ranks == 1 else launcher + [str(ranks)] + command)
        check(said.returncode == 0, f"exit code 0 on {ranks} ranks: {said.stderr}")
        reports.append(said.stdout.replace(f" on {ranks} rank" + "s" * (ranks > 1), "").replace(worst, ""))
        check_worst(said.stdout, worst)
    check_report(reports[0], tets)
    check(reports[0] == reports[1] == reports[2], "one, two and three ranks tell the same")
    sound = run(doctor + [quads])
    check("cells  quad 256" in sound.stdout and "nothing is past its limit" in sound.stdout,
          "an even mesh has nothing to change")

    out = os.path.join(folder, "out")
    stenosis = [os.path.join(drivers, "fsi-stenosis"), "-mesh", tets, "-output_dir", out]
    short = run(stenosis + ["-time_end", "0.001"])
    line = reports[0].splitlines()[0]
    check(short.returncode == 0 and line in short.stdout.replace(" on 1 rank", ""),
          "a driver prints the same line: " + line)
    check("fsi: warning: mesh " + tets in short.stderr and "(limit " in short.stderr and
          "fsi-mesh check" in short.stderr, "and warns: " + short.stderr)
    quiet = run([os.path.join(drivers, "fsi-cavity"), "-mesh", quads, "-output_dir", out, "-time_end",
                 "0.001"])
    check(quiet.returncode == 0 and quiet.stderr == "", "but not of an even mesh" + quiet.stderr)
    failed = run(stenosis + ["-inlet_pressure", "1e6", "-fluid_viscosity", "1e-5", "-time_step", "0.2"])
    check(failed.returncode == 3, f"a flow that is too fast: exit code 3 ({failed.returncode})")
    said = r"largest Courant number is \S+ at \(\S+, \S+, \S+\) in a tet of aspect ratio .*: convection"
    check(re.search(said, failed.stderr), "place, cell and term are told: " + failed.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
