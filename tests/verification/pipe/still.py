#!/usr/bin/env python3
"""A stiff solid that hardly moves through the mesh keeps its strain and its map alike.

usage: still.py FSI_PIPE MESH FOLDER disc | ring

The frame goes along with the solid, so that what is wrong at its surface does not average out on the
way through the cells. A disc (2-D) is compared with the same on its way through a mesh at rest. Waves
along the surface of a ring (3-D) must not grow.
"""
import csv
import subprocess
import sys

COMMON = {"mesh_periodic": "inlet,outlet", "fluid_viscosity": 0.01, "solid_shear_modulus": 1000}
DISC = {"solid_shape": "sphere", "solid_radius": 0.1, "solid_center": "0.7,0.5,0", "flow_mean_velocity": 0.6667,
        "time_end": 2, "sample_interval": 0.25}
RING = {"solid_shape": "torus", "solid_major_radius": 0.3, "solid_minor_radius": 0.1, "solid_angle": 0,
        "solid_center": "0.6,0.5,0.5", "flow_mean_velocity": 0.5, "time_end": 1, "sample_interval": 0.1}


def run(driver, mesh, folder, speed, options):
    options = {**COMMON, **options, "flow_frame_velocity": speed, "output_dir": f"{folder}/{speed}"}
    words = [str(word) for k, v in options.items() for word in ("-" + k, v)]
    subprocess.run([driver, "-mesh", mesh] + words, check=True, stdout=subprocess.DEVNULL)
    with open(f"{folder}/{speed}/solid.csv", encoding="utf-8") as file:
        rows = [{k: float(v) for k, v in row.items() if v} for row in csv.DictReader(file)]
    for row in rows[::2]:
        print(f"frame {speed}, t = {row['t']:.2f}: elastic energy {row['elastic_energy']:.2e}, of the shape "
              f"{row['shape_energy']:.2e}, smallest eigenvalue of B {row['min_eig_B']:.4f}")
    return rows


def disc(driver, mesh, folder):
    resting, moving = (run(driver, mesh, folder, speed, DISC)[-1] for speed in (0, 0.98))
    assert abs(moving["ux"] + 0.98 - resting["ux"]) < 1e-3
    assert max(moving["elastic_energy"], resting["elastic_energy"]) < 1e-8
    assert moving["shape_energy"] < 2.5 * moving["elastic_energy"]
    assert resting["shape_energy"] < 1.5 * resting["elastic_energy"]


def ring(driver, mesh, folder):
    end = run(driver, mesh, folder, 0.6, RING)[-1]
    assert end["elastic_energy"] < 6e-6 and end["shape_energy"] < 2.2 * end["elastic_energy"]
    assert abs(end["angle"]) < 1e-4 and end["min_eig_B"] > 0.99


def main():
    driver, mesh, folder, which = sys.argv[1:]
    {"disc": disc, "ring": ring}[which](driver, mesh, folder)


if __name__ == "__main__":
    main()
