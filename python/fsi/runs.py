"""Reading of runs: the tables, the options, the mesh and the fields at each time.

    import fsi

    run = fsi.Run("out/torus")
    run.tables["solid"]["angle"]        # a column of solid.csv
    run.options["solid_shear_modulus"]  # as run.yaml has it, a text
    for snapshot in run.snapshots():
        print(snapshot.time, snapshot["u"].max())
"""
import csv
import functools
import json
import os
import re

import h5py
import numpy as np

from . import cells


class Mesh:
    """Points [n, 3] and cells, each a stretch of `corners` that begins at `starts`."""

    def __init__(self, points, corners, starts, types, period=(0, 0, 0)):
        self.points, self.corners, self.starts = np.asarray(points, float), corners, starts
        self.types, self.counts = types, np.diff(np.append(starts, len(corners)))
        self.low, self.high = self.points.min(axis=0), self.points.max(axis=0)
        self.period = np.asarray(period, float)
        self.place = self._places()
        self.share = self._shares()

    @property
    def dim(self):
        return 2 if np.isin(self.types, (cells.TRIANGLE, cells.QUAD)).all() else 3

    def _places(self):
        """For each point the first point at its place, where a period makes two places one."""
        points = self.points.copy()
        for axis in np.flatnonzero(self.period):
            top = points[:, axis] > self.high[axis] - 1e-6 * self.period[axis]
            points[top, axis] = self.low[axis]
        if not self.period.any():
            return np.arange(len(points))
        size = 1e-6 * np.ptp(self.points, axis=0).max()
        _, first, inverse = np.unique(np.round(points / size), axis=0, return_index=True,
                                      return_inverse=True)
        return first[inverse.ravel()]

    def _shares(self):
        """The weight of a cell at each of its corners.

        A linear field is met where the weights can stay between 0 and 2 [Holmes89]. They are 1 where all
        cells are on one side, as at a wall.
        """
        away = np.repeat(self.centres(), self.counts, axis=0) - self.points[self.corners]
        away = away[:, :self.dim]
        place, number = self.place[self.corners], len(self.points)
        first = np.stack([np.bincount(place, column, minlength=number) for column in away.T], axis=1)
        second = np.stack([np.stack([np.bincount(place, a * b, minlength=number) for a in away.T], axis=1)
                           for b in away.T], axis=2)
        spread = np.trace(second, axis1=1, axis2=2) + 1e-300
        second += 1e-9 * spread[:, None, None] * np.eye(self.dim)
        slope = np.linalg.solve(second, -first[..., None])[..., 0]
        share = 1 + np.einsum("ij,ij->i", slope[place], away)
        mean = np.bincount(place, share, minlength=number) / np.maximum(np.bincount(place, minlength=number), 1)
        return np.where(mean[place] > 0.5, np.clip(share, 0, 2), 1)

    def groups(self, chosen=None):
        """(cell numbers, corners [m, k], type) for each type, of all cells or of those chosen."""
        numbers = np.arange(len(self.types)) if chosen is None else np.asarray(chosen)
        for kind in np.unique(self.types[numbers]):
            some = numbers[self.types[numbers] == kind]
            yield some, self.corners[self.starts[some][:, None] + np.arange(self.counts[some[0]])], kind

    def centres(self):
        """Mean of the corners of each cell."""
        return np.add.reduceat(self.points[self.corners], self.starts, axis=0) / self.counts[:, None]

    def extent(self, values):
        """Smallest and largest value at the corners of each cell."""
        at_corners = values[self.corners]
        return (np.minimum.reduceat(at_corners, self.starts),
                np.maximum.reduceat(at_corners, self.starts))

    @functools.cached_property
    def volumes(self):
        """Volume of each cell; its area in two dimensions."""
        found = np.zeros(len(self.types))
        for numbers, corners, kind in self.groups():
            places = self.points[corners] - self.points[corners[:, :1]]
            for face in cells.FACES[kind]:
                found[numbers] += np.einsum("mi,mi->m", places[:, face].mean(axis=1),
                                            self._outward(places[:, face])) / self.dim
        return abs(found)

    def edges(self, chosen=None):
        """Mean length of the edges of each cell, of all cells or of those chosen; 0 of the others."""
        found = np.zeros(len(self.types))
        for numbers, corners, kind in self.groups(chosen):
            sides = cells.EDGES[kind]
            for first, second in sides:
                along = self.points[corners[:, second]] - self.points[corners[:, first]]
                found[numbers] += np.linalg.norm(along, axis=1) / len(sides)
        return found

    def edges_at_points(self, chosen):
        """The mean of `edges` over all cells around each corner of the cells chosen; NaN where none of the
        cells around a point has such a corner."""
        wanted = np.zeros(len(self.points), bool)
        for _, corners, _ in self.groups(chosen):
            wanted[self.place[corners]] = True
        around = np.logical_or.reduceat(wanted[self.place[self.corners]], self.starts)
        return self.at_points(self.edges(np.flatnonzero(around)), around)

    def gradients(self, values):
        """Of values at the points [n, c], in each cell [m, c, 3], by the means on its faces."""
        found = np.zeros((len(self.types), values.shape[1], 3))
        for numbers, corners, kind in self.groups():
            places = self.points[corners] - self.points[corners[:, :1]]
            for face in cells.FACES[kind]:
                found[numbers] += np.einsum("mc,mi->mci", values[corners[:, face]].mean(axis=1),
                                            self._outward(places[:, face]))
        return found / self.volumes[:, None, None]

    def _outward(self, ends):
        """Area times normal of faces with corners [m, k, 3]; of sides in two dimensions."""
        if self.dim == 2:
            along = ends[:, 1] - ends[:, 0]
            return np.stack([along[:, 1], -along[:, 0], 0 * along[:, 0]], axis=1)
        middle = ends.mean(axis=1, keepdims=True)
        return 0.5 * np.cross(ends - middle, np.roll(ends, -1, axis=1) - middle).sum(axis=1)

    def at_points(self, values, weights=None):
        """Weighted mean over the cells around each point; NaN where all of their weights are 0."""
        values = np.asarray(values, float)
        columns = values.reshape(len(values), -1)
        weight = self.share if weights is None else self.share * np.repeat(weights, self.counts)
        place = self.place[self.corners]
        total = np.bincount(place, weight, minlength=len(self.points))
        sums = [np.bincount(place, weight * np.repeat(column, self.counts), minlength=len(self.points))
                for column in columns.T]
        with np.errstate(invalid="ignore", divide="ignore"):
            means = np.stack(sums, axis=1) / total[:, None]
        return means[self.place].reshape((len(self.points),) + values.shape[1:])


