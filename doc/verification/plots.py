#!/usr/bin/python3
"""Draws the pictures of these pages from their tables: plots.py [PAGE...]

PAGE.png shows the table of PAGE.md and holds a mark of it, by which tests/reference/pages.py tells
whether the table has changed since. Without a PAGE all are drawn, but for those of fields: disc.png
is made by tests/verification/disc/run.py, paper.png of the figures of examples/paper/run.
"""
import itertools
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(SOURCE, "python"), os.path.join(SOURCE, "tests", "reference")]
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import pages  # noqa: E402
from fsi import style  # noqa: E402

NUMBER = re.compile(r"(?<![\w.])[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?")
MARKS = "osD^vPX"
BLUE, ORANGE, GREEN = style.LINES[:3]
GREY = {"color": "0.4", "linewidth": 1}


# What the tables say.

def text_of(page):
    with open(os.path.join(HERE, page + ".md"), encoding="utf-8") as file:
        return file.read()


def rows(page, *begins):
    """The rows of a page's table without its head, as lists of cells; those that begin so."""
    lines = pages.tables(text_of(page))[0].strip().split("\n")[2:]
    found = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines]
    return [row for row in found if row[0].startswith(begins or "")]


def filled(table, *columns):
    """The rows with the names of the row before where theirs are empty."""
    names = {}
    for row in table:
        names.update({column: row[column] for column in columns if row[column]})
        yield [names.get(column, cell) if column in columns else cell
               for column, cell in enumerate(row)]


def values(cell):
    """The numbers of a cell; 1 234 is one of them, and 10^4 is another."""
    cell = re.sub(r"(?<=\d) (?=\d{3}\b)", "", cell)
    return [float(word) for word in NUMBER.findall(re.sub(r"10\^(\d)", r"1e\1", cell))]


def first(cell):
    return values(cell)[0]


def grouped(points):
    """(label, x, y) of points as lines of (label, all x, all y)."""
    found = {}
    for label, x, y in points:
        line = found.setdefault(label, ([], []))
        line[0].append(x)
        line[1].append(y)
    return [(label, x, y) for label, (x, y) in found.items()]


# How they are drawn.

def panels(count=2, width=7.2, height=3.0):
    figure, axes = plt.subplots(1, count, figsize=(width, height), squeeze=False,
                                layout="constrained")
    figure.get_layout_engine().set(wspace=0.06)
    return figure, *axes[0]


def panel():
    return panels(1, 6.2, 3.2)


def ticks(axis, at):
    """Labels at these numbers, and nowhere else."""
    axis.set_major_locator(matplotlib.ticker.FixedLocator(sorted(set(at))))
    axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: f"{x:g}"))
    axis.set_minor_locator(matplotlib.ticker.NullLocator())


def short(x, _):
    """A number as the tables write it: 2e-3."""
    if 0.01 <= x < 1e4:
        return f"{x:g}"
    digits, power = f"{x:.0e}".split("e")
    return f"{digits}e{int(power)}"


def logarithmic(*axes):
    """Labels at 1, 2 and 5 of each decade; at 1 alone where there are many decades."""
    for axis in axes:
        low, high = axis.get_view_interval()
        subs = (1, 2, 5) if high < 300 * low else (1,)
        axis.set_major_locator(matplotlib.ticker.LogLocator(subs=subs))
        axis.set_major_formatter(matplotlib.ticker.FuncFormatter(short))
        axis.set_minor_locator(matplotlib.ticker.NullLocator())


def slope(ax, series, order, label=None):
    """A dashed line below all others that falls or rises with this order."""
    x = np.array(sorted(n for _, at, _ in series for n in at), dtype=float)[[0, -1]]
    below = 0.75 * min(e / n ** order for _, at, errors in series for n, e in zip(at, errors))
    ax.plot(x, below * x ** order, "--", label=label or f"order {abs(order):g}", **GREY)


def lines(ax, series, xlabel, ylabel, order=None, at=None, log="xy"):
    """Lines of (label, x, y) with markers, ticks where x is, and the slope of an order."""
    ax.set(xscale="log" if "x" in log else "linear", yscale="log" if "y" in log else "linear",
           xlabel=xlabel, ylabel=ylabel)
    looks = zip(itertools.cycle(MARKS), itertools.cycle(style.LINES))
    for (label, x, y), (mark, colour) in zip(series, looks):
        ax.plot(x, y, mark + "-", color=colour, label=label, markersize=4.5)
    if order is not None:
        slope(ax, series, order)
    if "y" in log:
        logarithmic(ax.yaxis)
    ticks(ax.xaxis, at or [n for _, x, _ in series for n in x])


