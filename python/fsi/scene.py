"""Pictures in three dimensions: layers of triangles, and a camera."""
from dataclasses import dataclass

import matplotlib
import numpy as np

from . import cells, surfaces

GREY = (0.55, 0.6, 0.66)


@dataclass
class Layer:
    """Triangles with a colour and an opacity at each point, red green blue alpha [n, 4]."""

    points: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray
    colours: np.ndarray
    lit: bool = True


@dataclass
class Camera:
    """Looks from far away along -`towards`, `up` upwards; a parallel projection shows true lengths.

    `middle` is the point in the middle, `width` and `height` are what the picture spans.
    """

    middle: np.ndarray
    towards: np.ndarray
    up: np.ndarray
    width: float
    height: float

    def axes(self):
        """Unit vectors to the right, upwards and towards the eye, as rows."""
        back = self.towards / np.linalg.norm(self.towards)
        right = np.cross(self.up, back)
        right /= np.linalg.norm(right)
        return np.array([right, np.cross(back, right), back])


@dataclass
class Colours:
    """A colour map over a range, with the label of its bar."""

    name: str
    low: float
    high: float
    label: str
    extend: str = "neither"  # where values lie beyond the range, as matplotlib calls it
    kind: str = "1"  # of its unit

    def __call__(self, values):
        span = max(self.high - self.low, 1e-300)
        return matplotlib.colormaps[self.name](np.clip((values - self.low) / span, 0, 1))


def span(values):
    """The range of values: the whole of it, unless a hundredth of them makes more than half of it."""
    low, least, most, high = np.percentile(values, (0, 1, 99, 100))
    return (low, high) if high - low < 2 * (most - least) else (least, most)


def beyond(values, low, high):
    under, over = np.min(values) < low - 1e-12, np.max(values) > high + 1e-12
    return "both" if under and over else "min" if under else "max" if over else "neither"


def painted(surface, colours, lit=True):
    """A surface in colours [4] or [n, 4]."""
    colours = np.broadcast_to(np.asarray(colours, float), (len(surface.points), 4))
    return Layer(surface.points, surface.triangles, surface.normals(), colours, lit)


def glass(surface, camera, colour=GREY, faint=0.05, rim=0.6):
    """A translucent surface: faint where one looks straight through it, clear at its rim."""
    layer = painted(surface, (*colour, faint))
    slant = 1 - abs(layer.normals @ camera.axes()[2])
    layer.colours = layer.colours.copy()
    layer.colours[:, 3] += (rim - faint) * slant**3
    return layer


def tubes(lines, radius, sides=8):
    """Round tubes about lines, each [n, 3]."""
    points, triangles, offset = [], [], 0
    turn = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    for line in lines:
        along = np.gradient(line, axis=0)
        along /= np.linalg.norm(along, axis=1, keepdims=True) + 1e-300
        first = np.cross(along, np.eye(3)[abs(along).mean(axis=0).argmin()])
        first /= np.linalg.norm(first, axis=1, keepdims=True) + 1e-300
        second = np.cross(along, first)
        ring = np.cos(turn)[:, None] * first[:, None] + np.sin(turn)[:, None] * second[:, None]
        points.append((line[:, None] + radius * ring).reshape(-1, 3))
        a = (np.arange(len(line) - 1)[:, None] * sides + np.arange(sides)).ravel()
        b = (np.arange(len(line) - 1)[:, None] * sides + (np.arange(sides) + 1) % sides).ravel()
        triangles += [offset + np.stack([a, b, a + sides], axis=1),
                      offset + np.stack([b, b + sides, a + sides], axis=1)]
        offset += len(points[-1])
    if not points:
        return surfaces.Surface(np.zeros((0, 3)), np.zeros((0, 3), int))
    return surfaces.Surface(np.concatenate(points), np.concatenate(triangles))


