"""Figures 4 to 8, S4 and S5: the way, the angle and the shape of a ring in the pipe."""
import os

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

from figures_parts import (Missing, bar, body, column, dashes, empty, head, legend_below, legend_beside,
                           lines, nearest, picture, plain)
from fsi import scene, surfaces

SHOWN = (0, 45, 90)  # angles at the start whose shapes are shown over time
SIDES = {"side view": ((0, 0, 1), (0, 1, 0)), "top view": ((0, 1, 0), (0, 0, -1))}
MEAN = "mean over one unit of time"
# Columns of solid.csv, and their names in the figures.
BENDING = ("bending_meridian", "bending_prime"), ("meridian", "prime vertical")
OUTLINES = ("aspect_inner", "aspect_outer"), ("inner", "outer")


def figure_4(runs):
    """The surface of the ring that starts at 45 degrees, and the angles of all rings."""
    tilt, run = runs.family("tilt"), runs.run("tilt", "solid_angle=45")
    figure = plt.figure(figsize=(10.5, 7.4), layout="constrained")
    above, below = figure.subfigures(2, 1, height_ratios=(1.25, 1))
    _surfaces(above, run, runs)
    axes = below.subplots(1, 2)
    for ax, letter, name, members in ((axes[0], "B", "the tilt", tilt),
                                      (axes[1], "C", "the place", runs.family_or_none("place"))):
        head(ax, letter, f"angle of the axis to x, by {name} at the start")
        if not members:
            empty(ax, "no run yet")
            continue
        lines(ax, members, ["turn"])
        ax.set_ylabel(r"$\psi$ [°]")
        ax.set_ylim(-4, max(100, ax.get_ylim()[1]))
        ax.set_yticks(np.arange(0, ax.get_ylim()[1], 15 if ax.get_ylim()[1] < 120 else 30))
        legend_beside(ax, r"$\psi_0$ = 0" if letter == "C" else None)
    return figure


def _surfaces(figure, run, runs):
    """The body at all times of field files, up to five, from the side and from above."""
    if run is None or not run.items:
        ax = figure.subplots()
        head(ax, "A", r"surface, $\psi_0$ = 45°")
        empty(ax, "no run yet")
        return
    numbers = sorted({nearest(run, time) for time in (0, 5, 10, 15, 20)})
    axes = figure.subplots(2, 5, squeeze=False)
    for ax in axes.flat:
        plain(ax)
    snapshots = list(run.snapshots(numbers))
    bodies = [body(run, snapshot, ("stretch",)) for snapshot in snapshots]
    top = max(np.percentile(surface.values["stretch"], 99) for surface in bodies)
    colours = scene.Colours("YlOrRd", 1, max(top, 1.01), r"largest stretch $\lambda_1$", "max")
    for i, (snapshot, surface) in enumerate(zip(snapshots, bodies)):
        layer = scene.painted(surface, colours(surface.values["stretch"]))
        x = 0.5 * (surface.points[:, 0].min() + surface.points[:, 0].max())
        for row, (towards, up) in enumerate(SIDES.values()):
            shown = picture([layer], towards, up, ((x, 0.5, 0.5), 1.1, 1.04), 420, runs.renderer)
            axes[row, i].imshow(shown, extent=(-0.55, 0.55, -0.02, 1.02))
            axes[row, i].hlines((0, 1), -0.55, 0.55, color="0.4", linewidth=1.2)
        axes[0, i].set_title(f"$t^*$ = {snapshot.time:g}", fontsize=9)
    for row, words in enumerate(SIDES):
        axes[row, 0].set_ylabel(words)
    figure.suptitle(r"$\bf{A}$  surface $\alpha$ = 0.5, $\psi_0$ = 45°; the flow goes to the right", x=0.01,
                    ha="left", fontsize=9.5)
    bar(figure, axes, colours, shrink=0.6, aspect=25)


