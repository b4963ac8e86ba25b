#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What others read from a deck and its void's mesh written as one: Gmsh, meshio, VTK, each where it is installed.

usage: read_joined.py LACUNA    Exit 77 where none is.

All formats must hold the same nodes and cells at the same places with the same numbers, and the groups.
"""
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
    import readers
except ImportError as error:
    print(f"left out: {error}")
    sys.exit(77)

N = 6
RECIPE = """
local lacuna = require "lacuna"
local model = lacuna.load "part.bdf"
local box = { { 1.9, 1.9, 1.9 }, { 4.1, 4.1, 6.1 } }
local mesh = model:open_volume { name = "soft foam",
  source = { box = { { 1.9, 1.9, 1.9 }, { 4.1, 4.1, 2.1 } } },
  walls = { { box = { { 1.9, 1.9, 1.9 }, { 2.1, 4.1, 6.1 } } }, { box = { { 3.9, 1.9, 1.9 }, { 4.1, 4.1, 6.1 } } },
            { box = { { 1.9, 1.9, 1.9 }, { 4.1, 2.1, 6.1 } } }, { box = { { 1.9, 3.9, 1.9 }, { 4.1, 4.1, 6.1 } } } },
}:sweep { layers = 4 }
for _, path in ipairs { "j.msh", "j.vtu", "j.vtk", "j.unv", "j.bdf", "j.exo" } do mesh:write(path, { with = model }) end
mesh:write("text.msh", { with = model, binary = false })
mesh:write("text.vtk", { with = model, binary = false })
mesh:write("old.msh", { with = model, version = 2.2 })
mesh:write("oldtext.msh", { with = model, version = 2.2, binary = false })
mesh:write("numbered.vtu", { with = model, first_node = 50001, first_cell = 60001 })
mesh:write "alone.vtu"
mesh:write "alone.vtk"
mesh:write "alone.e"
mesh:write("alonetext.vtk", { binary = false })
for _, path in ipairs { "j.msh", "j.vtu", "j.vtk", "text.msh", "text.vtk", "old.msh", "oldtext.msh" } do
  assert(lacuna.check(path).hexes == 216, path)
end
"""


def node(i, j, k):
    return 100 + i + (N + 1) * (j + (N + 1) * k)


def deck():
    """A block with a pit of 2 by 2 by 4 cells open above; two properties, numbers with holes."""
    lines, cells = ["BEGIN BULK"], {}
    for k in range(N):
        for j in range(N):
            for i in range(N):
                if 2 <= i < 4 and 2 <= j < 4 and k >= 2:
                    continue
                corners = [node(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                cells[1000 + 3 * len(cells)] = (7 if k < 2 else 8, corners)
    used = sorted({n for _, corners in cells.values() for n in corners})
    for n in used:
        m = n - 100
        lines.append(f"GRID,{n},,{m % (N + 1)}.,{m // (N + 1) % (N + 1)}.,{m // (N + 1) ** 2}.")
    for tag, (pid, corners) in cells.items():
        lines.append(f"CHEXA,{tag},{pid},{','.join(map(str, corners[:6]))}\n,{corners[6]},{corners[7]}")
    lines += ["PSOLID,7,1", "PSOLID,8,1", "MAT1,1,2.1+5,,.3", "ENDDATA"]
    return "\n".join(lines) + "\n", cells


def places(points, cells):
    """Cells as sorted lists of corners' coordinates."""
    return sorted(tuple(sorted(map(tuple, np.round(points[c], 9)))) for c in cells)


def read_meshio(path):
    import meshio
    mesh = meshio.read(path)
    hexes = np.vstack([block.data for block in mesh.cells if block.type == "hexahedron"])
    found = {"hexes": places(mesh.points, hexes)}
    if path.suffix == ".vtu" or path.suffix == ".vtk":
        table = {name: list(np.atleast_1d(value)) for name, value in mesh.field_data.items()}
        data = {name: np.concatenate(parts) for name, parts in mesh.cell_data.items()}
        if table:
            size = len(data["entity"])
            found["groups"] = {name: int(np.isin(data["entity"], value).sum()) for name, value in table.items()}
            assert sum(len(block.data) for block in mesh.cells) == size
        if "cell_number" in data:
            kinds = np.concatenate([[block.type] * len(block.data) for block in mesh.cells])
            found["cells"] = dict(zip(map(int, data["cell_number"][kinds == "hexahedron"]), map(tuple, hexes)))
            found["nodes"] = mesh.point_data["node_number"].astype(int).ravel()
            found["regions"] = data["region"][kinds == "hexahedron"]
    return found


