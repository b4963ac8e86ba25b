# SPDX-License-Identifier: MIT
"""What lives in an interpreter, and how it looks to numpy, meshio, PyVista and notebooks."""
from __future__ import annotations

import os
from collections.abc import Mapping

from ._library import Error, _note, own_interpreter
from ._wire import Answer, Report, Request, Table

classes = {}  # by the name that they have in Lua
_VTK_TYPES = {("hex", 8): 12, ("hex", 20): 25, ("hex", 27): 29, ("wedge", 6): 13, ("pyramid", 5): 14,
              ("tet", 4): 10, ("quad", 4): 9, ("quad", 8): 23, ("quad", 9): 28, ("triangle", 3): 5}


class Object:
    """What lives in an interpreter: a Model, a Volume, a Mesh …"""

    __slots__ = ("_interpreter", "_number", "__weakref__")
    _at_once = True  # fields and text are looked up; False: some are worked out

    def __init__(self, *_, **__):
        raise TypeError(f"a {type(self).__name__} is made by a call, such as lacuna.load")

    def __str__(self):
        return call("text", self, at_once=self._at_once)

    def __repr__(self):
        return f"<lacuna.{type(self).__name__}: {self}>"

    def __eq__(self, other):
        if not isinstance(other, Object) or self._interpreter is not other._interpreter:
            return NotImplemented
        return self._number == other._number or call("equal", self, other, at_once=True)

    def __hash__(self):
        return hash((id(self._interpreter), self._number))

    def __copy__(self):
        return self  # a second one would be the same object in the library

    def __reduce__(self):
        raise TypeError(f"a {type(self).__name__} lives in the library and is neither pickled nor copied; "
                        "write it to a file, and load that")

    def _method(self, name, *arguments):
        return call("method", self, name, *arguments)

    def _field(self, name):
        return call("field", self, name, at_once=self._at_once)

    def _array(self, name, *arguments):
        """A view of a Buffer, which stays as long as the view."""
        numpy = _module("numpy", "python3-numpy")
        memory = _Memory(self._method(name, *arguments))
        found = memory.__array_interface__
        if 0 in found["shape"]:  # nothing to view
            return numpy.empty(found["shape"], found["typestr"])
        return numpy.asarray(memory)


class AnyFace(Object):
    """Equal to other objects of the same face, and counted with them in sets."""

    __slots__ = ()

    def __hash__(self):
        return hash((id(self._interpreter), self._field("tag")))

    __eq__ = Object.__eq__


class Buffer(Object):
    __slots__ = ()


classes["Buffer"] = Buffer


class _Memory:
    def __init__(self, buffer):
        found = buffer._interpreter.buffer(buffer._number)
        self._buffer = buffer
        self.__array_interface__ = {
            "version": 3, "data": (found.data or 0, True), "shape": (found.rows, found.columns),
            "typestr": "<f8" if found.type == 0 else "<i4"}


def _module(name, package):
    try:
        return __import__(name)
    except ModuleNotFoundError as error:
        if error.name != name:  # it lacks another one
            raise
        raise ImportError(f"{name} is not installed: pip install {name}, or apt install {package}") from None


def call(*values, at_once=False):
    """Make a call of bridge.lua: what it returns, a tuple where that is several values.

    at_once: it looks something up, which nobody has to be able to stop
    """
    request = Request(Object)
    data = request.bytes(values)
    interpreter = request.interpreter or own_interpreter()

    def make(name, number):
        made = object.__new__(classes[name])
        interpreter.stand(made, number)
        return made

    def read(data):
        answer = Answer(data, make)
        return answer.take(1) == b"k", [answer.value() for _ in range(answer.whole())]

    done, results = interpreter.call(data, request.callables, read, at_once)
    if done:
        return None if not results else results[0] if len(results) == 1 else tuple(results)
    error, = results
    if not isinstance(error, Table):
        raise Error(str(error), "lua.error")
    raise Error(error["message"], error["code"], error["entities"], error["found"], error["needed"],
                error.get("remedy"), error["attempts"])


