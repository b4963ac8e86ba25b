#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Models that were slow once, and how the time of each stage grows: each bar, the figure, met or not.

usage: corners.py LACUNA [--runs 5] [--only assembly,plate,loops,bodies,gaps,stator,cylinders,blade,start,sources,
                                             median,longest,growth]
                  [--data FOLDER] [--folder /tmp] [--output CORNERS.jsonl] [--picture CORNERS.svg]

Inputs are made here. Figures are seconds of the processor of whole processes, without the CAD process, and medians of
`runs`; the start, and the sweeps of the CAD files below `--data`, are the clock's. Small sources are compared with
Gmsh by `pave/against_gmsh.py`, with the bench_pave of the build. Growth is the power of the processor seconds of each
stage over four sizes, of six families: plates with holes, bundles of tubes, honeycombs, assemblies of boxes, scanned
tubes, perforated drums; stages below 0.05 s at the largest size are not judged. The exit code is 1 where a bar is
missed. Inputs of CAD need python3-gmsh; without it their bars are unmeasured.
"""
import argparse
import json
import math
import os
import pathlib
import random
import resource
import statistics
import struct
import subprocess
import sys
import tempfile
import time

from bars import Bars, power

try:
    import gmsh
except ImportError:
    gmsh = None

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE / "pave"))
import against_gmsh  # noqa: E402

GROWTH = 1.15  # largest power of a stage
LEAST = 0.05   # seconds of a stage that is judged [s]


class Unmeasured(Exception):
    pass


def seconds_of(command, folder):
    """Processor seconds of a process and its children, and what it printed."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip().splitlines()[-1])
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def recipe(folder, text):
    path = folder / "recipe.lua"
    path.write_text('local lacuna = require "lacuna"\n' + text)
    return [str(path)]


def run(options, folder, text):
    return seconds_of([options.lacuna, "--quiet"] + recipe(folder, text), folder)


# --- inputs ---------------------------------------------------------------------------------------------------

def cad(folder, name, build):
    """A STEP file of what `build` makes with Gmsh's Open CASCADE."""
    if gmsh is None:
        raise Unmeasured("python3-gmsh is missing")
    gmsh.initialize(["corners"], readConfigFiles=False)
    gmsh.option.setNumber("General.Terminal", 0)
    build(gmsh.model.occ)
    gmsh.model.occ.synchronize()
    gmsh.write(str(folder / name))
    gmsh.finalize()


def holed_plate(rows):
    def build(occ):
        holes = [(3, occ.addCylinder(5 + 10 * i, 5 + 10 * k, -1, 0, 0, 7, 3)) for i in range(rows) for k in range(rows)]
        occ.cut([(3, occ.addBox(0, 0, 0, 10 * rows, 10 * rows, 5))], holes)
    return build


