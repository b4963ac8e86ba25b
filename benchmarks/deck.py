#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A deck of a million elements with a void: read, filled, written joined, beside how long meshio and Gmsh take to read it.

usage: deck.py LACUNA [--runs 3] [--cells 104] [--formats inp bdf unv msh vtu] [--keep FOLDER]

The deck is a block of `cells` by 100 by 100 hexahedra with a pit of 40 by 40 by 25 open above, its nodes moved a little.
Every reading is a process of its own; the medians count. Python's time begins after its modules are loaded. Lacuna's steps
are told apart by the lines that the recipe prints: "load" is the reading and the faces, edges and vertices of the skin;
"read" is lacuna's reader alone, from the same process by a file that has no faces to be found (`lacuna.check`, with the
quality of every cell measured as well). Results go to benchmarks/results/, one file a run.
"""
import argparse
import datetime
import json
import os
import pathlib
import platform
import resource
import statistics
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ACROSS = 100          # cells along y and z
PIT = (40, 40, 25)    # cells of the void

RECIPE = """
local lacuna = require "lacuna"
local function mark(what) io.stdout:write(what, "\\n") io.stdout:flush() end
mark "start"
local model = lacuna.load "{deck}"
mark "load"
local x0, x1, y0, y1, z0, z1 = {box}
local function face(a, b) return {{ box = {{ a, b }} }} end
local e = 0.3
local void = model:open_volume {{ name = "filling",
  source = face({{ x0 - e, y0 - e, z0 - e }}, {{ x1 + e, y1 + e, z0 + e }}),
  walls = {{ face({{ x0 - e, y0 - e, z0 - e }}, {{ x0 + e, y1 + e, z1 + e }}),
             face({{ x1 - e, y0 - e, z0 - e }}, {{ x1 + e, y1 + e, z1 + e }}),
             face({{ x0 - e, y0 - e, z0 - e }}, {{ x1 + e, y0 + e, z1 + e }}),
             face({{ x0 - e, y1 - e, z0 - e }}, {{ x1 + e, y1 + e, z1 + e }}) }} }}
local mesh = void:sweep {{ layers = {layers} }}
mark "fill"
mesh:write("{joined}", {{ with = model }})
mark "write"
print("hexes", mesh.hexes)
"""


def in_pit(cells):
    low = ((cells - PIT[0]) // 2, (ACROSS - PIT[1]) // 2, ACROSS - PIT[2])
    return low, lambda i, j, k: all(a <= x < a + w for x, a, w in zip((i, j, k), low, PIT))


def write_inp(path, cells):
    """Nodes and cells; also how many there are."""
    low, pit = in_pit(cells)
    row, layer = cells + 1, (cells + 1) * (ACROSS + 1)
    node = lambda i, j, k: 1 + i + row * j + layer * k
    inside = lambda i, j, k: all(a < x < a + w for x, a, w in zip((i, j), low, PIT)) and k > low[2]
    count = 0
    with open(path, "w") as file:
        file.write("*HEADING\na block with a pit\n*NODE\n")
        for k in range(ACROSS + 1):
            for j in range(ACROSS + 1):
                for i in range(cells + 1):
                    if not inside(i, j, k):
                        shift = 0.03 * ((7 * i + 5 * j + 3 * k) % 11 - 5) / 5
                        loose = 0 < i < cells and 0 < j < ACROSS and 0 < k < low[2]
                        file.write("%d, %.9f, %.9f, %.9f\n" % ((node(i, j, k),) + tuple(
                            x + (shift if loose else 0) for x in (i, j, k))))
        file.write("*ELEMENT, TYPE=C3D8, ELSET=block\n")
        tag = 0
        for k in range(ACROSS):
            for j in range(ACROSS):
                for i in range(cells):
                    tag += 1
                    if pit(i, j, k):
                        continue
                    count += 1
                    a, b, c, d = node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)
                    file.write("%d, %d, %d, %d, %d, %d, %d, %d, %d\n" % (
                        tag, a, b, c, d, a + layer, b + layer, c + layer, d + layer))
        file.write("*MATERIAL, NAME=steel\n*ELASTIC\n210000., .3\n*SOLID SECTION, ELSET=block, MATERIAL=steel\n")
    return count


def child(argv):
    """One reading in this process: seconds and peak memory as JSON."""
    who, path = argv
    if who == "meshio":
        import meshio
        begin = time.perf_counter()
        mesh = meshio.read(path)
        cells = sum(len(block.data) for block in mesh.cells if block.type == "hexahedron")
    else:
        import gmsh
        gmsh.initialize([], False)
        gmsh.option.setNumber("General.Terminal", 0)
        begin = time.perf_counter()
        gmsh.open(path)
        cells = len(gmsh.model.mesh.getElementsByType(5)[0])
    seconds = time.perf_counter() - begin
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(json.dumps({"seconds": seconds, "peak_mb": peak / 1024, "hexes": cells}))


def measured(command, **more):
    """Times at which the lines came, the last line, the peak [MB]."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **more)
    lines = [(time.perf_counter(), line.strip()) for line in process.stdout]
    error = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = status
    if status != 0:
        raise RuntimeError(error[-600:])
    return lines, usage.ru_maxrss / 1024


