#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A deck of hexahedra and wedges with a gap, filled and joined: what others read in every format, and CalculiX solves.

usage: joined_wedges.py LACUNA    Exit 77 where no other reader is installed.
"""
import itertools
import pathlib
import shutil
import subprocess
import sys
import tempfile

try:
    import numpy as np
    import readers
except ImportError as error:
    print(f"left out: {error}")
    sys.exit(77)

N, LAYERS, LOW, HIGH, TOP = 4, 3, 1, 4, 5  # squares each way; layers of the gap between two heights; the whole height
RECIPE = """
local lacuna = require "lacuna"
for _, from in ipairs { "part.inp", "part.bdf" } do
  local model = lacuna.load(from)
  local mesh = model:open_volume { name = "filling",
    source = { box = { { -0.1, -0.1, 0.9 }, { 4.1, 4.1, 1.1 } } },
    target = { box = { { -0.1, -0.1, 3.9 }, { 4.1, 4.1, 4.1 } } },
  }:sweep { layers = 3, wedges = true }
  for _, to in ipairs { "j.inp", "j.bdf", "j.unv", "j.msh", "j.vtu", "j.vtk", "j.exo" } do
    mesh:write(from:sub(-3) .. "_" .. to, { with = model })
  end
  mesh:write(from:sub(-3) .. "_old.msh", { with = model, version = 2.2, binary = false })
  print(mesh.hexes, mesh.wedges)
