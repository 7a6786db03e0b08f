#!/usr/bin/python3
"""Surfaces and sections against exact ones: surfaces.py SOURCE FOLDER."""
import sys

import numpy as np

import made_up
from made_up import ball, box, check, filled_part, irregular, part_inside

made_up.arguments()
import fsi  # noqa: E402
from fsi import cells, cuts, quadrics, runs, surfaces  # noqa: E402


def snapshot(mesh, centre, radius, period=(0, 0, 0)):
    x = mesh.centres()
    shear = np.column_stack([x[:, 1], 0 * x[:, 0], 0 * x[:, 0]])
    unit = np.tile([1.0, 1, 1, 0, 0, 0], (len(x), 1))
    return runs.Snapshot(mesh, 0.0, {"alpha": ball(mesh, centre, radius, period), "u": shear, "B": unit,
                                     "p": x[:, 0] - 2 * x[:, 2]})


def check_sphere():
    exact = 4 * np.pi * 0.3**2
    for kind, n in (("hex", 16), ("tet", 14), ("prism", 14), ("pyramid", 12)):
        mesh = runs.Mesh(*box((1, 1, 1), (n, n, n), kind))
        check(abs(mesh.volumes.sum() - 1) < 1e-12, f"{kind}: the cells fill the box")
        one = snapshot(mesh, (0.5, 0.48, 0.51), 0.3)
        raw, fine = surfaces.isosurface(one, carry=("p",)), surfaces.solid_surface(one, ("p", "stretch"))
        for name, surface in (("isosurface", raw), ("solid", fine)):
            check((surface.edges()[1] == 2).all(), f"{kind}: the {name} is closed")
            check(surface.volume() > 0, f"{kind}: normals of the {name} point outward")
        check(abs(raw.area() / exact - 1) < 0.05, f"{kind}: area of the isosurface {raw.area() / exact:.4f}")
        check(abs(fine.area() / exact - 1) < 0.01, f"{kind}: area of the solid {fine.area() / exact:.4f}")
        check(abs(fine.volume() / one.volume_of_solid() - 1) < 1e-3, f"{kind}: its volume is held")
        wrong = raw.values["p"] - (raw.points[:, 0] - 2 * raw.points[:, 2])
        check(abs(wrong).max() < 1e-9, f"{kind}: a linear field is met on the surface")
        check(np.allclose(fine.values["stretch"], 1), f"{kind}: the strain of fluid has no part in it")
        away = np.linalg.norm(fine.points - (0.5, 0.48, 0.51), axis=1)
        slant = np.einsum("ij,ij->i", fine.normals(), fine.points - (0.5, 0.48, 0.51)) / away
        check(slant.min() > 0.9, f"{kind}: no folds: cosine of normal to radius {slant.min():.3f}")
        check(np.ptp(away) < 0.3 / n, f"{kind}: no facets: radius from {away.min():.4f} to {away.max():.4f}")


def check_matched():
    value = np.array([[1.0, -1, -1, -1], [-1, 1, 1, 1], [1, 1, -1, -1], [3, 1, 2, 4], [-2, -1, -3, -1]])
    check(np.allclose(cells.part_above(value), [1 / 8, 7 / 8, 1 / 2, 1, 0], atol=5e-3),
          f"the part of a tetrahedron above 0: {cells.part_above(value)}")
    for kind in ("hex", "tet", "prism", "pyramid"):
        mesh = runs.Mesh(*box((1, 1, 1), (5, 5, 5), kind))
        parts = cells.Simplices(mesh)
        places = parts.extend(mesh.points)[parts.corners]
        size = abs(np.linalg.det(places[:, 1:] - places[:, :1])) / 6
        check(np.allclose(np.bincount(parts.cells, size), mesh.volumes), f"{kind}: the cells of the tetrahedra")
        height = mesh.points @ (0.3, 0.5, 0.8) - 0.7
        part = np.bincount(parts.cells, size * cells.part_above(parts.extend(height)[parts.corners])) / mesh.volumes
        found = surfaces.zero_surface(mesh, cells.matched(mesh, part, mesh.at_points(part) - 0.5, 60), {})
        inner = (abs(found.points - 0.5) < 0.3).all(axis=1)
        off = found.points[inner] @ (0.3, 0.5, 0.8) - 0.7
        check(abs(off).max() < 0.02, f"{kind}: a plane is found again to {abs(off).max():.1e}")