def legend(figure, ax, columns):
    """The legend of one panel below the whole figure."""
    figure.legend(*ax.get_legend_handles_labels(), loc="upper center", bbox_to_anchor=(0.5, 0),
                  ncol=columns, fontsize=8)


# One function for each page.

def balance():
    figure, ax = panel()
    found = [(first(row[0]), values(row[3])) for row in rows("balance", "disc")]
    lines(ax, [(f"density {ratio}", [n for n, _ in found], [parts[i] for _, parts in found])
               for i, ratio in enumerate(("0.5", "5"))],
          "cells a side", "work not found again, %", -1)
    ticks(ax.yaxis, [3, 5, 7, 10])
    ax.legend(fontsize=8)
    return figure


def carried():
    figure, left, right = panels()
    spheres = rows("carried", "sphere")
    lines(left, [(row[0], values(row[2]), values(row[3])) for row in spheres],
          "way, diameters", "centroid off, diameters")
    left.legend(fontsize=8, loc="center right")
    discs = rows("carried", "disc")
    lines(right, [(f"r / h = {row[1]}", values(row[2]), values(row[3])) for row in discs],
          "Courant number", "centroid ahead, % of the way")
    for row, colour in zip(discs, style.LINES):
        right.axhline(float(row[4]), color=colour, linestyle=":", linewidth=1)
    right.plot([], [], ":", color="0.4", label="h²/(12 r²)")
    right.set_ylim(0.006)
    right.legend(fontsize=7.5, loc="lower left", ncol=2)
    return figure


def cavity():
    figure, left, right = panels()
    table = rows("cavity")
    lines(left, grouped((f"Re {row[0]}", first(row[1]), first(row[5])) for row in table),
          "cells a side", "error of the profiles, lid's speed 1", -2)
    left.legend(fontsize=8)
    lines(right, grouped((f"{name}, Re {row[0]}", first(row[1]), abs(first(row[i])))
                         for row in table
                         for i, name in ((2, "least u"), (3, "least v"), (4, "largest v"))),
          "cells a side", "error, % of the reference", -2)
    right.set_ylim(0.006)
    right.legend(fontsize=7, loc="lower left", ncol=2)
    return figure


def edge():
    figure, left, right = panels()
    times = [0.8, 1.2, 1.6]
    for ax, i, label in ((left, 0, "x of the centroid, sides of the duct"),
                         (right, 1, "velocity along x, mean flow 1")):
        lines(ax, [(row[0], times, [values(cell)[i] for cell in row[1:4]]) for row in rows("edge")],
              "t, dimensionless", label, log="")
    legend(figure, left, 2)
    return figure


def energy():
    figure, ax = panel()
    series = grouped((f"{row[0].split()[0]}, {row[1]}, {row[2]} a side", C, abs(first(cell)))
                     for row in rows("energy")
                     for C, cell in zip((0.5, 0.25, 0.125), row[3:]) if cell)
    lines(ax, series, "Courant number", "part of the kinetic energy lost to t = 2", 3)
    legend(figure, ax, 2)
    return figure


def flow():
    figure, left, right = panels()
    found = [(row[0].split(",")[0] + ", " + re.sub(r" [\d, ]+$", "", row[1]), row)
             for row in filled(rows("flow"), 0)]
    for ax, i, name in ((left, 2, "u"), (right, 4, "p")):
        lines(ax, [(label, values(row[1]), values(row[i])) for label, row in found],
              "cells a side", f"L2 error of {name}, dimensionless", -2)
    legend(figure, left, 3)
    return figure


def heavy_slab():
    figure, left, right = panels()
    found = [(f"density {row[0]}", values(row[1]), values(row[2])) for row in rows("heavy_slab")]
    lines(left, [line for line in found if "in time" not in line[0]], "cells across a half",
          "error of u, of the amplitude", -2, at=[16, 32, 64])
    left.legend(fontsize=7)
    lines(right, [line for line in found if "in time" in line[0]], "steps a period",
          "error of u in time, dimensionless", -2)
    right.legend(fontsize=7.5)
    return figure