def figure_5(runs):
    """The way and the velocity of the rings over time, by their tilt and by their place at the start."""
    families = [runs.family("tilt"), runs.family_or_none("place")]
    figure, axes = plt.subplots(2, 3, figsize=(11.5, 5.8), layout="constrained")
    panels = (("y", "height $y_c$ of the centroid"), ("ux", "velocity $u_x$"), ("uy", "velocity $u_y$"))
    for row, members in zip(axes, families):
        for ax, (name, words) in zip(row, panels):
            head(ax, "ABCDEF"[list(axes.flat).index(ax)], words)
            if not members:
                empty(ax, "no run yet")
                continue
            lines(ax, members, [name])
        if members:
            legend_beside(row[-1], r"$\psi_0$ = 0" if row is axes[1] else None)
    return figure


def late(run, name):
    """Mean and deviation of a column over the last quarter of its time."""
    time, values = column(run, name)
    values = values[time >= 0.75 * time[-1]]
    return (np.nan, np.nan) if np.isnan(values).all() else (np.nanmean(values), np.nanstd(values))


def shape_over_time(ax, members, names, words):
    """Columns of the ring's shape over time, as moving means."""
    lines(ax, members, names, width=1.0)
    dashes(ax, words, MEAN)


def shape_by_tilt(ax, members, names, words):
    """Columns of the ring's shape over the last quarter of the time, against the tilt at the start.

    Runs that are far behind the others are left out.
    """
    ends = [member.run.tables["solid"]["t"][-1] for member in members]
    members = [member for member, end in zip(members, ends) if end > 0.9 * max(ends)]
    for name, word, mark, shade in zip(names, words, "os", ("tab:blue", "tab:orange")):
        values = np.array([late(member.run, name) for member in members])
        ax.errorbar([member.value for member in members], values[:, 0], values[:, 1], color=shade,
                    marker=mark, markersize=5, linestyle="-", linewidth=0.8, capsize=2.5,
                    fillstyle="full" if mark == "o" else "none", label=word)
    ax.set_xlabel(r"$\psi_0$ [°]")
    ax.set_xlim(-4, 94)
    ax.set_xticks(range(0, 91, 15))
    ax.legend(fontsize=8)


def of_rings(runs):
    """The family `tilt`, and of it those that are shown over time."""
    members = [member for member in runs.family("tilt") if member.run.items]
    if not members:
        raise Missing(os.path.join(runs.out, "tilt"))
    return members, [member for member in members if member.value in SHOWN] or members


def figure_6(runs):
    """The sections of the tubes of the rings: outlines at the end, and their aspect ratios."""
    members, shown = of_rings(runs)
    high = 1.1 + 9.2 / len(members), 5.6  # a ring takes its part of the width
    figure = plt.figure(figsize=(10.5, sum(high)), layout="constrained")
    above, below = figure.subfigures(2, 1, height_ratios=high)
    _sections(above.subplots(2, 1), members)
    axes = below.subplots(2, 2)
    for row, letters, names in ((axes[0], "CD", ("forward", "back")), (axes[1], "EF", ("right", "left"))):
        columns = ["aspect_" + name for name in names]
        shape_over_time(row[0], shown, columns, names)
        shape_by_tilt(row[1], members, columns, names)
        head(row[0], letters[0], "aspect ratio of the sections")
        head(row[1], letters[1], "the same, mean over the last quarter of the time")
    legend_below(below, axes[0, 0])
    return figure


def frame_of(run, time):
    """Unit vectors zeta, eta and xi of a ring as rows: xi its axis, eta downstream where it is tilted."""
    solid = run.tables["solid"]
    at = min(np.searchsorted(solid["t"], time), len(solid["t"]) - 1)
    xi = np.array([solid[name][at] for name in ("nx", "ny", "nz")])
    zeta = np.array([0, 0, 1.0]) if abs(xi[2]) < 0.99 else np.array([0, 1.0, 0])
    zeta -= (zeta @ xi) * xi
    zeta /= np.linalg.norm(zeta)
    return np.array([zeta, np.cross(xi, zeta), xi])


