#!/usr/bin/python3
"""Pictures of a run: draw.py FOLDER writes interface.png, flow.png, series.png into FOLDER.

draw.py FOLDER --plane x draws the flow in the plane of that normal through the solid's centre.
"""
import argparse
import itertools
import json
import os
import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

from fields import Snapshot, isosurface, series, table  # noqa: E402
from planes import AXES, Slice, cuts_of, has_solid, normal_of  # noqa: E402

plt.rcParams.update({
    "figure.dpi": 130, "savefig.bbox": "tight", "font.size": 10, "axes.titlesize": 10,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.25,
    "legend.frameon": False, "lines.linewidth": 1.4, "image.cmap": "viridis",
})
SOLID = "#c8402f"
INK = "#23395b"
COLOURS = (INK, SOLID, "#3a8f6a", "#b8860b", "#6a4c93", "#5b8db8")


def chosen(items, count):
    """`count` of the items, evenly spread, first and last among them."""
    if len(items) <= count:
        return list(items)
    return [items[i] for i in np.unique(np.linspace(0, len(items) - 1, count).round().astype(int))]


def panel(axes, cut):
    axes.set_aspect("equal")
    axes.set_xlim(cut.low[0], cut.high[0])
    axes.set_ylim(cut.low[1], cut.high[1])
    axes.set_xlabel(AXES[cut.across[0]])
    axes.set_ylabel(AXES[cut.across[1]])
    axes.grid(False)


def draw_flow(folder, items, normal=2):
    """|u| with streamlines and the interface, at up to four times."""
    items = chosen(items, 4)
    cuts = list(cuts_of(items, normal))
    size = cuts[0].high - cuts[0].low
    wide = size[0] > 2 * size[1]
    rows, columns = (len(items), 1) if wide else (1, len(items))
    width, height = (9, 8.4 * size[1] / size[0] + 0.65) if wide else (3.6, 3.9)
    figure, axes = plt.subplots(rows, columns, squeeze=False, layout="constrained",
                                figsize=(width * columns, height * rows))
    top = max(np.linalg.norm(cut["u"], axis=1).max() for cut in cuts)
    shades = None
    for ax, cut in zip(axes.flat, cuts):
        speed = np.linalg.norm(cut["u"], axis=1)
        shades = ax.tripcolor(cut.triangles, speed, shading="gouraud", vmin=0, vmax=top)
        x, y, ux = cut.grid(cut["u"][:, cut.across[0]])
        uy = cut.grid(cut["u"][:, cut.across[1]])[2]
        ax.streamplot(x, y, ux, uy, color=(1, 1, 1, 0.55), linewidth=0.6, arrowsize=0.6,
                      density=(1.6, 0.6) if wide else 1.1)
        if "alpha" in cut.snapshot:
            cut.outline(ax, SOLID)
        panel(ax, cut)
        where = "" if cut.snapshot.dim == 2 else f"   plane {AXES[cut.normal]} = {cut.level:.4g}"
        ax.set_title(f"t = {cut.snapshot.time:.4g}{where}", loc="left")
    figure.colorbar(shades, ax=axes, label="|u|", shrink=0.8, aspect=30,
                    location="bottom" if wide else "right")
    return save(figure, folder, "flow.png")


def while_solid(items):
    """The items up to the last one with solid in it."""
    items = list(items)
    while items and not has_solid(Snapshot(*items[-1])):
        items.pop()
    return items


def interface_title(items, all_items):
    left = "" if len(items) == len(all_items) else \
        f"; none is left at t = {all_items[len(items)][1]:.4g}"
    return "interface, $\\alpha$ = 0.5" + left


