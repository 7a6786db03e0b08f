#!/usr/bin/python3
"""Pictures of a run: draw.py FOLDER writes series.png, interface.png, flow.png into FOLDER, and of a run
in three dimensions view.png. draw.py FOLDER FOLDER... writes overlay.png: runs over each other.

doc/howto/pictures.md shows what the options are for.
"""
import argparse
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "python"))
import fsi  # noqa: E402
from fsi import film, labels, plots, sections, style, views  # noqa: E402


def words(known):
    """What takes words with commas between them, all of them known."""
    def split(text):
        unknown = [word for word in text.split(",") if word not in known]
        if unknown:
            raise argparse.ArgumentTypeError(f'"{unknown[0]}" is none of {", ".join(known)}')
        return tuple(text.split(","))
    return split


def units(text):
    names = text.split(",")
    if len(names) != 3:
        raise argparse.ArgumentTypeError("three units are expected: of length, time and mass")
    return labels.Units(*names)


def direction(text):
    found = tuple(float(word) for word in text.split(","))
    if len(found) != 3 or not 0 < sum(part * part for part in found) < float("inf"):
        raise argparse.ArgumentTypeError("three numbers are expected that are not all 0")
    return found


def plane(text):
    found = re.fullmatch("([xyz])=(.+)", text)
    try:
        return found[1], float(found[2])
    except (TypeError, ValueError):
        raise argparse.ArgumentTypeError("a plane of symmetry is expected, as z=0.5") from None


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="+", help="the output directory of a run")
    parser.add_argument("--output", metavar="FOLDER", help="where the pictures go; not given: into the "
                        "folder of the run; of several runs, into the folder that holds the first")
    parser.add_argument("--show", type=lambda text: text.split(","), metavar="WORDS", help="panels of "
                        "series.png and overlay.png, with commas: " + ", ".join(plots.KEYS) + ", all, or "
                        "any column of a csv file in the folder")
    parser.add_argument("--plane", choices=list("xyz"), help="normal of the plane of flow.png in 3-D, "
                        "through the solid's centre; not given: z, or where the solid travels along "
                        "z the axis that it travels along least")
    parser.add_argument("--colour", choices=views.COLOURS, default="stretch", help="of the body in 3-D")
    parser.add_argument("--parts", type=words(views.PARTS), default=views.PARTS,
                        metavar="WORDS", help="what view.png shows: " + ",".join(views.PARTS))
    parser.add_argument("--q", type=float, nargs="?", const=0.0, metavar="VALUE", help="view.png with the "
                        "surface on which Q has this value; without a value: the strongest vortices")
    parser.add_argument("--view", choices=("auto", "body", "vessel"), default="auto", help="what view.png "
                        "holds: the surroundings of the body, or all of the vessel")
    parser.add_argument("--camera", type=direction, metavar="X,Y,Z", help="the direction from which one looks "
                        "in 3-D, --camera=-1,0.5,0 where the first number is negative; not given: a little "
                        "aside of the normal of --plane")
    parser.add_argument("--mirror", type=plane, action="append", metavar="PLANE", help="the image beyond a "
                        "plane of symmetry too, as z=0.5, at an end of the mesh; volumes, energies and flow rates "
                        "are of both sides")
    parser.add_argument("--relative", action="store_true", help="streamlines of flow.png and view.png as "
                        "seen by who moves with the body")
    parser.add_argument("--time", type=float, help="view.png at the field file nearest to this time; not "
                        "given: the last one with nearly all of the solid in it")
    parser.add_argument("--film", action="store_true", help="film/frame_NNNN.png too, and film.mp4 where "
                        "ffmpeg is installed, else film.gif")
    parser.add_argument("--scale", type=int, default=1, help="2 doubles the resolution")
    parser.add_argument("--units", type=units, default=labels.Units(),
                        metavar="LENGTH,TIME,MASS", help="units of the case for the labels: m,s,kg")
    parser.add_argument("--renderer", choices=("auto", "vtk", "plain"), default="auto", help="what draws in "
                        "3-D: VTK, or numpy alone; not given: VTK where python3-vtk9 and xvfb are installed")
    args = parser.parse_args()
    if args.mirror and len(args.mirror) > 1:
        parser.error("--mirror: one plane of symmetry only")
    args.mirror = args.mirror[0] if args.mirror else None
    return args


