"""Reads the runs of libfsi and draws them; doc/howto/pictures.md shows how."""
from .cuts import best_normal, cut, cuts_through_solid
from .mirror import Mirrored
from .runs import Mesh, Run, Snapshot, differences, options, series, table
from .surfaces import Surface, isosurface, outside, solid_surface, wall

__all__ = ["Mesh", "Mirrored", "Run", "Snapshot", "Surface", "best_normal", "cut", "cuts_through_solid", "differences",
           "isosurface", "options", "outside", "series", "solid_surface", "table", "wall"]
