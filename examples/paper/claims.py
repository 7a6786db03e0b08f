"""The claims of [Matsumiya25], one by one: what the study measures, and whether the claim holds.

claims.write(preset, out) makes OUT/claims.md of the runs that are complete.
"""
import csv
import os
import sys
from dataclasses import dataclass
from typing import Callable

import numpy as np

import study
from measures import (Missing, Runs, at, end, first_time, gradient, leaves, listed, loss, moving_mean, peaks, psi,
                      rises, turned)

INCLINED, EMPTY = (15, 30, 45, 60), 0.16
SHAPES = ("torus", "disk", "sphere", "ellipsoid")


@dataclass
class Claim:
    figure: str
    text: str
    test: Callable  # of the runs: (what is measured, whether it holds)


CLAIMS = []


def claim(figure, text):
    def note(test):
        CLAIMS.append(Claim(figure, text, test))
        return test
    return note


# The flow and the disc

@claim("2", "the error of Poiseuille flow falls with second order")
def _flow(runs):
    errors = []
    for n in runs.preset.flow:
        snapshot = runs(f"flow-{n}", "empty").snapshot(-1)
        centre = snapshot.mesh.centres()
        radius = (centre[:, 1] - 0.5)**2 + (centre[:, 2] - 0.5)**2
        error = snapshot["u"][:, 0] - (1 - 4 * radius)
        errors.append(np.sqrt(np.average(error**2, weights=snapshot.mesh.volumes)))
    order = -np.polyfit(np.log(runs.preset.flow), np.log(errors), 1)[0]
    return f"L2 {listed(zip(runs.preset.flow, errors), '{:.1e}')}: order {order:.2f}", order > 1.9


