#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A square of quads along a vector, a turn, a helix, a twist and an S: the same nodes, cells and volume as Gmsh's
extrusions, which can do these in pieces of less than half a turn. Skipped where Python has no Gmsh.

usage: along_against_gmsh.py LACUNA SCRATCH
"""
import json
import math
import pathlib
import subprocess
import sys

try:
    import gmsh
except ImportError:
    print("skipped: this Python has no gmsh")
    sys.exit(77)

LACUNA, SCRATCH = sys.argv[1], pathlib.Path(sys.argv[2])
ACROSS, PIECES, LAYERS = 4, 5, 6  # quads along a side, pieces of Gmsh's path, layers of each

# The square's lower corner and the directions of its sides, Lacuna's `along`, and Gmsh's pieces: either a
# translation, or (point, direction of the axis, angle, translation).
X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
QUARTER = math.pi / 2
S_PATH = """{ path = function(t)
  local a = 2.5 * t
  if a <= 1.25 then return 3 - 3 * math.cos(a), 0, 3 * math.sin(a) end
  local b, x, z = 2.5 - a, 6 * (1 - math.cos(1.25)), 6 * math.sin(1.25)
  return x - 3 * (1 - math.cos(b)), 0, z - 3 * math.sin(b)
end }"""


def s_pieces():
    """Two arcs of radius 3 about axes along y: the first at x = 3, the second opposite the end of the first."""
    far = (3 - 6 * math.cos(1.25), 0, 6 * math.sin(1.25))
    pieces = [((3, 0, 0), Y, 1.25 / 2, None)] * 2 + [(far, Y, -1.25 / 2, None)] * 2
    return pieces


CASES = {
    "vector": ((0, 0, 0), X, Y, "{ vector = { 0.5, 0.2, 3 } }", [(0.1, 0.04, 0.6)] * PIECES),
    "turn": ((2, 0, 0), X, Z, "{ axis = { { 0, 0, 0 }, { 0, 0, 1 } }, angle = 300 }",
             [((0, 0, 0), Z, math.pi / 3, None)] * PIECES),
    "helix": ((2, 0, 0), X, Z, "{ helix = { { 0, 0, 0 }, { 0, 0, 1 }, 2.5, 1.25 } }",
              [((0, 0, 0), Z, QUARTER, (0, 0, 2.5 / 4))] * PIECES),
    "twist": ((-0.5, -0.5, 0), X, Y, "{ vector = { 0, 0, 5 }, twist = 150 }",
              [((0, 0, 0), Z, math.radians(30), (0, 0, 1))] * PIECES),
    "s": ((-0.5, -0.5, 0), X, Y, S_PATH, s_pieces()),
}


def plus(p, *steps):
    return tuple(p[d] + sum(step[d] for step in steps) for d in range(3))


def volume_of(c):
    """Volume of a trilinear hexahedron (Grandy 1997)."""
    def det(a, b, d):
        return (a[0] * (b[1] * d[2] - b[2] * d[1]) - a[1] * (b[0] * d[2] - b[2] * d[0])
                + a[2] * (b[0] * d[1] - b[1] * d[0]))

    def less(a, b):
        return tuple(p - q for p, q in zip(a, b))
    return (det(plus(less(c[6], c[1]), less(c[7], c[0])), less(c[6], c[3]), less(c[2], c[0]))
            + det(less(c[7], c[0]), plus(less(c[6], c[3]), less(c[5], c[0])), less(c[6], c[4]))
            + det(less(c[6], c[1]), less(c[5], c[0]), plus(less(c[6], c[4]), less(c[2], c[0])))) / 12


def measured():
    """Nodes, hexahedra, and their volume, of Gmsh's current model."""
    gmsh.model.mesh.removeDuplicateNodes()
    tags, places, _ = gmsh.model.mesh.getNodes()
    place = {tag: tuple(places[3 * i:3 * i + 3]) for i, tag in enumerate(tags)}
    used, volume, count = set(), 0, 0
    kinds, _, nodes = gmsh.model.mesh.getElements(3)
    for kind, own in zip(kinds, nodes):
        assert kind == 5, f"cells of type {kind}"
        for i in range(0, len(own), 8):
            cell = list(own[i:i + 8])
            used.update(cell)
            volume += abs(volume_of([place[n] for n in cell]))
            count += 1
    return sorted(place[n] for n in used), count, volume


