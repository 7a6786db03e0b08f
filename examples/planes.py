"""Planes through the fields of a run, for pictures."""
import numpy as np
from matplotlib.tri import LinearTriInterpolator, Triangulation

from fields import Snapshot

AXES = "xyz"


def apart(points):
    """Places of points of which no two are nearly the same: cells above each other have one."""
    spacing = np.sqrt(np.prod(np.ptp(points, axis=0)) / len(points))
    return np.sort(np.unique((points / (0.05 * spacing)).round(), axis=0, return_index=True)[1])


def has_solid(snapshot):
    return "alpha" in snapshot and snapshot["alpha"].max() > 0.5


class Slice:
    """A plane through a run (all of it in 2-D), as triangles over cell centres.

    normal: 0, 1 or 2; level: where on that axis, none: in the middle of the mesh.
    """

    def __init__(self, snapshot, normal=2, level=None):
        centres = snapshot.centres()
        self.normal, self.level = (normal, 0.0) if snapshot.dim == 3 else (2, 0.0)
        self.across = [i for i in range(3) if i != self.normal]
        cells = np.arange(len(centres))
        if snapshot.dim == 3:
            along = snapshot.points[:, normal]
            self.level = 0.5 * (along.min() + along.max()) if level is None else level
            bottom, top = snapshot.extent(normal)
            # The half-open test takes one layer where the plane lies between two.
            cells = np.flatnonzero((bottom <= self.level) & (self.level < top))
        cells = cells[apart(centres[np.ix_(cells, self.across)])]
        self.snapshot, self.cells = snapshot, cells
        x, y = centres[np.ix_(cells, self.across)].T
        self.triangles = Triangulation(x, y)
        corner = np.stack([x, y], axis=1)[self.triangles.triangles]
        side = np.linalg.norm(corner - np.roll(corner, 1, axis=1), axis=2).max(axis=1)
        (ax, ay), (bx, by) = (corner[:, 1] - corner[:, 0]).T, (corner[:, 2] - corner[:, 0]).T
        flat = abs(ax * by - ay * bx) < 1e-6 * side**2  # on the edge of an even mesh, by rounding
        far = side > 6 * np.median(side)
        for mask in (far | flat, far):
            self.triangles.set_mask(mask)
            try:
                self.triangles.get_trifinder()
                break
            except RuntimeError:  # what is left does not fit together
                continue
        points = snapshot.points[:, self.across]
        self.low, self.high = points.min(axis=0), points.max(axis=0)

    def __getitem__(self, name):
        return self.snapshot[name][self.cells]

    def grid(self, values, nx=240):
        """Values at a regular grid; masked outside the mesh."""
        size = self.high - self.low
        ny = max(20, int(nx * size[1] / size[0]))
        x = np.linspace(self.low[0], self.high[0], nx)
        y = np.linspace(self.low[1], self.high[1], ny)
        return x, y, LinearTriInterpolator(self.triangles, values)(*np.meshgrid(x, y))

    def outline(self, axes, colour, width=1.8):
        alpha = self["alpha"]
        if alpha.min() < 0.5 < alpha.max():
            axes.tricontour(self.triangles, alpha, [0.5], colors=[colour], linewidths=width)


def normal_of(plane, solid):
    """The number of the axis across the pictures: as asked for, or z; where the solid goes its way
    along z, the axis that it travels along least."""
    if plane:
        return AXES.index(plane)
    ways = [np.ptp(solid[name]) if name in solid else 0.0 for name in AXES]
    return 2 if ways[2] <= 0.5 * max(ways) else int(np.argmin(ways))


def centre_of_solid(snapshot, axis):
    """Mean place of the solid along an axis; none without a solid."""
    if not has_solid(snapshot):
        return None
    sizes = [np.subtract(*snapshot.extent(i)[::-1]) for i in range(snapshot.dim)]
    return np.average(snapshot.centres()[:, axis], weights=snapshot["alpha"] * np.prod(sizes, axis=0))


def cuts_of(items, normal):
    """A plane through each snapshot: through the solid's centre, or where the last one was."""
    level = None
    for item in items:
        snapshot = Snapshot(*item)
        centre = centre_of_solid(snapshot, normal)
        level = centre if centre is not None else level
        yield Slice(snapshot, normal, level)
