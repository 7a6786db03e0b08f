#!/usr/bin/python3
"""An ellipsoid that lodges in a round throat stays at rest: rest.py DRIVER CASE MESH FOLDER.

From t = 30 to 45 the centroid moves by less than 0.005 and the elastic energy changes by less than a tenth, and the run
warns of nothing. CASE is that of the sphere.
"""
import csv
import os
import subprocess
import sys


def main():
    driver, case, mesh, folder = sys.argv[1:5]
    out = os.path.join(folder, "out-ellipsoid")
    with open(case, encoding="utf-8") as file:
        lines = [line for line in file if "radius:" not in line]
    ellipsoid = os.path.join(folder, "ellipsoid.yaml")
    with open(ellipsoid, "w", encoding="utf-8") as file:
        file.writelines(lines)
    said = subprocess.run([driver, ellipsoid, "-mesh", mesh, "-solid_shape", "ellipsoid", "-solid_semi_axes",
                           "0.5,0.33,0.33", "-time_end", "45", "-output_dir", out],
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    with open(os.path.join(out, "solid.csv"), newline="", encoding="utf-8") as file:
        rows = [{name: float(row[name]) for name in ("t", "x", "elastic_energy", "shape_energy")}
                for row in csv.DictReader(file)]
    rest = next(row for row in rows if row["t"] >= 30)
    end = rows[-1]
    for row in (rest, end):
        print(", ".join(f"{name} {value:.4f}" for name, value in row.items()))
    warnings = [line for line in said.stderr.splitlines() if "warning" in line]
    print("\n".join(warnings))
    still = abs(end["x"] - rest["x"]) < 0.005
    steady = abs(end["elastic_energy"] - rest["elastic_energy"]) < 0.1 * rest["elastic_energy"]
    complete = said.returncode == 0 and end["t"] > 44.99
    print("ok" if still and steady and complete and not warnings else "FAIL")
    return 0 if still and steady and complete and not warnings else 1


if __name__ == "__main__":
    sys.exit(main())
