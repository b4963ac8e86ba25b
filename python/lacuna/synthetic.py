# SPDX-License-Identifier: MIT
# Made by python/generate.py from lua/lacuna.d.lua.
"""Open volumes of any class and size, for trials: models whose faces have names."""
from ._objects import call, options_of


def prism(options=None, /, **keywords):
    """A regular prism with regular holes, twisted, tapered, bent.

    sides: int
    radius: float
    height: float
    holes: int
    hole_radius: float
    twist: float
    taper: float
    bend: float
    facets: int
    drop: str | list[str]
    """
    return call("module", "synthetic.prism", options_of(options, keywords))


def annulus(options=None, /, **keywords):
    """A ring; wall_1 is the outer cylinder, wall_2 the inner one.

    inner: float
    outer: float
    height: float
    facets: int
    drop: str | list[str]
    """
    return call("module", "synthetic.annulus", options_of(options, keywords))


def elbow(options=None, /, **keywords):
    """A bent pipe; wall_2 is the bore, where `inner` is above 0.

    radius: float
    inner: float
    bend_radius: float
    angle: float
    facets: int
    drop: str | list[str]
    """
    return call("module", "synthetic.elbow", options_of(options, keywords))


def barrel(options=None, /, **keywords):
    """A cylinder that bulges to radius (1 + bulge) half way up.

    radius: float
    height: float
    bulge: float
    facets: int
    drop: str | list[str]
    """
    return call("module", "synthetic.barrel", options_of(options, keywords))


def plate(options=None, /, **keywords):
    """A plate with round holes in rows; walls 1 to 4 are its sides.

    length: float
    width: float
    height: float
    holes: int
    hole_radius: float
    facets: int
    drop: str | list[str]
    """
    return call("module", "synthetic.plate", options_of(options, keywords))
