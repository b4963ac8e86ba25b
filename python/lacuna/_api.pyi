# SPDX-License-Identifier: MIT
# Made by python/generate.py from lua/lacuna.d.lua.
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Literal, Protocol, Union

import numpy

from ._objects import AnyFace, AnyMesh, Object, Shown
from ._wire import Report, Table

class OtherMesh(Protocol):  # of meshio or PyVista
    points: Any

Path = Union[str, os.PathLike[str]]
Vector = Union[Sequence[float], numpy.ndarray]
Plane = Union[Sequence[Vector], Mapping[str, Any]]
Thickness = Union[float, Callable[[float, float, float], float]]
Class = Union[Literal["I", "II", "III", "IV", "V", "closed", "0"]]
FaceRef = Union[Face, int, str, Mapping[str, Any]]
FaceRefs = Union[FaceRef, Iterable[FaceRef]]
MetricName = Union[Literal["scaled_jacobian", "scaled_jacobian_with_centre", "jacobian", "shape", "shear", "condition", "max_aspect_frobenius", "med_aspect_frobenius", "oddy", "skew", "taper", "max_edge_ratio", "edge_ratio", "full_edge_ratio", "stretch", "diagonal", "dimension", "volume", "distortion", "relative_size_squared", "shape_and_size", "shear_and_size"]]

class Contact(Table):
    a: str
    b: str
    name: str | None
    type: Literal["tie", "contact"] | None
    gap: float | None
    faces: list[list[int]] | None
    least: float | None
    width: float | None
    area: float | None
    slave: str | None
    master: str | None
class ModelInfo(Table):
    source: str
    diagonal: float
    tolerance: float
    parts: int
    closed_parts: int
    faces: list[FaceInfo]
    free_edges: list[Table]
    gaps: list[Table]
    cavities: list[Cavity]
class FaceInfo(Table):
    tag: int
    name: str
    kind: str
    area: float
    normal: list[float]
    centroid: list[float]
    loops: int
    edges: int
    has_mesh: bool
    radius: float | None
    axis: list[float] | None
    box: list[list[float]]
    neighbours: list[int]
    fits: Literal["cylinder", "sphere", "cone"] | None
    centre: list[float] | None
    apex: list[float] | None
    half_angle: float | None
    least_radius: float | None
    largest_radius: float | None
    free_edges: int
    part: int
    cavity: int | None
    use: str
class Cavity(Table):
    kind: Literal["pocket", "bore", "slot", "inner void"]
    faces: list[int]
    class_: Class
    volume: float
class Classification(Table):
    class_: Class
    free_loops: int
    wall_free_source: list[int]
    wall_free_target: list[int]
    reasons: list[str]
class Match(Table):
    loops: list[Table]
    vertices: list[list[int]]
    method: str
    confidence: float
    notes: list[str]
class Closure(Table):
    void_edges: int
    void_faces: int
    void_edge_tags: list[int]
    void_face_tags: list[int]
    watertight: bool
    algorithms: list[str]
class FreeEdge(Table):
    tag: int
    from_: int
    to: int
    length: float
class LeftOut(Table):
    region: str
    code: str
    message: str
class Fidelity(Table):
    volume: float
    sealed_volume: float
    max_distance: float
    mean_distance: float
    faces: dict[int | str, FaceFidelity]
class FaceFidelity(Table):
    quads: int
    max_distance: float
    mean_distance: float
    place: list[float]
class AssemblyFidelity(Table):
    volume: float
    sealed_volume: float
    max_distance: float
    mean_distance: float
    regions: dict[str, Fidelity]
class WorstCell(Table):
    cell: int
    layer: int | None
    centre: list[float]
    scaled_jacobian: float
class MetricSummary(Table):
    name: MetricName
    cells: int
    min: float
    mean: float
    max: float
    deviation: float
    acceptable: list[float] | None
    outside: int
    outside_share: float
    worst: Table
