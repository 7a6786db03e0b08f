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
    assert out > 0.1 and aside < 0.3 and late < 4 * early and least > 0.99 * empty


def check_given(driver, mesh, folder):
    """Half a disc at an outlet that gives the velocity: by itself or by its flow rate, it is the same."""
    outlets = {"velocity": ["velocity", "-patches_right_velocity", "1,0,0"],
               "flow_rate": ["flow_rate", "-patches_right_flow_rate", "-0.5", "-patches_right_profile", "plug"]}
    least = {}
    for kind, words in outlets.items():
        out = f"{folder}_{kind}"
        shutil.rmtree(out, ignore_errors=True)
        subprocess.run([driver, "-mesh", mesh, "-output_dir", out, "-patches_left_type", "pressure",
                        "-patches_bottom_type", "symmetry", "-patches_top_type", "wall", "-fluid_viscosity", "0.5",
                        "-solid_shape", "sphere", "-solid_radius", "0.2", "-solid_center", "2.6,0.22,0",
                        "-solid_shear_modulus", "1000", "-time_end", "0.5", "-patches_right_type", *words],
                       check=True)
        least[kind] = min(row["min_eig_B"] for row in rows(out, "solid.csv"))
    print(f"half a disc at a given outlet: smallest eigenvalue of B {least}")
    assert least["velocity"] > 0.9 and abs(least["velocity"] - least["flow_rate"]) < 1e-6


if __name__ == "__main__":
    check_given(sys.argv[1], sys.argv[2], os.path.join(sys.argv[-1], "leaving_given"))
    for mesh_file in sys.argv[3:-1]:
        name = "leaving_" + os.path.splitext(os.path.basename(mesh_file))[0]
        check(sys.argv[1], mesh_file, os.path.join(sys.argv[-1], name))
