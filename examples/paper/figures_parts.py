"""What the figures share: the runs of the study, panels over time, and pictures of bodies."""
import os
from dataclasses import dataclass
from fractions import Fraction

import matplotlib
import matplotlib.pyplot as plt
import matplotlib.ticker
import numpy as np

import study

from measures import fsi, moving_mean, opened, turn
from fsi import cells, render, scene, style

TIME = r"$t^*$ in units of $D/2\bar{u}$ = 10 ms"
STYLES = ("-", "--", ":", "-.")
SECTIONS = {"bending_meridian": ("aspect_forward", "aspect_back"),  # what a bending angle is made of
            "bending_prime": ("aspect_right", "aspect_left")}


class Missing(Exception):
    """No run is there of those that a figure is made of; the text names the folder."""


@dataclass
class Member:
    """A run of a family, with its value of what differs there."""

    run: fsi.Run
    value: float
    label: str
    colour: object


@dataclass
class Family:
    """The points of a sweep, with the one of the sweep `tilt` that belongs to them."""

    value: object  # of the options, for the order
    label: object  # the same in words
    base: str = ""


def number(name):
    return lambda options: float(options[name])


def slenderness(options):
    return float(options["solid_major_radius"]) / float(options["solid_minor_radius"])


def height(options):
    return float(options["solid_center"].split(",")[1])


FAMILIES = {
    "tilt": Family(number("solid_angle"), lambda o: rf"$\psi_0$ = {float(o['solid_angle']):g}°"),
    "place": Family(height, lambda o: f"$y_0$ = {height(o):g}", "solid_angle=0"),
    "thickness": Family(slenderness, lambda o: f"R/r = {Fraction(slenderness(o)).limit_denominator(9)}",
                        "solid_angle=45"),
    "modulus": Family(number("solid_shear_modulus"), lambda o: f"G = {float(o['solid_shear_modulus']):g}",
                      "solid_angle=45"),
    "viscosity": Family(number("solid_viscosity"), lambda o: r"$\mu_s/\mu_f$ = "
                        f"{float(o['solid_viscosity']) / float(o['fluid_viscosity']):g}", "solid_angle=45"),
    "size": Family(number("solid_major_radius"), lambda o: f"R = {float(o['solid_major_radius']):g}, "
                   f"r = {float(o['solid_minor_radius']):g}", "solid_angle=45"),
}


class Study:
    """The runs in a folder of the study."""

    def __init__(self, preset, out, renderer="auto"):
        self.preset, self.out, self.renderer, self._runs = preset, out, renderer, {}

    def sweeps(self, part):
        return [sweep for sweep in study.sweeps(self.preset) if sweep.part == part]

    def run(self, sweep, point):
        """The run of a point; None where it has written nothing yet."""
        folder = os.path.join(self.out, sweep, point)
        if folder not in self._runs:
            there = os.path.exists(os.path.join(folder, "run.yaml"))
            run = opened(self.preset, sweep, folder) if there else None
            self._runs[folder] = run if run and run.tables["flow"] else None
        return self._runs[folder]

    def family(self, name):
        """The members of a family that are there, in order; Missing where there is none."""
        family = FAMILIES[name]
        runs = [self.run(name, point) for point in study.points(name)]
        if any(runs) and family.base:
            runs.append(self.run("tilt", family.base))
        runs = [run for run in runs if run and run.tables["solid"]]
        runs.sort(key=lambda run: family.value(run.options))
        if not runs:
            raise Missing(os.path.join(self.out, name))
        colours = style.colours(len(runs))
        if name == "tilt":  # a colour stays with its angle when others are not there
            colours = [matplotlib.colormaps["viridis"](family.value(run.options) / 95) for run in runs]
        return [Member(run, family.value(run.options), family.label(run.options), colour)
                for run, colour in zip(runs, colours)]

    def family_or_none(self, name):
        """The members of a family, for panels that may stay empty."""
        try:
            return self.family(name)
        except Missing:
            return []


def nearest(run, time, within=np.inf):
    """The number of the field file nearest to a time; None where none is so near."""
    away = [abs(t - time) for t in run.times]
    return int(np.argmin(away)) if away and min(away) <= within else None


def head(ax, letter, words):
    """The letter of a panel and what it shows."""
    ax.set_title((rf"$\bf{{{letter}}}$  " if letter else "") + words, loc="left")


def empty(ax, words):
    """A panel of which no run is there."""
    ax.text(0.5, 0.5, words, transform=ax.transAxes, ha="center", va="center", color="0.5")
    ax.set_xticks([])
    ax.set_yticks([])