def check_round():
    """A ball of few cells is round, on tetrahedra of unequal size as on hexahedra; limits a third above what
    is found. A spike, a dent or a fold is none of it."""
    centre = np.array((0.52, 0.49, 0.5))
    for kind, n, limit in (("tet", 7, 0.07), ("tet", 9, 0.035), ("tet", 12, 0.022), ("hex", 8, 0.04), ("hex", 12, 0.011)):
        mesh = irregular((1, 1, 1), (n, n, n), kind)
        one = runs.Snapshot(mesh, 0.0, {"alpha": filled_part(mesh, centre, 0.25)})
        surface = surfaces.solid_surface(one)
        away = surface.points - centre
        radius = np.linalg.norm(away, axis=1)
        slant = (np.einsum("ij,ij->i", surface.normals(), away) / radius).min()
        area, radius = surface.area() / (np.pi / 4), radius / 0.25
        told = f"{kind}: {0.5 / np.median(mesh.edges()):.1f} edges across"
        check(max(1 - radius.min(), radius.max() - 1) < limit,
              f"{told}, radius from {radius.min():.3f} to {radius.max():.3f}")
        check(abs(area - 1) < 0.005, f"{told}, area {area:.4f}")
        check(slant > 0.97, f"{told}, cosine of normal to radius {slant:.3f}")


