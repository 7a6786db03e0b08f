"""A film of a run: a picture of each field file, and a gif or, where ffmpeg is installed, an mp4."""
import os
import shutil
import subprocess
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

from . import scene, sections, style, surfaces, views


def film(run, folder, look=None, scale=1, rate=8):
    """Writes folder/film/frame_NNNN.png and folder/film.mp4 or film.gif; the path of the film.

    Colours and view keep their range; in three dimensions the camera follows the body.
    """
    look = look or views.Look()
    frames = os.path.join(folder, "film")
    os.makedirs(frames, exist_ok=True)
    for name in os.listdir(frames):
        if name.startswith("frame_"):
            os.remove(os.path.join(frames, name))
    paths = [os.path.join(frames, f"frame_{i:04}.png") for i in range(len(run.items))]
    look = replace(look, ranges=ranges(run, look))
    deep = run.snapshot(0).dim == 3
    if deep:
        camera = views.build(run, run.snapshot(0), replace(look, parts=()))[1]
        look = replace(look, frame=(camera.width, camera.height))
    for i, path in enumerate(paths):
        figure = views.view(run, i, look, scale) if deep else \
            sections.flow(run, look.normal, [i], look.units, look.ranges["speed"][1],
                          look.relative)
        figure.savefig(path, dpi=style.DPI * scale, facecolor="white")
        plt.close(figure)
    return _joined(paths, os.path.join(folder, "film"), rate)


def ranges(run, look):
    """The smallest and largest value of what is coloured, over all times, by field."""
    found = {}
    for snapshot in run.snapshots():
        values = {"speed": snapshot["speed"]}
        if snapshot.dim == 3 and look.colour != "none" and snapshot.has_solid():
            values.update(surfaces.solid_surface(snapshot, (look.colour,)).values)
        for name, here in values.items():
            low, high = found.get(name, (np.inf, -np.inf))
            least, most = scene.span(here)
            found[name] = min(low, least), max(high, most)
    return {**found, **look.ranges}


def _joined(paths, stem, rate):
    program = shutil.which("ffmpeg")
    if program is not None:
        path = stem + ".mp4"
        subprocess.run([program, "-y", "-loglevel", "error", "-framerate", str(rate), "-i",
                        os.path.join(os.path.dirname(paths[0]), "frame_%04d.png"), "-vf",
                        "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", path], check=True,
                       stdin=subprocess.DEVNULL)
        return path
    path = stem + ".gif"
    pictures = [Image.open(p).convert("RGB").quantize(128, dither=Image.Dither.NONE) for p in paths]
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=int(1000 / rate), loop=0)
    return path
