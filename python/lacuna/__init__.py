# SPDX-License-Identifier: MIT
"""Lacuna fills open volumes with hexahedra.

    import lacuna

    part = lacuna.load("bracket.step")
    void = part.open_volume(source=12, target=31, walls=[4, 5, 6])
    mesh = void.sweep(layers=12, size=2.0)
    mesh.write("bracket.msh")

Nodes, cells and loops are numbered from 1. A face's tag is the number that Gmsh shows for the same file.
"""
from . import synthetic
from ._api import *  # noqa: F403
from ._api import __all__ as _names
from ._library import VERSION as version
from ._library import Error, progress
from ._wire import Report, Table

gmsh_version: str  # see __getattr__
__version__ = version
__all__ = [*_names, "Error", "Report", "Table", "progress", "synthetic", "version"]


def __getattr__(name):
    if name == "gmsh_version":  # asked of the CAD process when somebody wants to know
        from ._objects import call
        return call("module", name)
    raise AttributeError(f"module 'lacuna' has no attribute '{name}'")