class Grid:
    """A vector field at a regular grid over a mesh, for streamlines; NaN outside of the mesh."""

    def __init__(self, snapshot, name, count=32):
        mesh = snapshot.mesh
        self.low, self.period = mesh.low, mesh.period
        size = mesh.high - mesh.low
        self.step = max(size.min() / count, (size.prod() / 2e6)**(1 / 3))
        shape = np.maximum(np.ceil(size / self.step - 1e-9).astype(int) + 1, 2)
        self.step = size / (shape - 1)
        self.values = np.full((*shape, 3), np.nan)
        # Of the cells with a node of the grid, some at a time: each is many tetrahedra.
        holds = np.ones(len(mesh.types), bool)
        for axis in range(3):
            least, most = mesh.extent((mesh.points[:, axis] - self.low[axis]) / self.step[axis])
            holds &= np.ceil(least - 1e-6) <= np.floor(most + 1e-6)
        chosen = np.flatnonzero(holds)
        for some in np.array_split(chosen, len(chosen) // 50000 + 1):
            parts = cells.Simplices(mesh, some)
            found = cells.resample(parts.extend(mesh.points), parts.corners,
                                   parts.extend(snapshot.at_points(name)), mesh.low, mesh.high, shape)
            self.values = np.where(np.isnan(found), self.values, found)
        self.known = ~np.isnan(self.values[..., :1]) + 0.0
        self.values = grown(self.values)

    def __call__(self, places):
        """Values at places [n, 3], linear between the nodes; NaN outside."""
        return self._linear(self.values, places)

    def inside(self, places):
        """Whether places are in the mesh, to half a step of the grid."""
        return self._linear(self.known, places)[:, 0] > 0.5

    def _linear(self, values, places):
        periods = np.where(self.period > 0, np.floor((places - self.low) / np.where(
            self.period > 0, self.period, 1)), 0)
        node = (places - periods * self.period - self.low) / self.step
        shape = np.array(values.shape[:3])
        base = np.floor(np.nan_to_num(node, nan=-1)).astype(int)
        out = ((base < 0) | (base > shape - 2)).any(axis=1)
        base = np.clip(base, 0, shape - 2)
        share = node - base
        total = 0
        for corner in np.ndindex(2, 2, 2):
            weight = np.prod(np.where(corner, share, 1 - share), axis=1)
            total = total + weight[:, None] * values[tuple((base + corner).T)]
        total[out] = np.nan
        return total


def grown(values):
    """A field on a grid [nx, ny, nz, 3] by one layer wider: a node without a value takes the mean of those
    around it. So all places in the mesh have their eight nodes."""
    known = ~np.isnan(values[..., :1])
    padded = np.pad(np.concatenate([np.where(known, values, 0), known], axis=-1), ((1, 1),) * 3 + ((0, 0),))
    total = sum(padded[tuple(slice(i, i + n) for i, n in zip(step, values.shape))] for step in
                np.ndindex(3, 3, 3))
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(known, values, total[..., :3] / total[..., 3:])


def streamlines(grid, seeds, length, steps=160, least=20):
    """Lines along the velocity through the seeds, `length` long to both sides, or to the wall; none of
    `least` points or less."""
    step = length / steps
    found = []
    for way in (-step, step):
        places, trail = np.array(seeds, float), []
        for _ in range(steps):
            velocity = grid(places)
            middle = places + 0.5 * way * _unit(velocity)
            places = places + way * _unit(grid(middle))
            trail.append(places)
        found.append(np.stack(trail))
    whole = np.concatenate([found[0][::-1], np.asarray(seeds, float)[None], found[1]])
    for line in np.swapaxes(whole, 0, 1):
        known = line[~np.isnan(line).any(axis=1)]
        if len(known) > least:
            yield known


def apart(places, count):
    """So many of the places, each as far as can be from those before it."""
    if len(places) == 0:
        return places
    chosen, away = [0], np.full(len(places), np.inf)
    while len(chosen) < min(count, len(places)):
        away = np.minimum(away, np.linalg.norm(places - places[chosen[-1]], axis=1))
        chosen.append(int(away.argmax()))
    return places[chosen]


def _unit(vectors):
    return vectors / (np.linalg.norm(vectors, axis=1, keepdims=True) + 1e-12)


def fitted(layers_points, towards, up, margin=1.04):
    """A camera whose picture just holds the points."""
    camera = Camera(np.zeros(3), np.asarray(towards, float), np.asarray(up, float), 1, 1)
    axes = camera.axes()
    seen = np.concatenate(layers_points) @ axes.T
    low, high = seen.min(axis=0), seen.max(axis=0)
    camera.middle = 0.5 * (low + high) @ axes
    camera.width, camera.height = margin * (high - low)[:2]
    return camera
