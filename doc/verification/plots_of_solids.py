"""The pictures of the pages on solids."""
import re

import numpy as np
from plot_parts import (MARKS, BLUE, ORANGE, GREY, text_of, rows, filled, values, first, grouped,
                        panels, panel, ticks, logarithmic, lines, legend, style)


def balance():
    figure, ax = panel()
    found = [(first(row[0]), values(row[3])) for row in rows("balance", "disc")]
    lines(ax, [(f"density {ratio}", [n for n, _ in found], [parts[i] for _, parts in found])
               for i, ratio in enumerate(("0.5", "5"))],
          "cells a side", "work not found again, %", -1)
    ticks(ax.yaxis, [3, 5, 7, 10])
    ax.legend(fontsize=8)
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


def lodging():
    figure, left, right = panels()
    found = [(row[0], values(row[1]), values(row[3])) for row in rows("lodging")]
    pressures = [0.5, 1, 1.4]
    lines(left, [(name, pressures if len(x) == 3 else [1], x) for name, x, _ in found],
          "pressure at the inlet", "x of the centroid at rest", log="")
    names = [name for name, _, held in found if held]
    for i, held in enumerate(held for _, _, held in found if held):
        right.plot([held[0], held[-1]], [i, i], "|-", color=BLUE if i else ORANGE, markersize=9)
    right.set(yticks=range(len(names)), xlabel="largest pressure held")
    right.set_yticklabels(names, fontsize=7.5)
    legend(figure, left, 3)
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


def migration():
    figure, ax = panel()
    lines(ax, grouped((row[0] + how, first(row[1]), first(row[column]))
                      for column, how in ((2, ""), (3, ", mesh along")) for row in rows("migration")),
          "cells per diameter of the tube", "way towards the axis at t = 3", at=(16, 24), log="")
    legend(figure, ax, 2)
    return figure


def oscillation():
    figure, ax = panel()
    lines(ax, grouped((f"{row[0]}, m = {row[1]}", first(row[2]), first(row[3])) for row in rows("oscillation")),
          "cells a radius", "error of q", -2)
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
    fine = [row for row in table if row[1] == "24"]
    place = np.arange(len(fine))
    of_body = {row[0]: at for row, at in zip(fine, place)}
    for column, throat, shift in ((2, 6, -0.27), (3, 3, 0), (4, 1, 0.27)):
        ax.bar(place + shift, [first(row[column]) for row in fine], 0.25,
               color=style.LINES[column - 2], label=f"throat {throat}, 24 cells")
    finer = [row for row in table if row[1] == "32"]
    ax.plot([of_body[row[0]] - 0.27 for row in finer], [first(row[2]) for row in finer], "k+",
            markersize=11, label="throat 6, 32 cells")
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
    ticks(ax.yaxis, [0.005, 0.01, 0.02, 0.04])
    ax.set(xlabel="cells a radius", ylabel="distance from the rigid disc, radii")
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
    right.legend(fontsize=8, loc=(0.05, 0.1))
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
    right.axhline(0.15, color="k", linestyle=":", linewidth=1, label="asked of x, y")
    right.set_ylim(0, 0.25)
    right.legend(fontsize=8, loc="upper left", ncol=2)
    return figure


PICTURES = (balance, edge, heavy_slab, inclusion, kinematics, lodging, mesh_quality, migration, oscillation, paper_mesh,
            paper_throat, passing_discs, reference_map, settling, shape, shear, slab, stability,
            stiff, stiff_rings, torus)
