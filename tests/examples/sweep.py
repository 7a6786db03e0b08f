#!/usr/bin/python3
"""examples/sweep/run: side by side, gone on with after a kill, with any driver, and drawn.

    sweep.py SOURCE DRIVERS FOLDER
"""
import csv
import fcntl
import os
import re
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


def text(*path):
    try:
        with open(os.path.join(*path), encoding="utf-8") as file:
            return file.read()
    except OSError:
        return ""


def processes_of(folder):
    """Processes of this user whose command line names the folder as -output_dir."""
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{name}/cmdline", "rb") as file:
                words = file.read().decode(errors="replace").split("\0")
        except OSError:
            continue
        if "-output_dir" in words and words[words.index("-output_dir") + 1] == folder:
            yield int(name)


def wait_for(condition):
    end = time.monotonic() + 60
    while not condition() and time.monotonic() < end:
        time.sleep(0.01)
    return condition()


def has_checkpoint(folder):
    return os.path.isdir(folder) and any(f.startswith("checkpoint_") for f in os.listdir(folder)
                                         if f.endswith(".h5"))


def check_tables(source, drivers, folder):
    """A table beside the case counts as one in the working folder does, also with a blank in its name."""
    mesh, case, points, out = (os.path.join(folder, name) for name in ("channel.msh", "case.yaml", "inlet.csv", "flows"))
    subprocess.run(["gmsh", "-2", os.path.join(source, "meshes", "channel.geo"), "-setnumber", "n", "6", "-o", mesh],
                   check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    with open(case, "w", encoding="utf-8") as file:
        file.write("patches:\n  inlet: {type: flow_rate, flow_rate: my pulse.csv}\n"
                   "  outlet: {type: pressure, pressure: beyond.csv}  # beyond.csv\n")
    with open(points, "w", encoding="utf-8") as file:
        file.write("fluid_viscosity\n0.1\n")
    values = {"my pulse.csv": 1, "beyond.csv": 0}

    def ends(changed, more=()):
        values.update(changed)
        for name, value in values.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(f"0,{value}\n1,{value}\n")
        subprocess.run([os.path.join(source, "examples", "sweep", "run"), case, points, out, "--",
                        os.path.join(drivers, "fsi-vessel"), "-mesh", mesh, "-time_end", "0.1", *more],
                       stdin=subprocess.DEVNULL, capture_output=True, check=False, cwd=source)
        row = list(csv.DictReader(text(out, "sweep.csv").splitlines()))[0]
        return float(row["flow_rate_outlet"]), float(row["mean_pressure_outlet"])

    found = [ends({}), ends({"my pulse.csv": 2}), ends({"beyond.csv": 3})]
    check(all(abs(a - b) < 1e-6 for pair in zip(found, [(1, 0), (2, 0), (2, 3)]) for a, b in zip(*pair)),
          f"a point runs anew where a table beside the case has changed: {found}")
    flow = ["-flow_from", os.path.join(folder, "flow")]
    begins = []
    for end in ("0.02", "0.04"):
        subprocess.run([os.path.join(drivers, "fsi-vessel"), case, "-mesh", mesh, "-time_end", end, "-checkpoint_interval",
                        end, "-output_dir", flow[1]], stdin=subprocess.DEVNULL, capture_output=True, check=False)
        ends({}, flow)
        rows = csv.DictReader(text(out, "fluid_viscosity=0.1", "flow.csv").splitlines())
        begins.append(float(next(rows)["t"]))
    check(begins[0] < 0.04 < begins[1], f"and where the flow that it begins with has: {begins}")


def main():
    source, drivers, folder = sys.argv[1:4]
    folder = os.path.join(os.path.abspath(folder), "sweep")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    mesh, points, out = (os.path.join(folder, name) for name in ("mesh.msh", "points.csv", "out"))
    subprocess.run(["gmsh", "-2", os.path.join(source, "meshes", "cavity.geo"), "-setnumber", "n",
                    "16", "-o", mesh], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL)
    driver = os.path.join(folder, "my_cavity")  # a driver of any name
    os.symlink(os.path.abspath(os.path.join(drivers, "fsi-cavity")), driver)
    with open(points, "w", encoding="utf-8") as file:
        file.write(" lid_velocity , solid_center\n# a comment\n 1 , \"0.6, 0.5, 0\" \n\n"
                   " 0.5 , \"0.5, 0.5, 0\"\n")
    names = ["lid_velocity=1_solid_center=0.6,0.5,0", "lid_velocity=0.5_solid_center=0.5,0.5,0"]
    first, second = (os.path.join(out, name) for name in names)
    case = os.path.join(source, "examples", "cavity_disc.yaml")
    command = [os.path.join(source, "examples", "sweep", "run"), "-j", "2", case, points, out, "--",
               driver, "-mesh", mesh, "-time_end", "20", "-output_interval", "0",
               "-checkpoint_interval", "0.5"]

    def start():
        return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)

    sweep = start()
    check(wait_for(lambda: has_checkpoint(first) and has_checkpoint(second)), "both points begin")
    alive = [list(processes_of(point)) for point in (first, second)]
    check(all(alive), f"and run side by side {alive}")
    for process in alive[0]:
        os.kill(process, signal.SIGKILL)
    said = sweep.communicate()[0]
    check(sweep.returncode == 1 and f"{names[0]}: failed (-9)" in said and
          f"{names[1]}: complete" in said, f"the killed one fails, the other completes: {said}")

    again = start()
    check(wait_for(lambda: "going on from t" in text(first, "log.txt")), "it goes on")
    again.send_signal(signal.SIGINT)
    said = again.communicate()[0]
    check(again.returncode == 5 and f"{names[0]}: interrupted" in said,
          f"SIGINT to the sweep saves it: exit code {again.returncode} {said}")

    last = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    check(last.returncode == 0 and last.stdout.count(": complete") == 2,
          f"then all is complete: {last.stdout} {last.stderr}")
    check(text(first, "log.txt").count("going on from t") == 2, "gone on with twice")
    check(text(second, "log.txt").count("limits on dt") == 1, "what was complete did not run again")
    rows = list(csv.DictReader(text(out, "sweep.csv").splitlines()))
    check([row["status"] for row in rows] == ["complete"] * 2 and
          all(abs(float(row["t"]) - 20) < 1e-9 for row in rows), "the table holds the end of each")
    check(os.path.exists(os.path.join(out, "sweep.png")), "and is drawn")

    with open(mesh, "a", encoding="utf-8") as file:
        file.write("\n")
    brief = ["0.01" if word == "20" else word for word in command]
    subprocess.run(brief, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    logs = text(first, "log.txt")
    subprocess.run(brief, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    check(text(first, "log.txt") == logs, "what is complete is left")
    with open(mesh, "a", encoding="utf-8") as file:
        file.write("\n")
    subprocess.run(brief, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    check(text(first, "log.txt") != logs, "and runs anew where the mesh has changed")

    named = os.path.join(folder, "named.csv")
    with open(named, "w", encoding="utf-8") as file:
        file.write("name, lid_velocity\nslow, 0.5\nas it is, -\n")
    short = [named if word == points else "0.01" if word == "20" else word for word in command]
    subprocess.run(short, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    velocities = [re.findall(r'^lid_velocity: "?(.*?)"?$', text(os.path.join(out, name), "run.yaml"), re.M)
                  for name in ("slow", "as it is")]
    check(velocities == [["0.5"], ["1"]], f"points with names, one with the case's value: {velocities}")

    with open(named, "w", encoding="utf-8") as file:
        file.write("name, lid_velocty\nmisspelt, 0.5\n")
    wrong = subprocess.run(short, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    check(wrong.returncode == 1 and "misspelt: failed (2): unknown option -lid_velocty" in wrong.stdout,
          f"a point that fails says why: {wrong.stdout}")

    pair = os.path.join(folder, "pair.yaml")
    with open(pair, "w", encoding="utf-8") as file:
        file.write("solids:\n" + "".join(
            f"  {name}: {{shape: sphere, radius: 0.1, center: [{x}], shear_modulus: 0.1}}\n"
            for name, x in (("left", "0.3,0.5,0"), ("right", "0.7,0.5,0"))))
    with open(named, "w", encoding="utf-8") as file:
        file.write("name, lid_velocity\npair, 0.5\n")
    subprocess.run([pair if word == case else word for word in short], stdin=subprocess.DEVNULL, capture_output=True,
                   check=False)
    rows = list(csv.DictReader(text(out, "sweep.csv").splitlines()))
    check(abs(float(rows[0].get("left_x", 0)) - 0.3) < 0.01 and abs(float(rows[0].get("right_x", 0)) - 0.7) < 0.01,
          f"the columns of each of two solids: {rows[0]}")

    with open(named, "w", encoding="utf-8-sig") as file:  # as a spreadsheet writes it
        file.write("name;lid_velocity\nfast;2\n")
    subprocess.run(short, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    check('lid_velocity: 2' in text(os.path.join(out, "fast"), "run.yaml").replace('"', ""), "a table of a spreadsheet")
    with open(named, "w", encoding="utf-8") as file:
        file.write("lid_velocity, lid_velocity\n1, 2\n")
    bad = subprocess.run(short, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    check(bad.returncode == 2 and "column lid_velocity stands there twice" in bad.stderr,
          f"a column that stands there twice is refused: {bad.stderr}")

    with open(named, "w", encoding="utf-8") as file:
        file.write("name, lid_velocity\na/1, 1\na-1, 2\n")
    bad = subprocess.run(short, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    check(bad.returncode == 2 and "two points would write into" in bad.stderr, f"so are two points of one folder: {bad.stderr}")
    with open(named, "w", encoding="utf-8") as file:
        file.write(f"name, lid_velocity\n{'long' * 80}, 1\n")
    said = subprocess.run(short, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False).stdout
    check(": complete" in said, f"a name too long for a folder is shortened: {said}")

    with open(os.path.join(second, ".lock"), "wb") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        os.remove(os.path.join(second, "summary.json"))
        again = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        check("running already" in again.stdout and again.returncode == 1,
              f"a point that runs is left alone: {again.stdout}")

    with open(points, "a", encoding="utf-8") as file:
        file.write("1\n")
    bad = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    check(bad.returncode == 2 and '"1" has not a value for each of' in bad.stderr,
          f"a line that is not whole is refused: {bad.stderr}")
    os.remove(points)
    bad = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    check(bad.returncode == 2 and f'"{points}" cannot be read' in bad.stderr,
          f"so is a table that is not there: {bad.stderr}")
    check_tables(source, os.path.abspath(drivers), folder)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