def print_numbers(run):
    """How the run ended, and what the solid went through."""
    summary = run.summary
    if summary:
        per_step = summary.get("us_per_cell_step", 0) * 1e-6 * summary["cells"]  # of those since a restart
        made = round(summary["wall_seconds"] / per_step) if per_step > 0 else summary["steps"]
        those = "" if made == summary["steps"] else f", {made} of them in"
        print(f"  {summary['status']} at t = {summary['t']:.6g}: {summary['cells']} cells, "
              f"{summary['ranks']} {'rank' if summary['ranks'] == 1 else 'ranks'}, {summary['steps']} steps{those or ','} "
              f"{summary['wall_seconds']:.4g} s")
    for name, data in plots.with_drift(run).items():
        if not os.path.exists(os.path.join(run.folder, name + ".csv")):
            continue
        ends = last_values(data)
        if ends:
            print(f"  {name}.csv ends with " + ", ".join(ends))
        if "min_eig_B" in data:
            print(f"  {name}.csv holds det B from {data['det_B_min'].min():.6g} to {data['det_B_max'].max():.6g}, "
                  f"eigenvalues of B down to {data['min_eig_B'].min():.4g}, a change of volume of "
                  f"{abs(data['drift']).max():.1e}")


def last_values(data):
    """What a table ends with, in words. Where a part of the solid has left, the shape of the rest is no result."""
    out = data["volume_out"][-1] if "volume_out" in data else 0.0
    gone = out / (data["volume"][-1] + out) if out > 0 else 0.0
    cut = bool(gone > 0.005)
    rates = [c for c in data if c.startswith("flow_rate_")] or ["flow_rate"]
    found = [f"{c} {data[c][-1]:.5g}" for c in
             ("x", "y", "z", "angle", "taylor", "pressure_gradient", *rates, "kinetic_energy",
              "elastic_energy") if c in data and data[c][-1] != 0 and not (cut and c in ("angle", "taylor"))]
    return found + [f"of what is left inside: {100 * gone:.3g} % has left"] * cut


def pictures(run, wish):
    """(name, figure) of each picture of a run."""
    yield "series.png", plots.series(run, wish.show, wish.units)
    if not run.items:
        return
    normal = wish.plane or fsi.best_normal(run.tables["solid"])
    look = look_of(wish, normal)
    deep = run.snapshot(0).dim == 3
    yield "interface.png", views.over_time(run, look, wish.scale) if deep else \
        sections.interface(run, wish.units)
    yield "flow.png", sections.flow(run, normal, units=wish.units, relative=wish.relative)
    if deep:
        number = sections.last_whole(run)
        if wish.time is not None:
            number = min(range(len(run.items)), key=lambda i: abs(run.times[i] - wish.time))
        yield "view.png", views.view(run, number, look, wish.scale)


def look_of(wish, normal):
    if wish.camera and not wish.plane:  # the slice faces the camera
        normal = max("xyz", key=lambda axis: abs(wish.camera["xyz".index(axis)]))
    return views.Look(camera=wish.camera, colour=wish.colour, parts=wish.parts, q=wish.q, view=wish.view, normal=normal,
                      relative=wish.relative, renderer=wish.renderer, units=wish.units)


def main():
    wish = arguments()
    style.apply()
    runs = [fsi.Mirrored(folder, *wish.mirror) if wish.mirror else fsi.Run(folder) for folder in wish.folder]
    for run in runs:
        if not run.items and not any(run.tables.values()):
            raise ValueError(f"{run.folder} holds neither tables nor fields of a run")
    above = os.path.dirname(os.path.abspath(runs[0].folder))
    output = wish.output or (runs[0].folder if len(runs) == 1 else above)
    os.makedirs(output, exist_ok=True)
    if len(runs) > 1:
        found = [("overlay.png", plots.overlay(runs, wish.show, wish.units))]
    else:
        print_numbers(runs[0])
        found = pictures(runs[0], wish)
    for name, figure in found:
        if figure is not None:
            print("  wrote " + style.save(figure, os.path.join(output, name), wish.scale))
    if wish.film and len(runs) == 1 and runs[0].items:
        normal = wish.plane or fsi.best_normal(runs[0].tables["solid"])
        print("  wrote " + film.film(runs[0], output, look_of(wish, normal), wish.scale))


if __name__ == "__main__":
    try:
        main()
    except (ValueError, RuntimeError, OSError) as error:
        sys.exit(f"draw.py: {error}")