def draw_interface_2d(folder, items, title):
    """The line alpha = 0.5 at up to eight times."""
    items = chosen(items, 8)
    figure, ax = plt.subplots(figsize=(5.4, 5.0), layout="constrained")
    colours = plt.get_cmap("plasma")(np.linspace(0.0, 0.9, len(items)))
    for item, colour in zip(items, colours):
        cut = Slice(Snapshot(*item))
        cut.outline(ax, colour, 1.6)
        ax.plot([], [], color=colour, label=f"t = {item[1]:.3g}")
        panel(ax, cut)
    ax.set_title(title, loc="left")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return save(figure, folder, "interface.png")


def lit(triangles, colour):
    """The colour of each triangle under one lamp, both sides alike."""
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True) + 1e-300
    lamp = np.array([-0.3, -0.75, 0.6])
    light = 0.35 + 0.65 * np.abs(normal @ (lamp / np.linalg.norm(lamp)))
    return np.outer(light, matplotlib.colors.to_rgb(colour))


def in_one_piece(triangles, low, high):
    """The surface of a solid that crosses a periodic seam, its two parts side by side."""
    for i in range(3):
        size, x = high[i] - low[i], triangles[:, :, i].mean(axis=1)
        steps = np.diff(np.sort(x))
        k = steps.argmax()
        if steps[k] > size / 2:
            triangles[x > np.sort(x)[k], :, i] -= size
    return triangles


