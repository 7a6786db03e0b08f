"""A disc as wide as its channel is wedged in it under a steady pressure, on triangles.

    wedged.py DRIVER CHANNEL FOLDER

It is stuck, or slides slowly. A strain of the cells at the wall that takes up more than the force gives
grows whatever the step, until most of the energy comes from nothing."""
import csv
import os
import shutil
import subprocess
import sys

ARGUMENTS = """
-patches_inlet_type pressure -patches_inlet_pressure 0.8 -patches_outlet_type pressure -patches_outlet_pressure 0
-fluid_density 1 -fluid_viscosity 0.05 -solid_shape sphere -solid_shear_modulus 20 -sample_interval 0.02
""".split()


def rows(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items() if value} for row in csv.DictReader(file)]


def check(driver, mesh, folder, end, energy_most, words):
    """The elastic energy must stay below energy_most and none may come from nothing."""
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([driver, *ARGUMENTS, "-mesh", mesh, "-output_dir", folder, "-time_end", str(end), *words],
                   check=True)
    flow, solid = rows(folder, "flow.csv"), rows(folder, "solid.csv")
    made = max(row.get("energy_made", 0) for row in flow)
    most = max(row["elastic_energy"] for row in solid if "elastic_energy" in row)
    least = min(row["min_eig_B"] for row in solid if "min_eig_B" in row)
    print(f"{os.path.basename(folder)}: elastic energy at most {most:.4f}, smallest eigenvalue of B {least:.3f}, "
          f"energy from nothing {made:.3f}")
    assert made < 0.02 and most < energy_most and least > 0.7


if __name__ == "__main__":
    fsi_vessel, channel, out = sys.argv[1:]
    disc = ["-solid_radius", "0.5", "-solid_center", "2,0.5,0"]
    check(fsi_vessel, channel, os.path.join(out, "wedged_disc"), 1.5, 0.012, [*disc, "-solid_viscosity", "0.05"])
    for ratio in (10, 0.1):
        check(fsi_vessel, channel, os.path.join(out, f"wedged_disc_{ratio}"), 2, 0.012,
              [*disc, "-solid_viscosity", str(0.05 * ratio)])
