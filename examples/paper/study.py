"""Runs the parts of the study that examples/paper/run is asked for, each a sweep over a table here."""
import argparse
import csv
import os
import re
import subprocess
import sys
from dataclasses import dataclass

HERE = os.path.dirname(os.path.abspath(__file__))
PARTS = ("flow", "disc", "pipe", "stenosis", "figures", "claims")


@dataclass
class Preset:
    """Cells per diameter of the parts; several where a part compares meshes.

    Pipe and stenosis are the half z > 0.5, apart from the kinematics. fine: diameters along which the mesh of the
    pipe is fine, and goes along with the ring; 0: all of it is fine and at rest. guide: cells per diameter of runs
    at rest that tell how fast a ring goes.
    """

    flow: tuple
    disc: tuple
    pipe: int
    stenosis: int
    fine: float = 0
    guide: int = 24


PRESETS = {"coarse": Preset((16, 20, 24), (16, 32, 64), 24, 24),
           "medium": Preset((16, 24, 32), (16, 32, 64, 128), 32, 32),
           "paper": Preset((32, 48, 64), (16, 32, 64, 128), 64, 48, fine=2)}
PIPE = ("tilt", "place", "thickness", "modulus", "viscosity", "size", "kinematics")
THROATS = (6, 3, 1)


@dataclass
class Sweep:
    """A table of points, run with a driver and a case on a mesh of a geometry."""

    part: str
    name: str
    points: str
    driver: str
    case: str
    dimension: int
    geometry: str
    parameters: dict
    guide: str = ""  # the sweep over the same points at rest
    options: tuple = ()  # beside those of the case

    @property
    def half(self):
        """Whether it runs the half of what it is about, to one side of the plane z = 0.5."""
        return "half" in self.parameters

    @property
    def mesh(self):
        return "-".join([self.geometry] + [f"{k}-{v}" for k, v in self.parameters.items()]) + ".msh"


def sweeps(preset):
    """All sweeps of a preset, in the order of the figures."""
    for n in preset.flow:
        yield Sweep("flow", f"flow-{n}", "flow", "fsi-pipe", "pipe", 3, "pipe", {"n": n, "length": 1})
    for n in preset.disc:
        yield Sweep("disc", f"disc-{n}", "disc", "fsi-cavity", "disc", 2, "cavity", {"n": n})
    for name in PIPE:
        pipe = {"n": preset.pipe, "length": 5}
        if name != "kinematics":  # left_cauchy_green has no image beyond a plane
            pipe["half"] = 1
        if preset.fine:
            yield Sweep("pipe", name + "-guide", name, "fsi-pipe", "pipe", 3, "pipe", {**pipe, "n": preset.guide})
            yield Sweep("pipe", name, name, "fsi-pipe", "pipe", 3, "pipe", {**pipe, "fine": preset.fine},
                        name + "-guide")
        else:
            yield Sweep("pipe", name, name, "fsi-pipe", "pipe", 3, "pipe", pipe)
    for throat in THROATS:
        yield Sweep("stenosis", f"throat-{throat}", "shapes", "fsi-stenosis", "stenosis", 3, "stenosis",
                    {"n": preset.stenosis, "throat": throat, "half": 1})


