#!/usr/bin/python3
"""Reading of runs, and the units of their columns against doc/reference/files.md: reading.py SOURCE FOLDER."""
import os
import re
import sys

import numpy as np

import made_up
from made_up import box, check, write_run

source, folder = made_up.arguments()
import fsi  # noqa: E402
from fsi import labels, mirror, plots  # noqa: E402


def check_run():
    place = os.path.join(folder, "run")
    count = 4 * 3 * 2

    def fields(time):
        return {"u": np.full((count, 3), time), "alpha": np.linspace(0, 1, count)}
    write_run(place, box((4, 3, 2), (4, 3, 2)), [0.0, 0.5], fields,
              {"mesh_periodic": "inlet,outlet,front,back", "solid_shear_modulus": "10", "time_end": "0.5"},
              {"solid": {"t": [0, 1], "x": [1, 3], "y": [0, 0], "z": [0, 0]}, "flow": {"t": [1], "dt": [0.1]}})
    with open(os.path.join(place, "solid.csv"), "a", encoding="utf-8") as file:
        file.write("2,5")  # a row that is being written
    run = fsi.Run(place)
    check(run.times == [0.0, 0.5] and run.options["solid_shear_modulus"] == "10", "times and options")
    check(len(run.tables["solid"]["t"]) == 2, "a row that is half written is left out")
    check(np.allclose(run.centroid(0.25), (1.5, 0, 0)), "the centroid at a time")
    last = run.snapshot(-1)
    check(last.time == 0.5 and np.allclose(last["u"], 0.5) and np.allclose(last["speed"], 0.75**0.5),
          "fields, and what follows from them")
    check(np.allclose(last.mesh.period, (4, 0, 2)), f"periods by the names of patches: {last.mesh.period}")
    low, high = (last.mesh.points[:, 0] == side for side in (0, 4))
    values = last.at_points("alpha")
    check(np.allclose(np.sort(values[low]), np.sort(values[high])), "both sides of a seam have one value")
    check(run.snapshot(0).mesh is last.mesh, "the mesh is read once")
    several = fsi.Snapshot(last.mesh, 0, {"alpha_a": np.full(count, 0.25), "alpha_b": np.full(count, 0.5),
                                          "B_a": np.ones((count, 6)), "B_b": np.full((count, 6), 4.0)})
    check(np.allclose(several["alpha"], 0.75) and np.allclose(several["B"], 3), "several solids together")
    check(fsi.table(os.path.join(folder, "none.csv")) == {} and fsi.series(folder) == [], "nothing there: empty")


def check_mirror():
    """Half a run and its image beyond a plane of symmetry, cells of each kind."""
    for kind in ("hex", "tet", "prism", "pyramid", "quad", "triangle"):
        flat = kind in ("quad", "triangle")
        sides, counts, axis, level = ((2, 1), (4, 2), "y", 1) if flat else ((2, 1, 1), (4, 2, 2), "z", 1)
        place, arrays = os.path.join(folder, "half_" + kind), box(sides, counts, kind)
        count = len(arrays[3])
        values = {"u": np.tile([1.0, 2, 3], (count, 1)), "B": np.tile([1.0, 2, 3, 4, 5, 6], (count, 1)),
                  "p": np.arange(count, dtype=float)}
        write_run(place, arrays, [0.0], lambda _, values=values: values, {}, {
            "solid": {"t": [0, 1], "volume": [1, 1], "min_eig_B": [0.5, 0.5], axis: [0.7, 0.7], "u" + axis: [0, 1]},
            "flow": {"t": [1], "flow_rate_left": [3], "pressure_drop": [5]}})
        run = fsi.Mirrored(place, axis, level)
        mesh, snapshot, number = run.snapshot(0).mesh, run.snapshot(0), "xyz".index(axis)
        check(np.isclose(mesh.volumes.sum(), 4) and mesh.high[number] == 2, f"{kind}: twice the volume")
        linear = np.array([1.0, 2, 0 if flat else 3])
        check(np.allclose(mesh.gradients((mesh.points @ linear)[:, None])[:, 0], linear),
              f"{kind}: faces of the image look outward")
        check(np.isclose(sum(mesh.edges()[count:]), sum(mesh.edges()[:count])) and
              len(mesh.points) == 2 * len(arrays[0]) - (arrays[0][:, number] == level).sum(),
              f"{kind}: the points on the plane are shared")
        there = snapshot["u"][-1], snapshot["B"][-1], snapshot["p"][-1]
        turned = ([1, -2, 3], [1, 2, 3, -4, -5, 6]) if flat else ([1, 2, -3], [1, 2, 3, 4, -5, -6])
        check(np.array_equal(there[0], turned[0]) and np.array_equal(there[1], turned[1]) and
              there[2] == count - 1, f"{kind}: velocity, strain and pressure of the image")
    solid, flow = run.tables["solid"], run.tables["flow"]
    check(solid["volume"][0] == 2 and solid["min_eig_B"][0] == 0.5 and (solid[axis] == 1).all() and
          (solid["u" + axis] == 0).all() and flow["flow_rate_left"][0] == 6 and flow["pressure_drop"][0] == 5,
          "tables of both sides")
    told = {name for name, unit in units_told().items() if unit in ("volume", "area", "energy", "energy / time",
                                                                    "volume / time")}
    check(told == {*mirror.ADDED, "flow_rate", "flow_rate_NAME"}, f"all columns that add up: {told}")
    write_run(os.path.join(folder, "joined"), box((2, 1, 1), (4, 2, 2)), [0.0], lambda _: {"p": np.zeros(16)},
              {"mesh_periodic": "inlet,outlet"})
    for place, axis, level, words in ((place, axis, 0.5, "no end of the mesh"), (place, "z", 0, "flat along z"),
                                      (os.path.join(folder, "joined"), "x", 0, "periodic along x")):
        try:
            fsi.Mirrored(place, axis, level)
            check(False, f"refused: {words}")
        except ValueError as error:
            check(words in str(error), f"refused: {error}")


