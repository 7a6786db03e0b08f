#!/usr/bin/python3
"""Runs the vortex of the page tetrahedra.md with icoFoam of OpenFOAM and prints its errors.

    icofoam.py MESH.msh STEPS FOLDER

MESH.msh is a mesh of a box of side 1 that gmsh makes from meshes/tets.geo. The flow starts as
u = sin(pi x) cos(pi y), v = -cos(pi x) sin(pi y) with slip on all sides and a viscosity of 0.01, and
runs to t = 1 in STEPS steps of one length, on one core. The pressure starts from zero, and icoFoam finds it in the
first step. FOLDER holds the case and the outputs of the programs; it must not exist yet.

One line tells the number of cells, the number of steps, the errors, the largest Courant number and the
CPU seconds of icoFoam. The errors are root mean squares over the volume. That of u is a part of the
exact root mean square, and the mean difference is taken out of that of p.

gmsh, gmshToFoam and icoFoam must be on the path. Where the environment does not name OpenFOAM's own
folder in WM_PROJECT_DIR, it is taken to be share/openfoam beside the folder of icoFoam, as in Debian's package.
"""
import math
import os
import re
import shutil
import subprocess
import sys

import numpy as np

VISCOSITY, END = 0.01, 1
SIDES = "left", "right", "bottom", "top", "back", "front"

CONTROL = """application icoFoam;
startFrom startTime;
startTime 0;
stopAt endTime;
endTime {end};
deltaT {step!r};
writeControl timeStep;
writeInterval {steps};
writeFormat ascii;
writePrecision 12;
timeFormat general;
runTimeModifiable no;
"""

# Second order in time and space.
SCHEMES = """ddtSchemes { default backward; }
gradSchemes { default Gauss linear; }
divSchemes { default none; div(phi,U) Gauss linear; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
"""

SOLUTION = """solvers
{
  p { solver GAMG; smoother GaussSeidel; tolerance 1e-7; relTol 0; }
  pFinal { $p; }
  U { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-7; relTol 0; }
}
PISO { nCorrectors 2; nNonOrthogonalCorrectors 1; pRefCell 0; pRefValue 0; }
"""


def exact(centre, t):
    """Velocity and pressure of the vortex at time t."""
    x, y = math.pi * centre[:, 0], math.pi * centre[:, 1]
    decay = math.exp(-2 * VISCOSITY * math.pi**2 * t)
    u = decay * np.stack([np.sin(x) * np.cos(y), -np.cos(x) * np.sin(y), 0 * x], axis=1)
    return u, decay**2 * (np.cos(2 * x) + np.cos(2 * y)) / 4


def fail(sentence, code=2):
    print(sentence, file=sys.stderr)
    sys.exit(code)


def environment():
    """The environment of the programs; ends the run where one of them is missing."""
    for program, package in (("gmsh", "gmsh"), ("gmshToFoam", "openfoam"), ("icoFoam", "openfoam")):
        if not shutil.which(program):
            fail(f"The program {program} is not on the path; Debian has it in the package {package}.")
    prefix = os.path.dirname(os.path.dirname(shutil.which("icoFoam")))
    return {"WM_PROJECT_DIR": os.path.join(prefix, "share", "openfoam"), **os.environ}


