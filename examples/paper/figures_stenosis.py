"""Figure 11: bodies of several shapes on their way through a throat."""
import os

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

from figures_parts import (TIME, Missing, bar, empty, fsi, grid_lines, head, nearest, picture, plain, style,
                           time_axis)
from fsi import scene, surfaces, views

EYE = (0.4, 0.36, 1.0), (0, 1, 0)
SHAPES = ("torus", "disk", "sphere", "ellipsoid")
SMALL = ("torus", "small_disk", "small_sphere", "small_ellipsoid")  # with the volume of the torus
COLOURS = dict(zip(SHAPES + SMALL[1:], style.LINES[:4] + style.LINES[1:4]))
TORN = "X"  # the mark of a body that came apart
START = 1.0  # from then on flow rates are compared: before it both are near to 0


def words_of(shape):
    return shape.replace("small_", "")


def bodies_in(runs, sweep, shapes):
    """The runs of these shapes in a vessel, by name."""
    found = {shape: runs.run(sweep, shape) for shape in shapes}
    return {shape: run for shape, run in found.items() if run and run.tables["solid"]}


def figure_11(runs):
    """Shapes in the longest throat: the vessel, the bodies, pressure and flow rate over time."""
    sweep = runs.sweeps("stenosis")[0]
    large, small = (bodies_in(runs, sweep.name, shapes) for shapes in (SHAPES, SMALL))
    if not large:
        raise Missing(os.path.join(runs.out, sweep.name))
    vessel = runs.run(sweep.name, "empty")
    figure = plt.figure(figsize=(10.5, 12), layout="constrained")
    top, middle, below = figure.subfigures(3, 1, height_ratios=(0.75, 1.55, 2.1))
    _vessel(top.subplots(), next(iter(large.values())))
    _bodies(middle, large, runs.renderer)
    axes = below.subplots(2, 2)
    for row, letters, found, size in ((axes[0], "DE", large, "equal surfaces"),
                                      (axes[1], "FG", small, "equal volumes")):
        _over_time(row[0], found, "pressure_span", None)
        _over_time(row[1], found, "flow_rate", vessel)
        head(row[0], letters[0], f"largest difference of pressure, {size}")
        head(row[1], letters[1], f"flow rate through the outlet, {size}")
    return figure


def _vessel(ax, run):
    mesh = run.snapshot(0).mesh
    segments = grid_lines(mesh, 2, 0.5)[..., :2]
    ax.add_collection(LineCollection(segments, colors="0.45", linewidths=0.35))
    ax.set_aspect("equal")
    ax.set_xlim(mesh.low[0] - 0.05, mesh.high[0] + 0.05)
    ax.set_ylim(-0.05, 1.05)
    ax.set_xlabel("x")
    ax.set_ylabel("y")
    ax.grid(False)
    head(ax, "A", "the vessel and its mesh on the plane z = 0.5")


def gone(run):
    """The part of the body that has left, at the times of solid.csv."""
    solid = run.tables["solid"]
    return solid["volume_out"] / solid["volume"][0]


def peak(run):
    """The number of the field file nearest to the largest difference of pressure until the body leaves."""
    flow = run.tables["flow"]
    inside = np.interp(flow["t"], run.tables["solid"]["t"], gone(run)) < 0.01
    return nearest(run, flow["t"][np.argmax(np.where(inside, flow["pressure_span"], 0))])


def torn(run):
    """The time from which on the body is in pieces, before it leaves; None where it stays whole."""
    solid = run.tables["solid"]
    apart = np.flatnonzero((solid["pieces"] > 1) & (gone(run) < 0.01))
    return solid["t"][apart[0]] if len(apart) else None


def _bodies(figure, found, renderer):
    """Each body at the start and at the largest difference of pressure, in its stretch of the vessel."""
    axes = figure.subplots(2, 4)
    numbers = {shape: (0, peak(run)) for shape, run in found.items()}
    surface = {(shape, row): fsi.solid_surface(run.snapshot(numbers[shape][row]), ("stretch",))
               for shape, run in found.items() for row in (0, 1)}
    stretches = np.concatenate([s.values["stretch"] for s in surface.values() if "stretch" in s.values])
    top = max(np.percentile(stretches, 99), 1.01)
    colours = scene.Colours("YlOrRd", 1, top, r"largest stretch $\lambda_1$", "max")
    for ax in axes.flat:
        plain(ax)
    for place, (shape, run) in enumerate(found.items()):
        for row in (0, 1):
            snapshot = run.snapshot(numbers[shape][row])
            axes[row, place].imshow(_view(snapshot, surface[shape, row], colours, renderer))
            words = f"{shape}, $t^*$ = {snapshot.time:g}"
            head(axes[row, place], "BC"[row] if place == 0 else "", words)
    bar(figure, axes, colours, shrink=0.6, aspect=25)


