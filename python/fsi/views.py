"""Pictures in three dimensions: the body in its vessel with the flow, and the body over time."""
from dataclasses import dataclass, field

import matplotlib
import matplotlib.ticker
import matplotlib.pyplot as plt
import numpy as np

from . import cuts, labels, render, scene, sections, style, surfaces

PARTS = ("wall", "slice", "streamlines", "body")
COLOURS = ("stretch", "traction", "p", "speed", "none")
BODY, FLOW = "YlOrRd", "Blues"
BESIDE = 2.0  # what --view body shows to either side, in sizes of the body


@dataclass
class Look:
    """What a view shows and how."""

    colour: str = "stretch"  # of the body: stretch, p, speed, traction or none
    parts: tuple = PARTS
    q: float = None  # value of the isosurface of Q; None: none; 0: one that shows the strongest vortices
    view: str = "auto"  # body: follows it; vessel: all of it; auto: body in a periodic vessel
    normal: str = "z"
    camera: tuple = None  # from where one looks; None: a little aside of the normal
    relative: bool = False  # streamlines in the frame of the body
    renderer: str = "auto"
    units: labels.Units = field(default_factory=labels.Units)
    ranges: dict = field(default_factory=dict)  # of colours, by field; what is missing fits the data
    pixels: int = 1100
    frame: tuple = None  # width and height of what the picture spans; None: what fits

    def eye(self):
        """From where one looks, and what is upwards."""
        if self.camera is not None:
            steep = abs(self.camera[1]) > 0.9 * np.linalg.norm(self.camera)
            return self.camera, (0, 0, 1) if steep else (0, 1, 0)
        return {"z": ((0.4, 0.36, 1.0), (0, 1, 0)), "y": ((0.4, -1.0, 0.36), (0, 0, 1)),
                "x": ((1.0, 0.36, -0.4), (0, 1, 0))}[self.normal]


def window(snapshot, look, about, size=0.0):
    """The box [2, 3] that a view shows; size: of the body."""
    mesh = snapshot.mesh
    low, high = mesh.low.copy(), mesh.high.copy()
    follow = look.view == "body" or look.view == "auto" and mesh.period.any()
    if follow and about is not None:
        half = 1.25 * np.sort(high - low)[1]
        if look.view == "body" and size > 0:
            half = min(half, BESIDE * size)
        for axis in range(3):
            if mesh.period[axis]:
                reach = min(half, 0.5 * mesh.period[axis])
                low[axis], high[axis] = about[axis] - reach, about[axis] + reach
            elif high[axis] - low[axis] > 2 * half:
                low[axis], high[axis] = max(low[axis], about[axis] - half), min(high[axis], about[axis] + half)
    return np.array([low, high])


def within(surface, box, mesh):
    """The part of a surface in a box, with its copies along the periods; cut off at the box."""
    found, room = [], 1e-9 * np.ptp(box, axis=0).max()
    for step in np.ndindex(*np.where(mesh.period > 0, 5, 1)):
        shift = (np.array(step) - np.where(mesh.period > 0, 2, 0)) * mesh.period
        copy = surface.moved(shift)
        corners = copy.points[copy.triangles]
        inside = ((corners.max(axis=1) > box[0] - room) & (corners.min(axis=1) < box[1] + room)).all(axis=1)
        if inside.any():
            part = copy.part(inside)
            for axis in range(3):
                part = surfaces.clipped(part, part.points[:, axis] - box[0, axis] + room)
                part = surfaces.clipped(part, box[1, axis] - part.points[:, axis] + room)
            found.append(part)
    if not found:
        return surface.part(np.zeros(0, int))
    return surfaces.united(found)


def colours_of(name, values, cmap, look):
    """The colours of a field: the range that is given, else that of the values.

    A few values far away from the others do not set the range; the colour bar has an arrow there.
    """
    low, high = look.ranges.get(name) or scene.span(values)
    return scene.Colours(cmap, low, high, look.units.field(name, max(abs(low), abs(high))),
                         scene.beyond(values, low, high), labels.FIELDS[name][2])


