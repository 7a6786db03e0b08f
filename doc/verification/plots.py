#!/usr/bin/python3
"""Draws the pictures of these pages from their tables: plots.py [PAGE...]

PAGE.png holds what stands in the table of PAGE.md and a mark of that table, by which tests/reference/pages.py
tells whether it has changed since. Without a PAGE all are drawn. disc.png and paper.png show fields.
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

MARKS = "osD^vPX*<>"
BLUE, ORANGE, GREEN, ROSE, AMBER, SKY = style.LINES


def values(cell):
    """The numbers of a cell; 1 234 is one of them, and 10^4, too."""
    cell = re.sub(r"10\^(\d)", r"1e\1", re.sub(r"(?<=\d) (?=\d{3}\b)", "", cell))
    return [float(word) for word in re.findall(r"(?<![\w.])[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?", cell)]


def first(cell):
    """The first number of a cell; none where it has none."""
    return (values(cell) or [np.nan])[0]


def text_of(page):
    with open(os.path.join(HERE, page + ".md"), encoding="utf-8") as file:
        return file.read()


def rows(page):
    """The rows of a page's table without its head, as lists of cells."""
    lines = pages.tables(text_of(page))[0].strip().split("\n")[2:]
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines]


def panels(count=2, width=7.2, height=3.0):
    figure, axes = plt.subplots(1, count, figsize=(width, height), squeeze=False, layout="constrained")
    figure.get_layout_engine().set(wspace=0.06)
    return figure, axes[0]


def ticks(axis, at):
    """Labels at the numbers that were measured, and nowhere else."""
    axis.set_major_locator(matplotlib.ticker.FixedLocator(sorted(set(at))))
    axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: f"{x:g}"))
    axis.set_minor_locator(matplotlib.ticker.NullLocator())


def short(x, _=None):
    """A number as the tables write it: 2e-3."""
    return f"{x:g}" if 0.01 <= abs(x) < 1e4 or x == 0 else re.sub(r"e([+-])0?", r"e\1", f"{x:.0e}").replace("e+", "e")


def logarithmic(axis):
    """Labels at 1, 2 and 5 of each decade; at 1 alone where there are more than three decades."""
    low, high = axis.get_view_interval()
    subs = (1, 2, 5) if high < 300 * low else (1,)
    axis.set_major_locator(matplotlib.ticker.LogLocator(subs=subs))
    axis.set_major_formatter(matplotlib.ticker.FuncFormatter(short))
    axis.set_minor_locator(matplotlib.ticker.NullLocator())


def lines(ax, series, xlabel, ylabel, order=None, at=None, log="xy"):
    """Lines of (label, x, y) with markers; the slope of an order beside them, dashed."""
    ax.set(xscale="log" if "x" in log else "linear", yscale="log" if "y" in log else "linear",
           xlabel=xlabel, ylabel=ylabel)
    for (label, x, y), mark, colour in zip(series, itertools.cycle(MARKS), itertools.cycle(style.LINES)):
        ax.plot(x, y, mark + "-", color=colour, label=label, markersize=4.5)
    if order is not None:
        x = np.array([min(min(x) for _, x, _ in series), max(max(x) for _, x, _ in series)], dtype=float)
        below = 0.75 * min(y / x ** order for _, xs, ys in series for x, y in zip(xs, ys))
        ax.plot(x, below * x ** order, "--", color="0.4", linewidth=1, label=f"order {abs(order):g}")
    if "y" in log:
        logarithmic(ax.yaxis)
    if at == "auto":
        logarithmic(ax.xaxis)
    else:
        ticks(ax.xaxis, at or [n for _, x, _ in series for n in x])


def legend(figure, ax, columns, **more):
    """The legend of an axes below the whole figure."""
    handles, labels = ax.get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", bbox_to_anchor=(0.5, 0), ncol=columns, fontsize=8, **more)


