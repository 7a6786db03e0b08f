"""Figures 9 and 10: the flow about a ring as the ring sees it, and the pressure gradient that drives it."""
import os

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

from figures_parts import (Missing, body, empty, fsi, head, lines, nearest, plain, render, style)
from fsi import surfaces, views

HALF = 1.25  # of the length of pipe that is shown about a ring
LEVEL = 0.5  # of Q
TOP = 0.8  # of the colours of the relative speed
EMPTY = 0.16  # the pressure gradient of the pipe without a ring
SETTLED = 3.0  # time from which on the panels of the pressure gradient show all of it
SEEN = ((0, 10), (45, 10), (45, 20), (90, 10))  # angles at the start and times


def drift(snapshot):
    """The mean velocity of the solid."""
    return np.average(snapshot["u"], axis=0, weights=snapshot["alpha"] * snapshot.mesh.volumes)


def about_ring(run, snapshot):
    """x from the ring's centre, y, and the velocity as the ring sees it, on the plane z = 0.5."""
    plane = fsi.cut(snapshot, "z", 0.5)
    x, y, velocity = plane.grid(plane["u"] - drift(snapshot), 500)
    x, velocity = x[:-1], velocity[:, :-1]  # the two ends of a period are one place
    step = x[1] - x[0]
    count = int(round(HALF / step))
    place = int(round((run.centroid(snapshot.time)[0] - x[0]) / step))
    numbers = np.arange(-count, count + 1)
    return numbers * step, y, velocity[:, (place + numbers) % len(x)]


def relative_map(ax, run, number):
    """The relative speed with streamlines and the outline of the ring; returns what a bar needs."""
    snapshot = run.snapshot(number)
    x, y, velocity = about_ring(run, snapshot)
    shades = ax.imshow(np.ma.sqrt((velocity**2).sum(axis=2)), extent=(x[0], x[-1], y[0], y[-1]),
                       origin="lower", vmin=0, vmax=TOP, interpolation="bilinear")
    ax.streamplot(x, y, velocity[..., 0], velocity[..., 1], color=(1, 1, 1, 0.7), linewidth=0.6,
                  arrowsize=0.6, density=(1.6, 0.9))
    surface = body(run, snapshot)
    segments = surfaces.section(surface, 2, 0.5)[..., :2] - [run.centroid(snapshot.time)[0], 0]
    ax.add_collection(LineCollection(segments, colors=[style.SOLID], linewidths=1.8))
    ax.set_aspect("equal")
    ax.set_xlim(x[0], x[-1])
    ax.set_ylim(0, 1)
    ax.set_xlabel(r"$x - x_c$")
    ax.set_ylabel("y")
    ax.grid(False)
    return shades


def seen(runs):
    """(angle, run, number of the field file) of what figure 9 shows; the last one for a time not reached."""
    found = []
    for angle, time in SEEN:
        run = runs.run("tilt", f"solid_angle={angle}")
        number = nearest(run, time) if run else None
        if number and (angle, run, number) not in found:
            found.append((angle, run, number))
    return found


def figure_9(runs):
    """Relative speed with streamlines on the plane z = 0.5, and the vortices around the ring."""
    shown = seen(runs)
    if not shown:
        raise Missing(os.path.join(runs.out, "tilt"))
    figure = plt.figure(figsize=(10.5, 2.75 * len(shown) + 0.4), layout="constrained")
    axes = figure.subplots(len(shown), 2, squeeze=False, width_ratios=(1.15, 1))
    for (left, right), letters, (angle, run, number) in zip(axes, ("AE", "BF", "CG", "DH"), shown):
        words = rf"$\psi_0$ = {angle}°, $t^*$ = {run.times[number]:g}"
        shades = relative_map(left, run, number)
        head(left, letters[0], words)
        _vortices(right, run, number, runs.renderer)
        head(right, letters[1], f"{words}: surface Q = {LEVEL:g}")
    figure.colorbar(shades, ax=axes[:, 0], label=r"relative speed $|u - u_c|$", location="bottom", shrink=0.6,
                    aspect=35, pad=0.01)
    return figure


def _vortices(ax, run, number, renderer):
    look = views.Look(colour="none", parts=("wall", "body"), q=LEVEL, renderer=renderer)
    layers, camera, _ = views.build(run, run.snapshot(number), look)
    width = 900
    shown = render.image(layers, camera, width, int(width * camera.height / camera.width), renderer)
    ax.imshow(shown)
    plain(ax)


def figure_10(runs):
    """The pressure gradient over time, and the flow about a thick and a thin ring."""
    families = {name: runs.family_or_none(name) for name in ("tilt", "thickness", "modulus")}
    if not any(families.values()):
        raise Missing(os.path.join(runs.out, "tilt"))
    rings = [member for member in families["thickness"] if member.run.items][:3]
    figure = plt.figure(figsize=(11.5, 5.4 if rings else 3.2), layout="constrained")
    above, *below = figure.subfigures(2, 1, height_ratios=(1.6, 1)) if rings else [figure]
    titles = ("tilt", "R/r", "modulus")
    for ax, letter, title, members in zip(above.subplots(1, 3), "ABC", titles, families.values()):
        head(ax, letter, f"pressure gradient, by {title}")
        if members:
            _gradients(ax, members)
        else:
            empty(ax, "no run yet")
    for part in below:
        axes = part.subplots(1, len(rings), squeeze=False)[0]
        for ax, member in zip(axes, rings):
            shades = relative_map(ax, member.run, -1)
            head(ax, "D" if ax is axes[0] else "", f"{member.label}, $t^*$ = {member.run.times[-1]:g}")
        part.colorbar(shades, ax=axes, label=r"$|u - u_c|$", shrink=0.7)
    return figure


def _gradients(ax, members):
    lines(ax, members, ["pressure_gradient"], "flow")
    ax.axhline(EMPTY, color="0.45", linestyle="--", linewidth=1, label="empty pipe")
    tables = [member.run.tables["flow"] for member in members]
    late = np.concatenate([[EMPTY, 1.08 * EMPTY], *(flow["pressure_gradient"][flow["t"] > SETTLED]
                                                    for flow in tables)])
    room = 0.1 * np.ptp(late)
    rows = len(members) // 2 + 1  # of the legend
    ax.set_ylim(late.min() - room, late.max() + rows * room)
    ax.legend(fontsize=7.5, ncol=2, loc="upper right", borderaxespad=0)
