#!/usr/bin/python3
"""A run that is asked to end saves its state and says so by exit code 5.

    signals.py SOURCE DRIVERS FOLDER [MPIEXEC...]

SIGINT, SIGTERM, SIGHUP and SIGUSR2 to a driver; the same to fsi-mpiexec, and SIGUSR2 to mpiexec, on two ranks.
After SIGUSR1 the run goes on; the checkpoint serves to go on from.
"""
import glob
import json
import os
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


def rows(out):
    try:
        with open(os.path.join(out, "flow.csv"), encoding="utf-8") as file:
            return len(file.readlines()) - 1
    except OSError:
        return 0


def summary(out):
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def checkpoints(out):
    return glob.glob(os.path.join(out, "checkpoint_*.h5"))


def interrupt(launcher, case, out, number, environment):
    """Starts a run, sends it the signal once it steps, and waits; its exit code."""
    shutil.rmtree(out, ignore_errors=True)
    with subprocess.Popen([*launcher, *case, "-output_dir", out], stdin=subprocess.DEVNULL,
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment,
                          start_new_session=True) as run:
        while run.poll() is None and rows(out) < 3:
            time.sleep(0.01)
        if number == signal.SIGUSR1:
            run.send_signal(number)
            while run.poll() is None and not checkpoints(out):
                time.sleep(0.01)
            check(run.poll() is None, "after SIGUSR1 and its checkpoint the run goes on")
            number = signal.SIGUSR2
        run.send_signal(number)
        return run.wait(60)


def main():
    source, drivers, folder, *mpiexec = sys.argv[1:]
    signal.signal(signal.SIGHUP, signal.SIG_DFL)  # under nohup it is ignored, and the drivers keep that
    out, mesh = os.path.join(folder, "signals"), os.path.join(folder, "signals.msh")
    os.makedirs(folder, exist_ok=True)
    subprocess.run(["gmsh", "-2", os.path.join(source, "meshes", "cavity.geo"), "-setnumber", "n",
                    "16", "-o", mesh], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL)
    case = [os.path.join(drivers, "fsi-cavity"),
            os.path.join(source, "examples", "cavity_disc.yaml"), "-mesh", mesh,
            "-time_end", "1000", "-output_interval", "0"]
    environment = dict(os.environ, MPIEXEC=mpiexec[0])
    wrapped = [os.path.join(drivers, "fsi-mpiexec"), *mpiexec[1:], "2"]
    asked = {"fsi-cavity": ([], (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR2)),
             "mpiexec": ([*mpiexec, "2"], (signal.SIGUSR2,)),
             "fsi-mpiexec": (wrapped, (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1))}
    for name, (launcher, signals) in asked.items():
        for number in signals:
            code = interrupt(launcher, case, out, number, environment)
            what = f"{signal.Signals(number).name} to {name}"
            check(code == 5, f"{what}: exit code {code}")
            check(summary(out)["status"] == "interrupted", f"{what}: interrupted")
            check(bool(checkpoints(out)), f"{what}: a checkpoint")
    last = [word if word != "1000" else str(summary(out)["t"] + 0.1) for word in case]
    done = subprocess.run([*wrapped, *last, "-output_dir", out, "-restart"], env=environment,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True)
    check(done.returncode == 0 and summary(out)["status"] == "complete",
          f"gone on with to its end: exit code {done.returncode} {done.stderr}")
    short = [word if word != "1000" else "0.1" for word in case]
    with open("/dev/full", "w", encoding="utf-8") as full:
        said = subprocess.run([*short, "-output_dir", out], stdin=subprocess.DEVNULL, stdout=full,
                              stderr=subprocess.PIPE, text=True, check=False)
    check(said.returncode == 4 and "standard output" in said.stderr,
          f"a full standard output is told: exit code {said.returncode} {said.stderr}")
    with subprocess.Popen([*short, "-output_dir", out], stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as run:
        run.stdout.close()
        code = run.wait(60)
        check(code == 0 and summary(out)["status"] == "complete", f"who reads the output may leave: exit code {code}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
