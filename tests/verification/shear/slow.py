"""A disc of triangles that moves as the fluid does, in a flow so slow that steps are long for viscosity.

Equal viscosities and next to no elasticity: u = rate y, so that the plates put in and the fluid
dissipates mu rate^2 H^2 all along.

Usage: slow.py FSI-SHEAR CASE MESHES FOLDER MESH BOX
"""
import csv
import os
import subprocess
import sys


def main():
    driver, case, meshes, folder, mesh, box = sys.argv[1:]
    out = os.path.join(folder, "slow")
    step, steps = 1.6e-4, 400
    subprocess.run([driver, case, "-mesh", os.path.join(meshes, mesh + ".msh"),
                    "-fluid_density", "5e-4", "-solid_density", "5e-4", "-fluid_viscosity", "1",
                    "-solid_viscosity", "1", "-solid_shear_modulus", "1e-6", "-solid_memory", "false",
                    "-time_end", str(steps * step), "-time_step", str(step), "-time_courant", "1",
                    "-sample_interval", str(steps * step / 10), "-output_dir", out], check=True)
    with open(os.path.join(out, "flow.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))[1:]
    exact = float(box) ** 2
    worst = max(abs(float(row["dissipation"]) / exact - 1) for row in rows)
    print(f"dissipation off by {worst:.1e} at most, allowed 1e-5")
    return 0 if worst < 1e-5 else 1


if __name__ == "__main__":
    sys.exit(main())
