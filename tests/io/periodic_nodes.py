#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""periodic_nodes.py PROGRAM: Gmsh reads $Periodic, in text and binary; the nodes of each surface are the
images of their masters. Gmsh 4.8 does not read back even its own $Periodic of version 2.2. Exit code 77: there
is no Gmsh for Python."""
import pathlib
import subprocess
import sys
import tempfile

try:
    import gmsh
except ImportError:
    print("Gmsh for Python is not here")
    sys.exit(77)

RECIPE = """
local lacuna = require "lacuna"
local part = lacuna.synthetic.prism { sides = 4, radius = 1, height = 1, holes = 1 }
local void = part:open_volume { source = "source", target = "target", walls = "auto" }
local mesh = void:sweep { layers = 2, size = 0.6,
  periodic = { { "wall_1", "wall_3" }, { "wall_2", "wall_4" }, { "source", "target" } } }
for _, binary in ipairs { true, false } do mesh:write(("cell_%s.msh"):format(binary), { binary = binary }) end
"""


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        recipe = pathlib.Path(folder, "cell.lua")
        recipe.write_text(RECIPE)
        subprocess.run([program, recipe], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        files = sorted(pathlib.Path(folder).glob("*.msh"))
        assert len(files) == 2
        for path in files:
            gmsh.initialize([], False)
            gmsh.option.setNumber("General.Terminal", 0)
            gmsh.open(str(path))
            places = {}
            tags, coordinates, _ = gmsh.model.mesh.getNodes()
            for i, tag in enumerate(tags):
                places[tag] = coordinates[3 * i:3 * i + 3]
            pairs = 0
            for _, surface in gmsh.model.getEntities(2):
                master, slaves, masters, affine = gmsh.model.mesh.getPeriodicNodes(2, surface)
                if master == surface:
                    continue
                assert len(slaves) == len(masters) > 3, path.name
                pairs += 1
                for slave, node in zip(slaves, masters):
                    for i in range(3):
                        image = sum(affine[4 * i + j] * places[node][j] for j in range(3)) + affine[4 * i + 3]
                        assert abs(image - places[slave][i]) < 1e-14, path.name
            assert pairs == 3, (path.name, pairs)
            gmsh.finalize()
    print("Gmsh reads 3 pairs of surfaces of", len(files), "files")


main()