def build(run, snapshot, look):
    """(layers, camera, colours of the bars) of a view."""
    about = snapshot.centre_of_solid()
    body, size = None, 0.0
    if about is not None:
        carried = () if look.colour == "none" else (look.colour,)
        body = surfaces.solid_surface(snapshot, carried)
        if len(body.points):
            about = 0.5 * (body.points.min(axis=0) + body.points.max(axis=0))
            size = np.ptp(body.points, axis=0).max()
    mesh, box = snapshot.mesh, window(snapshot, look, about, size)
    wall = within(surfaces.wall(mesh), box, mesh)
    # Near a body in the middle of a wide vessel there is no wall.
    corners = box[np.array(list(np.ndindex(2, 2, 2))), np.arange(3)]
    camera = scene.fitted([wall.points if len(wall.points) else corners], *look.eye())
    camera.width, camera.height = look.frame or (camera.width, camera.height)
    layers, bars = [], []
    if "wall" in look.parts:
        layers.append(scene.glass(wall, camera))
    if "slice" in look.parts or "streamlines" in look.parts:
        speed = colours_of("speed", snapshot["speed"], FLOW, look)
        speed.low = min(speed.low, 0.0)
        bars.append(speed)
    if "slice" in look.parts:
        layers.append(_slice(snapshot, look, about, box, speed))
        if body is not None and len(body.points) and "body" in look.parts:
            set_behind(layers, body, look, camera)
    if "streamlines" in look.parts:
        layers.append(_streamlines(snapshot, look, about, box, camera, speed))
    if body is not None and len(body.points) and "body" in look.parts:
        colours = (*matplotlib.colors.to_rgb(style.ORANGE), 1)
        if look.colour in body.values:
            bars.insert(0, colours_of(look.colour, body.values[look.colour], BODY, look))
            colours = bars[0](body.values[look.colour])
        layers.append(scene.painted(body, colours))
    if look.q is not None:
        layers.append(_vortices(snapshot, look, box, camera))
    return layers, camera, bars


def _slice(snapshot, look, about, box, speed):
    axis = cuts.AXES.index(look.normal)
    cut = cuts.cut(snapshot, look.normal, None if about is None else about[axis])
    plane = within(surfaces.Surface(cut.points, cut.triangles, {"speed": cut["speed"]}), box, snapshot.mesh)
    return scene.painted(plane, speed(plane.values["speed"]), lit=False)


def set_behind(layers, body, look, camera):
    """Moves the slice, the last layer, and what is behind it away from the eye until it is behind all of the body.

    A parallel projection shows them where they were, and they hide nothing of the body.
    """
    axis, away = cuts.AXES.index(look.normal), camera.axes()[2]
    if abs(away[axis]) < 0.1:  # the slice is viewed from its edge
        return
    place = layers[-1].points[:1, axis]
    depth = ((place - body.points[:, axis]) / away[axis]).max(initial=0)
    for layer in layers:
        back = (layer.points[:, axis] - place) / away[axis] < 1e-9 * camera.width
        layer.points = layer.points - np.where(back, 1.01 * depth, 0)[:, None] * away


def _streamlines(snapshot, look, about, box, camera, speed, count=24):
    mesh = snapshot.mesh
    centres, free = mesh.centres(), np.ones(len(mesh.types), bool)
    if "alpha" in snapshot:
        free = snapshot["alpha"] < 0.05
    places = centres[free]
    random = np.random.default_rng(7)
    places = places[random.permutation(len(places))[:1500]]
    shifted = places + mesh.period * np.round((box.mean(axis=0) - places) / np.where(
        mesh.period > 0, mesh.period, 1))
    inside = ((shifted > box[0]) & (shifted < box[1])).all(axis=1)
    if "slice" in look.parts:  # lines behind the slice are hidden
        axis = cuts.AXES.index(look.normal)
        side = np.sign(look.eye()[0][axis])
        inside &= side * (shifted[:, axis] - (box.mean(axis=0) if about is None else about)[axis]) > 0
    places = shifted[inside]
    grid = scene.Grid(snapshot, "u")
    if look.relative and snapshot.has_solid():
        grid.values = grid.values - snapshot.velocity_of_solid()
    seeds = scene.apart(places, count)
    size = min(camera.width, camera.height)
    # To both sides far enough to come to the wall, an inlet or an outlet.
    lines = [trimmed(line, grid) for line in scene.streamlines(grid, seeds, 3 * camera.width, 480)]
    lines = [piece for line in lines for piece in pieces(line, ((line >= box[0]) & (line <= box[1])).all(axis=1))]
    surface = scene.tubes(lines, 0.0028 * size)
    return scene.painted(surface, (0.25, 0.3, 0.36, 1))