end
"""
FACES = {"hexahedron": [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
         "wedge": [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]}


def deck():
    """Nodes, and cells as (kind, nodes), of two slabs; every third square is two triangles."""
    node = lambda i, j, k: 1 + i + (N + 1) * (j + (N + 1) * k)
    heights = [0, LOW, HIGH, TOP]
    nodes = {node(i, j, k): (i + (0.1 * ((3 * i + j) % 3 - 1) if 0 < i < N and 0 < j < N else 0), j, z)
             for k, z in enumerate(heights) for j in range(N + 1) for i in range(N + 1)}
    cells = []
    for k, (i, j) in itertools.product((0, 2), itertools.product(range(N), repeat=2)):
        ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
        parts = [ring] if (i + 2 * j) % 3 else [ring[:3], [ring[0], ring[2], ring[3]]]
        for part in parts:
            cells.append([node(a, b, c) for c in (k, k + 1) for a, b in part])
    return nodes, cells


def inp(nodes, cells):
    lines = ["*NODE"] + [f"{n}, {x}, {y}, {z}" for n, (x, y, z) in nodes.items()]
    for kind, size in (("C3D8", 8), ("C3D6", 6)):
        lines.append(f"*ELEMENT, TYPE={kind}, ELSET=part")
        lines += [f"{100 + c}, " + ", ".join(map(str, cell)) for c, cell in enumerate(cells) if len(cell) == size]
    lines += ["*MATERIAL, NAME=steel", "*ELASTIC", "210000., 0.3", "*SOLID SECTION, ELSET=part, MATERIAL=steel", "*STEP",
              "*STATIC", "*EL PRINT, ELSET=part", "S", "*EL PRINT, ELSET=filling", "S", "*END STEP"]
    return "\n".join(lines) + "\n"


def bdf(nodes, cells):
    lines = ["BEGIN BULK"] + [f"GRID,{n},,{float(x)},{float(y)},{float(z)}" for n, (x, y, z) in nodes.items()]
    for c, cell in enumerate(cells):
        word = "CHEXA" if len(cell) == 8 else "CPENTA"
        lines.append(f"{word},{100 + c},7," + ",".join(map(str, cell[:6])))
        if len(cell) == 8:
            lines.append(f",{cell[6]},{cell[7]}")
    return "\n".join(lines + ["PSOLID,7,1", "MAT1,1,2.1+5,,.3", "ENDDATA"]) + "\n"


def check(what, mesh, counts):
    assert {kind: len(mesh.cells[kind]) for kind in FACES} == counts, what
    used = np.unique(np.concatenate([mesh.cells[kind].ravel() for kind in FACES]))
    assert len(used) == (N + 1) ** 2 * (4 + LAYERS - 1), (what, len(used))
    uses, area, volume = {}, 0.0, 0.0
    for kind, faces in FACES.items():
        for cell in mesh.cells[kind]:
            own = 0.0
            for face in faces:
                p = mesh.points[cell[list(face)]]
                normal = sum(np.cross(p[k] - p[0], p[k + 1] - p[0]) for k in range(1, len(face) - 1)) / 2
                own += p.mean(axis=0) @ normal / 3
                key = tuple(sorted(cell[list(face)]))
                uses[key] = uses.get(key, 0) + 1
                area += np.linalg.norm(normal) if uses[key] == 1 else -np.linalg.norm(normal)
            assert own > 0, (what, kind, own)
            volume += own
    assert max(uses.values()) == 2, (what, "a face of three cells")
    assert abs(volume - N * N * TOP) < 1e-9 and abs(area - 2 * N * N - 4 * N * TOP) < 1e-9, (what, volume, area)


def solve(folder, name):
    """An affine displacement of the outside is the same stress everywhere, in wedges and hexahedra alike."""
    text = pathlib.Path(folder, name + ".inp").read_text()
    mesh = readers.read_meshio(pathlib.Path(folder, name + ".inp"))
    gradient = np.array([[0.001, 0.0004, -0.0002], [-0.0003, 0.002, 0.0001], [0.0005, -0.0002, -0.001]])
    lines = ["*STATIC", "*BOUNDARY"]
    numbers = [int(line.split(",")[0]) for line in text.split("*NODE\n")[1].split("*")[0].splitlines()]
    for number, at in zip(numbers, mesh.points):
        if np.any(at < 1e-9) or at[0] > N - 1e-9 or at[1] > N - 1e-9 or at[2] > TOP - 1e-9:
            lines += [f"{number}, {d + 1}, {d + 1}, {u:.12e}" for d, u in enumerate(gradient @ at)]
    pathlib.Path(folder, "solved.inp").write_text(text.replace("*STATIC", "\n".join(lines)))
    subprocess.run(["ccx", "solved"], cwd=folder, check=True, capture_output=True, timeout=100)
    strain = (gradient + gradient.T) / 2
    shear, lame = 210000 / 2.6, 210000 * 0.3 / (1.3 * 0.4)
    stress = 2 * shear * strain + lame * np.trace(strain) * np.eye(3)
    expected = stress[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    rows = [line.split() for line in pathlib.Path(folder, "solved.dat").read_text().splitlines()]
    found = np.array([row[2:] for row in rows if len(row) == 8 and row[0].isdigit()], dtype=float)
    assert np.abs(found - expected).max() < 1e-6 * np.abs(expected).max(), np.abs(found - expected).max()
    return len(found)


def main():
    here = {name for name in ("meshio", "gmsh", "vtk", "netCDF4") if readers.installed(name)}
    if not here:
        return 77
    nodes, cells = deck()
    sizes = [len(cell) for cell in cells]
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "part.inp").write_text(inp(nodes, cells))
        pathlib.Path(folder, "part.bdf").write_text(bdf(nodes, cells))
        pathlib.Path(folder, "fill.lua").write_text(RECIPE)
        run = subprocess.run([sys.argv[1], "fill.lua"], cwd=folder, capture_output=True, text=True, timeout=100)
        assert run.returncode == 0, run.stderr
        for line in run.stdout.splitlines():
            assert line.split() == [str(sizes.count(8) // 2 * LAYERS), str(sizes.count(6) // 2 * LAYERS)], line
        counts = {kind: sizes.count(size) // 2 * (2 + LAYERS) for kind, size in (("hexahedron", 8), ("wedge", 6))}
        for source in ("inp", "bdf"):
            for file, who in (("j.inp", ["meshio"]), ("j.bdf", ["meshio", "gmsh"]), ("j.unv", ["gmsh"]),
                              ("j.msh", ["gmsh", "meshio"]), ("old.msh", ["gmsh", "meshio"]), ("j.vtu", ["vtk", "meshio"]),
                              ("j.vtk", ["vtk", "meshio"]), ("j.exo", ["netCDF4", "meshio"])):
                path = pathlib.Path(folder, f"{source}_{file}")
                # meshio reads Exodus by netCDF4.
                able = here if file != "j.exo" or "netCDF4" in here else here - {"meshio"}
                for name in able.intersection(who):
                    read = {"meshio": readers.read_meshio, "gmsh": readers.read_gmsh, "vtk": readers.read_vtk,
                            "netCDF4": readers.read_exodus}[name]
                    mesh = read(path, "exodus") if name == "meshio" and file == "j.exo" else read(path)
                    check(f"{path.name} by {name}", mesh, counts)
                    if file == "j.bdf" and name == "meshio":  # cells by their property
                        filled = sum(counts.values()) - len(cells)
                        expected = {7: len(cells), 8: filled} if source == "bdf" else {1: len(cells), 2: filled}
                        assert mesh.groups == expected, (path.name, mesh.groups)
        if "meshio" in here and shutil.which("ccx"):
            points = solve(folder, "inp_j")
            assert points == 8 * counts["hexahedron"] + 2 * counts["wedge"], points
            print(f"CalculiX: the stress is right at {points} places")
        print(f"the same in all formats: {counts}")
    return 0


sys.exit(main())
