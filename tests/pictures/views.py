#!/usr/bin/python3
"""Pictures in three dimensions, by VTK where it is at hand and by numpy: views.py SOURCE FOLDER."""
import os
import re
import subprocess
import sys

import numpy as np

import made_up
from made_up import ball, box, check, filled_part, irregular, write_run

source, folder = made_up.arguments()
import fsi  # noqa: E402
from fsi import film, render, scene, style, surfaces, views  # noqa: E402
from PIL import Image  # noqa: E402

style.apply()
RENDERERS = ["plain"] + (["vtk"] if render.vtk_works() else [])


def run_across_a_seam():
    place = os.path.join(folder, "seam")
    mesh = fsi.Mesh(*box((2, 1, 1), (20, 10, 10)), (2, 0, 0))

    def fields(time):
        x = mesh.centres()
        speed = 1 - (2 * x[:, 1] - 1)**2
        away = x - (0.1, 0.5, 0.5)
        away[:, 0] -= 2 * np.round(away[:, 0] / 2)
        unit = np.tile([1.0, 1, 1, 0, 0, 0], (len(x), 1))
        unit[:, 0] += 0.2 * away[:, 0]
        return {"u": np.column_stack([speed, 0 * speed, 0 * speed]), "p": x[:, 0], "Q": -speed, "B": unit,
                "alpha": ball(mesh, (0.1 + time, 0.5, 0.5), 0.25, (2, 0, 0))}
    arrays = (mesh.points, mesh.corners, mesh.starts, mesh.types)
    time = np.linspace(0, 1, 5)
    write_run(place, arrays, [0.0, 1.0], fields, {"mesh_periodic": "inlet,outlet", "solid_shear_modulus": "10"},
              {"solid": {"t": time, "x": 0.1 + time, "y": 0.5 + 0 * time, "z": 0.5 + 0 * time, "angle": 45 + time}})
    return fsi.Run(place)


def check_image():
    """A red ball before a blue sheet: what covers what, where, and how bright."""
    mesh = fsi.Mesh(*box((1, 1, 1), (12, 12, 12)))
    ball_of = surfaces.solid_surface(fsi.Snapshot(mesh, 0, {"alpha": ball(mesh, (0.5, 0.5, 0.5), 0.3)}))
    sheet = surfaces.Surface(np.array([[0, 0, 0.5], [1, 0, 0.5], [1, 1, 0.5], [0, 1, 0.5]]),
                             np.array([[0, 1, 2], [0, 2, 3]]))
    camera = scene.fitted([sheet.points], (0, 0, 1), (0, 1, 0), margin=1.25)
    layers = [scene.painted(ball_of, (1, 0, 0, 1)), scene.painted(sheet, (0, 0, 1, 1), lit=False),
              scene.painted(sheet.moved(0.4), (0, 1, 0, 0.25), lit=False)]
    pictures = {}
    for renderer in RENDERERS:
        picture = pictures[renderer] = render.image(layers, camera, 200, 160, renderer)
        check(picture.shape == (160, 200, 3) and np.allclose(picture[2, 2], 1), f"{renderer}: on white")
        check(np.allclose(picture[135, 50], (0, 0, 1), atol=0.01), f"{renderer}: the sheet {picture[135, 50]}")
        check(picture[95, 85, 0] > 0.5 and picture[95, 85, 2] < 0.2, f"{renderer}: the ball is before it")
        green = picture[12, 190]
        check(np.allclose(green, (0.75, 1, 0.75), atol=0.02), f"{renderer}: glass on white {green}")
        red = (picture[..., 0] > 0.3) & (picture[..., 1] < 0.3)
        check(abs(red.sum() / 128**2 - np.pi * 0.3**2) < 0.03, f"{renderer}: the ball's disc {red.sum() / 128**2:.3f}")
    if len(pictures) == 2:
        apart = abs(pictures["plain"] - pictures["vtk"])
        check(apart.mean() < 0.01, f"both draw the same: apart by {apart.mean():.4f} in the mean")
    else:
        print("VTK is not at hand: left out")