def filled(table, column=0):
    """The rows with the name of the row before where theirs is empty."""
    name = ""
    for row in table:
        name = row[column] or name
        yield [*row[:column], name, *row[column + 1:]]


def balance():
    figure, (ax,) = panels(1, 6.2)
    found = [(values(row[0])[0], values(row[3])) for row in rows("balance") if row[0].startswith("disc")]
    cells = [n for n, _ in found]
    lines(ax, [(f"density {ratio}", cells, [part[i] for _, part in found]) for i, ratio in
               enumerate(("0.5", "5"))], "cells a side", "work not found again, %", -1)
    ticks(ax.yaxis, [3, 5, 7, 10])
    ax.legend(fontsize=8)
    return figure


def carried():
    figure, (left, right) = panels()
    table = rows("carried")
    spheres = [(row[0], values(row[2]), values(row[3])) for row in table if row[0].startswith("sphere")]
    lines(left, spheres, "way, diameters", "centroid off, diameters")
    left.legend(fontsize=8, loc="center right")
    discs = [row for row in table if row[0].startswith("disc")]
    lines(right, [(f"r / h = {row[1]}", values(row[2]), values(row[3])) for row in discs],
          "Courant number", "centroid ahead, % of the way", at=[0.05, 0.1, 0.2, 0.5])
    for row, colour in zip(discs, style.LINES):
        right.axhline(float(row[4]), color=colour, linestyle=":", linewidth=1)
    right.plot([], [], ":", color="0.4", label="h²/(12 r²)")
    right.legend(fontsize=7.5, loc="lower left", ncol=2)
    right.set_ylim(0.006)
    return figure


def cavity():
    figure, (left, right) = panels()
    table = rows("cavity")
    of = {re: [row for row in table if row[0] == re] for re in ("100", "1000")}
    cells = {re: [first(row[1]) for row in of[re]] for re in of}
    lines(left, [(f"Re {re}", cells[re], [first(row[5]) for row in of[re]]) for re in of],
          "cells a side", "error of the profiles, lid's speed 1", -2)
    left.legend(fontsize=8)
    lines(right, [(f"{name}, Re {re}", cells[re], [abs(first(row[i])) for row in of[re]])
                  for re in of for i, name in ((2, "least u"), (3, "least v"), (4, "largest v"))],
          "cells a side", "error, % of the reference", -2)
    right.legend(fontsize=7)
    return figure


def edge():
    figure, (left, right) = panels()
    times = [0.8, 1.2, 1.6]
    found = [(row[0], [values(cell) for cell in row[1:4]]) for row in rows("edge")]
    for ax, i, label in ((left, 0, "x of the centroid, sides of the duct"), (right, 1, "velocity along x")):
        lines(ax, [(name, times, [pair[i] for pair in pairs]) for name, pairs in found],
              "t, dimensionless", label, log="")
    legend(figure, left, 2)
    return figure


def energy():
    figure, (ax,) = panels(1, 6.2, 3.2)
    series = []
    for row in rows("energy"):
        changes = [abs(first(cell)) for cell in row[3:] if cell]
        series.append((f"{row[0].split()[0]}, {row[1]}, {row[2]} a side", [0.5, 0.25, 0.125][:len(changes)],
                       changes))
    lines(ax, series, "Courant number", "part of the kinetic energy lost to t = 2", 3)
    legend(figure, ax, 2)
    return figure


def flow():
    figure, axes = panels()
    found = []
    for row in filled(rows("flow")):
        found.append((row[0].split(",")[0] + ", " + re.sub(r" [\d, ]+$", "", row[1]), values(row[1]), row))
    for ax, i, name in ((axes[0], 2, "u"), (axes[1], 4, "p")):
        lines(ax, [(label, cells, values(row[i])) for label, cells, row in found], "cells a side",
              f"L2 error of {name}, dimensionless", -2)
    legend(figure, axes[0], 3)
    return figure