def lacuna_steps(lacuna, folder, deck, joined, cells):
    low, _ = in_pit(cells)
    box = ", ".join(str(x) for a, w in zip(low, PIT) for x in (a, a + w))
    (folder / "fill.lua").write_text(RECIPE.format(deck=deck, joined=joined, layers=PIT[2], box=box))
    lines, peak = measured([lacuna, "fill.lua"], cwd=folder)
    at = {line: when for when, line in lines}
    hexes = int(next(line.split()[1] for _, line in lines if line.startswith("hexes")))
    assert hexes == PIT[0] * PIT[1] * PIT[2], hexes
    return {"load": at["load"] - at["start"], "fill": at["fill"] - at["load"], "write": at["write"] - at["fill"],
            "peak_mb": peak}


def lacuna_read(lacuna, folder, deck):
    (folder / "read.lua").write_text('io.stdout:write("start\\n") io.stdout:flush()\n'
                                     'print(require("lacuna").check("%s").hexes)' % deck)
    lines, peak = measured([lacuna, "read.lua"], cwd=folder)
    return {"seconds": lines[-1][0] - lines[0][0], "peak_mb": peak, "hexes": int(lines[-1][1])}


def other(who, path):
    try:
        done = subprocess.run([sys.executable, __file__, "--child", who, str(path)], capture_output=True, text=True,
                              timeout=600)
    except subprocess.TimeoutExpired:
        return {"failed": "no end after 600 s"}
    if done.returncode != 0:
        return {"failed": (done.stderr.strip().splitlines() or ["?"])[-1][:200]}
    return json.loads(done.stdout.splitlines()[-1])


def median(rows):
    good = [row for row in rows if "failed" not in row]
    return {key: statistics.median(row[key] for row in good) for key in good[0]} if good else rows[0]


def main():
    if sys.argv[1:2] == ["--child"]:
        return child(sys.argv[2:])
    say = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    say.add_argument("lacuna", type=pathlib.Path)
    say.add_argument("--runs", type=int, default=3)
    say.add_argument("--cells", type=int, default=104, help="along x; 104: a million in all")
    say.add_argument("--formats", nargs="+", default=["inp", "bdf", "unv", "msh", "vtu"])
    say.add_argument("--keep", type=pathlib.Path, help="where the decks stay")
    args = say.parse_args()
    lacuna = str(args.lacuna.resolve())
    found = {"machine": platform.machine(), "cpus": os.cpu_count(), "runs": args.runs, "formats": {}}
    with tempfile.TemporaryDirectory() as scratch:
        folder = args.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        count = write_inp(folder / "deck.inp", args.cells)
        found["elements"] = count
        for kind in args.formats:
            deck, joined = folder / ("deck." + kind), folder / ("joined." + kind)
            if kind != "inp":  # the joined deck of the format before, as this one: the void filled; then read alone
                lacuna_steps(lacuna, folder, folder / "deck.inp", deck, args.cells)
            rows = {"lacuna": [], "meshio": [], "gmsh": []}
            steps = []
            for _ in range(args.runs):
                rows["lacuna"].append(lacuna_read(lacuna, folder, deck))
                for who in ("meshio", "gmsh"):
                    if not rows[who] or "failed" not in rows[who][0]:
                        rows[who].append(other(who, deck))
                if kind == "inp":
                    steps.append(lacuna_steps(lacuna, folder, deck, joined, args.cells))
            row = {who: median(all_of) for who, all_of in rows.items()}
            row["megabytes"] = deck.stat().st_size / 1e6
            if steps:
                row["steps"] = median(steps)
            found["formats"][kind] = row
            print(kind, json.dumps(row), flush=True)
    stamp = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H%M%SZ")
    (HERE / "results" / ("deck_%s.json" % stamp)).write_text(json.dumps(found, indent=1) + "\n")
    return 0


sys.exit(main())