def boxes_with_bores(count):
    def build(occ):
        one, _ = occ.cut([(3, occ.addBox(0, 0, 0, 8, 8, 5))], [(3, occ.addCylinder(4, 4, -1, 0, 0, 7, 2))])
        for k in range(1, count):
            occ.translate(occ.copy(one), 10 * (k % 13), 10 * (k // 13), 0)
    return build


def stator(occ):
    slots = [(3, occ.addCylinder(0, 0, -1, 0, 0, 32, 30))]
    for k in range(4):
        slots.append((3, occ.addBox(25, -4, -1, 15, 8, 32)))
        occ.rotate(slots[-1:], 0, 0, 0, 0, 0, 1, k * math.pi / 2)
    occ.cut([(3, occ.addCylinder(0, 0, 0, 0, 0, 30, 50))], slots)


def crossing_cylinders(occ):
    one, two, three = (occ.addCylinder(*(-5 * x for x in way), *(10 * x for x in way), 2)
                       for way in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    occ.fuse([(3, one)], [(3, two), (3, three)])


def stl(path, facets):
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(facets)))
        for a, b, c in facets:
            file.write(struct.pack("<12fH", 0, 0, 0, *a, *b, *c, 0))


def quad(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def box_facets(x, y, z, side):
    p = [(x + side * (k & 1), y + side * (k >> 1 & 1), z + side * (k >> 2)) for k in range(8)]
    return [t for q in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
            for t in quad(*(p[k] for k in q))]


def loose_sheet(rows, gap):
    """A sheet of facets, each corner moved by up to `gap`, so that no two facets share one."""
    dice = random.Random(1)

    def at(i, k):
        return (i / rows, k / rows, 0.1 * math.sin(9 * i / rows) * math.cos(7 * k / rows))
    return [tuple(tuple(x + gap * (dice.random() - 0.5) for x in point) for point in triangle)
            for i in range(rows) for k in range(rows)
            for triangle in quad(at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1))]


PLATES = """
local n = %d
local function plate(z, turned)
  local points, cells, m = {}, {}, 2 * n + 1
  for j = 0, m do for i = 0, m do points[#points + 1] = { i, j, z } end end
  local function id(i, j) return j * (m + 1) + i + 1 end
  for j = 0, m - 1 do
    for i = 0, m - 1 do
      if i %% 2 == 0 or j %% 2 == 0 then
        local a, b, c, d = id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)
        cells[#cells + 1] = turned and { a, d, c, b } or { a, b, c, d }
      end
    end
  end
  return points, cells
end
local model = lacuna.model()
local points, cells = plate(0, true)
model:add_face { name = "low", points = points, cells = cells }
points, cells = plate(1, false)
model:add_face { name = "high", points = points, cells = cells }
local volume = model:open_volume { source = "low", target = "high" }
local start = os.clock()
volume:match {}
print(os.clock() - start)
"""

BLADE = """
local n, rows = %d, 15
local function at(k, up)
  local u = 2 * math.pi * k / n
  local x, y = 0.5 * (1 + math.cos(u)), 0.06 * math.sin(u) * (1 + math.cos(u) / 2) + 0.02 * math.sin(math.pi * 0.5 * (1 + math.cos(u)))
  local turn = math.rad(5) * up
  return { x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn), up }
end
local points, cells = {}, {}
for j = 0, rows do for k = 0, n - 1 do points[#points + 1] = at(k, j / rows) end end
for j = 0, rows - 1 do
  for k = 0, n - 1 do
    local a, b = j * n + k + 1, j * n + (k + 1) %% n + 1
    cells[#cells + 1] = { a, b, b + n, a + n }
  end
end
local model = lacuna.model()
model:add_face { name = "blade", points = points, cells = cells }
local mesh = model:open_volume { walls = "blade" }:sweep { layers = 15, size = 0.0042 }
print(mesh.hexes)
"""


# --- rows -----------------------------------------------------------------------------------------------------

def row_assembly(options, folder):
    cad(folder, "boxes.step", boxes_with_bores(146))
    read, _ = run(options, folder, 'lacuna.load "boxes.step"')
    whole, _ = seconds_of([options.lacuna, "--quiet", "info", "boxes.step"], folder)
    return whole - read


def row_plate(options, folder):
    cad(folder, "plate.step", holed_plate(16))
    read, _ = run(options, folder, 'lacuna.load "plate.step"')
    whole, _ = run(options, folder, 'lacuna.load("plate.step"):open_volume():sweep { size = 3 }')
    return whole - read


def row_loops(options, folder):
    return float(run(options, folder, PLATES % 100)[1])


def row_bodies(options, folder):
    stl(folder / "bodies.stl", [t for k in range(21000) for t in box_facets(2 * (k % 28), 2 * (k // 28 % 28), 2 * (k // 784), 1)])
    return run(options, folder, 'lacuna.load "bodies.stl"')[0]


def row_gaps(options, folder):
    stl(folder / "gaps.stl", loose_sheet(707, 1.4e-5))
    return run(options, folder, 'lacuna.load("gaps.stl", { tolerance = 3e-5 })')[0]


def row_stator(options, folder):
    cad(folder, "stator.step", stator)
    return run(options, folder, 'lacuna.load("stator.step"):open_volume():sweep {}')[0]


def row_cylinders(options, folder):
    cad(folder, "cylinders.step", crossing_cylinders)
    return run(options, folder, 'lacuna.load("cylinders.step"):open_volume():sweep { fallback = "mixed" }')[0]


def row_blade(options, folder):
    return run(options, folder, BLADE % 200)[0]


def row_start(options, folder):
    cad(folder, "box.step", lambda occ: occ.addBox(0, 0, 0, 1, 2, 3))
    run(options, folder, 'lacuna.load "box.step"')
    start = time.perf_counter()
    run(options, folder, 'lacuna.load "box.step"')
    return time.perf_counter() - start


def row_sources(options, folder):
    """Share of small sources that take longer than the fastest of Gmsh's ways."""
    bench = pathlib.Path(options.lacuna).parent / "benchmarks" / "bench_pave"
    if not bench.exists():
        raise Unmeasured("bench_pave is not built")
    os.environ.setdefault("LACUNA_CAD", str(pathlib.Path(options.lacuna).parent / "lacuna-cad"))
    slower = []
    for domain in against_gmsh.DOMAINS:
        for quads in (40, 120, 400, 1000):
            found = against_gmsh.measure_in_turn(str(bench), domain, quads, ["source", *against_gmsh.GMSH], 1)
            ours = found.pop("source")
            theirs = [r["seconds"] for r in found.values() if "failed" not in r]
            if theirs and "failed" not in ours:
                slower.append(ours["seconds"] > min(theirs))
    if not slower:
        raise Unmeasured("no source was meshed both ways")
    return statistics.mean(slower)


def seconds_of_sweeps(options, folder):
    """Seconds of the sweep of each CAD file below --data, with nothing said about it."""
    if options.data is None:
        raise Unmeasured("--data names no folder")
    seconds = []
    for path in sorted(p for p in pathlib.Path(options.data).rglob("*") if p.suffix in (".step", ".stp", ".brep")):
        start = time.perf_counter()
        command = [options.lacuna, "--quiet"] + recipe(
            folder, f'lacuna.load({json.dumps(str(path.resolve()))}):open_volume():sweep {{ fallback = "mixed" }}')
        subprocess.run(command, cwd=folder, capture_output=True)
        seconds.append(time.perf_counter() - start)
    return seconds


def row_median(options, folder):
    return statistics.median(seconds_of_sweeps(options, folder))


def row_longest(options, folder):
    return max(seconds_of_sweeps(options, folder))


ROWS = {
    "assembly": ("info of 146 boxes with bores (1,022 faces), without reading", 3, row_assembly, " s"),
    "plate": ("plate with 256 holes, no roles, size of the holes, without reading", 1, row_plate, " s"),
    "loops": ("matching of 10,000 loops", 2, row_loops, " s"),
    "bodies": ("21,000 bodies of facets", 5, row_bodies, " s"),
    "gaps": ("a million facets with gaps of ten times the default tolerance, sewn", 3, row_gaps, " s"),
    "stator": ("a stator, no roles", 1, row_stator, " s"),
    "cylinders": ("three crossing cylinders, no roles", 1, row_cylinders, " s"),
    "blade": ("an aerofoil with 5 degrees of twist, class V, 78,000 hexahedra", 1, row_blade, " s"),
    "start": ("start of a STEP job", 0.05, row_start, " s"),
    "sources": ("share of sources of 40 to 1,000 quads slower than Gmsh's fastest", 7 / 107, row_sources, ""),
    "median": ("median sweep of the CAD files below --data", 0.3, row_median, " s"),
    "longest": ("longest sweep of the CAD files below --data", 10, row_longest, " s"),
}


# --- growth ---------------------------------------------------------------------------------------------------

def tube_facets(around, along, bend):
    def at(k, j):
        u, s = 2 * math.pi * k / around, 6 * j / along
        return (math.cos(u) + bend * math.sin(s), math.sin(u), s)
    return [t for j in range(along) for k in range(around)
            for t in quad(at(k, j), at(k + 1, j), at(k + 1, j + 1), at(k, j + 1))]


def bundle(rows):
    """Round tubes in a box: the space between them."""
    def build(occ):
        tubes = [(3, occ.addCylinder(3 * i + 1.5, 3 * k + 1.5, -1, 0, 0, 12, 1)) for i in range(rows) for k in range(rows)]
        occ.cut([(3, occ.addBox(0, 0, 0, 3 * rows, 3 * rows, 10))], tubes)
    return build


def honeycomb(rows):
    def build(occ):
        cells = []
        for i in range(rows):
            for k in range(rows):
                x, y = 2 * i + 1.2 + (k % 2), 1.75 * k + 1.2
                points = [occ.addPoint(x + math.cos(a * math.pi / 3 + math.pi / 6), y + math.sin(a * math.pi / 3 + math.pi / 6), -1)
                          for a in range(6)]
                loop = occ.addCurveLoop([occ.addLine(points[a], points[(a + 1) % 6]) for a in range(6)])
                face = occ.addPlaneSurface([loop])
                occ.dilate([(2, face)], x, y, -1, 0.9, 0.9, 1)
                cells.append(next(e for e in occ.extrude([(2, face)], 0, 0, 8) if e[0] == 3))
        occ.cut([(3, occ.addBox(0, 0, 0, 2 * rows + 1.4, 1.75 * rows + 0.7, 5))], cells)
    return build


def drum(holes):
    """Holes in the order of a sunflower's seeds, so that the area of the drum grows as their number."""
    def build(occ):
        tools = [(3, occ.addCylinder(2 * math.sqrt(k + 0.5) * math.cos(2.4 * k), 2 * math.sqrt(k + 0.5) * math.sin(2.4 * k),
                                     -1, 0, 0, 7, 1)) for k in range(holes)]
        occ.cut([(3, occ.addCylinder(0, 0, 0, 0, 0, 5, 2 * math.sqrt(holes) + 3))], tools)
    return build


def of_cad(build, sizes, size):
    def make(options, folder, step):
        cad(folder, "part.step", build(sizes[step]))
        return ('lacuna.load("part.step"):open_volume():sweep { size = %g }:write "mesh.msh"' % size), sizes[step]
    return make


BOXES = """
local n = %d
local parts = {}
for i = 0, n - 1 do
  for k = 0, n - 1 do
    local model, p = lacuna.model(), {}
    for c = 0, 7 do p[c + 1] = { i + c %% 2, k + c // 2 %% 2, c // 4 } end
    for f, q in ipairs { { 1, 3, 4, 2 }, { 5, 6, 8, 7 }, { 1, 2, 6, 5 }, { 3, 7, 8, 4 }, { 1, 5, 7, 3 }, { 2, 4, 8, 6 } } do
      model:add_face { name = "f" .. f, points = { p[q[1]], p[q[2]], p[q[3]], p[q[4]] }, cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
    end
    parts[#parts + 1] = model:open_volume { source = "f1", target = "f2", walls = { "f3", "f4", "f5", "f6" } }
  end
end
lacuna.assembly(parts):sweep { size = 0.25 }:write "mesh.msh"
"""


def of_boxes(options, folder, step):
    rows = (8, 12, 18, 26)[step]
    return BOXES % rows, rows


def of_tubes(options, folder, step):
    along = (100, 200, 400, 800)[step]
    stl(folder / "part.stl", tube_facets(60, along, 0.3))
    return 'lacuna.load("part.stl"):open_volume():sweep {}:write "mesh.msh"', along


FAMILIES = {
    "plates": of_cad(holed_plate, (4, 6, 8, 12), 3),
    "bundles": of_cad(bundle, (4, 6, 8, 12), 1),
    "honeycombs": of_cad(honeycomb, (4, 6, 8, 12), 1),
    "boxes": of_boxes,
    "tubes": of_tubes,
    "drums": of_cad(drum, (20, 40, 80, 160), 1.5),
}


def grow(options, folder, family):
    """Seconds of each stage by the work: faces, or facets."""
    stages = {}
    for step in range(4):
        text, size = FAMILIES[family](options, folder, step)
        work = size ** 2 if family in ("plates", "bundles", "honeycombs", "boxes") else size
        timing = folder / "timing.json"
        seconds_of([options.lacuna, "--quiet", "--timing", str(timing)] + recipe(folder, text), folder)
        found = {}
        for stage in json.loads(timing.read_text())["stages"]:
            name = stage["stage"].split(" ")[0]
            found[name] = found.get(name, 0) + stage["processor_seconds"]
        for name, seconds in found.items():
            stages.setdefault(name, []).append((work, seconds))
    return {name: points for name, points in stages.items() if len(points) == 4 and points[-1][1] >= LEAST}


def draw(path, curves):
    """Seconds by work, on logarithmic axes: a polyline a stage."""
    wide, high, edge = 900, 600, 50
    points = [p for curve in curves.values() for p in curve]
    low = [math.log10(min(max(p[k], 1e-4) for p in points)) for k in (0, 1)]
    top = [math.log10(max(p[k] for p in points)) for k in (0, 1)]

    def at(point):
        x, y = ((math.log10(max(point[k], 1e-4)) - low[k]) / max(top[k] - low[k], 1e-9) for k in (0, 1))
        return f"{edge + x * (wide - 2 * edge):.1f},{high - edge - y * (high - 2 * edge):.1f}"
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {high}" font-family="sans-serif" font-size="11">',
             f'<text x="{edge}" y="20">seconds by number of holes, members or rows; {10 ** low[1]:.2g} to {10 ** top[1]:.2g} s</text>']
    for number, (name, curve) in enumerate(curves.items()):
        colour = f"hsl({number * 360 // len(curves)},70%,40%)"
        x, y = at(curve[-1]).split(",")
        lines.append(f'<polyline fill="none" stroke="{colour}" points="{" ".join(map(at, curve))}"/>'
                     f'<text x="{x}" y="{y}" fill="{colour}" text-anchor="end">{name}</text>')
    path.write_text("\n".join(lines + ["</svg>"]) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lacuna")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--only", default=",".join([*ROWS, "growth"]))
    parser.add_argument("--data")
    parser.add_argument("--folder", default=tempfile.gettempdir())
    parser.add_argument("--output", default="corners.jsonl")
    parser.add_argument("--picture")
    options = parser.parse_args()
    options.lacuna = str(pathlib.Path(options.lacuna).resolve())
    wanted = options.only.split(",")
    bars = Bars(pathlib.Path(options.output), {"lacuna": options.lacuna, "runs": options.runs})
    with tempfile.TemporaryDirectory(dir=options.folder) as name:
        folder = pathlib.Path(name)
        for row, (words, limit, measure, unit) in ROWS.items():
            if row not in wanted:
                continue
            try:
                figure = statistics.median(measure(options, folder) for _ in range(options.runs))
            except (Unmeasured, RuntimeError) as error:
                print(f"{row}: {error}")
                figure = None
            bars.tell(words, figure, limit, False, unit)
        curves = {}
        for family in FAMILIES if "growth" in wanted else ():
            try:
                found = grow(options, folder, family)
            except (Unmeasured, RuntimeError) as error:
                print(f"{family}: {error}")
                bars.tell(f"growth of {family}", None, GROWTH, False)
                continue
            for stage, points in found.items():
                curves[f"{family}, {stage}"] = points
                bars.tell(f"growth of {family}, {stage}", power(points), GROWTH, False)
        if options.picture and curves:
            draw(pathlib.Path(options.picture), curves)
    return 1 if bars.missed else 3 if bars.unmeasured else 0


if __name__ == "__main__":
    sys.exit(main())