def heavy_slab():
    figure, (left, right) = panels()
    found = [(f"density {row[0]}", values(row[1]), values(row[2]), "steps" in row[1]) for row in rows("heavy_slab")]
    lines(left, [line[:3] for line in found if not line[3]], "cells across a half",
          "error of u, of the amplitude", -2, at=[16, 32, 64])
    left.legend(fontsize=7)
    lines(right, [line[:3] for line in found if line[3]], "steps a period", "error of u in time, dimensionless", -2)
    right.legend(fontsize=7.5)
    return figure


def inclusion():
    figure, (left, right) = panels()
    table = rows("inclusion")
    for ax, column, label in ((left, 2, "error of u, dimensionless"), (right, 3, "error of the strain, %")):
        series = []
        for ratio in ("5", "0.2"):
            of = [row for row in table if row[0] == ratio]
            series += [(f"ratio {ratio}, {way}", [first(row[1]) for row in of],
                        [values(row[column])[i] for row in of])
                       for i, way in enumerate(("along the grid", "at 45 degrees"))]
        lines(ax, series, "cells a radius", label, -2)
    legend(figure, left, 3)
    return figure


def interface():
    figure, axes = panels()
    for ax, kinds, order in ((axes[0], ("quads", "triangles"), -1), (axes[1], ("hexes", "tets"), -2 / 3)):
        lowest = []
        for kind, colour, mark in zip(kinds, (BLUE, ORANGE), "os"):
            of = [row for row in rows("interface") if row[0].startswith(kind)]
            cells, errors = [first(row[1]) for row in of], [first(row[3]) for row in of]
            ax.loglog(cells, errors, mark + "-", color=colour, label=kind, markersize=5)
            published = [(values(row[4] + " ()")) for row in of]
            at = [pair[1] if "cells)" in row[4] else n for pair, row, n in zip(published, of, cells)]
            ax.loglog(at, [pair[0] for pair in published], mark + ":", color=colour, markersize=6,
                      markerfacecolor="white", label=f"{kind}, published")
            lowest += list(zip(cells, errors))
        n = np.array([min(n for n, _ in lowest), max(n for n, _ in lowest)], dtype=float)
        ax.plot(n, 0.75 * min(e / m ** order for m, e in lowest) * n ** order, "--", color="0.4", linewidth=1,
                label="order 2 in the width")
        ax.set(xlabel="cells", ylabel="shape error, dimensionless")
        logarithmic(ax.xaxis)
        logarithmic(ax.yaxis)
        ax.legend(fontsize=7.5)
    axes[0].set_title("disc in the vortex", loc="left")
    axes[1].set_title("sphere in the deformation flow", loc="left")
    return figure


def kinematics():
    figure, axes = panels()
    table = rows("kinematics")
    at = next(i for i, row in enumerate(table) if row[0].startswith("smooth shear"))
    cells = values(table[at][0])
    for ax, row, kind in ((axes[0], table[at], "quads"), (axes[1], table[at + 1], "triangles")):
        lines(ax, [(name, cells, values(cell)[:2]) for name, cell in
                   zip(("left_cauchy_green", "log_conformation", "reference_map"), row[1:])],
              "cells a side", "L2 error of B, dimensionless", -2)
        ax.set_title(f"smooth shear, {kind}", loc="left")
    legend(figure, axes[0], 4)
    return figure


