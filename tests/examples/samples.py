#!/usr/bin/python3
"""Rows of the csv files at -sample_interval cost no step.

    samples.py SOURCE DRIVERS FOLDER

The soft disc in the cavity and the vortex: with rows at an interval and with rows after every step a
run takes the same steps; the times are the multiples of the interval, and what tells of the flow is
what lies between the rows of the steps around, linear in time.
"""
import bisect
import csv
import json
import os
import shutil
import subprocess
import sys

failures = []


def check(holds, sentence):
    print("ok  " if holds else "FAIL", sentence)
    if not holds:
        failures.append(sentence)


def table(out, name):
    with open(os.path.join(out, name + ".csv"), encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


def steps(out):
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    return summary["steps"], summary["limits"].get("event", 0)


def between(t, column, at):
    i = min(max(bisect.bisect_left(t, at * (1 - 1e-12)), 1), len(t) - 1)
    part = (at - t[i - 1]) / (t[i] - t[i - 1])
    return (1 - part) * column[i - 1] + part * column[i]


def compare(command, out, interval, end, columns):
    """Rows at an interval against rows after every step."""
    command = [*command, "-time_end", str(end), "-output_interval", "0"]
    name = os.path.basename(out)
    for words, kind in (["-sample_interval", str(interval)], "sampled"), ([], "each"):
        subprocess.run([*command, *words, "-output_dir", f"{out}-{kind}"], check=True,
                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    sampled, each = steps(out + "-sampled"), steps(out + "-each")
    check(sampled == each, f"{name}: as many steps, and steps to hit something, with rows at an "
          f"interval as with a row a step: {sampled}, {each}")
    for file, names in columns.items():
        rows, all_rows = table(out + "-sampled", file), table(out + "-each", file)
        first = 0 if file == "solid" else 1
        count = round(end / interval) + 1
        check(rows["t"] == [k * interval for k in range(first, count)],
              f"{name}: {file}.csv has a row at every multiple of {interval}")
        for column in names:
            size = max(map(abs, all_rows[column]))
            apart = max(abs(value - between(all_rows["t"], all_rows[column], t))
                        for t, value in zip(rows["t"], rows[column]) if t >= all_rows["t"][0])
            check(apart <= 1e-12 * size, f"{name}: {file}.csv {column} is what lies between the "
                  f"rows of the steps: {apart:.1e} of {size:.1e}")


def main():
    source, drivers, folder = sys.argv[1:4]
    folder = os.path.join(folder, "samples")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    mesh = os.path.join(folder, "mesh.msh")
    subprocess.run(["gmsh", "-2", os.path.join(source, "meshes", "cavity.geo"), "-setnumber", "n",
                    "24", "-o", mesh], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL)

    def command(driver, case):
        return [os.path.join(drivers, driver), os.path.join(source, "examples", case + ".yaml"),
                "-mesh", mesh]

    disc = command("fsi-cavity", "cavity_disc")
    flow = ["pressure_span", "kinetic_energy"]
    compare(disc, os.path.join(folder, "disc"), 0.02, 1,
            {"flow": flow, "solid": ["x", "y", "ux", "uy", "volume", "taylor", "min_eig_B"]})
    compare(disc, os.path.join(folder, "disc_seldom"), 0.5, 2, {"flow": flow, "solid": ["x", "y"]})
    compare(command("fsi-advect", "vortex"), os.path.join(folder, "vortex"), 0.1, 1,
            {"solid": ["x", "y", "volume", "difference"]})
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
