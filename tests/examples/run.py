#!/usr/bin/python3
"""A case of examples/ on a coarse mesh for a short time, as a user would run it.

    run.py NAME N TIME SOURCE DRIVERS FOLDER RANKS [MPIEXEC...]

On one rank and on each of RANKS (2 or 2,3): the run completes, writes the promised files, and all
give the same numbers to the solvers' tolerance; run.yaml repeats the run; the pictures can be drawn.
"""
import csv
import json
import math
import os
import re
import shutil
import subprocess
import sys

# Of a column's largest size: what solver tolerances may leave between numbers of ranks. The pressure
# is solved tighter than by default, so that a real difference shows; what remains is mostly the
# absolute tolerance on the divergence, which in short steps moves p by rho / dt as much.
TOLERANCE = 5e-5
TIGHT = ["-p_ksp_rtol", "1e-10"]
# Columns that tell of the run, not of the flow.
OF_THE_RUN = {"wall_per_step", "pressure_iterations", "divergence_max", "overshoot", "det_B_min",
              "det_B_max", "min_eig_B"}
# The axis of a round solid has no direction of its own.
AXIS = {"nx", "ny", "nz", "angle", "turned", "taylor_angle"}
LONGEST = {"lx", "ly", "lz", "long_angle"}  # nor has the longest direction of a ring
# Where a section passes a corner of a cell it gains a piece: 1e-8 in the surface, 1e-3 in this angle.
SECTIONS = {"bending_meridian"}
ROUND = {"cavity_disc", "shear", "two_discs", "stenosis_sphere", "vortex", "bend", "bifurcation", "lodging"}
failures = []


def check(holds, sentence):
    if not holds:
        failures.append(sentence)
        print("FAIL", sentence)


def run(words, **more):
    print("$", " ".join(words), flush=True)
    subprocess.run(words, check=True, stdin=subprocess.DEVNULL, **more)


def head(case, field):
    """A line "# field: words" at the head of a case."""
    with open(case, encoding="utf-8") as file:
        return re.search(rf"^# {field}: *(.*)$", file.read(), re.M).group(1).split()


def make_mesh(case, source, n, target):
    dimension, geometry, *parameters = head(case, "mesh")
    settings = dict(p.split("=") for p in parameters)
    settings["n"] = n
    words = [w for k, v in settings.items() for w in ("-setnumber", k, v)]
    run(["gmsh", dimension, os.path.join(source, "meshes", geometry + ".geo"), *words, "-o", target],
        stdout=subprocess.DEVNULL)


def table(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    check(len(rows) > 2, f"{path} has rows")
    check(all(len(row) == len(rows[0]) for row in rows), f"{path}: every row is whole")
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


def check_files(out, ranks):
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    check(summary["status"] == "complete", f"{out}: status is {summary['status']}")
    check(summary["ranks"] == ranks, f"{out}: ranks are {summary['ranks']}")
    with open(os.path.join(out, "run.yaml"), encoding="utf-8") as file:
        yaml = file.read()
    check(f"# libfsi {summary['version']}, commit {summary['commit']}\n" in yaml,
          f"{out}: run.yaml is there and tells the version and commit of summary.json")
    check(not re.search(r': "-?\d+e\+0', yaml), f"{out}: run.yaml has no 1e+01 for 10")
    for table in ("flow.csv", "solid.csv"):
        if os.path.exists(os.path.join(out, table)):
            with open(os.path.join(out, table), encoding="utf-8") as file:
                check("nan" not in file.read().lower(), f"{out}: {table} holds numbers only")


def compare(name, one, other, tolerance, skipped):
    """Columns of the same name agree, relative to the largest size of the column."""
    a, b = table(os.path.join(one, name)), table(os.path.join(other, name))
    check(list(a) == list(b), f"{name}: the same columns")
    for column in a:
        if column in skipped or column not in b:
            continue
        check(len(a[column]) == len(b[column]), f"{name}: {column} has as many rows")
        size = max(map(abs, a[column] + [1e-2]))
        apart = max((abs(x - y) for x, y in zip(a[column], b[column])), default=0)
        check(math.isfinite(apart) and apart <= tolerance * size,
              f"{name}: {column} apart by {apart:.3e}, size {size:.3e}")


def main():
    name, n, end, source, drivers, folder, ranks = sys.argv[1:8]
    mpiexec = sys.argv[8:]
    case = os.path.join(source, "examples", name + ".yaml")
    folder = os.path.join(folder, name)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    driver = os.path.join(drivers, head(case, "driver")[0])
    mesh = os.path.join(folder, "mesh.msh")
    make_mesh(case, source, n, mesh)

    one, again = (os.path.join(folder, d) for d in ("one", "again"))
    many = {n: os.path.join(folder, f"ranks{n}") for n in ranks.split(",")}
    options = ["-mesh", mesh, "-time_end", end, "-output_interval", end, "-sample_interval", "0",
               *([] if driver.endswith("fsi-advect") else TIGHT)]
    run([driver, case, *options, "-output_dir", one])
    check_files(one, 1)
    for n, out in many.items():
        run([*mpiexec, n, driver, case, *options, "-output_dir", out])
        check_files(out, int(n))
    run([driver, os.path.join(one, "run.yaml"), "-output_dir", again])
    skipped = OF_THE_RUN | SECTIONS | LONGEST | (AXIS if name in ROUND else set())
    for file in sorted(file for file in os.listdir(one) if file.endswith(".csv")):
        if os.path.exists(os.path.join(one, file)):
            for out in many.values():
                compare(file, one, out, TOLERANCE, skipped)
            compare(file, one, again, 0, {"wall_per_step"})
    run(["/usr/bin/python3", os.path.join(source, "examples", "draw.py"), one])
    for picture in ("series.png", "flow.png", *(["view.png"] if head(case, "mesh")[0] == "-3" else [])):
        check(os.path.exists(os.path.join(one, picture)), f"{picture} is drawn")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
