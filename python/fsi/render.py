"""A picture of layers: by VTK where it is at hand, else by numpy.

VTK draws off screen. Debian's needs an X server for it: Xvfb is started where it is installed, else a
display that answers is taken.
"""
import atexit
import ctypes
import ctypes.util
import importlib.util
import os
import shutil
import subprocess

import numpy as np

# Lamps: place (to the right, upwards, towards the eye) and brightness.
LAMPS = ((np.array([-0.35, 0.45, 0.82]), 1.0), (np.array([0.75, -0.55, 0.37]), 0.45))
AMBIENT, DIFFUSE, SPECULAR, POWER = 0.38, 0.58, 0.12, 25


def image(layers, camera, width, height, renderer="auto"):
    """The picture as an array [height, width, 3] of numbers from 0 to 1, on white.

    renderer: vtk, plain (numpy alone) or auto: vtk where it is at hand.
    """
    layers = [layer for layer in layers if len(layer.triangles)]
    if renderer == "auto":
        renderer = "vtk" if vtk_works() else "plain"
    if renderer == "vtk" and not vtk_works():
        raise RuntimeError("VTK cannot draw here: it needs the packages python3-vtk9 and xvfb")
    draw = {"vtk": _by_vtk, "plain": _by_numpy}[renderer]
    twice = draw(layers, camera, 2 * width, 2 * height)  # smooth edges: four samples a pixel
    return twice.reshape(height, 2, width, 2, 3).mean(axis=(1, 3))


def vtk_works():
    """Whether VTK is installed and has somewhere to draw."""
    return importlib.util.find_spec("vtkmodules") is not None and _display()


def _display():
    """Sees to an X server; whether there is one. VTK would end the program without."""
    if not hasattr(_display, "there"):
        _display.there = _xvfb() or _answers()
    return _display.there


def _xvfb():
    program = shutil.which("Xvfb")
    if program is None:
        return False
    read, write = os.pipe()
    server = subprocess.Popen([program, "-displayfd", str(write), "-screen", "0", "64x64x24", "-nolisten",
                               "tcp", "-noreset"], pass_fds=[write], stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    atexit.register(server.wait)
    atexit.register(server.terminate)
    os.close(write)
    with os.fdopen(read) as answer:  # ends without a number where the server does
        number = answer.readline().strip()
    if number:
        os.environ["DISPLAY"] = ":" + number
    return bool(number)


def _answers():
    name = ctypes.util.find_library("X11")
    if name is None or not os.environ.get("DISPLAY"):
        return False
    library = ctypes.CDLL(name)
    library.XOpenDisplay.restype = ctypes.c_void_p
    display = library.XOpenDisplay(None)
    if display:
        library.XCloseDisplay(ctypes.c_void_p(display))
    return bool(display)


def _by_vtk(layers, camera, width, height):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (what draws)
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.SetUseDepthPeeling(True)
    renderer.SetMaximumNumberOfPeels(12)
    renderer.SetOcclusionRatio(0)
    for layer in layers:
        renderer.AddActor(_actor(layer))
    axes = camera.axes()
    eye = renderer.GetActiveCamera()
    eye.SetParallelProjection(True)
    eye.SetFocalPoint(*camera.middle)
    eye.SetPosition(*(camera.middle + 10 * (camera.width + camera.height) * axes[2]))
    eye.SetViewUp(*axes[1])
    eye.SetParallelScale(0.5 * max(camera.height, camera.width * height / width))
    renderer.RemoveAllLights()
    renderer.SetAutomaticLightCreation(False)
    for place, bright in LAMPS:
        lamp = vtkLight()
        lamp.SetLightTypeToCameraLight()
        lamp.SetPosition(*place)
        lamp.SetFocalPoint(0, 0, 0)
        lamp.SetIntensity(bright)
        renderer.AddLight(lamp)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(True)
    window.SetSize(width, height)
    window.AddRenderer(renderer)
    window.Render()
    reader = vtkWindowToImageFilter()
    reader.SetInput(window)
    reader.ReadFrontBufferOff()
    reader.Update()
    found = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return found.reshape(height, width, -1)[::-1, :, :3] / 255


def _actor(layer):
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper
    points, triangles, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(layer.points), deep=True))
    corners = np.ascontiguousarray(layer.triangles, np.int64)
    triangles.SetData(numpy_to_vtkIdTypeArray(np.arange(0, corners.size + 1, 3, dtype=np.int64), deep=True),
                      numpy_to_vtkIdTypeArray(corners.ravel(), deep=True))
    data.SetPoints(points)
    data.SetPolys(triangles)
    data.GetPointData().SetNormals(numpy_to_vtk(np.ascontiguousarray(layer.normals), deep=True))
    colours = np.ascontiguousarray((255 * layer.colours).round().astype(np.uint8))
    data.GetPointData().SetScalars(numpy_to_vtk(colours, deep=True))
    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputData(data)
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetInterpolationToPhong()
    look.SetLighting(layer.lit)
    look.SetAmbient(AMBIENT if layer.lit else 1)
    look.SetDiffuse(DIFFUSE if layer.lit else 0)
    look.SetSpecular(SPECULAR)
    look.SetSpecularPower(POWER)
    if (layer.colours[:, 3] < 1).any():
        actor.ForceTranslucentOn()
    return actor