class Model(Shown):
    @property
    def tolerance(self) -> float: ...
    @property
    def diagonal(self) -> float: ...
    @property
    def regions(self) -> list[str]: ...
    def faces(
            self, selector: Mapping[str, Any] | str | int | None = None, /, *,
            tags: int | Iterable[int] | None = ..., name: str | None = ...,
            kind: Literal["plane", "cylinder", "cone", "sphere", "torus", "bspline", "surface", "discrete"] | None = ...,
            facing: Vector | None = ..., normal_within: float | None = ..., near: Vector | None = ...,
            within: float | None = ..., box: Sequence[Vector] | None = ...,
            touching: Face | int | str | None = ..., region: str | None = ..., free: bool | None = ...,
            radius: Sequence[float] | None = ..., area: Sequence[float] | None = ...,
    ) -> list[Face]: ...
    def face(
            self, which: FaceRef | None = None, /, *, tags: int | Iterable[int] | None = ...,
            name: str | None = ...,
            kind: Literal["plane", "cylinder", "cone", "sphere", "torus", "bspline", "surface", "discrete"] | None = ...,
            facing: Vector | None = ..., normal_within: float | None = ..., near: Vector | None = ...,
            within: float | None = ..., box: Sequence[Vector] | None = ...,
            touching: Face | int | str | None = ..., region: str | None = ..., free: bool | None = ...,
            radius: Sequence[float] | None = ..., area: Sequence[float] | None = ...,
    ) -> Face: ...
    def face_from(
            self, near: Vector, *, angle: float | None = ..., region: str | None = ...,
            free: bool | None = ...,
    ) -> Face: ...
    def add_face(
            self, points: Iterable[Vector] | numpy.ndarray, cells: Iterable[Iterable[int]] | numpy.ndarray, *,
            name: str | None = ..., keep_mesh: bool | None = ...,
    ) -> Face: ...
    def open_volume(
            self, roles: Mapping[str, Any] | None = None, /, *, source: FaceRefs | None = ...,
            target: FaceRefs | None = ..., walls: FaceRefs | Literal["auto"] | None = ...,
            faces: FaceRefs | None = ..., reading: int | None = ..., full_turn: bool | None = ...,
            along: Mapping[str, Any] | None = ..., fill_to: Plane | None = ..., class_: Class | None = ...,
            name: str | None = ..., material: str | int | None = ..., glued: bool | None = ...,
    ) -> Volume: ...
    def quads(
            self, options: Mapping[str, Any] | None = None, /, *, faces: FaceRefs | None = ...,
            size: float | Callable[[float, float, float], float] | None = ..., curvature: int | None = ...,
            gap: int | None = ..., quads: Literal["auto", "paved", "mapped", "gmsh", "keep"] | None = ...,
            order: Literal[1, 2] | None = ..., serendipity: bool | None = ..., threads: int | None = ...,
    ) -> QuadMesh: ...
    def bodies(self) -> list[Volume]: ...
    def contacts(
            self, options: Mapping[str, Any] | None = None, /, *, gap: float | None = ...,
    ) -> list[Contact]: ...
    def describe(self) -> str: ...
    def info(self) -> ModelInfo: ...
    def cavities(self) -> list[Cavity]: ...
    def view(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, title: str | None = ...,
    ) -> None: ...
    def picture(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, width: int | None = ...,
            height: int | None = ..., facets: bool | None = ..., legend: bool | None = ...,
            title: str | None = ...,
            view: Vector | Literal["iso", "front", "back", "left", "right", "top", "bottom"] | None = ...,
    ) -> None: ...
