"""A quadric near each point of a surface, fitted to the surface around it [Cazals05]: it takes out the steps
of cells.

A quadric keeps what is curved, as a mean of neighbours does not. What is around is told by lengths, so that
the size and the shape of the triangles do not matter.
"""
import numpy as np

# Of the weights: the width in edges of cells, and how many widths they reach. A ball of four edges across is
# off by 6 % at a width of 0.7, by 3 % at 0.9, and a tube of four edges by 2 % at 0.9, by 3 % at 1.4.
WIDTH, REACH = 0.9, 2.0
# Settles slope and curvature where there are too few points around. From 1e-5 to 1e-2 what is two edges thick
# and more changes by 0.3 % at most; 0.1 puts a flat ellipsoid off by 1.0 % in the mean in place of 0.8 %.
RIDGE = 1e-3
ROUNDS = 3  # of weights and normals: a ring of fractions wrong by up to 0.25 is off by 36 % after one, 25 % after three


class Quadrics:
    """Of points [n, 3]: the normal of each, and the heights of the surface over the plane there.

    vectors [n, 3]: normals as long as the area that a point stands for; normals [n, 3]: first guesses of
    any length; sizes [n]: the edges of the cells. A point counts for less the further away it is and the
    more its normal is turned, so that the far side of a thin body has no part.
    """

    def __init__(self, points, vectors, normals, sizes):
        self.points, self.widths = points, WIDTH * sizes
        self.frames, self.heights = np.zeros((len(points), 3, 3)), np.zeros((len(points), 6))
        for some, at, near in neighbourhoods(points, REACH * self.widths):
            away = (points[near] - points[some][at]) / self.widths[some][at, None]
            closeness = np.exp(-0.5 * np.einsum("ij,ij->i", away, away))
            normal = unit(normals[some])
            for _ in range(ROUNDS):
                weight = closeness * np.maximum(np.einsum("ij,ij->i", normal[at], vectors[near]), 0)
                normal = unit(sums(at, weight[:, None] * vectors[near], len(some)))
            self.frames[some] = frames(normal)
            self.heights[some] = fit(np.einsum("ijk,ik->ij", self.frames[some][at], away), weight, at, len(some))

    def onto(self, which, places):
        """Places [m, 3], moved along the normals of the points `which` [m] onto their quadrics."""
        width, frame = self.widths[which, None], self.frames[which]
        x, y, z = np.einsum("ijk,ik->ji", frame, (places - self.points[which]) / width)
        height = np.einsum("ij,ij->i", terms(x, y), self.heights[which])
        return places + width * np.clip(height - z, -1, 1)[:, None] * frame[:, 2]


def terms(x, y):
    return np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=1)


def fit(away, weight, at, number):
    """The factors of the terms [number, 6] that come nearest to the places `away` [k, 3], each around `at`."""
    known = terms(away[:, 0], away[:, 1])
    matrix = np.zeros((number, 6, 6))
    for i in range(6):
        for j in range(i, 6):
            matrix[:, i, j] = matrix[:, j, i] = np.bincount(at, weight * known[:, i] * known[:, j], number)
    total = matrix[:, 0, 0] + (matrix[:, 0, 0] == 0)
    matrix += total[:, None, None] * np.diag([1e-9] + [RIDGE] * 5)
    right = sums(at, (weight * away[:, 2])[:, None] * known, number)
    return np.linalg.solve(matrix, right[..., None])[..., 0]


def sums(at, values, number):
    """For each of `number` places the sum of the values [k, c] whose place is at[k]."""
    return np.stack([np.bincount(at, column, number) for column in values.T], axis=1)


def unit(vectors):
    return vectors / (np.linalg.norm(vectors, axis=1, keepdims=True) + 1e-300)


def frames(normals):
    """Two tangents and the normal, as rows [n, 3, 3]."""
    first = unit(np.cross(normals, np.eye(3)[abs(normals).argmin(axis=1)]))
    return np.stack([first, np.cross(normals, first), normals], axis=1)


def neighbourhoods(points, reach, most=1000000):
    """(some, at, near) for some points at a time: points[near] are within reach of points[some][at].

    Points of about the same reach go together, and so few that there are no more than `most` pairs of them
    to look at, or one point only.
    """
    if len(points) == 0:
        return
    scale = np.floor(np.log2(reach))
    order = np.lexsort([*np.floor((points - points.min(axis=0)) / (4 * 2**scale)[:, None]).T, scale])
    todo = [some for alike in np.split(order, np.flatnonzero(np.diff(scale[order])) + 1)
            for some in np.array_split(alike, len(alike) // 4000 + 1)]
    while todo:
        some = todo.pop()
        far = reach[some].max()
        around = np.flatnonzero(((points >= points[some].min(axis=0) - far) &
                                 (points <= points[some].max(axis=0) + far)).all(axis=1))
        found = pairs(points[some], points[around], far, most if len(some) > 1 else np.inf)
        if found is None:
            todo += np.array_split(some, 2)
            continue
        at, near = found[0], around[found[1]]
        close = np.linalg.norm(points[near] - points[some][at], axis=1) < reach[some][at]
        yield some, at[close], near[close]


def pairs(points, others, far, most):
    """(at, near) of the points and the others in boxes of a side `far` that touch; None of more than `most`."""
    low = others.min(axis=0) - 2 * far
    count = np.floor((others.max(axis=0) - low) / far).astype(int) + 3

    def boxes(places):
        return np.ravel_multi_index(np.floor((places - low) / far).astype(int).T, count)
    filled = boxes(others)
    order = np.argsort(filled, kind="stable")
    filled, steps = filled[order], np.indices((3, 3, 3)).reshape(3, -1)
    steps = np.ravel_multi_index(steps, count) - np.ravel_multi_index((1, 1, 1), count)
    wanted = (boxes(points)[:, None] + steps).ravel()
    first, last = (np.searchsorted(filled, wanted, side) for side in ("left", "right"))
    number = last - first
    if number.sum() > most:
        return None
    of = np.repeat(np.arange(len(wanted)), number)
    begin = np.cumsum(number) - number
    return of // len(steps), order[first[of] + np.arange(len(of)) - begin[of]]