def _by_numpy(layers, camera, width, height):
    """Opaque layers by depth; over them the translucent ones, blended without an order."""
    colour, depth = np.ones((height * width, 3)), np.full(height * width, -np.inf)
    for layer in layers:
        if (layer.colours[:, 3] >= 1).all():
            pixel, near, shade = _fragments(layer, camera, width, height)
            ahead = near > depth[pixel]
            pixel, near, shade = pixel[ahead], near[ahead], shade[ahead]
            order = np.argsort(near, kind="stable")  # the nearest of a pixel comes last, and stays
            colour[pixel[order]], depth[pixel[order]] = shade[order, :3], near[order]
    logarithm, weight, total = np.zeros(height * width), np.zeros(height * width), np.zeros((height * width, 3))
    for layer in layers:
        if (layer.colours[:, 3] < 1).any():
            pixel, near, shade = _fragments(layer, camera, width, height)
            ahead = near > depth[pixel]
            pixel, shade = pixel[ahead], shade[ahead]
            opacity = np.clip(shade[:, 3], 0, 0.999)
            logarithm += np.bincount(pixel, np.log1p(-opacity), minlength=len(depth))
            weight += np.bincount(pixel, opacity, minlength=len(depth))
            for i in range(3):
                total[:, i] += np.bincount(pixel, opacity * shade[:, i], minlength=len(depth))
    clear = np.exp(logarithm)[:, None]
    mixed = colour * clear + (1 - clear) * total / np.maximum(weight, 1e-12)[:, None]
    return np.clip(mixed, 0, 1).reshape(height, width, 3)[::-1]


def _fragments(layer, camera, width, height):
    """(pixel, nearness, colour) of all that a layer covers; pixels count from below."""
    axes = camera.axes()
    scale = min(width / camera.width, height / camera.height)
    seen = (layer.points - camera.middle) @ axes.T
    flat = seen[:, :2] * scale + 0.5 * np.array([width, height])
    corner = flat[layer.triangles]
    first = np.maximum(np.ceil(corner.min(axis=1) - 0.5), 0).astype(int)
    last = np.minimum(np.floor(corner.max(axis=1) - 0.5), [width - 1, height - 1]).astype(int)
    sides = np.maximum(last - first + 1, 0)
    edge = corner[:, 1:] - corner[:, :1]
    double = edge[:, 0, 0] * edge[:, 1, 1] - edge[:, 0, 1] * edge[:, 1, 0]
    use = np.flatnonzero((sides.prod(axis=1) > 0) & (abs(double) > 1e-9))
    total = np.cumsum(sides[use].prod(axis=1))
    found = [_stretch_of(layer, part, corner, edge, double, first, sides, seen, width, axes) for part in
             (np.split(use, np.searchsorted(total, np.arange(2000000, total[-1], 2000000)))
              if len(use) else [])]
    if not found:
        return np.zeros(0, int), np.zeros(0), np.zeros((0, 4))
    return tuple(np.concatenate(column) for column in zip(*found))


def _stretch_of(layer, part, corner, edge, double, first, sides, seen, width, axes):
    """The fragments of some triangles of a layer."""
    counts = sides[part].prod(axis=1)
    of = np.repeat(part, counts)
    rest = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    x, y = first[of, 0] + rest % sides[of, 0], first[of, 1] + rest // sides[of, 0]
    away = np.stack([x + 0.5, y + 0.5], axis=1) - corner[of, 0]
    b = (away[:, 0] * edge[of, 1, 1] - away[:, 1] * edge[of, 1, 0]) / double[of]
    c = (away[:, 1] * edge[of, 0, 0] - away[:, 0] * edge[of, 0, 1]) / double[of]
    hit = (b >= 0) & (c >= 0) & (b + c <= 1)
    of, share = of[hit], np.stack([1 - b - c, b, c], axis=1)[hit]
    corners = layer.triangles[of]
    near = (share * seen[corners, 2]).sum(axis=1)
    shade = np.einsum("nk,nkc->nc", share, layer.colours[corners])
    if layer.lit:
        normal = np.einsum("nk,nkc->nc", share, layer.normals[corners]) @ axes.T
        normal /= np.linalg.norm(normal, axis=1, keepdims=True) + 1e-300
        normal *= np.where(normal[:, 2:] < 0, -1, 1)
        light, gloss = np.full(len(of), AMBIENT), np.zeros(len(of))
        for place, bright in LAMPS:
            lamp = place / np.linalg.norm(place)
            facing = np.maximum(normal @ lamp, 0)
            mirrored = np.maximum(2 * facing * normal[:, 2] - lamp[2], 0)
            light += bright * DIFFUSE * facing
            gloss += bright * SPECULAR * mirrored**POWER * (facing > 0)
        shade[:, :3] = shade[:, :3] * light[:, None] + gloss[:, None]
    return y[hit] * width + x[hit], near, np.clip(shade, 0, 1)
