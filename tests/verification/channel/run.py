#!/usr/bin/python3
"""The driving gradient of plane Poiseuille flow on triangles against the exact one.

    run.py DRIVER MESHES FOLDER N [N ...]

Runs a channel of height 1 at mean velocity 0.5, viscosity 0.1, on MESHESN.msh until it is steady. The
gradient must come within 6e-3 (N / 12)^-2 of 12 mu U = 0.6, at an order of 1.7.
"""
import csv
import os
import subprocess
import sys

import numpy as np


def main():
    driver, meshes, folder = sys.argv[1:4]
    failures, errors = [], []
    for n in map(int, sys.argv[4:]):
        out = os.path.join(folder, f"channel{n}")
        subprocess.run([driver, "-mesh", f"{meshes}{n}.msh", "-mesh_periodic", "inlet,outlet",
                        "-solid_shape", "none", "-flow_mean_velocity", "0.5", "-fluid_viscosity", "0.1",
                        "-fluid_density", "1", "-time_end", "6", "-output_interval", "0",
                        "-output_dir", out],
                       check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        with open(os.path.join(out, "flow.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        error = abs(float(rows[-1]["pressure_gradient"]) / 0.6 - 1)
        limit = 6e-3 * (12 / n) ** 2
        print(f"n {n}: gradient off by {error:.2e} (limit {limit:.2e})", flush=True)
        errors.append((n, error))
        if not error <= limit:
            failures.append(f"n = {n}: the gradient is off by {error:.2e}")
    (n_1, e_1), (n_2, e_2) = errors[0], errors[-1]
    order = np.log(e_1 / e_2) / np.log(n_2 / n_1)
    print(f"order {order:.2f}")
    if not order >= 1.7:
        failures.append(f"the order {order:.2f} is too low")
    print("\n".join(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
