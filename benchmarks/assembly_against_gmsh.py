#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Members of assemblies by Lacuna and by Gmsh, where Gmsh can mesh them in hexahedra at all.

usage: assembly_against_gmsh.py LACUNA [RESULTS.md]

Gmsh gets what a person would do by hand: boxes fragmented, every curve, surface and volume transfinite and
recombined. What has no six-sided volumes has no transfinite mesh; there the row says so. Quality is the scaled
Jacobian at the corners, computed here for both.
"""
import os
import subprocess
import sys
import tempfile

import gmsh
import numpy as np

# Boxes as (corner, size), meshed with a size.
CASES = {
    "row of 3": ([((0, 0, 0), (1, 1, 1)), ((1, 0, 0), (2, 1, 1)), ((3, 0, 0), (1, 1, 1))], 0.2),
    "grid of 8": ([((i, j, k), (1, 1, 1)) for i in (0, 1) for j in (0, 1) for k in (0, 1)], 0.2),
    "L of 3": ([((0, 0, 0), (1, 1, 1)), ((1, 0, 0), (1, 1, 1)), ((0, 1, 0), (1, 1, 1))], 0.2),
    "part of a face": ([((0, 0, 0), (3, 2, 1)), ((1, 0.5, 1), (1, 1, 1))], 0.25),
    "over a corner": ([((0, 0, 0), (3, 2, 1)), ((2, 1, 1), (2, 2, 1))], 0.25),
}

RECIPE = """
local lacuna = require "lacuna"
local volumes = {}
for i, b in ipairs { %s } do
  local x, y, z, a, c, h = table.unpack(b)
  local model = lacuna.model()
  for name, at in pairs { low = z, high = z + h } do
    model:add_face { name = name, points = { { x, y, at }, { x + a, y, at }, { x + a, y + c, at }, { x, y + c, at } },
      cells = { { 1, 2, 3, 4 } } }
  end
  volumes[i] = model:open_volume { source = "low", target = "high" }
end
lacuna.assembly(volumes):sweep { size = %g }:write("%s")
"""


def scaled_jacobians(path):
    """Least corner value of each hexahedron of a mesh file."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(path)
    tags, places, _ = gmsh.model.mesh.getNodes()
    at = dict(zip(tags, places.reshape(-1, 3)))
    _, cells = gmsh.model.mesh.getElementsByType(5)
    corners = np.array([at[n] for n in cells]).reshape(-1, 8, 3)
    beside = [(1, 3, 4), (2, 0, 5), (3, 1, 6), (0, 2, 7), (7, 5, 0), (4, 6, 1), (5, 7, 2), (6, 4, 3)]
    least = np.full(len(corners), 1.0)
    for c, (a, b, d) in enumerate(beside):
        u, v, w = (corners[:, n] - corners[:, c] for n in (a, b, d))
        lengths = np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1) * np.linalg.norm(w, axis=1)
        least = np.minimum(least, np.einsum("ij,ij->i", np.cross(u, v), w) / lengths)
    gmsh.finalize()
    return least


def in_a_process(work, *arguments):
    """What `work` says, or that it ended its process: Gmsh does where a surface has no four corners."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        os.write(write, (work(*arguments) or "").encode())
        os._exit(0)
    os.close(write)
    _, status = os.waitpid(child, 0)
    said = os.read(read, 10000).decode()
    return said or ("Gmsh ends: no transfinite mesh" if status else None)


def by_gmsh(boxes, size, path):
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for corner, sides in boxes:
        gmsh.model.occ.addBox(*corner, *sides)
    volumes = gmsh.model.occ.getEntities(3)
    gmsh.model.occ.fragment(volumes[:1], volumes[1:])
    gmsh.model.occ.synchronize()
    for _, curve in gmsh.model.getEntities(1):
        length = gmsh.model.occ.getMass(1, curve)
        gmsh.model.mesh.setTransfiniteCurve(curve, round(length / size) + 1)
    try:
        for _, surface in gmsh.model.getEntities(2):
            gmsh.model.mesh.setTransfiniteSurface(surface)
            gmsh.model.mesh.setRecombine(2, surface)
        for _, volume in gmsh.model.getEntities(3):
            gmsh.model.mesh.setTransfiniteVolume(volume)
        gmsh.model.mesh.generate(3)
    except Exception as error:  # Gmsh raises Exception itself
        return str(error)
    types = gmsh.model.mesh.getElementTypes(3)
    if list(types) != [5]:
        return "volumes that are not six-sided become tetrahedra"
    gmsh.write(path)
    return None


def by_lacuna(lacuna, boxes, size, path, folder):
    recipe = os.path.join(folder, "recipe.lua")
    listed = ", ".join("{ %s }" % ", ".join(map(str, (*corner, *sides))) for corner, sides in boxes)
    with open(recipe, "w") as file:
        file.write(RECIPE % (listed, size, path))
    run = subprocess.run([lacuna, recipe], capture_output=True, text=True)
    return run.stderr.strip() if run.returncode else None


def main():
    lacuna = os.path.abspath(sys.argv[1])
    rows = ["| case | volumes | Lacuna: hexahedra | least | mean | Gmsh: hexahedra | least | mean |",
            "|---|---|---|---|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as folder:
        for name, (boxes, size) in CASES.items():
            row = [name, str(len(boxes))]
            path = os.path.join(folder, "mesh.msh")
            for why in (by_lacuna(lacuna, boxes, size, path, folder), None):
                if len(row) > 2:
                    why = in_a_process(by_gmsh, boxes, size, path)
                if why:
                    row += [why.splitlines()[0][:80], "", ""]
                    continue
                found = scaled_jacobians(path)
                row += [str(len(found)), f"{found.min():.3f}", f"{found.mean():.3f}"]
            rows.append("| " + " | ".join(row) + " |")
    text = "\n".join(rows) + "\n"
    print(text, end="")
    if len(sys.argv) > 2:
        with open(sys.argv[2], "w") as file:
            file.write(text)


if __name__ == "__main__":
    main()