def check_round():
    """A ball of four tetrahedra across is drawn with a round outline."""
    mesh = irregular((1, 1, 1), (9, 9, 9))
    one = fsi.Snapshot(mesh, 0, {"alpha": filled_part(mesh, (0.52, 0.49, 0.5), 0.25)})
    body = surfaces.solid_surface(one)
    for way in ((0.4, 0.36, 1.0), (1.0, 0.2, -0.3)):
        camera = scene.Camera(np.array((0.52, 0.49, 0.5)), np.array(way), np.array((0, 1, 0)), 0.7, 0.7)
        for renderer in RENDERERS:
            drawn = render.image([scene.painted(body, (1, 0, 0, 1))], camera, 280, 280, renderer)[..., 2] < 0.6
            x, y = np.meshgrid(*2 * [np.arange(280) - 139.5])
            away, turn = np.hypot(x, y), np.floor(8 * np.arctan2(y, x)).astype(int)
            outline = np.array([away[drawn & (turn == part)].max() for part in np.unique(turn)]) / 100
            check(0.96 < outline.min() and outline.max() < 1.04,
                  f"{renderer}: outline of a ball from {outline.min():.3f} to {outline.max():.3f}")


def check_views(run):
    for renderer in RENDERERS:
        look = views.Look(renderer=renderer, q=-0.5, relative=True, colour="stretch", pixels=300)
        layers, camera, bars = views.build(run, run.snapshot(0), look)
        check(len(layers) == 5 and [bar.label.split()[0] for bar in bars] == ["largest", "speed"],
              f"{renderer}: wall, slice, streamlines, body and vortices, with two bars")
        body = layers[3]
        check(np.ptp(body.points[:, 0]) < 0.55, f"{renderer}: the body is in one piece")
        check(body.points[:, 2].min() > layers[1].points[:, 2].max(), f"{renderer}: all of it is before the slice")
        middle = 0.5 * (body.points.min(axis=0) + body.points.max(axis=0))
        check(np.linalg.norm((middle - camera.middle) @ camera.axes()[0]) < 0.02, "the camera follows it")
        path = style.save(views.view(run, 0, look, 2), os.path.join(folder, renderer + ".png"), 2)
        wide = Image.open(path).size[0]
        check(570 < wide < 700, f"{renderer}: twice the resolution, {wide} pixels wide")
        style.save(views.over_time(run, look), os.path.join(folder, renderer + "_body.png"))
    lines = [line for line in scene.streamlines(scene.Grid(run.snapshot(0), "u"), [[1.9, 0.5, 0.5]], 1.0)]
    check(len(lines) == 1 and abs(np.ptp(lines[0][:, 0]) - 2) < 0.05 and np.ptp(lines[0][:, 1]) < 1e-6,
          "a streamline goes on across the seam")


def check_small():
    """A small body in a wide vessel: the view is of what is near it, and lines go from end to end."""
    place, arrays = os.path.join(folder, "small"), box((4, 2, 2), (32, 16, 16))
    mesh = fsi.Mesh(*arrays)
    y, z = mesh.centres()[:, 1] - 1, mesh.centres()[:, 2] - 1
    u = np.column_stack([2 - y**2 - z**2, 0 * y, 0 * y])
    write_run(place, arrays, [0.0], lambda _: {"u": u, "alpha": ball(mesh, (2, 1, 1), 0.25)})
    run = fsi.Run(place)
    look = views.Look(renderer="plain", view="body", colour="none", pixels=200)
    camera = views.build(run, run.snapshot(0), look)[1]
    check(camera.width < 3.5, f"near a small body: {camera.width:.2f} wide")
    whole = views.build(run, run.snapshot(0), views.Look(renderer="plain", colour="none"))[1]
    check(whole.width > 4, f"all of the vessel: {whole.width:.2f} wide")
    side = views.build(run, run.snapshot(0), views.Look(renderer="plain", colour="none", camera=(1, 0, 0), normal="x"))[1]
    check(np.allclose(side.axes(), [[0, 0, -1], [0, 1, 0], [1, 0, 0]]) and side.width < 2.2,
          f"seen from where it is asked for: {side.width:.2f} wide")
    above = views.Look(camera=(0, 2, 0), normal="x", renderer="plain", pixels=200)
    check(above.eye()[1] == (0, 0, 1) and len(views.build(run, run.snapshot(0), above)[0]) == 4,
          "from above, with the slice on edge")
    views.view(run, 0, look)
    grid = scene.Grid(run.snapshot(0), "u")
    ends = [np.ptp(line[:, 0]) for line in scene.streamlines(grid, [[2, 1.02, 1.9], [2, 0.04, 1]], 12.0, 480)]
    check(len(ends) == 2 and min(ends) > 3.9, f"streamlines go from end to end: {ends}")
    beyond = np.linspace((2, 1, 1), (4.05, 1, 1), 60)
    check(3.95 < views.trimmed(beyond, grid)[-1, 0] <= 4, "what sticks out at an opening is left out")
    wall = beyond + (0, 1.02, 0)
    check(len(views.trimmed(wall, grid)) == 60, "a line along a wall stays")


