#!/usr/bin/env python3
"""A pipe in a frame that moves along it: the same pressure gradient, and a ring that turns alike.

usage: frame.py FSI_PIPE MESH GRADED_MESH FOLDER
"""
import csv
import subprocess
import sys

SPEED, END = 0.7, 0.5
RING = {"solid_shape": "torus", "solid_major_radius": 0.3, "solid_minor_radius": 0.1, "solid_angle": 45,
        "solid_center": "0.75,0.5,0.5", "solid_shear_modulus": 10}


def command(driver, mesh, folder, speed, solid, end=END):
    options = {"mesh_periodic": "inlet,outlet", "fluid_viscosity": 0.01, "flow_mean_velocity": 0.5,
               "flow_frame_velocity": speed, "time_step": 0.01, "time_end": end, "sample_interval": 0.1,
               "checkpoint_interval": END, "output_dir": folder, **solid}
    return [driver, "-mesh", mesh] + [str(word) for k, v in options.items() for word in ("-" + k, v)]


def run(driver, mesh, folder, speed, solid):
    subprocess.run(command(driver, mesh, folder, speed, solid), check=True, stdout=subprocess.DEVNULL)
    tables = {}
    for name in ("flow", "solid") if solid else ("flow",):
        with open(f"{folder}/{name}.csv", encoding="utf-8") as file:
            tables[name] = [{k: float(v) for k, v in row.items() if v} for row in csv.DictReader(file)]
    return tables


def empty(driver, mesh, folder):
    still, moving = (run(driver, mesh, f"{folder}/{v}", v, {})["flow"] for v in (0, SPEED))
    assert len(still) == len(moving) > 4
    for a, b in zip(still[1:], moving[1:]):
        assert abs(b["pressure_gradient"] / a["pressure_gradient"] - 1) < 1e-6
        assert abs(b["mean_velocity"] - (0.5 - SPEED)) < 1e-10


def ring(driver, mesh, folder):
    still, moving = (run(driver, mesh, f"{folder}/ring{v}", v, RING) for v in (0, SPEED))
    a, b = still["solid"][-1], moving["solid"][-1]
    place = b["x"] + SPEED * b["t"] - a["x"]
    speed, angle = b["ux"] + SPEED - a["ux"], b["angle"] - a["angle"]
    gradient = moving["flow"][-1]["pressure_gradient"] / still["flow"][-1]["pressure_gradient"] - 1
    made = max(row["energy_made"] for row in moving["flow"])
    print(f"ring at t = {a['t']:g}: x {a['x']:.4f}, u_x {a['ux']:.4f}, angle {a['angle']:.2f}; in the frame off by "
          f"{place:.1e}, {speed:.1e}, {angle:.2f}; gradient by {gradient:.1e} of it; energy made {made:.1e}")
    assert abs(place) < 5e-3 and abs(speed) < 1e-2 and abs(angle) < 1
    assert abs(gradient) < 0.05 and made < 0.05


def restart(driver, mesh, folder):
    """A run goes on in the frame of its checkpoint alone: in another its velocities would be wrong."""
    for speed, code in ((0, 2), (SPEED, 0)):
        words = command(driver, mesh, f"{folder}/ring{SPEED}", speed, RING, END + 0.05)
        done = subprocess.run(words + ["-restart"], capture_output=True, text=True, check=False)
        print(f"-restart at {speed}: {done.returncode} {done.stderr.strip()}")
        assert done.returncode == code and (code == 0 or "frame=0.7,0,0" in done.stderr)


def main():
    driver, swept, graded, folder = sys.argv[1:]
    empty(driver, swept, folder)
    ring(driver, graded, folder)
    restart(driver, graded, folder)


if __name__ == "__main__":
    main()