def by_gmsh(corner, u, v, pieces):
    gmsh.model.add("extruded")
    geo = gmsh.model.geo
    points = [geo.addPoint(*p) for p in (corner, plus(corner, u), plus(corner, u, v), plus(corner, v))]
    lines = [geo.addLine(points[i], points[(i + 1) % 4]) for i in range(4)]
    face = geo.addPlaneSurface([geo.addCurveLoop(lines)])
    for line in lines:
        geo.mesh.setTransfiniteCurve(line, ACROSS + 1)
    geo.mesh.setTransfiniteSurface(face)
    geo.mesh.setRecombine(2, face)
    for piece in pieces:
        options = {"numElements": [LAYERS], "recombine": True}
        if len(piece) == 3:
            made = geo.extrude([(2, face)], *piece, **options)
        elif piece[3] is None:
            made = geo.revolve([(2, face)], *piece[0], *piece[1], piece[2], **options)
        else:
            made = geo.twist([(2, face)], *piece[0], *piece[3], *piece[1], piece[2], **options)
        face = made[0][1]
    geo.synchronize()
    gmsh.model.mesh.generate(3)
    found = measured()
    gmsh.model.remove()
    return found


def by_lacuna(name, corner, u, v, along, layers):
    path = SCRATCH / f"{name}.msh"
    points = ", ".join("{ %.17g, %.17g, %.17g }" % p
                       for p in (corner, plus(corner, u), plus(corner, u, v), plus(corner, v)))
    recipe = SCRATCH / f"{name}.lua"
    recipe.write_text(f"""local lacuna = require "lacuna"
local sheet = lacuna.model()
sheet:add_face {{ name = "start", points = {{ {points} }}, cells = {{ {{ 1, 2, 3, 4 }} }} }}
local mesh = sheet:open_volume {{ source = "start", along = {along} }}
  :sweep {{ size = {1 / ACROSS}, layers = {layers}, quads = "mapped", curvature = 0 }}
mesh:write("{path}", {{ quality = false }})
print(('{{ "volume": %.17g }}'):format(mesh:quality().volume))
""")
    told = json.loads(subprocess.run([LACUNA, "--quiet", recipe], stdout=subprocess.PIPE, text=True, check=True).stdout)
    gmsh.open(str(path))
    nodes, count, volume = measured()
    gmsh.model.remove()
    assert abs(volume - told["volume"]) < 1e-9 * volume, f"{name}: {volume} is told as {told['volume']}"
    return nodes, count, volume


gmsh.initialize([], False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.option.setNumber("General.Verbosity", 1)
for name, (corner, u, v, along, pieces) in CASES.items():
    theirs = by_gmsh(corner, u, v, pieces)
    ours = by_lacuna(name, corner, u, v, along, LAYERS * len(pieces))
    assert ours[1] == theirs[1] and len(ours[0]) == len(theirs[0]), \
        f"{name}: {ours[1]} cells and {len(ours[0])} nodes, {theirs[1]} and {len(theirs[0])} by Gmsh"
    share = abs(ours[2] / theirs[2] - 1)
    off = max(min(math.dist(p, q) for q in theirs[0]) for p in ours[0][::3])
    print(f"{name:7} {ours[1]} hexahedra, {len(ours[0])} nodes, volume {ours[2]:.12g}, "
          f"off Gmsh's by {share:.1e}, nodes by {off:.1e}")
    # A path that is a function is read at 1025 places; where its curvature jumps, the section there tilts by half
    # the curvature over a step.
    volume_limit, node_limit = (1e-5, 1e-3) if name == "s" else (1e-8, 1e-6)
    assert share < volume_limit, f"{name}: volume {ours[2]}, {theirs[2]} by Gmsh"
    assert off < node_limit, f"{name}: a node is {off} off Gmsh's"
gmsh.finalize()