def memory():
    figure, (ax,) = panels(1, 6.2)
    table = rows("memory")
    place = np.arange(len(table))
    for column, name, colour, shift in ((3, ".msh", BLUE, -0.2), (4, ".h5", ORANGE, 0.2)):
        most = [values(row[column])[0] for row in table]
        least = [values(row[column])[-1] for row in table]
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
    figure, (ax,) = panels(1, 6.2, 3.2)
    for column, G, fill in ((4, "0.1", True), (6, "10", False)):
        for kind, colour, mark in (("quads", BLUE, "o"), ("halves", ORANGE, "s"), ("triangles", GREEN, "^")):
            of = [row for row in rows("mesh_quality") if row[0].startswith(kind) and row[column]]
            ax.plot([first(row[1]) for row in of], [first(row[column]) for row in of],
                    mark + ("-" if fill else ":"), color=colour, markersize=5.5,
                    markerfacecolor=colour if fill else "white", label=f"{kind}, G* {G}")
    ax.set(yscale="log", xlabel="non-orthogonality, degrees", ylabel="L2 of the centroid, sides of the cavity")
    logarithmic(ax.yaxis)
    legend(figure, ax, 2)
    return figure


def paper_mesh():
    figure, axes = panels()
    kinds = {"at rest": [], "half of the pipe": [], "moving": [], "moving, graded": [], "moving, graded, half": []}
    for row in rows("paper_mesh"):
        name = re.sub(r"^\d+, |, fine = [\d.]+| of the pipe$", "", row[0])
        kinds["half of the pipe" if name == "half" else name].append((first(row[0]), values(row[3])[1], first(row[2])))
    for ax, i, label in ((axes[0], 1, "angle at t = 20, degrees"), (axes[1], 2, "x at t = 20, diameters")):
        lines(ax, [(name, [p[0] for p in found], [p[i] for p in found]) for name, found in kinds.items()],
              "cells per diameter", label, log="x")
    legend(figure, axes[0], 3)
    return figure


def paper_throat():
    figure, (ax,) = panels(1, 7.2, 3.2)
    table = rows("paper_throat")
    fine = [row for row in table if row[1] == "24"]
    place = np.arange(len(fine))
    for column, name, colour, shift in ((2, "throat 6", BLUE, -0.27), (3, "throat 3", ORANGE, 0),
                                        (4, "throat 1", GREEN, 0.27)):
        ax.bar(place + shift, [first(row[column]) for row in fine], 0.25, color=colour, label=name)
    coarse = {row[0]: first(row[2]) for row in table if row[1] == "16"}
    ax.plot(place - 0.27, [coarse[row[0]] for row in fine], "k_", markersize=11, label="throat 6, 16 cells")
    ax.set_xticks(place, [row[0].replace(" of the volume", "\nof the volume") for row in fine], fontsize=8)
    ax.set(ylabel="flow kept back, at most, %")
    ax.grid(axis="x")
    ax.legend(fontsize=8)
    return figure


def passing_discs():
    figure, (ax,) = panels(1, 6.2, 3.2)
    kinds = {}
    for row in rows("passing_discs"):
        kinds.setdefault(f"y0 {row[1]}, G {row[3].split(',')[0]}", []).append(
            (first(row[0]), first(row[4]), first(row[5])))
    for (name, found), colour, mark in zip(kinds.items(), style.LINES, MARKS):
        n = [p[0] for p in found]
        ax.loglog(n, [p[1] for p in found], mark + "-", color=colour, label=f"{name}, at the same time")
        ax.loglog(n, [p[2] for p in found], mark + ":", color=colour, markerfacecolor="white",
                  label=f"{name}, at the same x")
    ticks(ax.xaxis, [6, 10, 20])
    ticks(ax.yaxis, [0.005, 0.01, 0.02, 0.03])
    ax.set(xlabel="cells a radius", ylabel="distance from the rigid disc, radii")
    legend(figure, ax, 2)
    return figure


def pipe():
    figure, (left, right) = panels()
    found = {}
    for row in rows("pipe"):
        kind = row[0].split(",")[0]
        found.setdefault(f"{kind}, t = {row[1]}", []).append((first(row[0].split(",")[1]), first(row[2]), first(row[4])))
    for ax, i, label in ((left, 1, "L2 error of u, of 2 U"), (right, 2, "error of the driving gradient, %")):
        lines(ax, [(name, [p[0] for p in of], [p[i] for p in of]) for name, of in found.items()],
              "cells per diameter", label, -2)
        ax.legend(fontsize=8)
    return figure


