#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every metric of every cell against VTK's vtkMeshQuality, to 1e-9; the scaled Jacobian, which meshes keep and files
hold in single precision, to half a unit of that.

usage: against_vtk.py METRIC_VALUES [--lacuna LACUNA] [MESH.msh ...]
Cells: random ones, from nearly cubes to inside out, at several sizes; flat, folded and collapsed ones; the meshes
a recipe makes with LACUNA; the meshes named, read with meshio. Exit 77 where VTK is not installed.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
except ImportError as missing:
    print(f"left out: {missing}; apt-get install python3-vtk9")
    sys.exit(77)

TOLERANCE = 1e-9
SINGLE = {"scaled_jacobian"}  # values of at most 1, rounded
WORST = 1e30  # what Verdict says where there is nothing to measure

VTK_NAMES = {
    "scaled_jacobian_with_centre": "ScaledJacobian", "jacobian": "Jacobian", "shape": "Shape", "shear": "Shear",
    "condition": "Condition", "max_aspect_frobenius": "MaxAspectFrobenius",
    "med_aspect_frobenius": "MedAspectFrobenius", "oddy": "Oddy", "skew": "Skew", "taper": "Taper",
    "max_edge_ratio": "MaxEdgeRatios", "edge_ratio": "EdgeRatio", "stretch": "Stretch", "diagonal": "Diagonal",
    "dimension": "Dimension", "volume": "Volume", "distortion": "Distortion",
    "relative_size_squared": "RelativeSizeSquared", "shape_and_size": "ShapeAndSize",
    "shear_and_size": "ShearAndSize"}
OURS_ALONE = {"scaled_jacobian", "full_edge_ratio"}

CUBE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)
# Turned so that each direction comes first once: over the three, VTK's six edges are all twelve.
TURNS = [[0, 1, 2, 3, 4, 5, 6, 7], [0, 4, 5, 1, 3, 7, 6, 2], [0, 3, 7, 4, 1, 2, 6, 5]]


def vtk_values(nodes, hexes, measure):
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(nodes, float), deep=True))
    cells = vtk.vtkCellArray()
    records = np.hstack([np.full((len(hexes), 1), 8), hexes]).astype(np.int64).ravel()
    cells.SetCells(len(hexes), numpy_to_vtkIdTypeArray(records, deep=True))
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.SetCells(vtk.VTK_HEXAHEDRON, cells)
    quality = vtk.vtkMeshQuality()
    quality.SetInputData(grid)
    getattr(quality, "SetHexQualityMeasureTo" + measure)()
    quality.Update()
    return vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality")).copy()


def our_values(program, nodes, hexes):
    with tempfile.TemporaryDirectory() as folder:
        given, found = pathlib.Path(folder, "in"), pathlib.Path(folder, "out")
        with open(given, "wb") as file:
            np.array([len(nodes), len(hexes)], np.int64).tofile(file)
            np.ascontiguousarray(nodes, float).tofile(file)
            np.ascontiguousarray(hexes, np.int32).tofile(file)
        names = subprocess.run([program, str(given), str(found)], check=True, capture_output=True, text=True)
        rows = [line.split() for line in names.stdout.splitlines()]
        values = np.fromfile(found).reshape(len(rows), len(hexes))
    return {name: row for (name, _), row in zip(rows, values)}, {name for name, larger in rows if larger == "1"}


def disagreement(ours, theirs, larger_is_better, unit=1.0):
    """Difference over the value, or over the unit where that is larger; where VTK says nothing of what is better the
    larger, ours must be 0."""
    nothing = ~np.isfinite(theirs)
    if larger_is_better:
        nothing |= theirs >= WORST / 10
    expected = np.where(nothing, 0 if larger_is_better else WORST, theirs)
    return np.abs(ours - expected) / np.maximum(unit, np.abs(expected))


def compare(program, nodes, hexes, what):
    """Lines that say where we differ."""
    ours, larger = our_values(program, nodes, hexes)
    assert set(ours) == set(VTK_NAMES) | OURS_ALONE, "a metric is not compared"
    faults = []
    worst = 0.0
    # VTK looks at its first six edges only: turned three ways it has seen them all.
    turned = [vtk_values(nodes, hexes[:, turn], "EdgeRatio") for turn in TURNS]
    theirs = {name: vtk_values(nodes, hexes, measure) for name, measure in VTK_NAMES.items()}
    theirs["full_edge_ratio"] = np.max(turned, axis=0)
    # Lacuna's own counts the corners alone: recomputed here.
    theirs["scaled_jacobian"] = corner_scaled_jacobian(nodes[hexes])
    size = np.linalg.norm(np.ptp(nodes[hexes], axis=1), axis=1)
    units = {"jacobian": size**3, "volume": size**3, "dimension": size}
    for name, expected in theirs.items():
        unit = np.maximum(units.get(name, 1.0), np.finfo(float).tiny)
        difference = disagreement(ours[name], expected, name in larger, unit)
        at = int(np.argmax(difference))
        worst = max(worst, float(difference[at]))
        allowed = TOLERANCE + (np.finfo(np.float32).epsneg / 2 if name in SINGLE else 0)
        if not difference[at] <= allowed:
            faults.append(f"{what}: {name} of cell {at} is {ours[name][at]:.17g}, VTK says {expected[at]:.17g}")
    print(f"{what}: {len(hexes)} cells, {len(theirs)} metrics, largest difference {worst:.2g}")
    return faults


