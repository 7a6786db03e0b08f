#!/usr/bin/python3
"""Plots of tables and sections: what they show and leave out; plots.py SOURCE FOLDER."""
import os
import subprocess
import sys

import numpy as np

import made_up
from made_up import ball, box, check, write_run

source, folder = made_up.arguments()
import fsi  # noqa: E402
from fsi import cuts, plots, sections, style  # noqa: E402

style.apply()
TIME = np.linspace(0, 1, 11)


def solid(angle=45.0, slope=10.0):
    """A table in which x and the angle change, z and the volume by round-off alone."""
    return {"t": TIME, "x": TIME, "y": 0.5 + 1e-3 * TIME, "z": 0.5 + 1e-9 * TIME, "ux": 1 + 0 * TIME,
            "volume": 1 + 1e-14 * TIME, "volume_out": 0 * TIME, "angle": angle + slope * TIME,
            "min_eig_B": 1 - 0.1 * TIME, "det_B_min": 1 - 1e-12 * TIME, "det_B_max": 1 + 1e-12 * TIME,
            "aspect_forward": 1 - 0.1 * TIME, "aspect_back": 1 - 0.2 * TIME, "bending_prime": TIME}


def titles(figure):
    return [axes.get_title(loc="left") for axes in figure.axes if axes.get_title(loc="left")]


def make(name, modulus, shape="torus", mesh=box((2, 1, 1), (8, 8, 8)), **more):
    place = os.path.join(folder, name)
    count = len(mesh[3])

    def fields(time):
        return {"u": np.full((count, 3), time), "alpha": ball(fsi.Mesh(*mesh), (1, 0.5, 0.5), 0.3 - time)}
    flow = {"t": TIME[1:], "pressure_gradient": 0.2 + 0 * TIME[1:] + 0.1 / TIME[1:], "divergence_max": TIME[1:]}
    options = {"solid_shape": shape} if shape else more["shapes"]
    tables = {"solid": solid(slope=float(modulus))} if shape else {}
    write_run(place, mesh, more.get("times", [0.0, 0.1, 1.0]), fields,
              {"solid_shear_modulus": modulus, **options, "output_dir": name, "fluid_viscosity": "0.01",
               "flow_mean_velocity": "0.5"}, {**tables, "flow": flow, **more.get("tables", {})})
    return fsi.Run(place)


def check_series():
    ring = make("ring", "10")
    told = titles(plots.series(ring))
    check("centroid along x" in told and "centroid across x: y" in told, f"what changes is shown: {told}")
    for axis in "yz":
        turned = make("turned", "10")
        solid_table = turned.tables["solid"]
        solid_table["x"], solid_table[axis] = solid_table[axis], solid_table["x"]
        told = titles(plots.series(turned))
        check(f"centroid along {axis}" in told, f"a solid that travels along {axis}: {told}")
    solid_table["x"] = 0.9 * solid_table["z"]
    told = titles(plots.series(turned))
    check("centroid" in told and plots.main_axis(solid_table) is None, f"and one that turns: {told}")
    told = titles(plots.series(ring))
    for words in ("volume", "det B", "divergence", "velocity"):
        check(not any(words in title for title in told), f"left out as round-off or not asked for: {words}")
    told = titles(plots.series(ring, ["angle", "aspect", "bending", "gradient", "det", "volume"]))
    check(len(told) == 6 and any(title.startswith("angle") for title in told) and "det B" in told and
          "volume" in told, f"asked for: shown, by key and by column: {told}")
    check("angle of the axis to x [°]" not in titles(plots.series(make("ball", "10", "sphere"))),
          "a round solid has no axis")
    told = titles(plots.series(ring, ["min_eig_B", "strain", "min_eig_B"]))
    check(told == ["min_eig_B"], f"asked for twice: shown once: {told}")
    small = make("in metres", "10")
    small.tables["solid"].update(x=1e-3 * TIME, volume=1e-12 * (1 + TIME))
    figure = plots.series(small, ["x", "volume", "det"], plots.labels.Units("m", "s", "kg"))
    figure.canvas.draw()
    ticks = [tick.get_text() for tick in figure.axes[0].get_yticklabels()]
    check(titles(figure) == ["x [mm]", "volume [µm³]", "det B"] and "0.4" in ticks,
          f"a column has its unit, with a prefix: {titles(figure)}, {ticks}")
    try:
        plots.series(ring, ["angel"])
        check(False, "a word that is not known is refused")
    except ValueError as error:
        check('"angel"' in str(error) and "gradient" in str(error), "and told, with those that are known")


