#!/usr/bin/python3
"""The lid-driven cavity against reference profiles.

    run.py DRIVER CASE MESHES FOLDER DATA RE T N [N...]

Runs the case to time T on quads of N cells per side (MESHES/cavityN.msh) and compares the extremes of
u on x = 0.5 and of v on y = 0.5, and the whole profiles, with the reference. At Re = 100 and N = 128
the extremes must lie within 0.3 %; between the last two N the error of the profiles must fall with
order 1.8 or more; the flow must not change any more by 1e-5 of the kinetic energy per unit of time.
"""
import csv
import glob
import os
import subprocess
import sys

import h5py
import numpy as np


def reference(data, re):
    with open(os.path.join(data, "ldc_reference_own.csv"), encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    column = {name: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}
    return column["s"], column[f"u_Re{re}"], column[f"v_Re{re}"]


def profiles(out, n):
    """u on x = 0.5 and v on y = 0.5 at the cell centres along them, by a cubic through the four cells
    across the line."""
    with h5py.File(sorted(glob.glob(os.path.join(out, "fields_0*.hdf")))[-1]) as file:
        u = file["VTKHDF/CellData/u"][:]
    with h5py.File(os.path.join(out, "fields_mesh.hdf")) as file:
        mesh = file["VTKHDF"]
        corners = mesh["Connectivity"][:].reshape(-1, 4)
        centre = mesh["Points"][:][corners].mean(axis=1)
    i, j = (np.rint(centre[:, k] * n - 0.5).astype(int) for k in (0, 1))
    grid = np.zeros((n, n, 2))
    grid[i, j] = u[:, :2]
    weights = np.array([-1, 9, 9, -1]) / 16
    middle = slice(n // 2 - 2, n // 2 + 2)
    s = (np.arange(n) + 0.5) / n
    return s, np.tensordot(weights, grid[middle, :, 0], 1), np.tensordot(weights, grid[:, middle, 1],
                                                                        (0, 1))


def extreme(s, f, largest):
    """Value at the top of the parabola through the largest (least) item and its neighbours."""
    k = int(np.argmax(f) if largest else np.argmin(f))
    a, b, c = np.polyfit(s[k - 1:k + 2] - s[k], f[k - 1:k + 2], 2)
    return c - b * b / (4 * a)


def main():
    driver, case, meshes, folder, data, re, end = sys.argv[1:8]
    s_ref, u_ref, v_ref = reference(data, re)
    failures, errors = [], []
    for n in map(int, sys.argv[8:]):
        out = os.path.join(folder, f"Re{re}-{n}")
        os.makedirs(out, exist_ok=True)
        subprocess.run([driver, case, "-mesh", os.path.join(meshes, f"cavity{n}.msh"),
                        "-output_dir", out, "-fluid_viscosity", str(1 / float(re)), "-time_end", end,
                        "-time_courant", "0.5", "-output_interval", end, "-sample_interval", "1"],
                       check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        with open(os.path.join(out, "flow.csv"), encoding="utf-8") as file:
            energy = [float(row["kinetic_energy"]) for row in csv.DictReader(file)]
        # The last steps are shortened to hit the end, which the energy feels by 1e-5.
        change = abs(energy[-2] / energy[-3] - 1)
        if change > 1e-5:
            failures.append(f"N = {n} is not steady: {change:.1e}")
        s, u, v = profiles(out, n)
        ours = [extreme(s, u, False), extreme(s, v, False), extreme(s, v, True)]
        theirs = [extreme(s_ref, u_ref, False), extreme(s_ref, v_ref, False),
                  extreme(s_ref, v_ref, True)]
        off = [a / b - 1 for a, b in zip(ours, theirs)]
        error = np.sqrt(np.mean(np.square(np.interp(s_ref, s, u) - u_ref)[2:-2]) +
                        np.mean(np.square(np.interp(s_ref, s, v) - v_ref)[2:-2]))
        errors.append((n, error))
        print(f"Re {re} N {n}: u_min {ours[0]:.6f} ({100 * off[0]:+.3f} %), v_min {ours[1]:.6f} "
              f"({100 * off[1]:+.3f} %), v_max {ours[2]:.6f} ({100 * off[2]:+.3f} %), profiles "
              f"{error:.3e}, change of energy {change:.1e}", flush=True)
        if re == "100" and n == 128 and max(map(abs, off)) > 3e-3:
            failures.append("an extreme is off by more than 0.3 %")
    if len(errors) > 1:
        (n1, e1), (n2, e2) = errors[-2:]
        order = np.log(e1 / e2) / np.log(n2 / n1)
        print(f"order {order:.2f}")
        if order < 1.8:
            failures.append(f"order {order:.2f} is below 1.8")
    print("\n".join(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
