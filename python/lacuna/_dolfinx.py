# SPDX-License-Identifier: MIT
"""Meshes for dolfinx 0.5, as Debian 12 has it. They go through an .msh file, whose groups do not overlap."""
from __future__ import annotations

import os
import tempfile
from typing import Any, NamedTuple

import numpy

from ._library import Error

# By Gmsh's type: shape, degree, nodes. The last three are of cells that dolfinx does not have beside others.
_CELLS = {5: ("hexahedron", 1, 8), 12: ("hexahedron", 2, 27), 4: ("tetrahedron", 1, 4),
          6: ("wedge", 1, 6), 7: ("pyramid", 1, 5), 17: ("hexahedron of 20 nodes", 2, 20)}
_FACETS = {2: ("triangle", 1, 3), 3: ("quadrilateral", 1, 4), 10: ("quadrilateral", 2, 9),
           16: ("quadrilateral of 8 nodes", 2, 8)}


class DolfinxMesh(NamedTuple):
    """What `to_dolfinx()` returns: `mesh, cell_tags, facet_tags, physical_groups`."""

    mesh: Any  # dolfinx.mesh.Mesh
    cell_tags: Any  # its MeshTags of cells: the group of each
    facet_tags: Any  # its MeshTags of facets of the skin
    physical_groups: dict[str, tuple[int, int]]  # by name: dimension and tag


def mesh_of(mesh, comm):
    """`mesh.to_dolfinx(comm)`, once dolfinx is known to be installed."""
    import ufl
    if not hasattr(ufl, "VectorElement"):
        import dolfinx
        raise ImportError(f"to_dolfinx() is made for dolfinx 0.5, found {dolfinx.__version__}; "
                          "write an .msh file, and read it by dolfinx.io.gmshio.read_from_msh")
    from mpi4py import MPI
    comm = comm or MPI.COMM_WORLD
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.msh")
        mesh._method("write", path, {"version": 2.2})
        points, blocks, groups = _read_msh(path)
    cells = [kind for kind in blocks if kind in _CELLS]
    if cells not in ([5], [12], [4]):
        remedy = "sweep without `wedges`, `fallback` and `serendipity`"
        found = [f"{len(blocks[kind][0])} of the kind {_CELLS[kind][0]}" for kind in cells]
        raise Error(f"to_dolfinx: a mesh of dolfinx has hexahedra of 8 or 27 nodes alone, or tetrahedra alone, "
                    f"found {' and '.join(found)}; {remedy}", "python.cells_of_dolfinx", found=found,
                    remedy=remedy)
    facets = [kind for kind in blocks if kind in _FACETS]
    return DolfinxMesh(*_distributed(comm, points, cells[0], facets[0], blocks), groups)


def _distributed(comm, points, cell, facet, blocks):
    """The mesh and its tags. The first process has all cells; dolfinx divides them among the processes."""
    import ufl
    from dolfinx import cpp
    from dolfinx.mesh import create_mesh, meshtags_from_entities
    shape, degree, _ = _CELLS[cell]
    nodes = {kind: blocks[kind] if comm.rank == 0 else (blocks[kind][0][:0], blocks[kind][1][:0])
             for kind in (cell, facet)}
    element = ufl.FiniteElement("Lagrange", ufl.Cell(shape, geometric_dimension=3), degree, variant="equispaced")

    def permuted(kind, name, count):
        return nodes[kind][0][:, cpp.io.perm_gmsh(cpp.mesh.to_type(name), count)]

    made = create_mesh(comm, permuted(cell, shape, _CELLS[cell][2]), points if comm.rank == 0 else points[:0],
                       ufl.Mesh(ufl.VectorElement(element)))
    tags = []
    for kind, dimension, (name, _, count) in (cell, 3, _CELLS[cell]), (facet, 2, _FACETS[facet]):
        entities, values = cpp.io.distribute_entity_data(
            getattr(made, "_mesh", made), dimension, permuted(kind, name, count), nodes[kind][1])
        made.topology.create_connectivity(dimension, 3 if dimension == 2 else 0)
        tags.append(meshtags_from_entities(made, dimension, cpp.graph.AdjacencyList_int32(entities),
                                           values.astype(numpy.int32)))
    return made, *tags


def _read_msh(path):
    """A binary .msh of version 2.2 by Lacuna: points; nodes from 0 and groups of the cells by Gmsh's type; groups
    by name."""
    with open(path, "rb") as file:
        text = file.read()

    def section(name):
        """The place behind the count of entities that a section begins with, and the count."""
        begin = text.find(b"\n$" + name + b"\n") + len(name) + 3
        end = text.index(b"\n", begin)
        return end + 1, int(text[begin:end])

    groups, blocks = {}, {}
    if b"\n$PhysicalNames\n" in text:
        at, count = section(b"PhysicalNames")
        for line in text[at:].split(b"\n", count)[:count]:
            dimension, tag, name = line.split(b" ", 2)
            groups[name.decode().strip('"')] = int(dimension), int(tag)
    at, count = section(b"Nodes")
    points = numpy.frombuffer(text, numpy.dtype([("tag", "<i4"), ("place", "<f8", 3)]), count, at)["place"]
    at, count = section(b"Elements")
    while count > 0:
        kind, here, tags = numpy.frombuffer(text, "<i4", 3, at)
        width = 1 + tags + {**_CELLS, **_FACETS}[int(kind)][2]
        rows = numpy.frombuffer(text, "<i4", here * width, at + 12).reshape(here, width)
        blocks.setdefault(int(kind), []).append(rows[:, [1, *range(1 + tags, width)]])
        at += 12 + 4 * here * width
        count -= here
    joined = {kind: numpy.concatenate(parts) for kind, parts in blocks.items()}
    return points, {kind: (rows[:, 1:].astype(numpy.int64) - 1, rows[:, 0]) for kind, rows in joined.items()}, groups
