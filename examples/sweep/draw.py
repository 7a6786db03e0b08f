#!/usr/bin/python3
"""Draws the table of a sweep: draw.py OUT [OPTION...] makes OUT/sweep.png of OUT/sweep.csv.

Every column that differs between the points that are complete, against the first option that takes
several values; one line for each set of the other options. Positive values over more than two
decades stand on a logarithmic axis. OPTION...: the columns that are options
(default: those before the column `status`).
"""
import csv
import os
import sys

SHOWN = 32  # panels
LEFT_OUT = {"t", "dt", "dt_limit", "limit", "courant", "wall_per_step", "pressure_iterations",
            "rejected_steps", "divergence_max", "overshoot"}


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return None


def read(path):
    """Lines of the points that are complete, and all columns."""
    with open(path, encoding="utf-8") as file:
        reader = csv.DictReader(file)
        return [row for row in reader if row["status"] == "complete"], reader.fieldnames


def columns_that_differ(rows, names):
    """Those whose values differ by more than round-off: by 1e-6 of the largest component of their vector."""
    columns = {name: [number(row[name]) for row in rows] for name in names}
    columns = {name: values for name, values in columns.items() if None not in values}
    size = {}
    for name, values in columns.items():
        vector = name.rstrip("xyz")
        size[vector] = max(size.get(vector, 0), *map(abs, values))
    return [name for name, values in columns.items()
            if max(values) - min(values) > 1e-6 * size[name.rstrip("xyz")]]


def is_wide(values):
    return None not in values and min(values) > 0 and max(values) > 100 * min(values)


def draw(out, options=()):
    """The picture's name; None where there is nothing to draw or nothing to draw with."""
    rows, names = read(os.path.join(out, "sweep.csv"))
    options = list(options) or names[:names.index("status")]
    along = next((o for o in options if len({row[o] for row in rows}) > 1), None)
    if along is None:
        print("nothing to draw: fewer than two different points are complete")
        return None
    shown = columns_that_differ(rows, [n for n in names[names.index("status") + 1:] if n not in LEFT_OUT])
    if len(shown) > SHOWN:
        print("not drawn: " + ", ".join(shown[SHOWN:]))
    shown = shown[:SHOWN]
    try:
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
    except ImportError:
        print("nothing is drawn: there is no matplotlib")
        return None
    lines = {}
    for row in rows:
        others = ", ".join(f"{o} = {row[o]}" for o in options if o != along)
        lines.setdefault(others, []).append(row)
    width = min(4, max(1, len(shown)))
    height = max(1, -(-len(shown) // width))
    figure, axes = pyplot.subplots(height, width, squeeze=False, layout="constrained",
                                   figsize=(3.4 * width, 2.6 * height))
    for ax in axes.flat[len(shown):]:
        ax.axis("off")
    for ax, name in zip(axes.flat, shown):
        for label, members in lines.items():
            pairs = [(number(row[along]), row[along], number(row[name])) for row in members]
            if None in (x for x, _, _ in pairs):  # words: one place each
                ax.plot([word for _, word, _ in pairs], [y for _, _, y in pairs], "o", label=label)
            else:
                pairs.sort()
                ax.plot([x for x, _, _ in pairs], [y for _, _, y in pairs], "o-", label=label)
        if is_wide([number(row[along]) for row in rows]):
            ax.set_xscale("log")
        ax.set_title(name, loc="left", fontsize=10)
        ax.set_xlabel(along)
        ax.grid(alpha=0.25)
    if len(lines) > 1 and shown:
        axes.flat[0].legend(fontsize=7)
    picture = os.path.join(out, "sweep.png")
    figure.savefig(picture, dpi=130)
    pyplot.close(figure)
    return picture


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    print(draw(sys.argv[1], sys.argv[2:]))
