#!/usr/bin/python3
"""A stiff sphere, G* = 2300, is carried into a taper of tetrahedra with the default step.

    taper.py DRIVER FOLDER

Units: micrometre, nanogram, millisecond, so pressures are in Pa. The elastic energy at t = 3.25 is below 5e4. With a
third of the step it is 1.4e4; a strain that bursts has some 1e6. Nothing is warned of.
"""
import csv
import os
import subprocess
import sys

CASE = """
patches:
  inlet: {type: pressure, pressure: 200}
  outlet: {type: pressure, pressure: 0}
  wall: {type: wall}
  symy: {type: symmetry}
  symz: {type: symmetry}
fluid: {density: 1.0e-3, viscosity: 3.5}
solid: {shape: sphere, radius: 130, shear_modulus: 3000, center: [320, 0, 0]}
time: {end: 3.5}
sample_interval: 0.25
output_interval: 0
"""


def main():
    driver, folder = sys.argv[1:]
    mesh, case, out = (os.path.join(folder, name) for name in ("taper.msh", "taper.yaml", "out-taper"))
    geometry = os.path.join(os.path.dirname(os.path.abspath(__file__)), "taper.geo")
    subprocess.run(["gmsh", "-3", "-bin", "-v", "2", geometry, "-o", mesh], check=True, stdin=subprocess.DEVNULL)
    with open(case, "w", encoding="utf-8") as file:
        file.write(CASE)
    said = subprocess.run([driver, case, "-mesh", mesh, "-output_dir", out], check=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True).stderr
    with open(os.path.join(out, "solid.csv"), newline="", encoding="utf-8") as file:
        row = min(csv.DictReader(file), key=lambda row: abs(float(row["t"]) - 3.25))
    energy, shape = float(row["elastic_energy"]), float(row["shape_energy"])
    print(f"t {row['t']}, x {float(row['x']):.2f}, elastic_energy {energy:.3g}, shape_energy {shape:.3g}\n{said}")
    if not energy < 5e4:
        return f"the elastic energy is {energy:.3g}"
    return "it is warned of" if "warning" in said else 0


if __name__ == "__main__":
    sys.exit(main())
