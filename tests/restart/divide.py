#!/usr/bin/python3
"""A run that goes on divides the mesh anew by where the solid is, if it is asked to.

    divide.py SOURCE DRIVERS FOLDER MPIEXEC...

The soft torus in the pipe, coarse, on three ranks, each of which reads a third of the mesh file. The mesh is
divided across the pipe, so that the ring leaves its ranks on its way. Gone on with -restart_divide the largest
share of solid cells is at most 1.3 of the mean, and less than without, where a notice tells of it. The tables agree to the tolerance of the
solvers. A run that starts with the option divides the mesh anew by itself, and ends as the others. A solid that is placed on the centre line of a mesh is shared as well, and so
is the section of one in a plane.
"""
import csv
import json
import os
import re
import shutil
import subprocess
import sys

RANKS, CUT, END = "3", "1", "1.1"


def run(command, out, *words):
    done = subprocess.run([*command, "-output_dir", out, *words], check=True, text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    shares = [float(share) for share in re.findall(r"solid cells on the ranks: largest over mean (\S+)", done.stdout)]
    return shares[-1], done.stderr.count("the others wait for it"), len(shares)


def last_row(out):
    with open(os.path.join(out, "solid.csv"), encoding="utf-8") as file:
        return {name: float(value) for name, value in list(csv.DictReader(file))[-1].items()}


def number_of_rows(out):
    with open(os.path.join(out, "flow.csv"), encoding="utf-8") as file:
        return len(file.readlines())


def main():
    source, drivers, folder, *launcher = sys.argv[1:]
    folder = os.path.join(folder, "divide")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    mesh = os.path.join(folder, "pipe.msh")
    subprocess.run(["gmsh", "-3", os.path.join(source, "meshes", "pipe.geo"), "-setnumber", "n", "12", "-bin",
                    "-o", mesh], check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    shared = os.path.join(folder, "pipe.h5")
    subprocess.run([os.path.join(drivers, "fsi-mesh"), "convert", mesh, shared, "-mesh_periodic", "inlet,outlet"],
                   check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    driver = [os.path.join(drivers, "fsi-pipe"), os.path.join(source, "examples", "torus.yaml"), "-mesh", shared,
              "-mesh_divide_along", "0,0,0", "-output_interval", "0", "-checkpoint_interval", CUT, "-time_step", "0.01"]
    command = [*launcher, RANKS, *driver]
    kept, anew = os.path.join(folder, "kept"), os.path.join(folder, "anew")
    start, _, _ = run(command, kept, "-time_end", CUT)
    shutil.copytree(kept, anew)
    share_kept, notices_kept, _ = run(command, kept, "-restart", "-time_end", END)
    share_anew, notices_anew, _ = run(command, anew, "-restart", "-restart_divide", "-time_end", END)
    print(f"solid cells, largest over mean: {start} at the start, {share_kept} kept, {share_anew} divided anew")
    print(f"notices: {notices_kept} kept, {notices_anew} divided anew")
    a, b = last_row(kept), last_row(anew)
    apart = max(abs(a[name] - b[name]) for name in ("t", "x", "y", "z", "ux", "angle"))
    print(f"apart by {apart:.1e} at t = {a['t']:g}")
    itself = os.path.join(folder, "itself")
    command[command.index("-checkpoint_interval") + 1] = "0"
    share_itself, notices_itself, bodies = run(command, itself, "-restart_divide", "-time_end", END,
                                               "-max_wall_time", "3600")
    left = [name for name in os.listdir(itself) if name.startswith("checkpoint")]
    c, rows = last_row(itself), [number_of_rows(out) for out in (kept, itself)]
    by_itself = max(abs(a[name] - c[name]) for name in ("t", "x", "y", "z", "ux", "angle"))
    with open(os.path.join(itself, "summary.json"), encoding="utf-8") as file:
        status = json.load(file)["status"]
    with open(os.path.join(itself, "run.yaml"), encoding="utf-8") as file:
        repeats = 'restart: "false"' in file.read()
    print(f"by itself: {share_itself} after {bodies - 1} divisions, apart by {by_itself:.1e}, rows {rows}, {status}")
    bend = os.path.join(folder, "bend.msh")
    subprocess.run(["gmsh", "-3", os.path.join(source, "meshes", "bend.geo"), "-setnumber", "n", "8", "-bin",
                    "-o", bend], check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    share_on_path, _, _ = run([*launcher, RANKS, os.path.join(drivers, "fsi-vessel"),
                         os.path.join(source, "examples", "bend.yaml"), "-mesh", bend, "-output_interval", "0"],
                        os.path.join(folder, "bend"), "-time_end", "0.001")
    print(f"a sphere on the path of a bend: {share_on_path}")
    cavity = os.path.join(folder, "cavity.msh")
    subprocess.run(["gmsh", "-2", os.path.join(source, "meshes", "cavity.geo"), "-setnumber", "n", "32", "-bin",
                    "-o", cavity], check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    share_of_disc, _, _ = run([*launcher, RANKS, os.path.join(drivers, "fsi-cavity"), "-mesh", cavity, "-solid_shape",
                         "sphere", "-solid_radius", "0.2", "-solid_center", "0.5,0.5,0.5"],
                        os.path.join(folder, "cavity"), "-time_end", "0.001")
    print(f"a disc in a plane, its centre beside it: {share_of_disc}")
    checks = {"balanced at the start": start <= 1.3, "balanced again": share_anew <= 1.3 and share_anew < share_kept,
              "balanced where the place follows from the mesh": share_on_path <= 1.3,
              "balanced in a plane": share_of_disc <= 1.1,
              "told where it is lost, and only there": (notices_kept, notices_anew) == (1, 0),
              "the same run": apart <= 1e-4,
              "divided by itself": bodies == 2 and notices_itself == 1 and share_itself < 2,
              "to the same end": by_itself <= 1e-4 and rows[0] == rows[1] and status == "complete",
              "its run.yaml repeats the run": repeats,
              "no checkpoint is left where none was asked for": not left}
    for sentence, holds in checks.items():
        print("ok  " if holds else "FAIL", sentence)
    return 0 if all(checks.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