def _sections(axes, members):
    """Outlines of the rings in their two planes at the last field file, side by side."""
    titles = (("A", "sections with the meridian plane at the last field file; to the right the side that was "
               "downstream at the start; dashed: the start"), ("B", "the same with the prime vertical plane"))
    for ax, (letter, words) in zip(axes, titles):
        head(ax, letter, words)
        plain(ax)
        ax.set_aspect("equal")
        ax.set_xlim(-0.5, len(members) - 0.5)
        ax.set_ylim(-0.3, 0.14)
    for place, member in enumerate(members):
        run = member.run
        snapshot = run.snapshot(-1)
        surface, frame = body(run, snapshot), frame_of(run, snapshot.time)
        local = surfaces.Surface((surface.points - run.centroid(snapshot.time)) @ frame.T, surface.triangles)
        for ax, across in zip(axes, (1, 0)):
            segments = surfaces.section(local, 1 - across, 0.0)[..., [across, 2]] + [place, 0]
            ax.add_collection(LineCollection(segments, colors=[member.colour], linewidths=1.6))
            for side in (-1, 1):
                ax.add_patch(_at_start(run, place, side))
            ax.plot(place, 0, "+", color="0.4", markersize=5)
            ax.text(place, -0.28, f"{member.label}, $t^*$ = {snapshot.time:g}", ha="center", fontsize=7.5)
            ax.axvline(place + 0.5, color="0.85", linewidth=0.8)


def _at_start(run, place, side):
    """The circle of a section at the start."""
    middle = (place + side * float(run.options["solid_major_radius"]), 0)
    return plt.Circle(middle, float(run.options["solid_minor_radius"]), fill=False, edgecolor="0.65",
                      linewidth=0.7, linestyle="--", zorder=3)


def figure_7(runs):
    """Bending angles and aspect ratios of the outlines of the rings, over time and by their tilt."""
    members, shown = of_rings(runs)
    figure, axes = plt.subplots(2, 2, figsize=(10.5, 6.4), layout="constrained")
    rows = (("BC", "bending angle [°]", *BENDING), ("EF", "aspect ratio of the outlines", *OUTLINES))
    for row, (letters, title, names, words) in zip(axes, rows):
        shape_over_time(row[0], shown, names, words)
        shape_by_tilt(row[1], members, names, words)
        head(row[0], letters[0], title)
        head(row[1], letters[1], "the same, mean over the last quarter of the time")
    legend_below(figure, axes[0, 0])
    return figure


def deformation(runs, names, letters):
    """A row for each family: the height of the centroid, bending angles, aspect ratios of the outlines."""
    families = {name: runs.family_or_none(name) for name in names}
    if not any(families.values()):
        raise Missing(" or ".join(os.path.join(runs.out, name) for name in names))
    figure, axes = plt.subplots(len(names), 3, squeeze=False, layout="constrained",
                                figsize=(11.5, 0.4 + 2.8 * len(names)))
    titles = ("height $y_c$ of the centroid", "bending angle [°]", "aspect ratio of the outlines")
    letter = iter(letters)
    for row, members in zip(axes, families.values()):
        for ax, title in zip(row, titles):
            head(ax, next(letter), title)
            if not members:
                empty(ax, "no run yet")
        if members:
            lines(row[0], members, ["y"])
            shape_over_time(row[1], members, *BENDING)
            shape_over_time(row[2], members, *OUTLINES)
            legend_beside(row[2])
    return figure


def figure_8(runs):
    """What the thickness and the stiffness of a ring do to its way and its shape."""
    return deformation(runs, ("thickness", "modulus"), "ABCDEF")


def beside(runs, name):
    """One family: the height of the centroid, the angle, and the aspect ratios of the outlines."""
    members = runs.family(name)
    figure, axes = plt.subplots(1, 3, figsize=(11.5, 3.6), layout="constrained")
    titles = ("height $y_c$ of the centroid", r"angle $\psi$ of the axis to x [°]",
              "aspect ratio of the outlines")
    for ax, letter, title in zip(axes, "ABC", titles):
        head(ax, letter, title)
    lines(axes[0], members, ["y"])
    lines(axes[1], members, ["turn"])
    shape_over_time(axes[2], members, *OUTLINES)
    legend_beside(axes[2])
    return figure


def figure_s4(runs):
    """What the viscosity of a ring does."""
    return beside(runs, "viscosity")


def figure_s5(runs):
    """What the size of a ring does."""
    return beside(runs, "size")
