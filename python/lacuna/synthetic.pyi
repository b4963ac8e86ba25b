# SPDX-License-Identifier: MIT
# Made by python/generate.py from lua/lacuna.d.lua.
from collections.abc import Iterable, Mapping
from typing import Any, Union

from ._api import Model

Drop = Union[str, Iterable[str]]

def prism(
        options: Mapping[str, Any] | None = None, /, *, sides: int | None = ..., radius: float | None = ...,
        height: float | None = ..., holes: int | None = ..., hole_radius: float | None = ...,
        twist: float | None = ..., taper: float | None = ..., bend: float | None = ...,
        facets: int | None = ..., drop: Drop | None = ...,
) -> Model: ...
def annulus(
        options: Mapping[str, Any] | None = None, /, *, inner: float | None = ..., outer: float | None = ...,
        height: float | None = ..., facets: int | None = ..., drop: Drop | None = ...,
) -> Model: ...
def elbow(
        options: Mapping[str, Any] | None = None, /, *, radius: float | None = ..., inner: float | None = ...,
        bend_radius: float | None = ..., angle: float | None = ..., facets: int | None = ...,
        drop: Drop | None = ...,
) -> Model: ...
def barrel(
        options: Mapping[str, Any] | None = None, /, *, radius: float | None = ...,
        height: float | None = ..., bulge: float | None = ..., facets: int | None = ...,
        drop: Drop | None = ...,
) -> Model: ...
def plate(
        options: Mapping[str, Any] | None = None, /, *, length: float | None = ..., width: float | None = ...,
        height: float | None = ..., holes: int | None = ..., hole_radius: float | None = ...,
        facets: int | None = ..., drop: Drop | None = ...,
) -> Model: ...