def ranks():
    figure, (ax,) = panels(1, 6.2, 3.2)
    series = []
    for row in rows("ranks"):
        run = values(row[4])
        name = row[0].replace("columns with the solid's load", "columns")
        series.append((f"{name}, {row[1]} ranks", [0, 1, 3, 5, 10][:1 + len(run)], [first(row[2]), *run]))
    lines(ax, series, "t, dimensionless", "solid cells, largest rank over mean", log="")
    legend(figure, ax, 2)
    return figure


def reference_map():
    figure, axes = panels()
    found = []
    names = ["", ""]
    for row in rows("reference_map"):
        names = [row[0] or names[0], row[1] or names[1]]
        n = values(row[2])
        found.append((f"{names[0]}, {names[1]}" + (", mid-cell" if n[0] % 2 else ""), n, row))
    for ax, i, name in ((axes[0], 3, "u, of the walls' speed"), (axes[1], 5, "B_xy, of itself")):
        lines(ax, [(label, n, values(row[i])) for label, n, row in found], "cells across a half",
              f"error of {name}", -2, at=[32, 64])
    legend(figure, axes[0], 2)
    return figure


def settling():
    figure, (ax,) = panels(1, 6.2, 3.2)
    ax.axhspan(0.99, 1.01, color="0.9", label="1 %")
    for body, columns in (("disc", ((3, "disc, n = 32"), (4, "disc, n = 64"), (5, "disc, triangles, n = 32"))),
                          ("sphere", ((3, "sphere, n = 16"), (4, "sphere, n = 24")))):
        of = [row for row in rows("settling") if row[0].startswith(body)]
        for column, name in columns:
            kept = [(first(row[1]), first(row[column])) for row in of if row[column]]
            i = len(ax.lines)
            ax.plot(*zip(*kept), MARKS[i] + "-", color=style.LINES[i], label=name, markersize=5)
    ax.set(xscale="log", xlabel="density of the solid over that of the fluid", ylabel="speed over the exact one")
    ticks(ax.xaxis, [0.1, 0.5, 1.1, 2, 5, 10, 20])
    legend(figure, ax, 3)
    return figure


def shape():
    figure, (left, right) = panels()
    kinds = ("log_conformation", "reference_map", "log_conformation, no memory")
    table = rows("shape")
    ring = [row for row in table if re.match(r"ring, (aspect at )?t = ", row[0])]
    lines(left, [(kind, [values(row[0])[-1] for row in ring if row[i]],
                  [first(row[i]) for row in ring if row[i]]) for i, kind in enumerate(kinds, 1)],
          "t, dimensionless", "aspect of the ring's sections", log="x")
    discs = [row for row in table if row[0].startswith("pressed")]
    for row, dash in zip(discs, ("-", "--", ":")):
        for i, (colour, mark) in enumerate(zip(style.LINES, MARKS[:3]), 1):
            if "folds" not in row[i]:
                right.plot([1, 2, 3], values(row[i]), mark + dash, color=colour, markersize=4.5)
        right.plot([], [], "k" + dash, label=re.match(r"pressed, (G\* \d+, g \d+)", row[0]).group(1))
    right.set(xlabel="t, dimensionless", ylabel="height of the disc, sides of the cavity")
    ticks(right.xaxis, [1, 2, 3])
    right.set_ylim(0.08, 0.19)
    right.legend(fontsize=7.5, ncol=2, loc="upper left")
    legend(figure, left, 3)
    return figure


