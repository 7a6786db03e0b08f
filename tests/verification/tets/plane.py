"""A quarter of a soft sphere at two planes of symmetry, on ordinary tetrahedra, at a low Reynolds number.

It keeps its strain as it goes down a duct: what is rough at a plane would grow at the rate G / mu."""
import csv
import os
import shutil
import subprocess
import sys

CASE = """
patches:
  left: {type: flow_rate, flow_rate: 0.5}
  right: {type: pressure, pressure: 0}
  bottom: {type: symmetry}
  back: {type: symmetry}
  top: {type: wall}
  front: {type: wall}
fluid: {density: 1, viscosity: 4}
solid:
  shape: sphere
  radius: 0.65
  shear_modulus: 300
  center: [1.2, 0, 0]
time: {end: 1}
sample_interval: 0.05
"""


def main():
    driver, mesh, folder = sys.argv[1:]
    folder = os.path.join(folder, "plane")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    case = os.path.join(folder, "case.yaml")
    with open(case, "w", encoding="utf-8") as file:
        file.write(CASE)
    subprocess.run([driver, case, "-mesh", mesh, "-output_dir", folder], check=True)
    with open(os.path.join(folder, "solid.csv"), encoding="utf-8") as file:
        rows = [{name: float(value) for name, value in row.items() if value} for row in csv.DictReader(file)]
    least = min(row["min_eig_B"] for row in rows)
    last = rows[-1]
    ratio = last["elastic_energy"] / last["shape_energy"]
    print(f"quarter of a sphere at t = {last['t']:g}: x {last['x']:.4f}, smallest eigenvalue of B {least:.3f}, "
          f"elastic energy over that of the shape {ratio:.2f}")
    assert least > 0.92 and 0.7 < ratio < 1.4


if __name__ == "__main__":
    main()
