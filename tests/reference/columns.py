#!/usr/bin/python3
"""doc/reference/files.md against the files of short runs: columns.py SOURCE DRIVERS FOLDER

Every file, every column of flow.csv and solid.csv and every key of summary.json that a run writes is
described; all that is described is written by one of the runs; the codes of `limit` are the code's.
"""
import csv
import json
import os
import re
import shutil
import subprocess
import sys

# Driver, case, mesh: geometry, dimension, parameters; options.
RUNS = {
    "torus": ("fsi-pipe", "torus", ("pipe", 3, {"n": 8, "length": 2}),
              "-time_end 0.01 -output_interval 0.01 -checkpoint_interval 0.01"),
    "map": ("fsi-cavity", "cavity_disc", ("cavity", 2, {"n": 16}),
            "-time_end 0.01 -output_interval 0 -solid_kinematics reference_map"),
    "openings": ("fsi-vessel", "bifurcation", ("bifurcation", 3, {"n": 4}),
                 "-time_end 0.005 -output_interval 0"),
    "bodies": ("fsi-shear", "two_discs", ("shear", 2, {"n": 4, "H": 10}),
               "-time_end 0.01 -output_interval 0"),
    "advect": ("fsi-advect", "vortex", ("cavity", 2, {"n": 16}), "-time_end 0.05 -output_interval 0.05"),
}
OPENINGS = ("inlet", "left", "right")  # patches of the third
failures = []


def check(holds, sentence):
    if not holds:
        failures.append(sentence)
        print("FAIL", sentence)


def run(source, drivers, folder, name):
    """Makes the mesh and runs; the folder of the files."""
    driver, case, (geometry, dimension, numbers), options = RUNS[name]
    mesh, out = os.path.join(folder, name + ".msh"), os.path.join(folder, name)
    settings = [w for key, value in numbers.items() for w in ("-setnumber", key, str(value))]
    subprocess.run(["gmsh", f"-{dimension}", os.path.join(source, "meshes", geometry + ".geo"),
                    *settings, "-o", mesh], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL)
    subprocess.run([os.path.join(drivers, driver),
                    os.path.join(source, "examples", case + ".yaml"), "-mesh", mesh,
                    "-sample_interval", "0", "-output_dir", out, *options.split()],
                   check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    return out


def described(page):
    """{title of a section: the names in the first cells of its tables}"""
    sections = {}
    for part in re.split(r"^##? +", page, flags=re.M):
        title = part.split("\n")[0].strip()
        cells = re.findall(r"^\|((?:[^|\\]|\\.)*)\|", part, re.M)
        sections[title] = {name for cell in cells for name in re.findall(r"`([^`]+)`", cell)}
    return sections


def head(path):
    with open(path, encoding="utf-8") as file:
        return set(next(csv.reader(file)))


def compare(what, written, names, patches=OPENINGS):
    """Both ways; names: as described, NAME for a patch."""
    full = {name.replace("NAME", patch) for name in names for patch in patches}
    for name in sorted(written - full):
        check(False, f"{what}: {name} is written and not described")
    for name in sorted(full - written):
        check(False, f"{what}: {name} is described and not written")
    check(written, f"{what}: something is written")


def check_limits(source, page):
    with open(os.path.join(source, "libfsi", "run", "records.cpp"), encoding="utf-8") as file:
        names = re.search(r"limit_code.*?names\{(.*?)\}", file.read(), re.S).group(1)
    code = list(enumerate(re.findall(r'"(\w+)"', names)))
    page = re.search(r"### Codes of limit(.*?)^## ", page, re.S | re.M).group(1)
    told = [(int(n), name) for n, name in re.findall(r"^\| (\d+) \| (\w+) \|", page, re.M)]
    check(code == told, f"the codes of limit are {code}, described are {told}")


def main():
    source, drivers, folder = (os.path.abspath(word) for word in sys.argv[1:4])
    folder = os.path.join(folder, "columns")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    with open(os.path.join(source, "doc", "reference", "files.md"), encoding="utf-8") as file:
        page = file.read()
    sections = described(page)
    out = {name: run(source, drivers, folder, name) for name in RUNS}
    solvers = [out[name] for name in RUNS if name != "advect"]
    compare("flow.csv", set().union(*(head(os.path.join(d, "flow.csv")) for d in solvers)),
            sections["flow.csv"])
    tables = [os.path.join(d, name) for d in solvers for name in os.listdir(d)
              if re.fullmatch(r"solid.*\.csv", name)]
    compare("solid.csv", set().union(*map(head, tables)), sections["solid.csv"])
    compare("solid.csv of fsi-advect", head(os.path.join(out["advect"], "solid.csv")),
            sections["solid.csv of fsi-advect"])
    for name, folder in out.items():
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            compare(f"summary.json of {name}", set(json.load(file)), sections["summary.json"])
    files = set().union(*(os.listdir(folder) for folder in out.values()))
    files = {re.sub(r"_\d{4}\b", "_NNNN", name) for name in files}
    compare("files", {re.sub(r"^solid_(left|right)", "solid_NAME", name) for name in files},
            sections["Files of a run"], ("NAME",))
    check_limits(source, page)
    print(f"{len(failures)} differences between doc/reference/files.md and {len(RUNS)} runs")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