def shear():
    figure, (ax,) = panels(1, 6.4, 3.3)
    names = []
    for i, row in enumerate(filled(rows("shear"))):
        names.append(f"{row[0].split(', Re')[0]}, Ca {row[1]}, ratio {row[2]}, n {row[3]}")
        once = {} if i else {"D": "D", "angle": "angle", "limit": "required"}
        ax.plot(first(row[5]), i, "o", color=BLUE, label=once.get("D"))
        ax.plot(first(row[6]), i, "s", color=ORANGE, label=once.get("angle"))
        ax.plot(first(row[7]), i, "|", color="k", markersize=12, markeredgewidth=1.5, label=once.get("limit"))
    ax.set_yticks(range(len(names)), names, fontsize=8)
    ax.invert_yaxis()
    ax.set(xscale="log", xlabel="largest error, %")
    ticks(ax.xaxis, [0.1, 0.2, 0.5, 1, 2, 5])
    ax.legend(fontsize=8, loc="upper right")
    return figure


def slab():
    figure, axes = panels()
    chosen = {"mu_s = 1, surface on faces": "quads, on faces", "mu_s = 1, surface in mid-cell": "quads, in mid-cell",
              "mu_s = 1, triangles, on faces": "triangles, on faces", "the same on tetrahedra": "tetrahedra, on a wall",
              "mu_s = 0, on faces": "mu_s = 0, quads", "left_cauchy_green, mu_s = 0, on faces":
              "mu_s = 0, left_cauchy_green"}
    found = [(chosen[row[0]], values(row[1]), row) for row in rows("slab") if row[0] in chosen]
    for ax, i, name in ((axes[0], 2, "u, of the walls' speed"), (axes[1], 4, "B_xy, of itself")):
        lines(ax, [(label, n, values(row[i])) for label, n, row in found], "cells across a half",
              f"error of {name}", -2, at=[8, 16, 32, 64])
    legend(figure, axes[0], 4)
    return figure


def speed():
    figure, (ax,) = panels(1, 6.2)
    found = [row for row in rows("speed") if row[2]]
    place = np.arange(len(found))
    for column, name, colour, shift in ((1, "one rank", BLUE, -0.2), (2, "two ranks", ORANGE, 0.2)):
        times = [first(row[column].strip("*")) for row in found]
        ax.barh(place + shift, times, 0.36, color=colour, label=name)
        for y, x in zip(place + shift, times):
            ax.text(x, y, f" {x:.2f}", va="center", fontsize=8)
    ax.set_yticks(place, [row[0].strip("*").split(",")[0] for row in found])
    ax.invert_yaxis()
    ax.set(xlabel="microseconds a cell and step")
    ax.grid(axis="y")
    ax.legend(fontsize=8)
    return figure


def speed_error():
    figure, (ax,) = panels(1, 7.2, 3.9)
    kinds = {}
    for row in rows("speed_error"):
        Co = row[3] or re.search(r"Co (\S+)", row[0]).group(1)
        kinds.setdefault((row[0].split(",")[0], row[1], Co), []).append([first(cell) for cell in (row[2], row[4], row[5])])
    colours = {"log_conformation": BLUE, "left_cauchy_green": ORANGE, "reference_map": GREEN, "OpenFOAM": "k"}
    for (name, mesh, Co), found in kinds.items():
        ax.loglog([p[1] for p in found], [p[2] for p in found], "--" if name == "OpenFOAM" else "-",
                  marker="^" if mesh == "triangles" else "D" if Co == "0.8" else "s", color=colours[name],
                  label=f"{name}, {mesh}, Courant number {Co}", markersize=5.5,
                  markerfacecolor="white" if mesh == "triangles" or Co == "0.8" else colours[name])
        for n, x, y in found:
            place = (-2, -11) if name == "left_cauchy_green" else (4, 4)
            ax.annotate(f"{n:g}", (x, y), place, textcoords="offset points", fontsize=7.5, color=colours[name])
    ax.set(xlabel="CPU seconds, one core", ylabel="L2 error of the centroid, sides of the cavity")
    logarithmic(ax.xaxis)
    logarithmic(ax.yaxis)
    ax.set_title("the figures at the points: cells a side", loc="left", fontsize=8.5)
    legend(figure, ax, 2)
    return figure


