"""A stiff sphere off the axis leaves a duct through its outlet, on tetrahedra and on hexahedra.

It goes straight on and gives its energy up; the pressure at the inlet falls to that of the empty duct
and not below. A stress that went on across the outlet would work on what is still inside."""
import csv
import os
import shutil
import subprocess
import sys

CASE = """
patches:
  left: {type: flow_rate, flow_rate: 0.5}
  right: {type: pressure, pressure: 0}
fluid: {density: 1, viscosity: 1}
solid:
  shape: sphere
  radius: 0.3
  shear_modulus: 1000
  center: [2.4, 0.55, 0.5]
time: {end: 1.4}
sample_interval: 0.02
"""
WALLS = [word for name in ("bottom", "top", "back", "front") for word in (f"-patches_{name}_type", "wall")]


def rows(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items() if value} for row in csv.DictReader(file)]


def check(driver, mesh, folder):
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    case = os.path.join(folder, "case.yaml")
    with open(case, "w", encoding="utf-8") as file:
        file.write(CASE)
    subprocess.run([driver, case, "-mesh", mesh, "-output_dir", folder, *WALLS], check=True)
    flow, solid = rows(folder, "flow.csv"), rows(folder, "solid.csv")
    inside = [row for row in solid if row["t"] > 0.1 and "uy" in row]
    aside = max(max(abs(row["uy"]), abs(row["uz"])) for row in inside)
    early = max(row["elastic_energy"] for row in inside if row["volume_out"] < 1e-6)
    late = max(row["elastic_energy"] for row in inside)
    empty = flow[-1]["mean_pressure_left"]
    least = min(row["mean_pressure_left"] for row in flow if row["t"] > 0.1)
    out = solid[-1]["volume_out"]
    print(f"{os.path.basename(mesh)}: aside at {aside:.3f}, elastic energy at most {late / early:.2f} of that inside, "
          f"pressure at least {least / empty:.3f} of that of the empty duct, {out:.4f} out")
    assert out > 0.1 and aside < 0.3 and late < 4 * early and least > 0.97 * empty


if __name__ == "__main__":
    for mesh_file in sys.argv[2:-1]:
        name = "leaving_" + os.path.splitext(os.path.basename(mesh_file))[0]
        check(sys.argv[1], mesh_file, os.path.join(sys.argv[-1], name))
