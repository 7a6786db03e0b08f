#!/usr/bin/python3
"""A run begins with the flow of another one, which has no solid, and at its time.

    flow_from.py SOURCE DRIVERS FOLDER

An empty bend goes on by -flow_from as it does by -restart, bit for bit. A sphere put into its flow has
its first row at that time, and -restart then needs the other folder no more. What differs in fluid and
patches is told, what differs in the solid is not. Folders without such a flow are refused, and so is the
run's own, whose files would be removed.
"""
import csv
import os
import shutil
import subprocess
import sys

failures = []


def check(holds, sentence):
    print("ok  " if holds else "FAIL", sentence)
    if not holds:
        failures.append(sentence)


def rows(folder, table):
    with open(os.path.join(folder, table), encoding="utf-8") as file:
        return list(csv.DictReader(file))


def main():
    source, drivers, folder = sys.argv[1:4]
    folder = os.path.join(folder, "flow_from")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    mesh = os.path.join(folder, "bend.msh")
    subprocess.run(["gmsh", "-3", os.path.join(source, "meshes", "bend.geo"), "-setnumber", "n", "6", "-bin",
                    "-o", mesh], check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    vessel = [os.path.join(drivers, "fsi-vessel"), os.path.join(folder, "fluid.yaml"), "-mesh", mesh,
              "-patches_inlet_type", "flow_rate", "-patches_inlet_flow_rate", "0.7", "-patches_outlet_type",
              "pressure", "-checkpoint_interval", "0.1"]
    with open(vessel[1], "w", encoding="utf-8") as file:
        file.write("fluid:\n  viscosity: 0.02\n")
    sphere = ["-solid_shape", "sphere", "-solid_radius", "0.25", "-solid_shear_modulus", "2", "-solid_viscosity",
              "0.02", "-solid_path", "inlet,outlet", "-solid_arc_length", "0.6"]
    empty, whole, two, ball = (os.path.join(folder, name) for name in ("empty", "whole", "two", "ball"))

    def run(out, end, *words, code=0):
        done = subprocess.run([*vessel, "-output_dir", out, "-time_end", end, *words], text=True,
                              stdin=subprocess.DEVNULL, capture_output=True)
        check(done.returncode == code, f"exit code {done.returncode} of {words}")
        return [line for line in done.stderr.splitlines() if "warning" not in line], done.stdout

    run(empty, "0.2")
    shutil.copytree(empty, whole)
    run(whole, "0.3", "-restart")
    errors, said = run(two, "0.3", "-flow_from", empty)
    check(errors == [] and "the flow is that of" in said and "of them in this run" in said, "no notice")
    a, b = rows(whole, "flow.csv")[-1], rows(two, "flow.csv")[-1]
    check(all(a[name] == b[name] for name in ("t", "dt", "pressure_drop", "flow_rate", "kinetic_energy")),
          "the flow goes on as after a restart")
    errors, _ = run(ball, "0.25", "-flow_from", empty, *sphere, "-fluid_viscosity", "0.021")
    check(len(errors) == 1 and "-fluid_viscosity 0.021 (was 0.02)" in errors[0] and errors[0].count("(was") == 1,
          f"a notice of the viscosity alone: {errors}")
    check(float(rows(ball, "solid.csv")[0]["t"]) == 0.2, "the sphere is there from t = 0.2 on")
    os.rename(empty, empty + "_away")
    run(ball, "0.26", "-flow_from", empty, *sphere, "-restart")
    check(float(rows(ball, "solid.csv")[-1]["t"]) == 0.26, "a restart needs the other folder no more")
    with open(os.path.join(ball, "run.yaml"), encoding="utf-8") as file:
        check('restart: "false"' in file.read(), "run.yaml repeats a run from its start")
    errors, _ = run(ball, "0.27", *sphere[:-1], "0.7", "-restart", code=2)
    check(len(errors) == 1 and "-solid_arc_length 0.7 (was 0.6)" in errors[0], f"another place is refused: {errors}")
    errors, _ = run(whole, "1", "-flow_from", whole, code=2)
    check(len(errors) == 1 and "is -output_dir" in errors[0] and os.path.exists(os.path.join(whole, "flow.csv")),
          f"a run does not remove the flow that it begins with: {errors}")
    run(whole, "0.31", "-restart")
    for of, end, sentence in ((empty, "1", "there is no checkpoint"), (ball, "1", "is of another run"),
                              (empty + "_away", "0.2", "is not behind it")):
        errors, _ = run(two, end, "-flow_from", of, *sphere, code=2)
        check(len(errors) == 1 and sentence in errors[0], f"refused: {errors}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