def inclusion():
    figure, left, right = panels()
    ways = ("along the grid", "at 45 degrees")
    for ax, column, label in ((left, 2, "error of u, dimensionless"),
                              (right, 3, "error of the strain, %")):
        lines(ax, grouped((f"mu_s/mu_f {row[0]}, {way}", first(row[1]), values(row[column])[i])
                          for row in rows("inclusion") for i, way in enumerate(ways)),
              "cells a radius", label, -2)
    legend(figure, left, 3)
    return figure


def interface():
    figure, left, right = panels()
    left.set_title("disc in the vortex", loc="left")
    right.set_title("sphere in the deformation flow", loc="left")
    for ax, kinds, order in ((left, ("quads", "triangles"), -1), (right, ("hexes", "tets"), -2/3)):
        series = []
        for kind, colour, mark in zip(kinds, (BLUE, ORANGE), "os"):
            found = rows("interface", kind)
            cells, errors = ([first(row[i]) for row in found] for i in (1, 3))
            # Where the published mesh has another number of cells, this stands behind the error.
            published = [values(row[4].strip("()")) for row in found]
            there = [pair[1] if "cells)" in row[4] else n
                     for pair, row, n in zip(published, found, cells)]
            ax.loglog(cells, errors, mark + "-", color=colour, label=kind, markersize=5)
            ax.loglog(there, [pair[0] for pair in published], mark + ":", color=colour,
                      markerfacecolor="white", label=f"{kind}, published")
            series.append((kind, cells, errors))
        slope(ax, series, order, "order 2 in the width")
        ax.set(xlabel="cells", ylabel="shape error, dimensionless")
        logarithmic(ax.xaxis, ax.yaxis)
        ax.legend(fontsize=7.5)
    return figure


def kinematics():
    figure, left, right = panels()
    names = ("left_cauchy_green", "log_conformation", "reference_map")
    table = rows("kinematics")
    at = [row[0] for row in table].index("smooth shear, quads 24, 48")
    for ax, row, kind in ((left, table[at], "quads"), (right, table[at + 1], "triangles")):
        lines(ax, [(name, [24, 48], values(cell)[:2]) for name, cell in zip(names, row[1:])],
              "cells a side", "L2 error of B, dimensionless", -2)
        ax.set_title(f"smooth shear, {kind}", loc="left")
    legend(figure, left, 4)
    return figure


def memory():
    figure, ax = panel()
    table = rows("memory")
    place = np.arange(len(table))
    for column, name, colour, shift in ((3, ".msh", BLUE, -0.2), (4, ".h5", ORANGE, 0.2)):
        most, least = ([values(row[column])[i] for row in table] for i in (0, -1))
        ax.bar(place + shift, most, 0.36, color=colour, alpha=0.45, label=f"{name}, largest rank")
        ax.bar(place + shift, least, 0.36, color=colour, label=f"{name}, least rank")
        for x, y in zip(place + shift, most):
            ax.text(x, y, f"{y:g}", ha="center", va="bottom", fontsize=8)
    ax.set_xticks(place, [row[0] for row in table])
    ax.set(xlabel="ranks", ylabel="peak memory of a rank, MB")
    ax.grid(axis="x")
    ax.legend(fontsize=8)
    return figure


def mesh_quality():
    figure, ax = panel()
    for column, G, dash in ((4, "0.1", "-"), (6, "10", ":")):
        for kind, colour, mark in zip(("quads", "halves", "triangles"), style.LINES, "os^"):
            found = [row for row in rows("mesh_quality", kind) if row[column]]
            ax.semilogy([first(row[1]) for row in found], [first(row[column]) for row in found],
                        mark + dash, color=colour, label=f"{kind}, G* {G}",
                        markerfacecolor="white" if G == "10" else colour)
    ax.set(xlabel="non-orthogonality, degrees", ylabel="L2 of the centroid, sides of the cavity")
    logarithmic(ax.yaxis)
    legend(figure, ax, 2)
    return figure


