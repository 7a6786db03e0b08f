"""What the claims are measured by: the runs of a study, and numbers of one run."""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "python"))
import fsi  # noqa: E402
import study  # noqa: E402


class Missing(Exception):
    """A run that a claim needs is not complete."""


def opened(preset, sweep, folder):
    """A run of a sweep, of both sides where half was run; None where a run on another mesh stands there.

    In a mesh that goes along, `ux` is the velocity in the pipe at rest, and all else that of the mesh's frame.
    """
    options = fsi.options(os.path.join(folder, "run.yaml"))
    of = next((each for each in study.sweeps(preset) if each.name == sweep), None)
    if of is None or os.path.basename(options.get("mesh", "")) != of.mesh:
        return None
    run = fsi.Mirrored(folder, "z", 0.5) if of.half else fsi.Run(folder)
    if "ux" in run.tables["solid"]:
        run.tables["solid"]["ux"] += float(options.get("flow_frame_velocity", 0))
    return run


class Runs:
    """The runs of a study by sweep and point."""

    def __init__(self, preset, out):
        self.preset, self.out, self.known = preset, out, {}

    def __call__(self, sweep, point):
        folder = os.path.join(self.out, sweep, point)
        if folder not in self.known:
            if not os.path.exists(os.path.join(folder, "summary.json")):
                raise Missing(f"{sweep}/{point}")
            run = opened(self.preset, sweep, folder)
            if run is None or run.summary.get("status") != "complete":
                raise Missing(f"{sweep}/{point}")
            self.known[folder] = run
        return self.known[folder]

    def tilt(self, angle):
        return self("tilt", f"solid_angle={angle}")

    def place(self):
        return [self("place", point) for point in study.points("place")]

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


def turn(solid):
    """The angle between axis and x in degrees, which grows past 90 and 180 where the ring turns on."""
    across = np.stack([solid["ny"], solid["nz"]], axis=1)
    passes = np.einsum("ij,ij->i", across[1:], across[:-1]) < 0  # the axis goes through x to the other side
    side = np.append(1, np.cumprod(np.where(passes, -1, 1)))
    return abs(np.degrees(np.unwrap(np.arctan2(side * np.linalg.norm(across, axis=1), solid["nx"]))))


def psi(run):
    """The angle of a run's axis to x over time, as `turn` has it."""
    return turn(run.tables["solid"])


def turned(run):
    """The degrees by which it has changed since the start."""
    return psi(run) - psi(run)[0]


def moving_mean(time, values, width=1.0):
    """Means over `width` of time about each, over less at the ends; NaN where there is no value."""
    known = np.isfinite(values)
    if known.sum() < 2:
        return values
    at, of = time[known], values[known]
    total = np.append(0, np.cumsum(0.5 * (of[1:] + of[:-1]) * np.diff(at)))
    low, high = (np.clip(at + part * width, at[0], at[-1]) for part in (-0.5, 0.5))
    found = np.full(len(values), np.nan)
    found[known] = (np.interp(high, at, total) - np.interp(low, at, total)) / (high - low)
    return found


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