class Snapshot:
    """The fields at one time: snapshot["u"] is a value of each cell, at_points("u") of each point.

    Beside the fields of the file there are those of DERIVED; `viscosity` is that of the fluid.
    """

    def __init__(self, mesh, time, data, viscosity=0.0):
        self.mesh, self.time, self.data, self._at_points = mesh, time, dict(data), {}
        self.viscosity = viscosity
        bodies = [name for name in self.data if name.startswith("alpha_")]
        if bodies and "alpha" not in self.data:  # several solids: all of them together
            self.data["alpha"] = np.sum([self.data[name] for name in bodies], axis=0)
            self.data["B"] = sum(self.data[name][:, None] * self.data["B" + name[5:]]
                                 for name in bodies) / np.maximum(self.data["alpha"], 1e-300)[:, None]
        self.dim = mesh.dim

    def __contains__(self, name):
        return name in self.data or name in DERIVED and all(n in self.data for n in DERIVED[name][0])

    def __getitem__(self, name):
        if name not in self.data and name in self:
            self.data[name] = DERIVED[name][1](self)
        return self.data[name]

    def at_points(self, name):
        """A field at the points. Fields of the solid or of the fluid alone are NaN elsewhere."""
        if name not in self._at_points:
            weights = None
            if name in OF_SOLID:
                weights = self["alpha"] * (self["alpha"] > 0.01)
            if name in OF_FLUID and "alpha" in self:
                weights = (1 - self["alpha"]) * (self["alpha"] < 0.5)
            self._at_points[name] = self.mesh.at_points(self[name], weights)
        return self._at_points[name]

    def has_solid(self):
        return "alpha" in self and bool(self.part_of_solid().max() > 0.5)

    def part_of_solid(self, name="alpha"):
        """The volume fraction of a solid; a value that is not a number is an error."""
        lost = np.isnan(self[name]).sum()
        if lost:
            raise ValueError(f"at t = {self.time:.6g} the field {name} is no number in {lost} of "
                             f"{len(self[name])} cells")
        return self[name]

    def centre_of_solid(self):
        """Mean place of the solid [3], in the mesh as it is written; None without a solid."""
        if not self.has_solid():
            return None
        return np.average(self.mesh.centres(), axis=0, weights=self["alpha"] * self.mesh.volumes)

    def velocity_of_solid(self):
        """Mean velocity of the solid [3]; None without one."""
        if not self.has_solid():
            return None
        return np.average(self["u"], axis=0, weights=self["alpha"] * self.mesh.volumes)

    def volume_of_solid(self, name="alpha"):
        return float(self[name] @ self.mesh.volumes)

    def bodies(self):
        """The names of the volume fractions, one for each solid."""
        several = sorted(name for name in self.data if name.startswith("alpha_"))
        return several or [name for name in ("alpha",) if name in self.data]


