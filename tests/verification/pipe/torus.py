#!/usr/bin/python3
"""A soft torus, tilted by 45 degrees, in the periodic pipe at Re = 50, G* = 10.

    torus.py DRIVER CASE MESH FOLDER

Runs to t = 10 and checks what the flow must do with it: it reaches the end, keeps its volume to 1e-12
and the mean velocity 0.5 to 1e-10 in every row, waits about two units of time, then turns towards the
flow (its axis away from the pipe's) without turning back.
"""
import csv
import json
import os
import subprocess
import sys


def columns(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def main():
    driver, case, mesh, folder = sys.argv[1:5]
    out = os.path.join(folder, "torus")
    subprocess.run([driver, case, "-mesh", mesh, "-output_dir", out, "-output_interval", "2",
                    "-sample_interval", "0.05"], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL)
    solid, flow = (columns(os.path.join(out, name)) for name in ("solid.csv", "flow.csv"))
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    drift = max(abs(v / solid["volume"][0] - 1) for v in solid["volume"])
    mean = max(abs(u - 0.5) for u in flow["mean_velocity"])
    angle = solid["angle"]
    waiting = next(t for t, a in zip(solid["t"], angle) if abs(a - angle[0]) > 2)
    back = max(a - b for a, b in zip(angle, angle[1:]))
    print(f"t = {solid['t'][-1]:g}, {summary['cells']} cells, {summary['steps']} steps, "
          f"{summary['rejected_steps']} rejected, {summary['us_per_cell_step']:.2f} us a cell and step")
    print(f"volume {drift:.1e}, mean velocity {mean:.1e}, angle {angle[0]:.2f} to {angle[-1]:.2f}, "
          f"2 degrees at t = {waiting:.2f}, largest step back {back:.3f} degrees")
    checks = {"runs to the end": abs(solid["t"][-1] - 10) < 1e-9, "keeps its volume": drift <= 1e-12,
              "the mean velocity is held": mean <= 1e-10, "turns to the flow": angle[-1] > 70,
              "waits first": 1.5 <= waiting <= 3, "does not turn back": back < 0.5}
    for sentence, holds in checks.items():
        print("ok  " if holds else "FAIL", sentence)
    return 0 if all(checks.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
