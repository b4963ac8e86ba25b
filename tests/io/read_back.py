#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What others read from files with quality: Gmsh, meshio and VTK, each where it is installed.

usage: read_back.py LACUNA    Exit 77 where none is.
"""
import pathlib
import struct
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
local void = lacuna.synthetic.prism { sides = 6, holes = 1, twist = 30 }:open_volume()
void:close()
local mesh = void:sweep { layers = 7 }
local quality = mesh:quality()
mesh:write "default.msh"
mesh:write("text.msh", { binary = false })
mesh:write("old.msh", { version = 2.2, quality = true })
mesh:write("default22.msh", { version = 2.2 })
mesh:write("many.msh", { quality = { "shape", "skew", "scaled_jacobian" } })
mesh:write("none.msh", { quality = false })
mesh:write "a.vtu"
mesh:write "a.vtk"
mesh:write("text.vtk", { binary = false })
print(mesh.hexes, ("%.17g"):format(quality.min_scaled_jacobian), ("%.17g"):format(quality.metrics.shape.min))
"""

FIELDS = {"default.msh": ["scaled_jacobian"], "text.msh": ["scaled_jacobian"], "old.msh": ["scaled_jacobian"],
          "default22.msh": [], "many.msh": ["scaled_jacobian", "shape", "skew"], "none.msh": []}
MESHIO_REFUSES = {"old.msh"}  # meshio 5 reads no element data in version 2.2


def read_gmsh(path):
    """Least value and number of values of each view, by name."""
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(str(path))
    found = {}
    for view in gmsh.view.getTags():
        kind, elements, values, _, components = gmsh.view.getModelData(view, 0)
        assert (kind, components) == ("ElementData", 1)
        name = gmsh.option.getString(f"View[{gmsh.view.getIndex(view)}].Name")
        found[name] = (len(elements), min(value[0] for value in values))
    count = sum(len(tags) for tags in gmsh.model.mesh.getElements()[1])
    hexes = sum(len(tags) for tags in gmsh.model.mesh.getElements(3)[1])
    gmsh.finalize()
    return found, count, hexes


def read_meshio(path):
    import meshio
    mesh = meshio.read(path)
    count = sum(len(block.data) for block in mesh.cells)
    hexes = sum(len(block.data) for block in mesh.cells if block.type == "hexahedron")
    found = {name: (sum(map(len, data)), min(part.min() for part in data))
             for name, data in mesh.cell_data.items() if not name.startswith("gmsh:")}
    return found, count, hexes


def read_vtk(path):
    import vtk
    reader = vtk.vtkXMLUnstructuredGridReader() if path.suffix == ".vtu" else vtk.vtkUnstructuredGridReader()
    reader.SetFileName(str(path))
    if path.suffix == ".vtk":
        reader.ReadAllScalarsOn()
    reader.Update()
    grid = reader.GetOutput()
    data = grid.GetCellData()
    arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    hexes = sum(grid.GetCellType(i) == vtk.VTK_HEXAHEDRON for i in range(grid.GetNumberOfCells()))
    found = {a.GetName(): (a.GetNumberOfTuples(), a.GetRange()[0]) for a in arrays if a.GetName() != "entity"}
    return found, grid.GetNumberOfCells(), hexes


def in_single(value):
    """Rounded to single precision, in which files have scaled Jacobians."""
    return struct.unpack("f", struct.pack("f", value))[0]


def main():
    here = [(module, read, files) for module, read, files in
            [("gmsh", read_gmsh, list(FIELDS)), ("meshio", read_meshio, sorted(set(FIELDS) - MESHIO_REFUSES)),
             ("vtk", read_vtk, ["a.vtu", "a.vtk", "text.vtk"])] if readers.installed(module)]
    if not here:
        return 77
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "write.lua").write_text(RECIPE)
        run = subprocess.run([sys.argv[1], "write.lua"], cwd=folder, capture_output=True, text=True, check=True)
        words = run.stdout.split()
        hexes, least = int(words[0]), {"scaled_jacobian": in_single(float(words[1])), "shape": float(words[2])}
        for module, read, files in here:
            for name in files:
                found, count, found_hexes = read(pathlib.Path(folder, name))
                assert found_hexes == hexes, (module, name, found_hexes, hexes)
                expected = FIELDS.get(name, ["scaled_jacobian"])
                assert sorted(found) == expected, (module, name, sorted(found), expected)
                for field, (values, smallest) in found.items():
                    assert values == count, (module, name, field, values, count)
                    if field in least:
                        assert smallest == least[field], (module, name, field, smallest, least[field])
                print(f"{module} reads {name}: {count} cells, {', '.join(found) or 'no fields'}")
    return 0


sys.exit(main())
