#!/usr/bin/python3
"""A run that cannot go on ends with exit code 3, its reason, and a checkpoint of the last good step.

    failure.py SOURCE DRIVERS FOLDER

The pressure solver is given too few iterations: after a start from rest with a step that needs none,
every step fails. With enough iterations the run goes on from the checkpoint. A run out of wall time
ends with exit code 5 and a checkpoint. A file that cannot be written ends a run with exit code 4, the
sentence in summary.json and a checkpoint, as far as there is room for them. Steps that are taken back are counted by reason: a solid that strains too
much, a pressure that leaves too much divergence.
"""
import csv
import glob
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import time

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


def start(command, out, **more):
    """A run that has begun to write."""
    shutil.rmtree(out, ignore_errors=True)
    process = subprocess.Popen([*command, "-output_dir", out], stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **more)
    while process.poll() is None and not os.path.exists(os.path.join(out, "summary.json")):
        time.sleep(0.01)
    return process


def check_file_failure(process, out, word, saved=True):
    said = process.communicate()[1]
    state = summary(out)
    check(process.returncode == 4, f"{word}: exit code 4 ({process.returncode})")
    check(state["status"] == "failed" and word in state["message"],
          f"{word}: summary.json tells it: {state['message']}")
    check(state["message"] in said, f"{word}: standard error tells the same: {said}")
    check(bool(glob.glob(os.path.join(out, "checkpoint_*.h5"))) == saved,
          f"{word}: {'a' if saved else 'no'} checkpoint")


def without_signal():
    """A file that grows too large is then an error, as on a full disk, and no signal."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)


def file_failures(drivers, folder, case):
    """case: a driver's command without its end and output."""
    out = os.path.join(folder, "file_failure")
    endless = [*case, "-time_end", "1000", "-output_interval", "0.2"]

    process = start(endless, out)
    shutil.rmtree(out + "-gone", ignore_errors=True)
    os.rename(out, out + "-gone")
    check_file_failure(process, out, "fields_")
    resumed = run([*case, "-output_dir", out, "-time_end", "1", "-restart"])
    check(resumed.returncode == 0 and summary(out)["status"] == "complete",
          "a run whose directory vanished goes on in a new one: " + resumed.stderr)

    process = start(endless, out)
    os.mkdir(os.path.join(out, "fields_0010.hdf"))
    check_file_failure(process, out, "fields_0010.hdf")
    os.rmdir(os.path.join(out, "fields_0010.hdf"))
    resumed = run([*case, "-output_dir", out, "-time_end", "2.2", "-output_interval", "0.2",
                   "-restart"])
    check(resumed.returncode == 0, "with the obstacle gone it goes on " + resumed.stderr)
    with open(os.path.join(out, "fields.hdf.series"), encoding="utf-8") as file:
        times = [entry["time"] for entry in json.load(file)["files"]]
    check(len(times) == 12, f"no field is missing: {times}")

    # The tables outgrow what is allowed, the checkpoint does not; then it does too.
    for limit, saved in ((250_000, True), (20_000, False)):
        process = start([*case, "-time_end", "1000", "-output_interval", "0", "-time_step", "0.001"],
                        out, restore_signals=False, preexec_fn=without_signal)
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (limit, limit))
        check_file_failure(process, out, ".csv", saved)
        for file in ("flow.csv", "solid.csv"):
            with open(os.path.join(out, file), encoding="utf-8") as table:
                text = table.read()
            check(text.endswith("\n") and len({line.count(",") for line in text.splitlines()}) == 1,
                  f"{file} holds whole rows")
    process = start([*case, "-time_end", "1000", "-output_interval", "0", "-sample_interval", "1000",
                     "-max_wall_time", "1"], out, restore_signals=False, preexec_fn=without_signal)
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (20_000, 20_000))
    check_file_failure(process, out, "interrupted", False)

    process = start([os.path.join(drivers, "fsi-advect"), *case[1:4], "-solid_shape", "sphere",
                     "-solid_center", "0.5,0.75,0", "-solid_radius", "0.15", "-time_end", "8",
                     "-output_interval", "0.02"], out)
    os.rename(out, out + "-moved")
    said = process.communicate()[1]
    check(process.returncode == 4 and "fields_" in said, "fsi-advect: exit code 4 and " + said)
    shutil.rmtree(out + "-moved")


