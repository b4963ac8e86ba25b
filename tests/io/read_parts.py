#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Meshes in parts as others read them, against the same mesh in one file: Gmsh and meshio, each where it is
installed.

usage: read_parts.py LACUNA    Exit 77 where none is.
"""
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

try:
    import numpy
    import readers
except ImportError as error:
    print(f"left out: {error}")
    sys.exit(77)

RECIPE = """
local lacuna = require "lacuna"
local p = lacuna.params { parts = 3, ghosts = 1, order = 1, layers = 7, wedges = false, blocks = false }
local mesh
if p.blocks then
  local void = lacuna.synthetic.prism { sides = 4 }:open_volume {}
  local pieces = lacuna.assembly(void:cut { plane = { { 0, 0, 0.8 }, { 0, 0, 1 } } })
  mesh = pieces:sweep { layers = p.layers, order = p.order }
else
  local void = lacuna.synthetic.prism { sides = p.wedges and 5 or 6, holes = p.wedges and 0 or 1, twist = 30,
    drop = { "wall_1" } }:open_volume {}
  mesh = void:sweep { layers = p.layers, order = p.order }
end
mesh:write "w.msh"
mesh:write "w.vtu"
local options = { partitions = p.parts, ghosts = p.ghosts }
mesh:write("p.msh", options)
mesh:write("p.pvtu", options)
options.binary = false
mesh:write("t.msh", options)
-- And as Lacuna itself reads them.
for _, name in ipairs { "p.msh", "t.msh" } do
  assert(tostring(lacuna.check(name)) == tostring(lacuna.check "w.msh"), name)
  local whole, parts = lacuna.load "w.msh", lacuna.load(name)
  assert(whole:describe():gsub("w%.msh", "") == parts:describe():gsub("[pt]%.msh", ""), name)
