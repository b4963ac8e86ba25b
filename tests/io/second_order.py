#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What others read from files of order 2: Gmsh, meshio and VTK, each where it is installed.

The volume says whether they take every node for what it is: each integrates the Jacobian by its own shape
functions, or, meshio having none, in its own order of nodes.

usage: second_order.py LACUNA    Exit 77 where none is installed.
"""
import itertools
import pathlib
import subprocess
import sys
import tempfile

try:
    import readers
except ImportError as error:
    print(f"left out: {error}")
    sys.exit(77)

RECIPE = """
local lacuna = require "lacuna"
local void = lacuna.synthetic.annulus { inner = 0.5, outer = 1, height = 1 }:open_volume()
for nodes, serendipity in pairs { [20] = true, [27] = false } do
  local mesh = void:sweep { layers = 2, size = 0.4, curvature = 8, order = 2, serendipity = serendipity }
  print(nodes, mesh.hexes, mesh.nodes, ("%.17g"):format(mesh:quality().volume))
  for _, ending in ipairs { "msh", "vtu", "vtk", "inp", "bdf", "unv", "exo" } do
    if nodes == 20 or ending:find "^[mv]" then mesh:write(nodes .. "." .. ending) end
  end
  mesh:write(nodes .. "_22.msh", { version = 2.2 })
  mesh:write(nodes .. "_22t.msh", { version = 2.2, binary = false })
  mesh:write(nodes .. "_t.msh", { binary = false })
  mesh:write(nodes .. "_t.vtk", { binary = false })
end
"""

GAUSS = [(0.5, 8 / 18), (0.5 - 0.15 ** 0.5, 5 / 18), (0.5 + 0.15 ** 0.5, 5 / 18)]
POINTS = [((u, v, w), a * b * c) for (u, a), (v, b), (w, c) in itertools.product(GAUSS, repeat=3)]


def determinant(m):
    (a, b, c), (d, e, f), (g, h, i) = m
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def jacobian(place, at, step=1e-4):
    """By central differences, which are exact for what is quadratic along each direction."""
    columns = []
    for d in range(3):
        ends = []
        for sign in (1, -1):
            moved = list(at)
            moved[d] += sign * step
            ends.append(place(moved))
        columns.append([(x - y) / (2 * step) for x, y in zip(*ends)])
    return determinant(columns)


def read_gmsh(path):
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(str(path))
    volume, hexes = 0, 0
    types, tags, _ = gmsh.model.mesh.getElements(3)
    for kind, elements in zip(types, tags):
        points, weights = gmsh.model.mesh.getIntegrationPoints(kind, "Gauss6")
        determinants = gmsh.model.mesh.getJacobians(kind, points)[1]
        for i, value in enumerate(determinants):
            volume += value * weights[i % len(weights)]
        hexes += len(elements)
    nodes = len(gmsh.model.mesh.getNodes()[0])
    gmsh.finalize()
    return hexes, nodes, volume


def read_vtk(path):
    import vtk
    reader = (vtk.vtkExodusIIReader() if path.suffix == ".exo" else
              vtk.vtkXMLUnstructuredGridReader() if path.suffix == ".vtu" else vtk.vtkUnstructuredGridReader())
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    if path.suffix == ".exo":
        blocks = grid.NewIterator()
        blocks.InitTraversal()
        grid = blocks.GetCurrentDataObject()
    volume, hexes = 0, 0
    for i in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(i)
        if cell.GetCellDimension() < 3:
            continue
        hexes += 1

        def place(at, cell=cell):
            found, weights, sub = [0.0] * 3, [0.0] * 27, vtk.reference(0)
            cell.EvaluateLocation(sub, at, found, weights)
            return found

        volume += sum(weight * jacobian(place, at) for at, weight in POINTS)
    return hexes, grid.GetNumberOfPoints(), volume


SIDES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
CUBE = CORNERS + [tuple((a + b) / 2 for a, b in zip(CORNERS[i], CORNERS[j])) for i, j in SIDES]


def serendipity(at):
    """Shape functions of 20 nodes in meshio's order, which is VTK's."""
    x = [2 * t - 1 for t in at]
    weights = []
    for node in CUBE:
        n = [2 * t - 1 for t in node]
        product = 1.0
        for t, s in zip(x, n):
            product *= 1 - t * t if s == 0 else 1 + t * s
        if 0 in n:
            weights.append(product / 4)
        else:
            weights.append(product * (sum(t * s for t, s in zip(x, n)) - 2) / 8)
    return weights


def read_meshio(path):
    import meshio
    mesh = meshio.read(path)
    volume, hexes = 0, 0
    table = {}
    for block in mesh.cells:
        if not block.type.startswith("hexahedron"):
            continue
        hexes += len(block.data)
        if block.type != "hexahedron20":
            return hexes, len(mesh.points), None
        for cell in block.data:
            points = [mesh.points[n] for n in cell]

            def place(at, points=points):
                key = tuple(at)
                if key not in table:
                    table[key] = serendipity(at)
                return [sum(w * p[d] for w, p in zip(table[key], points)) for d in range(3)]

            volume += sum(weight * jacobian(place, at) for at, weight in POINTS)
    return hexes, len(mesh.points), volume


def main():
    # Gmsh's own readers of VTK and BDF take middle nodes in another order, or none (see its issues).
    here = [(read, endings) for name, read, endings in
            [("gmsh", read_gmsh, {".msh", ".unv"}),
             ("meshio", read_meshio, {".msh", ".vtu", ".vtk", ".inp", ".bdf"}),
             ("vtk", read_vtk, {".vtu", ".vtk", ".exo"})] if readers.installed(name)]
    if not here:
        return 77
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "write.lua").write_text(RECIPE)
        run = subprocess.run([sys.argv[1], "write.lua"], cwd=folder, capture_output=True, text=True, check=True)
        expected = {}
        for line in run.stdout.splitlines():
            nodes, hexes, count, volume = line.split()
            expected[nodes] = (int(hexes), int(count), float(volume))
        for path in sorted(pathlib.Path(folder).iterdir()):
            if path.suffix == ".lua":
                continue
            hexes, count, volume = expected[path.stem.split("_")[0]]
            for read, endings in here:
                if path.suffix not in endings:
                    continue
                found = read(path)
                what = (read.__name__, path.name, found, (hexes, count, volume))
                assert found[:2] == (hexes, count), what
                assert found[2] is None or abs(found[2] - volume) < 1e-7 * volume, what
                print(f"{read.__name__} {path.name}: {found[0]} cells, volume {found[2]}")
    return 0


sys.exit(main())
