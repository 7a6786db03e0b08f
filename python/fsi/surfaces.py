"""Surfaces as triangles: the solid's, the wall of the vessel, where a field has a value."""
import functools
from dataclasses import dataclass, field

import numpy as np

from . import cells, quadrics


ENDS = 0.03, 0.97  # a surface keeps so far from the ends of an edge: a triangle of no size has no normal


@dataclass
class Surface:
    """points [n, 3], triangles [m, 3] and values at the points, by name."""

    points: np.ndarray
    triangles: np.ndarray
    values: dict = field(default_factory=dict)

    def area_vectors(self):
        """Of each triangle: its normal, as long as its area."""
        a, b, c = np.moveaxis(self.points[self.triangles], 1, 0)
        return 0.5 * np.cross(b - a, c - a)

    def area(self):
        return np.linalg.norm(self.area_vectors(), axis=1).sum()

    def volume(self):
        """What a closed surface encloses."""
        middle = self.points[self.triangles].mean(axis=1) - self.points.mean(axis=0)
        return np.einsum("ij,ij->", middle, self.area_vectors()) / 3

    def around(self):
        """At each point the sum of the normals of its triangles, each as long as its area."""
        return quadrics.sums(self.triangles.ravel(), np.repeat(self.area_vectors(), 3, axis=0), len(self.points))

    def normals(self):
        """Unit vectors at the points, outward where the triangles turn that way."""
        return quadrics.unit(self.around())

    def edges(self):
        """Pairs of points [k, 2], each once, and of how many triangles each is a side."""
        sides = np.sort(self.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        first, _, count = cells.distinct(sides)
        return sides[first], count

    def moved(self, shift):
        return Surface(self.points + shift, self.triangles, self.values)

    def part(self, chosen):
        """The triangles chosen, with the points that they need."""
        kept, number = np.unique(self.triangles[chosen], return_inverse=True)
        return Surface(self.points[kept], number.reshape(-1, 3),
                       {name: value[kept] for name, value in self.values.items()})


def isosurface(snapshot, name="alpha", level=0.5, carry=()):
    """The surface name = level in three dimensions; its normals point to smaller values.

    The fields named in `carry` come along as values at the points.
    """
    return zero_surface(snapshot.mesh, snapshot.at_points(name) - level,
                        {other: snapshot.at_points(other) for other in carry})


def zero_surface(mesh, value, fields):
    """The surface on which values at the points are 0, with the fields {name: values at the points}."""
    least, most = mesh.extent(value)
    parts = cells.Simplices(mesh, np.flatnonzero((least <= 0) & (most >= 0)))
    value, places = parts.extend(value), parts.extend(mesh.points)
    ends, part, triangles = cells.crossing(parts.corners, value)
    surface = Surface(cells.between(places, ends, part), triangles)
    # Each end is on one side of the level: from the higher to the lower one is outward.
    outward = (places[ends[:, 1]] - places[ends[:, 0]]) * np.where(value[ends[:, :1]] < 0, -1, 1)
    wrong = np.einsum("ij,ij->i", surface.area_vectors(), outward[triangles].sum(axis=1)) < 0
    surface.triangles[wrong] = surface.triangles[wrong][:, ::-1]
    part = np.clip(part, *ENDS)
    surface.points = cells.between(places, ends, part)
    for name, known in fields.items():
        surface.values[name] = cells.between(parts.extend(known), ends, part)
    return surface


def solid_surface(snapshot, carry=(), about=None):
    """The surface alpha = 0.5, smooth and in one piece across the seams of a period.

    A closed surface encloses the volume of the solid. `carry` names fields that come along as values; one
    of them may be traction, the size of the fluid's stress on the surface beyond its mean pressure. The
    middle lies as near as can be to the place `about` (default: the middle of the mesh).
    """
    if snapshot.mesh.dim == 2:
        raise ValueError("a run in two dimensions has no surface; its line is where alpha is 0.5")
    fields = ["stress" if name == "traction" else name for name in carry]
    fields = [name for name in fields if name in snapshot]
    bodies = [_body(snapshot, name, fields, about) for name in snapshot.bodies()]
    return united([body for body in bodies if len(body.triangles)] or bodies[:1])


def _half(snapshot, name):
    """The level at the surface of a solid: 0.5, or less where means over cells nowhere come near to 1."""
    snapshot.part_of_solid(name)
    return 0.5 * max(min(1.0, float(snapshot.at_points(name).max())), 0.5)


def united(parts):
    """Several surfaces as one."""
    offsets = np.cumsum([0] + [len(part.points) for part in parts])
    return Surface(np.concatenate([part.points for part in parts]),
                   np.concatenate([part.triangles + o for part, o in zip(parts, offsets)]),
                   {name: np.concatenate([part.values[name] for part in parts]) for name in parts[0].values})


def _body(snapshot, name, fields, about):
    """The surface of one solid, of which `name` is the part of the cells."""
    mesh = snapshot.mesh
    value = cells.matched(mesh, snapshot[name], snapshot.at_points(name) - _half(snapshot, name))
    known = {field: snapshot.at_points(field) for field in fields}
    known["edge"] = mesh.edges_at_points(np.flatnonzero(mesh.extent(value)[1] >= 0))
    surface = zero_surface(mesh, value, known)
    if len(surface.triangles) == 0:
        del surface.values["edge"]
        return surface
    surface = in_one_piece(united([surface, cap(mesh, value, known)]), mesh, about)
    surface = joined(surface, 1e-6 * np.ptp(mesh.points, axis=0).max())
    for key, value in surface.values.items():
        surface.values[key] = filled(value, surface.edges()[0])
    surface = smooth(fitted(surface), 4)
    del surface.values["edge"]
    if (surface.edges()[1] == 2).all():
        # Triangles cut off what is curved: give the volume back along the normals.
        volume = snapshot.volume_of_solid(name)
        for _ in range(8):  # a part of its size at a time: a coarse mesh may have lost much
            far = 0.05 * np.sqrt(surface.area())
            step = np.clip((volume - surface.volume()) / surface.area(), -far, far)
            surface = surface.moved(step * surface.normals())
            if abs(step) < 1e-4 * far:
                break
    if "stress" in surface.values:
        surface.values["traction"] = traction(surface)
    return surface


def traction(surface):
    """The size of stress times normal at the points, the mean pressure on the surface left out."""
    stress, normals = surface.values["stress"], surface.normals()
    pressure = -np.trace(stress, axis1=1, axis2=2) / 3
    area = np.linalg.norm(surface.area_vectors(), axis=1)
    mean = np.average(pressure[surface.triangles].mean(axis=1), weights=area)
    return np.linalg.norm(np.einsum("nij,nj->ni", stress, normals) + mean * normals, axis=1)


def section(surface, normal, level):
    """The line in which the plane normal = level cuts a surface, as segments [n, 2, 3]."""
    ends, part, segments = cells.crossing(surface.triangles, surface.points[:, normal] - level)
    return cells.between(surface.points, ends, part)[segments]


def solid_outline(snapshot, rounds=30):
    """The line alpha = 0.5 in two dimensions, smooth, as segments [n, 2, 3].

    A closed line encloses the area of the solid.
    """
    return np.concatenate([_outline(snapshot, name, rounds) for name in snapshot.bodies()])


def _outline(snapshot, name, rounds):
    parts = cells.Simplices(snapshot.mesh)
    value = parts.extend(snapshot.at_points(name) - _half(snapshot, name))
    places = parts.extend(snapshot.mesh.points)
    ends, part, edges = cells.crossing(parts.corners, value)
    if len(edges) == 0:
        return np.zeros((0, 2, 3))
    points = cells.between(places, ends, part)
    higher = places[np.where(value[ends[:, 0]] > 0, ends[:, 0], ends[:, 1])]
    outward = (points - higher)[edges].sum(axis=1)
    count = np.bincount(edges.ravel(), minlength=len(points))
    points = relaxed(points, edges, rounds, np.flatnonzero(count == 1))
    along = points[edges[:, 1]] - points[edges[:, 0]]
    normal = np.stack([along[:, 1], -along[:, 0], 0 * along[:, 0]], axis=1)
    inward = np.einsum("ij,ij->i", normal, outward) < 0
    edges[inward] = edges[inward][:, ::-1]  # the solid is to the left of each segment
    normal[inward] *= -1
    if (count == 2).all():
        area = 0.5 * np.einsum("ij,ij->", points[edges].mean(axis=1) - points.mean(axis=0), normal)
        length = np.linalg.norm(along, axis=1).sum()
        lost = np.clip((snapshot.volume_of_solid(name) - area) / length, -0.05 * length, 0.05 * length)
        at = np.stack([np.bincount(edges.ravel(), np.repeat(column, 2), minlength=len(points))
                       for column in normal.T], axis=1)
        points += lost * at / (np.linalg.norm(at, axis=1, keepdims=True) + 1e-300)
    return points[edges]


def in_one_piece(surface, mesh, about=None):
    """Moves by a period what lies beyond the widest gap."""
    points = surface.points.copy()
    for axis in np.flatnonzero(mesh.period):
        length = mesh.period[axis]
        order = np.sort(points[:, axis])
        gaps = np.append(np.diff(order), order[0] + length - order[-1])
        if gaps.argmax() < len(order) - 1:
            # The triangles lie within the mesh, so that none of them spans the gap.
            points[points[:, axis] > order[gaps.argmax()], axis] -= length
        middle = 0.5 * (points[:, axis].min() + points[:, axis].max())
        target = about[axis] if about is not None else 0.5 * (mesh.low[axis] + mesh.high[axis])
        points[:, axis] += length * np.round((target - middle) / length)
    return Surface(points, surface.triangles, surface.values)


def joined(surface, size):
    """Points that are nearer to each other than `size` become one."""
    _, first, number = np.unique(np.round(surface.points / size), axis=0, return_index=True,
                                 return_inverse=True)
    triangles = number.ravel()[surface.triangles]
    flat = (triangles[:, 0] == triangles[:, 1]) | (triangles[:, 1] == triangles[:, 2]) | \
        (triangles[:, 2] == triangles[:, 0])
    return Surface(surface.points[first], triangles[~flat],
                   {name: value[first] for name, value in surface.values.items()})


def smooth(surface, rounds):
    """Takes out small steps and keeps volume and shape; an open edge stays."""
    edges, count = surface.edges()
    points = relaxed(surface.points, edges, rounds, edges[count == 1].ravel())
    values, number = {}, len(surface.points)
    for name, value in surface.values.items():
        values[name] = relaxed(value.reshape(number, -1), edges, 6).reshape(value.shape)
    return Surface(points, surface.triangles, values)


def relaxed(places, edges, rounds, fixed=(), shares=(0.5, -0.53)):
    """Each round moves the ends of edges towards the mean of its neighbours and back
    [Taubin95]."""
    free = np.ones((len(places), 1))
    free[np.asarray(fixed, int)] = 0
    for _ in range(rounds):
        for share in shares:
            places = places + share * free * (neighbours(places, edges) - places)
    return places


def neighbours(values, edges):
    """The mean of the values [n, c] at the other ends of the edges."""
    number = len(values)
    degree = np.maximum(np.bincount(edges.ravel(), minlength=number), 1)[:, None]
    return np.stack([np.bincount(edges[:, 0], column[edges[:, 1]], minlength=number) +
                     np.bincount(edges[:, 1], column[edges[:, 0]], minlength=number)
                     for column in values.T], axis=1) / degree


def fitted(surface):
    """Each triangle as four, with all points on quadrics that take out steps of the size of a cell.

    The values of `edge` are the size of the cells. An open edge stays.
    """
    edges, count = surface.edges()
    vectors, number = surface.around(), len(surface.points)
    near = quadrics.Quadrics(surface.points, vectors, vectors + neighbours(vectors, edges), surface.values["edge"])
    surface = smooth(surface, 0)
    inner = np.setdiff1d(np.arange(number), edges[count == 1])
    # Slivers would fold: their points move apart first.
    surface.points = relaxed(surface.points, edges, 5, edges[count == 1].ravel(), (0.5,))
    surface.points[inner] = near.onto(inner, surface.points[inner])
    fine, (a, b) = subdivide(surface), edges[count != 1].T
    middle = number + np.flatnonzero(count != 1)
    fine.points[middle] = 0.5 * (near.onto(a, fine.points[middle]) + near.onto(b, fine.points[middle]))
    return fine


def filled(values, edges):
    """NaN, as of the fluid's stress where a body touches a wall, replaced from the neighbours outwards."""
    flat = values.reshape(len(values), -1).copy()
    known = ~np.isnan(flat[:, 0])
    while not known.all():
        weight = neighbours(known[:, None].astype(float), edges)
        found = neighbours(np.where(known[:, None], flat, 0), edges) / np.maximum(weight, 1e-300)
        new = ~known & (weight[:, 0] > 0)
        if not new.any():
            break
        flat[new], known[new] = found[new], True
    return flat.reshape(values.shape)


def subdivide(surface):
    """Each triangle as four."""
    edges, _ = surface.edges()
    number, count = len(surface.points), len(edges)
    sides = np.sort(surface.triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2)
    key = edges[:, 0] * number + edges[:, 1]
    middle = number + np.searchsorted(key, sides[..., 0] * number + sides[..., 1])
    (a, b, c), (ab, bc, ca) = surface.triangles.T, middle.T
    triangles = np.concatenate([np.stack(t, axis=1) for t in
                                ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    assert count == 0 or triangles.max() == number + count - 1

    def halves(values):
        return np.concatenate([values, values[edges].mean(axis=1)])
    return Surface(halves(surface.points), triangles,
                   {name: halves(value) for name, value in surface.values.items()})


def cap(mesh, value, fields):
    """The part of the mesh's outside on which values at the points are above 0; it closes the zero_surface."""
    triples, quads = outer_faces(mesh)
    middle = len(mesh.points) + np.arange(len(quads))
    triangles = np.concatenate([triples] + [
        np.column_stack([quads[:, i], quads[:, (i + 1) % 4], middle]) for i in range(4)])

    def extended(values):
        return np.concatenate([values, values[quads].mean(axis=1)])
    places, value = extended(mesh.points), extended(value)
    for axis in np.flatnonzero(mesh.period):  # a seam is no outside
        at = places[triangles, axis]
        room = 1e-6 * mesh.period[axis]
        ends = (at < mesh.low[axis] + room).all(axis=1) | (at > mesh.high[axis] - room).all(axis=1)
        triangles = triangles[~ends]
    ends, part = cells.upper(triangles, value)
    part = np.clip(part, *ENDS)
    found = Surface(cells.between(places, ends, part), np.arange(len(ends)).reshape(-1, 3))
    for name, known in fields.items():
        found.values[name] = cells.between(extended(known), ends, part)
    return found


def clipped(surface, value):
    """The part of a surface in which values at its points are not below 0."""
    ends, part = cells.upper(surface.triangles, value)
    first, number, _ = cells.distinct(np.sort(ends, axis=1))
    ends, part = ends[first], part[first]
    return Surface(cells.between(surface.points, ends, part), number.reshape(-1, 3),
                   {name: cells.between(values, ends, part) for name, values in surface.values.items()})


@functools.lru_cache(maxsize=4)
def outer_faces(mesh):
    """The faces of one cell alone, by corner: those of three [n, 3] and those of four [m, 4]."""
    faces = {3: [np.zeros((0, 3), int)], 4: [np.zeros((0, 4), int)]}
    for _, corners, kind in mesh.groups():
        for face in cells.FACES[kind]:
            faces[len(face)].append(corners[:, face])
    outer = []
    for found in (np.concatenate(faces[size]) for size in (3, 4)):
        first, _, count = cells.distinct(np.sort(found, axis=1))
        outer.append(found[first[count == 1]])
    return outer


def outside(mesh):
    """The outer faces of a mesh in three dimensions as a surface, normals outward."""
    triples, quads = outer_faces(mesh)
    triangles = np.concatenate([triples, quads[:, :3], quads[:, [0, 2, 3]]])
    return Surface(mesh.points, triangles).part(slice(None))


@functools.lru_cache(maxsize=4)
def wall(mesh, sharp=40):
    """The wall of a vessel: its outside without the flat ends.

    The outside is divided along edges that turn by more than `sharp` degrees; flat parts are ends. Where
    all parts are flat, as in a box, all of them are wall.
    """
    surface = outside(mesh)
    normal = surface.area_vectors()
    normal /= np.linalg.norm(normal, axis=1, keepdims=True) + 1e-300
    sides = np.sort(surface.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    order = np.lexsort(sides.T)
    same = (sides[order[1:]] == sides[order[:-1]]).all(axis=1)
    pairs = np.stack([order[:-1][same] // 3, order[1:][same] // 3], axis=1)
    turn = np.einsum("ij,ij->i", *normal[pairs.T])
    part = components(len(normal), pairs[turn > np.cos(np.radians(sharp))])
    total = np.stack([np.bincount(part, normal[:, i]) for i in range(3)], axis=1)
    mean = np.linalg.norm(total, axis=1) / np.maximum(np.bincount(part), 1)
    curved = mean[part] < 0.9999
    if not curved.any():
        return surface
    # The parts do not share points, so that light breaks at the edge between them.
    return surface.part(curved)


def components(count, pairs):
    """A number for each of `count` things, the same for those that pairs join."""
    label = np.arange(count)
    while len(pairs):
        least = np.minimum(label[pairs[:, 0]], label[pairs[:, 1]])
        if (label[pairs] == least[:, None]).all():
            break
        for side in (0, 1):
            np.minimum.at(label, label[pairs[:, side]], least)
            np.minimum.at(label, pairs[:, side], least)
        label = label[label]
    return label
