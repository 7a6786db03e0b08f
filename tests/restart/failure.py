#!/usr/bin/python3
"""A run that cannot go on ends with exit code 3, its reason, and a checkpoint of the last good step.

    failure.py SOURCE DRIVERS FOLDER

The pressure solver is given too few iterations: after a start from rest with a step that needs none,
every step fails. With enough iterations the run goes on from the checkpoint. A run out of wall time
ends with exit code 5 and a checkpoint.
"""
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


def run(command):
    return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)


def summary(out):
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def main():
    source, drivers, folder = sys.argv[1:4]
    out = os.path.join(folder, "failure")
    shutil.rmtree(out, ignore_errors=True)
    os.makedirs(out)
    mesh = os.path.join(folder, "failure.msh")
    subprocess.run(["gmsh", "-2", os.path.join(source, "meshes", "cavity.geo"), "-setnumber", "n",
                    "24", "-o", mesh], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL)
    command = [os.path.join(drivers, "fsi-cavity"),
               os.path.join(source, "examples", "cavity_disc.yaml"), "-mesh", mesh,
               "-output_dir", out]
    failed = run([*command, "-time_end", "1", "-p_pc_type", "none", "-p_ksp_max_it", "2"])
    check(failed.returncode == 3, f"exit code 3 ({failed.returncode})")
    check('system "p" did not converge' in failed.stderr, "the reason is told: " + failed.stderr)
    state = summary(out)
    check(state["status"] == "failed" and state["rejected_steps"] == 9, "nine tries, then failed")
    check("did not converge" in state["message"], "the reason is in summary.json")
    for file in ("flow.csv", "solid.csv"):
        with open(os.path.join(out, file), encoding="utf-8") as table:
            check("nan" not in table.read().lower(), f"{file} holds numbers only")
    command += ["-checkpoint_interval", "0.25"]
    resumed = run([*command, "-time_end", "0.5", "-restart"])
    check(resumed.returncode == 0, "its checkpoint serves to go on " + resumed.stderr)
    check(summary(out)["status"] == "complete", "to the end")
    check(summary(out)["rejected_steps"] == 9, "the rejected steps are remembered")
    kept = [name for name in sorted(os.listdir(out)) if name.startswith("checkpoint_")]
    again = run([*command, "-time_end", "0.5", "-restart"])
    with open(os.path.join(out, "fields.hdf.series"), encoding="utf-8") as file:
        times = [entry["time"] for entry in json.load(file)["files"]]
    check(again.returncode == 0 and len(set(times)) == len(times),
          f"gone on with at its end it lists every time once: {times}")
    check(kept == [name for name in sorted(os.listdir(out)) if name.startswith("checkpoint_")],
          f"and its two checkpoints, of different times, stay: {kept}")

    stopped = run([*command, "-time_end", "1000", "-output_interval", "0", "-max_wall_time", "1"])
    check(stopped.returncode == 5, f"out of time: exit code 5 ({stopped.returncode})")
    check(summary(out)["status"] == "interrupted", "interrupted")
    check(any(name.startswith("checkpoint_") for name in os.listdir(out)), "with a checkpoint")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
