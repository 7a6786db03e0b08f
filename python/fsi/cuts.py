"""Plane sections: the cells of a run cut by a plane, with the fields on the section."""
import numpy as np

from . import cells

AXES = "xyz"


class Cut:
    """Triangles of a plane section, or all of a mesh in two dimensions.

    points [n, 3], triangles [m, 3]; `across` are the two axes in the plane, `level` is the place on
    the third one, `low` and `high` the corners of the mesh in the plane.
    """

    def __init__(self, snapshot, normal, level):
        mesh = snapshot.mesh
        self.snapshot, self.normal, self.level, self._values = snapshot, normal, level, {}
        self.across = [axis for axis in range(3) if axis != normal]
        self.low, self.high = mesh.low[self.across], mesh.high[self.across]
        if mesh.dim == 2:
            self._parts, self._ends = cells.Simplices(mesh), None
            self.points, self.triangles = self._parts.extend(mesh.points), self._parts.corners
            return
        bottom, top = mesh.extent(mesh.points[:, normal])
        self._parts = cells.Simplices(mesh, np.flatnonzero((bottom <= level) & (level <= top)))
        places = self._parts.extend(mesh.points)
        self._ends, self._part, self.triangles = cells.crossing(
            self._parts.corners, places[:, normal] - level)
        self.points = cells.between(places, self._ends, self._part)

    def __getitem__(self, name):
        """A field at the points of the section."""
        if name not in self._values:
            values = self._parts.extend(self.snapshot.at_points(name))
            if self._ends is not None:
                values = cells.between(values, self._ends, self._part)
            self._values[name] = values
        return self._values[name]

    def grid(self, values, nx=240):
        """x, y and values on a regular grid, masked where the plane is outside of the mesh."""
        size = self.high - self.low
        shape = (nx, max(20, int(nx * size[1] / size[0])))
        found = cells.resample(self.points[:, self.across], self.triangles, values, self.low, self.high,
                               shape)
        return (*(np.linspace(*ends) for ends in zip(self.low, self.high, shape)),
                np.ma.masked_invalid(np.swapaxes(found, 0, 1)))

    def outline(self, name="alpha", level=0.5):
        """The line on which a field has a value, as segments [n, 2, 2] in the plane."""
        ends, part, segments = cells.crossing(self.triangles, self[name] - level)
        return cells.between(self.points[:, self.across], ends, part)[segments]

    def area(self):
        """Of the section."""
        a, b, c = np.moveaxis(self.points[self.triangles], 1, 0)
        return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()


def cut(snapshot, normal="z", level=None):
    """The section of the plane normal = level; level None: through the middle of the mesh.

    In two dimensions it is the mesh itself, whatever the plane.
    """
    mesh = snapshot.mesh
    axis = 2 if mesh.dim == 2 else AXES.index(normal)
    if level is None:
        level = 0.5 * (mesh.low[axis] + mesh.high[axis])
    # At an end of the mesh the plane is taken just within.
    room = 1e-9 * (mesh.high[axis] - mesh.low[axis])
    return Cut(snapshot, axis, float(np.clip(level, mesh.low[axis] + room, mesh.high[axis] - room)))


def cuts_through_solid(snapshots, normal="z"):
    """A section of each snapshot: through the solid's centre, or where the last one was."""
    level = None
    for snapshot in snapshots:
        centre = snapshot.centre_of_solid()
        level = centre[AXES.index(normal)] if centre is not None else level
        yield cut(snapshot, normal, level)


def best_normal(solid):
    """The axis of the best view of a solid, from its table: z, or, if it moves along z, the axis along which
    it moves least."""
    ways = [np.ptp(solid[name]) if name in solid else 0.0 for name in AXES]
    return "z" if ways[2] <= 0.5 * max(ways) else AXES[int(np.argmin(ways))]