def corner_scaled_jacobian(corners):
    around = [(1, 3, 4), (2, 0, 5), (3, 1, 6), (0, 2, 7), (7, 5, 0), (4, 6, 1), (5, 7, 2), (6, 4, 3)]
    least = np.ones(len(corners))
    for corner, ends in enumerate(around):
        edges = corners[:, ends] - corners[:, [corner]]
        lengths = np.linalg.norm(edges, axis=2).prod(axis=1)
        volume = np.einsum("ni,ni->n", edges[:, 0], np.cross(edges[:, 1], edges[:, 2]))
        least = np.minimum(least, np.divide(volume, lengths, out=np.zeros_like(volume), where=lengths > 0))
    return least


def as_list(cells):
    return cells.reshape(-1, 3), np.arange(8 * len(cells)).reshape(-1, 8)


def random_cells(seed, count, shake, size=1.0, stretch=1.0):
    random = np.random.default_rng(seed)
    cells = CUBE + random.uniform(-shake, shake, (count, 8, 3))
    turn, _ = np.linalg.qr(random.normal(size=(3, 3)))
    turn *= np.linalg.det(turn)
    return as_list(size * (cells * [1, stretch, 1 / stretch]) @ turn + size * random.uniform(-5, 5, 3))


def odd_cells():
    flat = CUBE * [1, 1, 0]
    thin = CUBE * [1, 1, 1e-6]
    wedge = CUBE[[0, 1, 2, 3, 4, 5, 5, 4]]
    pyramid = CUBE[[0, 1, 2, 3, 4, 4, 4, 4]]
    joined = CUBE[[0, 0, 2, 3, 4, 5, 6, 7]]
    turned_over = CUBE[[4, 5, 6, 7, 0, 1, 2, 3]]
    tangled = CUBE[[0, 1, 2, 3, 5, 4, 6, 7]]
    point = CUBE * 0 + 3.0
    line = CUBE * [1, 0, 0]
    dented = CUBE.copy()
    dented[6] = [0.3, 0.3, 0.3]
    barely = CUBE.copy()
    barely[6] = [1 / 3 + 1e-3] * 3
    twisted = CUBE.copy()
    twisted[4:] = twisted[[5, 6, 7, 4]]
    return as_list(np.array([CUBE, flat, thin, wedge, pyramid, joined, turned_over, tangled, point, line, dented,
                             barely, twisted, 1e-4 * CUBE, 1e4 * CUBE]))


RECIPE = """
local lacuna = require "lacuna"
local synthetic = lacuna.synthetic
local models = {
  elbow = synthetic.elbow { inner = 0.4, angle = 90 }, twisted = synthetic.prism { twist = 60, taper = 0.5 },
  plate = synthetic.plate { holes = 3 }, barrel = synthetic.barrel {},
}
for name, model in pairs(models) do
  local void = model:open_volume()
  void:close()
  void:sweep { layers = 6 }:write(name .. ".vtu")
end
"""


def recipe_meshes(lacuna, folder):
    pathlib.Path(folder, "meshes.lua").write_text(RECIPE)
    subprocess.run([lacuna, "meshes.lua"], cwd=folder, check=True)
    for path in sorted(pathlib.Path(folder).glob("*.vtu")):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        grid = reader.GetOutput()
        types = vtk_to_numpy(grid.GetCellTypesArray())
        records = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
        offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
        starts = offsets[:-1][types == vtk.VTK_HEXAHEDRON]
        yield path.name, vtk_to_numpy(grid.GetPoints().GetData()), records[starts[:, None] + np.arange(8)]


def msh_mesh(path):
    import meshio
    mesh = meshio.read(path)
    return mesh.points, np.vstack([block.data for block in mesh.cells if block.type == "hexahedron"])


def main():
    words = argparse.ArgumentParser()
    words.add_argument("program")
    words.add_argument("--lacuna")
    words.add_argument("meshes", nargs="*")
    given = words.parse_args()
    faults = []
    for seed, shake in enumerate((1e-3, 0.1, 0.3, 0.5, 1.0)):
        faults += compare(given.program, *random_cells(seed, 2000, shake), f"random by {shake}")
    for seed, (size, stretch) in enumerate([(1e-3, 1), (1e3, 1), (1, 10), (1, 0.01)]):
        faults += compare(given.program, *random_cells(10 + seed, 2000, 0.2, size, stretch),
                          f"size {size}, stretched {stretch}")
    faults += compare(given.program, *odd_cells(), "odd cells")
    if given.lacuna:
        with tempfile.TemporaryDirectory() as folder:
            for name, nodes, hexes in recipe_meshes(given.lacuna, folder):
                faults += compare(given.program, nodes, hexes, name)
    for path in given.meshes:
        faults += compare(given.program, *msh_mesh(path), pathlib.Path(path).name)
    # The comparison itself sees a millionth.
    nodes, hexes = random_cells(0, 10, 0.1)
    value = vtk_values(nodes, hexes, "Shape")
    assert (disagreement(value * (1 + 1e-6), value, True) > TOLERANCE).all()
    for fault in faults:
        print(fault)
    return 1 if faults else 0


sys.exit(main())