def _view(snapshot, surface, colours, renderer):
    """A body in the stretch of the vessel about it."""
    middle = np.array([0.5 * (surface.points[:, 0].min() + surface.points[:, 0].max()), 0.5, 0.5])
    mesh = snapshot.mesh
    box = np.array([[middle[0] - 0.7, *mesh.low[1:]], [middle[0] + 0.7, *mesh.high[1:]]])
    wall = views.within(surfaces.wall(mesh), box, mesh)
    camera = scene.Camera(middle, np.array(EYE[0]), np.array(EYE[1]), 1, 1)
    layers = [scene.glass(wall, camera), scene.painted(surface, colours(surface.values["stretch"]))]
    return picture(layers, *EYE, (middle, 1.75, 1.35), 480, renderer)


def _over_time(ax, found, name, vessel):
    if not found:
        empty(ax, "no run yet")
        return
    for shape, run in found.items():
        flow, end = run.tables["flow"], torn(run)
        ax.plot(flow["t"], flow[name], color=COLOURS[shape], label=words_of(shape))
        if end is not None:
            ax.plot(end, np.interp(end, flow["t"], flow[name]), TORN, color=COLOURS[shape])
    if any(torn(run) is not None for run in found.values()):
        ax.plot([], [], TORN, color="0.3", label="in pieces from here on")
    if vessel:
        ax.plot(vessel.tables["flow"]["t"], vessel.tables["flow"][name], color="0.45", linestyle="--",
                label="empty vessel")
    time_axis(ax)
    ax.legend(fontsize=8)


def throats(runs):
    """Lowest flow rate and time at which half of a body has left, against the length of the throat."""
    sweeps = runs.sweeps("stenosis")
    figure, axes = plt.subplots(2, 2, figsize=(8.6, 6.2), layout="constrained", sharex=True, sharey="row")
    drawn = False
    for ax_pair, letters, shapes, size in ((axes[:, 0], "AC", SHAPES, "equal surfaces"),
                                           (axes[:, 1], "BD", SMALL, "equal volumes")):
        for shape in shapes:
            found = {i: run for i, sweep in enumerate(sweeps)
                     for run in bodies_in(runs, sweep.name, [shape]).values()}
            vessels = {i: runs.run(sweeps[i].name, "empty") for i in found}
            drawn |= bool(found)
            _lowest(ax_pair[0], found, vessels, shape)
            _leaving(ax_pair[1], found, shape)
        head(ax_pair[0], letters[0], f"lowest flow rate, {size}")
        head(ax_pair[1], letters[1], f"time at which half has left, {size}")
    if not drawn:
        plt.close(figure)
        raise Missing(" or ".join(os.path.join(runs.out, sweep.name) for sweep in sweeps))
    for ax in axes[1]:
        ax.set_xticks(range(len(sweeps)), [str(sweep.parameters["throat"]) for sweep in sweeps])
        ax.set_xlim(-0.3, len(sweeps) - 0.7)
        ax.set_xlabel("length of the throat in D")
    axes[0, 0].set_ylabel("parts of the empty vessel's")
    axes[1, 0].set_ylabel(TIME)
    axes[0, 1].plot([], [], TORN, color="0.3", label="came apart")
    axes[0, 1].legend(fontsize=8)
    axes[1, 1].plot([], [], "o", color="0.3", fillstyle="none", label="not until here")
    axes[1, 1].legend(fontsize=8)
    return figure


def lowest(run, vessel):
    """The lowest flow rate in parts of the empty vessel's at the same time."""
    flow, other = run.tables["flow"], vessel.tables["flow"]
    chosen = (flow["t"] >= START) & (flow["t"] <= other["t"][-1])
    if not chosen.any():
        return np.nan
    return (flow["flow_rate"][chosen] / np.interp(flow["t"][chosen], other["t"], other["flow_rate"])).min()


def _lowest(ax, found, vessels, shape):
    values = {i: lowest(run, vessels[i]) for i, run in found.items() if vessels[i]}
    ax.plot(list(values), list(values.values()), "-", color=COLOURS[shape], label=words_of(shape))
    for i, value in values.items():
        ax.plot(i, value, "o" if torn(found[i]) is None else TORN, color=COLOURS[shape])


def _leaving(ax, found, shape):
    """A full mark where half of the body has left, an open one where the run has come without that."""
    half = {i: np.flatnonzero(gone(run) > 0.5) for i, run in found.items()}
    time = {i: run.tables["solid"]["t"][half[i][0] if len(half[i]) else -1] for i, run in found.items()}
    ax.plot(list(time), list(time.values()), "-", color=COLOURS[shape], linewidth=0.8)
    for i, value in time.items():
        mark = "o" if torn(found[i]) is None else TORN
        ax.plot(i, value, mark, color=COLOURS[shape], fillstyle="full" if len(half[i]) else "none")
