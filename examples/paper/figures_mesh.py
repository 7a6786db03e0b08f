"""Figures 2 and 3: the flow in an empty pipe and the soft disc in the cavity, on several meshes."""
import os

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

import study
from figures_parts import (Missing, convergence, empty, fsi, grid_lines, head, nearest, plain, style,
                           time_axis)
from fsi import sections

DATA = os.path.join(study.HERE, os.pardir, os.pardir, "tests", "verification", "data")
SHAPES = (1.17, 4.69, 8.20)  # times at which there are outlines to compare with


def exact(y, mean=0.5):
    """The velocity of a full flow across the pipe."""
    return 8 * mean * y * (1 - y)


def beside_line(mesh):
    """(cells, y): the cells in the middle of the pipe that touch the vertical line through its axis,
    bottom to top, each put at its distance from the axis."""
    centres, middle = mesh.centres(), 0.5 * (mesh.low + mesh.high)
    room = 1e-6 * np.ptp(mesh.points)
    (left, right), (near, far) = mesh.extent(mesh.points[:, 0]), mesh.extent(mesh.points[:, 2])
    chosen = np.flatnonzero((left <= middle[0] + room) & (right > middle[0] + room) &
                            (abs(near - middle[2]) < room) & (far > middle[2] + room))
    across = centres[chosen, 1:] - middle[1:]
    y = middle[1] + np.sign(across[:, 0]) * np.linalg.norm(across, axis=1)
    order = np.argsort(y)
    return chosen[order], y[order]


def norms(snapshot):
    """Mean square and largest error of u_x over all cells, in a pipe about y = z = 0.5."""
    mesh = snapshot.mesh
    y = 0.5 + np.linalg.norm(mesh.centres()[:, 1:] - 0.5, axis=1)
    error = snapshot["u"][:, 0] - exact(y)
    return np.sqrt(np.average(error**2, weights=mesh.volumes)), abs(error).max()


def figure_2(runs):
    """The flow in an empty pipe from a plug: profiles and errors on three meshes."""
    found = {sweep.parameters["n"]: runs.run(sweep.name, point) for sweep in runs.sweeps("flow")
             for point in study.points(sweep.points)}
    found = {n: run for n, run in found.items() if run and run.items}
    if not found:
        raise Missing(os.path.join(runs.out, runs.sweeps("flow")[0].name))
    figure, axes = plt.subplots(2, 3, figsize=(10.5, 6.6), layout="constrained")
    finest = found[max(found)]
    _mesh_panel(axes[0, 0], finest, max(found))
    _start_panel(axes[0, 1], found)
    _profiles_over_time(axes[0, 2], finest, max(found))
    for ax, letter in zip(axes[1], "DE"):
        _profiles_of_meshes(ax, found, letter)
    _flow_errors(axes[1, 2], found)
    return figure


def _mesh_panel(ax, run, n):
    mesh = run.snapshot(-1).mesh
    segments = grid_lines(mesh, 0, mesh.low[0])[..., 1:]
    ax.add_collection(LineCollection(segments, colors="0.35", linewidths=0.5))
    ax.set_xlim(-0.02, 1.02)
    ax.set_ylim(-0.02, 1.02)
    ax.set_aspect("equal")
    plain(ax)
    head(ax, "A", f"section of the mesh, N = {n}")


def _start_panel(ax, found):
    for (n, run), colour in zip(found.items(), style.LINES):
        flow = run.tables["flow"]
        ax.plot(flow["t"], flow["pressure_gradient"], color=colour, label=f"N = {n}")
    ax.axhline(0.16, color="0.45", linestyle="--", linewidth=1, label="full flow, 0.16")
    ax.set_xlim(0, 6)
    ax.set_ylim(0.1, 0.6)
    time_axis(ax)
    ax.legend(fontsize=8)
    head(ax, "B", "pressure gradient of the start-up")


def _profiles_over_time(ax, run, n):
    colours = matplotlib.colormaps["viridis"](np.linspace(0, 0.9, len(run.items)))
    for i, (snapshot, colour) in enumerate(zip(run.snapshots(), colours)):
        chosen, y = beside_line(snapshot.mesh)
        ax.plot(snapshot["u"][chosen, 0], y, color=colour, linestyle="-" if i < 2 else "--",
                linewidth=2.4 - 0.4 * i, label=f"$t^*$ = {snapshot.time:g}")
    ax.set_xlabel("$u_x$")
    ax.set_ylabel("y")
    ax.legend(fontsize=8, loc="center left")
    head(ax, "C", f"profile over time, N = {n}")