def paper_mesh():
    figure, left, right = panels()
    found = [(re.sub(r"^\d+, |, fine = [\d.]+|(, )?half of the pipe", "", row[0]) or "at rest",
              "half of the pipe" in row[0], row) for row in rows("paper_mesh")]
    for ax, column, i, label in ((left, 3, 1, "angle at t = 20, degrees"),
                                 (right, 2, 0, "x at t = 20, diameters")):
        lines(ax, grouped((name + (", half" if half else ""), first(row[0]), values(row[column])[i])
                          for name, half, row in found), "cells per diameter", label, log="x")
    legend(figure, left, 3)
    return figure


def paper_throat():
    figure, ax = panels(1, 7.2, 3.2)
    table = rows("paper_throat")
    fine, coarse = ([row for row in table if row[1] == cells] for cells in ("24", "16"))
    place = np.arange(len(fine))
    for column, throat, shift in ((2, 6, -0.27), (3, 3, 0), (4, 1, 0.27)):
        ax.bar(place + shift, [first(row[column]) for row in fine], 0.25,
               color=style.LINES[column - 2], label=f"throat {throat}, 24 cells")
    ax.plot(place - 0.27, [first(row[2]) for row in coarse], "k_", markersize=11,
            label="throat 6, 16 cells")
    ax.set_xticks(place, [row[0].replace(" of", "\nof") for row in fine], fontsize=8)
    ax.set_ylabel("flow kept back, at most, %")
    ax.grid(axis="x")
    ax.legend(fontsize=8)
    return figure


def passing_discs():
    figure, ax = panel()
    for column, dash, name in ((4, "-", "at the same time"), (5, ":", "at the same x")):
        series = grouped((f"y0 {row[1]}, G {row[3].split(',')[0]}, {name}", first(row[0]),
                          first(row[column])) for row in rows("passing_discs"))
        for (label, n, away), colour, mark in zip(series, style.LINES, MARKS):
            ax.loglog(n, away, mark + dash, color=colour, label=label,
                      markerfacecolor=colour if dash == "-" else "white")
    ticks(ax.xaxis, [6, 10, 20])
    ticks(ax.yaxis, [0.005, 0.01, 0.02, 0.03])
    ax.set(xlabel="cells a radius", ylabel="distance from the rigid disc, radii")
    legend(figure, ax, 2)
    return figure


def pipe():
    figure, left, right = panels()
    for ax, i, label in ((left, 2, "L2 error of u, of 2 U"),
                         (right, 4, "error of the driving gradient, %")):
        lines(ax, grouped((f"{row[0].split(',')[0]}, t = {row[1]}", first(row[0]), first(row[i]))
                          for row in rows("pipe")), "cells per diameter", label, -2)
        ax.legend(fontsize=8)
    return figure


def ranks():
    figure, ax = panel()
    series = grouped((f"{row[0].split(' with')[0]}, {row[1]} ranks", t, part)
                     for row in rows("ranks")
                     for t, part in zip((0, 1, 3, 5, 10), [first(row[2]), *values(row[4])]))
    lines(ax, series, "t, dimensionless", "solid cells, largest rank over mean", log="")
    legend(figure, ax, 2)
    return figure


def reference_map():
    figure, left, right = panels()
    found = [(", ".join(row[:2]) + (", mid-cell" if "33" in row[2] else ""), row)
             for row in filled(rows("reference_map"), 0, 1)]
    for ax, i, name in ((left, 3, "u, of the walls' speed"), (right, 5, "B_xy, of itself")):
        lines(ax, [(label, values(row[2]), values(row[i])) for label, row in found],
              "cells across a half", f"error of {name}", -2, at=[32, 64])
    legend(figure, left, 2)
    return figure


def settling():
    figure, ax = panel()
    ax.axhspan(0.99, 1.01, color="0.9", label="1 %")
    lines(ax, grouped((name, first(row[1]), first(row[column])) for body, column, name in
                      (("disc", 3, "disc, n = 32"), ("disc", 4, "disc, n = 64"),
                       ("disc", 5, "disc, triangles, n = 32"), ("sphere", 3, "sphere, n = 16"),
                       ("sphere", 4, "sphere, n = 24"))
                      for row in rows("settling", body) if row[column]),
          "density of the solid over that of the fluid", "speed over the exact one", log="x")
    legend(figure, ax, 3)
    return figure


