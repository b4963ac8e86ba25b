# SPDX-License-Identifier: MIT
"""Meshes as readers see them that are not Lacuna's: Gmsh, meshio, VTK, netCDF4, each where it is installed.

Each gives a Mesh: nodes, and by the kind of cell the places of their nodes in meshio's order, their numbers where the
reader tells them, and the cells of each group by name, or by number where it has none.
"""
import pathlib

import numpy as np

CORNERS = {"line": 2, "triangle": 3, "quad": 4, "tetra": 4, "pyramid": 5, "wedge": 6, "hexahedron": 8}
GMSH = {1: "line", 2: "triangle", 3: "quad", 4: "tetra", 5: "hexahedron", 6: "wedge", 7: "pyramid"}
VTK = {3: "line", 5: "triangle", 9: "quad", 10: "tetra", 12: "hexahedron", 13: "wedge", 14: "pyramid"}
EXODUS = {"SHELL3": "triangle", "TRI3": "triangle", "SHELL4": "quad", "TETRA4": "tetra", "PYRAMID5": "pyramid",
          "PYRAMID": "pyramid", "WEDGE6": "wedge", "HEX8": "hexahedron", "TETRA": "tetra", "HEX": "hexahedron", "WEDGE": "wedge"}


class Mesh:
    def __init__(self, points, node_numbers=None):
        self.points = np.asarray(points, dtype=float).reshape(-1, 3)
        self.node_numbers = node_numbers
        self.cells = {}    # by kind: places of nodes, a row each
        self.numbers = {}  # by kind, where they are known
        self.groups = {}   # by name or (dimension, number): how many cells
        self.regions = {}  # by kind, where the file tells them

    def add(self, kind, nodes, numbers=None):
        nodes = np.asarray(nodes, dtype=np.int64).reshape(-1, CORNERS[kind])
        if not len(nodes):
            return
        before = self.cells.get(kind)
        self.cells[kind] = nodes if before is None else np.vstack([before, nodes])
        if numbers is not None:
            known = self.numbers.get(kind)
            numbers = np.asarray(numbers, dtype=np.int64)
            self.numbers[kind] = numbers if known is None else np.concatenate([known, numbers])

    def places(self, kind, digits=9):
        """Cells of a kind as corners in their order, the least first: what two readers must agree on."""
        at = np.round(self.points[self.cells[kind]], digits) + 0.0
        return sorted(tuple(map(tuple, cell)) for cell in at)


def installed(name):
    try:
        __import__(name)
        return True
    except ImportError:
        print(f"left out: {name} is not installed")
        return False


def read_gmsh(path):
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    try:
        gmsh.open(str(path))
        tags, xyz, _ = gmsh.model.mesh.getNodes()
        at = {int(t): i for i, t in enumerate(tags)}
        mesh = Mesh(xyz, np.array(tags, dtype=np.int64))
        for kind, numbers, nodes in zip(*gmsh.model.mesh.getElements()):
            if kind in GMSH:
                mesh.add(GMSH[kind], [at[int(n)] for n in nodes], numbers)
        for dim, tag in gmsh.model.getPhysicalGroups():
            count = sum(len(part) for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, tag)
                        for part in gmsh.model.mesh.getElements(dim, entity)[1])
            name = gmsh.model.getPhysicalName(dim, tag) or (dim, tag)
            mesh.groups[name] = max(mesh.groups.get(name, 0), count)
    finally:
        gmsh.finalize()
    return mesh


def read_meshio(path, form=None):
    import meshio
    found = meshio.read(path, form)
    mesh = Mesh(found.points)
    for block in found.cells:
        if block.type in CORNERS:
            mesh.add(block.type, block.data)
    if "nastran:ref" in found.cell_data:
        for ref, many in zip(*np.unique(np.concatenate(found.cell_data["nastran:ref"]), return_counts=True)):
            mesh.groups[int(ref)] = int(many)
    return mesh


def read_vtk(path):
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    path = pathlib.Path(path)
    reader = vtk.vtkXMLUnstructuredGridReader() if path.suffix == ".vtu" else vtk.vtkUnstructuredGridReader()
    reader.SetFileName(str(path))
    if path.suffix == ".vtk":
        reader.ReadAllScalarsOn()
    reader.Update()
    grid = reader.GetOutput()
    numbers = grid.GetPointData().GetArray("node_number")
    mesh = Mesh(vtk_to_numpy(grid.GetPoints().GetData()), None if numbers is None else vtk_to_numpy(numbers))
    array = grid.GetCellData().GetArray("cell_number")
    cell_number = None if array is None else vtk_to_numpy(array)
    of_kind = {}
    for c in range(grid.GetNumberOfCells()):
        of_kind.setdefault(grid.GetCellType(c), []).append(c)
    for kind, cells in of_kind.items():
        if kind in VTK:
            # VTK's wedges have the first triangle look outward, meshio's inward.
            order = [0, 2, 1, 3, 5, 4] if VTK[kind] == "wedge" else range(CORNERS[VTK[kind]])
            nodes = [[grid.GetCell(c).GetPointId(k) for k in order] for c in cells]
            mesh.add(VTK[kind], nodes, None if cell_number is None else cell_number[cells])
            if grid.GetCellData().HasArray("region"):
                mesh.regions[VTK[kind]] = vtk_to_numpy(grid.GetCellData().GetArray("region"))[cells]
    entity = grid.GetCellData().GetArray("entity")
    field = grid.GetFieldData()
    for a in range(field.GetNumberOfArrays() if entity is not None else 0):
        inside = np.isin(vtk_to_numpy(entity), vtk_to_numpy(field.GetArray(a)))
        mesh.groups[field.GetArray(a).GetName()] = int(inside.sum())
    return mesh


def read_exodus(path):
    """By the names that the format agrees on."""
    import netCDF4
    with netCDF4.Dataset(path) as file:
        text = lambda name: [b"".join(row).split(b"\0")[0].decode() for row in file.variables[name][:].filled(b"\0")]
        points = np.column_stack([file.variables["coord" + axis][:] for axis in "xyz"])
        mesh = Mesh(points, np.array(file.variables["node_num_map"][:]))
        numbers, at = file.variables["elem_num_map"][:], 0
        for b, name in enumerate(text("eb_names"), 1):
            block = file.variables[f"connect{b}"]
            rows = np.array(block[:]) - 1
            kind = EXODUS.get(block.elem_type)
            if kind is not None:
                mesh.add(kind, rows[:, :CORNERS[kind]], numbers[at:at + len(rows)])
            mesh.groups[name] = mesh.groups.get(name, 0) + len(rows)
            at += len(rows)
    return mesh
