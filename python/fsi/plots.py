"""Plots of the tables: a run over time, or several runs over each other."""
import dataclasses
import itertools
import os
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np

from . import labels, runs, sections, style


@dataclass
class Panel:
    """The content of one panel. NAME_* means all columns that begin with NAME_."""

    key: str
    title: str
    table: str
    columns: tuple
    unit: str
    logarithmic: bool = False
    floor: float = 0.0  # below this size a change is round-off
    always: bool = False  # also where nothing changes


PANELS = (
    Panel("centroid", "centroid", "solid", ("x", "y", "z"), "length"),
    Panel("velocity", "velocity of the solid", "solid", ("ux", "uy", "uz"), "velocity"),
    Panel("angle", "angle of the axis to x", "solid", ("angle",), "degrees", floor=1e-2),
    Panel("aspect", "aspect ratio of the sections", "solid",
          ("aspect_forward", "aspect_back", "aspect_right", "aspect_left"), "1", floor=1e-4),
    Panel("aspect", "aspect ratio of the outlines", "solid", ("aspect_inner", "aspect_outer"), "1",
          floor=1e-4),
    Panel("bending", "bending angles", "solid", ("bending_meridian", "bending_prime"), "degrees", floor=1e-3),
    Panel("taylor", "(a - b) / (a + b)", "solid", ("taylor",), "1", floor=1e-4),
    Panel("strain", "smallest eigenvalue of B", "solid", ("min_eig_B",), "1", floor=1e-6),
    Panel("det", "det B", "solid", ("det_B_min", "det_B_max"), "1", floor=1e-6),
    Panel("drift", "volume / first volume - 1", "solid", ("drift",), "1", floor=1e-9),
    Panel("gradient", "pressure gradient", "flow", ("pressure_gradient",), "force / volume"),
    Panel("rate", "flow rate", "flow", ("flow_rate",), "volume / time"),
    Panel("rates", "flow rate of each opening, outward", "flow", ("flow_rate_*",), "volume / time",
          always=True),
    Panel("pressures", "mean pressure of each opening", "flow", ("mean_pressure_*",), "pressure",
          always=True),
    Panel("energy", "kinetic energy", "flow", ("kinetic_energy",), "energy"),
    Panel("energy", "elastic energy", "flow", ("elastic_energy",), "energy"),
    Panel("dt", "time step and its limit", "flow", ("dt", "dt_limit"), "time"),
    Panel("divergence", "largest divergence", "flow", ("divergence_max",), "1 / time", True),
    Panel("iterations", "pressure iterations in a step", "flow", ("pressure_iterations",), "1"),
    Panel("wall", "wall time of a step", "flow", ("wall_per_step",), "s"),
)
MOST_OF_SOLIDS = 8  # lines that a legend names
OF_THE_RUN = ("dt", "divergence", "iterations", "wall")  # shown only where asked for
KEYS = list(dict.fromkeys(panel.key for panel in PANELS))


def main_axis(solid):
    """The axis along which a solid travels more than twice as far as along the others; None without one."""
    ways = [np.ptp(solid[axis]) if axis in solid and len(solid[axis]) else 0.0 for axis in "xyz"]
    first, second = sorted(ways)[:-3:-1]
    return "xyz"[ways.index(first)] if first > 2 * second else None


def directed(panel, solid):
    """The panels of what has three components: along the way of the solid and across it, where it has
    one direction."""
    axis = main_axis(solid)
    if panel.key not in ("centroid", "velocity") or panel.table != "solid" or axis is None:
        return [panel]
    along = [column for column in panel.columns if column.endswith(axis)]
    across = [column for column in panel.columns if not column.endswith(axis)]
    return [dataclasses.replace(panel, title=f"{panel.title} along {axis}", columns=tuple(along)),
            dataclasses.replace(panel, title=f"{panel.title} across {axis}", columns=tuple(across))]


def chosen_panels(show, tables):
    """The panels that are asked for by key or by column; all but those of the run itself for none."""
    panels = [part for panel in PANELS for part in directed(panel, tables["solid"])]
    if not show:
        return [panel for panel in panels if panel.key not in OF_THE_RUN], False
    found = []
    for word in [key for word in show for key in (KEYS if word == "all" else [word])]:
        known = [panel for panel in panels if panel.key == word]
        of = [name for name in dict.fromkeys(["solid", "flow", *tables]) if word in tables[name]]
        if not known and not of:
            raise ValueError(f'nothing is called "{word}"; there are {", ".join(KEYS)}, all, and the '
                             "columns of the csv files")
        found += known or [Panel(word, word, of[0], (word,), unit_of(word))]
    return found, "all" not in show


