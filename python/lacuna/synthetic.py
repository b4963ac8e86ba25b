# SPDX-License-Identifier: MIT
# Made by python/generate.py from lua/lacuna.d.lua.
"""Open volumes of any class and size, for trials: models whose faces have names."""
from ._objects import call, options_of


def prism(options=None, /, **keywords):
    """A prism over a regular polygon, with regularly arranged holes; it can be twisted, tapered and bent.

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
    """A bent pipe. If `inner` is above 0, wall_2 is the bore.

    radius: float
    inner: float
    bend_radius: float
    angle: float
    facets: int
    drop: str | list[str]
    """
    return call("module", "synthetic.elbow", options_of(options, keywords))


def barrel(options=None, /, **keywords):
    """A cylinder whose radius grows to radius × (1 + bulge) at half its height.

    radius: float
    height: float
    bulge: float
    facets: int
    drop: str | list[str]
    """
    return call("module", "synthetic.barrel", options_of(options, keywords))


def plate(options=None, /, **keywords):
    """A plate with rows of round holes. wall_1 to wall_4 are its sides.

    length: float
    width: float
    height: float
    holes: int
    hole_radius: float
    facets: int
    drop: str | list[str]
    """
    return call("module", "synthetic.plate", options_of(options, keywords))