def units_told():
    """The unit of each column in doc/reference/files.md."""
    with open(os.path.join(source, "doc", "reference", "files.md"), encoding="utf-8") as file:
        rows = [[cell.strip() for cell in line.strip("|\n").split("|")] for line in file
                if line.startswith("| `")]
    return {name: row[2] for row in rows if len(row) == 6 for name in re.findall(r"`([^`]+)`", row[0])}


def check_stretch():
    mesh = fsi.Mesh(*box((1, 1, 1), (2, 2, 2)))
    stretch = np.tile([1.21, 1, 1 / 1.21, 0, 0, 0], (8, 1))
    alpha = np.array([1, 1, 1, 1, 0, 0, 0, 0.0])
    stretch[4:] = (9, 9, 9, 0, 0, 0)
    one = fsi.Snapshot(mesh, 0, {"B": stretch, "alpha": alpha})
    values = one.at_points("stretch")
    check(np.allclose(one["stretch"][:4], 1.1), "largest stretch")
    check(np.allclose(values[np.isfinite(values)], 1.1) and np.isnan(values).any(),
          "the strain at points is of the solid alone")


def check_units():
    """Each panel has the unit that the reference gives its columns."""
    told = units_told()
    for panel in plots.PANELS:
        for column in panel.columns:
            name = column.replace("*", "NAME")
            check(told.get(name) == panel.unit, f"{name}: {panel.unit}, in the reference {told.get(name)}")
    for name, unit in labels.COLUMNS.items():
        check(told.get(name) == unit, f"{name}: {unit}, in the reference {told.get(name)}")
    units = labels.Units("m", "s", "kg")
    check(units("pressure") == "Pa" and units("force / volume") == "Pa/m" and units("1 / time²") == "1/s²" and
          units("volume / time", 2) == "m²/s" and units("1") == "", "units in SI")
    for value, kind, text in ((1e-3, "length", "1 mm"), (1e-4, "length", "0.1 mm"), (2e-5, "length", "20 µm"),
                              (0.5, "length", "0.5 m"), (3e5, "length", "3e+05 m"), (0, "length", "0 m"),
                              (0.04, "velocity", "40 mm/s"), (3e-11, "volume", "0.03 mm³"), (2e5, "pressure", "200 kPa"),
                              (4e-12, "energy", "4 pJ"), (3e-4, "time", "0.0003 s"), (2e4, "force / volume", "20 kPa/m")):
        check(units.number(value, kind) == text, f"{value:g} as {units.number(value, kind)}")
    check(units.label("x", "length", size=0.002) == "x [mm]" and units.number(3e-5, "length", 2e-3) == "0.03 mm",
          "one prefix for all values of an axis")
    units = labels.Units("mm", "s", "mg")
    check(units.number(1e-4, "length") == "0.0001 mm" and labels.Units().number(1e-4, "length") == "0.0001",
          "a prefix for metres alone")
    check(units("pressure") == "mg/(mm s²)" and units.label("speed", "velocity") == "speed [mm/s]", "in others")
    check(labels.Units().label("speed", "velocity") == "speed", "without units: none")


check_run()
check_mirror()
check_stretch()
check_units()
sys.exit(1 if made_up.failures else 0)