def unit_of(column):
    """The unit of a column of a csv file; 1 for one of a driver of one's own."""
    return next((panel.unit for panel in PANELS if column in panel.columns), labels.COLUMNS.get(column, "1"))


def columns_of(panel, table):
    return [c for wanted in panel.columns for c in table
            if c == wanted or wanted.endswith("*") and c.startswith(wanted[:-1])]


def lines_of(panel, table, asked=False):
    """The (column, values) of a panel. What changes by round-off alone is left out unless asked for."""
    lines = [(c, table[c]) for c in columns_of(panel, table) if np.isfinite(table[c]).any()]
    if asked or panel.always:
        return lines
    kin = [table[c] for other in PANELS if other.key == panel.key and other.unit == panel.unit
           for c in columns_of(other, table)]
    least = max([panel.floor] + [max(1e-4 * np.nanmax(v) - 1e-4 * np.nanmin(v), 1e-9 * np.nanmax(abs(v)))
                                 for v in kin if np.isfinite(v).any() and panel.key != "energy"])
    return [(name, v) for name, v in lines if np.nanmax(v) - np.nanmin(v) > least]


def with_drift(run):
    """The tables of a run, with the column drift in that of each solid."""
    tables = {name: dict(table) for name, table in run.tables.items()}
    for table in tables.values():
        volume = table.get("volume")
        if volume is not None and volume[0] != 0:
            table.setdefault("drift", (volume + table.get("volume_out", 0)) / volume[0] - 1)
    return tables


def is_round(run, solid):
    """A solid that starts round has no axis; solid: the name of its table."""
    several = f"solids_{solid.removeprefix('solid_')}_shape".lower()
    return run.options.get("solid_shape" if solid == "solid" else several) == "sphere"


def fits(panel, run, dim):
    """Whether a panel is useful for a run of this kind: a round solid has no axis, and between sliding
    plates the net flow is zero. With a flow rate of each opening, that of one of them says less."""
    without_axis = all(is_round(run, solid) for solid in run.solids)
    of_openings = any(column.startswith("flow_rate_") for column in run.tables.get("flow", {}))
    return not (panel.key == "angle" and without_axis or panel.key == "taylor" and dim == 3 or
                panel.key == "rate" and (of_openings or run.summary.get("case") == "shear"))


def empty_gradient(run):
    """The pressure gradient that holds the mean velocity of a round pipe without a solid; None where
    the run is of something else."""
    if run.summary.get("case") != "pipe" or not run.items:
        return None
    mesh = run.snapshot(0).mesh
    sides = (mesh.high - mesh.low)[1:]
    viscosity, velocity = (float(run.options.get(name, "nan")) for name in
                           ("fluid_viscosity", "flow_mean_velocity"))
    section = mesh.volumes.sum() / (mesh.high - mesh.low)[0]
    if abs(sides[0] - sides[1]) > 0.02 * sides[0] or abs(section / (np.pi / 4 * sides[0]**2) - 1) > 0.05:
        return None
    gradient = 32 * viscosity * velocity / sides[0]**2
    return gradient if np.isfinite(gradient) else None


