#!/usr/bin/python3
"""Stiff discs in the cavity move as a rigid one.

    stiff.py DRIVER CASE MESHES FOLDER NAMES

Meshes of NAMES, separated by commas, 32 cells a side, G from 100 to 10^6 (the fluid's rho U^2 is 1),
Courant number 0.5. At the last common time the kinetic energies on a mesh are alike within 1 %
(measured: 0.1 on quads, 0.3 on triangles). The disc strains by less than 1e-2: B differs from I
by no more. A strain that is not bounded by the work of the force makes more of it.
"""
import csv
import os
import subprocess
import sys


def last(path):
    with open(path, newline="", encoding="utf-8") as file:
        return {k: float(v) for k, v in list(csv.DictReader(file))[-1].items()}


def main():
    driver, case, meshes, folder, names = sys.argv[1:]
    bad = []
    for name in names.split(","):
        bad += judge(driver, case, os.path.join(meshes, f"{name}.msh"), folder, name)
    return "; ".join(bad) or 0


def judge(driver, case, mesh, folder, name):
    """What is wrong with the discs on one mesh."""
    bad, energies = [], {}
    for G, end in ((100, 1), (1000, 1), (100, 0.1), (1e4, 0.1), (1e6, 0.1)):
        out = os.path.join(folder, f"out-stiff-{name}-{G:g}-{end}")
        subprocess.run([driver, case, "-mesh", mesh, "-solid_shear_modulus", f"{G:g}", "-time_end",
                        str(end), "-sample_interval", str(end), "-output_interval", "0", "-output_dir",
                        out], check=True, stdout=subprocess.DEVNULL)
        flow, solid = (last(os.path.join(out, f"{name}.csv")) for name in ("flow", "solid"))
        print(f"{name}, G {G:g}, t {end}: kinetic energy {flow['kinetic_energy']:.6f}, elastic energy "
              f"{flow['elastic_energy']:.2e}, min_eig_B {solid['min_eig_B']:.4f}, made "
              f"{flow['energy_made']:.1e}")
        energies.setdefault(end, []).append(flow["kinetic_energy"])
        if solid["min_eig_B"] < 0.99 or flow["energy_made"] > 0.01:
            bad.append(f"G {G:g} strains itself on {name}")
    for end, values in energies.items():
        if max(values) > 1.01 * min(values):
            bad.append(f"the kinetic energies at t = {end} differ on {name}")
    return bad


if __name__ == "__main__":
    sys.exit(main())