def check_speck():
    """What is left of a solid in one cell has no surface, and stops no picture."""
    arrays = box((1, 1, 1), (6, 6, 6))

    def fields(time):
        alpha = ball(fsi.Mesh(*arrays), (0.5, 0.5, 0.5), 0.3) if time == 0 else (np.arange(216) == 100) * 0.6
        return {"u": np.ones((216, 3)), "alpha": alpha}
    write_run(os.path.join(folder, "speck"), arrays, [0.0, 1.0], fields)
    run, look = fsi.Run(os.path.join(folder, "speck")), views.Look(renderer="plain", pixels=200)
    check(len(surfaces.solid_surface(run.snapshot(1)).points) == 0, "a speck has no surface")
    check(len(views.build(run, run.snapshot(1), look)[0]) == 3, "a view without it is drawn")
    check(len([axes for axes in views.over_time(run, look).axes if axes.get_title(loc="left")]) == 1,
          "over time the body is drawn as long as there is one")


def check_film(run):
    path = film.film(run, folder, views.Look(renderer="plain", pixels=240, parts=("wall", "body")))
    frames = sorted(os.listdir(os.path.join(folder, "film")))
    sizes = {Image.open(os.path.join(folder, "film", name)).size for name in frames}
    check(os.path.exists(path) and frames == ["frame_0000.png", "frame_0001.png"] and len(sizes) == 1,
          f"a film of equal frames: {frames}, {sizes}")


def check_page(run):
    """doc/howto/pictures.md: the Python of the page runs, and it names every option of the command."""
    with open(os.path.join(source, "doc", "howto", "pictures.md"), encoding="utf-8") as file:
        page = file.read()
    code = re.search(r"```python\n(.*?)```", page, re.S).group(1).replace("out/torus", run.folder)
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=source)
    check(said.returncode == 0 and said.stdout.count("\n") == 4 and said.stdout.startswith("10 46.0"),
          f"the Python of the page runs: {said.stdout}{said.stderr}")
    draw = [sys.executable, os.path.join(source, "examples", "draw.py")]
    told = subprocess.run(draw + ["--help"], capture_output=True, text=True).stdout
    options = set(re.findall(r"^  (--[a-z]+)", told, re.M))
    named = set(re.findall(r"(--[a-z]+)(?![\w-])", page)) - {"--help"}
    check(len(options) > 10 and options == named, f"the page names every option: {options ^ named}")
    for wrong in (["--parts", "wal"], ["--units", "m,s"], ["--camera", "0,0,0"], ["--camera", "1,2"]):
        said = subprocess.run(draw + [run.folder, *wrong], capture_output=True, text=True)
        check(said.returncode == 2 and "error: argument" in said.stderr, f"refused: {wrong}")


def check_without_display():
    """Without a server to draw on, VTK is left alone: it would end the program."""
    code = f"import sys; sys.path.insert(0, {os.path.join(source, 'python')!r}); from fsi import render; " \
        "print(render.vtk_works())"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                          env={"PATH": folder, "DISPLAY": ":987"})
    check(said.stdout.strip() == "False", f"a display that does not answer is not taken: {said.stdout}{said.stderr}")


check_image()
check_round()
seam = run_across_a_seam()
check_views(seam)
check_small()
check_speck()
check_film(seam)
check_page(seam)
check_without_display()
sys.exit(1 if made_up.failures else 0)