def loaded(path, options):
    """lacuna.load: meshes of meshio and PyVista go through a file, with groups where meshio has Gmsh's."""
    if hasattr(path, "cells_dict"):
        if path.cell_sets and "gmsh:physical" not in path.cell_data:
            _note("note: load: sets of cells are not read from a meshio.Mesh; of groups it takes those in "
                  "cell_data['gmsh:physical']")
        ending = ".msh" if "gmsh:physical" in path.cell_data else ".vtu"

        def write(file):
            path.write(file, file_format="gmsh22" if ending == ".msh" else None)
    elif hasattr(path, "cast_to_unstructured_grid"):
        ending, write = ".vtu", path.cast_to_unstructured_grid().save
    else:
        return call("module", "load", path, options)
    import tempfile
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "mesh" + ending)
        write(file)
        return call("module", "load", file, options)


def options_of(options, keywords, **given):
    """One table of options, None where there are none. `class_` and `with_` are `class` and `with` in Lua."""
    if options is not None and not isinstance(options, Mapping):
        raise TypeError(f"options are keywords, or a dict before them; found {options!r}")
    merged = dict(options or {})
    merged.update({name[:-1] if name.endswith("_") else name: value for name, value in keywords.items()})
    merged.update(given)
    return merged or None


def shaped(value, shape):
    """Give tables the class that they have in the reference, and make those that go by number dicts."""
    if value is None or shape is None:
        return value
    kind, of = shape
    if kind == "list":
        return [shaped(item, of) for item in value]
    if kind == "rows":
        return {row["name"]: shaped(row, of) for key, row in value.items() if isinstance(key, int)}
    if kind == "map":
        items = enumerate(value, 1) if isinstance(value, list) else value.items()
        return {key: shaped(item, of) for key, item in items}
    if not isinstance(value, Table):
        return value
    record = classes[of]
    made = record(value)
    for name in record._optional:
        made.setdefault(name)
    for name, inner in record._shapes.items():
        if name in made:  # None stays
            made[name] = shaped(made[name], inner)
    return made


# --- pictures and pages -------------------------------------------------------------------------------------


class Shown(Object):
    """What has pictures and pages: a notebook shows the page, or the picture where it runs no script."""

    __slots__ = ()

    def _made_file(self, method, ending):
        import tempfile
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "shown" + ending)
            self._method(method, path)
            with open(path, "rb") as file:
                return file.read()

    def _repr_png_(self):
        return self._made_file("picture", ".png")

    def _repr_html_(self):
        import html
        page = html.escape(self._made_file("view", ".html").decode())
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 600px; border: 0"></iframe>'


class AnyMesh(Shown):
    """What Mesh, AssemblyMesh and QuadMesh share beyond Lua."""

    __slots__ = ()

    def _blocks(self):
        """VTK's type, and the nodes of all cells from 0, of every kind of cell that occurs."""
        if isinstance(self, classes["QuadMesh"]):
            counts = {"quad": self.quads, "triangle": self.triangles}
        else:
            counts = {"hex": self.hexes, "wedge": self.wedges, "pyramid": self.pyramids, "tet": self.tets}
        for kind in counts:
            if counts[kind]:
                cells = self._array("cells", kind)
                yield _VTK_TYPES[kind, cells.shape[1]], cells - 1

    def _write_bare(self, path):
        """Nodes, cells and groups alone: an assembly's mesh has no option for quality."""
        self._method("write", path, {"quality": False} if isinstance(self, classes["Mesh"]) else None)

    def to_meshio(self):
        """A meshio.Mesh: nodes, cells, and the groups of faces and volumes as `cell_sets`, as meshio has them
        of an .msh file. Node 1 of Lacuna is node 0 of meshio."""
        import tempfile
        meshio = _module("meshio", "python3-meshio")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mesh.msh")
            self._write_bare(path)
            return meshio.read(path)

    def to_pyvista(self):
        """A pyvista.UnstructuredGrid of the nodes and cells; node 1 of Lacuna is point 0."""
        pyvista = _module("pyvista", "python3-pyvista")
        numpy = _module("numpy", "python3-numpy")
        cells, types = [], []
        for vtk_type, block in self._blocks():
            counts = numpy.full((len(block), 1), block.shape[1])
            cells.append(numpy.hstack([counts, block]).ravel())
            types.append(numpy.full(len(block), vtk_type, dtype=numpy.uint8))
        return pyvista.UnstructuredGrid(numpy.concatenate(cells), numpy.concatenate(types),
                                        numpy.array(self._array("coordinates")))
