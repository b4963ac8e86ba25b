#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Voids of real decks from the files alone: loaded, faces picked by selectors, swept, joined with their deck.

usage: from_files.py LACUNA DATA JUDGE [CASE]    Exit 77 where the data or the judge is not there.

DATA holds fem/, stl/ and cases.json. JUDGE is run_discrete.py, which reads the decks and the meshes itself: a mesh must be
valid, of the case's class, have every node of the given rims, and every given quad as a face; STL files hold no mesh. In the joined deck, read by
JUDGE too, numbers and places of the deck stay, and each given quad is by its nodes' numbers a face of the new cells.
"""
import collections
import json
import os
import pathlib
import runpy
import subprocess
import sys
import tempfile
import types

HOLE = "near = {{ {0}, {1}, {2} }}, radius = {{ {3}, {4} }}"
RECESS = "box = { { 26.8, 8.0, -13.0 }, { 29.0, 9.9, -10.8 } }"
CUBE = {n: "name = '%d'" % n for n in range(1, 7)}


def block(axis, value):
    return "region = 'pid:2', facing = { %s }" % ", ".join(str(value if a == axis else 0) for a in range(3))


def core(x, y, z):
    return "near = { %g, %g, %g }" % (x, y, z)


CORE = {7: core(.5, .5, .25), 8: core(.5, .5, .75), 9: core(.5, .25, .5), 10: core(.75, .5, .5), 11: core(.5, .75, .5),
        12: core(.25, .5, .5), 2: core(.5, .5, 1)}

# (source, target, walls) as selectors, by file and case.
CASES = {
    ("contact_model.bdf", "gap12-I"): (["region = 'pid:1', facing = { 1, 0, 0 }"], ["region = 'pid:2', facing = { -1, 0, 0 }"], []),
    ("contact_model.bdf", "block2-II"): ([block(2, -1)], [block(2, 1)], [block(0, -1)]),
    ("contact_model.bdf", "block2-III"): ([block(2, -1)], [block(2, 1)], [block(0, -1), block(0, 1), block(1, -1)]),
    ("contact_model.bdf", "block2-IV"): ([block(2, -1)], [], [block(a, s) for a in (0, 1) for s in (-1, 1)]),
    ("contact_model.bdf", "block2-V"): ([], [], [block(a, s) for a in (0, 1) for s in (-1, 1)]),
    ("wingbox.bdf", "skin-V"): ([], [], ["name = 'pid:2'"]),
    ("codim_1-tube.inp", "tube-V"): ([], [], ["kind = 'discrete'"]),
    ("salome_cube.unv", "cube-I"): ([CUBE[5]], [CUBE[6]], []),
    ("salome_cube.unv", "cube-II"): ([CUBE[5]], [CUBE[6]], [CUBE[1]]),
    ("salome_cube.unv", "cube-III"): ([CUBE[5]], [CUBE[6]], [CUBE[1], CUBE[2], CUBE[4]]),
    ("salome_cube.unv", "cube-IV"): ([CUBE[5]], [], [CUBE[n] for n in (1, 2, 3, 4)]),
    ("salome_cube.unv", "cube-V"): ([], [], [CUBE[n] for n in (1, 2, 3, 4)]),
    ("bracket_01.stl", "hole(0,-13)-V"): ([], [], ["box = { { -5.1, -19.1, 29.9 }, { 5.1, -6.9, 42.1 } }"]),
    ("bracket_01.stl", "hole(32,-19)-V"): ([], [], [HOLE.format(31.5, -19, 5, 2.9, 3.1)]),
    ("bracket_01.stl", "hole(32,19)-V"): ([], [], [HOLE.format(31.5, 19, 5, 2.9, 3.1)]),
    ("bracket_01.stl", "hole(-32,-19)-V"): ([], [], [HOLE.format(-31.5, -19, 5, 2.9, 3.1)]),
    ("bracket_01.stl", "hole(-32,19)-V"): ([], [], [HOLE.format(-31.5, 19, 5, 2.9, 3.1)]),
    ("hollow_brick_2x4.stl", "recess-IV"): ([RECESS + ", area = { 3, 3.5 }"], [], [RECESS + ", area = { 10, 11 }"]),
    ("hollow_brick_2x4.stl", "recess-V"): ([], [], [RECESS + ", area = { 10, 11 }"]),
    ("nested_cubes.msh", "frustum-I"): ([CORE[8]], [CORE[2]], []),
    ("nested_cubes.msh", "core-I"): ([CORE[7]], [CORE[8]], []),
    ("nested_cubes.msh", "core-II"): ([CORE[7]], [CORE[8]], [CORE[9]]),
    ("nested_cubes.msh", "core-III"): ([CORE[7]], [CORE[8]], [CORE[9], CORE[10], CORE[11]]),
    ("nested_cubes.msh", "core-IV"): ([CORE[7]], [], [CORE[n] for n in (9, 10, 11, 12)]),
    ("nested_cubes.msh", "core-V"): ([], [], [CORE[n] for n in (9, 10, 11, 12)]),
}

# Rims with an odd number of sides, which no quads fill: one side is divided, so the mesh and its deck do not conform there.
ODD = {("wingbox.bdf", "skin-V")}

RECIPE = """local lacuna = require "lacuna"
local model = lacuna.load "{path}"
local void = model:open_volume {{ name = "foam", {roles} }}
print("class", void.class)
local mesh = void:sweep {{ layers = {layers}, size = {size!r} }}
mesh:write("mesh.msh", {{ groups = "all" }})
if "{joined}" ~= "" then mesh:write("{joined}", {{ with = model }}) end
"""


def list_of(selectors):
    return "{ " + ", ".join("{ %s }" % s for s in selectors) + " }"


def check_joined(judge, before, path, quads, hexes):
    after = judge.read(path)
    at = {}
    for fem, found in ((before, {}), (after, at)):
        for number, cell in zip(fem.ids, fem.cells):
            found[number] = fem.points[list(cell)]
        if fem is before:
            old = found
    diagonal = max(before.points.max(axis=0) - before.points.min(axis=0))
    for number, corners in old.items():
        if number not in at or abs(at[number] - corners).max() > 1e-7 * diagonal:
            return "element %d of the deck is not there, or elsewhere" % number
    new = [c for c, number, kind in zip(after.cells, after.ids, after.kind) if kind == "hex" and number not in old]
    if len(new) != hexes:
        return "%d new cells, not %d" % (len(new), hexes)
    count = collections.Counter(frozenset(c[i] for i in side) for c in new for side in judge.SIDES["hex"])
    skin = {face for face, users in count.items() if users == 1}
    kept = {number: cell for number, cell in zip(after.ids, after.cells) if number in old}
    # The deck's faces by their numbers there: corners of kept cells at the same places.
    place = {tuple(round(float(x), 9) for x in before.points[n]): None for face in quads for n in face}
    if len(place) != len({n for face in quads for n in face}):
        return None  # coincident nodes of the deck: their numbers are ambiguous here
    for cell in kept.values():
        for n in cell:
            key = tuple(round(float(x), 9) for x in after.points[n])
            if key in place:
                place[key] = n
    missing = sum(frozenset(place[tuple(round(float(x), 9) for x in before.points[n])] for n in face) not in skin
                  for face in quads)
    return "%d of %d given quads are no faces of the new cells" % (missing, len(quads)) if missing else None


def run(judge, lacuna, data, case, folder):
    file = data / case["file"]
    fem = judge.read(file)
    fem.entities = file.suffix == ".msh"
    source, target, walls = judge.SELECT[case["file"]](fem, case["case"])
    rows = judge.rows(fem.points, source, target, walls)
    layers, size = judge.spacing(fem.points, source, target, walls, len(rows))
    named = CASES[file.name, case["case"]]
    roles = ", ".join("%s = %s" % (role, list_of(of)) for role, of in zip(("source", "target", "walls"), named) if of)
    quads = [f for faces in (source, target, walls) for f in faces if len(f) == 4]
    triangles = any(len(f) == 3 for faces in (source, target, walls) for f in faces)
    odd = (file.name, case["case"]) in ODD
    joined = "joined" + file.suffix if quads and not triangles and not odd else ""
    (folder / "case.lua").write_text(RECIPE.format(path=file, roles=roles, layers=layers, size=size, joined=joined))
    done = subprocess.run([lacuna, "case.lua"], cwd=folder, capture_output=True, text=True, timeout=120)
    if done.returncode != 0:
        return "refused: " + done.stderr.strip()[:300]
    if "class\t" + case["cls"] not in done.stdout:
        return "not of class " + case["cls"]
    _, _, groups, _ = judge.read_hexes(folder / "mesh.msh")
    given = [name for name in groups if name.startswith("wall:")]
    found = judge.judge(folder / "mesh.msh", fem.points, source, target, walls, given, size)
    if found["faults"]:
        return "; ".join(found["faults"])
    for what in ("source", "target", "walls"):
        if judge.conforms(found, what) is False and not odd:
            return "%s: %.3f of its quads kept" % (what, found[what])
    if found["rim"] is not None and found["rim"] != 1 and file.suffix != ".stl":  # whose facets are no mesh
        return "%.3f of the rims' nodes are there" % found["rim"]
    if not joined:
        return None
    return check_joined(judge, fem, folder / joined, quads, found["hexes"])


def main():
    lacuna, data, tool = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    only = sys.argv[4] if len(sys.argv) > 4 else ""
    if not (data / "cases.json").exists() or not tool.exists():
        print("left out: the decks and their judge are not there")
        return 77
    try:
        import gmsh
        import numpy  # noqa: F401
    except ImportError as missing:
        print("left out:", missing)
        return 77
    judge = types.SimpleNamespace(**runpy.run_path(str(tool)))
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    faults = 0
    cases = json.loads((data / "cases.json").read_text())["discrete"]
    if not only and not os.environ.get("LACUNA_WHOLE_FAMILIES"):
        cases = cases[::3]  # of every format and every class
    for case in cases:
        if only not in case["file"] + " " + case["case"]:
            continue
        with tempfile.TemporaryDirectory() as folder:
            wrong = run(judge, lacuna, data.resolve(), case, pathlib.Path(folder))
        faults += wrong is not None
        print(case["file"], case["case"], wrong or "is right", flush=True)
    print(len(cases), "cases,", faults, "faults")
    gmsh.finalize()
    return 1 if faults else 0


sys.exit(main())