def points(name):
    """The folders of the points of a table, in its order."""
    with open(os.path.join(HERE, name + ".csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file, skipinitialspace=True))
    return [row.get("name") or "_".join(f"{k}={v}" for k, v in row.items() if v != "-") for row in rows]


def make_table(sweep, out):
    """The table of a sweep's points. Where it has a guide, a table of its own: the mesh of each point goes along
    at the mean velocity of the guide's ring."""
    table = os.path.join(HERE, sweep.points + ".csv")
    if not sweep.guide:
        return table
    with open(table, encoding="utf-8") as file:
        rows = list(csv.DictReader(file, skipinitialspace=True))
    for row, name in zip(rows, points(sweep.points)):
        with open(os.path.join(out, sweep.guide, name, "solid.csv"), encoding="utf-8") as file:
            way = [(float(at["t"]), float(at["x"])) for at in csv.DictReader(file)]
        row["flow_frame_velocity"] = f"{(way[-1][1] - way[0][1]) / (way[-1][0] - way[0][0]):.4f}"
        row["name"] = name
    path = os.path.join(out, sweep.name + "-points.csv")
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)
    return path


def tell_strayed(sweep, out):
    """Names the points whose ring left the part of the pipe that is fine."""
    for point in points(sweep.points):
        folder = os.path.join(out, sweep.name, point)
        if not os.path.exists(os.path.join(folder, "solid.csv")):
            continue
        with open(os.path.join(folder, "run.yaml"), encoding="utf-8") as file:
            size = sum(float(r) for r in re.findall(r'^solid_(?:major|minor)_radius: "(.*)"', file.read(), re.M))
        with open(os.path.join(folder, "solid.csv"), encoding="utf-8") as file:
            way = [float(at["x"]) for at in csv.DictReader(file)]
        if min(way) < size or max(way) > sweep.parameters["fine"] - size:
            print(f"WARNING: {sweep.name}/{point}: the ring goes from x = {min(way):.2f} to {max(way):.2f}, out of the "
                  f"fine part from 0 to {sweep.parameters['fine']:g}", flush=True)


def make_mesh(sweep, folder):
    """The mesh file of a sweep, made once."""
    path = os.path.join(folder, sweep.mesh)
    if os.path.exists(path):
        return path
    os.makedirs(folder, exist_ok=True)
    settings = [word for k, v in sweep.parameters.items() for word in ("-setnumber", k, str(v))]
    geometry = os.path.join(HERE, "..", "..", "meshes", sweep.geometry + ".geo")
    done = subprocess.run(["gmsh", f"-{sweep.dimension}", geometry, *settings, "-bin", "-o",
                           path + ".part.msh"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, check=False)
    if done.returncode:
        sys.exit(f"gmsh failed on {geometry}:\n{done.stdout}")
    os.replace(path + ".part.msh", path)
    return path


def run(sweep, arguments):
    """Runs a sweep; whether all of its points are complete."""
    driver = [os.path.join(arguments.drivers, sweep.driver)]
    if arguments.n > 1:
        driver = [os.path.join(arguments.drivers, "fsi-mpiexec"), "-n", str(arguments.n)] + driver
    mesh = make_mesh(sweep, os.path.join(arguments.o, "meshes"))
    print(f"== {sweep.part}: {sweep.name}", flush=True)
    try:
        table = make_table(sweep, arguments.o)
    except (FileNotFoundError, IndexError):
        print(f"{sweep.name} is left out: there is no run in {sweep.guide} yet for each of its points")
        return 1
    code = subprocess.run([os.path.join(HERE, "..", "sweep", "run"), "-j", str(arguments.j),
                           os.path.join(HERE, sweep.case + ".yaml"),
                           table,
                           os.path.join(arguments.o, sweep.name), "--", *driver, "-mesh", mesh, *sweep.options],
                          check=False).returncode
    if sweep.guide:
        tell_strayed(sweep, arguments.o)
    return code


def read_arguments(words):
    parser = argparse.ArgumentParser(prog="examples/paper/run", add_help=False)
    parser.add_argument("drivers")
    parser.add_argument("root")
    parser.add_argument("-j", type=int, default=int(os.environ.get("FSI_CORES", "1")))
    parser.add_argument("-n", type=int, default=1)
    parser.add_argument("-o")
    parser.add_argument("words", nargs="*", metavar="PRESET|PART")
    arguments = parser.parse_intermixed_args(words)
    presets = [word for word in arguments.words if word in PRESETS]
    arguments.parts = [word for word in arguments.words if word in PARTS] or list(PARTS)
    unknown = [word for word in arguments.words if word not in PRESETS and word not in PARTS]
    if unknown or len(presets) > 1:
        parser.exit(2, f'"{(unknown or presets)[-1]}": one of {", ".join(PRESETS)}, and parts of '
                    f'{", ".join(PARTS)} are expected\n')
    arguments.preset = (presets or ["coarse"])[0]
    arguments.o = os.path.abspath(arguments.o or os.path.join(arguments.root, arguments.preset))
    return arguments


def main():
    arguments = read_arguments(sys.argv[1:])
    os.makedirs(arguments.o, exist_ok=True)
    preset, worst = PRESETS[arguments.preset], 0
    for sweep in sweeps(preset):
        if sweep.part in arguments.parts:
            code = run(sweep, arguments)
            if code in (2, 5):
                return code
            worst = max(worst, code)
    if "figures" in arguments.parts:
        import figures
        for path in figures.draw(preset, arguments.o):
            print("wrote", path)
    if "claims" in arguments.parts:
        import claims
        print("wrote", claims.write(preset, arguments.o))
    return worst


if __name__ == "__main__":
    sys.exit(main())
