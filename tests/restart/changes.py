#!/usr/bin/python3
"""Going on from a checkpoint with other options: one notice names each that tells of flow or solid and
changed; another kinematics and another shape are refused.

    changes.py SOURCE DRIVERS FOLDER
"""
import os
import shutil
import subprocess
import sys

failures = []


def check(holds, sentence):
    print("ok  " if holds else "FAIL", sentence)
    if not holds:
        failures.append(sentence)


def main():
    source, drivers, folder = sys.argv[1:4]
    out, mesh = (os.path.join(folder, name) for name in ("changes", "changes.msh"))
    shutil.rmtree(out, ignore_errors=True)
    os.makedirs(folder, exist_ok=True)
    subprocess.run(["gmsh", "-2", os.path.join(source, "meshes", "cavity.geo"), "-setnumber", "n",
                    "16", "-o", mesh], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL)
    end = 0.0

    def go_on(*options, code=0, restart=True, to=None):
        """One more piece of the run; the lines on standard error."""
        nonlocal end
        end += 0.1
        done = subprocess.run(
            [os.path.join(drivers, "fsi-cavity"), os.path.join(source, "examples",
                                                               "cavity_disc.yaml"),
             "-mesh", mesh, "-output_dir", out, "-output_interval", "0", "-checkpoint_interval", "1",
             "-time_end", str(to or end), *(["-restart"] if restart else []), *options],
            stdin=subprocess.DEVNULL, capture_output=True, text=True)
        check(done.returncode == code, f"exit code {done.returncode} with {options}")
        return done.stderr.splitlines()

    def check_notice(lines, *parts):
        check(len(lines) == 1 and lines[0].startswith("fsi: notice: ") and
              all(part in lines[0] for part in parts), f"one notice: {lines}")
        check(lines[0].count("(was ") == len(parts), "and no other option in it")

    check(go_on(restart=False) == [], "a new run says nothing")
    check(go_on("-sample_interval", "0.05", "-time_courant", "0.3", "-p_ksp_rtol", "1e-8") == [],
          "nor does one that changed its time steps, output and solver")
    changed = ["-solid_shear_modulus", "1", "-fluid_viscosity", "0.02"]
    check_notice(go_on(*changed), "-solid_shear_modulus 1 (was 0.1)",
                 "-fluid_viscosity 0.02 (was 0.01)")
    check(go_on(*changed) == [], "the next checkpoint knows of the change")
    # The same velocity then has another energy, of which the scheme made nothing.
    check_notice(go_on(*changed, "-fluid_density", "20", "-solid_density", "20"),
                 "-fluid_density 20 (was 1)", "-solid_density 20 (was 1)")
    check_notice(go_on(*changed, "-lid_velocity", "0.5"), "-lid_velocity 0.5 (was 1)",
                 "-fluid_density 1 (was 20)", "-solid_density 1 (was 20)")
    changed += ["-lid_velocity", "0.5"]
    refused = go_on(*changed, "-solid_shape", "cylinder", "-solid_radius", "0.3", code=2)
    refused = [line for line in refused if "cells through its thickness" not in line]
    check(len(refused) == 1 and all(part in refused[0] for part in (
        "-solid_shape cylinder (was sphere)", "-solid_radius 0.3 (was 0.2)",
        "-solid_height 0.2 (was not given)")), f"another shape is refused: {refused}")
    check_notice(go_on(*changed, "-solid_law", "gent", "-solid_law_limit", "20"),
                 "-solid_law gent (was neo_hookean)", "-solid_law_limit 20 (was not given)")
    check_notice(go_on(*changed, "-solid_law", "gent", "-solid_law_limit", "10"),
                 "-solid_law_limit 10 (was 20)")
    refused = go_on(*changed, code=2, to=0.05)
    check(len(refused) == 1 and "option -time_end: 0.05, but the checkpoint" in refused[0],
          f"an end before the checkpoint is refused: {refused}")
    for other in ("left_cauchy_green", "reference_map"):
        refused = go_on(*changed, "-solid_kinematics", other, code=2)
        check(len(refused) == 1 and "kinematics=log_conformation" in refused[0] and
              f"kinematics={other}" in refused[0], f"refused: {refused}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
