#!/usr/bin/python3
"""The soft torus in the periodic pipe on prisms, whose triangles lie in the section.

    torus_prisms.py DRIVER CASE MESH FOLDER

Runs to t = 10. The strain must stay that of an elastic ring: smallest eigenvalue of B at least 0.9, elastic
energy at most 1e-3 after the start, no step taken back.
"""
import csv
import json
import os
import subprocess
import sys


def table(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def main():
    driver, case, mesh, folder = sys.argv[1:]
    out = os.path.join(folder, "torus_prisms")
    subprocess.run([driver, case, "-mesh", mesh, "-output_dir", out, "-output_interval", "0",
                    "-sample_interval", "0.25"], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL)
    solid, flow = table(out, "solid.csv"), table(out, "flow.csv")
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        rejected = json.load(file)["rejected_steps"]
    smallest = min(row["min_eig_B"] for row in solid)
    energy = max(row["elastic_energy"] for row in flow if row["t"] > 0.2)
    print(f"torus on prisms to t = {solid[-1]['t']:g}: smallest eigenvalue of B {smallest:.3f}, largest "
          f"elastic energy {energy:.1e}, {rejected:g} steps taken back")
    good = solid[-1]["t"] > 10 - 1e-9 and smallest >= 0.9 and energy <= 1e-3 and rejected == 0
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