def trimmed(line, grid):
    """A line without what sticks out of the mesh at its ends, up to two steps of the grid; a line along a wall,
    where the grid does not tell, stays."""
    inside = np.flatnonzero(grid.inside(line))
    step = np.linalg.norm(line[1] - line[0])
    if len(inside) == 0 or step == 0:
        return line
    most = 2 * grid.step.max() / step
    first, beyond = inside[0], len(line) - 1 - inside[-1]
    return line[first if first <= most else 0:len(line) - (beyond if beyond <= most else 0)]


def pieces(line, kept, least=13):
    """The stretches of a line that are kept, where they have at least so many points."""
    ends = np.flatnonzero(np.diff(np.concatenate([[False], kept, [False]]).astype(int)))
    return [line[a:b] for a, b in zip(ends[::2], ends[1::2]) if b - a >= least]


def _vortices(snapshot, look, box, camera):
    level = look.q
    if not level:
        fluid = snapshot["Q"][snapshot["alpha"] < 0.01] if "alpha" in snapshot else snapshot["Q"]
        level = max(np.percentile(fluid, 98), 1e-12)
    surface = surfaces.smooth(within(surfaces.isosurface(snapshot, "Q", level), box, snapshot.mesh), 5)
    return scene.glass(surface, camera, matplotlib.colors.to_rgb(style.GREEN), 0.25, 0.6)


def view(run, number=-1, look=None, scale=1):
    """A figure of the body in its vessel with the flow at one time."""
    look = look or Look()
    snapshot = run.snapshot(number)
    layers, camera, bars = build(run, snapshot, look)
    aspect = camera.height / camera.width
    width = int(look.pixels * min(1, 0.8 / aspect))
    picture = render.image(layers, camera, width * scale, max(int(width * aspect), 1) * scale, look.renderer)
    inches = width / style.DPI
    above, strip, below = 0.3, 0.45, 0.62 if bars else 0.05
    height = above + inches * aspect + strip + below
    figure = plt.figure(figsize=(inches, height))
    ax = figure.add_axes((0, (below + strip) / height, 1, inches * aspect / height))
    show(ax, picture)
    last = number % len(run.items) == len(run.items) - 1
    ax.set_title(time_of(run, snapshot, look) + (sections.end(run, look.units) if last else ""), loc="left", x=0.01)
    ruler(figure.add_axes((0, below / height, 1, strip / height)), camera, look, strip / inches)
    colour_bars(figure, bars, look.units, below / height)
    return figure


def time_of(run, snapshot, look):
    """The time, and the part of the solid inside the mesh if a part has left, since only that is drawn."""
    left = run.inside(snapshot.time)
    part = "" if left > 0.995 or not snapshot.has_solid() else f", {100 * left:.0f} % inside"
    return f"t = {look.units.number(snapshot.time, 'time')}{part}"


def show(ax, picture):
    """Puts a rendered picture into axes, a pixel a pixel."""
    ax.imshow(picture, interpolation="none", aspect="auto")
    ax.axis("off")