class Face(AnyFace):
    @property
    def tag(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def kind(self) -> str: ...
    @property
    def area(self) -> float: ...
    @property
    def normal(self) -> list[float]: ...
    @property
    def centroid(self) -> list[float]: ...
    @property
    def loops(self) -> int: ...
    @property
    def edges(self) -> int: ...
    @property
    def has_mesh(self) -> bool: ...
    @property
    def radius(self) -> float | None: ...
    @property
    def axis(self) -> list[float] | None: ...
    @property
    def box(self) -> list[list[float]]: ...
    @property
    def neighbours(self) -> list[int]: ...
class Volume(Shown):
    @property
    def class_(self) -> Class: ...
    def classify(self) -> Classification: ...
    def override_class(self, class_: Class) -> Volume: ...
    def match(
            self, options: Mapping[str, Any] | None = None, /, *,
            vertices: Iterable[Sequence[int]] | numpy.ndarray | None = ...,
            loops: Iterable[Sequence[int]] | numpy.ndarray | None = ..., flip: Iterable[int] | None = ...,
            method: Literal["aligned", "nearest"] | None = ...,
    ) -> Match: ...
    def close(
            self, options: Mapping[str, Any] | None = None, /, *,
            edge_shape: Literal["auto", "straight", "follow", "smooth"] | None = ...,
            void_edges: Iterable[Sequence[int | Iterable[Vector] | numpy.ndarray]] | None = ...,
            cap: Literal["auto", "flat", "parallel"] | None = ...,
            holes: Literal["cover", "through"] | None = ...,
    ) -> Closure: ...
    def is_watertight(self) -> bool: ...
    def free_edges(self) -> list[FreeEdge]: ...
    def tree(self) -> str: ...
    def describe(self) -> str: ...
    def view(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, title: str | None = ...,
    ) -> None: ...
    def picture(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, width: int | None = ...,
            height: int | None = ..., facets: bool | None = ..., legend: bool | None = ...,
            title: str | None = ...,
            view: Vector | Literal["iso", "front", "back", "left", "right", "top", "bottom"] | None = ...,
    ) -> None: ...
    def cut(
            self, options: Mapping[str, Any] | None = None, /, *, plane: Plane | None = ...,
            face: FaceRef | None = ..., auto: bool | None = ...,
    ) -> list[Volume]: ...
    def model(self) -> Model: ...
    def sweep(
            self, options: Mapping[str, Any] | None = None, /, *,
            layers: int | Iterable[float] | Mapping[str, Any] | None = ...,
            size: float | Callable[[float, float, float], float] | None = ..., curvature: int | None = ...,
            gap: int | None = ..., max_deviation: float | None = ...,
            quads: Literal["auto", "paved", "mapped", "gmsh", "keep"] | None = ...,
            fallback: Literal["none", "wedges", "leave_out", "mixed"] | None = ..., wedges: bool | None = ...,
            rows: int | None = ..., row_height: float | Callable[[float, float, float], float] | None = ...,
            boundary_layers: Mapping[str, Any] | Iterable[Mapping[str, Any]] | None = ...,
            intervals: Iterable[Sequence[Any]] | None = ..., periodic: Iterable[Sequence[Any]] | None = ...,
            order: Literal[1, 2] | None = ..., serendipity: bool | None = ...,
            min_scaled_jacobian: float | None = ..., improve: bool | Mapping[str, Any] | None = ...,
            threads: int | None = ...,
    ) -> Mesh | AssemblyMesh: ...
    def sweep_to(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *,
            layers: int | Iterable[float] | Mapping[str, Any] | None = ...,
            size: float | Callable[[float, float, float], float] | None = ..., curvature: int | None = ...,
            gap: int | None = ..., max_deviation: float | None = ...,
            quads: Literal["auto", "paved", "mapped", "gmsh", "keep"] | None = ...,
            fallback: Literal["none", "wedges", "leave_out", "mixed"] | None = ..., wedges: bool | None = ...,
            rows: int | None = ..., row_height: float | Callable[[float, float, float], float] | None = ...,
            boundary_layers: Mapping[str, Any] | Iterable[Mapping[str, Any]] | None = ...,
            intervals: Iterable[Sequence[Any]] | None = ..., periodic: Iterable[Sequence[Any]] | None = ...,
            order: Literal[1, 2] | None = ..., serendipity: bool | None = ...,
            min_scaled_jacobian: float | None = ..., improve: bool | Mapping[str, Any] | None = ...,
            threads: int | None = ..., write: Mapping[str, Any] | None = ...,
    ) -> Report: ...
    def write_facets(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, binary: bool | None = ...,
            groups: Literal["one", "all"] | None = ...,
    ) -> None: ...
    def write_cad(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, tolerance: float | None = ...,
            deviation: float | None = ..., cad_seconds: float | None = ..., cad_megabytes: float | None = ...,
    ) -> Table: ...
class Mesh(AnyMesh):
    @property
    def left_out(self) -> list[LeftOut]: ...
    @property
    def fidelity(self) -> Fidelity: ...
    @property
    def nodes(self) -> int: ...
    @property
    def hexes(self) -> int: ...
    @property
    def wedges(self) -> int: ...
    @property
    def pyramids(self) -> int: ...
    @property
    def tets(self) -> int: ...
    @property
    def layers(self) -> int: ...
    @property
    def order(self) -> Literal[1, 2]: ...
    @property
    def regions(self) -> list[str]: ...
    @property
    def report(self) -> Report: ...
    def quality(self) -> Quality: ...
    def groups(self) -> list[Table]: ...
    def copy(
            self, options: Mapping[str, Any] | None = None, /, *, translate: Vector | None = ...,
            rotate: Sequence[Vector | float] | None = ..., mirror: Plane | None = ..., name: str | None = ...,
    ) -> Mesh: ...
    def pattern(
            self, count: int, *, translate: Vector | None = ...,
            rotate: Sequence[Vector | float] | None = ..., numbered: bool | None = ...,
    ) -> AssemblyMesh: ...
    def node(self, i: int) -> tuple[float, float, float]: ...
    def wedge(self, i: int) -> tuple[int, ...]: ...
    def hex(self, i: int) -> tuple[int, ...]: ...
    def coordinates(self) -> numpy.ndarray: ...
    def cells(self, kind: Literal["hex", "wedge", "pyramid", "tet"] | None = None) -> numpy.ndarray: ...
    def field(
            self, metric: MetricName | None = None,
            kind: Literal["hex", "wedge", "pyramid", "tet"] | None = None,
    ) -> numpy.ndarray: ...
    def write(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, version: float | None = ...,
            binary: bool | None = ..., quality: bool | MetricName | Iterable[MetricName] | None = ...,
            with_: Model | Iterable[Model] | None = ...,
            without: str | int | Iterable[str | int] | None = ..., renumber: bool | None = ...,
            first_node: int | None = ..., first_cell: int | None = ..., element: str | None = ...,
            groups: Literal["one", "all"] | None = ..., gmsh_options: bool | None = ...,
            interfaces: bool | None = ..., orientation: bool | None = ...,
            partitions: int | Literal["processes"] | None = ..., ghosts: int | None = ...,
    ) -> None: ...
    def view(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, title: str | None = ...,
    ) -> None: ...
    def picture(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, width: int | None = ...,
            height: int | None = ...,
            view: Vector | Literal["iso", "front", "back", "left", "right", "top", "bottom"] | None = ...,
            colour: Literal["quality", "layer", "groups", "region", "origin"] | None = ...,
            cut: Plane | None = ..., layers: Sequence[int] | None = ..., edges: bool | None = ...,
            legend: bool | None = ..., title: str | None = ...,
    ) -> None: ...
class Assembly(Object):
    def contacts(
            self, options: Mapping[str, Any] | None = None, /, *, gap: float | None = ...,
    ) -> list[Contact]: ...
    def sweep(
            self, options: Mapping[str, Any] | Mapping[Volume, Mapping[str, Any]] | None = None, /, *,
            layers: int | Iterable[float] | Mapping[str, Any] | None = ...,
            size: float | Callable[[float, float, float], float] | None = ..., curvature: int | None = ...,
            gap: int | None = ..., max_deviation: float | None = ...,
            quads: Literal["auto", "paved", "mapped", "gmsh", "keep"] | None = ...,
            fallback: Literal["none", "wedges", "leave_out", "mixed"] | None = ..., wedges: bool | None = ...,
            rows: int | None = ..., row_height: float | Callable[[float, float, float], float] | None = ...,
            boundary_layers: Mapping[str, Any] | Iterable[Mapping[str, Any]] | None = ...,
            intervals: Iterable[Sequence[Any]] | None = ..., periodic: Iterable[Sequence[Any]] | None = ...,
            order: Literal[1, 2] | None = ..., serendipity: bool | None = ...,
            min_scaled_jacobian: float | None = ..., improve: bool | Mapping[str, Any] | None = ...,
            threads: int | None = ..., contacts: Mapping[str, Any] | None = ...,
    ) -> AssemblyMesh: ...
    def sweep_to(
            self, path: Path, options: Mapping[str, Any] | Mapping[Volume, Mapping[str, Any]] | None = None,
            /, *, layers: int | Iterable[float] | Mapping[str, Any] | None = ...,
            size: float | Callable[[float, float, float], float] | None = ..., curvature: int | None = ...,
            gap: int | None = ..., max_deviation: float | None = ...,
            quads: Literal["auto", "paved", "mapped", "gmsh", "keep"] | None = ...,
            fallback: Literal["none", "wedges", "leave_out", "mixed"] | None = ..., wedges: bool | None = ...,
            rows: int | None = ..., row_height: float | Callable[[float, float, float], float] | None = ...,
            boundary_layers: Mapping[str, Any] | Iterable[Mapping[str, Any]] | None = ...,
            intervals: Iterable[Sequence[Any]] | None = ..., periodic: Iterable[Sequence[Any]] | None = ...,
            order: Literal[1, 2] | None = ..., serendipity: bool | None = ...,
            min_scaled_jacobian: float | None = ..., improve: bool | Mapping[str, Any] | None = ...,
            threads: int | None = ..., write: Mapping[str, Any] | None = ...,
    ) -> Report: ...
class AssemblyMesh(AnyMesh):
    @property
    def contacts(self) -> list[Contact]: ...
    @property
    def interface_cells(self) -> int: ...
    @property
    def left_out(self) -> list[LeftOut]: ...
    @property
    def fidelity(self) -> AssemblyFidelity: ...
    @property
    def nodes(self) -> int: ...
    @property
    def hexes(self) -> int: ...
    @property
    def wedges(self) -> int: ...
    @property
    def pyramids(self) -> int: ...
    @property
    def tets(self) -> int: ...
    @property
    def order(self) -> Literal[1, 2]: ...
    @property
    def layers(self) -> dict[str, int]: ...
    @property
    def regions(self) -> list[str]: ...
    @property
    def report(self) -> Report: ...
    def quality(self) -> Quality: ...
    def groups(self) -> list[Table]: ...
    def copy(
            self, options: Mapping[str, Any] | None = None, /, *, translate: Vector | None = ...,
            rotate: Sequence[Vector | float] | None = ..., mirror: Plane | None = ..., name: str | None = ...,
    ) -> AssemblyMesh: ...
    def pattern(
            self, count: int, *, translate: Vector | None = ...,
            rotate: Sequence[Vector | float] | None = ..., numbered: bool | None = ...,
    ) -> AssemblyMesh: ...
    def node(self, i: int) -> tuple[float, float, float]: ...
    def hex(self, i: int) -> tuple[int, ...]: ...
    def coordinates(self) -> numpy.ndarray: ...
    def cells(self, kind: Literal["hex", "wedge", "pyramid", "tet"] | None = None) -> numpy.ndarray: ...
    def field(
            self, metric: MetricName | None = None,
            kind: Literal["hex", "wedge", "pyramid", "tet"] | None = None,
    ) -> numpy.ndarray: ...
    def wedge(self, i: int) -> tuple[int, ...]: ...
    def pyramid(self, i: int) -> tuple[int, int, int, int, int]: ...
    def tet(self, i: int) -> tuple[int, int, int, int]: ...
    def write(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, version: float | None = ...,
            binary: bool | None = ..., with_: Model | Iterable[Model] | None = ...,
            without: str | int | Iterable[str | int] | None = ..., renumber: bool | None = ...,
            first_node: int | None = ..., first_cell: int | None = ..., element: str | None = ...,
            groups: Literal["one", "all"] | None = ..., gmsh_options: bool | None = ...,
            interfaces: bool | None = ..., orientation: bool | None = ...,
            partitions: int | Literal["processes"] | None = ..., ghosts: int | None = ...,
    ) -> None: ...
    def view(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, title: str | None = ...,
    ) -> None: ...
    def picture(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, width: int | None = ...,
            height: int | None = ...,
            view: Vector | Literal["iso", "front", "back", "left", "right", "top", "bottom"] | None = ...,
            colour: Literal["quality", "layer", "groups", "region", "origin"] | None = ...,
            cut: Plane | None = ..., layers: Sequence[int] | None = ..., edges: bool | None = ...,
            legend: bool | None = ..., title: str | None = ...,
    ) -> None: ...
class QuadMesh(AnyMesh):
    @property
    def nodes(self) -> int: ...
    @property
    def quads(self) -> int: ...
    @property
    def triangles(self) -> int: ...
    @property
    def hexes(self) -> int: ...
    @property
    def layers(self) -> int: ...
    @property
    def order(self) -> Literal[1, 2]: ...
    @property
    def regions(self) -> list[str]: ...
    @property
    def report(self) -> Report: ...
    def quality(self) -> Table: ...
    def groups(self) -> list[Table]: ...
    def node(self, i: int) -> tuple[float, float, float]: ...
    def quad(self, i: int) -> tuple[int, ...]: ...
    def model(self) -> Model: ...
    def coordinates(self) -> numpy.ndarray: ...
    def cells(self, kind: Literal["quad", "triangle"] | None = None) -> numpy.ndarray: ...
    def write(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, version: float | None = ...,
            binary: bool | None = ..., groups: Literal["one", "all"] | None = ...,
            gmsh_options: bool | None = ...,
    ) -> None: ...
    def view(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, title: str | None = ...,
    ) -> None: ...
    def picture(
            self, path: Path, options: Mapping[str, Any] | None = None, /, *, width: int | None = ...,
            height: int | None = ..., facets: bool | None = ..., legend: bool | None = ...,
            title: str | None = ...,
            view: Vector | Literal["iso", "front", "back", "left", "right", "top", "bottom"] | None = ...,
    ) -> None: ...
class Quality(Object):
    @property
    def hexes(self) -> int: ...
    @property
    def wedges(self) -> int: ...
    @property
    def pyramids(self) -> int: ...
    @property
    def tets(self) -> int: ...
    @property
    def least(self) -> Table: ...
    @property
    def min_scaled_jacobian(self) -> float: ...
    @property
    def mean_scaled_jacobian(self) -> float: ...
    @property
    def inverted(self) -> int: ...
    @property
    def uncertified(self) -> int: ...
    @property
    def certified(self) -> bool: ...
    @property
    def worst(self) -> list[WorstCell]: ...
    @property
    def histogram(self) -> list[int]: ...
    @property
    def metrics(self) -> dict[MetricName, MetricSummary]: ...
    @property
    def volume(self) -> float: ...
def load(
        path: Path | Iterable[Path] | OtherMesh, options: Mapping[str, Any] | None = None, /, *,
        tolerance: float | None = ..., feature_angle: float | None = ..., keep_mesh: bool | None = ...,
        keep_noise: bool | None = ..., scale: float | None = ...,
        unit: Literal["um", "mm", "cm", "m", "in", "ft"] | None = ..., cad_seconds: float | None = ...,
        cad_megabytes: float | None = ..., without: str | int | Iterable[str | int] | None = ...,
) -> Model: ...
def model(options: Mapping[str, Any] | None = None, /, *, tolerance: float | None = ...) -> Model: ...
def assembly(volumes: Iterable[Volume | Mesh | AssemblyMesh]) -> Assembly: ...
def split_interface(
        mesh: Mesh | AssemblyMesh, faces: str | int | Iterable[str | int | Iterable[str]], *,
        element: str | None = ..., name: str | None = ...,
) -> AssemblyMesh: ...
def check(path: Path) -> Quality: ...
def convert(
        from_: Path, to: Path, options: Mapping[str, Any] | None = None, /, *, version: float | None = ...,
        binary: bool | None = ..., groups: Literal["one", "all"] | None = ...,
) -> Table: ...
def view(
        file: Path, path: Path, options: Mapping[str, Any] | None = None, /, *, title: str | None = ...,
        show: Literal["auto", "faces", "cells"] | None = ...,
) -> Literal["cells", "faces"]: ...
def picture(
        file: Path, path: Path, options: Mapping[str, Any] | None = None, /, *, width: int | None = ...,
        height: int | None = ...,
        view: Vector | Literal["iso", "front", "back", "left", "right", "top", "bottom"] | None = ...,
        colour: Literal["quality", "layer", "groups", "region", "origin"] | None = ...,
        cut: Plane | None = ..., layers: Sequence[int] | None = ..., edges: bool | None = ...,
        legend: bool | None = ..., title: str | None = ..., facets: bool | None = ...,
        show: Literal["auto", "faces", "cells"] | None = ...,
) -> Literal["cells", "faces"]: ...
