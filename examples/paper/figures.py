#!/usr/bin/python3
"""Draws figures 2 to 11 of the study from its runs, complete or not: figures.py PRESET OUT [FOLDER].

The pictures go to OUT/figures, or to FOLDER.
"""
import os
import sys

import figures_flow
import figures_mesh
import figures_pipe
import figures_stenosis
import study
from figures_parts import Missing, Study, style

FIGURES = {
    "fig02": figures_mesh.figure_2, "fig03": figures_mesh.figure_3, "fig04": figures_pipe.figure_4,
    "fig05": figures_pipe.figure_5, "fig06": figures_pipe.figure_6, "fig07": figures_pipe.figure_7,
    "fig08": figures_pipe.figure_8, "fig09": figures_flow.figure_9, "fig10": figures_flow.figure_10,
    "fig11": figures_stenosis.figure_11, "fig11_throats": figures_stenosis.throats,
    "figS4": figures_pipe.figure_s4, "figS5": figures_pipe.figure_s5,
}


def draw(preset, out, renderer="auto", folder=None, wanted=None):
    """Writes the figures (`wanted`: only these) and gives their paths; tells which are left out."""
    style.apply()
    folder = folder or os.path.join(out, "figures")
    os.makedirs(folder, exist_ok=True)
    runs, paths = Study(preset, out, renderer), []
    for name in wanted or FIGURES:
        try:
            figure = FIGURES[name](runs)
        except Missing as missing:
            print(f"{name}.png is left out: there is no run in {missing}.")
            continue
        paths.append(style.save(figure, os.path.join(folder, name + ".png")))
    return paths


def main():
    if len(sys.argv) not in (3, 4) or sys.argv[1] not in study.PRESETS:
        sys.exit(__doc__ + f"\nPRESET: {', '.join(study.PRESETS)}")
    for path in draw(study.PRESETS[sys.argv[1]], sys.argv[2], folder=(sys.argv[3:] or [None])[0]):
        print(path)


if __name__ == "__main__":
    main()