@claim("3", "the way of the disc's centre converges with the mesh, of first order or better")
def _disc(runs):
    reference = os.path.join(study.HERE, "..", "..", "tests", "verification", "data",
                             "softdisc_reference_G0.1.csv")
    if not os.path.exists(reference):
        raise Missing("the reference of the disc")
    with open(reference, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    columns = dict(zip(rows[0], np.array(rows[1:], float).T))
    errors = []
    for n in runs.preset.disc:
        solid = runs(f"disc-{n}", "benchmark").tables["solid"]
        away = [np.interp(columns["t"], solid["t"], solid[axis]) - columns[axis + "c_ref"] for axis in "xy"]
        errors.append(np.sqrt(np.mean(away[0]**2 + away[1]**2)))
    order = -np.polyfit(np.log(runs.preset.disc), np.log(errors), 1)[0]
    return f"L2 {listed(zip(runs.preset.disc, errors), '{:.1e}')}: order {order:.2f}", order > 1


# Turning

@claim("4A", "a torus at 45 degrees turns to about 80 by t = 20, never back")
def _base(runs):
    angle = psi(runs.tilt(45))
    back = np.max(np.maximum.accumulate(angle) - angle)
    return f"{angle[-1]:.1f} degrees, back by {back:.2f}", abs(angle[-1] - 80) < 5 and back < 0.5


@claim("4B", "15, 30, 45 and 60 degrees end near 80")
def _inclined(runs):
    ends = [psi(runs.tilt(a))[-1] for a in INCLINED]
    return listed(zip(INCLINED, ends), "-> {:.1f}"), all(abs(e - 80) < 5 for e in ends)


@claim("4B", "75 degrees stays, with slight fluctuations")
def _seventyfive(runs):
    angle = psi(runs.tilt(75))
    return f"{angle.min():.1f} to {angle.max():.1f}, at the end {angle[-1]:.1f}", \
        abs(angle - 75).max() < 7


@claim("4B", "90 degrees stays")
def _ninety(runs):
    away = abs(turned(runs.tilt(90))).max()
    return f"turns by {away:.2f} degrees at most", away < 0.5


@claim("4B", "0 degrees stays at first, then begins to turn")
def _zero(runs):
    run = runs.tilt(0)
    angle, times = abs(turned(run)), run.tables["solid"]["t"]
    starts = first_time(times, angle > 2)
    return f"{np.interp(10, times, angle):.3f} degrees at t = 10, {angle[-1]:.2f} at 20; " \
        f"more than 2 from t = {starts:.1f} on", np.isfinite(starts) and starts > 2


@claim("4B", "inclined tori wait for about two units of time, those off the centre do not")
def _waiting(runs):
    def start(run):
        return first_time(run.tables["solid"]["t"], abs(turned(run)) > 2)
    centre, off = [start(runs.tilt(a)) for a in INCLINED], [start(run) for run in runs.place()]
    return f"2 degrees turned at {listed(zip(INCLINED, centre), '{:.2f}')}; off the centre " \
        f"{', '.join(f'{s:.2f}' for s in off)}", \
        min(centre) > 1.5 and max(centre) < 3 and max(off) < 1


@claim("4C", "tori off the centre at 0 degrees end near 80")
def _off_centre(runs):
    ends = [psi(run)[-1] for run in runs.place()]
    return ", ".join(f"{e:.1f}" for e in ends), all(abs(e - 80) < 5 for e in ends)


# Place and velocity

@claim("5A", "inclined tori leave the axis and come to rest off it; 0 and 90 degrees stay on it")
def _place(runs):
    inclined = [at(runs.tilt(a), "y", 20) - 0.5 for a in INCLINED]
    pace = [abs(at(runs.tilt(a), "uy", 20)) for a in INCLINED]
    still = [abs(runs.tilt(a).tables["solid"]["y"] - 0.5).max() for a in (0, 90)]
    return f"off by {listed(zip(INCLINED, inclined), '{:+.4f}')}, u_y there up to {max(pace):.1e}; " \
        f"0 and 90: {still[0]:.1e}, {still[1]:.1e}", min(map(abs, inclined)) > 5e-3 and max(still) < 1e-3


@claim("5B", "u_x of 15, 30, 45 degrees has a maximum before t = 1, that of 60 and 75 has none")
def _early(runs):
    def falls(run):
        solid = run.tables["solid"]
        early = solid["ux"][solid["t"] <= 1]
        later = solid["ux"][(solid["t"] > 0.1) & (solid["t"] <= 3)]
        return float(early.max() - later[np.argmax(later):].min()) if early.max() >= later.max() else 0.0
    found = [(a, falls(runs.tilt(a))) for a in (15, 30, 45, 60, 75)]
    return "falls after it by " + listed(found, "{:.4f}"), \
        all((drop > 1e-3) == (a <= 45) for a, drop in found)


@claim("5B", "the largest u_x of inclined tori is above that of the horizontal one")
def _fastest(runs):
    inclined = [runs.tilt(a).tables["solid"]["ux"].max() for a in INCLINED]
    horizontal = runs.tilt(90).tables["solid"]["ux"].max()
    return f"{listed(zip(INCLINED, inclined))}; 90 {horizontal:.3f}", max(inclined) > horizontal


@claim("5F", "the largest u_y of tori off the centre is above that of inclined ones")
def _across(runs):
    off = [abs(run.tables["solid"]["uy"]).max() for run in runs.place()]
    inclined = [abs(runs.tilt(a).tables["solid"]["uy"]).max() for a in INCLINED]
    return f"{', '.join(f'{v:.4f}' for v in off)}; inclined {listed(zip(INCLINED, inclined), '{:.4f}')}", \
        max(off) > max(inclined)


# Shape

@claim("6", "tori at 0 and 90 degrees do not deform")
def _undeformed(runs):
    names = ["aspect_" + side for side in ("forward", "back", "right", "left", "inner", "outer")]
    least = {a: min(end(runs.tilt(a), name) for name in names) for a in (0, 90)}
    return "smallest aspect at t = 20 " + listed(least.items()), min(least.values()) > 0.97


@claim("6", "at 45 degrees the forward section flattens more than the one behind")
def _forward(runs):
    means = []
    for side in ("forward", "back"):
        solid = runs.tilt(45).tables["solid"]
        means.append(np.mean(solid["aspect_" + side][solid["t"] > 15]))
    return f"mean from t = 15 on: {means[0]:.3f}, {means[1]:.3f}", means[0] < means[1] - 0.005


@claim("7B", "a torus at 45 degrees bends first, then turns, then is drawn out")
def _order(runs):
    solid = runs.tilt(45).tables["solid"]
    half = []
    for values in (-solid["bending_prime"], turned(runs.tilt(45)), 1 - solid["aspect_outer"]):
        values = abs(moving_mean(solid["t"], values - values[0]))
        half.append(first_time(solid["t"], values > 0.5 * values[solid["t"] <= 20].max()))
    return "half of the largest at t = " + ", ".join(f"{t:.1f}" for t in half), rises(half)


@claim("7C", "the bending at t = 20 grows with the angle at the start")
def _bending(runs):
    angles = (15, 30, 45, 60, 75)
    ends = [max(abs(end(runs.tilt(a), "bending_meridian")), abs(end(runs.tilt(a), "bending_prime")))
            for a in angles]
    return listed(zip(angles, ends), "{:.1f}"), rises(ends)


@claim("8", "the thinnest torus and the softest one are drawn out most")
def _drawn(runs):
    thin = {r: end(runs.thick(r), "aspect_outer") for r in ("11/5", "3", "13/3")}
    soft = {g: end(runs.soft(g), "aspect_outer") for g in (10, 3, 1)}
    return f"outer aspect: R/r {listed(thin.items())}; G* {listed(soft.items())}", \
        rises(list(thin.values())[::-1]) and rises(list(soft.values())[::-1])


@claim("8", "only the bending of the thinnest torus overshoots")
def _overshoot(runs):
    found = {}
    for ratio in ("11/5", "3", "13/3"):
        solid = runs.thick(ratio).tables["solid"]
        size = abs(moving_mean(solid["t"], solid["bending_prime"]))
        found[ratio] = float(size.max() / size[-1] - 1)
    return "largest over last, less 1: " + listed(found.items(), "{:.2f}"), \
        found["13/3"] > 0.05 > max(found["11/5"], found["3"])


@claim("8A", "after t = 8 the torus with R/r = 3 is nearest to the axis")
def _nearest(runs):
    away = {r: abs(at(runs.thick(r), "y", 20) - 0.5) for r in ("11/5", "3", "13/3")}
    return "off by " + listed(away.items(), "{:.4f}"), away["3"] == min(away.values())


@claim("S4", "a torus of ten times the viscosity is nearer to the wall and a little less deformed")
def _viscous(runs):
    thick, base = runs("viscosity", "solid_viscosity=0.1"), runs.tilt(45)
    away = [abs(at(run, "y", 20) - 0.5) for run in (thick, base)]
    outer, bend = ([end(run, c) for run in (thick, base)] for c in ("aspect_outer", "bending_prime"))
    return f"off by {away[0]:.4f} against {away[1]:.4f}; outer aspect {outer[0]:.3f}, {outer[1]:.3f}; " \
        f"bending {bend[0]:.1f}, {bend[1]:.1f}", away[0] > away[1] and outer[0] > outer[1]


@claim("S5", "a torus of half the size ends farther from the axis")
def _small(runs):
    small = runs("size", "solid_major_radius=0.15_solid_minor_radius=0.05")
    away = [abs(at(run, "y", 20) - 0.5) for run in (small, runs.tilt(45))]
    return f"off by {away[0]:.4f} against {away[1]:.4f}", away[0] > away[1]


@claim("4A", "the scheme of the paper, B by its transport, gives the angle (not in the paper)")
def _scheme(runs):
    found = {"log B": runs.tilt(45)}
    for kind in ("reference_map", "left_cauchy_green"):
        found[kind] = runs("kinematics", f"solid_kinematics={kind}")
    return "; ".join(f"{name} {psi(run)[-1]:.1f} degrees, outer aspect {end(run, 'aspect_outer'):.3f}, "
                     f"bending {end(run, 'bending_prime'):.1f}" for name, run in found.items()), \
        abs(psi(found["left_cauchy_green"])[-1] - 80) < 5


# Flow and pressure

@claim("9", "the vortices about the torus at 45 degrees fade")
def _vortices(runs):
    volumes = []
    for number, time in enumerate(runs.tilt(45).times):
        if time > 0:
            snapshot = runs.tilt(45).snapshot(number)
            outside = (snapshot["alpha"] < 0.5) & (snapshot["Q"] > 0.5)
            volumes.append((f"{time:.0f}", float(snapshot.mesh.volumes[outside].sum())))
    return "fluid with Q > 0.5: t = " + listed(volumes, "{:.4f}"), volumes[-1][1] < 0.8 * volumes[0][1]


@claim("10A", "the pressure gradient at t = 20 is largest for 0 degrees, inclined tori have less than 90")
def _gradients(runs):
    found = {a: gradient(runs.tilt(a)) for a in (0, *INCLINED, 75, 90)}
    inclined = [found[a] for a in INCLINED]
    return listed(found.items(), "{:.4f}"), found[0] == max(found.values()) and \
        max(inclined) < found[90] and min(found.values()) > EMPTY


@claim("10B", "the softer torus has the smaller pressure gradient")
def _soft_gradient(runs):
    found = {g: gradient(runs.soft(g)) for g in (1, 3, 10)}
    return "G* " + listed(found.items(), "{:.4f}"), rises(found.values())


@claim("10C", "the thinner torus has the smaller pressure gradient")
def _thin_gradient(runs):
    found = {r: gradient(runs.thick(r)) for r in ("13/3", "3", "11/5")}
    return "R/r " + listed(found.items(), "{:.4f}"), rises(found.values())


# The throat

@claim("11", "the torus passes the throat")
def _torus_passes(runs):
    left = leaves(runs.shape("torus"))
    return f"half of it has left at t = {left:.2f}", np.isfinite(left)


@claim("11", "disk, sphere and ellipsoid end in divergence (a failure of the method; all should pass)")
def _others_pass(runs):
    left = [(name, leaves(runs.shape(name))) for name in SHAPES[1:]]
    return "all pass, half out at t = " + listed(left, "{:.2f}"), \
        not all(np.isfinite(time) for _, time in left)


@claim("11D", "the pressure span of the torus has two maxima")
def _two_peaks(runs):
    flow = runs.shape("torus").tables["flow"]
    span = moving_mean(flow["t"], flow["pressure_span"], 0.3)[flow["t"] > 0.5]
    count = peaks(span, 0.05 * (span.max() - span.min()))
    return f"{count} maxima, the largest {span.max():.2f}", count == 2


@claim("11E", "of one surface the torus keeps back least of the flow, the ellipsoid less than the sphere")
def _loss(runs):
    found = {name: loss(runs, name) for name in SHAPES}
    return listed(found.items()), found["torus"] == min(found.values()) and \
        found["ellipsoid"] < found["sphere"]


@claim("11E", "the same order with one volume (not in the paper)")
def _loss_by_volume(runs):
    names = ("torus", "small_disk", "small_sphere", "small_ellipsoid")
    found = {name: loss(runs, name) for name in names}
    return listed(found.items()), found["torus"] == min(found.values()) and \
        found["small_ellipsoid"] < found["small_sphere"]


@claim("11", "the throat may be shorter (not in the paper): all bodies pass 6, 3 and 1")
def _throats(runs):
    found = []
    for throat in study.THROATS:
        for name in (*SHAPES, "small_disk", "small_sphere", "small_ellipsoid"):
            run = runs.shape(name, throat)
            found.append((f"{throat} {name}", leaves(run)))
    return listed(found, "{:.2f}"), all(np.isfinite(time) for _, time in found)


def judged(each, runs):
    """What is measured of a claim, and whether it holds: yes, no, or open where a run is not complete."""
    try:
        measured, holds = each.test(runs)
    except Missing as missing:
        return f"{missing} is not complete", "open"
    return measured, "yes" if holds else "no"


def write(preset, out):
    """Writes OUT/claims.md; its path. Where the study of another preset stands beside OUT, it has columns too, so
    that one sees what the mesh changes."""
    above, studies = os.path.dirname(os.path.abspath(out)), {}
    for name, each in sorted(study.PRESETS.items(), key=lambda item: item[1] is not preset):
        folder = out if each is preset else os.path.join(above, name)
        if each is preset or any(os.path.isdir(os.path.join(folder, part)) for part in study.PIPE):
            studies[name] = Runs(each, folder)
    lines = ["| figure | claim | " + " | ".join(f"{name}: measured | holds" for name in studies) + " |",
             "|---" * (2 + 2 * len(studies)) + "|"]
    for each in CLAIMS:
        cells = [each.figure, each.text, *(word for runs in studies.values() for word in judged(each, runs))]
        lines.append("| " + " | ".join(cells) + " |")
    path = os.path.join(out, "claims.md")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    return path


if __name__ == "__main__":
    with open(write(study.PRESETS[sys.argv[1]], sys.argv[2]), encoding="utf-8") as written:
        print(written.read())
