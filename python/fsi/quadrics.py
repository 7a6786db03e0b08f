"""A quadric near each point of a surface, fitted to the surface around it: it takes out the steps of cells.

A quadric keeps what is curved, as a mean of neighbours does not. What is around is told by lengths, so that
the size and the shape of the triangles do not matter.
"""
import numpy as np

WIDTH, REACH = 0.9, 2.0  # of the weights: the width in edges of cells, and how many widths they reach
RIDGE = 1e-3  # settles slope and curvature where there are too few points around


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
            for _ in range(3):
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
    """For each of so many places the sum of the values [k, c] that stand `at` it [k]."""
    return np.stack([np.bincount(at, column, number) for column in values.T], axis=1)


def unit(vectors):
    return vectors / (np.linalg.norm(vectors, axis=1, keepdims=True) + 1e-300)


def frames(normals):
    """Two tangents and the normal, as rows [n, 3, 3]."""
    first = unit(np.cross(normals, np.eye(3)[abs(normals).argmin(axis=1)]))
    return np.stack([first, np.cross(normals, first), normals], axis=1)


def neighbourhoods(points, reach, most=4000):
    """(some, at, near) for some points at a time: points[near] are within reach of points[some][at]."""
    if len(points) == 0:
        return
    side = 4 * np.median(reach)
    order = np.lexsort(np.floor((points - points.min(axis=0)) / side).T)
    for some in np.array_split(order, len(order) // most + 1):
        far = reach[some].max()
        around = np.flatnonzero(((points >= points[some].min(axis=0) - far) &
                                 (points <= points[some].max(axis=0) + far)).all(axis=1))
        at, near = pairs(points[some], points[around], far)
        near = around[near]
        close = np.linalg.norm(points[near] - points[some][at], axis=1) < reach[some][at]
        yield some, at[close], near[close]


def pairs(points, others, far):
    """(at, near) of the points and the others in boxes of a side `far` that touch."""
    low = others.min(axis=0) - 2 * far
    count = np.floor((others.max(axis=0) - low) / far).astype(int) + 3

    def boxes(places):
        return np.ravel_multi_index(np.floor((places - low) / far).astype(int).T, count)
    order, here, found = np.argsort(boxes(others), kind="stable"), boxes(points), []
    filled = boxes(others)[order]
    for step in np.ndindex(3, 3, 3):
        wanted = here + np.ravel_multi_index(step, count) - np.ravel_multi_index((1, 1, 1), count)
        first, last = (np.searchsorted(filled, wanted, side) for side in ("left", "right"))
        at = np.repeat(np.arange(len(points)), last - first)
        begin = np.cumsum(last - first) - (last - first)
        found.append((at, order[first[at] + np.arange(len(at)) - begin[at]]))
    return tuple(np.concatenate(part) for part in zip(*found))