def column(run, name, table="solid"):
    """Times and values of a column; `turn` is the angle of the axis to x without a bound.

    The value is NaN where a section of the ring that it is made of is too small for an ellipse.
    """
    data = run.tables[table]
    if name == "turn":
        return data["t"], turn(data)
    if name not in data:
        return np.zeros(0), np.zeros(0)
    values = data[name].copy()
    for section in SECTIONS.get(name, [name] if name.startswith("aspect") else []):
        values[data[section] == 0] = np.nan
    return data["t"], values


def lines(ax, members, names, table="solid", width=0):
    """Columns over time, a colour a member and a dash a column; width: of a moving mean."""
    for member in members:
        for name, dash in zip(names, STYLES):
            time, values = column(member.run, name, table)
            if width:
                values = moving_mean(time, values, width)
            ax.plot(time, values, color=member.colour, linestyle=dash,
                    label=member.label if dash == "-" else None)
    time_axis(ax)


def time_axis(ax):
    ax.set_xlabel(TIME)
    ax.xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(5, steps=(1, 2, 5, 10)))


def legend_beside(ax, title=None):
    """The colours of the members, to the right of a row of panels whose last one may have a legend too."""
    handles, words = ax.get_legend_handles_labels()
    if ax.get_legend():
        ax.add_artist(ax.get_legend())
    ax.legend(handles, words, loc="center left", bbox_to_anchor=(1.02, 0.5), title=title, alignment="left")


def legend_below(figure, ax):
    """The colours of the members of a panel below a figure."""
    handles, words = ax.get_legend_handles_labels()
    figure.legend(handles, words, loc="upper center", bbox_to_anchor=(0.5, 0), ncol=7)


def dashes(ax, words, title=None):
    """A legend of what the dashes mean."""
    handles = [plt.Line2D([], [], color="0.3", linestyle=dash) for dash in STYLES[:len(words)]]
    ax.legend(handles, words, fontsize=8, handlelength=2.4, title=title, title_fontsize=8, alignment="left",
              frameon=True, framealpha=0.8, edgecolor="none")


def order_line(ax, numbers, values, order):
    """A line of an order below the values at the largest number."""
    numbers = np.array([min(numbers), max(numbers)], float)
    ax.plot(numbers, 0.6 * min(values) * (numbers[-1] / numbers)**order, color="0.5", linewidth=1,
            linestyle=":", label=f"order {order}")


def convergence(ax, numbers, norms, order, along):
    """Norms, a list by name, against the number of cells `along` a length, on logarithmic axes."""
    for (name, values), colour, mark in zip(norms.items(), style.LINES, "os^"):
        ax.loglog(numbers, values, mark + "-", color=colour, label=name)
    order_line(ax, numbers, [value for values in norms.values() for value in values], order)
    ax.set_xticks(numbers, [str(n) for n in numbers])
    ax.yaxis.set_major_locator(matplotlib.ticker.LogLocator(10, (1, 2, 5)))
    ax.yaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    ax.minorticks_off()
    ax.set_xlabel(f"N, cells per {along}")
    ax.legend(fontsize=8)


def grid_lines(mesh, axis, level):
    """The edges of the faces of cells that lie on a plane, as segments [n, 2, 3]."""
    room = 1e-6 * np.ptp(mesh.points)
    on = abs(mesh.points[:, axis] - level) < room
    pairs = []
    for _, corners, kind in mesh.groups():
        for face in cells.FACES[kind]:
            ends = corners[:, face]
            ends = ends[on[ends].all(axis=1)]
            pairs.append(np.stack([ends, np.roll(ends, -1, axis=1)], axis=2).reshape(-1, 2))
    pairs = np.unique(np.sort(np.concatenate(pairs), axis=1), axis=0)
    return mesh.points[pairs]


def body(run, snapshot, carry=()):
    """The surface of the solid where solid.csv has its centroid, periods taken off; None without one."""
    if not snapshot.has_solid():
        return None
    about = run.centroid(snapshot.time)
    surface = fsi.solid_surface(snapshot, carry, about)
    return surface if len(surface.points) else None


def picture(layers, towards, up, box, pixels, renderer):
    """A picture of layers in a window (middle, width, height), `pixels` wide."""
    middle, width, high = box
    middle, towards, up = (np.asarray(vector, float) for vector in (middle, towards, up))
    camera = scene.Camera(middle, towards, up, width, high)
    return render.image(layers, camera, pixels, max(int(pixels * high / width), 1), renderer)


def plain(ax):
    """No ticks and no frame: a picture stands there."""
    ax.set_xticks([])
    ax.set_yticks([])
    ax.grid(False)
    for side in ax.spines.values():
        side.set_visible(False)


def bar(figure, axes, colours, **places):
    """A colour bar for a map of fsi.scene."""
    span = matplotlib.colors.Normalize(colours.low, colours.high)
    shades = matplotlib.cm.ScalarMappable(span, colours.name)
    return figure.colorbar(shades, ax=axes, label=colours.label, extend=colours.extend, **places)