def check_own_table():
    """A csv file that a driver of one's own wrote beside; one without a time is none."""
    tables = {"axis": {"t": TIME[::2], "off_axis": TIME[::2]**2}, "points": {"a": TIME}}
    own = make("own", "10", tables=tables)
    check(set(own.tables) == {"solid", "flow", "axis"}, f"tables are found: {sorted(own.tables)}")
    figure = plots.series(own, ["off_axis", "angle"])
    check(titles(figure)[0] == "off_axis" and len(figure.axes[0].lines[0].get_xdata()) == 6,
          f"its column is drawn over its own time: {titles(figure)}")
    check("off_axis" not in titles(plots.series(own)), "where it is asked for")
    figure = plots.overlay([own, make("other", "5")], ["off_axis"])
    check(len(figure.axes[0].lines) == 1, "over a run without it")
    command = [sys.executable, os.path.join(source, "examples", "draw.py"), own.folder, "--show", "off_axis"]
    said = subprocess.run([*command, "--relative"], capture_output=True, text=True)
    check(said.returncode == 0, f"the command draws it: {said.stderr}")


def check_outlet():
    """Of a solid of which a part has left the command tells no shape, and the run how much is inside."""
    run = make("outlet", "10")
    command = [sys.executable, os.path.join(source, "examples", "draw.py"), run.folder, "--show", "x"]
    said = subprocess.run(command, capture_output=True, text=True).stdout
    check("angle 55" in said and "left inside" not in said and run.inside(1.0) == 1, f"all of it inside: {said}")
    table = {**solid(), "volume": 1 - 0.75 * TIME, "volume_out": 0.75 * TIME}
    run = make("outlet", "10", tables={"solid": table})
    said = subprocess.run(command, capture_output=True, text=True).stdout
    check("angle" not in said and "of what is left inside: 75 % has left" in said and abs(run.inside(0.4) - 0.7) < 1e-9,
          f"a part has left: {said}")


def check_failed():
    """A run that failed says so on every picture; one that goes on does not."""
    run = make("failed", "10")
    run.summary.update(status="failed", message="")
    check(not run.failed() and plots.series(run)._suptitle is None, "a run that goes on has not failed")
    run.summary.update(message="the flow became too fast", t=0.7)
    for figure in (plots.series(run), sections.flow(run, "z")):
        check(figure._suptitle.get_text() == "the run failed at t = 0.7", f"told: {figure._suptitle.get_text()}")
    check(sections.gone(run, [0], plots.labels.Units()).endswith("; the run failed at t = 0.7"),
          "beside the interface too")


def check_damaged():
    """A field file that is cut off, as a copy that did not end, is told in a sentence."""
    run = make("damaged", "10")
    os.truncate(os.path.join(run.folder, "fields_0001.hdf"), 100)
    command = [sys.executable, os.path.join(source, "examples", "draw.py"), run.folder]
    said = subprocess.run(command, capture_output=True, text=True)
    check(said.returncode == 1 and said.stderr.startswith("draw.py: "), f"a damaged file of fields: {said.stderr}")


def check_empty_pipe():
    square = make("square", "1")
    check(plots.empty_gradient(square) is None, "no line of the empty pipe in one that is not round")
    points, *rest = box((2, 1, 1), (4, 12, 12))
    x, y = (2 * points[:, 1:] - 1).T
    around = np.column_stack([points[:, 0], x * np.sqrt(1 - y**2 / 2) / 2, y * np.sqrt(1 - x**2 / 2) / 2])
    gradient = plots.empty_gradient(make("round", "1", mesh=(around, *rest)))
    check(gradient is not None and abs(gradient - 0.16) < 1e-12, f"that of a round one: {gradient}")