def _stretch(snapshot):
    xx, yy, zz, xy, yz, xz = snapshot["B"].T
    rows = [[xx, xy], [xy, yy]] if snapshot.dim == 2 else [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    largest = np.linalg.eigvalsh(np.moveaxis(np.array(rows), -1, 0))[:, -1]
    return np.sqrt(np.maximum(largest, 0))


def _stress(snapshot):
    slope = snapshot.mesh.gradients(snapshot.at_points("u"))
    viscous = snapshot.viscosity * (slope + np.swapaxes(slope, 1, 2))
    return viscous - snapshot["p"][:, None, None] * np.eye(3)


DERIVED = {  # name: (the fields that it is made of, how)
    "speed": (("u",), lambda snapshot: np.linalg.norm(snapshot["u"], axis=1)),
    "stretch": (("B", "alpha"), _stretch),  # the largest one
    "stress": (("u", "p"), _stress),  # of the fluid [m, 3, 3]
}
OF_SOLID, OF_FLUID = ("B", "stretch"), ("stress",)


class Run:
    """A folder that a run has written. `tables` holds solid, flow, and each other csv file with a column t."""

    def __init__(self, folder):
        self.folder = folder
        self.options = options(os.path.join(folder, "run.yaml"))
        self.solids = names = sorted(n[:-4] for n in os.listdir(folder) if re.fullmatch(r"solid(_.+)?\.csv", n))
        self.tables = {name: table(os.path.join(folder, name + ".csv")) for name in [*names, "flow"]}
        self.tables.setdefault("solid", self.tables[names[0]] if names else {})
        for name in sorted(n[:-4] for n in os.listdir(folder) if n.endswith(".csv")):
            if name not in self.tables and "t" in (found := table(os.path.join(folder, name + ".csv"))):
                self.tables[name] = found  # of a driver of one's own
        self.summary = summary(folder)
        self.items = series(folder)

    def failed(self):
        """Whether the run ended early with a reason; a run that continues has none yet."""
        return self.summary.get("status") == "failed" and bool(self.summary.get("message"))

    @property
    def times(self):
        return [time for _, time in self.items]

    def snapshot(self, number):
        """The fields of the file of that number; -1 is the last."""
        path, time = self.items[number]
        pairs = [p for p in self.options.get("mesh_periodic", "").split(",") if p]
        with h5py.File(path, "r") as file:
            data = {name: np.asarray(field) for name, field in file["VTKHDF/CellData"].items()}
        viscosity = float(self.options.get("fluid_viscosity", 0))
        return Snapshot(read_mesh(path, tuple(pairs)), time, data, viscosity)

    def snapshots(self, numbers=None):
        for number in range(len(self.items)) if numbers is None else numbers:
            yield self.snapshot(number)

    def centroid(self, time):
        """The centroid of solid.csv at a time [3], periods added on; None without a solid."""
        solid = self.tables["solid"]
        if "x" not in solid or len(solid["t"]) == 0:
            return None
        return np.array([np.interp(time, solid["t"], solid[axis]) for axis in "xyz"])

    def inside(self, time):
        """The part of the solids' volume at a time that has not left through an opening, by their tables."""
        several = [table for name, table in self.tables.items() if name.startswith("solid_")]
        known = [table for table in several or [self.tables["solid"]]
                 if "volume_out" in table and "volume" in table and len(table["t"])]
        volume, gone = (sum(np.interp(time, table["t"], table[name]) for table in known)
                        for name in ("volume", "volume_out"))
        return volume / (volume + gone) if volume + gone > 0 else 1.0


def read_mesh(path, pairs=()):
    """The mesh of a field file; pairs: names of the patches that are joined, two by two."""
    folder = os.path.dirname(os.path.abspath(path))
    with h5py.File(path, "r") as file:
        link = file["VTKHDF"].get("Points", getlink=True)
    stored = os.path.join(folder, link.filename) if isinstance(link, h5py.ExternalLink) else path
    return _read_mesh(stored, os.path.getmtime(stored), pairs)


@functools.lru_cache(maxsize=4)
def _read_mesh(path, _, pairs):
    with h5py.File(path, "r") as file:
        root = file["VTKHDF"]
        points, corners, starts, types = (np.asarray(root[name]) for name in
                                          ("Points", "Connectivity", "Offsets", "Types"))
    return Mesh(points, corners.astype(int), starts[:len(types)].astype(int), types,
                _period(points, pairs))


def _period(points, pairs):
    """The length of the mesh along each axis along which it is periodic, else 0."""
    low, high = points.min(axis=0), points.max(axis=0)
    period = np.zeros(3)
    axes = {"left": 0, "inlet": 0, "bottom": 1, "front": 2, "back": 2}
    for first in pairs[::2]:
        for axis in [axes[first]] if first in axes else range(3):
            ends = [points[abs(points[:, axis] - end) < 1e-6 * np.ptp(points)] for end in
                    (low[axis], high[axis])]
            ends = [np.delete(end, axis, axis=1) for end in ends]
            ends = [end[np.lexsort(np.round(end / np.ptp(points), 6).T)] for end in ends]
            if high[axis] > low[axis] and not period[axis] and len(ends[0]) == len(ends[1]) and \
                    np.allclose(*ends, atol=1e-5 * np.ptp(points)):
                period[axis] = high[axis] - low[axis]
                break
    return period


def series(folder):
    """The (path, time) pairs of the fields of a run, in time."""
    for name in sorted(os.listdir(folder)):
        if name.endswith(".hdf.series"):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                items = json.load(file)["files"]
            return sorted(((os.path.join(folder, i["name"]), i["time"]) for i in items),
                          key=lambda item: item[1])
    return []


def table(path):
    """A csv file as {column: array}; empty where there is none or it has no row."""
    if not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8", errors="replace") as file:
        rows = [row for row in csv.reader(file) if row]
    rows = rows[:1] + [row for row in rows[1:] if len(row) == len(rows[0])]  # one may be half written
    if len(rows) < 2:
        return {}
    return {name: np.array([_number(v) for v in column]) for name, column in
            zip(rows[0], zip(*rows[1:]))}


def _number(text):
    try:
        return float(text)
    except ValueError:
        return float("nan")


def options(path):
    """The options of a run.yaml as {name: text}; empty where there is none."""
    if not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8") as file:
        pairs = re.findall(r'^([^#:\s]+): *"?(.*?)"? *$', file.read(), re.M)
    return dict(pairs)


def summary(folder):
    """What summary.json holds; empty where there is none."""
    path = os.path.join(folder, "summary.json")
    if not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def differences(runs, apart_from=("output_dir", "restart", "max_wall_time")):
    """The options that are not the same in all runs, as {name: [value of each run]}."""
    names = sorted(set().union(*(run.options for run in runs)))
    found = {name: [run.options.get(name, "") for run in runs] for name in names
             if name not in apart_from}
    return {name: values for name, values in found.items() if len(set(values)) > 1}
