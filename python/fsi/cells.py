"""Cells as simplices, what a level of a field cuts out of them, and their values on a grid.

A cell that is no simplex is divided about its centre and the centres of its faces of four corners.
Two cells divide the face between them alike, so that surfaces are closed, and no diagonal is preferred.
"""
import numpy as np

TRIANGLE, QUAD, TET, HEX, PRISM, PYRAMID = 5, 9, 10, 12, 13, 14
FACES = {  # by corner, counter-clockwise from outside
    TRIANGLE: [(0, 1), (1, 2), (2, 0)],
    QUAD: [(0, 1), (1, 2), (2, 3), (3, 0)],
    TET: [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
    HEX: [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
    PRISM: [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
    PYRAMID: [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
}
EDGES = {kind: sorted({tuple(sorted((face[i - 1], face[i]))) for face in faces for i in range(len(face))})
         for kind, faces in FACES.items()}  # by corner, each once


def distinct(rows):
    """For rows of whole numbers of at least 0: the first place of each distinct row, in ascending order of
    rows, the index of each row among them, and their counts. numpy.unique along an axis takes many times
    as long."""
    key = np.zeros(len(rows), np.int64)
    for column in rows.T:
        key = np.unique(key * (column.max(initial=0) + 1) + column, return_inverse=True)[1]
    return np.unique(key, return_index=True, return_inverse=True, return_counts=True)[1:]


class Simplices:
    """Triangles [m, 3] or tetrahedra [m, 4] that fill cells, over the points and further ones.

    A further point is the middle of a cell or of a face; `extend` gives it the mean of the corners. `cells`
    are the numbers of the cells that they are of.
    """

    def __init__(self, mesh, chosen=None):
        self.count, self.means = len(mesh.points), []
        found, of, quads = [], [], []
        extra = self.count
        for numbers, corners, kind in mesh.groups(chosen):
            if kind in (TRIANGLE, TET):
                found.append(corners)
                of.append(numbers)
                continue
            self.means.append(corners)
            middle = extra + np.arange(len(corners))
            extra += len(corners)
            for face in FACES[kind]:
                ends = corners[:, face]
                if len(face) == 4:
                    quads.append((ends, middle, numbers))
                else:
                    found.append(np.column_stack([ends, middle]))
                    of.append(numbers)
        if quads:
            ends, middle, numbers = (np.concatenate(part) for part in zip(*quads))
            first, number, _ = distinct(np.sort(ends, axis=1))
            self.means.append(ends[first])
            centre = extra + number
            found += [np.column_stack([ends[:, i], ends[:, (i + 1) % 4], centre, middle])
                      for i in range(4)]
            of += [numbers] * 4
        size = mesh.dim + 1
        self.cells = np.concatenate(of) if of else np.zeros(0, int)
        self.corners = np.concatenate(found) if found else np.zeros((0, size), int)

    def extend(self, values):
        """Values at the points, followed by those at the further points."""
        parts = [values]
        for corners in self.means:
            at_corners = values[corners]
            known = ~np.isnan(at_corners)
            total = np.where(known, at_corners, 0).sum(axis=1)
            with np.errstate(invalid="ignore"):
                parts.append(total / known.sum(axis=1))
        return np.concatenate(parts)


def crossing(corners, value):
    """Where the linear value passes zero in simplices: (ends [k, 2], part [k], elements [m, d]).

    A new point lies at (1 - part) of the first end and part of the second one. Tetrahedra give
    triangles, triangles give segments.
    """
    value = np.where(value == 0, 1e-12 * (np.abs(value).max(initial=0) + 1e-300), value)
    inside = value[corners] > 0
    count, size = inside.sum(axis=1), corners.shape[1]
    elements = []
    for alone in (True, False):  # one corner apart from the others
        some = np.flatnonzero(count == (1 if alone else size - 1))
        order = np.argsort(inside[some] != alone, axis=1, kind="stable")
        a, *others = np.take_along_axis(corners[some], order, axis=1).T
        elements.append(np.stack([np.stack([a, b], axis=1) for b in others], axis=1))
    if size == 4:  # two and two
        some = np.flatnonzero(count == 2)
        order = np.argsort(~inside[some], axis=1, kind="stable")
        a, b, c, d = np.take_along_axis(corners[some], order, axis=1).T
        ac, ad, bc, bd = (np.stack(pair, axis=1) for pair in ((a, c), (a, d), (b, c), (b, d)))
        elements += [np.stack([ac, ad, bd], axis=1), np.stack([ac, bd, bc], axis=1)]
    pairs = np.sort(np.concatenate(elements), axis=2).reshape(-1, 2)
    first, number, _ = distinct(pairs)
    ends = pairs[first]
    part = value[ends[:, 0]] / (value[ends[:, 0]] - value[ends[:, 1]])
    return ends, part, number.reshape(-1, size - 1)


def upper(triangles, value):
    """The part of triangles in which the linear value is not below 0: (ends [3 m, 2], part [3 m]), three
    points to a triangle, each as those of crossing."""
    above = value[triangles] >= 0
    count = above.sum(axis=1)
    # A triangle with one corner above or below is turned until that corner is its first one.
    turns = (np.where(count == 1, above.argmax(axis=1), (~above).argmax(axis=1))[:, None] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(triangles, turns, axis=1).T
    one, two, all_of = (np.flatnonzero(count == k) for k in (1, 2, 3))
    keep = np.stack([triangles[all_of]] * 2, axis=2)  # each point between two, here one and the same
    ab, ac = np.stack([a, b], axis=1), np.stack([a, c], axis=1)
    bb, cc = np.stack([b, b], axis=1), np.stack([c, c], axis=1)
    aa = np.stack([a, a], axis=1)
    pairs = np.concatenate([keep] + [np.stack([part[some] for part in parts], axis=1) for some, parts in
                                     ((one, (aa, ab, ac)), (two, (ab, bb, cc)), (two, (ab, cc, ac)))])
    ends = pairs.reshape(-1, 2)
    apart = value[ends[:, 0]] - value[ends[:, 1]]
    return ends, value[ends[:, 0]] / np.where(apart == 0, 1, apart) * (apart != 0)


def matched(mesh, fraction, value, rounds=12, most=0.4):
    """Of values at the points those whose linear course in the tetrahedra of each cell fills the cell by its
    fraction, as near as can be.

    Means over cells round off what is curved, and over cells of unequal size and place they are off by a
    good part of an edge. Each round adds half of what is missing in the cells around a point, in the mean.
    No value changes by more than `most`: so a trace of solid away from the body, where values are near to
    -0.5, stays without a surface. At 0.2 an ellipsoid two edges thick is off by 6 %, at 0.4 by 4 %.
    """
    low, high = mesh.extent(value)
    cut = np.flatnonzero((fraction > 0) & (fraction < 1) | (low < 0) & (high > 0))
    if len(cut) == 0:
        return value
    parts = Simplices(mesh, cut)
    places = parts.extend(mesh.points)[parts.corners]
    size = abs(np.linalg.det(places[:, 1:] - places[:, :1]))
    whole = np.maximum(np.bincount(parts.cells, size, minlength=len(fraction)), 1e-300)
    near = np.concatenate([mesh.place[corners].ravel() for _, corners, _ in mesh.groups(cut)])
    cell = np.concatenate([np.repeat(some, corners.shape[1]) for some, corners, _ in mesh.groups(cut)])
    count = np.maximum(np.bincount(near, minlength=len(value)), 1)
    first = value
    for _ in range(rounds):
        filled = size * part_above(parts.extend(value)[parts.corners])
        missing = fraction - np.bincount(parts.cells, filled, minlength=len(fraction)) / whole
        value = (value + 0.5 * np.bincount(near, missing[cell], minlength=len(value)) / count)[mesh.place]
        value = np.clip(value, first - most, first + most)
    return value


def part_above(value):
    """The part of each tetrahedron where the linear course of the values [n, 4] at its corners is above 0:
    the sum over i of max(v_i, 0)^3 / prod_{j != i} (v_i - v_j)."""
    value = np.sort(value / (abs(value).max(axis=1, keepdims=True) + 1e-300), axis=1)
    value = value + 1e-3 * np.arange(4)  # no two are the same
    total = 0
    for i in range(4):
        others = [value[:, i] - value[:, j] for j in range(4) if j != i]
        total = total + np.maximum(value[:, i], 0)**3 / np.prod(others, axis=0)
    return np.clip(total, 0, 1)


def between(values, ends, part):
    """Values at the points of a crossing; where one end has none, that of the other."""
    first, second = values[ends[:, 0]], values[ends[:, 1]]
    part = part.reshape((-1,) + (1,) * (first.ndim - 1))
    mixed = first + part * (second - first)
    return np.where(np.isnan(first), second, np.where(np.isnan(second), first, mixed))


def resample(points, corners, values, low, high, shape):
    """Values [n, c] at simplices on a regular grid, an array shape + [c]; NaN where there is none."""
    low, shape = np.asarray(low, float), np.asarray(shape)
    step = (np.asarray(high, float) - low) / np.maximum(shape - 1, 1)
    dim = len(shape)
    corner = ((points - low) / step)[corners]
    first = np.maximum(np.ceil(corner.min(axis=1) - 1e-9), 0).astype(int)
    last = np.minimum(np.floor(corner.max(axis=1) + 1e-9), shape - 1).astype(int)
    sides = np.maximum(last - first + 1, 0)
    edges = corner[:, 1:] - corner[:, :1]
    use = np.flatnonzero((sides.prod(axis=1) > 0) & (abs(np.linalg.det(edges)) > 1e-14))
    grid = np.full(tuple(shape) + values.shape[1:], np.nan)
    total = np.cumsum(sides[use].prod(axis=1))
    for part in np.split(use, np.searchsorted(total, np.arange(2000000, total[-1], 2000000))
                         if len(use) else []):
        counts = sides[part].prod(axis=1)
        of = np.repeat(part, counts)
        rest = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
        node = np.empty((len(of), dim), int)
        for axis in range(dim):
            node[:, axis] = first[of, axis] + rest % sides[of, axis]
            rest = rest // sides[of, axis]
        inverse = np.linalg.inv(edges[part])
        share = np.einsum("ni,nij->nj", node - corner[of, 0], np.repeat(inverse, counts, axis=0))
        share = np.column_stack([1 - share.sum(axis=1), share])
        hit = (share > -1e-6).all(axis=1)
        mixed = np.einsum("nk,nk...->n...", share[hit], values[corners[of[hit]]])
        grid[tuple(node[hit].T)] = mixed
    return grid