def check_overlay():
    runs = [make("soft", "1"), make("stiff", "5"), make("hard", "9")]
    figure = plots.overlay(runs, ["angle", "aspect"])
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    check(names == ["solid_shear_modulus 1", "solid_shear_modulus 5", "solid_shear_modulus 9"],
          f"the legend tells what differs: {names}")
    check(len(titles(figure)) == 3 and all(len(axes.lines) == 3 for axes in figure.axes[:3]),
          "a panel for each column, a line for each run")
    told = titles(plots.overlay(runs, ["strain", "x", "min_eig_B"], plots.labels.Units("cm", "s", "g")))
    check(told == ["smallest eigenvalue of B", "x [cm]"], f"each column once, with its unit: {told}")
    command = [sys.executable, os.path.join(source, "examples", "draw.py"), *(run.folder for run in runs)]
    said = subprocess.run(command + ["--show", "angle", "--output", folder], capture_output=True, text=True)
    check(said.returncode == 0 and os.path.exists(os.path.join(folder, "overlay.png")), "the command draws it")
    said = subprocess.run(command[:3] + ["--show", "angel"], capture_output=True, text=True)
    check(said.returncode == 1 and said.stderr.startswith("draw.py: nothing is called"),
          "and refuses what it does not know in a sentence")


def check_several():
    """Each of several solids has its own lines and panels, and the axis of one that is not round."""
    tables = {f"solid_{name}": {**solid(), "x": way * TIME} for name, way in (("ball", 1), ("Rod", 2))}
    shapes = {"solids_ball_shape": "sphere", "solids_rod_shape": "ellipsoid"}
    runs = [make(name, modulus, None, tables=tables, shapes=shapes) for name, modulus in (("one", "1"), ("two", "5"))]
    angle = next((axes for axes in plots.series(runs[0]).axes if axes.get_title(loc="left").startswith("angle")), None)
    check(angle is not None and len(angle.lines) == 1, "the axis of the rod beside a ball is drawn, that of the ball not")
    figure = plots.overlay(runs, ["x"])
    ends = [line.get_ydata()[-1] for axes in figure.axes for line in axes.lines]
    check(titles(figure) == ["x: Rod x", "x: ball x"] and ends == [2, 2, 1, 1],
          f"runs over each other show every solid: {titles(figure)}, {ends}")
    told = titles(plots.series(make("disk", "1", "disk")))
    check(any(title.startswith("angle") for title in told), f"a disk has an axis: {told}")


def check_sections():
    """Twenty cells: the plane lies between two layers; the solid has left by the end."""
    run = make("layers", "1", mesh=box((2, 1, 1), (20, 20, 20)), times=[0.0, 0.1, 1.0])
    check(sections.while_solid(run) == [0, 1], "the last time with solid in it")
    check(sections.last_whole(run) == 0, "the last time with the whole solid in it")
    figure = sections.flow(run, "z")
    told = titles(figure)
    check(told[0].startswith("t = 0   plane z = 0.5") and len(told) == 3, f"sections are drawn: {told}")
    style.save(figure, os.path.join(folder, "flow.png"))
    # What moves with the body stands still for who moves with it.
    arrows = [len(sections.flow(run, "z", [1], relative=relative).axes[0].patches) for relative in (False, True)]
    check(arrows[0] > 0 == arrows[1], f"streamlines as the body sees them: arrow heads {arrows}")
    flat = make("flat", "1", "sphere", box((2, 1), (16, 8), "triangle"))
    check("none is left at t = 1" in titles(sections.interface(flat))[0], "and the interface is, as long as it is")
    check(cuts.best_normal({"x": [0, 2], "y": [0, 0.1], "z": [0, 3]}) == "y", "seen from where it moves least")


def check_sweep():
    """The table of a sweep, in which y and ux differ by round-off alone, ux of a vector that is zero."""
    sys.path.insert(0, os.path.join(source, "examples", "sweep"))
    import draw
    rows = [{"x": "2.5", "y": f"{i}e-16", "ux": "0", "angle": str(i), "volume": f"{1 + i * 1e-15}", "limit": "dt"}
            for i in range(3)]
    shown = draw.columns_that_differ(rows, list(rows[0]))
    check(shown == ["angle"], f"a sweep's picture has the columns that differ: {shown}")


check_series()
check_sweep()
check_own_table()
check_outlet()
check_failed()
check_damaged()
check_empty_pipe()
check_overlay()
check_several()
check_sections()
sys.exit(1 if made_up.failures else 0)
