#!/usr/bin/python3
"""Two stiff discs that meet and pass in shear against rigid discs in Stokes flow (stokes_pair.py).

    run.py DRIVER CASE MESHES FOLDER MESH OFFSET MODULUS RE LIMIT [OPTIONS...]

Runs CASE on MESHES/MESH.msh with the left disc at (-2, OFFSET), to the time when the rigid disc comes to x = 2.
At no time may the left disc be farther from the rigid one than LIMIT radii, nor a volume change by 1e-12. The
discs must mirror each other to 1e-5. OPTIONS are the driver's.
"""
import csv
import os
import resource
import subprocess
import sys

import numpy as np

import stokes_pair

HEIGHT, STEP = 10.0, 0.05


def columns(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {name: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}


def run(driver, case, mesh, out, end, offset, modulus, density, options):
    """The tables of the two discs."""
    chosen = {"solids_left_center": f"-2,{offset},0", "solids_right_center": f"2,-{offset},0",
              "fluid_density": density, "output_interval": 0, "sample_interval": STEP, "time_end": end}
    for name in ("left", "right"):
        chosen[f"solids_{name}_shear_modulus"] = modulus
        chosen[f"solids_{name}_density"] = density
    words = [word for key, value in chosen.items() for word in ("-" + key, str(value))]
    subprocess.run([driver, case, "-mesh", mesh, "-output_dir", out, *words, *options],
                   check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    return [columns(os.path.join(out, f"solid_{name}.csv")) for name in ("left", "right")]


def main():
    driver, case, meshes, folder, mesh, offset, modulus, density, limit = sys.argv[1:10]
    offset, limit = float(offset), float(limit)
    end = np.floor(stokes_pair.passing((-2, offset), HEIGHT, 12, STEP, 2)[0] / STEP) * STEP
    t, x, y = stokes_pair.path((-2, offset), HEIGHT, end, STEP)
    left, right = run(driver, case, os.path.join(meshes, mesh + ".msh"), os.path.join(folder, f"{mesh}-{offset:g}"),
                      end, offset, modulus, density, sys.argv[10:])
    assert len(left["t"]) == len(t) and abs(left["t"] - t).max() < 1e-9
    print(f"{mesh}, offset {offset:g}, G {modulus}, Re {density}")
    print("     t    x       rigid    y       rigid")
    for i in range(0, len(t), 10):
        print("%6.2f %8.4f %8.4f %8.4f %8.4f" % (t[i], left["x"][i], x[i], left["y"][i], y[i]))
    apart = np.hypot(left["x"] - x, left["y"] - y)
    aside = abs(np.interp(left["x"], x, y) - left["y"])
    mirrored = np.hypot(left["x"] + right["x"], left["y"] + right["y"])
    drift = max(abs(d["volume"] / d["volume"][0] - 1).max() for d in (left, right))
    energy = max(d["elastic_energy"].max() for d in (left, right))
    print(f"apart at the same time {apart.max():.2e}, at the same x {aside.max():.2e} (at most {limit:g}); "
          f"mirrored to {mirrored.max():.1e}; volume {drift:.1e}; elastic energy {energy:.1e}; least eigenvalue "
          f"{min(d['min_eig_B'].min() for d in (left, right)):.3f}; "
          f"{resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime:.0f} CPU s")
    return 0 if apart.max() <= limit and mirrored.max() <= 1e-5 and drift <= 1e-12 else 1


if __name__ == "__main__":
    sys.exit(main())