def check_slender():
    """A ring of two and three cells in the radius of its tube, and a trace of solid away from a body."""
    for kind, n in (("hex", 16), ("hex", 24), ("tet", 20)):
        mesh = irregular((1, 1, 0.5), (n, n, n // 2), kind)

        def inside(places):
            x, y, z = np.moveaxis(places - (0.5, 0.5, 0.25), -1, 0)
            return np.hypot(np.hypot(x, y) - 0.27, z) < 0.125
        one = runs.Snapshot(mesh, 0.0, {"alpha": part_inside(mesh, inside)})
        surface = surfaces.solid_surface(one)
        x, y, z = (surface.points - (0.5, 0.5, 0.25)).T
        radius = np.hypot(np.hypot(x, y) - 0.27, z) / 0.125
        area = surface.area() / (4 * np.pi**2 * 0.27 * 0.125)
        check(0.95 < radius.min() and radius.max() < 1.05 and abs(area - 1) < 0.01,
              f"{kind}: a ring, tube from {radius.min():.3f} to {radius.max():.3f}, area {area:.4f}")
    far = np.linalg.norm(mesh.centres() - (0.02, 0.02, 0.02), axis=1).argmin()
    one.data["alpha"][far] = 0.15
    check(abs(surfaces.solid_surface(one).area() / surface.area() - 1) < 1e-3, "a trace away from it has no surface")


def check_coarse():
    """A ball of little more than two cells: means over cells leave little of it."""
    for kind, n in (("hex", 6), ("tet", 5)):
        mesh = runs.Mesh(*box((1, 1, 1), (n, n, n), kind))
        one = snapshot(mesh, (0.52, 0.5, 0.47), 0.21)
        surface = surfaces.solid_surface(one)
        away = np.linalg.norm(surface.points - (0.52, 0.5, 0.47), axis=1)
        check(0.12 < away.min() and away.max() < 0.32, f"{kind}, coarse: radius {away.min():.3f} to {away.max():.3f}")
        check(abs(surface.volume() / one.volume_of_solid() - 1) < 0.01, f"{kind}, coarse: its volume is held")


def check_traction():
    """In a shear flow u = (y, 0, 0) at viscosity 2, whatever the pressure level."""
    for kind, n in (("hex", 16), ("tet", 14)):
        mesh = runs.Mesh(*box((1, 1, 1), (n, n, n), kind))
        one = snapshot(mesh, (0.5, 0.5, 0.5), 0.25)
        one.viscosity, one.data["p"] = 2.0, np.full(len(mesh.types), 7.0)
        slope = mesh.gradients(mesh.points * (0, 3, 0))
        check(np.allclose(slope, np.diag((0, 3, 0))), f"{kind}: the gradient of a linear field")
        surface = surfaces.solid_surface(one, ("traction",))
        normals = surface.normals()
        exact = 2 * np.linalg.norm(normals[:, :2], axis=1)
        check(abs(surface.values["traction"] - exact).max() < 0.02, f"{kind}: traction of a shear flow")


def check_at_a_wall():
    """A ball of which a part has left through the side y = 0: closed by a disc there."""
    for kind, n in (("hex", 20), ("tet", 16), ("prism", 16), ("pyramid", 12)):
        mesh = runs.Mesh(*box((1, 1, 1), (n, n, n), kind))
        one = snapshot(mesh, (0.5, 0.1, 0.5), 0.3)
        surface = surfaces.solid_surface(one, ("stretch", "traction"))
        check(np.isfinite(surface.values["traction"]).all(), f"{kind}: traction where no fluid is beside it")
        exact = 2 * np.pi * 0.3 * 0.4 + np.pi * (0.3**2 - 0.1**2)
        check((surface.edges()[1] == 2).all() and surface.values["stretch"].shape == surface.points[:, 0].shape,
              f"{kind}: closed at the wall")
        check(abs(surface.area() / exact - 1) < 0.03, f"{kind}: area with the disc {surface.area() / exact:.4f}")
        check(abs(surface.volume() / one.volume_of_solid() - 1) < 1e-3, f"{kind}: volume at the wall")


def check_seam():
    period = (1, 0, 0)
    mesh = runs.Mesh(*box((1, 1, 1), (16, 16, 16)), period)
    whole = surfaces.solid_surface(snapshot(mesh, (0.5, 0.5, 0.5), 0.3, period))
    for x in (0.0, 0.03, 0.97, 0.75):
        split = surfaces.solid_surface(snapshot(mesh, (x, 0.5, 0.5), 0.3, period), about=(x, 0.5, 0.5))
        check((split.edges()[1] == 2).all() and abs(split.area() / whole.area() - 1) < 3e-3 and
              abs(np.ptp(split.points[:, 0]) - 0.6) < 0.02, f"across the seam in one piece, x = {x}")
        check(abs(split.points[:, 0].mean() - x) < 0.02, "and where it is asked for")


def check_cuts():
    for kind in ("hex", "tet", "prism", "pyramid"):
        mesh = runs.Mesh(*box((2, 1, 1), (20, 10, 10), kind))
        one = snapshot(mesh, (1, 0.5, 0.5), 0.3)
        for level in (0.5, 0.3, 0.4371, 0.0, 1.0):  # between layers, within one, at the ends
            for normal, area in (("z", 2), ("y", 2), ("x", 1)):
                cut = fsi.cut(one, normal, level)
                check(abs(cut.area() - area) < 1e-6, f"{kind}: section {normal} = {level}: {cut.area():.8f}")
        cut = fsi.cut(one, "z", 0.4371)
        inner = (abs(cut.points[:, 1] - 0.5) < 0.39) & (abs(cut.points[:, 0] - 1) < 0.89)
        check(abs(cut["u"][:, 0] - cut.points[:, 1])[inner].max() < 1e-9, f"{kind}: a linear velocity is met")
        line = cut.outline("alpha", 0.5)
        away = np.linalg.norm(line - (1, 0.5), axis=2)
        check(abs(away - np.sqrt(0.3**2 - 0.0629**2)).max() < 0.04, f"{kind}: the outline on the section")
        x, y, values = cut.grid(cut["u"], 41)
        check(values.shape == (20, 41, 3) and not values.mask.any() and
              abs(values[..., 0] - y[:, None])[4:-4, 4:-4].max() < 1e-9, f"{kind}: on the grid too")
    flat = runs.Mesh(*box((1, 1), (24, 24), "triangle"))
    one = snapshot(flat, (0.5, 0.5, 0), 0.3)
    check(abs(fsi.cut(one).area() - 1) < 1e-12, "in two dimensions the section is the mesh")
    for kind in ("triangle", "quad"):
        one = snapshot(runs.Mesh(*box((1, 1), (24, 24), kind)), (0.5, 0.5, 0), 0.3)
        line = surfaces.solid_outline(one)
        length = np.linalg.norm(line[:, 1] - line[:, 0], axis=1).sum()
        a, b = line[:, 0], line[:, 1]
        area = 0.5 * np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
        check(abs(length / (0.6 * np.pi) - 1) < 0.01, f"{kind}: outline of a disc {length / 0.6 / np.pi:.4f}")
        check(abs(area / one.volume_of_solid() - 1) < 2e-3, f"{kind}: its area is held {area:.5f}")
    empty = snapshot(flat, (0.5, 0.5, 0), -1)
    check(len(surfaces.solid_outline(empty)) == 0 and empty.centre_of_solid() is None, "without a solid: none")
    levels = [c.level for c in cuts.cuts_through_solid(
        [snapshot(mesh, (1, 0.5, z), 0.2 if z else -1) for z in (0.4, 0)], "z")]
    check(abs(levels[0] - 0.4) < 0.02 and levels[1] == levels[0], "without a solid: where the last one was")


def check_wall():
    def round_pipe(p):
        square = 2 * p[:, 1:] - 1  # of a square a circle
        x, y = square.T
        out = np.column_stack([p[:, 0], x * np.sqrt(1 - y**2 / 2), y * np.sqrt(1 - x**2 / 2)])
        return out
    points, *rest = box((3, 1, 1), (12, 16, 16))
    mesh = runs.Mesh(round_pipe(points), *rest)
    wall = surfaces.wall(mesh)
    check(abs(wall.area() / (6 * np.pi) - 1) < 0.01, f"wall of a pipe without its ends {wall.area():.4f}")
    outside = surfaces.outside(mesh)
    check(abs(outside.volume() / mesh.volumes.sum() - 1) < 1e-2, "the outside encloses the cells")
    check(abs(surfaces.wall(runs.Mesh(*box((1, 1, 1), (3, 3, 3), "prism"))).area() - 6) < 1e-9,
          "of a box all is wall")


def check_clipped():
    points, *rest = box((1, 1, 1), (5, 5, 5), "tet")
    surface = surfaces.outside(runs.Mesh(points, *rest))
    surface.values["x"] = surface.points[:, 0]
    part = surfaces.clipped(surface, surface.points @ (1.0, 0.5, 0) - 0.63)
    rim, count = part.edges()
    rim = part.points[rim[count == 1].ravel()]
    check(abs(rim @ (1.0, 0.5, 0) - 0.63).max() < 1e-12, "a surface is cut off along a plane")
    check(abs(part.values["x"] - part.points[:, 0]).max() < 1e-12 and (part.edges()[1] <= 2).all(),
          "with its values, and in one piece")
    sides = (1 - 0.63, 1 - 0.13, 1.0, 2 * (1 - 0.38))  # y = 0, y = 1, x = 1, and both of z
    check(abs(part.area() - sum(sides)) < 1e-12, f"its area {part.area():.6f}")


def check_distinct():
    rows = np.array([[2, 0, 7], [1, 5, 5], [2, 0, 7], [1, 5, 4]])
    first, which, count = cells.distinct(rows)
    check(first.tolist() == [3, 1, 0] and which.tolist() == [2, 1, 2, 0] and count.tolist() == [1, 1, 2],
          "distinct rows")


def check_resample():
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    grid = cells.resample(points, np.array([[0, 1, 2, 3]]), points @ [[1.0], [2], [4]], (0, 0, 0), (1, 1, 1),
                          (5, 5, 5))
    inside = np.isfinite(grid[..., 0])
    check(inside.sum() == 35 and grid[1, 1, 1, 0] == 1.75, "a tetrahedron on a grid")


def check_edges():
    for kind in ("hex", "tet", "prism", "pyramid"):
        mesh = irregular((1, 1, 1), (4, 4, 4), kind)
        mean = mesh.edges()
        some = np.array([3, 40])
        check(np.allclose(mesh.edges(some)[some], mean[some]) and np.count_nonzero(mesh.edges(some)) == 2,
              f"{kind}: edges of some cells")
        corners = np.concatenate([found.ravel() for _, found, _ in mesh.groups(some)])
        near = mesh.edges_at_points(some)
        check(np.allclose(near[corners], mesh.at_points(mean)[corners]) and np.isnan(near).any(),
              f"{kind}: edges at their corners")
    check(np.isclose(runs.Mesh(*box((2, 3, 7), (1, 1, 1))).edges()[0], 4), "edges of a box")


def check_neighbourhoods():
    """Of places with unequal reaches, all of one place at once and in parts."""
    random = np.random.default_rng(2)
    places, reach = random.uniform(0, 1, (900, 3)), 0.02 * 30**random.uniform(0, 1, 900)
    away = np.linalg.norm(places[:, None] - places, axis=2)
    for most in (1000000, 500):
        found = np.zeros((900, 900), int)
        for some, at, near in quadrics.neighbourhoods(places, reach, most):
            np.add.at(found, (some[at], near), 1)
        check((found == (away < reach[:, None])).all(), f"who is near, {most} pairs at a time")


def check_lost():
    one = snapshot(runs.Mesh(*box((1, 1, 1), (6, 6, 6))), (0.5, 0.5, 0.5), -1)
    check(surfaces.solid_surface(one, ("p",)).values.keys() == {"p"}, "without a solid: no values but those asked for")
    one.data["alpha"][7] = np.nan
    for ask in (one.has_solid, lambda: surfaces.solid_surface(one)):
        try:
            ask()
            told = ""
        except ValueError as error:
            told = str(error)
        check(told == "at t = 0 the field alpha is no number in 1 of 216 cells", f"a cell without a number: {told}")


check_sphere()
check_matched()
check_round()
check_slender()
check_coarse()
check_traction()
check_at_a_wall()
check_seam()
check_cuts()
check_wall()
check_clipped()
check_distinct()
check_resample()
check_edges()
check_neighbourhoods()
check_lost()
sys.exit(1 if made_up.failures else 0)
