#!/usr/bin/env python3
"""Values given over time, at default settings: the steps follow them.

A channel with a heartbeat before a windkessel, an oscillating pressure, a pressure that is switched off,
and a saw of the flow rate.
usage: defaults.py FSI_VESSEL MESH FOLDER
"""
import cmath
import csv
import math
import os
import subprocess
import sys

LENGTH, VISCOSITY = 4.0, 0.5  # of the channel of height 1


def run(name, tables, tells="", **options):
    """The columns of flow.csv of a run to its end, which says nothing but one line with `tells`."""
    driver, mesh, folder = sys.argv[1:]
    folder = os.path.join(folder, "defaults_" + name)
    os.makedirs(folder, exist_ok=True)
    command = [driver, "-mesh", mesh, "-output_dir", folder]
    for option, text in tables.items():
        with open(os.path.join(folder, option + ".csv"), "w", encoding="utf-8") as file:
            file.write("t,value\n" + text)
        command += ["-" + option, file.name]
    for option, value in options.items():
        command += ["-" + option, str(value)]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    told = tells in done.stderr and done.stderr.count("\n") == (1 if tells else 0)
    assert done.returncode == 0 and told, f"{name}: exit code {done.returncode} {done.stderr}"
    with open(os.path.join(folder, "flow.csv"), encoding="utf-8") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    return {column: [row[column] for row in rows] for column in rows[0]}


def heartbeat():
    """The mean pressure of the windkessel is (R_p + R_d) times the mean flow rate."""
    beat = "0,0\n0.1,1\n0.3,0\n0.32,-0.05\n0.34,0\n1,0\n"
    flow = run("heartbeat", {"patches_inlet_flow_rate": beat}, patches_inlet_type="flow_rate",
               patches_inlet_period=1, patches_outlet_type="windkessel", patches_outlet_resistance=1,
               patches_outlet_distal_resistance=10, patches_outlet_capacitance=0.1,
               patches_outlet_stored_pressure=1.2, fluid_viscosity=0.1, time_end=10)
    mean = sum(max(0, min(dt, t - 5)) * p for t, dt, p in
               zip(flow["t"], flow["dt"], flow["mean_pressure_outlet"])) / 5
    exact = 11 * 0.149
    print(f"heartbeat: {len(flow['t'])} steps, mean pressure off by {100 * (mean / exact - 1):.2f} %")
    assert abs(mean / exact - 1) < 0.01


def oscillation():
    """p = cos(2 pi t) at the inlet, 0 at the outlet; the flow rate between two plates."""
    table = "".join(f"{i / 40},{LENGTH * math.cos(2 * math.pi * i / 40)}\n" for i in range(41))
    flow = run("oscillation", {"patches_inlet_pressure": table}, patches_inlet_type="pressure",
               patches_inlet_period=1, patches_outlet_type="pressure", fluid_viscosity=VISCOSITY, time_end=8)
    omega = 2 * math.pi
    wave = cmath.sqrt(1j * omega / VISCOSITY) / 2
    amplitude = (1 - cmath.tanh(wave) / wave) / (1j * omega)
    worst = max(abs(q - (amplitude * cmath.exp(1j * omega * t)).real)
                for t, q in zip(flow["t"], flow["flow_rate_outlet"]) if t > 4) / abs(amplitude)
    print(f"oscillation: {len(flow['t'])} steps, flow rate off by {100 * worst:.2f} % of its amplitude")
    assert worst < 0.01


def switched_off():
    """The flow does not rise once the pressure is gone."""
    flow = run("off", {"patches_inlet_pressure": "0,1\n0.999,1\n1,0\n2,0\n"}, patches_inlet_type="pressure",
               patches_outlet_type="pressure", fluid_viscosity=0.1, time_end=2)
    after = [q for t, q in zip(flow["t"], flow["flow_rate_outlet"]) if t >= 1]
    print(f"switched off: flow rate {after[0]:.4f}, at the end {after[-1]:.4f}")
    assert all(b <= a for a, b in zip(after, after[1:])) and after[-1] < 0.5 * after[0]


def saw():
    """Energy stays in bounds where the flow rate falls from 1 to 0 at once."""
    flow = run("saw", {"patches_inlet_flow_rate": "0,0\n1,1\n"}, tells="jump from 1 to 0", patches_inlet_type="flow_rate",
               patches_inlet_period=1, patches_outlet_type="pressure", fluid_viscosity=0.1, time_end=3)
    most = max(flow["kinetic_energy"])
    print(f"saw: {len(flow['t'])} steps, largest kinetic energy {most:.3f}")
    assert most < 0.7 * LENGTH  # that of a parabola is 0.6


def small_falls():
    """No short step that takes a part of a fall is followed by a long one that takes the rest."""
    for part in (0.95, 0.94, 0.925):
        flow = run("fall", {"patches_inlet_flow_rate": f"0,0\n0.5,1\n0.8,1\n0.80001,{part}\n2,{part}\n"},
                   patches_inlet_type="flow_rate", patches_outlet_type="pressure", fluid_viscosity=0.1, time_end=2)
        growth = max(b / a for a, b in zip(flow["dt"], flow["dt"][1:]))
        print(f"fall to {part}: a step is at most {growth:.2f} times as long as the one before")
        assert growth < 2


heartbeat()
oscillation()
switched_off()
saw()
small_falls()