def shape():
    figure, left, right = panels()
    kinds = ("log_conformation", "reference_map", "log_conformation, no memory")
    lines(left, grouped((kind, values(row[0])[-1], first(row[i]))
                        for i, kind in enumerate(kinds, 1)
                        for row in rows("shape", "ring, aspect", "ring, t") if row[i]),
          "t, dimensionless", "aspect of the ring's sections", log="x")
    for row, dash in zip(rows("shape", "pressed"), ("-", "--", ":")):
        for cell, colour, mark in zip(row[1:], style.LINES, MARKS):
            if "folds" not in cell:
                right.plot([1, 2, 3], values(cell), mark + dash, color=colour, markersize=4.5)
        right.plot([], [], "k" + dash, label=row[0].split(":")[0].replace("pressed, ", ""))
    right.set(xlabel="t, dimensionless", ylabel="height of the disc, sides of the cavity",
              ylim=(0.08, 0.19))
    ticks(right.xaxis, [1, 2, 3])
    right.legend(fontsize=7.5, ncol=2, loc="upper left")
    legend(figure, left, 3)
    return figure


def shear():
    figure, ax = panels(1, 6.4, 3.3)
    table = list(filled(rows("shear"), 0))
    place = range(len(table))
    for column, look, name in ((5, {"marker": "o", "color": BLUE}, "D"),
                               (6, {"marker": "s", "color": ORANGE}, "angle"),
                               (7, {"marker": "|", "color": "k", "markersize": 12}, "required")):
        ax.plot([first(row[column]) for row in table], place, linestyle="", label=name, **look)
    ax.set_yticks(place, [f"{row[0].split(', Re')[0]}, Ca {row[1]}, ratio {row[2]}, n {row[3]}"
                          for row in table], fontsize=8)
    ax.invert_yaxis()
    ax.set(xscale="log", xlabel="largest error, %")
    ticks(ax.xaxis, [0.1, 0.2, 0.5, 1, 2, 5])
    ax.legend(fontsize=8, loc="upper right")
    return figure


def slab():
    figure, left, right = panels()
    chosen = {"mu_s = 1, surface on faces": "quads, on faces",
              "mu_s = 1, surface in mid-cell": "quads, in mid-cell",
              "mu_s = 1, triangles, on faces": "triangles, on faces",
              "the same on tetrahedra": "tetrahedra, on a wall",
              "mu_s = 0, on faces": "mu_s = 0, quads",
              "left_cauchy_green, mu_s = 0, on faces": "mu_s = 0, left_cauchy_green"}
    found = [(chosen[row[0]], row) for row in rows("slab", *chosen) if row[0] in chosen]
    for ax, i, name in ((left, 2, "u, of the walls' speed"), (right, 4, "B_xy, of itself")):
        lines(ax, [(label, values(row[1]), values(row[i])) for label, row in found],
              "cells across a half", f"error of {name}", -2, at=[8, 16, 32, 64])
    legend(figure, left, 4)
    return figure


def speed():
    figure, ax = panel()
    found = [[cell.strip("*") for cell in row] for row in rows("speed") if row[2]]
    place = np.arange(len(found))
    for column, name, shift in ((1, "one rank", -0.2), (2, "two ranks", 0.2)):
        times = [first(row[column]) for row in found]
        ax.barh(place + shift, times, 0.36, color=style.LINES[column - 1], label=name)
        for y, x in zip(place + shift, times):
            ax.text(x, y, f" {x:.2f}", va="center", fontsize=8)
    ax.set_yticks(place, [row[0].split(",")[0] for row in found])
    ax.invert_yaxis()
    ax.set_xlabel("microseconds a cell and step")
    ax.grid(axis="y")
    ax.legend(fontsize=8)
    return figure