def stability():
    figure, axes = panels()
    kinds = {}
    for row in rows("stability"):
        if "to t = 100" not in row[0]:
            before = re.sub(r",? ?G\* \S+$", "", row[0]) or "quads, mu_s / mu_f 1"
            kinds.setdefault(before, []).append((first(row[0].split("G* ")[1]), first(row[2]), first(row[1])))
    for ax, i, label, log in ((axes[0], 1, "smallest eigenvalue of B", "x"), (axes[1], 2, "steps to t = 8.2", "xy")):
        lines(ax, [(name, [p[0] for p in found], [p[i] for p in found]) for name, found in kinds.items()],
              "G* = G / (rho U²)", label, log=log, at=[0.1, 1, 10, 100])
    ticks(axes[1].yaxis, [1000, 1500, 2000, 3000])
    legend(figure, axes[0], 3)
    return figure


def stenosis():
    figure, (left, right) = panels()
    table = rows("stenosis")
    def of(given, throat, column):
        kept = [row for row in table if row[0] == given and row[1] == throat]
        return [first(row[2]) for row in kept], [abs(first(row[column])) for row in kept]

    lines(left, [(f"{name}, throat {throat}", *of("parabola", throat, column))
                 for name, column in (("drop", 4), ("flow at the exact drop", 6)) for throat in ("6", "2")],
          "cells per diameter", "error, % of the reference", -2)
    left.set_title("parabola given", loc="left")
    left.legend(fontsize=7.5)
    lines(right, [(f"throat {throat}", *of("pressures", throat, 4)) for throat in ("6", "2")],
          "cells per diameter", "flow rate above the reference, %", log="x")
    right.set_title("pressures given", loc="left")
    right.set_ylim(0, 2)
    right.legend(fontsize=8)
    return figure


def stiff():
    figure, (left, right) = panels()
    table = rows("stiff")
    limits = re.search(r"rigid limit at t = 1 is ([\d.]+) on 32 cells, ([\d.]+) on 64", text_of("stiff"))
    viscous = [(values(row[0])[-1], values(row[2].replace("at t = 1 ", ""))) for row in table if "mu_s" in row[0]]
    for i, name in enumerate(("32 cells a side", "64 cells a side")):
        found = [(ratio, energies[i]) for ratio, energies in viscous if len(energies) > i]
        left.plot(*zip(*found), MARKS[i] + "-", color=style.LINES[i], label=name)
        left.axhline(float(limits.group(i + 1)), color=style.LINES[i], linestyle="--", linewidth=1)
    left.plot([], [], "--", color="0.4", label="rigid")
    left.set(xscale="log", xlabel="mu_s / mu_f", ylabel="kinetic energy at t = 1, dimensionless")
    ticks(left.xaxis, [100, 200, 300, 500, 1000])
    left.legend(fontsize=8)
    for row, colour, mark in zip([row for row in table if "10^6" in row[0]], style.LINES, MARKS):
        stiffness, energies = values(row[0].replace("G*", "")), values(row[2])[1:]
        if " to " in row[2]:
            right.fill_between([100, 1e6], *energies, color=colour, alpha=0.6, label=row[1])
        else:
            right.plot(stiffness, energies, mark + "-", color=colour, label=row[1])
    right.set(xscale="log", xlabel="G*", ylabel="kinetic energy at t = 0.1, dimensionless")
    right.legend(fontsize=8)
    return figure


def stiff_rings():
    figure, (left, right) = panels()
    found = [[first(cell) for cell in row[1:4]] for row in rows("stiff_rings") if row[0] == "turning"]
    t = [p[0] for p in found]
    left.plot(t, [p[2] for p in found], "-", color="0.4", label="rigid")
    left.plot(t, [p[1] for p in found], "o", color=BLUE, label="G = 500")
    left.set(xlabel="t, 1 / shear rate", ylabel="angle, degrees")
    left.legend(fontsize=8)
    right.plot(t, [p[1] - p[2] for p in found], "o-", color=BLUE)
    right.axhline(0, color="0.4", linewidth=1)
    right.set(xlabel="t, 1 / shear rate", ylabel="angle less that of the rigid ring, degrees")
    return figure


