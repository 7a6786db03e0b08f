"""Pictures of plane sections: the speed with streamlines, and the interface over time in two dimensions."""
import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

from . import cuts, labels, scene, style, surfaces

AXES = cuts.AXES


def spread(count, most):
    """Up to `most` of `count` numbers, evenly spread, first and last among them."""
    return list(range(count)) if count <= most else \
        [int(i) for i in np.unique(np.linspace(0, count - 1, most).round())]


def outline(ax, cut, colour, width=1.8):
    """The interface of the solid on a section."""
    if cut.snapshot.dim == 2:
        segments = surfaces.solid_outline(cut.snapshot)
    else:
        # A section shows the solid inside the mesh, in one piece or not.
        surface = surfaces.solid_surface(cut.snapshot)
        segments = np.concatenate([surfaces.section(surface.moved(shift), cut.normal, cut.level)
                                   for shift in copies(cut.snapshot.mesh)])
    ax.add_collection(LineCollection(segments[..., cut.across], colors=[colour], linewidths=width,
                                     capstyle="round"))


def copies(mesh):
    """The shifts by a period that bring back parts beyond a periodic boundary."""
    steps = np.array(list(np.ndindex(*np.where(mesh.period > 0, 3, 1)))) - (mesh.period > 0)
    return steps * mesh.period


def frame(ax, cut, units):
    ax.set_aspect("equal")
    ax.set_xlim(cut.low[0], cut.high[0])
    ax.set_ylim(cut.low[1], cut.high[1])
    size = (cut.high - cut.low).max()
    for axis, name, setter in zip((ax.xaxis, ax.yaxis), cut.across, (ax.set_xlabel, ax.set_ylabel)):
        setter(units.label(AXES[name], "length", size=size))
        units.ticks(axis, "length", size)
    ax.grid(False)


def title(cut, units):
    """The time and the place of a section."""
    if cut.snapshot.dim == 2:
        return f"t = {units.number(cut.snapshot.time, 'time')}"
    size = (cut.high - cut.low).max()
    level = round(cut.level, 3 - int(np.floor(np.log10(size)))) + 0.0
    where = f"   plane {AXES[cut.normal]} = {units.number(level, 'length', size)}"
    return f"t = {units.number(cut.snapshot.time, 'time')}{where}"


def draw_section(ax, cut, top, units, relative=False):
    """Speed, streamlines and interface on one section; returns what a colour bar needs. relative:
    streamlines as one sees them who moves with the body."""
    _, _, speed = cut.grid(cut["speed"], 900)
    shades = ax.imshow(speed, extent=(cut.low[0], cut.high[0], cut.low[1], cut.high[1]), origin="lower",
                       vmin=0, vmax=top, interpolation="bilinear")
    size = cut.high - cut.low
    body = cut.snapshot.velocity_of_solid() if relative else None
    gx, gy, velocity = cut.grid((cut["u"] - (0 if body is None else body))[:, cut.across])
    if abs(velocity).max() > 1e-9 * cut["speed"].max():  # else it is rounding
        ax.streamplot(gx, gy, velocity[..., 0], velocity[..., 1], color=(1, 1, 1, 0.55), linewidth=0.6,
                      arrowsize=0.6, density=(1.6, 0.6) if size[0] > 2 * size[1] else 1.1)
    if "alpha" in cut.snapshot:
        outline(ax, cut, style.SOLID)
    frame(ax, cut, units)
    ax.set_title(title(cut, units), loc="left")
    return shades


def flow(run, normal, numbers=None, units=labels.Units(), top=None, relative=False):
    """The speed on a section through the solid, at up to four times; relative: of the streamlines."""
    numbers = spread(len(run.items), 4) if numbers is None else numbers
    found = list(cuts.cuts_through_solid(run.snapshots(numbers), normal))
    size = found[0].high - found[0].low
    wide = size[0] > 2 * size[1]
    rows, columns = (len(found), 1) if wide else (1, len(found))
    width, height = (6.5, 5.9 * size[1] / size[0] + 0.5) if wide else \
        (2.9, 2.35 * size[1] / size[0] + 0.55)
    figure, axes = plt.subplots(rows, columns, squeeze=False, layout="constrained",
                                figsize=(width * columns + (not wide) * 0.7, height * rows + wide * 0.75))
    most = max(cut["speed"].max() for cut in found)
    # A few values far above the others, as in a run that fails, do not set the range.
    top = max(scene.span(cut["speed"])[1] for cut in found) if top is None else top
    for ax, cut in zip(axes.flat, found):
        shades = draw_section(ax, cut, top, units, relative)
        if ax is not axes.flat[0] and not wide:
            ax.set_ylabel("")
        if wide and ax is not axes.flat[len(found) - 1]:
            ax.set_xlabel("")
    if run.failed():
        figure.suptitle(end(run, units)[2:], x=0.01, ha="left", fontsize=9.5)
    bar = figure.colorbar(shades, ax=axes, label=units.field("speed", top), shrink=0.5 if wide else 0.9, aspect=30,
                    extend="max" if most > top else "neither", location="bottom" if wide else "right", pad=0.02)
    units.ticks(bar.ax.xaxis if wide else bar.ax.yaxis, "velocity", top)
    return figure


def while_solid(run):
    """The numbers of the field files up to the last one with solid in it."""
    numbers = list(range(len(run.items)))
    while numbers and not run.snapshot(numbers[-1]).has_solid():
        numbers.pop()
    return numbers


def last_whole(run):
    """The number of the last field file with nearly all of the solid in it; the last one without a solid."""
    numbers = while_solid(run)
    if not numbers:
        return -1
    whole = 0.98 * max(run.snapshot(number).volume_of_solid() for number in (0, numbers[-1]))
    return next((number for number in reversed(numbers) if run.snapshot(number).volume_of_solid() >= whole),
                numbers[-1])


def end(run, units):
    """What a title says of a run that failed, or nothing."""
    return f"; the run failed at t = {units.number(run.summary['t'], 'time')}" if run.failed() else ""


def gone(run, numbers, units):
    """What a title says where the solid has left before the end, and where the run failed."""
    left = "" if len(numbers) == len(run.items) else \
        f"; none is left at t = {units.number(run.times[len(numbers)], 'time')}"
    return left + end(run, units)


def interface(run, units=labels.Units()):
    """The interface of a run in two dimensions at up to eight times; None without a solid."""
    numbers = while_solid(run)
    if not numbers:
        return None
    shown = [numbers[i] for i in spread(len(numbers), 8)]
    figure, ax = plt.subplots(figsize=(4.6, 3.9), layout="constrained")
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.92, len(shown)))
    for snapshot, colour in zip(run.snapshots(shown), colours):
        cut = cuts.cut(snapshot)
        outline(ax, cut, colour, 1.5)
        ax.plot([], [], color=colour, label=f"t = {units.number(snapshot.time, 'time')}")
    frame(ax, cut, units)
    ax.set_title(r"interface, $\alpha$ = 0.5" + gone(run, numbers, units), loc="left")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure
