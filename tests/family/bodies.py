#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Ordinary mechanical bodies with random ratios, whole and with 1 to 3 faces missing; needs gmsh.

bodies.py make FOLDER SEED [NAME ...]     writes the bodies, two draws of missing faces each, and bodies.json
bodies.py run PROGRAM FOLDER MODE OUT [--only REGEX] [--seconds 60]
                                          MODE: whole, mixed (whole, with fallback = "mixed"), open

`run` needs verify_mixed.py on PYTHONPATH, which judges a mesh without the program. It prints a line for each
body; the last line counts the verdicts: right, poor (least scaled Jacobian below 0.1), refused, late, noted
(the volume is off by more than 2 %, with a note), wrong (off without a note, or not conforming), crash.
"""
import argparse, collections, json, math, pathlib, random, re, subprocess, time
from math import pi

rng = random.Random()
def between(a, b): return round(rng.uniform(a, b), 2)
def ratios(*bounds): return [between(a, b) for a, b in zip(bounds[::2], bounds[1::2])]
def choice(*of): return rng.choice(of)

# --- shapes ------------------------------------------------------------------------------------------------
def occ():
    import gmsh
    return gmsh.model.occ
def box(x, y, z, a, b, c): return 3, occ().addBox(x, y, z, a, b, c)
def cyl(x, y, z, u, v, w, r): return 3, occ().addCylinder(x, y, z, u, v, w, r)
def cone(x, y, z, u, v, w, r, s): return 3, occ().addCone(x, y, z, u, v, w, r, s)
def ball(x, y, z, r): return 3, occ().addSphere(x, y, z, r)
def ring(x, y, z, r, s): return 3, occ().addTorus(x, y, z, r, s)
def cut(a, *tools): return occ().cut([a], list(tools))[0][0]
def fuse(a, *others): return occ().fuse([a], list(others))[0][0]
def common(a, *others): return occ().intersect([a], list(others))[0][0]
def polar(r, angle): return r * math.cos(angle), r * math.sin(angle)
def around(n, r, make, phase=0.0): return [make(*polar(r, 2 * pi * i / n + phase)) for i in range(n)]
def solid_in(parts): return [t for t in parts if t[0] == 3][0]
def prism(points, along): return solid_in(occ().extrude([(2, flat(points))], *along))
def polygon(n, r, z=0.0, x=0.0, y=0.0): return around(n, r, lambda u, v: (x + u, y + v, z))
def turned(v, angle, axis=(0, 0, 1)):
    occ().rotate([v], 0, 0, 0, *axis, angle)
    return v
def lines(points):
    p = [occ().addPoint(*q) for q in points]
    return [occ().addLine(a, b) for a, b in zip(p, p[1:] + p[:1])]
def flat(points): return occ().addPlaneSurface([occ().addCurveLoop(lines(points))])
def lathe(points):  # (radius, height)
    return solid_in(occ().revolve([(2, flat([(r, 0, z) for r, z in points]))], 0, 0, 0, 0, 0, 1, 2 * pi))
def loft(sections):
    return occ().addThruSections([occ().addWire(lines(s)) for s in sections], -1, True, True)[0]
def slot(x, y, z, length, r, height):  # with round ends, along x
    return fuse(box(x - length / 2, y - r, z, length, 2 * r, height),
                *[cyl(x + s * length / 2, y, z, 0, 0, height, r) for s in (-1, 1)])
def edges(v, keep):
    import gmsh
    occ().synchronize()
    found = {abs(e) for face in gmsh.model.getBoundary([v], False, False, False)
             for _, e in gmsh.model.getBoundary([face], False, False, False)}
    return [e for e in sorted(found) if keep(gmsh.model.getBoundingBox(1, e))]
def upright(b): return b[3] - b[0] < 1e-3 and b[4] - b[1] < 1e-3
def above(z): return lambda b: b[2] > z - 1e-3
def fillet(v, keep, r): return occ().fillet([v[1]], edges(v, keep), [r])[0]
def chamfer(v, keep, r):
    import gmsh
    of, skin = edges(v, keep), {t[1] for t in gmsh.model.getBoundary([v], False, False, False)}
    beside = [[f for f in gmsh.model.getAdjacencies(1, e)[0] if f in skin][0] for e in of]
    return occ().chamfer([v[1]], of, beside, [r])[0]

helpers = set(globals())

# --- brackets and plates -----------------------------------------------------------------------------------
def angle_gusset():  # an angle with one gusset in the middle and slotted holes
    a, b, t = ratios(50, 90, 40, 80, 5, 9); v = fuse(box(0, 0, 0, a, b, t), box(0, 0, 0, t, b, a * .8))
    w, k = ratios(5, 10, .5, .9)
    v = fuse(v, prism([(t, b / 2 - w / 2, t), (t + k * (a - t), b / 2 - w / 2, t),
            (t, b / 2 - w / 2, t + k * (.8 * a - t))], (0, w, 0)))
    return cut(v, *[slot(a * .6, b * s, -1, a * .15, b * .06, t + 2) for s in (.2, .8)])
def corner_bracket():  # three plates that meet in a corner
    a, t = ratios(50, 80, 5, 10)
    v = fuse(box(0, 0, 0, a, a * .9, t), box(0, 0, 0, t, a * .9, a * .8), box(0, 0, 0, a, t, a * .8))
    return cut(v, cyl(a * .6, a * .55, -1, 0, 0, t + 2, a * .12),
            cyl(-1, a * .5, a * .5, t + 2, 0, 0, a * .09))
def z_bracket():
    a, b, h, t = ratios(30, 50, 25, 50, 30, 60, 4, 8)
    v = prism([(0, 0, 0), (a, 0, 0), (a, 0, h), (2 * a, 0, h), (2 * a, 0, h + t), (a - t, 0, h + t),
            (a - t, 0, t), (0, 0, t)], (0, b, 0))
    return cut(v, cyl(a * .45, b / 2, -1, 0, 0, t + 2, b * .15),
            cyl(a * 1.55, b / 2, h - 1, 0, 0, t + 2, b * .2))
def bent_sheet():  # two bends with round corners
    a, r, t, b, h = ratios(30, 60, 3, 8, 2, 4, 25, 50, 20, 40)
    def bend(x, z, side):
        return common(cut(cyl(x, 0, z, 0, b, 0, r + t), cyl(x, -1, z, 0, b + 2, 0, r)),
                box(x if side > 0 else x - 99, 0, z if side > 0 else z - 99, 99, b, 99))
    x, z = a + 2 * r + t, -r - h
    v = fuse(box(0, 0, 0, a, b, t), bend(a, -r, 1), box(a + r, 0, z, t, b, h), bend(x, z, -1),
            box(x, 0, z - r - t, a * .6, b, t))
    return cut(v, cyl(a * .5, b / 2, -1, 0, 0, t + 2, b * .2))
def cover_plate():  # counterbored holes at rounded corners, a raised pad, a window
    a, b, t = ratios(70, 110, 50, 80, 8, 12); v = fillet(box(0, 0, 0, a, b, t), upright, b * .12)
    v = fuse(v, box(a * .25, b * .25, t * .5, a * .5, b * .5, t))
    v = cut(v, slot(a / 2, b / 2, -1, a * .2, b * .12, 3 * t)); d = b * .13
    return cut(v, *[c for x in (d, a - d) for y in (d, b - d) for c in (cyl(x, y, -1, 0, 0, t + 2, d * .3),
            cyl(x, y, t * .55, 0, 0, t, d * .55))])
def chamfered_plate():
    a, b, t = ratios(60, 90, 40, 60, 10, 18)
    v = cut(box(0, 0, 0, a, b, t), cyl(a * .3, b / 2, -1, 0, 0, t + 2, b * .2),
            slot(a * .7, b / 2, -1, a * .12, b * .1, t + 2))
    return chamfer(v, above(t), between(1, 2.5))

# --- flanges, pulleys, wheels ------------------------------------------------------------------------------
def hub_flange():  # bore, hub with fillet at its foot, bolts
    r, t, h = ratios(35, 60, 7, 12, 15, 35); q = r * between(.4, .5)
    v = fuse(cyl(0, 0, 0, 0, 0, t, r), cyl(0, 0, 0, 0, 0, t + h, q))
    v = fillet(v, lambda b: abs(b[2] - t) < .001 and abs(b[5] - t) < .001 and (b[3] - b[0] < 2 * q + 1),
            between(2, 4))
    return cut(v, cyl(0, 0, -1, 0, 0, t + h + 2, q * .6), *around(choice(4, 5, 6), (r + q) / 2 + 1, lambda x,
            y: cyl(x, y, -1, 0, 0, t + 2, (r - q) * .18)))
def flange_ribs():  # a flange whose hub has ribs, with a bore
    r, t, h, n = between(40, 60), between(6, 10), between(20, 35), choice(3, 4, 6)
    q, w = r * .4, between(4, 6); v = fuse(cyl(0, 0, 0, 0, 0, t, r), cyl(0, 0, 0, 0, 0, t + h, q))
    for i in range(n):
        v = fuse(v, turned(prism([(q * .8, -w / 2, t), (r * .9, -w / 2, t), (q * .8, -w / 2, t + h * .9)],
                (0, w, 0)), 2 * pi * i / n))
    return cut(v, cyl(0, 0, -1, 0, 0, t + h + 2, q * .6))
def square_flange():  # a square flange on a pipe stub
    a, t, l = ratios(50, 80, 8, 12, 25, 50); r = a * between(.2, .3)
    v = fillet(box(-a / 2, -a / 2, 0, a, a, t), upright, a * .12)
    v = cut(fuse(v, cyl(0, 0, 0, 0, 0, l, r)), cyl(0, 0, -1, 0, 0, l + 2, r * .75))
    return cut(v, *around(4, a * .52, lambda x, y: cyl(x, y, -1, 0, 0, t + 2, a * .06), pi / 4))
def spoked_wheel():
    r, t, n = between(40, 60), between(10, 16), choice(3, 4, 5, 6); w = between(5, 8)
    v = fuse(cut(cyl(0, 0, 0, 0, 0, t, r), cyl(0, 0, -1, 0, 0, t + 2, r * .82)),
            cyl(0, 0, 0, 0, 0, t, r * .28))
    v = fuse(v, *[turned(box(r * .15, -w / 2, t * .2, r * .75, w, t * .6), 2 * pi * i / n) for i in range(n)])
    return cut(v, cyl(0, 0, -1, 0, 0, t + 2, r * .15))
def round_spokes():  # round spokes between rim and hub
    r, t, n = between(40, 60), between(12, 18), choice(3, 4, 5)
    v = fuse(cut(cyl(0, 0, 0, 0, 0, t, r), cyl(0, 0, -1, 0, 0, t + 2, r * .8)), cyl(0, 0, 0, 0, 0, t, r * .3))
    v = fuse(v, *[cyl(0, 0, t / 2, *polar(r * .9, 2 * pi * i / n), 0, t * .25) for i in range(n)])
    return cut(v, cyl(0, 0, -1, 0, 0, t + 2, r * .18))
def v_pulley():  # two grooves, hub on one side, set screw
    r, w = ratios(30, 45, 20, 30); b, g = r * .25, r * .2
    v = lathe([(b, 0), (r, 0), (r, w * .1), (r - g, w * .2), (r - g, w * .3), (r, w * .4), (r, w * .6),
            (r - g, w * .7), (r - g, w * .8), (r, w * .9), (r, w), (b * 2, w), (b * 2, w * 1.6), (b,
            w * 1.6)])
    return cut(v, cyl(0, 0, w * 1.3, r, 0, 0, b * .3))
def impeller_blank():
    r, h, n = between(35, 50), between(25, 40), choice(4, 5, 6, 7)
    v = lathe([(r * .15, 0), (r, 0), (r, h * .12), (r * .6, h * .25), (r * .35, h), (r * .15, h)])
    w = between(2.5, 4)
    for i in range(n):
        v = fuse(v, turned(prism([(r * .3, -w / 2, h * .1), (r * .95, -w / 2, h * .1),
                (r * .95, -w / 2, h * .35), (r * .5, -w / 2, h * .8), (r * .3, -w / 2,
                h * .8)], (0, w, 0)), 2 * pi * i / n))
    return v
def cam():  # two circles joined by tangents, with a bore and a second disc
    r, l, t = ratios(18, 28, 20, 35, 8, 14); s = r * between(.35, .6); c = (r - s) / l
    k = math.sqrt(1 - c * c)
    v = fuse(cyl(0, 0, 0, 0, 0, t, r), cyl(l, 0, 0, 0, 0, t, s),
            prism([(r * c, -r * k, 0), (l + s * c, -s * k, 0), (l + s * c, s * k, 0), (r * c, r * k, 0)],
            (0, 0, t)))
    return cut(fuse(v, cyl(0, 0, 0, 0, 0, t * 2, r * .7)), cyl(0, 0, -1, 0, 0, 2 * t + 2, r * .4))

# --- shafts ------------------------------------------------------------------------------------------------
def shaft_two_keys():  # end mill keyways with round ends on two steps, chamfered ends
    r, l = ratios(10, 15, 30, 50)
    v = fuse(cyl(0, 0, 0, l, 0, 0, r), cyl(l, 0, 0, l * .8, 0, 0, r * .75),
            cyl(-l * .6, 0, 0, l * .6, 0, 0, r * .8))
    key = turned(slot(0, 0, 0, l * .3, r * .22, r), 0)
    occ().translate([key], l * .5, 0, r * .7)
    end = box(l * 1.5, -r * .15, r * .4, l, r * .3, r)
    return cut(v, key, end)
def shaft_flats():  # two flats and a cross hole
    r, l = ratios(8, 14, 50, 80)
    v = fuse(cyl(0, 0, 0, 0, 0, l, r), cyl(0, 0, l * .4, 0, 0, l * .15, r * 1.6))
    v = cut(v, box(r * .7, -r * 2, l * .75, r, 4 * r, l), box(-r * 1.7, -r * 2, l * .75, r, 4 * r, l))
    return cut(v, cyl(-2 * r, 0, l * .2, 4 * r, 0, 0, r * .3))
def shaft_grooves():  # snap-ring grooves and a centre hole
    r, l = ratios(10, 16, 50, 80)
    v = lathe([(0, 0), (r, 0), (r, l * .2), (r * .85, l * .2), (r * .85, l * .25), (r, l * .25), (r, l * .6),
            (r * .7, l * .6), (r * .7, l * .85), (r * .6, l * .85), (r * .6, l * .9), (r * .7,
            l * .9), (r * .7, l), (0, l)])
    return cut(v, cyl(0, 0, l * .7, 0, 0, l, r * .25))
def eccentric():
    r, l = ratios(10, 16, 20, 40)
    return fuse(cyl(0, 0, 0, 0, 0, l, r), cyl(r * .4, 0, l, 0, 0, l * .5, r * 1.7),
            cyl(0, 0, l * 1.5, 0, 0, l, r * .8))
def splined_bore():
    r, t, n = between(20, 30), between(15, 30), choice(4, 6, 8); b = r * .5
    return cut(cyl(0, 0, 0, 0, 0, t, r), cyl(0, 0, -1, 0, 0, t + 2, b),
            *[turned(box(0, -b * .15, -1, b * 1.25, b * .3, t + 2), 2 * pi * i / n) for i in range(n)])
def socket_screw():
    r, l = ratios(5, 9, 25, 50); v = fuse(cyl(0, 0, 0, 0, 0, 2 * r, r * 1.6), cyl(0, 0, -l, 0, 0, l, r))
    return cut(v, prism(polygon(6, r * .9, r), (0, 0, 2 * r)))
def bolt():  # hexagon head, washer face, chamfered end
    r, l = ratios(5, 9, 30, 60)
    v = fuse(prism(polygon(6, 2 * r, 0), (0, 0, r * 1.3)), cyl(0, 0, -r * .15, 0, 0, r * .3, r * 1.6),
            cyl(0, 0, -l, 0, 0, l, r))
    return fuse(v, cone(0, 0, -l - r * .3, 0, 0, r * .3, r * .7, r))

# --- blocks with bores -------------------------------------------------------------------------------------
def blind_three_sides():  # blind bores from three sides that do not meet
    a, b, c = ratios(50, 80, 50, 70, 40, 60); r = between(5, 8)
    return cut(box(0, 0, 0, a, b, c), cyl(a * .7, b * .7, c * .55, 0, 0, c, r),
            cyl(-1, b * .25, c * .6, a * .4, 0, 0, r * .9), cyl(a * .6, -1, c * .25, 0, b * .4, 0, r * .8))
def blind_meeting():  # blind bores from three sides that meet in one corner
    a, b, c = ratios(50, 80, 50, 70, 40, 60); r = between(7, 10)
    return cut(box(0, 0, 0, a, b, c), cyl(a / 2, b / 2, c * .45, 0, 0, c, r),
            cyl(-1, b / 2, c * .5, a / 2 + 1, 0, 0, r * .8), cyl(a / 2, -1, c * .5, 0, b / 2 + 1, 0, r * .65))
def valve_spool():  # a bore along the block, ports from above and below, mounting holes
    a, b, c = ratios(90, 130, 35, 50, 40, 55); r = between(7, 10)
    v = cut(box(0, 0, 0, a, b, c), cyl(-1, b / 2, c / 2, a + 2, 0, 0, r))
    v = cut(v, *[cyl(a * s, b / 2, c / 2, 0, 0, k * c, r * .6) for s, k in ((.25, 1), (.5, -1), (.75, 1))])
    return cut(v, *[cyl(a * s, b * .12, -1, 0, 0, c + 2, b * .05) for s in (.1, .9)])
def two_slanted_ports():
    a, b, c = ratios(70, 100, 40, 60, 40, 60); r, g = between(6, 9), math.radians(between(20, 40))
    v = cut(box(0, 0, 0, a, b, c), cyl(-1, b / 2, c * .35, a + 2, 0, 0, r))
    return cut(v, *[cyl(a * s, b / 2, c * .35, k * c * math.tan(g), 0, c, r * .55) for s,
            k in ((.4, -1), (.6, 1))])
def stepped_bores():  # a counterbored main bore crossed by a smaller one
    a, b, c = ratios(50, 80, 40, 60, 40, 60); r = between(9, 13)
    return cut(box(0, 0, 0, a, b, c), cyl(a / 2, b / 2, -1, 0, 0, c + 2, r),
            cyl(a / 2, b / 2, c * .7, 0, 0, c, r * 1.4), cyl(-1, b / 2, c * .35, a + 2, 0, 0, r * .5))
def casting_bosses():  # a box with round bosses on three sides, bored through to the middle
    a, b, c = ratios(40, 60, 40, 60, 40, 60); r = between(9, 13)
    v = fuse(box(-a / 2, -b / 2, -c / 2, a, b, c), cyl(0, 0, 0, 0, 0, c * .75, r * 1.4),
            cyl(0, 0, 0, a * .75, 0, 0, r * 1.2), cyl(0, 0, 0, 0, b * .75, 0, r))
    return cut(v, cyl(0, 0, 0, 0, 0, c, r * .8), cyl(0, 0, 0, a, 0, 0, r * .7), cyl(0, 0, 0, 0, b, 0, r * .5))
def slot_and_bores():  # a milled slot, a stepped edge and bores from two sides
    a, b, c = ratios(70, 100, 45, 60, 30, 45)
    v = cut(box(0, 0, 0, a, b, c), box(-1, b * .75, c * .6, a + 2, b, c),
            slot(a * .35, b * .4, c * .5, a * .25, b * .12, c))
    return cut(v, cyl(a * .8, b * .4, -1, 0, 0, c + 2, b * .12),
            cyl(a * .55, -1, c * .25, 0, b + 2, 0, c * .1))
def t_slots_two():  # T-slots along x in the top and along y in the bottom
    a, b, c = ratios(60, 90, 60, 80, 35, 50); w = between(6, 9)
    return cut(box(0, 0, 0, a, b, c), box(-1, b / 2 - w / 2, c * .65, a + 2, w, c),
            box(-1, b / 2 - w, c * .65, a + 2, 2 * w, c * .15), box(a / 2 - w / 2, -1, -1, w, b + 2,
            c * .35 + 1), box(a / 2 - w, -1, c * .2, 2 * w, b + 2, c * .15))
def vee_block():
    a, b, c = ratios(40, 60, 50, 80, 40, 60); w = a * between(.3, .4)
    v = prism([(0, 0, 0), (a, 0, 0), (a, 0, c), (a / 2 + w, 0, c), (a / 2, 0, c - w), (a / 2 - w, 0, c),
            (0, 0, c)], (0, b, 0))
    return cut(v, box(-1, b * .3, c * .2, a * .2 + 1, b * .4, c * .2),
            box(a * .8, b * .3, c * .2, a, b * .4, c * .2))

# --- pipes and tanks ---------------------------------------------------------------------------------------
def elbow_pipe():  # a bent tube with straight ends and a flange
    r, q, l = ratios(8, 14, 25, 45, 10, 30)
    def bend(r):
        disk = turned((2, occ().addDisk(0, 0, 0, r, r)), pi / 2, (1, 0, 0))
        occ().translate([disk], q, 0, 0)
        return solid_in(occ().revolve([disk], 0, 0, 0, 0, 0, 1, pi / 2))
    v = fuse(bend(r), cyl(q, 0, 0, 0, -l, 0, r), cyl(q, -l, 0, 0, r / 2, 0, r * 1.7),
             cyl(0, q, 0, -l, 0, 0, r))
    return cut(v, bend(r * .7), cyl(q, 0, 0, 0, -l, 0, r * .7), cyl(0, q, 0, -l, 0, 0, r * .7))
def tee_slanted():  # a Y of solid cylinders
    r, l, g = between(10, 18), between(60, 90), math.radians(between(35, 60))
    return fuse(cyl(-l / 2, 0, 0, l, 0, 0, r), cyl(0, 0, 0, l * .7 * math.cos(g), 0, l * .7 * math.sin(g),
            r * between(.5, .8)))
def cross_solid():  # four arms
    r, l = ratios(10, 18, 70, 100)
    return fuse(cyl(-l / 2, 0, 0, l, 0, 0, r), cyl(0, -l / 2, 0, 0, l, 0, r * between(.6, .9)))
def cylinder_through():  # a cylinder across a larger one, off the axis, with a bore
    r, l = ratios(18, 28, 50, 70); q = r * between(.3, .5); y = r * between(.1, .3)
    return cut(fuse(cyl(0, 0, 0, 0, 0, l, r), cyl(-1.6 * r, y, l / 2, 3.2 * r, 0, 0, q)),
            cyl(-2 * r, y, l / 2, 4 * r, 0, 0, q * .6))
def tank_nozzle():  # a solid tank with flat head, dished end and two nozzles
    r, l = ratios(20, 30, 50, 80); v = fuse(cyl(0, 0, 0, 0, 0, l, r), ball(0, 0, l, r))
    return fuse(v, cyl(0, 0, l * .3, r * 1.6, 0, 0, r * .3), cyl(0, 0, l, 0, 0, r * 1.5, r * .25))
def tank_shell():  # the same as a shell with one nozzle
    r, l, t = ratios(25, 35, 50, 80, 3, 5); q = r * .3
    v = fuse(cyl(0, 0, 0, 0, 0, l, r), ball(0, 0, l, r), cyl(0, 0, l * .4, r * 1.6, 0, 0, q))
    return cut(v, cyl(0, 0, t, 0, 0, l - t, r - t), ball(0, 0, l, r - t),
            cyl(0, 0, l * .4, 2 * r, 0, 0, q - t * .6))
def cone_on_box():
    a, b, h = ratios(40, 60, 40, 60, 20, 40); r = min(a, b) * between(.3, .45)
    return fuse(box(-a / 2, -b / 2, 0, a, b, h * .5), cone(between(-3, 3), between(-3, 3), h * .5, 0, 0, h,
            r, r * between(.2, .7)))
def hopper():  # a square funnel with a flange and an outlet pipe
    a, h, t = ratios(50, 80, 40, 60, 3, 5); b = a * .3
    square = lambda s, z: [(-s / 2, -s / 2, z), (s / 2, -s / 2, z), (s / 2, s / 2, z), (-s / 2, s / 2, z)]
    v = fuse(loft([square(b, 0), square(a, h)]), box(-b / 2, -b / 2, -h * .4, b, b, h * .4),
            box(-a * .6, -a * .6, h, a * 1.2, a * 1.2, t))
    return cut(v, loft([square(b - 2 * t, 0), square(a - 2 * t, h)]),
            box(-b / 2 + t, -b / 2 + t, -h, b - 2 * t, b - 2 * t, h), box(-a / 2 + t, -a / 2 + t, h - .001,
            a - 2 * t, a - 2 * t, h))
def dome_ports():  # a dome shell with three ports
    r, t = ratios(30, 45, 4, 7); v = common(ball(0, 0, 0, r), box(-99, -99, 0, 198, 198, 99))
    v = cut(v, ball(0, 0, 0, r - t))
    return cut(v, *around(3, r * .55, lambda x, y: cyl(x, y, 0, 0, 0, 99, r * .1)))
def ball_valve_body():  # a ball with a through bore and two flanges
    r = between(18, 26)
    v = fuse(ball(0, 0, 0, r), *[cyl(k * r * .8, 0, 0, k * r * .7, 0, 0, r * .6) for k in (1, -1)],
            *[cyl(k * r * 1.5, 0, 0, k * r * .3, 0, 0, r) for k in (1, -1)])
    return cut(v, cyl(-99, 0, 0, 198, 0, 0, r * .4))

# --- housings ----------------------------------------------------------------------------------------------
def gearbox_half():  # a shell with half round bearing seats
    a, b, c, t = ratios(80, 110, 50, 70, 30, 45, 5, 8)
    v = fuse(box(0, 0, 0, a, b, c), *[cyl(a * s, -t, c, 0, b + 2 * t, 0, k * c) for s,
            k in ((.3, .6), (.72, .4))])
    v = cut(v, box(-99, -99, c, 999, 999, 99), box(t, t, t, a - 2 * t, b - 2 * t, c))
    return cut(v, *[cyl(a * s, -99, c, 0, 999, 0, k * c) for s, k in ((.3, .4), (.72, .25))])
def enclosure():  # a thin box with rounded corners, four screw posts and a cable hole
    a, b, c, t = ratios(70, 100, 50, 70, 20, 35, 2.5, 4); v = fillet(box(0, 0, 0, a, b, c), upright, 3 * t)
    v = cut(v, fillet(box(t, t, t, a - 2 * t, b - 2 * t, c), upright, 2 * t)); d = 4 * t
    v = fuse(v, *[cyl(x, y, t / 2, 0, 0, c * .6, t * 1.3) for x in (d, a - d) for y in (d, b - d)])
    v = cut(v, *[cyl(x, y, t, 0, 0, c, t * .6) for x in (d, a - d) for y in (d, b - d)])
    return cut(v, cyl(-1, b / 2, c * .55, 2 * t, 0, 0, c * .15))
def bearing_housing():  # a foot, a round head with a stepped bore, side ribs, grease hole
    a, b, h, t = ratios(80, 110, 25, 40, 40, 55, 8, 12); r = between(18, 24)
    v = fuse(box(-a / 2, 0, 0, a, b, t), box(-r, 0, 0, 2 * r, b, h), cyl(0, 0, h, 0, b, 0, r))
    for k in (1, -1):
        v = fuse(v, prism([(k * r * .9, b * .4, t), (k * a * .42, b * .4, t), (k * r * .9, b * .4, h * .7)],
                (0, b * .2, 0)))
    return cut(v, cyl(0, -1, h, 0, b + 2, 0, r * .5), cyl(0, b * .5, h, 0, b, 0, r * .7),
            cyl(0, b * .25, h, 0, 0, 2 * r, r * .1))
def motor_mount():  # an L whose upright has a round window, with two triangular side plates
    a, b, h, t = ratios(60, 80, 50, 70, 55, 75, 5, 8); v = fuse(box(0, 0, 0, a, b, t), box(0, 0, 0, t, b, h))
    for y in (0, b - t):
        v = fuse(v, prism([(0, y, 0), (a * .9, y, 0), (a * .9, y, t), (t, y, h * .9), (0, y, h * .9)],
                (0, t, 0)))
    return cut(v, cyl(-1, b / 2, h * .55, t + 2, 0, 0, b * .25),
            *[cyl(a * .7, b * s, -1, 0, 0, t + 2, t * .4) for s in (.3, .7)])
def bearing_cap():
    r, b, t = ratios(15, 22, 20, 35, 6, 10)
    v = fuse(cyl(0, 0, 0, 0, b, 0, r + t), box(-r - 3 * t, 0, 0, 2 * r + 6 * t, b, t))
    v = cut(v, box(-99, -99, -99, 198, 198, 99), cyl(0, -1, 0, 0, b + 2, 0, r))
    return cut(v, *[cyl(k * (r + 2 * t), b / 2, -1, 0, 0, t + 2, t * .4) for k in (1, -1)])

# --- levers, clamps, hooks ---------------------------------------------------------------------------------
def connecting_rod():
    l, t = ratios(60, 100, 10, 16); r, s = ratios(16, 22, 9, 13)
    v = fuse(cyl(0, 0, 0, 0, 0, t, r), cyl(l, 0, 0, 0, 0, t, s),
            prism([(0, -r * .6, t * .2), (l, -s * .6, t * .2), (l, s * .6, t * .2), (0, r * .6, t * .2)],
            (0, 0, t * .6)))
    return cut(v, cyl(0, 0, -1, 0, 0, t + 2, r * .65), cyl(l, 0, -1, 0, 0, t + 2, s * .55))
def fork():  # a clevis whose stem is round
    a, b, c, l = ratios(25, 35, 30, 40, 20, 28, 30, 50)
    v = fuse(box(0, -b / 2, -c / 2, a, b, c), cyl(a, -b / 2, 0, 0, b, 0, c / 2),
            cyl(-l, 0, 0, l, 0, 0, c * .35))
    return cut(v, box(a * .3, -b * .22, -c, 3 * a, b * .44, 2 * c), cyl(a, -b, 0, 0, 2 * b, 0, c * .25))
def crane_hook():  # a bent round bar: straight, half turn, straight
    r, q, l = ratios(5, 9, 18, 28, 20, 40); o = occ(); d = o.addDisk(q, 0, 0, r, r)
    o.rotate([(2, d)], q, 0, 0, 1, 0, 0, pi / 2)
    bend = solid_in(o.revolve([(2, d)], 0, 0, 0, 0, 0, 1, pi * between(1.0, 1.3)))
    return fuse(bend, cyl(q, 0, 0, 0, -l, 0, r), cyl(q, -l, 0, 0, -r, 0, r * 1.7))
def pipe_clamp():  # half a clamp with ears and a reinforcing web
    r, w, t = ratios(14, 22, 18, 28, 4, 7)
    v = fuse(cyl(0, 0, 0, 0, 0, w, r + t), box(-r - 4 * t, 0, 0, 2 * r + 8 * t, t, w),
            box(-r - 3 * t, 0, w * .4, 2 * r + 6 * t, r * .8, w * .2))
    v = cut(v, box(-99, -99, -1, 198, 99, 99), cyl(0, 0, -1, 0, 0, w + 2, r))
    return cut(v, *[cyl(k * (r + 2.7 * t), -1, w * s, 0, t + 2, 0, t * .4) for k in (1, -1) for s in (.2,
            .8)])
def split_collar():  # a collar with a slit and a clamping screw
    r, w = ratios(16, 24, 12, 18)
    v = cut(cyl(0, 0, 0, 0, 0, w, r), cyl(0, 0, -1, 0, 0, w + 2, r * .5),
            box(0, -r * .08, -1, 2 * r, r * .16, w + 2))
    return cut(v, cyl(r * .75, -2 * r, w / 2, 0, 4 * r, 0, r * .12))
def hinge_leaf():  # two knuckles, countersunk holes
    a, b, t, r = ratios(35, 50, 50, 70, 4, 6, 6, 9); v = box(0, 0, 0, a, b, t)
    for y in (0, .6):
        v = fuse(v, cyl(0, b * y, r, 0, b * .3, 0, r))
    v = cut(v, cyl(0, -1, r, 0, b + 2, 0, r * .5))
    return cut(v, *[c for s in (.2, .8) for c in (cyl(a * .65, b * s, -1, 0, 0, t + 2, t * .5),
            cone(a * .65, b * s, t * .5, 0, 0, t * .5, t * .5, t))])
def eye_bolt():  # a ring on a stem
    q, r, l = ratios(15, 22, 4, 6, 25, 40)
    return fuse(turned(ring(0, 0, 0, q, r), pi / 2, (1, 0, 0)), cyl(0, 0, -q, 0, 0, -l, r * 1.2))

# --- plain solids ------------------------------------------------------------------------------------------
def skew_frustum():  # a frustum with its top off-centre
    n, r, h = choice(3, 4, 5, 6), between(30, 45), between(25, 50)
    return loft([polygon(n, r), polygon(n, r * between(.3, .7), h, between(-12, 12), between(-12, 12))])
def pyramid_on_prism():
    n, r, h = choice(4, 5, 6), between(25, 40), between(20, 40)
    return fuse(prism(polygon(n, r), (0, 0, h * .6)), loft([polygon(n, r, h * .6),
            polygon(n, r * .35, h * 1.4, between(-4, 4), 3)]))
def cut_ball():  # a ball cut by two planes
    r = between(20, 35)
    v = common(ball(0, 0, 0, r), box(-99, -99, -r * between(.3, .8), 198, 198, r * between(1.0, 1.3)))
    return common(v, box(-r * between(.3, .8), -99, -99, 198, 198, 198))
def lens_bore():  # two balls' common part with a bore
    r = between(30, 45); d = r * between(.5, .8)
    return cut(common(ball(0, 0, 0, r), ball(0, 0, 2 * d, r)), cyl(0, 0, -99, 0, 0, 198, r * .2))
def balls_and_bar():  # a dumbbell whose balls differ
    r, l = ratios(14, 20, 45, 70)
    return fuse(ball(0, 0, 0, r), ball(l, 0, 0, r * between(.7, 1.2)),
            cyl(0, 0, 0, l, 0, 0, r * between(.35, .55)))
def balls_cluster():
    r = between(15, 22)
    return fuse(ball(0, 0, 0, r), ball(r * 1.3, 0, 0, r * between(.6, .8)),
            ball(-r * .6, r * 1.1, 0, r * between(.6, .8)))
def pillow_box():  # rounded on all edges, with a pocket and a bore
    a, b, c = ratios(50, 80, 40, 60, 25, 40); v = fillet(box(0, 0, 0, a, b, c), lambda _: True, between(3, 6))
    return cut(v, box(a * .2, b * .25, c * .6, a * .3, b * .5, c),
            cyl(a * .75, b / 2, -1, 0, 0, c + 2, b * .15))
def skewed_wedge():  # a block with two slanted sides and a bore normal to one of them
    a, b, c = ratios(50, 80, 40, 60, 30, 50); g = math.radians(between(15, 30))
    v = prism([(0, 0, 0), (a, 0, 0), (a, 0, c * .4), (a - c * .6 / math.tan(g) * .5, 0, c), (0, 0, c)],
            (b * .2, b, 0))
    return cut(v, cyl(a * .4, b * .6, -1, 0, 0, c + 2, b * .15))

bodies = {name: f for name, f in globals().items() if name not in helpers and name != "helpers"}

# --- files -------------------------------------------------------------------------------------------------
def write_body(folder, name, seed):  # one body and two copies with faces missing; returns their rows
    import gmsh
    rng.seed(f"{name}{seed}")
    o, stem, kept = occ(), f"{name}_{seed}", bodies[name]()
    o.synchronize()
    o.remove([v for v in gmsh.model.getEntities(3) if v != kept], True)
    o.synchronize()
    skin = [f[1] for f in gmsh.model.getBoundary([kept], False, False, False)]
    o.remove([f for f in gmsh.model.getEntities(2) if f[1] not in skin])
    o.synchronize()
    assert gmsh.model.getEntities(3) == [kept]
    volume, whole, step = o.getMass(3, kept[1]), *(folder / (stem + end) for end in (".brep", ".step"))
    for file in (whole, step): gmsh.write(str(file))
    gmsh.clear()
    o.importShapes(str(step))  # a cut seam may turn the kept part of a ball into its complement
    o.synchronize()
    same = abs(sum(o.getMass(*v) for v in gmsh.model.getEntities(3)) / volume - 1) < 1e-3
    rows = [dict(file=(step if same else whole).name, name=stem, faces=len(skin), volume=volume, gone=[])]
    for draw in (1, 2):
        gmsh.clear()
        o.importShapes(str(whole))
        o.synchronize()
        solid = gmsh.model.getEntities(3)
        skin = sorted(f[1] for f in gmsh.model.getBoundary(solid, False, False, False))
        gone = rng.sample(skin, min(choice(1, 2, 3), max(1, len(skin) - 2)))
        o.remove(solid)
        o.remove([(2, f) for f in gone], True)
        o.synchronize()
        gmsh.write(str(folder / f"{stem}_o{draw}.brep"))
        rows.append(dict(file=f"{stem}_o{draw}.brep", name=f"{stem}_o{draw}", faces=len(skin) - len(gone),
                         volume=volume, gone=gone))
    return rows
def make(folder, seed, names):
    import gmsh
    folder.mkdir(exist_ok=True, parents=True)
    rows = []
    for name in names or bodies:
        gmsh.initialize(["", "-v", "0", "-setstring", "Geometry.OCCTargetUnit", "MM"])
        gmsh.option.setNumber("General.Terminal", 0)
        try: rows += write_body(folder, name, seed)
        except Exception as error: print("not made:", name, error)
        gmsh.finalize()
    (folder / "bodies.json").write_text(json.dumps(rows, indent=0))
    print(len(rows), "files of", len(rows) // 3, "bodies")

# --- runs --------------------------------------------------------------------------------------------------
def verdict(mesh, row, words):
    import verify_mixed
    found, notes = verify_mixed.judge(mesh), re.findall(r"\[([a-z_.0-9]+)\]", words)
    wrong, off = found["wrong"], found.get("volume", 0) / row["volume"] - 1
    text = (f'hex share {found.get("hex_share", 0):.2f} least {found.get("least_hex", 0):.2f} '
            f'volume {off:+.2%} {wrong or ""} {notes}')
    if wrong or abs(off) > .02: return "noted" if notes and not wrong else "wrong", text
    return "poor" if min(found["least_hex"], found["least"]) < .1 else "right", text
def run(program, folder, mode, out, only, seconds):
    out.mkdir(parents=True, exist_ok=True)
    count, codes, times = collections.Counter(), collections.Counter(), []
    for row in json.loads((folder / "bodies.json").read_text()):
        if bool(row["gone"]) != (mode == "open") or not re.search(only, row["name"]): continue
        mesh, recipe = out / (row["name"] + ".msh"), out / (row["name"] + ".lua")
        mesh.unlink(missing_ok=True)
        options = 'fallback = "mixed"' if mode == "mixed" else ""
        recipe.write_text(f'require "lacuna".load("{(folder / row["file"]).resolve()}"):open_volume {{}}'
                          f':sweep {{ {options} }}:write "{mesh.name}"\n')
        start, text = time.time(), ""
        try:
            done = subprocess.run([program.resolve(), "--quiet", recipe.name], cwd=out, capture_output=True,
                                  text=True, timeout=seconds)
            times.append(time.time() - start)
            if done.returncode == 0: word, text = verdict(mesh, row, done.stderr)
            else:
                word = "refused" if done.returncode == 1 else "crash"
                text = (done.stderr.splitlines() or ["?"])[-1][:250]
                codes[(re.findall(r"\[([a-z_]+\.[a-z_0-9]+)\]", text) or ["?"])[-1]] += 1
        except subprocess.TimeoutExpired: word, times = "late", times + [seconds]
        mesh.unlink(missing_ok=True)
        count[word] += 1
        print(f'{word:8} {times[-1]:5.1f} s {row["faces"]:3} {row["name"]} {text}', flush=True)
    times.sort()
    print(mode, dict(count), f"median {times[len(times) // 2]:.1f} s, longest {times[-1]:.1f} s", dict(codes))

if __name__ == "__main__":
    parser = argparse.ArgumentParser(usage=__doc__.replace("%", "%%"))
    of = parser.add_subparsers(dest="what", required=True)
    maker, runner = of.add_parser("make"), of.add_parser("run")
    for of, name in ((maker, "folder"), (runner, "program"), (runner, "folder")):
        of.add_argument(name, type=pathlib.Path)
    maker.add_argument("seed", type=int)
    maker.add_argument("names", nargs="*")
    runner.add_argument("mode", choices=("whole", "mixed", "open"))
    runner.add_argument("out", type=pathlib.Path)
    for option, default in (("--only", "."), ("--seconds", 60.0)):
        runner.add_argument(option, type=type(default), default=default)
    asked = vars(parser.parse_args())
    make(**asked) if asked.pop("what") == "make" else run(**asked)
