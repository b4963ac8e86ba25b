#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Real decks written in every format and read by others: the same nodes, cells, numbers and sets.

usage: round_trips.py REWRITE FOLDER    REWRITE reads a deck and writes it, FOLDER holds the decks. Exit 77 where the
folder or every other reader is missing.
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

# The reader that takes the deck as it stands, what it is in, and groups that must come out in every format by name.
DECKS = {
    "contact_model.bdf": ("meshio", {"hexahedron": 675}, {"pid:1": 225, "pid:2": 225, "pid:3": 225}),
    "wingbox.bdf": ("meshio", {"quad": 2464}, {}),
    "codim_1-tube.inp": ("meshio", {"quad": 96}, {}),
    "nested_cubes.msh": ("gmsh", {"triangle": 240, "tetra": 520}, {}),
    "salome_cube.unv": ("gmsh", {"quad": 150, "hexahedron": 125}, {}),
}
READ = {"gmsh": readers.read_gmsh, "meshio": readers.read_meshio, "vtk": readers.read_vtk,
        "netCDF4": readers.read_exodus}
# What is written, who reads it, and how near coordinates are, of their size.
TARGETS = [
    ("a.bdf", [], ["meshio", "gmsh"], 1e-9),
    ("a.inp", [], ["meshio"], 1e-13),
    ("a.unv", [], ["gmsh"], 1e-15),
    ("a.msh", [], ["gmsh", "meshio"], 0),
    ("t.msh", ["text"], ["gmsh", "meshio"], 0),
    ("old.msh", ["2.2"], ["gmsh"], 0),
    ("oldt.msh", ["2.2", "text"], ["gmsh", "meshio"], 0),
    ("a.vtk", [], ["vtk", "meshio"], 0),
    ("t.vtk", ["text"], ["vtk", "meshio"], 0),
    ("a.vtu", [], ["vtk", "meshio"], 0),
    ("a.exo", [], ["netCDF4", "meshio"], 0),
]


def compare(what, found, given, kinds, near):
    for kind, count in kinds.items():
        assert len(found.cells.get(kind, [])) == count, (what, kind, {k: len(v) for k, v in found.cells.items()})
        size = max(1, np.abs(given.points).max())
        # By their corners' places, in their order: coordinates that a format rounds are rounded alike.
        digits = 9 if near == 0 else max(0, int(-np.log10(near * size)) - 2)
        assert found.places(kind, min(digits, 9)) == given.places(kind, min(digits, 9)), (what, kind)
        if near == 0:
            exact = lambda mesh: sorted(map(tuple, mesh.points[np.unique(mesh.cells[kind])]))
            assert exact(found) == exact(given), (what, kind)
    for kind in kinds:
        if kind in found.numbers and kind in given.numbers:
            assert sorted(found.numbers[kind]) == sorted(given.numbers[kind]), (what, kind, "numbers")
            order = np.argsort(found.numbers[kind]), np.argsort(given.numbers[kind])
            nodes = [mesh.node_numbers[mesh.cells[kind][by]] for mesh, by in zip((found, given), order)]
            assert np.array_equal(*nodes), (what, kind, "nodes by number")


def main():
    rewrite, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    if not folder.is_dir():
        print(f"skipped: {folder} is not here")
        return 77
    here = {name for name in READ if readers.installed(name)}
    if not here:
        return 77
    done = 0
    with tempfile.TemporaryDirectory() as scratch:
        for name, (reader, kinds, groups) in DECKS.items():
            if not (folder / name).exists() or reader not in here:
                print(f"skipped: {name} or {reader} is not here")
                continue
            given = READ[reader](folder / name)
            numbered = READ["gmsh"](folder / name) if "gmsh" in here and not name.endswith(".inp") else None
            for file, words, who, near in TARGETS:
                out = pathlib.Path(scratch, file)
                run = subprocess.run([rewrite, folder / name, out, *words], capture_output=True, text=True)
                assert run.returncode == 0, (name, file, run.stderr)
                for other in who:
                    # meshio reads Exodus by netCDF4.
                    if other not in here or (file == "a.exo" and not readers.installed("netCDF4")):
                        continue
                    found = READ[other](out, "exodus") if other == "meshio" and file == "a.exo" else READ[other](out)
                    what = f"{name} as {file} by {other}"
                    # Gmsh's own reading of the deck where it tells numbers; it drops nodes that no cell has.
                    compare(what, found, numbered if numbered is not None and found.numbers else given, kinds, near)
                    for group, count in groups.items():
                        if group in found.groups or (other in ("gmsh", "vtk") and not file.endswith((".bdf", ".unv"))):
                            assert found.groups.get(group) == count, (what, group, found.groups)
                    if given.groups and file.endswith(name[-4:]) and other == reader:
                        assert found.groups == given.groups, (what, found.groups, given.groups)
                    done += 1
            print(f"{name}: the same in {len(TARGETS)} files")
    print(f"{done} readings")
    return 0


sys.exit(main())
