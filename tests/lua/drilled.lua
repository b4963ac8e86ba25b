-- SPDX-License-Identifier: MIT
-- Drilled parts: boxes, discs, brackets and bends with blind holes that end flat, in a cone or in a ball, and
-- shafts with a bore across. Such parts are cut where the cylinder of a hole ends or along a bore.
-- usage: lacuna drilled.lua scratch=FOLDER [first=1] [last=60]
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local params = lacuna.params { scratch = ".", first = 0, last = -1 }

local function row(...) return table.concat({ ... }, ", ") end

--- Volume 1 less others.
local function combined(tools)
  return ("BooleanDifference{ Volume{1}; Delete; }{ Volume{%s}; Delete; }"):format(tools)
end

--- A blind hole from a place on a horizontal side: tools for Open CASCADE, and its volume.
-- @param way  -1 from above, 1 from below
-- @param room  how deep it may reach
-- @param tips  four kinds of tip to draw from
local function hole(random, number, at, way, radius, room, tips)
  local tip = tips[math.ceil(random(0, 4))]
  local angle = math.rad(random(40, 65)) -- between axis and cone
  local reach = tip == "cone" and radius / math.tan(angle) or tip == "ball" and radius or 0
  local depth = random(0.4, 0.8) * room - reach
  if depth < 0.2 * room then depth, reach, tip = 0.5 * room, 0, "flat" end
  local foot = row(at[1], at[2], at[3] + way * depth)
  local geo = {
    ("Cylinder(%d) = {%s, %s, %.15g, 2*Pi};"):format(number, row(table.unpack(at)), row(0, 0, way * depth),
      radius),
  }
  local volume = math.pi * radius ^ 2 * depth
  if tip == "cone" then
    geo[2] = ("Cone(%d) = {%s, %s, %.15g, 0, 2*Pi};"):format(number + 1, foot, row(0, 0, way * reach), radius)
    volume = volume + math.pi * radius ^ 2 * reach / 3
  elseif tip == "ball" then
    geo[2] = ("Sphere(%d) = {%s, %.15g, -Pi/2, Pi/2, 2*Pi};"):format(number + 1, foot, radius)
    volume = volume + 2 / 3 * math.pi * radius ^ 3
  end
  return geo, volume, tip
end

--- The volume of a cylinder within a larger one whose axis crosses its axis at a right angle.
local function across(radius, bore)
  local steps, sum = 2000, 0
  for i = 1, steps do
    local y = bore * (2 * (i - 0.5) / steps - 1)
    sum = sum + 4 * math.sqrt(bore ^ 2 - y ^ 2) * math.sqrt(radius ^ 2 - y ^ 2) * 2 * bore / steps
  end
  return sum
end

