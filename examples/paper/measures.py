"""What the claims are measured by: the runs of a study, and numbers of one run."""
import csv
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "python"))
import fsi  # noqa: E402

class Missing(Exception):
    """A run that a claim needs is not complete."""


class Runs:
    """The runs of a study by sweep and point."""

    def __init__(self, preset, out):
        self.preset, self.out, self.known = preset, out, {}

    def __call__(self, sweep, point):
        folder = os.path.join(self.out, sweep, point)
        if folder not in self.known:
            if not os.path.exists(os.path.join(folder, "summary.json")):
                raise Missing(f"{sweep}/{point}")
            run = fsi.Run(folder)
            if run.summary.get("status") != "complete":
                raise Missing(f"{sweep}/{point}")
            self.known[folder] = run
        return self.known[folder]

    def tilt(self, angle):
        return self("tilt", f"solid_angle={angle}")

    def place(self):
        with open(os.path.join(HERE, "place.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file, skipinitialspace=True))
        return [self("place", "_".join(f"{k}={v}" for k, v in row.items())) for row in rows]

    def thick(self, ratio):
        if ratio == "3":
            return self.tilt(45)
        return self("thickness", {"11/5": "solid_major_radius=0.275_solid_minor_radius=0.125",
                                  "13/3": "solid_major_radius=0.325_solid_minor_radius=0.075"}[ratio])

    def soft(self, modulus):
        return self.tilt(45) if modulus == 10 else self("modulus", f"solid_shear_modulus={modulus}")

    def shape(self, name, throat=6):
        return self(f"throat-{throat}", name)


def at(run, column, time, table="solid"):
    """The value of a column at a time."""
    data = run.tables[table]
    return float(np.interp(time, data["t"], data[column]))


def end(run, column, table="solid"):
    return float(run.tables[table][column][-1])


def turned(run):
    """Degrees by which the axis has turned about z since the start, over time; the axis has no sign."""
    solid = run.tables["solid"]
    angle = 0.5 * np.unwrap(2 * np.arctan2(solid["ny"], solid["nx"]))
    return np.degrees(angle - angle[0])


def psi(run, start):
    """The angle of the axis to x over time, which goes on past 90 degrees; `start` at first."""
    angle = turned(run)
    return start + angle * (1 if angle[np.argmax(abs(angle))] >= 0 else -1)


def smooth(values, times, over=1.0):
    """The mean over a stretch of time about each time."""
    count = max(1, int(round(over / np.median(np.diff(times)))))
    padded = np.pad(values, (count // 2, count - 1 - count // 2), mode="edge")
    return np.convolve(padded, np.ones(count) / count, mode="valid")


def first_time(times, there):
    """The first of the times at which something is there; infinite where it never is."""
    found = np.flatnonzero(there)
    return float(times[found[0]]) if len(found) else float("inf")


def peaks(values, least):
    """Number of maxima that stand out by at least `least` on both sides."""
    found, low, high, rising = 0, values[0], values[0], True
    for value in values[1:]:
        high, low = max(high, value), min(low, value)
        if rising and value < high - least:
            found, rising, low = found + 1, False, value
        elif not rising and value > low + least:
            rising, high = True, value
    return found


def listed(pairs, form="{:.3f}"):
    return ", ".join(f"{name} {form.format(value)}" for name, value in pairs)


def rises(values):
    values = list(values)
    return all(a < b for a, b in zip(values, values[1:]))


def gradient(run):
    """The mean pressure gradient of the last unit of time."""
    flow = run.tables["flow"]
    return float(np.mean(flow["pressure_gradient"][flow["t"] > flow["t"][-1] - 1]))


def loss(runs, name, throat=6):
    """The largest part of the empty vessel's flow, at the same time, that a body keeps back."""
    flow, empty = runs.shape(name, throat).tables["flow"], runs.shape("empty", throat).tables["flow"]
    rate = np.interp(flow["t"], empty["t"], empty["flow_rate"])
    late = flow["t"] > 0.5
    return float(np.max(1 - flow["flow_rate"][late] / rate[late]))


def leaves(run):
    """When the body has left; infinite where it has not."""
    solid = run.tables["solid"]
    return first_time(solid["t"], solid["volume"] < 0.5 * solid["volume"][0])