def write(folder, name, kind, text):
    """Writes one file of the case, under the head that OpenFOAM wants."""
    path = os.path.join(folder, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write("FoamFile { version 2.0; format ascii; class %s; object %s; }\n%s"
                   % (kind, os.path.basename(name), text))


def write_field(folder, name, dimensions, values, condition):
    """Writes a field at time 0, a value for each cell and the same condition on all sides."""
    if values.ndim == 1:
        kind, lines = "scalar", [f"{value:.12g}" for value in values]
    else:
        kind, lines = "vector", ["({:.12g} {:.12g} {:.12g})".format(*value) for value in values]
    sides = "\n".join(f"  {side} {{ type {condition}; }}" for side in SIDES)
    text = (f"dimensions {dimensions};\ninternalField nonuniform List<{kind}> {len(lines)}\n(\n"
            + "\n".join(lines) + f"\n);\nboundaryField\n{{\n{sides}\n}}\n")
    write(folder, f"0/{name}", f"vol{kind.capitalize()}Field", text)


def run(words, folder, env):
    """Runs a program in the case's folder and returns its CPU seconds and what it said."""
    before = os.times()
    log = os.path.join(folder, "log." + words[0])
    with open(log, "w", encoding="utf-8") as file:
        code = subprocess.run(words, cwd=folder, env=env, stdout=file, stderr=subprocess.STDOUT).returncode
    after = os.times()
    if code:
        fail(f"{words[0]} has failed; see {log}.", 1)
    with open(log, encoding="utf-8") as file:
        said = file.read()
    return (after.children_user - before.children_user + after.children_system - before.children_system, said)


def numbers(path, width, kind=float):
    """The numbers of the first list in a file of OpenFOAM, in rows of that width."""
    with open(path, encoding="utf-8") as file:
        count, body = re.search(r"^.*?(\d+)\s*\n\(\n(.*?)\n\)", file.read(), re.M | re.S).groups()
    values = np.array(re.sub(r"[()]", " ", body).split(), dtype=kind).reshape(int(count), -1)
    assert values.shape[1] == width
    return values


def cells(folder):
    """Centres and volumes of the tetrahedra, in the order of OpenFOAM's mesh."""
    mesh = os.path.join(folder, "constant", "polyMesh")
    points = numbers(os.path.join(mesh, "points"), 3)
    faces = numbers(os.path.join(mesh, "faces"), 4, int)
    assert (faces[:, 0] == 3).all()
    a, b, c = (points[faces[:, i]] for i in (1, 2, 3))
    middle, area = (a + b + c) / 3, np.cross(b - a, c - a) / 2
    owner = numbers(os.path.join(mesh, "owner"), 1, int)[:, 0]
    neighbour = numbers(os.path.join(mesh, "neighbour"), 1, int)[:, 0]
    inner, n = len(neighbour), max(owner.max(), neighbour.max()) + 1

    def over_faces(on_owner, on_neighbour):
        return np.bincount(owner, on_owner, n) + np.bincount(neighbour, on_neighbour[:inner], n)

    # Every point of a tetrahedron is on three of its four faces.
    centre = np.stack([over_faces(middle[:, i], middle[:, i]) for i in range(3)], axis=1) / 4
    flux = (area * middle).sum(axis=1) / 3
    return centre, over_faces(flux, -flux)


def prepare(mesh, steps, folder, env):
    """Makes the case, and returns centres and volumes of its cells."""
    os.makedirs(folder)
    write(folder, "system/controlDict", "dictionary", CONTROL.format(end=END, step=END / steps, steps=steps))
    write(folder, "system/fvSchemes", "dictionary", SCHEMES)
    write(folder, "system/fvSolution", "dictionary", SOLUTION)
    write(folder, "constant/transportProperties", "dictionary",
          f"nu nu [0 2 -1 0 0 0 0] {VISCOSITY};\n")
    run(["gmsh", mesh, "-save", "-format", "msh2", "-o", "mesh.msh", "-0"], folder, env)
    run(["gmshToFoam", "mesh.msh"], folder, env)
    centre, volume = cells(folder)
    u, _ = exact(centre, 0)
    write_field(folder, "U", "[0 1 -1 0 0 0 0]", u, "slip")
    write_field(folder, "p", "[0 2 -2 0 0 0 0]", 0 * volume, "zeroGradient")
    return centre, volume


def errors(folder, centre, volume):
    """Root mean squares of the errors at the end, that of u as a part of the exact one."""
    u, p = exact(centre, END)
    off_u = numbers(os.path.join(folder, str(END), "U"), 3) - u
    off_p = numbers(os.path.join(folder, str(END), "p"), 1)[:, 0] - p
    off_p -= np.average(off_p, weights=volume)
    square_u = [np.average((values**2).sum(axis=1), weights=volume) for values in (off_u, u)]
    return math.sqrt(square_u[0] / square_u[1]), math.sqrt(np.average(off_p**2, weights=volume))


def main():
    if len(sys.argv) != 4 or not re.fullmatch(r"[1-9]\d*", sys.argv[2]):
        fail(__doc__.strip())
    mesh, steps, folder = os.path.abspath(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
    env = environment()
    if not os.path.isfile(mesh):
        fail(f"There is no mesh {mesh}.")
    if os.path.exists(folder):
        fail(f"The folder {folder} exists already.")
    centre, volume = prepare(mesh, steps, folder, env)
    seconds, said = run(["icoFoam"], folder, env)
    courant = max(float(value) for value in re.findall(r"Courant Number mean: \S+ max: (\S+)", said))
    off_u, off_p = errors(folder, centre, volume)
    print(f"{len(volume)} cells, {steps} steps: u {off_u:.2e}, p {off_p:.2e}, "
          f"largest Courant number {courant:.2f}, {seconds:.2f} CPU seconds")


if __name__ == "__main__":
    main()
