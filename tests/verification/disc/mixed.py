#!/usr/bin/python3
"""The soft disc in the cavity on quads of which some are divided into two triangles.

    mixed.py DRIVER CASE MESH FOLDER DATA [KIND...]

KIND: none, one, all, some or half of the quads divided; not given: each. MESH: 64 x 64 quads. Divided are one quad, a twentieth of all, the right half, and all. By the L2 norm over
time of the distance of the centroid from the reference, one divided quad leaves the answer within 1 %
of that on quads. With a twentieth or a half it is at most a fifth above the larger of the errors of quads and
of triangles (measured: below it, and 15 % above). The area stays.
"""
import csv
import os
import subprocess
import sys

import numpy as np

MIDDLE = 64 * 64 // 2 + 32
DIVIDED = {"none": lambda i, x: False, "one": lambda i, x: i == MIDDLE,
           "all": lambda i, x: True, "some": lambda i, x: i * 7919 % 20 == 0, "half": lambda i, x: x > 0.5}
OF_QUADS = {"none": 1.0, "one": 1.01}
OF_BOTH = {"some": 1.2, "half": 1.2}


def columns(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return {name: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}


def divide(lines, which):
    """The lines of an ascii gmsh 2.2 file with the quads of which(number, x of the middle) divided."""
    start = lines.index("$Nodes")
    nodes = (line.split() for line in lines[start + 2:start + 2 + int(lines[start + 1])])
    x = {node[0]: float(node[1]) for node in nodes}
    start = lines.index("$Elements")
    count, quads, elements = int(lines[start + 1]), 0, []
    for line in lines[start + 2:start + 2 + count]:
        _, kind, tags, *rest = line.split()
        head, v = rest[:int(tags)], rest[int(tags):]
        parts = [(kind, v)]
        if kind == "3":
            if which(quads, sum(x[k] for k in v) / 4):
                v = v[1:] + v[:1] if quads % 2 else v
                parts = [("2", v[:3]), ("2", [v[0], v[2], v[3]])]
            quads += 1
        elements += [(one, tags, *head, *corners) for one, corners in parts]
    numbered = [" ".join((str(i + 1), *element)) for i, element in enumerate(elements)]
    return lines[:start + 1] + [str(len(numbered))] + numbered + lines[start + 2 + count:]


def run(driver, case, mesh, out, data):
    """The error on one mesh, and the relative change of area."""
    subprocess.run([driver, case, "-mesh", mesh, "-output_dir", out, "-time_end", "8.2", "-output_interval",
                    "0", "-sample_interval", "0.02"], check=True, stdout=subprocess.DEVNULL)
    reference = columns(os.path.join(data, "softdisc_reference_G0.1.csv"))
    solid = columns(os.path.join(out, "solid.csv"))
    t = reference["t"][reference["t"] <= 8.2]
    away = [np.interp(t, solid["t"], solid[a]) - reference[f"{a}c_ref"][:len(t)] for a in "xy"]
    return np.sqrt(np.mean(np.square(away).sum(0))), np.abs(solid["volume"] / solid["volume"][0] - 1).max()


def main():
    driver, case, mesh, folder, data, *kinds = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    ascii_mesh = os.path.join(folder, "mixed-none.msh")
    subprocess.run(["gmsh", mesh, "-0", "-format", "msh2", "-setnumber", "Mesh.Binary", "0", "-o",
                    ascii_mesh], check=True,
                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    with open(ascii_mesh, encoding="utf-8") as file:
        lines = file.read().splitlines()
    bad, errors = [], {}
    for name in kinds or DIVIDED:
        path = os.path.join(folder, f"mixed-{name}.msh")
        with open(path, "w", encoding="utf-8") as file:
            file.write("\n".join(divide(lines, DIVIDED[name])) + "\n")
        errors[name], drift = run(driver, case, path, os.path.join(folder, f"out-mixed-{name}"), data)
        print(f"divided: {name}: L2 {errors[name]:.3e}, area {drift:.1e}", flush=True)
        limit = (OF_QUADS[name] * errors["none"] if name in OF_QUADS else
                 OF_BOTH.get(name, np.inf) * max(errors["none"], errors.get("all", 0)))
        if not errors[name] <= limit or not drift <= 1e-12:
            bad.append(f"{name} of the quads divided: {errors[name]:.2e}, at most {limit:.2e} is allowed")
    return "; ".join(bad) or 0


if __name__ == "__main__":
    sys.exit(main())
