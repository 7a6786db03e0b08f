"""The whole of a model of which one half was run: mesh, fields and tables with their image beyond a plane of symmetry.

    run = fsi.Mirrored("out/half", "z", 0.5)
    run.snapshot(-1).mesh  # twice the cells
"""
import functools

import numpy as np

from . import cells
from .runs import Mesh, Run, Snapshot

TURNED = {  # the corners of a cell in an image, so that its faces look outward again
    cells.TRIANGLE: (0, 2, 1), cells.QUAD: (0, 3, 2, 1), cells.TET: (0, 2, 1, 3), cells.PYRAMID: (0, 3, 2, 1, 4),
    cells.PRISM: (0, 2, 1, 3, 5, 4), cells.HEX: (0, 3, 2, 1, 4, 7, 6, 5),
}
TENSOR = ("xx", "yy", "zz", "xy", "yz", "xz")  # the order of the files
# Columns that add up over the halves; those of flow.csv for each opening begin with flow_rate.
ADDED = ("volume", "volume_out", "volume_returned", "area", "elastic_energy", "shape_energy", "kinetic_energy", "dissipation", "work",
         "difference")


class Mirrored(Run):
    """The run in `folder` of what lies to one side of the plane axis = level, as a run of both sides.

    The plane must cut each solid: its centroid is put on the plane, and `pieces` is that of one side. The tables
    have no column `reynolds`, which is made with the diameter of half an opening. ValueError: the plane is no end
    of the mesh, or the mesh is periodic across it.
    """

    def __init__(self, folder, axis, level):
        super().__init__(folder)
        self.axis, self.level = "xyz".index(axis), float(level)
        if self.items:
            self.snapshot(0)
        self.tables = {name: self._of_both_sides(table) for name, table in self.tables.items()}

    def _of_both_sides(self, table):
        found = {name: 2 * values if name in ADDED or name.startswith("flow_rate") else values
                 for name, values in table.items() if name != "reynolds"}
        for name, still in (("xyz"[self.axis], self.level), ("u" + "xyz"[self.axis], 0.0)):
            if name in found:
                found[name] = np.full(len(found[name]), still)
        return found

    def snapshot(self, number):
        """The fields of both sides: first the cells that were computed, then their images."""
        half = super().snapshot(number)
        data = {name: np.concatenate([values, image(values, self.axis)]) for name, values in half.data.items()}
        return Snapshot(doubled_mesh(half.mesh, self.axis, self.level), half.time, data, half.viscosity)


def image(values, axis):
    """Values of cells beyond the plane. A vector's component along the axis has the other sign, and so has a
    component of a symmetric tensor that has the axis in its name once."""
    signs = np.ones(1 if values.ndim == 1 else values.shape[1])
    if len(signs) == 3:
        signs[axis] = -1
    if len(signs) == 6:
        signs[[parts.count("xyz"[axis]) == 1 for parts in TENSOR]] = -1
    return (values.reshape(len(values), -1) * signs).reshape(values.shape)


@functools.lru_cache(maxsize=4)
def doubled_mesh(mesh, axis, level):
    """A mesh and its image; the points on the plane are those of both."""
    points, room = mesh.points, 1e-6 * np.ptp(mesh.points)
    if mesh.high[axis] - mesh.low[axis] <= room:
        raise ValueError(f"the mesh is flat along {'xyz'[axis]}: it has no image there")
    if mesh.period[axis]:
        raise ValueError(f"the mesh is periodic along {'xyz'[axis]}: the plane is none of symmetry")
    if min(abs(mesh.low[axis] - level), abs(mesh.high[axis] - level)) > room:
        raise ValueError(f"the plane {'xyz'[axis]} = {level:g} is no end of the mesh, which goes from "
                         f"{mesh.low[axis]:g} to {mesh.high[axis]:g}")
    beyond = points.copy()
    beyond[:, axis] = 2 * level - points[:, axis]
    apart = abs(points[:, axis] - level) > room
    number = np.where(apart, len(points) + np.cumsum(apart) - 1, np.arange(len(points)))
    corners = np.empty_like(mesh.corners)
    for some, of, kind in mesh.groups():
        corners[mesh.starts[some][:, None] + np.arange(of.shape[1])] = number[of[:, TURNED[kind]]]
    return Mesh(np.concatenate([points, beyond[apart]]), np.concatenate([mesh.corners, corners]),
                np.concatenate([mesh.starts, len(mesh.corners) + mesh.starts]), np.tile(mesh.types, 2), mesh.period)
