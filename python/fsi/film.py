"""A film of a run: a picture of each field file, and a gif or, where ffmpeg is installed, an mp4."""
import os
import shutil
import subprocess
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

from . import sections, style, views


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
            sections.flow(run, look.normal, [i], look.units, look.ranges["speed"][1])
        figure.savefig(path, dpi=style.DPI * scale, facecolor="white")
        plt.close(figure)
    return _joined(paths, os.path.join(folder, "film"), rate)


def ranges(run, look):
    """The smallest and largest value of what is coloured, over all times, by field."""
    found = dict(look.ranges)
    for snapshot in run.snapshots():
        for name in ("speed", look.colour):
            if name not in snapshot or name in look.ranges:
                continue
            values = snapshot[name]
            if name != "speed":
                values = values[snapshot["alpha"] > 0.5]
            if len(values):
                low, high = found.get(name, (np.inf, -np.inf))
                found[name] = min(low, float(values.min())), max(high, float(values.max()))
    found.setdefault("speed", (0.0, 1.0))
    return found


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