def ruler(ax, camera, look, share):
    """The directions and a length in a strip as wide as the picture, `share` of its width high."""
    width = camera.width
    height = share * width
    length = 10.0 ** np.floor(np.log10(0.25 * width))
    length *= max(k for k in (1, 2, 5) if k * length <= 0.25 * width)
    ax.set_xlim(0, width)
    ax.set_ylim(0, height)
    ax.axis("off")
    right = 0.985 * width
    ax.plot([right - length, right], [0.3 * height] * 2, color="0.2", linewidth=1.5, solid_capstyle="butt")
    ax.text(right - 0.5 * length, 0.4 * height, look.units.number(length, "length"), ha="center",
            va="bottom", fontsize=8)
    arm, corner = 0.42 * height, np.array([0.55, 0.42]) * height
    for axis, way in zip(cuts.AXES, camera.axes()[:2].T):
        ax.annotate("", corner + arm * way, corner, arrowprops={
            "arrowstyle": "-|>", "color": "0.2", "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0,
            "mutation_scale": 6})
        ax.text(*(corner + 1.4 * arm * way), axis, ha="center", va="center", fontsize=8)


def colour_bars(figure, bars, units, below):
    """A bar for each map in a row below the picture."""
    for i, bar in enumerate(bars):
        share = 1 / len(bars)
        ax = figure.add_axes((share * (i + 0.5) - 0.36 * share, 0.72 * below, 0.72 * share, 0.14 * below))
        mapped = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(bar.low, bar.high), bar.name)
        figure.colorbar(mapped, cax=ax, orientation="horizontal", label=bar.label, extend=bar.extend,
                        ticks=matplotlib.ticker.MaxNLocator(5))
        units.ticks(ax.xaxis, bar.kind, max(abs(bar.low), abs(bar.high)))
        ax.tick_params(labelsize=8)


def over_time(run, look=None, scale=1, most=6):
    """The body alone at up to six times, all at one scale; None without a solid."""
    look = look or Look()
    numbers = sections.while_solid(run)
    if not numbers:
        return None
    shown = [numbers[i] for i in sections.spread(len(numbers), most)]
    carried = () if look.colour == "none" else (look.colour,)
    snapshots = list(run.snapshots(shown))
    bodies = [surfaces.solid_surface(snapshot, carried) for snapshot in snapshots]
    drawn = [i for i, body in enumerate(bodies) if len(body.points)]  # specks have no surface
    if not drawn:
        return None
    shown, snapshots, bodies = ([some[i] for i in drawn] for some in (shown, snapshots, bodies))
    bars = []
    if carried and all(look.colour in body.values for body in bodies):
        bars = [colours_of(look.colour, np.concatenate([b.values[look.colour] for b in bodies]), BODY, look)]
    cameras = [scene.fitted([body.points], *look.eye(), margin=1.1) for body in bodies]
    for camera in cameras:
        camera.width, camera.height = (max(getattr(c, side) for c in cameras) for side in ("width", "height"))
    columns = min(3, len(shown))
    rows = -(-len(shown) // columns)
    wide = 2.3
    tall, above, strip, below = wide * cameras[0].height / cameras[0].width, 0.28, 0.45, 0.62 if bars else 0.05
    height = 0.25 + rows * (above + tall) + strip + below
    figure = plt.figure(figsize=(wide * columns, height))
    pixels = [int(side * style.DPI * scale) for side in (wide, tall)]
    for i, (snapshot, body, camera) in enumerate(zip(snapshots, bodies, cameras)):
        bottom = below + strip + (rows - 1 - i // columns) * (above + tall)
        ax = figure.add_axes((i % columns / columns, bottom / height, 1 / columns, tall / height))
        colours = bars[0](body.values[look.colour]) if bars else (*matplotlib.colors.to_rgb(style.SOLID), 1)
        show(ax, render.image([scene.painted(body, colours)], camera, *pixels, look.renderer))
        ax.set_title(time_of(run, snapshot, look), loc="left", x=0.02)
    ruler(figure.add_axes((0, below / height, 1 / columns, strip / height)), cameras[0], look, strip / wide)
    figure.suptitle(r"surface of the solid, $\alpha$ = 0.5" + sections.gone(run, numbers, look.units),
                    x=0.01, y=1 - 0.02 / height, ha="left", va="top", fontsize=9.5)
    colour_bars(figure, bars, look.units, below / height)
    return figure
