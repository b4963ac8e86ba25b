# SPDX-License-Identifier: MIT
"""What lives in an interpreter, and how it looks to numpy, meshio, PyVista and notebooks."""
from __future__ import annotations

import os
from collections.abc import Mapping

from ._library import Error, _note, own_interpreter
from ._wire import HANDED_OVER, Answer, Report, Request, Table, without_folder

classes = {}  # by the name that they have in Lua
_VTK_WEDGE = [0, 2, 1, 3, 5, 4]  # VTK has the triangles of a wedge the other way round
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
        shape = (found.rows,) if found.columns == 1 else (found.rows, found.columns)
        self.__array_interface__ = {
            "version": 3, "data": (found.data or 0, True), "shape": shape,
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
    """lacuna.load: meshes of meshio and PyVista go through a file, those of meshio with their sets of cells."""
    if hasattr(path, "cast_to_unstructured_grid"):
        grid = path.cast_to_unstructured_grid()
        for name in ("gmsh:physical", "entity"):  # of files that were read by PyVista
            if name in grid.cell_data:
                _note(f"note: load: the groups in {name!r} of a grid of PyVista are left out; lacuna.load of an .msh "
                      "file reads them")
        kind, ending, write = "PyVista", ".vtu", grid.save
    elif hasattr(path, "cell_sets"):
        if path.point_sets:
            _note("note: load: the point sets of a meshio.Mesh are left out; sets of cells are read, and "
                  "lacuna.load of its file reads all")
        grouped = _with_groups(path)
        kind, ending = "meshio", ".vtu" if grouped is path else ".msh"

        def write(file):
            grouped.write(file, file_format=None if grouped is path else "gmsh22")
    else:
        return call("module", "load", path, options)
    import tempfile
    with tempfile.TemporaryDirectory(prefix=HANDED_OVER) as folder:
        file = os.path.join(folder, f"the {kind} mesh{ending}")  # so messages name it
        write(file)
        return call("module", "load", file, options)


def _with_groups(mesh):
    """A meshio.Mesh for .msh of version 2.2, where a cell stands once for each group that it is in: those of
    `cell_sets`, and of `cell_data["gmsh:physical"]` where no set has their name. The mesh itself if it has
    neither."""
    numpy = _module("numpy", "python3-numpy")
    named = {(int(tag), int(dim)): name for name, (tag, dim) in mesh.field_data.items()}
    sets = {name: blocks for name, blocks in mesh.cell_sets.items() if not name.startswith("gmsh:")}
    physical = mesh.cell_data.get("gmsh:physical")
    if not sets and physical is None:
        return mesh
    cells, groups, entities, tags = [], [], [], {}
    for number, block in enumerate(mesh.cells):
        entity = mesh.cell_data.get("gmsh:geometrical", [numpy.ones(len(each), int) for each in mesh.cells])[number]
        members = {name: blocks[number] for name, blocks in sets.items()}
        for tag in numpy.unique(physical[number]) if physical is not None else ():
            members.setdefault(named.get((int(tag), block.dim), f"physical_{tag}"),
                               numpy.flatnonzero(physical[number] == tag) if tag else None)
        alone = numpy.ones(len(block), bool)
        for name, chosen in members.items():
            if chosen is not None and len(chosen):
                tag = tags.setdefault((name, block.dim), len(tags) + 1)
                cells.append((block.type, block.data[chosen]))
                groups.append(numpy.full(len(chosen), tag))
                entities.append(entity[chosen])
                alone[chosen] = False
        if alone.any():
            cells.append((block.type, block.data[alone]))
            groups.append(numpy.zeros(alone.sum(), int))
            entities.append(entity[alone])
    solid = {name for name, dim in tags if dim == 3}
    names = {name if dim == 3 or name not in solid else name + ":faces": numpy.array([tag, dim])
             for (name, dim), tag in tags.items()}  # meshio has one name for one dimension
    return type(mesh)(mesh.points, cells, field_data=names,
                      cell_data={"gmsh:physical": groups, "gmsh:geometrical": entities})


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
        page = html.escape(without_folder(self._made_file("view", ".html").decode()))
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 600px; border: 0"></iframe>'


class AnyMesh(Shown):
    """What Mesh, AssemblyMesh and QuadMesh share beyond Lua."""

    __slots__ = ()

    def _blocks(self):
        """Of every kind of cell that occurs: its word, VTK's type, and the nodes of all cells from 0, as VTK
        has them."""
        if isinstance(self, classes["QuadMesh"]):
            counts = {"quad": self.quads, "triangle": self.triangles}
        else:
            counts = {"hex": self.hexes, "wedge": self.wedges, "pyramid": self.pyramids, "tet": self.tets}
        for kind in counts:
            if counts[kind]:
                cells = self._array("cells", kind)
                yield kind, _VTK_TYPES[kind, cells.shape[1]], \
                    (cells[:, _VTK_WEDGE] if kind == "wedge" else cells) - 1

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
            made = meshio.read(path)
            made.cell_sets.pop("gmsh:bounding_entities", None)  # which surfaces bound a volume: no set of cells
            # meshio reads them without a sign, and its writer of .inp makes `1.0` of such numbers.
            made.cell_sets = {name: [cells if cells is None else cells.astype("int64") for cells in blocks]
                              for name, blocks in made.cell_sets.items()}
            return made

    def to_pyvista(self):
        """A pyvista.UnstructuredGrid of the nodes and cells, with `cell_data["scaled_jacobian"]`; node 1 of
        Lacuna is point 0."""
        pyvista = _module("pyvista", "python3-pyvista")
        numpy = _module("numpy", "python3-numpy")
        cells, types, values = [], [], []
        for kind, vtk_type, block in self._blocks():
            counts = numpy.full((len(block), 1), block.shape[1])
            cells.append(numpy.hstack([counts, block]).ravel())
            types.append(numpy.full(len(block), vtk_type, dtype=numpy.uint8))
            values.append(self._array("field", "scaled_jacobian", kind))
        grid = pyvista.UnstructuredGrid(numpy.concatenate(cells), numpy.concatenate(types),
                                        numpy.array(self._array("coordinates")))
        grid.cell_data["scaled_jacobian"] = numpy.concatenate(values)
        return grid

    def to_dolfinx(self, comm=None):
        """A DolfinxMesh: `mesh, cell_tags, facet_tags, physical_groups`, as dolfinx reads them of an .msh file.

        comm: an MPI communicator; default MPI.COMM_WORLD. Each of its processes has to make the mesh and this
            call; the cells are divided among them.

        dolfinx has one kind of cell in a mesh: hexahedra of 8 or 27 nodes, or tetrahedra. Others are an error.
        """
        _module("dolfinx", "python3-dolfinx")
        from . import _dolfinx
        return _dolfinx.mesh_of(self, comm)