end
"""


def ghosts_of(cells, part, rows):
    """Parts each cell is a ghost of: those it shares a node with, as many rows over."""
    own = {cell: {part[cell]} for cell in cells}
    for _ in range(rows):
        at = {}
        for cell, nodes in cells.items():
            for node in nodes:
                at.setdefault(node, set()).update(own[cell])
        own = {cell: set().union(*(at[node] for node in nodes)) for cell, nodes in cells.items()}
    return {cell: all_of - {part[cell]} for cell, all_of in own.items() if all_of != {part[cell]}}


def read_gmsh(path):
    """Nodes and elements by tag, the groups and the part of each, the parts that solids are ghosts of."""
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(str(path))
    mesh = gmsh.model.mesh
    tags, points, _ = mesh.getNodes()
    nodes = dict(zip(tags, points.reshape(-1, 3).tolist()))
    elements, groups, part, ghosts = {}, {}, {}, {}
    for dimension, tag in gmsh.model.getEntities():
        parts = list(gmsh.model.getPartitions(dimension, tag))
        names = {gmsh.model.getPhysicalName(dimension, group)
                 for group in gmsh.model.getPhysicalGroupsForEntity(dimension, tag)}
        if parts and gmsh.model.getParent(dimension, tag)[0] < 0:  # its ghosts
            for cell, owner in zip(*mesh.getGhostElements(dimension, tag)):
                ghosts.setdefault(cell, set()).add(parts[0])
                assert part.get(cell, owner) == owner, (path, cell)
            continue
        for kind, found, all_nodes in zip(*mesh.getElements(dimension, tag)):
            for element, own in zip(found, all_nodes.reshape(len(found), -1).tolist()):
                assert element not in elements, (path, element)
                elements[element] = (kind, tuple(own))
                groups[element] = names
                part[element] = parts[0] if parts else 0
    gmsh.finalize()
    return nodes, elements, groups, part, ghosts


def check_gmsh(folder, parts, rows):
    whole = read_gmsh(folder / "w.msh")
    for name in ["p.msh", "t.msh"]:
        nodes, elements, groups, part, ghosts = read_gmsh(folder / name)
        assert elements == whole[1], name
        assert groups == whole[2], name
        assert nodes.keys() == whole[0].keys(), name
        assert all(nodes[tag] == whole[0][tag] for tag in nodes), name
        assert set(part.values()) == set(range(1, parts + 1)), (name, set(part.values()))
        solids = {tag: own for tag, (kind, own) in elements.items() if kind in (5, 6, 12, 17)}
        if rows == 0:
            assert not ghosts, name
        else:
            assert ghosts == ghosts_of(solids, part, rows), name
        sizes = [sum(part[tag] == p for tag in solids) for p in range(1, parts + 1)]
        print(f"gmsh reads {name}: {len(elements)} elements, parts of {sizes}, {len(ghosts)} ghosts")


def check_meshio(folder, parts, rows):
    import meshio
    whole = meshio.read(folder / "w.vtu")
    cells = [(block.type, row) for block in whole.cells for row in block.data]
    data = {name: numpy.concatenate(values) for name, values in whole.cell_data.items()}
    # Places by number: those of the file's own numbers, else as they come.
    cell_at = {n: i for i, n in enumerate(data.get("cell_number", range(1, len(cells) + 1)))}
    points = range(1, len(whole.points) + 1)
    node_at = {n: i for i, n in enumerate(whole.point_data.get("node_number", points))}
    root = xml.etree.ElementTree.parse(folder / "p.pvtu").getroot()
    names = [piece.get("Source") for piece in root.iter("Piece")]
    assert names == [f"p_{p}.vtu" for p in range(parts)], names
    arrays = {array.get("Name") for array in root.iter("PDataArray")} - {None}
    assert int(root[0].get("GhostLevel")) == rows
    part, ghosts, owners = {}, {}, {}
    for p, name in enumerate(names):
        piece = meshio.read(folder / name)
        assert set(piece.cell_data) | set(piece.point_data) == arrays, (name, arrays)
        number = numpy.array([node_at[n] for n in piece.point_data["node_number"]])
        assert (piece.points == whole.points[number]).all(), name
        own = [(block.type, row) for block in piece.cells for row in block.data]
        values = {key: numpy.concatenate(value) for key, value in piece.cell_data.items()}
        for i, (kind, row) in enumerate(own):
            cell = cell_at[values["cell_number"][i]]
            assert kind == cells[cell][0] and (number[row] == cells[cell][1]).all(), (name, i)
            for key in data:
                assert values[key][i] == data[key][cell], (name, key, i)
            if rows > 0 and values["vtkGhostType"][i]:
                ghosts.setdefault(cell, set()).add(p)
            else:
                assert cell not in part, (name, cell)
                part[cell] = p
        if rows > 0:
            for point, ghost in zip(number, piece.point_data["vtkGhostType"]):
                if not ghost:
                    assert point not in owners, (name, point)
                    owners[point] = p
    assert sorted(part) == list(range(len(cells)))
    if rows > 0:
        assert len(owners) == len(whole.points)
        solids = {i: row for i, (kind, row) in enumerate(cells) if kind[:3] in ("hex", "wed")}
        assert ghosts == ghosts_of(solids, part, rows)
    print(f"meshio reads {parts} pieces: {len(cells)} cells, {len(ghosts)} ghosts")


CASES = ["parts=3", "parts=1", "parts=7 ghosts=2", "parts=2 ghosts=0", "parts=2 order=2",
         "parts=3 wedges=true", "parts=2 blocks=true", "parts=5 ghosts=2 blocks=true",
         "parts=3 blocks=true order=2"]


def main():
    here = [check for module, check in [("gmsh", check_gmsh), ("meshio", check_meshio)]
            if readers.installed(module)]
    if not here:
        return 77
    for case in CASES:
        options = dict(word.split("=") for word in case.split())
        print(case)
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "write.lua").write_text(RECIPE)
            run = subprocess.run([sys.argv[1], "write.lua", *case.split()], cwd=folder, capture_output=True,
                                 text=True, check=False)
            assert run.returncode == 0, run.stderr
            for check in here:
                check(pathlib.Path(folder), int(options["parts"]), int(options.get("ghosts", 1)))
    return 0


sys.exit(main())