def figure_of(count, columns=3):
    columns = min(columns, count)
    figure, axes = plt.subplots(-(-count // columns), columns, squeeze=False, layout="constrained",
                                figsize=(3.6 * columns, 2.5 * -(-count // columns)))
    for ax in axes.flat[count:]:
        ax.axis("off")
    return figure, axes.flat[:count]


def lines_over_time(panel, run, tables, asked):
    """The (column, t, values) of a panel; of several solids each column has the name of its solid before it."""
    if panel.table != "solid" or len(run.solids) < 2:
        table = tables.get(panel.table, {})
        return [(column, table["t"], values) for column, values in lines_of(panel, table, asked)]
    return [(f"{solid.removeprefix('solid_')} {column}", tables[solid]["t"], values) for solid in run.solids
            if asked or panel.key != "angle" or not is_round(run, solid)
            for column, values in lines_of(panel, tables[solid], asked)]


def series(run, show=None, units=labels.Units()):
    """The tables of a run over time; None where there is nothing to show."""
    tables, dim = with_drift(run), run.snapshot(0).dim if run.items else 3
    panels, asked = chosen_panels(show, tables)
    panels = [(panel, lines_over_time(panel, run, tables, asked)) for panel in panels
              if asked or fits(panel, run, dim)]
    drawn = {}  # each set of columns once, under any name
    for panel, lines in panels:
        if lines:
            drawn.setdefault((panel.table, *(name for name, _, _ in lines)), (panel, lines))
    panels = list(drawn.values())
    if not panels:
        return None
    figure, axes = figure_of(len(panels))
    for ax, (panel, lines) in zip(axes, panels):
        for (name, t, values), colour in zip(lines, itertools.cycle(style.LINES)):
            ax.plot(t, _shown(values, panel), color=colour,
                    label=_short(name, [other for other, _, _ in lines]))
        empty = empty_gradient(run) if panel.key == "gradient" else None
        if empty is not None:
            ax.axhline(empty, color="0.45", linestyle="--", linewidth=1, label="empty pipe")
        values = np.concatenate([values for _, _, values in lines])
        _finish(ax, panel, units, dim, values, lines[0][0] if len(lines) == 1 < len(panel.columns) else "")
        if panel.table == "solid" and len(run.solids) > 1 and len(lines) > MOST_OF_SOLIDS:
            ax.set_title(f"{panel.title}, {len(run.solids)} solids", loc="left", y=1.0)
        elif len(lines) > 1 or empty is not None:
            _legend(ax, len(lines) + (empty is not None))
    if run.failed():
        figure.suptitle(sections.end(run, units)[2:], x=0.01, ha="left", fontsize=9.5)
    return figure


def overlay(runs_shown, show=None, units=labels.Units()):
    """Several runs over each other, a panel for each column, of several solids for each column of each;
    a legend by the options that differ."""
    tables = [with_drift(run) for run in runs_shown]
    dim = runs_shown[0].snapshot(0).dim if runs_shown[0].items else 3
    panels, asked = chosen_panels(show, tables[0])
    found = {}  # each column once
    for panel in panels:
        if not asked and not fits(panel, runs_shown[0], dim):
            continue
        for run, table in zip(runs_shown, tables):
            for name, _, _ in lines_over_time(panel, run, table, asked):
                found.setdefault((panel.table, name), (panel, name))
    if not found:
        return None
    figure, axes = figure_of(len(found))
    for ax, (panel, column) in zip(axes, found.values()):
        drawn = []
        for run, table, colour in zip(runs_shown, tables, style.colours(len(tables))):
            for name, t, values in lines_over_time(panel, run, table, True):
                if name == column:
                    ax.plot(t, _shown(values, panel), color=colour)
                    drawn.append(values)
        _finish(ax, panel, units, dim, np.concatenate(drawn), "" if panel.columns == (column,) else column)
    handles = [plt.Line2D([], [], color=c) for c in style.colours(len(tables))]
    names = legend(runs_shown)
    figure.legend(handles, names, loc="lower left", bbox_to_anchor=(0, 1), ncol=min(3, len(names)))
    return figure


def legend(runs_shown):
    """A name for each run, of the options that differ; the folders where none does."""
    differ = runs.differences(runs_shown)
    if not differ:
        return [run.folder for run in runs_shown]
    return [", ".join(f"{name} {values[i]}" for name, values in differ.items())
            for i in range(len(runs_shown))]


def _short(name, names):
    """A column's name without what it has in common with the others of its panel."""
    prefix = os.path.commonprefix(names)
    prefix = prefix[:prefix.rfind("_") + 1]
    return name[len(prefix):].replace("_", " ")


def _legend(ax, count):
    """A legend in a strip of its own above the lines."""
    rows = -(-count // 2)
    if ax.get_yscale() == "linear":
        low, high = ax.get_ylim()
        ax.set_ylim(low, high + 0.13 * rows * (high - low))
    ax.legend(fontsize=7.5, loc="upper left", ncol=2, borderaxespad=0.1)


def _shown(values, panel):
    return np.where(values > 0, values, np.nan) if panel.logarithmic else values


def _finish(ax, panel, units, dim, values, column=""):
    size = 1.0 if panel.logarithmic else np.nanmax(abs(values), initial=0)
    if panel.logarithmic:
        ax.set_yscale("log")
    words = units.label(panel.title, panel.unit, dim, size)
    told = f"{words}: {column}" if column else words
    ax.set_title(told if len(told) < 50 else units.label(column, panel.unit, dim, size), loc="left", y=1.0)
    ax.set_xlabel(units.label("t", "time"))
    ax.locator_params(axis="x", nbins=6)
    ax.ticklabel_format(axis="x", useOffset=False, scilimits=(-3, 4))
    if not panel.logarithmic:
        ax.ticklabel_format(axis="y", useOffset=False, scilimits=(-3, 4))
        ax.yaxis.set_offset_position("right")
        units.ticks(ax.yaxis, panel.unit, size, dim)