def tetrahedra():
    figure, axes = panels(3, 7.9, 3.0)
    table = rows("tetrahedra")
    flows = [(row[0].split(",")[0] + (", t = 0.25" if "test" in row[0] else ""), values(row[1]), row)
             for row in table if "in all" not in row[1]]
    for ax, i, name in ((axes[0], 2, "u, of itself"), (axes[1], 4, "p, dimensionless")):
        lines(ax, [(label, n, values(row[i])) for label, n, row in flows], "cells a side",
              f"error of {name}", -2, at=[6, 12, 24, 64])
    axes[0].legend(fontsize=6.5, loc="lower left")
    pair = [(f"{name}, {part}", values(row[1]), values(row[i])) for row, name in zip(table[-2:], ("libfsi", "icoFoam"))
            for part, i in (("u", 2), ("p", 4))]
    lines(axes[2], pair, "cells in all", "error of the vortex, dimensionless", -2 / 3, at="auto")
    axes[2].lines[-1].set_label("order 2 in the width")
    axes[2].legend(fontsize=6.5, loc="lower left")
    return figure


def torus():
    figure, (left, right) = panels()
    table = rows("torus")
    t = [first(row[0]) for row in table]
    left.plot(t, [first(row[5]) for row in table], "o-", color=BLUE, label="angle")
    left.set(xlabel="t, dimensionless", ylabel="angle of the axis to x, degrees", xticks=t)
    other = left.twinx()
    other.plot(t, [100 * first(row[3]) - 50 for row in table], "s--", color=ORANGE, label="off the axis")
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
    figure, (left, right) = panels()
    table = rows("vessel")
    series = []
    for before, row in zip([None, *table], table):
        if "40, 80 steps" in row[1]:
            series.append((before[0].replace(" per diameter", ""), [40, 80], values(row[2])))
        elif row[0] == "windkessel":
            series.append(("windkessel, pressure", [40, 80], values(row[2])))
    lines(left, series, "steps a period", "error, dimensionless", -2)
    splits = [(values(row[0])[1], first(row[2]), first(row[3])) for row in table if row[0].startswith("split, outlets")]
    lines(right, [("network", [p[0] for p in splits], [p[2] for p in splits])],
          "resistance of the right outlet, left 50", "left part of the flow", log="x")
    right.lines[0].set(marker="None", color="0.4")
    right.plot([p[0] for p in splits], [p[1] for p in splits], "o", color=ORANGE, label="libfsi")
    right.legend(fontsize=8)
    legend(figure, left, 3)
    return figure


PICTURES = (balance, carried, cavity, edge, energy, flow, heavy_slab, inclusion, interface, kinematics, memory,
            mesh_quality, paper_mesh, paper_throat, passing_discs, pipe, ranks, reference_map, settling, shape,
            shear, slab, speed, speed_error, stability, stenosis, stiff, stiff_rings, tetrahedra, torus, vessel)


def main():
    style.apply()
    known = {draw.__name__: draw for draw in PICTURES}
    for page in sys.argv[1:] or known:
        if page not in known:
            sys.exit(f'no picture is called "{page}"; there are {", ".join(known)}')
        figure, path = known[page](), os.path.join(HERE, page + ".png")
        figure.savefig(path, dpi=style.DPI, facecolor="white", bbox_inches="tight", pad_inches=0.08,
                       metadata={"Description": pages.mark(pages.tables(text_of(page))[0]), "Software": None})
        plt.close(figure)
        print(os.path.relpath(path, SOURCE), os.path.getsize(path) // 1000, "kB")


if __name__ == "__main__":
    main()
