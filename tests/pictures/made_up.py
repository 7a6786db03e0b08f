"""Runs made up for the tests: a box of cells, a solid of known shape, a known flow."""
import json
import os
import sys

import h5py
import numpy as np

failures = []


def check(holds, sentence):
    print("ok  " if holds else "FAIL", sentence)
    if not holds:
        failures.append(sentence)


def arguments():
    """(source, folder); the package is on the path from here on."""
    source, folder = (os.path.abspath(word) for word in sys.argv[1:3])
    sys.path.insert(0, os.path.join(source, "python"))
    os.makedirs(folder, exist_ok=True)
    return source, folder


def box(sides, counts, kind="hex"):
    """(points, corners, starts, types) of a box of hexahedra, tetrahedra, prisms, pyramids,
    quadrilaterals or triangles; two sides make it flat."""
    axes = [np.linspace(0, side, count + 1) for side, count in zip(sides, counts)]
    places = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(sides))
    number = np.arange(len(places)).reshape([count + 1 for count in counts])
    ranges = [np.arange(count) for count in counts]
    base = np.stack(np.meshgrid(*ranges, indexing="ij"), axis=-1).reshape(-1, len(sides))
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    steps = square if len(sides) == 2 else [(*s, k) for k in (0, 1) for s in square]
    cells = np.stack([number[tuple((base + step).T)] for step in steps], axis=1)
    points = np.column_stack([places, np.zeros((len(places), 3 - len(sides)))])
    if kind == "pyramid":
        middle = len(points) + np.arange(len(cells))
        points = np.concatenate([points, points[cells].mean(axis=1)])
        cells = np.column_stack([cells, middle])
    parts, vtk = {
        "hex": ([range(8)], 12), "quad": ([range(4)], 9), "triangle": ([(0, 1, 2), (0, 2, 3)], 5),
        "prism": ([(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)], 13),
        "tet": ([(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)], 10),
        "pyramid": ([(0, 1, 2, 3, 8), (7, 6, 5, 4, 8), (4, 5, 1, 0, 8), (5, 6, 2, 1, 8), (6, 7, 3, 2, 8),
                     (7, 4, 0, 3, 8)], 14),
    }[kind]
    corners = np.concatenate([cells[:, list(part)] for part in parts])
    return points, corners.ravel(), np.arange(len(corners)) * corners.shape[1], \
        np.full(len(corners), vtk, np.uint8)


def ball(mesh, centre, radius, period=(0, 0, 0)):
    """The part of each cell that is inside of a ball (in two dimensions a disc), by its distance."""
    away = mesh.centres() - centre
    period = np.asarray(period, float)
    away -= period * np.round(away / np.where(period > 0, period, 1))
    size = mesh.volumes**(1 / mesh.dim)
    distance = np.linalg.norm(away[:, :mesh.dim], axis=1)
    return np.clip(0.5 + (radius - distance) / size, 0, 1)


def irregular(sides, counts, kind="tet"):
    """Cells of unequal size: the inner points of a box of tetrahedra moved about; hexahedra stay."""
    import fsi  # on the path since arguments()
    points, *rest = box(sides, counts, kind)
    inner = ((points > 1e-9) & (points < np.array(sides) - 1e-9)).all(axis=1) & (kind == "tet")
    shift = np.random.default_rng(3).uniform(-0.18, 0.18, points.shape) * np.array(sides) / counts
    return fsi.Mesh(np.where(inner[:, None], points + shift, points), *rest)


def part_inside(mesh, inside, count=1000):
    """The part of each tetrahedron or box for which inside(places), by so many places spread evenly in it."""
    x, y, z = np.outer(1.2207440846 ** -np.arange(1, 4), np.arange(count)) % 1
    if mesh.counts[0] == 8:
        share = np.stack([a * b * c for c in (1 - z, z) for a, b in
                          ((1 - x, 1 - y), (x, 1 - y), (x, y), (1 - x, y))], axis=1)
    else:
        share = np.diff(np.sort([0 * x, x, y, z, 0 * x + 1], axis=0), axis=0).T
    corners = mesh.points[mesh.corners.reshape(len(mesh.types), -1)]
    return np.concatenate([inside(np.einsum("sk,mkd->msd", share, some)).mean(axis=1)
                           for some in np.array_split(corners, len(corners) // 1000 + 1)])


def filled_part(mesh, centre, radius):
    """The part of each cell in a ball."""
    return part_inside(mesh, lambda places: np.linalg.norm(places - centre, axis=-1) < radius)


def write_run(folder, mesh_arrays, times, fields, options=None, tables=None, case="pipe"):
    """A folder as a driver leaves it; fields(time): {name: values of the cells}."""
    os.makedirs(folder, exist_ok=True)
    names = ("Points", "Connectivity", "Offsets", "Types")
    with h5py.File(os.path.join(folder, "fields_mesh.hdf"), "w") as file:
        for name, values in zip(names, mesh_arrays):
            file["VTKHDF/" + name] = values
    items = []
    for i, time in enumerate(times):
        items.append({"name": f"fields_{i:04}.hdf", "time": time})
        with h5py.File(os.path.join(folder, items[-1]["name"]), "w") as file:
            for name in names:
                file["VTKHDF/" + name] = h5py.ExternalLink("fields_mesh.hdf", "/VTKHDF/" + name)
            for name, values in fields(time).items():
                file["VTKHDF/CellData/" + name] = values
    with open(os.path.join(folder, "fields.hdf.series"), "w", encoding="utf-8") as file:
        json.dump({"file-series-version": "1.0", "files": items}, file)
    with open(os.path.join(folder, "run.yaml"), "w", encoding="utf-8") as file:
        file.write("# a run made up\n" + "".join(f'{k}: "{v}"\n' for k, v in (options or {}).items()))
    with open(os.path.join(folder, "summary.json"), "w", encoding="utf-8") as file:
        json.dump({"case": case, "status": "complete", "t": times[-1], "cells": len(mesh_arrays[3]),
                   "ranks": 1, "steps": 1, "wall_seconds": 1.0}, file)
    for name, columns in (tables or {}).items():
        with open(os.path.join(folder, name + ".csv"), "w", encoding="utf-8") as file:
            file.write(",".join(columns) + "\n")
            for row in zip(*columns.values()):
                file.write(",".join(f"{value:.17g}" for value in row) + "\n")