def speed_error():
    figure, ax = panels(1, 7.2, 3.9)
    colours = {"log_conformation": BLUE, "left_cauchy_green": ORANGE, "reference_map": GREEN}
    kinds = {}
    for row in rows("speed_error"):
        name = row[0].split(",")[0]
        kind = (name, row[1], row[3] or row[0].split("Co ")[1])
        kinds.setdefault(kind, []).append([first(cell) for cell in (row[2], row[4], row[5])])
    for (name, mesh, courant), found in kinds.items():
        colour = colours.get(name, "k")
        mark = "^" if mesh == "triangles" else "D" if courant == "0.8" else "s"
        ax.loglog([p[1] for p in found], [p[2] for p in found], mark, color=colour,
                  linestyle="-" if name in colours else "--", markersize=5.5,
                  markerfacecolor=colour if mark == "s" else "white",
                  label=f"{name}, {mesh}, Courant number {courant}")
        for n, x, y in found:
            ax.annotate(f"{n:g}", (x, y), (-2, -11) if colour == ORANGE else (4, 4),
                        textcoords="offset points", fontsize=7.5, color=colour)
    ax.set(xlabel="CPU seconds, one core", ylabel="L2 error of the centroid, sides of the cavity")
    ax.set_title("the figures at the points: cells a side", loc="left", fontsize=8.5)
    logarithmic(ax.xaxis, ax.yaxis)
    legend(figure, ax, 2)
    return figure


def stability():
    figure, left, right = panels()
    found = [(re.sub(r"(, )?G\* \S+$", "", row[0]) or "quads, mu_s / mu_f 1",
              first(row[0].split("G* ")[1]), row) for row in rows("stability")
             if "to t = 100" not in row[0]]
    for ax, i, label, log in ((left, 2, "smallest eigenvalue of B", "x"),
                              (right, 1, "steps to t = 8.2", "xy")):
        lines(ax, grouped((name, G, first(row[i])) for name, G, row in found),
              "G* = G / (rho U²)", label, log=log, at=[0.1, 1, 10, 100])
    ticks(right.yaxis, [1000, 1500, 2000, 3000])
    legend(figure, left, 3)
    return figure


def stenosis():
    figure, left, right = panels()
    left.set_title("parabola given", loc="left")
    right.set_title("pressures given", loc="left")
    lines(left, grouped((f"{name}, throat {row[1]}", first(row[2]), abs(first(row[i])))
                        for i, name in ((4, "drop"), (6, "flow at the exact drop"))
                        for row in rows("stenosis", "parabola")),
          "cells per diameter", "error, % of the reference", -2)
    left.set_ylim(0.08)
    left.legend(fontsize=7.5, loc="lower left")
    lines(right, grouped((f"throat {row[1]}", first(row[2]), first(row[4]))
                         for row in rows("stenosis", "pressures")),
          "cells per diameter", "flow rate above the reference, %", log="x")
    right.set_ylim(0, 2)
    right.legend(fontsize=8)
    return figure


def stiff():
    figure, left, right = panels()
    viscous = [(values(row[0])[-1], values(row[2].replace("at t = 1 ", "")))
               for row in rows("stiff", "G* 0.1")]
    lines(left, grouped((name, ratio, energies[i])
                        for i, name in enumerate(("32 cells a side", "64 cells a side"))
                        for ratio, energies in viscous if len(energies) > i),
          "mu_s / mu_f", "kinetic energy at t = 1, dimensionless", log="x")
    limits = re.search(r"at t = 1 is ([\d.]+) on 32 cells, ([\d.]+) on 64", text_of("stiff"))
    for limit, colour in zip(limits.groups(), style.LINES):
        left.axhline(float(limit), color=colour, linestyle="--", linewidth=1)
    left.plot([], [], "--", label="rigid", **GREY)
    left.legend(fontsize=8)
    elastic = [row for row in rows("stiff", "G* 100") if "10^6" in row[0]]
    for row, colour, mark in zip(elastic, style.LINES, MARKS):
        stiffness, energies = values(row[0]), values(row[2])[1:]
        if " to " in row[2]:
            right.fill_between([stiffness[0], stiffness[-1]], *energies, color=colour, alpha=0.6,
                               label=row[1])
        else:
            right.plot(stiffness, energies, mark + "-", color=colour, label=row[1])
    right.set(xscale="log", xlabel="G*", ylabel="kinetic energy at t = 0.1, dimensionless")
    right.legend(fontsize=8)
    return figure


def stiff_rings():
    figure, left, right = panels()
    found = [[first(cell) for cell in row[1:4]] for row in rows("stiff_rings", "turning")]
    t, angle, rigid = np.transpose(found)
    left.plot(t, rigid, label="rigid", **GREY)
    left.plot(t, angle, "o", color=BLUE, label="G = 500")
    left.set(xlabel="t, 1 / shear rate", ylabel="angle, degrees")
    left.legend(fontsize=8)
    right.plot(t, angle - rigid, "o-", color=BLUE)
    right.axhline(0, **GREY)
    right.set(xlabel="t, 1 / shear rate", ylabel="angle less that of the rigid ring, degrees")
    return figure


