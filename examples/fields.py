"""Reads what a run writes: fields.hdf.series (VTKHDF, one file a time) and the csv tables."""
import csv
import json
import os

import h5py
import numpy as np

TRIANGLE, QUAD, TET, HEX, PRISM, PYRAMID = 5, 9, 10, 12, 13, 14
# Each cell as tetrahedra, by corner.
TETS = {
    TET: [(0, 1, 2, 3)],
    HEX: [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)],
    PRISM: [(0, 1, 2, 5), (0, 1, 5, 4), (0, 4, 5, 3)],
    PYRAMID: [(0, 1, 2, 4), (0, 2, 3, 4)],
}


class Snapshot:
    """One time: points [n, 3], cells as (corners [m, k], type) groups in file order, cell data."""

    def __init__(self, path, time):
        self.time = time
        with h5py.File(path, "r") as file:
            root = file["VTKHDF"]
            sizes = [np.asarray(root[name]).astype(int) for name in
                     ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds")]
            points, connectivity = np.asarray(root["Points"]), np.asarray(root["Connectivity"])
            offsets, self.types = np.asarray(root["Offsets"]), np.asarray(root["Types"])
            self.data = {name: np.asarray(root["CellData"][name]) for name in root["CellData"]}
        bodies = [value for name, value in self.data.items() if name.startswith("alpha_")]
        if bodies:  # several solids: all of them together
            self.data["alpha"] = np.sum(bodies, axis=0)
        # The parts follow each other; the numbers in a part start at zero.
        first_point = np.concatenate([[0], np.cumsum(sizes[0])])
        first_id = np.concatenate([[0], np.cumsum(sizes[2])])
        self.points = points.astype(float)
        corners, starts, row = connectivity.astype(int), [], 0
        for part, cells in enumerate(sizes[1]):
            corners[first_id[part]:first_id[part + 1]] += first_point[part]
            starts.append(offsets[row:row + cells].astype(int) + first_id[part])
            row += cells + 1
        self.starts = np.concatenate(starts) if starts else np.zeros(0, int)
        self.corners = corners
        self.counts = np.diff(np.append(self.starts, len(corners)))

    def __contains__(self, name):
        return name in self.data

    def __getitem__(self, name):
        return self.data[name]

    @property
    def dim(self):
        return 2 if np.isin(self.types, (TRIANGLE, QUAD, 7)).all() else 3

    def groups(self):
        """(cell numbers, corners [m, k], type) for each kind of cell."""
        for kind in np.unique(self.types):
            cells = np.flatnonzero(self.types == kind)
            for count in np.unique(self.counts[cells]):
                some = cells[self.counts[cells] == count]
                yield some, self.corners[self.starts[some][:, None] + np.arange(count)], kind

    def centres(self):
        """Mean of the corners of each cell."""
        total = np.add.reduceat(self.points[self.corners], self.starts, axis=0)
        return total / self.counts[:, None]

    def extent(self, axis):
        """Lowest and highest coordinate of each cell."""
        values = self.points[self.corners, axis]
        return np.minimum.reduceat(values, self.starts), np.maximum.reduceat(values, self.starts)

    def at_points(self, name):
        """Cell data averaged to the points, seams between the parts included."""
        places, inverse = np.unique(np.round(self.points, 9), axis=0, return_inverse=True)
        corner = inverse[self.corners]
        weight = np.bincount(corner, minlength=len(places))
        total = np.bincount(corner, np.repeat(self[name], self.counts), minlength=len(places))
        return (total / np.maximum(weight, 1))[inverse]


def series(folder):
    """The (path, time) pairs of a run, in time."""
    for name in sorted(os.listdir(folder)):
        if name.endswith(".hdf.series"):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                items = json.load(file)["files"]
            return sorted(((os.path.join(folder, i["name"]), i["time"]) for i in items),
                          key=lambda item: item[1])
    return []


def table(path):
    """A csv file as {column: array}; empty where there is none."""
    if not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8") as file:
        rows = [row for row in csv.reader(file) if row]
    if len(rows) < 2:
        return {}

    def number(text):
        try:
            return float(text)
        except ValueError:
            return float("nan")
    columns = zip(*[row for row in rows[1:] if len(row) == len(rows[0])])
    return {name: np.array([number(v) for v in column]) for name, column in zip(rows[0], columns)}


def isosurface(snapshot, name="alpha", level=0.5):
    """Triangles [m, 3, 3] of name = level, by marching tetrahedra on the values at the points."""
    value = snapshot.at_points(name) - level
    value[value == 0] = 1e-12
    found = []
    for _, corners, kind in snapshot.groups():
        for tet in TETS.get(kind, []):
            found += march(snapshot.points, value, corners[:, tet])
    return np.concatenate(found) if found else np.zeros((0, 3, 3))


def march(points, value, tets):
    """The crossing triangles of tetrahedra [m, 4]: one where a corner is alone, two where not."""
    inside = value[tets] > 0
    count = inside.sum(axis=1)

    def crossing(i, j):
        t = (value[i] / (value[i] - value[j]))[:, None]
        return points[i] + t * (points[j] - points[i])

    found = []
    for alone in (True, False):
        some = np.flatnonzero(count == (1 if alone else 3))
        order = np.argsort(inside[some] != alone, axis=1, kind="stable")
        a, b, c, d = np.take_along_axis(tets[some], order, axis=1).T
        found.append(np.stack([crossing(a, b), crossing(a, c), crossing(a, d)], axis=1))
    some = np.flatnonzero(count == 2)
    order = np.argsort(~inside[some], axis=1, kind="stable")
    a, b, c, d = np.take_along_axis(tets[some], order, axis=1).T
    ac, ad, bc, bd = crossing(a, c), crossing(a, d), crossing(b, c), crossing(b, d)
    found += [np.stack([ac, ad, bd], axis=1), np.stack([ac, bd, bc], axis=1)]
    return found
