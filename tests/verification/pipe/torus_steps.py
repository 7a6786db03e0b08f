#!/usr/bin/python3
"""The soft torus in the periodic pipe with long and with short time steps.

    torus_steps.py DRIVER CASE FOLDER MESH ...

Runs to t = 10 at Courant numbers 0.5 and 0.1. At t = 2, 4, 6, 8 and 10 they must be at the same angle to 0.25 degrees,
and at the same place to 0.15 % of the pipe's diameter: the largest difference at these times, as the root mean square
over the meshes, since that of one mesh is partly chance. The first may take two fifths of the steps of the second at
most: the elastic limit makes them shorter than its Courant number allows.
"""
import csv
import json
import os
import subprocess
import sys


def run(driver, case, mesh, folder, courant):
    out = os.path.join(folder, f"torus_{courant}_{os.path.splitext(os.path.basename(mesh))[0]}")
    subprocess.run([driver, case, "-mesh", mesh, "-output_dir", out, "-output_interval", "0",
                    "-sample_interval", "0.1", "-time_courant", courant], check=True,
                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    with open(os.path.join(out, "solid.csv"), encoding="utf-8") as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    print(f"Co {courant}: {summary['steps']} steps, {summary['rejected_steps']} rejected, "
          f"{summary['us_per_cell_step']:.2f} us a cell and step")
    return rows, summary


def compare(driver, case, folder, mesh):
    """The largest differences of place and of angle, and whether the run was as it must be otherwise."""
    (long, few), (short, many) = [run(driver, case, mesh, folder, courant) for courant in ("0.5", "0.1")]
    at = {round(row["t"], 6): row for row in short}
    worst, times = {}, []
    for row in long:
        other = at.get(round(row["t"], 6))
        if other is None or round(row["t"], 6) not in (2, 4, 6, 8, 10):
            continue
        times.append(round(row["t"], 6))
        apart = {name: abs(row[name] - other[name]) for name in ("x", "y", "z", "angle")}
        print(f"t = {row['t']:g}: x {row['x']:.4f} {other['x']:.4f}, y {row['y']:.4f} {other['y']:.4f}, "
              f"angle {row['angle']:.2f} {other['angle']:.2f}, apart " +
              ", ".join(f"{name} {value:.5f}" for name, value in apart.items()))
        worst = {name: max(value, worst.get(name, 0)) for name, value in apart.items()}
    sound = times == [2, 4, 6, 8, 10] and min(few["t"], many["t"]) > 10 - 1e-9
    return max(worst["x"], worst["y"], worst["z"]), worst["angle"], sound and 5 * few["steps"] <= 2 * many["steps"]


def main():
    driver, case, folder, *meshes = sys.argv[1:]
    places, angles, sound = zip(*(compare(driver, case, folder, mesh) for mesh in meshes))
    mean = (sum(place**2 for place in places) / len(places)) ** 0.5
    print(f"root mean square of the largest differences of place {mean:.5f}")
    checks = {"all run to t = 10, with two fifths of the steps": all(sound),
              "they are at the same place": mean <= 1.5e-3,
              "and at the same angle": max(angles) <= 0.25}
    for sentence, holds in checks.items():
        print("ok  " if holds else "FAIL", sentence)
    return 0 if all(checks.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
