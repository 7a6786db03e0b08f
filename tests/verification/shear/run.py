#!/usr/bin/python3
"""A neo-Hookean disc or sphere between sliding plates against the exact solution without plates.

    run.py DRIVER CASE MESHES FOLDER NAME DIM BOXES END LIMIT CA RATIO RE [OPTIONS...]

Runs CASE on MESHES/NAME-H.msh for every side H of BOXES (10,20), prints Taylor deformation D and angle
over time, and takes out what the plates and neighbours add, in proportion to H^-DIM, from the last two
boxes. Then |D - D_exact| / (D_exact at END) at all times, and |angle / angle_exact - 1| from t = 0.1 on,
must not exceed LIMIT. OPTIONS are the driver's.
"""
import csv
import os
import resource
import subprocess
import sys

import numpy as np

import exact

SAMPLES = 0.05


def columns(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {name: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}


def run(driver, case, mesh, out, end, ca, ratio, reynolds, options):
    """Times, deformation, angle, CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([driver, case, "-mesh", mesh, "-output_dir", out, "-time_end", str(end),
                    "-solid_shear_modulus", str(1 / ca), "-solid_viscosity", str(ratio),
                    "-fluid_density", str(reynolds), "-solid_density", str(reynolds),
                    "-output_interval", "0", "-sample_interval", str(SAMPLES), *options],
                   check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    found = columns(os.path.join(out, "solid.csv"))
    kept = found["t"] > SAMPLES / 2
    return (found["t"][kept], found["taylor"][kept], found["taylor_angle"][kept],
            resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before)


def without_plates(boxes, values, dim):
    """values = a + b H^-dim through the last two boxes."""
    if len(boxes) < 2:
        return values[-1]
    far, near = (float(h) ** -dim for h in boxes[:-3:-1])
    return values[-1] + (values[-1] - values[-2]) * far / (near - far)


def main():
    driver, case, meshes, folder, name, dim, boxes, end, limit, ca, ratio, reynolds = sys.argv[1:13]
    options = sys.argv[13:]
    dim, end, limit, ca, ratio = int(dim), float(end), float(limit), float(ca), float(ratio)
    reynolds = float(reynolds)
    boxes = boxes.split(",")
    print(f"{name}: Ca {ca:g}, viscosity ratio {ratio:g}, Re {reynolds:g} {' '.join(options)}")
    runs = []
    for box in boxes:
        out = os.path.join(folder, f"{name}-{box}-Ca{ca:g}-ratio{ratio:g}")
        runs.append(run(driver, case, os.path.join(meshes, f"{name}-{box}.msh"), out, end, ca, ratio,
                        reynolds, options))
        print(f"  H = {box}: CPU {runs[-1][3]:.1f} s", flush=True)
    t = runs[-1][0]
    D, angle = (without_plates(boxes, [np.interp(t, r[0], r[i]) for r in runs], dim) for i in (1, 2))
    D_exact, angle_exact = (exact.disc if dim == 2 else exact.sphere)(t, ca, ratio)
    off, turned = abs(D - D_exact) / D_exact[-1], abs(angle / angle_exact - 1)
    shown = [0.1, 0.2, 0.5, *range(1, int(end) + 1)]
    for i in sorted({int(np.argmin(abs(t - s))) for s in (*shown, end)}):
        each = "  ".join(f"{r[1][min(i, len(r[1]) - 1)]:.5f} {r[2][min(i, len(r[2]) - 1)]:.3f}" for r in runs)
        print(f"  t {t[i]:5.2f}: D, angle {each}  without plates {D[i]:.5f} {angle[i]:.3f}  exact "
              f"{D_exact[i]:.5f} {angle_exact[i]:.3f}  D off {100 * (D[i] / D_exact[i] - 1):+.2f} %, angle "
              f"{100 * (angle[i] / angle_exact[i] - 1):+.2f} %")
    turned = turned[t > 0.1 - SAMPLES / 2]
    print(f"  largest error of D {100 * off.max():.2f} % of its last, of the angle {100 * turned.max():.2f} %; "
          f"limit {100 * limit:g} %")
    return 0 if max(off.max(), turned.max()) <= limit else 1


if __name__ == "__main__":
    sys.exit(main())