def draw_interface_3d(folder, items, title):
    """The surface alpha = 0.5 at up to six times, each in a frame around the solid."""
    items = chosen(items, 6)
    columns = min(3, len(items))
    rows = -(-len(items) // columns)
    figure = plt.figure(figsize=(3.7 * columns, 3.6 * rows))
    for i, item in enumerate(items):
        snapshot = Snapshot(*item)
        triangles = isosurface(snapshot)
        ax = figure.add_subplot(rows, columns, i + 1, projection="3d")
        ax.set_title(f"t = {item[1]:.4g}", loc="left")
        if len(triangles) < 2:
            continue
        # Axes (x, z, y): y, the height across the pipe, upwards on the paper.
        low, high = snapshot.points.min(axis=0), snapshot.points.max(axis=0)
        triangles = in_one_piece(triangles, low, high)
        ax.add_collection3d(Poly3DCollection(triangles[:, :, [0, 2, 1]],
                                             facecolors=lit(triangles[:, :, [0, 2, 1]], SOLID)))
        middle = 0.5 * (triangles.min(axis=(0, 1)) + triangles.max(axis=(0, 1)))
        half = 0.5 * max((triangles.max(axis=(0, 1)) - triangles.min(axis=(0, 1))).max(),
                         min(high - low))
        ax.set_xlim(middle[0] - half, middle[0] + half)
        ax.set_ylim(middle[2] - half, middle[2] + half)
        ax.set_zlim(middle[1] - half, middle[1] + half)
        ax.set_box_aspect((1, 1, 1))
        ax.view_init(elev=16, azim=-68)
        ax.set_xlabel("x")
        ax.set_ylabel("z")
        ax.set_zlabel("y")
        ax.tick_params(labelsize=7)
    figure.suptitle(title, x=0.02, ha="left")
    return save(figure, folder, "interface.png")


PANELS = (
    # title, table, columns (NAME_*: all that begin so), logarithmic
    ("centroid", "solid", ("x", "y", "z"), False),
    ("velocity of the solid", "solid", ("ux", "uy", "uz"), False),
    ("angle of the axis to x, degrees", "solid", ("angle",), False),
    ("volume / first volume - 1", "solid", ("drift",), False),
    ("det B, smallest eigenvalue of B", "solid", ("det_B_min", "det_B_max", "min_eig_B"), False),
    ("pressure gradient", "flow", ("pressure_gradient",), False),
    ("flow rate", "flow", ("flow_rate",), False),
    ("flow rate of each opening, outward", "flow", ("flow_rate_*",), False),
    ("mean pressure of each opening", "flow", ("mean_pressure_*",), False),
    ("energy", "flow", ("kinetic_energy", "elastic_energy"), False),
    ("time step and its limit", "flow", ("dt", "dt_limit"), False),
    ("largest divergence", "flow", ("divergence_max",), True),
    ("pressure iterations a step", "flow", ("pressure_iterations",), False),
    ("seconds a step", "flow", ("wall_per_step",), False),
)


PANEL_COLUMNS = {title: columns for title, _, columns, _ in PANELS}


def draw_series(folder, tables):
    """Every column that a run has and that changes, against time; of openings the steady ones too."""
    shown = []
    for title, name, columns, logarithmic in PANELS:
        data = tables[name]
        columns = [c for wanted in columns for c in data
                   if c == wanted or (wanted.endswith("*") and c.startswith(wanted[:-1]))]
        of_openings = any(wanted.endswith("*") for wanted in PANEL_COLUMNS[title])
        lines = [(c, data[c]) for c in columns
                 if np.isfinite(data[c]).any() and (of_openings or np.ptp(data[c]) > 0)]
        if lines:
            shown.append((title, data["t"], lines, logarithmic))
    if not shown:
        return None
    columns = min(3, len(shown))
    rows = -(-len(shown) // columns)
    figure, axes = plt.subplots(rows, columns, squeeze=False, figsize=(4.0 * columns, 2.6 * rows),
                                layout="constrained")
    for ax in axes.flat[len(shown):]:
        ax.axis("off")
    for ax, (title, t, lines, logarithmic) in zip(axes.flat, shown):
        for (name, values), colour in zip(lines, itertools.cycle(COLOURS)):
            ax.plot(t, np.where(values > 0, values, np.nan) if logarithmic else values,
                    color=colour, label=name)
        if logarithmic:
            ax.set_yscale("log")
        if len(lines) > 1:
            ax.legend(fontsize=8)
        ax.set_title(title, loc="left")
        ax.set_xlabel("t")
    return save(figure, folder, "series.png")


def save(figure, folder, name):
    path = os.path.join(folder, name)
    figure.savefig(path, pad_inches=0.25)
    plt.close(figure)
    return path


def print_numbers(folder, tables):
    """The summary and the last line of each table."""
    path = os.path.join(folder, "summary.json")
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            summary = json.load(file)
        for key, value in summary.items():
            if not isinstance(value, dict):
                print(f"  {key:22} {value}")
    for name, data in tables.items():
        if data:
            last = ", ".join(f"{c} {v[-1]:.5g}" for c, v in data.items() if np.isfinite(v[-1]))
            print(f"  last of {name}.csv: {last}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", help="the output directory of a run")
    parser.add_argument("--plane", choices=list(AXES), help="normal of the plane of flow.png in 3-D, "
                        "through the solid's centre; not given: z, or where the solid travels along "
                        "z the axis that it travels along least")
    wish = parser.parse_args()
    folder = wish.folder
    # Of several solids the first one is drawn over time.
    names = sorted(n[:-4] for n in os.listdir(folder) if re.fullmatch(r"solid(_.+)?\.csv", n))
    tables = {name: table(os.path.join(folder, name + ".csv")) for name in [*names, "flow"]}
    tables.setdefault("solid", tables[names[0]] if names else {})
    volume = tables["solid"].get("volume")
    if volume is not None and volume[0] != 0:
        left = tables["solid"].get("volume_out", 0)
        tables["solid"]["drift"] = (volume + left) / volume[0] - 1
    print_numbers(folder, tables)
    items = series(folder)
    pictures = [draw_series(folder, tables)]
    if items:
        solid = while_solid(items)
        if solid:
            draw = draw_interface_2d if Snapshot(*solid[-1]).dim == 2 else draw_interface_3d
            pictures.append(draw(folder, solid, interface_title(solid, items)))
        pictures.append(draw_flow(folder, items, normal_of(wish.plane, tables["solid"])))
    for picture in pictures:
        if picture:
            print(f"  wrote {picture}")


if __name__ == "__main__":
    main()