def check_rejections(drivers, source, folder, reason, words):
    """The run is taken back for that reason, goes on, and tells it."""
    mesh, out = os.path.join(folder, "rejected.msh"), os.path.join(folder, "rejected")
    shutil.rmtree(out, ignore_errors=True)
    subprocess.run(["gmsh", "-2", os.path.join(source, "meshes", "cavity.geo"), "-setnumber", "n",
                    "16", "-o", mesh], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL)
    done = run([os.path.join(drivers, "fsi-cavity"),
                os.path.join(source, "examples", "cavity_disc.yaml"), "-mesh", mesh, "-output_dir",
                out, "-output_interval", "0", "-sample_interval", "0", *words])
    state = summary(out)
    check(done.returncode == 0 and state["status"] == "complete", f"{reason}: the run goes on")
    check(list(state["rejections"]) == [reason], f"{reason}: {state['rejections']}")
    check(state["rejections"].get(reason) == state["rejected_steps"] > 0,
          f"{reason}: {state['rejected_steps']} steps are taken back")
    with open(os.path.join(out, "flow.csv"), encoding="utf-8") as table:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(table)]
    back = [b for a, b in zip(rows, rows[1:]) if b["rejected_steps"] > a["rejected_steps"]]
    check(rows[-1]["rejected_steps"] == state["rejected_steps"] and len(back) > 0,
          f"{reason}: flow.csv counts them")
    retry = 7  # doc/theory/time_step.md
    check(all(row["limit"] == retry and row["dt"] < row["dt_limit"] for row in back),
          f"{reason}: flow.csv shows the shorter steps")


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

    # Goes on from there and fails in its first step, where no field file is due.
    failed = run([*command, "-time_end", "1000", "-output_interval", "100", "-restart", "-p_pc_type", "none",
                  "-p_ksp_max_it", "2"])
    state = summary(out)
    with open(os.path.join(out, "fields.hdf.series"), encoding="utf-8") as file:
        last = json.load(file)["files"][-1]
    check(failed.returncode == 3 and state["t"] > 0.5 and last["time"] == state["t"] and
          os.path.exists(os.path.join(out, last["name"])),
          f"the fields of the last good state are there: {last}, t = {state['t']}: {failed.stderr}")

    # A new run in the folder of one that did not end keeps its checkpoint, and none of its tables of solids.
    with open(os.path.join(out, "solid_other.csv"), "w", encoding="utf-8") as table:
        table.write("t,x,y,z,ux,uy,uz,volume\n0,0,0,0,0,0,0,1\n")
    anew = run([*command, "-time_end", "0.02", "-output_interval", "0"])
    kept = [name for name in os.listdir(out) if name.endswith(".before")]
    check(anew.returncode == 0 and len(kept) == 1 and f"is kept as \"{os.path.join(out, kept[0])}" in anew.stderr,
          f"the checkpoint of a run that did not end is kept: {kept}: {anew.stderr}")
    check(not os.path.exists(os.path.join(out, "solid_other.csv")), "tables of a solid that is not there are removed")
    check(".before" not in run([*command, "-time_end", "0.02"]).stderr, "that of one that did is not")

    check_rejections(drivers, source, folder, "the solid strains too much in the step",
                     ["-time_end", "6", "-time_step", "0.075", "-solid_shear_modulus", "0.01",
                      "-solid_center", "0.5,0.65,0", "-solid_radius", "0.3"])
    check_rejections(drivers, source, folder, "the flow is not divergence-free",
                     ["-time_end", "0.3", "-time_step", "0.02", "-p_ksp_type", "cg", "-p_pc_type",
                      "jacobi", "-p_ksp_rtol", "1e-12", "-p_ksp_atol", "1e-3"])
    file_failures(drivers, folder, command[:4])
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
