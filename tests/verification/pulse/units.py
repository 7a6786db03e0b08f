#!/usr/bin/env python3
"""The same case in units of the vessel and in SI units: the same trajectory to the solver's tolerance.

A soft sphere in a bend 400 micrometres wide at 0.05 m/s, behind it a windkessel.
usage: units.py FSI_VESSEL MESH MESH_IN_METRES FOLDER
"""
import csv
import subprocess
import sys

LENGTH, VELOCITY, DENSITY = 4e-4, 0.05, 1000.0
TIME, PRESSURE = LENGTH / VELOCITY, DENSITY * VELOCITY**2
RATE = VELOCITY * LENGTH**2


def run(driver, mesh, folder, L, T, rho, P, Q):
    options = {
        "patches_inlet_type": "flow_rate", "patches_inlet_flow_rate": 0.4 * Q,
        "patches_outlet_type": "windkessel", "patches_outlet_resistance": P / Q,
        "patches_outlet_distal_resistance": 4 * P / Q, "patches_outlet_capacitance": 0.1 * Q * T / P,
        "fluid_density": rho, "fluid_viscosity": 0.02 * P * T, "solid_density": rho,
        "solid_shape": "sphere", "solid_radius": 0.25 * L, "solid_shear_modulus": 2 * P,
        "solid_viscosity": 0.02 * P * T, "solid_path": "inlet,outlet", "solid_arc_length": 0.6 * L,
        "time_end": 0.3 * T, "time_step": 0.005 * T, "sample_interval": 0, "output_dir": folder,
    }
    command = [driver, "-mesh", mesh]
    for name, value in options.items():
        command += ["-" + name, str(value)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    tables = {}
    for name in ("solid", "flow"):
        with open(f"{folder}/{name}.csv", encoding="utf-8") as file:
            tables[name] = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    return tables


def main():
    driver, mesh, metres, folder = sys.argv[1:]
    plain = run(driver, mesh, folder + "/units_plain", 1, 1, 1, 1, 1)
    si = run(driver, metres, folder + "/units_si", LENGTH, TIME, DENSITY, PRESSURE, RATE)
    worst = 0.0
    for table, column, unit in (("solid", "x", LENGTH), ("solid", "y", LENGTH), ("solid", "z", LENGTH),
                                ("solid", "min_eig_B", 1), ("flow", "mean_pressure_outlet", PRESSURE),
                                ("flow", "flow_rate_outlet", RATE), ("flow", "reynolds", 1)):
        assert len(plain[table]) == len(si[table]) == 60 + (table == "solid")
        for a, b in zip(plain[table], si[table]):
            worst = max(worst, abs(a[column] - b[column] / unit))
    moved = plain["solid"][-1]["x"] - plain["solid"][0]["x"]
    print(f"vessel of 400 micrometres: the sphere moves by {moved:.3f} diameters; "
          f"largest difference to SI units {worst:.1e}")
    assert moved > 0.1
    assert worst < 1e-6


main()
