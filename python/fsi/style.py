"""The look of all pictures: colours that colour-blind readers can distinguish, fonts, lines."""
import matplotlib
import matplotlib.pyplot as plt
import numpy as np

# [Okabe08]
BLUE, ORANGE, GREEN, ROSE, AMBER, SKY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"
LINES = (BLUE, ORANGE, GREEN, ROSE, AMBER, SKY)
SOLID = ORANGE
DPI = 150


def apply():
    """Sets the defaults of matplotlib; the picture goes to a file, not to a screen."""
    matplotlib.use("Agg")
    plt.rcParams.update({
        "figure.dpi": DPI, "font.size": 9, "axes.titlesize": 9.5, "axes.labelsize": 9,
        "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.25,
        "legend.frameon": False, "lines.linewidth": 1.4, "image.cmap": "viridis",
    })


def colours(count):
    """So many colours, in order where there are more than the lines have."""
    return LINES[:count] if count <= len(LINES) else \
        [tuple(c) for c in matplotlib.colormaps["viridis"](np.linspace(0, 0.95, count))]


def save(figure, path, scale=1):
    """Writes a figure; scale 2 doubles its resolution."""
    figure.savefig(path, dpi=DPI * scale, facecolor="white", bbox_inches="tight", pad_inches=0.08)
    plt.close(figure)
    return path
