"""The pictures of the pages on flow, interface and cost."""
import re

import numpy as np
from plot_parts import (BLUE, ORANGE, GREEN, GREY, rows, filled, values, first, grouped, panels,
                        panel, ticks, logarithmic, slope, lines, legend, style)


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


def energy():
    figure, ax = panel()
    series = grouped((f"{row[0].split()[0]}, {row[1]}, {row[2]} a side", C, abs(first(cell)))
                     for row in rows("energy")
                     for C, cell in zip((0.5, 0.25, 0.125), row[3:]) if cell)
    lines(ax, series, "Courant number", "change of the kinetic energy to t = 2, as a part of it", 3)
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
    found = rows("ranks")
    for column, name, shift in ((2, "at the start", -0.25), (3, "t = 10, kept", 0), (4, "t = 10, divided anew", 0.25)):
        given = [(i, first(row[column])) for i, row in enumerate(found) if row[column]]
        ax.bar([i + shift for i, _ in given], [part for _, part in given], 0.25, label=name)
    ax.set_xticks(range(len(found)), [f"{row[0]}, {row[1]} ranks" for row in found])
    ax.set(ylabel="solid cells, largest rank over mean")
    legend(figure, ax, 3)
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


PICTURES = (carried, cavity, energy, flow, interface, memory, pipe, ranks, speed, speed_error,
            stenosis, tetrahedra, vessel)
