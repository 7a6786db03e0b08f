#!/usr/bin/python3
"""A soft body lodges in a throat, against finite elements (contact.py, reference.csv, of a sphere reference_sphere.csv).

    run.py DRIVER CASE MESHES FOLDER END NAME:PRESSURE:LIMIT[:PART]...

For each mesh NAME and inlet PRESSURE the body is at rest at t = END: its speed is below 5e-3. Its centroid is within
LIMIT of the reference, if that has an equilibrium with this pressure. The energies of strain and shape differ by less
than PART of the first, where it is given. LIMIT "passes": the body has left the throat. A
case sphere.yaml has half of a sphere: its energies are those of both halves here.
"""
import csv
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
STILL = 5e-3


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def reference(file, pressure):
    """x of the centroid and elastic energy with that pressure on the stable part of the curve; None: too much."""
    curve = table(os.path.join(HERE, file))
    for a, b in zip(curve, curve[1:]):
        if a["pressure"] <= pressure < b["pressure"]:
            s = (pressure - a["pressure"]) / (b["pressure"] - a["pressure"])
            return tuple((1 - s) * a[k] + s * b[k] for k in ("x", "elastic_energy"))
    return None


def main():
    driver, case, meshes, folder, end, *scenes = sys.argv[1:]
    bad, sphere = [], os.path.basename(case) == "sphere.yaml"
    file, behind, halves = ("reference_sphere.csv", 3.5, 2) if sphere else ("reference.csv", 2.5, 1)
    for scene in scenes:
        name, pressure, limit, *part = scene.split(":")
        out = os.path.join(folder, f"out-{name}-{pressure}")
        said = subprocess.run([driver, case, "-mesh", os.path.join(meshes, f"{name}.msh"), "-patches_inlet_pressure",
                               pressure, "-time_end", end, "-sample_interval", "0.5", "-output_interval", "0",
                               "-output_dir", out], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              text=True).stderr
        last = table(os.path.join(out, "solid.csv"))[-1]
        there = reference(file, float(pressure))
        print(f"{name}, p {pressure}: t {last['t']:g}, x {last['x']:.4f}, ux {last['ux']:.1e}, elastic_energy "
              f"{halves * last['elastic_energy']:.4f}, shape_energy {halves * last['shape_energy']:.4f}; reference "
              + (f"{there[0]:.4f}, {there[1]:.4f}" if there else "passes"), flush=True)
        print(said, end="")
        if limit == "passes":
            if last["x"] < behind:
                bad.append(f"{scene}: it is held")
        elif abs(last["ux"]) > STILL or (there and abs(last["x"] - there[0]) > float(limit)):
            bad.append(f"{scene}: it is not at rest near the reference")
        elif part and abs(last["shape_energy"] / last["elastic_energy"] - 1) > float(part[0]):
            bad.append(f"{scene}: strain and shape do not agree")
    return "; ".join(bad) or 0


if __name__ == "__main__":
    sys.exit(main())