def tetrahedra():
    figure, left, middle, right = panels(3, 7.9, 3.0)
    *flows, ours, theirs = rows("tetrahedra")
    for ax, i, name in ((left, 2, "u, of itself"), (middle, 4, "p, dimensionless")):
        lines(ax, [(row[0].split(",")[0] + (", t = 0.25" if "test" in row[0] else ""),
                    values(row[1]), values(row[i])) for row in flows],
              "cells a side", f"error of {name}", -2, at=[6, 12, 24, 64])
    vortex = [(f"{name}, {part}", values(row[1]), values(row[i])) for name, row in
              (("libfsi", ours), ("icoFoam", theirs)) for part, i in (("u", 2), ("p", 4))]
    lines(right, vortex, "cells in all", "error of the vortex, dimensionless")
    slope(right, vortex, -2/3, "order 2 in the width")
    logarithmic(right.xaxis, right.yaxis)
    for ax in (left, right):
        ax.legend(fontsize=6.5, loc="lower left")
    return figure


def torus():
    figure, left, right = panels()
    table = rows("torus")
    t = [first(row[0]) for row in table]
    left.plot(t, [first(row[5]) for row in table], "o-", color=BLUE, label="angle")
    left.set(xlabel="t, dimensionless", ylabel="angle of the axis to x, degrees", xticks=t)
    other = left.twinx()
    other.plot(t, [100 * first(row[3]) - 50 for row in table], "s--", color=ORANGE,
               label="off the axis")
    other.set_ylabel("off the axis, % of D")
    other.grid(False)
    left.legend(handles=[*left.lines, *other.lines], fontsize=8)
    lines(right, [(name, t, [first(row[i]) for row in table]) for i, name in
                  ((2, "x, % of D"), (4, "y, % of D"), (6, "angle, degrees"))],
          "t, dimensionless", "Courant numbers 0.5 and 0.1, apart", log="")
    right.axhline(0.5, color="k", linestyle=":", linewidth=1, label="asked of x")
    right.set_ylim(0, 0.85)
    right.legend(fontsize=8, loc="upper left", ncol=2)
    return figure


def vessel():
    figure, left, right = panels()
    table = rows("vessel")
    named = list(zip([table[0], *table], table))
    lines(left, [((before if row[0] == "the same" else row)[0].replace(" per diameter", ""),
                  [40, 80], values(row[2])) for before, row in named
                 if "80" in row[1]],
          "steps a period", "error, dimensionless", -2)
    split = [[values(row[0])[1], first(row[2]), first(row[3])]
             for row in rows("vessel", "split, outlets")]
    resistance, part, network = np.transpose(split)
    right.semilogx(resistance, network, label="network", **GREY)
    right.semilogx(resistance, part, "o", color=ORANGE, label="libfsi")
    right.set(xlabel="resistance of the right outlet, left 50", ylabel="left part of the flow")
    ticks(right.xaxis, resistance)
    right.legend(fontsize=8)
    legend(figure, left, 3)
    return figure


PICTURES = (balance, carried, cavity, edge, energy, flow, heavy_slab, inclusion, interface,
            kinematics, memory, mesh_quality, paper_mesh, paper_throat, passing_discs, pipe, ranks,
            reference_map, settling, shape, shear, slab, speed, speed_error, stability, stenosis,
            stiff, stiff_rings, tetrahedra, torus, vessel)


def main():
    style.apply()
    known = {draw.__name__: draw for draw in PICTURES}
    for page in sys.argv[1:] or known:
        if page not in known:
            sys.exit(f'no picture is called "{page}"; there are {", ".join(known)}')
        figure, path = known[page](), os.path.join(HERE, page + ".png")
        mark = pages.mark(pages.tables(text_of(page))[0])
        figure.savefig(path, dpi=style.DPI, facecolor="white", bbox_inches="tight", pad_inches=0.08,
                       metadata={"Description": mark, "Software": None})
        plt.close(figure)
        print(os.path.relpath(path, SOURCE), os.path.getsize(path) // 1000, "kB")


if __name__ == "__main__":
    main()