def read_exodus(path):
    """By the names that the format agrees on; meshio reads the same blocks."""
    import netCDF4
    import meshio
    with netCDF4.Dataset(path) as file:
        text = lambda name: [b"".join(row).split(b"\0")[0].decode() for row in file.variables[name][:].filled(b"\0")]
        points = np.column_stack([file.variables["coord" + axis][:] for axis in "xyz"])
        numbers = file.variables["elem_num_map"][:]
        hexes, tags, groups, kinds, at = [], [], {}, [], 0
        for b, name in enumerate(text("eb_names"), 1):
            block = file.variables[f"connect{b}"]
            if block.elem_type == "HEX8":
                hexes.append(block[:] - 1)
                tags += list(numbers[at:at + len(block)])
                groups[name] = len(block)
            kinds += [block.elem_type] * len(block)
            at += len(block)
        hexes = np.vstack(hexes)
        corner = np.vstack([file.variables[f"connect{b}"][:] - 1 for b in range(1, len(text("eb_names")) + 1)])
        sides = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (0, 4, 7, 3), (0, 3, 2, 1), (4, 5, 6, 7)]
        on_rim = lambda p: any(np.ptp(p[:, axis]) < 1e-12 for axis in range(3))
        for s, name in enumerate(text("ss_names"), 1):
            elements, side = file.variables[f"elem_ss{s}"][:], file.variables[f"side_ss{s}"][:]
            groups[name] = max(groups.get(name, 0), len(elements))  # a face may be called as a block is
            used = {tuple(np.round(points[n], 9)) for e, k in zip(elements, side) for n in corner[e - 1][list(sides[k - 1])]}
            n = text("ns_names").index(name) + 1
            assert used == {tuple(np.round(points[i - 1], 9)) for i in file.variables[f"node_ns{n}"][:]}, name
            assert all(on_rim(points[corner[e - 1][list(sides[k - 1])]]) for e, k in zip(elements, side)), name
        nodes = file.variables["node_num_map"][:]
    mesh = meshio.read(path, "exodus")
    assert sum(len(block.data) for block in mesh.cells if block.type == "hexahedron") == len(hexes)
    assert np.array_equal(mesh.points, points)
    return {"hexes": places(points, hexes), "cells": dict(zip(map(int, tags), map(tuple, hexes))), "nodes": nodes,
            "groups": groups}


def seen(mesh):
    """What is checked of a mesh of the shared readers."""
    hexes = mesh.cells["hexahedron"]
    found = {"hexes": places(mesh.points, hexes)}
    if "hexahedron" in mesh.numbers:
        found["cells"] = dict(zip(map(int, mesh.numbers["hexahedron"]), map(tuple, hexes)))
        found["nodes"] = mesh.node_numbers
    if "hexahedron" in mesh.regions:
        found["regions"] = mesh.regions["hexahedron"]
    return found


def read_gmsh(path):
    mesh = readers.read_gmsh(path)
    return seen(mesh) | ({"groups": mesh.groups} if path.suffix == ".msh" else {})


def read_vtk(path):
    mesh = readers.read_vtk(path)
    return seen(mesh) | {"groups": mesh.groups}


def check(found, path, kept, walls):
    """The whole block, its kept cells by their numbers, the groups by their counts."""
    alone = path.name.startswith("alone.") or path.name == "alonetext.vtk"
    assert len(found["hexes"]) == len(set(found["hexes"])) == (16 if alone else N ** 3), path
    corners = {p for cell in found["hexes"] for p in cell}
    if not alone:
        assert len(corners) == (N + 1) ** 3, (path, len(corners))
    if "cells" in found and not alone:
        numbers = found["nodes"]
        for tag, (_, nodes) in kept.items():
            assert [int(numbers[n]) for n in found["cells"][tag]] == nodes, (path, tag)
    if path.name == "numbered.vtu":
        assert max(found["cells"]) == 60016 + 0 * walls or min(t for t in found["cells"] if t not in kept) == 60001
        assert min(n for n in found["nodes"] if n >= 50000) == 50001
    if "regions" in found:
        assert sorted(set(map(int, found["regions"]))) == [7, 8, 9], path
    groups = found.get("groups")
    if groups:
        name = "soft foam" if "soft foam" in groups else "soft%20foam"
        assert groups[name] == 16, (path, groups)
        assert groups["source"] == groups["target"] == 4, (path, groups)
        assert sum(count for of, count in groups.items() if of.startswith("wall:")) == 32, (path, groups)
        if not alone and not path.name.startswith("old"):
            assert groups["pid:7"] == 72 and groups["pid:8"] == 128, (path, groups)


def main():
    text, kept = deck()
    found_readers = []
    for name, read, files in (("meshio", read_meshio, ["j.msh", "j.vtu", "j.vtk", "text.msh", "text.vtk", "oldtext.msh",
                                                       "numbered.vtu", "alone.vtu", "alone.vtk",
                                                       "alonetext.vtk"]),
                              ("netCDF4", read_exodus, ["j.exo", "alone.e"]),
                              ("gmsh", read_gmsh, ["j.msh", "text.msh", "old.msh", "oldtext.msh", "j.unv", "j.bdf"]),
                              ("vtk", read_vtk, ["j.vtu", "j.vtk", "text.vtk", "numbered.vtu", "alone.vtu", "alone.vtk",
                                                 "alonetext.vtk"])):
        # meshio 5 reads no numbers with holes from a binary file of version 2.2.
        if readers.installed(name):
            found_readers.append((name, read, files))
    if not found_readers:
        return 77
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "part.bdf").write_text(text)
        pathlib.Path(folder, "join.lua").write_text(RECIPE)
        subprocess.run([sys.argv[1], "join.lua"], cwd=folder, check=True, timeout=100)
        for name, read, files in found_readers:
            for file in files:
                path = pathlib.Path(folder, file)
                found = read(path)
                check(found, path, kept, 32)
                print(f"{name} reads {file}: {len(found['hexes'])} hexahedra, groups {found.get('groups')}")
    return 0


sys.exit(main())
