#!/usr/bin/python3
"""A sphere wider than the throat of a stenosis is pressed into it and through it.

    throat.py FSI_STENOSIS CASE MESH FOLDER

The sphere (radius 0.307, throat of radius 0.25, 12 cells per diameter) touches the wall all around, with less than a
cell of fluid between. A map that is carried into the wall, where the fluxes bring nothing, makes it stick at x = 2.9.
At t = 3.3 it is beyond the narrowest place, x = 3, whole, and stress and shape tell the same energy within 10 %.
"""
import csv
import subprocess
import sys


def main():
    driver, case, mesh, folder = sys.argv[1:]
    subprocess.run([driver, case, "-mesh", mesh, "-output_dir", folder, "-time_end", "3.3", "-output_interval", "0",
                    "-checkpoint_interval", "0", "-solid_shape", "sphere", "-solid_radius", "0.307"],
                   check=True, stdout=subprocess.DEVNULL)
    with open(f"{folder}/solid.csv", encoding="utf-8") as file:
        rows = [{k: float(v) for k, v in row.items() if v} for row in csv.DictReader(file)]
    end = rows[-1]
    for row in rows[:: len(rows) // 6] + [end]:
        print(", ".join(f"{k} {row[k]:.4g}" for k in ("t", "x", "ux", "elastic_energy", "shape_energy", "min_eig_B")))
    assert end["x"] > 3.1 and end["ux"] > 0.5
    assert end["pieces"] == 1 and end["min_eig_B"] > 0.2
    assert abs(end["volume"] / rows[0]["volume"] - 1) < 1e-12
    assert abs(end["shape_energy"] / end["elastic_energy"] - 1) < 0.1


if __name__ == "__main__":
    main()