--- @return  geometry, volume, and a word for what it is
local function drilled(random, number)
  local kind = ({ "box", "disc", "bracket", "bend", "shaft" })[number % 5 + 1]
  local stock, volume, seats, room -- seats: places of holes with their ways and half the width around them
  if kind == "box" then
    local x, y, z = random(3, 5), random(2, 3), random(1.5, 3)
    stock, volume, room = ("Box(1) = {0, 0, 0, %s};"):format(row(x, y, z)), x * y * z, z
    local other = random(0, 1) < 0.5 and -1 or 1
    seats = { { { x / 4, y / 2, z }, -1, math.min(x / 4, y / 2) },
      { { 3 * x / 4, y / 2, other < 0 and z or 0 }, other, math.min(x / 4, y / 2) } }
  elseif kind == "disc" then
    local r, z = random(1.5, 2), random(1.5, 3)
    stock, volume = ("Cylinder(1) = {0, 0, 0, 0, 0, %.15g, %.15g, 2*Pi};"):format(z, r), math.pi * r ^ 2 * z
    room = z / 2
    seats = { { { 0, 0, z }, -1, r / 2 }, { { 0, 0, 0 }, 1, r / 2 } }
  elseif kind == "bracket" then
    local x, y, z, thick = random(3, 4), random(2, 3), random(2, 3), random(0.8, 1)
    stock = ("Box(1) = {0, 0, 0, %s}; Box(2) = {%s, 9, 9, 9}; BooleanDifference{ Volume{1}; Delete; }"
      .. "{ Volume{2}; Delete; }"):format(row(x, y, z), row(thick, -1, thick))
    volume, room = x * y * thick + (z - thick) * y * thick, thick
    seats = { { { (x + thick) / 2, y / 2, thick }, -1, math.min((x - thick) / 2, y / 2, 0.8) } }
  elseif kind == "bend" then
    local r, turn = random(0.8, 1.2), random(3, 4)
    stock = ("Disk(1) = {%.15g, 0, 0, %.15g}; Extrude{ {0, 1, 0}, {0, 0, 0}, Pi/2 }{ Surface{1}; }"
      .. "Recursive Delete{ Surface{1}; }"):format(turn, r)
    volume, room = math.pi * r ^ 2 * turn * math.pi / 2, 2
    seats = { { { turn, 0, 0 }, -1, r } }
  else
    local r, z = random(1, 2), random(4, 6)
    local bore, at = random(0.25, 0.5) * r, random(0.4, 0.6) * z
    return ("Cylinder(1) = {0, 0, 0, 0, 0, %.15g, %.15g, 2*Pi}; Cylinder(2) = {-9, 0, %.15g, 18, 0, 0, "
        .. "%.15g, 2*Pi};" .. combined "2"):format(z, r, at, bore),
      math.pi * r ^ 2 * z - across(r, bore), kind
  end
  local geo, tools, words = { stock }, {}, { kind }
  -- A bend with a ball in its end is one poor sweep, which is taken.
  local tips = { "flat", "cone", "cone", kind == "bend" and "cone" or "ball" }
  for n = 1, random(0, 1) < 0.5 and 1 or #seats do
    local at, way, half = table.unpack(seats[n])
    local made, less, tip = hole(random, 10 * n, at, way, random(0.35, 0.6) * half, room, tips)
    volume, words[#words + 1] = volume - less, tip
    for k, line in ipairs(made) do geo[#geo + 1], tools[#tools + 1] = line, 10 * n + k - 1 end
  end
  geo[#geo + 1] = combined(table.concat(tools, ","))
  return table.concat(geo, "\n"), volume, table.concat(words, " ")
end

--- A body is meshed by hexahedra of its volume.
local function is_swept(file, geo, volume, word)
  check.write(file, 'SetFactory("OpenCASCADE");\n' .. geo .. "\n")
  local mesh = lacuna.load(file):open_volume {}:sweep {}
  local quality = mesh:quality()
  check.that(quality.certified and mesh.tets == 0 and mesh.wedges == 0, word)
  check.that(quality.min_scaled_jacobian > 0.2, ("%s: %.3f"):format(word, quality.min_scaled_jacobian))
  check.near(quality.volume / volume, 1, 0.02)
  return ("%s: %d hexahedra, least %.3f, volume %+.2f %%"):format(word, mesh.hexes,
    quality.min_scaled_jacobian, 100 * (quality.volume / volume - 1))
end

-- Both legs of a bracket are drilled: one piece has a hollow in an end, and a wall of a neighbour is a part
-- of its other end.
for _, thick in ipairs { 3.6, 4, 4.4 } do
  local depth, tip = 1.8, math.tan(math.rad(31))
  local geo = ("Box(1) = {0, 0, 0, 12, 6, 10}; Box(2) = {%s, 9, 9, 9};"):format(row(thick, -1, thick))
    .. combined "2" .. ("Cylinder(3) = {8, 3, %.15g, 0, 0, %.15g, 1, 2*Pi};"):format(thick, -depth)
    .. ("Cone(4) = {8, 3, %.15g, 0, 0, %.15g, 1, 0, 2*Pi};"):format(thick - depth, -tip)
    .. ("Cylinder(5) = {0, 3, 7, %.15g, 0, 0, 1, 2*Pi};"):format(depth)
    .. ("Cone(6) = {%.15g, 3, 7, %.15g, 0, 0, 1, 0, 2*Pi};"):format(depth, tip) .. combined "3,4,5,6"
  local volume = 6 * (12 * thick + (10 - thick) * thick) - 2 * math.pi * (depth + tip / 3)
  is_swept(params.scratch .. "/legs.geo", geo, volume, "both legs")
end

-- A shaft with two fins, a bore and a stud, in an order of faces in which pieces lie in front of each other
-- all round the shaft.
do
  local mesh = lacuna.load(arg[0]:match("^(.*/)") .. "finned_shaft.step"):open_volume {}:sweep {}
  local quality = mesh:quality()
  check.that(quality.certified and mesh.tets == 0 and quality.min_scaled_jacobian > 0.2, "fins")
  check.near(quality.volume / (math.pi * (0.8 * 1.6 + 0.6 * (1.9 ^ 2 - 1.2 ^ 2 - 0.18 ^ 2))), 1, 0.02)
end

-- An angle plate with a rounded edge, gussets and slots: layers of one piece end at vertices of the others.
do
  local width, thick, high = 4, 0.6, 1.9
  local geo = ("Box(1) = {0,0,0, 5,%.15g,%.15g};  Box(2) = {0,0,0, %.15g,%.15g,4};\n"):format(width, thick,
      thick, width) .. "BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };\n"
    .. "e() = Curve In BoundingBox{-0.01,-0.01,-0.01, 0.01,9,0.01};  v() = Fillet{3}{e()}{0.4};\n"
  for n, y in ipairs { 0, width - 0.4 } do
    local at = 100 * n
    geo = geo .. ("Point(%d) = {%.15g,%.15g,%.15g};  Point(%d) = {%.15g,%.15g,%.15g};\n"):format(at, thick, y,
        thick, at + 1, thick + high, y, thick)
      .. ("Point(%d) = {%.15g,%.15g,%.15g};  Line(%d) = {%d,%d};\n"):format(at + 2, thick, y, thick + high,
        at, at, at + 1)
      .. ("Line(%d) = {%d,%d};  Line(%d) = {%d,%d};\n"):format(at + 1, at + 1, at + 2, at + 2, at + 2, at)
      .. ("Curve Loop(%d) = {%d:%d};  Plane Surface(%d) = {%d};\n"):format(at, at, at + 2, at, at)
      .. ("g%d() = Extrude{0, 0.4, 0}{ Surface{%d}; };\n"):format(n, at)
  end
  geo = geo .. "BooleanUnion(9) = { Volume{v()}; Delete; }{ Volume{g1[1],g2[1]}; Delete; };\n"
    .. ("Cylinder(20) = {-1,%.15g,3.1, 9,0,0, 0.4};\n"):format(width / 2)
  for n, y in ipairs { 1.1, 2.5 } do
    geo = geo .. ("Box(%d) = {3.2,%.15g,-1, 1,0.5,3};\n"):format(3 * n + 21, y)
      .. ("Cylinder(%d) = {3.2,%.15g,-1, 0,0,3, 0.25};  "):format(3 * n + 22, y + 0.25)
      .. ("Cylinder(%d) = {4.2,%.15g,-1, 0,0,3, 0.25};\n"):format(3 * n + 23, y + 0.25)
  end
  geo = geo .. "BooleanUnion(10) = { Volume{24}; Delete; }{ Volume{25,26}; Delete; };\n"
    .. "BooleanUnion(11) = { Volume{27}; Delete; }{ Volume{28,29}; Delete; };\n"
    .. "BooleanDifference{ Volume{9}; Delete; }{ Volume{10,11,20}; Delete; }"
  is_swept(params.scratch .. "/angle.geo", geo, (9 - thick) * thick * width + 0.4 * high ^ 2
    - (1 - math.pi / 4) * 0.16 * width - thick * (0.16 * math.pi + 1 + math.pi / 8), "angle")
end

-- A boss with a bore and two ribs on a plate: an edge of an end of one piece is a part of a side line of
-- another piece.
do
  local side, thick, radius, high, width = 74.02, 9.21, 13.57, 20.86, 5.26
  local inner, outer, top = 0.8 * radius, 0.42 * side, 0.8 * high
  local geo = ("Box(1) = {%s};  Cylinder(2) = {%s};  Cylinder(3) = {%s};\n"):format(
      row(-side / 2, -side / 2, 0, side, side, thick), row(0, 0, 0, 0, 0, thick + high, radius),
      row(0, 0, -1, 0, 0, thick + high + 2, 0.55 * radius))
  local beside = 0 -- area of one half of a rib outside the boss, times the height there
  for i = 1, 1000 do
    local y = width / 2 * (i - 0.5) / 1000
    local share = (outer - math.sqrt(radius ^ 2 - y ^ 2)) / (outer - inner)
    beside = beside + share ^ 2 * (outer - inner) * top / 2 * width / 2 / 1000
  end
  for n, way in ipairs { 1, -1 } do
    local at = 100 * n
    geo = geo .. ("Point(%d) = {%s};  Point(%d) = {%s};  Point(%d) = {%s};\n"):format(
        at, row(way * inner, -width / 2, thick), at + 1, row(way * outer, -width / 2, thick),
        at + 2, row(way * inner, -width / 2, thick + top))
      .. ("Line(%d) = {%d,%d};  Line(%d) = {%d,%d};  Line(%d) = {%d,%d};\n"):format(
        at, at, at + 1, at + 1, at + 1, at + 2, at + 2, at + 2, at)
      .. ("Curve Loop(%d) = {%d:%d};  Plane Surface(%d) = {%d};\n"):format(at, at, at + 2, at, at)
      .. ("g%d() = Extrude{0, %.15g, 0}{ Surface{%d}; };\n"):format(n, width, at)
  end
  geo = geo .. "BooleanUnion(50) = { Volume{1}; Delete; }{ Volume{2,g1[1],g2[1]}; Delete; };\n"
    .. "BooleanDifference{ Volume{50}; Delete; }{ Volume{3}; Delete; }"
  is_swept(params.scratch .. "/ribs.geo", geo, side ^ 2 * thick + math.pi * radius ^ 2 * high
    - math.pi * (0.55 * radius) ^ 2 * (thick + high) + 4 * beside, "ribs")
end

check.family(params, function(number)
  if number == 81 then return "refused: hollows in both ends whose rims nearly coincide" end
  local random = check.random(104729 * number + 31)
  for _ = 1, 5 do random(0, 1) end
  return is_swept(("%s/%03d.geo"):format(params.scratch, number), drilled(random, number))
end)