def _profiles_of_meshes(ax, found, letter):
    near = letter == "E"
    y = np.linspace(0, 1, 401)
    ax.plot(exact(y), y, color="0.3", linewidth=1, label=r"$8\bar{u}y(1-y)$")
    for (n, run), colour, mark in zip(found.items(), style.LINES, "o^s"):
        snapshot = run.snapshot(-1)
        chosen, y = beside_line(snapshot.mesh)
        ax.plot(snapshot["u"][chosen, 0], y, mark, color=colour, markersize=5 if near else 4,
                fillstyle="none", label=f"N = {n}")
    window = 0.955, 0.385, 0.05, 0.23
    if near:
        ax.set_xlim(window[0], window[0] + window[2])
        ax.set_ylim(window[1], window[1] + window[3])
    else:
        ax.add_patch(plt.Rectangle(window[:2], *window[2:], fill=False, edgecolor="red", linestyle=":"))
        ax.legend(fontsize=8, loc="center left")
    ax.set_xlabel("$u_x$")
    ax.set_ylabel("y")
    head(ax, letter, "near the axis" if near else f"cells along the diameter, $t^*$ = {snapshot.time:g}")


def _flow_errors(ax, found):
    table = {n: norms(run.snapshot(-1)) for n, run in found.items()}
    convergence(ax, list(table), {"$L_2$": [v[0] for v in table.values()],
                                  r"$L_\infty$": [v[1] for v in table.values()]}, 2, "diameter")
    head(ax, "F", "error of $u_x$; the start-up has decayed")


def reference(name):
    """A table to compare with as an array; None where it is not installed."""
    path = os.path.join(DATA, name)
    return np.genfromtxt(path, delimiter=",", comments="#", skip_header=2) if os.path.exists(path) else None


def figure_3(runs):
    """The soft disc in the cavity: outlines, way and errors of the way on several meshes."""
    found = {sweep.parameters["n"]: runs.run(sweep.name, "benchmark") for sweep in runs.sweeps("disc")}
    found = {n: run for n, run in found.items() if run and run.tables["solid"]}
    if not found:
        raise Missing(os.path.join(runs.out, runs.sweeps("disc")[0].name, "benchmark"))
    figure, axes = plt.subplots(2, 3, figsize=(10.5, 7.0), layout="constrained")
    for ax, letter, time in zip(axes[0], "BCD", SHAPES):
        _outline_panel(ax, found[max(found)], max(found), letter, time)
    _way_panel(axes[1, 0], found)
    _way_errors(axes[1, 1], found)
    handles, words = axes[1, 0].get_legend_handles_labels()
    axes[1, 2].axis("off")
    handles.append(plt.Line2D([], [], color="black", linewidth=1.8))
    axes[1, 2].legend(handles, [*words, rf"outline $\alpha$ = 0.5, N = {max(found)}"], loc="center left")
    return figure


def _outline_panel(ax, run, n, letter, time):
    number = nearest(run, time, 0.1)
    head(ax, letter, f"$t^*$ = {time:.2f}, N = {n}")
    if number is None:
        empty(ax, "no field file here yet")
        return
    cut = fsi.cut(run.snapshot(number))
    x, y, velocity = cut.grid(cut["u"][:, :2], 160)
    ax.streamplot(x, y, velocity[..., 0], velocity[..., 1], color="0.6", linewidth=0.6, arrowsize=0.6,
                  density=1.2)
    sections.outline(ax, cut, "black")
    shape = reference(f"softdisc_shape_t{time:.2f}.csv")
    if shape is not None:
        ax.plot(*np.append(shape, shape[:1], axis=0).T, color="red", linestyle="--", linewidth=1)
    ax.set_aspect("equal")
    ax.set_xlim(0, 1)
    ax.set_ylim(0, 1)
    ax.set_xlabel("x")
    ax.set_ylabel("y")
    ax.grid(False)


def _way_panel(ax, found):
    for (n, run), colour in zip(found.items(), style.LINES):
        solid = run.tables["solid"]
        ax.plot(solid["x"], solid["y"], color=colour, linewidth=1.1, label=f"N = {n}")
    truth = reference("softdisc_reference_G0.1.csv")
    if truth is not None:
        ax.plot(truth[:, 1], truth[:, 2], color="red", linestyle="--", linewidth=1, label="reference")
    ax.set_aspect("equal")
    ax.set_xlabel("x")
    ax.set_ylabel("y")
    head(ax, "E", "way of the centroid")


def _way_errors(ax, found):
    """Of the way to the end: against the reference, or where there is none against the finest mesh."""
    truth, words = reference("softdisc_reference_G0.1.csv"), "error of the way"
    done = {n: run for n, run in found.items() if run.summary.get("status") == "complete"}
    if truth is None and done:
        solid = done.pop(max(done)).tables["solid"]
        truth = np.column_stack([solid["t"], solid["x"], solid["y"]])
        words = "difference from the finest mesh"
    head(ax, "F", words)
    if len(done) < 2:
        empty(ax, "fewer than two runs have ended")
        return
    table = {}
    for n, run in done.items():
        solid = run.tables["solid"]
        away = np.hypot(*(np.interp(truth[:, 0], solid["t"], solid[axis]) - values
                          for axis, values in zip("xy", truth[:, 1:].T)))
        table[n] = np.sqrt(np.mean(away**2)), away.max()
    convergence(ax, list(table), {"$L_2$ over time": [v[0] for v in table.values()],
                                  r"$L_\infty$": [v[1] for v in table.values()]}, 1, "side")
