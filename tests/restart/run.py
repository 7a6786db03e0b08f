#!/usr/bin/python3
"""A run that is killed at five random times and gone on with each time ends as the uncut run does.

    run.py SOURCE DRIVERS FOLDER RANKS [MPIEXEC...]

The soft torus in the pipe and the soft disc in the cavity, the disc with the reference map too, a heavy torus,
a sphere in a vessel between windkessels, and one that leaves the mesh, coarse.
On the same ranks the tables (but for the columns of wall time) and the last checkpoint are equal byte
for byte.
"""
import csv
import glob
import os
import random
import shutil
import signal
import subprocess
import sys
import time

CASES = {
    "torus": ("fsi-pipe", "torus", ["-3", "pipe", "n=8", "length=2"],
              ["-time_end", "0.8", "-checkpoint_interval", "0.05", "-output_interval", "0.2"]),
    "disc": ("fsi-cavity", "cavity_disc", ["-2", "cavity", "n=24"],
             ["-time_end", "8", "-checkpoint_interval", "0.5", "-output_interval", "2"]),
    "map": ("fsi-cavity", "cavity_disc", ["-2", "cavity", "n=24"],
            ["-time_end", "4", "-checkpoint_interval", "0.5", "-output_interval", "2",
             "-solid_kinematics", "reference_map"]),
    "gent": ("fsi-cavity", "cavity_disc", ["-2", "cavity", "n=24"],
             ["-time_end", "4", "-checkpoint_interval", "0.5", "-output_interval", "2",
              "-solid_law", "gent", "-solid_law_limit", "3"]),
    "heavy": ("fsi-pipe", "torus", ["-3", "pipe", "n=8", "length=2"],
              ["-time_end", "0.6", "-checkpoint_interval", "0.05", "-output_interval", "0.2",
               "-gravity", "0,-2,0", "-solid_density", "3"]),
    "vessel": ("fsi-vessel", "bifurcation", ["-3", "bifurcation", "n=6"],
               ["-time_end", "0.8", "-checkpoint_interval", "0.05", "-output_interval", "0.2"]),
    # nothing of the solid is left in the second half
    "leaves": ("fsi-vessel", "bend", ["-3", "bend", "n=5"],
               ["-solid_arc_length", "2.6", "-end_when_empty", "false", "-checkpoint_interval", "0.1"]),
}
# On several ranks each start takes a second: the cases whose state goes across the ranks in another way.
ON_RANKS = ("torus", "disc", "vessel", "leaves")
KILLS = 5


def mesh(source, folder, name, parameters):
    dimension, geometry, *settings = parameters
    target = os.path.join(folder, name + ".msh")
    words = [w for s in settings for w in ("-setnumber", *s.split("="))]
    subprocess.run(["gmsh", dimension, os.path.join(source, "meshes", geometry + ".geo"), *words,
                    "-bin", "-o", target], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL)
    return target


def table(path):
    """Rows without the columns that tell of the wall clock."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return [[item for name, item in zip(rows[0], row) if name != "wall_per_step"] for row in rows]


def last_checkpoint(out):
    with open(sorted(glob.glob(os.path.join(out, "checkpoint_*.h5")))[-1], "rb") as file:
        return file.read()


def session_of(leader):
    """The processes of a session: mpiexec puts its ranks into process groups of their own."""
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            if os.getsid(int(name)) == leader:
                yield int(name)
        except ProcessLookupError:
            pass


def kill_after(command, seconds):
    """Starts a run in a session of its own and kills all of it."""
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL, start_new_session=True) as run:
        try:
            run.wait(seconds)
        except subprocess.TimeoutExpired:
            for process in list(session_of(run.pid)):
                os.kill(process, signal.SIGKILL)
            while any(process != run.pid for process in session_of(run.pid)):
                time.sleep(0.01)


def go_through(name, source, drivers, folder, launcher):
    driver, case, parameters, options = CASES[name]
    command = [*launcher, os.path.join(drivers, driver),
               os.path.join(source, "examples", case + ".yaml"),
               "-mesh", mesh(source, folder, name, parameters), *options]
    uncut, cut = (os.path.join(folder, f"{name}-{kind}") for kind in ("uncut", "cut"))
    started = time.monotonic()
    subprocess.run([*command, "-output_dir", uncut], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL)
    length = time.monotonic() - started
    dice = random.Random()  # other times in every run of the test
    for kill in range(KILLS):
        restart = ["-restart"] if glob.glob(os.path.join(cut, "checkpoint_*.h5")) else []
        seconds = dice.uniform(0.2, 0.6) * length
        print(f"{name}: killed after {seconds:.2f} s of {length:.2f} {' '.join(restart)}")
        kill_after([*command, "-output_dir", cut, *restart], seconds)
    restart = ["-restart"] if glob.glob(os.path.join(cut, "checkpoint_*.h5")) else []
    print(f"{name}: to the end {' '.join(restart)}")
    subprocess.run([*command, "-output_dir", cut, *restart], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL)
    bad = []
    for file in ("flow.csv", "solid.csv"):
        if table(os.path.join(uncut, file)) != table(os.path.join(cut, file)):
            bad.append(f"{name}: {file} differs")
    if last_checkpoint(uncut) != last_checkpoint(cut):
        bad.append(f"{name}: the last checkpoints differ")
    return bad


def main():
    source, drivers, folder, ranks = sys.argv[1:5]
    folder = os.path.join(folder, f"ranks-{ranks}")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    launcher = sys.argv[5:] + [ranks] if ranks != "1" else []
    bad = [what for name in (CASES if ranks == "1" else ON_RANKS)
           for what in go_through(name, source, drivers, folder, launcher)]
    print("\n".join(bad) or "equal")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
