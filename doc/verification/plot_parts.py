"""What the pictures of these pages have in common: figures from the tables, axes, lines."""
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
