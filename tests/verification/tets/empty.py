"""Vessels and a box with a lid, empty, on tetrahedra as gmsh makes them, from rest to t = 20.

    empty.py DRIVER GMSH MESHES FOLDER N [FLOW...]

N cells per diameter. Delaunay and HXT, optimised or not. Every run must end at t = 20 without a step that
was taken back. FLOW: only those."""
import json
import math
import os
import shutil
import subprocess
import sys

END = 20
INFLOW = f"-patches_inlet_type flow_rate -patches_inlet_flow_rate {math.pi / 4}".split()
OUTFLOW = "-patches_outlet_type pressure -patches_outlet_pressure 0".split()
BRANCHES = [word for name in ("left", "right")
            for word in (f"-patches_{name}_type", "pressure", f"-patches_{name}_pressure", "0")]
LID = "-patches_top_type velocity -patches_top_velocity 1,0,0".split() + [
    word for name in ("left", "right", "bottom", "back", "front") for word in (f"-patches_{name}_type", "wall")]
# name: geometry, Reynolds number, openings, further numbers of the geometry
FLOWS = {
    "cylinder": ("cylinder", 100, INFLOW + OUTFLOW, {}),
    "bend": ("bend", 100, INFLOW + OUTFLOW, {}),
    "bifurcation": ("bifurcation", 100, INFLOW + BRANCHES, {}),
    "stenosis_50": ("stenosis", 50, INFLOW + OUTFLOW, {"simplex": 1}),
    "stenosis_200": ("stenosis", 200, INFLOW + OUTFLOW, {"simplex": 1}),
    "lid_100": ("tets", 100, LID, {}),
    "lid_1000": ("tets", 1000, LID, {}),
}


def make(gmsh, meshes, geometry, numbers, file):
    words = [gmsh, "-3", "-bin", os.path.join(meshes, geometry + ".geo"), "-o", file]
    for name, value in numbers.items():
        words += ["-setnumber", name, str(value)]
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


def main():
    driver, gmsh, meshes, out, n = sys.argv[1:6]
    os.makedirs(out, exist_ok=True)
    for flow in sys.argv[6:] or FLOWS:
        geometry, reynolds, openings, more = FLOWS[flow]
        for algorithm in (1, 10):
            for optimise in (1, 0):
                name = f"{flow}_{'delaunay' if algorithm == 1 else 'hxt'}_{'optimised' if optimise else 'plain'}"
                folder = os.path.join(out, name)
                shutil.rmtree(folder, ignore_errors=True)
                numbers = {"n": n, "algorithm": algorithm, "optimise": optimise,
                           "Mesh.Algorithm3D": algorithm, "Mesh.Optimize": optimise, **more}
                make(gmsh, meshes, geometry, numbers, folder + ".msh")
                subprocess.run([driver, "-mesh", folder + ".msh", "-fluid_viscosity", str(1 / reynolds), *openings,
                                "-time_end", str(END), "-output_interval", "0", "-output_dir", folder],
                               check=True, stdout=subprocess.DEVNULL)
                with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
                    summary = json.load(file)
                print(f"{name}: {summary['cells']} cells, {summary['steps']} steps, "
                      f"{summary['rejected_steps']} taken back, {summary['wall_seconds']:.0f} s", flush=True)
                assert summary["status"] == "complete" and summary["t"] == END
                assert summary["rejected_steps"] == 0


if __name__ == "__main__":
    main()
