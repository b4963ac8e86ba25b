#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A mesh of hexahedra, wedges, pyramids and tetrahedra in every format, as others read it.

Of order 1: the cells conform and fill the box; CalculiX solves a patch test across all four kinds; OpenFOAM's
checkMesh finds no fault. Of order 2, with curved edges: each middle node is on its edge.

usage: mixed_cells.py REWRITE    REWRITE reads a deck and writes it. Exit 77 where no reader is installed.
"""
import collections
import os
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

N = 3
HEX_FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
FACES = {"tetra": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)), "hexahedron": HEX_FACES,
         "wedge": ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
         "pyramid": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))}
# Edges with a middle node, in the order of VTK and meshio, and places in it of the nodes in Gmsh's.
EDGES = {"tetra": "01 12 20 03 13 23", "pyramid": "01 12 23 30 04 14 24 34", "wedge": "01 12 20 34 45 53 03 14 25",
         "hexahedron": "01 12 23 30 45 56 67 74 04 15 26 37"}
EDGES = {kind: [tuple(map(int, edge)) for edge in text.split()] for kind, text in EDGES.items()}
GMSH_EDGES = {"tetra": "01 12 20 03 23 13", "pyramid": "01 03 04 12 14 23 24 34", "wedge": "01 02 03 12 14 25 34 35 45",
              "hexahedron": "01 03 04 12 15 23 26 37 45 47 56 67"}
GMSH_TYPES = {"tetra": (4, 11), "hexahedron": (5, 17), "wedge": (6, 18), "pyramid": (7, 19)}
SECOND = {"tetra10": "tetra", "pyramid13": "pyramid", "wedge15": "wedge", "hexahedron20": "hexahedron"}
VTK_SECOND = {24: "tetra", 27: "pyramid", 26: "wedge", 25: "hexahedron"}


def generate():
    """Places and cells, as tests/support/mixed_cells.h says."""
    random, points, at = np.random.default_rng(1), [], {}

    def node(*place):
        if place not in at:
            at[place] = len(points)
            points.append([x if x in (0, most) else x + random.uniform(-0.15, 0.15)
                           for x, most in zip(place, (N, N, 2))])
        return at[place]

    cells = collections.defaultdict(list)
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    for i in range(N):
        for j in range(N):
            low = [node(i + a, j + b, c) for a, b, c in corners]
            high = [node(i + a, j + b, c + 1) for a, b, c in corners]
            if i == 0:
                first = min(range(4), key=lambda k: low[4 + k])
                r = [(first + k) % 4 for k in range(4)]
                for t in ((r[0], r[1], r[2]), (r[0], r[2], r[3])):
                    cells["wedge"].append([low[k] for k in t] + [low[4 + k] for k in t])
            else:
                cells["hexahedron"].append(low)
            middle = node(i + 0.5, j + 0.5, 1.5)
            for f, face in enumerate(HEX_FACES):
                q = [high[k] for k in face][::-1]
                if f == 0 and i > 0:
                    cells["pyramid"].append(q + [middle])
                    continue
                first = q.index(min(q))
                q = q[first:] + q[:first]
                cells["tetra"] += [[q[0], q[1], q[2], middle], [q[0], q[2], q[3], middle]]
    return np.array(points), cells


def place_of_middle(a, b):
    p = (np.array(a) + np.array(b)) / 2
    return p + 0.01 * np.sin(5 * p[[1, 2, 0]])


def write_msh(path, points, cells, order, kinds):
    points, middles, rows = list(points), {}, []
    for kind in kinds:
        for cell in cells[kind]:
            row = list(cell)
            for edge in GMSH_EDGES[kind].split() if order == 2 else ():
                a, b = sorted(cell[int(k)] for k in edge)
                if (a, b) not in middles:
                    middles[a, b] = len(points)
                    points.append(place_of_middle(points[a], points[b]))
                row.append(middles[a, b])
            rows.append(f"{len(rows) + 1} {GMSH_TYPES[kind][order - 1]} 2 1 1 " + " ".join(str(n + 1) for n in row))
    nodes = [f"{n + 1} {x:.17g} {y:.17g} {z:.17g}" for n, (x, y, z) in enumerate(points)]
    path.write_text("\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "1", '3 1 "solid"',
                               "$EndPhysicalNames", "$Nodes", str(len(nodes)), *nodes, "$EndNodes", "$Elements",
                               str(len(rows)), *rows, "$EndElements"]) + "\n")


def check_first(what, mesh, counts):
    assert {kind: len(cells) for kind, cells in mesh.cells.items()} == counts, (what, mesh.cells)
    uses, volume = collections.Counter(), 0.0
    for kind, cells in mesh.cells.items():
        for cell in cells:
            own = 0.0
            for face in FACES[kind]:
                nodes = list(dict.fromkeys(cell[list(face)]))  # a brick that is a pyramid repeats its apex
                if len(nodes) < 3:
                    continue
                p = mesh.points[nodes]
                own += p.mean(0) @ sum(np.cross(p[k] - p[0], p[k + 1] - p[0]) for k in range(1, len(p) - 1)) / 6
                uses[tuple(sorted(nodes))] += 1
            assert own > 0, (what, kind, own)
            volume += own
    outside = sum(count == 1 for count in uses.values())
    assert max(uses.values()) == 2 and outside == 3 * N * N + 13 * N, (what, outside)
    assert abs(volume - 2 * N * N) < 1e-8, (what, volume)


def second_meshio(path):
    import meshio
    mesh = meshio.read(path)
    for block in mesh.cells:
        if block.type in SECOND:
            yield SECOND[block.type], mesh.points[block.data]


def second_vtk(path):
    import vtk
    reader = {".vtu": vtk.vtkXMLUnstructuredGridReader, ".vtk": vtk.vtkUnstructuredGridReader,
              ".exo": vtk.vtkExodusIIReader}[path.suffix]()
    reader.SetFileName(str(path))
    reader.Update()
    grids = [reader.GetOutput()]
    if path.suffix == ".exo":
        blocks, grids = grids[0].NewIterator(), []
        blocks.InitTraversal()
        while not blocks.IsDoneWithTraversal():
            grids.append(blocks.GetCurrentDataObject())
            blocks.GoToNextItem()
    for grid in grids:
        for c in range(grid.GetNumberOfCells()):
            ids = grid.GetCell(c).GetPointIds()
            places = [grid.GetPoint(ids.GetId(k)) for k in range(ids.GetNumberOfIds())]
            yield VTK_SECOND[grid.GetCellType(c)], np.array([places])


def check_second(what, blocks, cells, kinds):
    count = collections.Counter()
    for kind, places in blocks:
        count[kind] += len(places)
        for nodes in places:
            corners = len(nodes) - len(EDGES[kind])
            for k, (a, b) in enumerate(EDGES[kind]):
                apart = np.abs(nodes[corners + k] - place_of_middle(nodes[a], nodes[b])).max()
                assert apart < (1e-6 if ".exo" in what else 1e-9), (what, kind, k, apart)  # VTK reads floats there
    assert count == {kind: len(cells[kind]) for kind in kinds}, (what, count)


def volume_by_gmsh(path):
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(str(path))
    volume = 0.0
    for kind, elements in zip(*gmsh.model.mesh.getElements(3)[:2]):
        points, weights = gmsh.model.mesh.getIntegrationPoints(kind, "Gauss8")
        found = gmsh.model.mesh.getJacobians(kind, points)[1]
        volume += np.dot(found, np.tile(weights, len(elements)))
    gmsh.finalize()
    return volume


def patch_test(path, points):
    """An affine displacement of the outside is the same stress everywhere."""
    gradient = np.array([[0.001, 0.0004, -0.0002], [-0.0003, 0.002, 0.0001], [0.0005, -0.0002, -0.001]])
    outside = [(n + 1, p) for n, p in enumerate(points) if min(p) == 0 or p[0] == N or p[1] == N or p[2] == 2]
    lines = [path.read_text(), "*MATERIAL, NAME=steel", "*ELASTIC", "210000., 0.3",
             "*SOLID SECTION, ELSET=solid, MATERIAL=steel", "*STEP", "*STATIC", "*BOUNDARY"]
    lines += [f"{n}, {d + 1}, {d + 1}, {u:.12e}" for n, p in outside for d, u in enumerate(gradient @ p)]
    lines += ["*EL PRINT, ELSET=solid", "S", "*END STEP"]
    path.with_name("solved.inp").write_text("\n".join(lines) + "\n")
    subprocess.run(["ccx", "solved"], cwd=path.parent, check=True, capture_output=True, timeout=100)
    strain = (gradient + gradient.T) / 2
    stress = 210000 / 1.3 * strain + 210000 * 0.3 / (1.3 * 0.4) * np.trace(strain) * np.eye(3)
    rows = [line.split() for line in path.with_name("solved.dat").read_text().splitlines()]
    found = np.array([row[2:] for row in rows if len(row) == 8 and row[0].isdigit()], dtype=float)
    expected = stress[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    assert len(points) > len(outside) and len(found) > 0
    assert np.abs(found - expected).max() < 1e-6 * np.abs(expected).max(), np.abs(found - expected).max()
    print(f"CalculiX: one stress at {len(found)} places")


def check_mesh(rewrite, source, folder):
    system, constant = folder / "case/system", folder / "case/constant"
    system.mkdir(parents=True)
    constant.mkdir()
    rewrite(source, constant / "polyMesh")
    head = "FoamFile {{ version 2.0; format ascii; class dictionary; object {}; }}\n"
    (system / "controlDict").write_text(head.format("controlDict") + "application none; startFrom startTime;\n"
                                        "startTime 0; stopAt endTime; endTime 1; deltaT 1; writeInterval 1;\n")
    kinds = ("ddt", "grad", "div", "laplacian", "interpolation", "snGrad")
    schemes = "".join(f"{kind}Schemes {{}}\n" for kind in kinds)
    for name, text in (("fvSchemes", schemes), ("fvSolution", "")):
        (system / name).write_text(head.format(name) + text)
    here = dict(os.environ, FOAM_ETC=os.environ.get("FOAM_ETC", "/usr/share/openfoam/etc"),
                WM_PROJECT_DIR=os.environ.get("WM_PROJECT_DIR", "/usr/share/openfoam"))
    run = subprocess.run(["checkMesh", "-case", folder / "case"], capture_output=True, text=True, timeout=100, env=here)
    assert "Mesh OK." in run.stdout, run.stdout + run.stderr
    print("checkMesh: Mesh OK.")


def main():
    here = {name for name in ("meshio", "gmsh", "vtk", "netCDF4") if readers.installed(name)}
    if not here:
        return 77

    def rewrite(source, out, *words):
        run = subprocess.run([sys.argv[1], source, out, *words], capture_output=True, text=True, timeout=100)
        assert run.returncode == 0, (out, run.stderr)

    points, cells = generate()
    counts = {kind: len(of) for kind, of in cells.items()}
    bricks = {kind: count for kind, count in counts.items() if kind != "pyramid"}
    bricks["hexahedron"] += counts["pyramid"]
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        source = folder / "first.msh"
        write_msh(source, points, cells, 1, FACES)
        read = {"gmsh": readers.read_gmsh, "meshio": readers.read_meshio, "vtk": readers.read_vtk,
                "netCDF4": readers.read_exodus}
        for file, words, who in [("a.msh", [], "gmsh meshio"), ("t.msh", ["text"], "gmsh meshio"),
                                 ("b.msh", ["2.2"], "gmsh"), ("c.msh", ["2.2", "text"], "gmsh meshio"),
                                 ("a.vtk", [], "vtk meshio"), ("a.vtu", [], "vtk meshio"), ("a.bdf", [], "meshio gmsh"),
                                 ("a.exo", [], "netCDF4"), ("a.inp", [], "meshio"), ("a.unv", [], "gmsh")]:
            rewrite(source, folder / file, *words)
            for name in here.intersection(who.split()):
                check_first(f"{file} by {name}", read[name](folder / file),
                            bricks if file in ("a.inp", "a.unv") else counts)
            rewrite(folder / file, folder / "again.msh")  # by the reader of the format
            if "gmsh" in here:
                check_first(f"{file} read again", readers.read_gmsh(folder / "again.msh"), counts)
        if shutil.which("ccx"):
            patch_test(folder / "a.inp", points)
        if shutil.which("checkMesh"):
            check_mesh(rewrite, source, folder)
        for kinds in (["tetra", "hexahedron"] + more for more in ([], ["wedge"], ["pyramid"], ["wedge", "pyramid"])):
            write_msh(folder / "second.msh", points, cells, 2, kinds)
            for file, who in [("a.msh", "meshio"), ("a.vtk", "vtk meshio"), ("a.vtu", "vtk meshio"),
                              ("a.bdf", "meshio"), ("a.exo", "vtk"), ("a.inp", "meshio"), ("a.unv", "")]:
                if "pyramid" in kinds and file in ("a.inp", "a.unv"):
                    continue
                rewrite(folder / "second.msh", folder / file)
                for name in here.intersection(who.split()):
                    if name == "meshio" and len(kinds) > 2:
                        continue  # it knows no wedge15 and no pyramid13
                    blocks = (second_vtk if name == "vtk" else second_meshio)(folder / file)
                    check_second(f"{file} of order 2 by {name}", blocks, cells, kinds)
                rewrite(folder / file, folder / "again.msh")
                if "gmsh" in here:
                    given, found = volume_by_gmsh(folder / "second.msh"), volume_by_gmsh(folder / "again.msh")
                    assert abs(found - given) < 1e-9 * given, (file, found, given)
    print(f"the same in all formats: {counts}")
    return 0


sys.exit(main())
