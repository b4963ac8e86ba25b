-- SPDX-License-Identifier: MIT
-- Grooves and slots in bodies, named by their faces alone: the void lies beside the material, not in it.
-- usage: lacuna grooves.lua scratch=FOLDER
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local params = lacuna.params { scratch = "." }
local path = params.scratch .. "/groove.geo"

--- The faces of a file for which `is_given` holds.
local function faces_of(geo, is_given)
  check.write(path, 'SetFactory("OpenCASCADE");\n' .. geo .. "\n")
  local model = lacuna.load(path)
  local faces = {}
  for _, face in ipairs(model:faces()) do
    if is_given(face) then faces[#faces + 1] = face end
  end
  return model, faces
end

-- Half width of the flanks, radius at the floor and width of the floor, in a shaft of radius 20.
local grooves = { steep = { 2, 10, 0 }, v = { 5, 14, 0 }, flat = { 12, 17, 0 }, belt = { 4, 14, 8 } }
for name, groove in pairs(grooves) do
  local wide, floor, middle = table.unpack(groove)
  local parts, at = {}, -40
  local function add(length, from, to)
    if length == 0 then return end
    parts[#parts + 1] = from == to
      and ("Cylinder(%d) = {0, 0, %g, 0, 0, %g, %g};"):format(#parts + 1, at, length, from)
      or ("Cone(%d) = {0, 0, %g, 0, 0, %g, %g, %g};"):format(#parts + 1, at, length, from, to)
    at = at + length
  end
  add(40 - wide, 20, 20)
  add(wide, 20, floor)
  add(middle, floor, floor)
  add(wide, floor, 20)
  add(40 - wide, 20, 20)
  parts[#parts + 1] = ("BooleanUnion(99) = { Volume{1}; Delete; }{ Volume{2:%d}; Delete; };"):format(#parts)
  local model, faces = faces_of(table.concat(parts, "\n"), function(face)
    return face.kind == "cone" or face.kind == "cylinder" and face.radius < 19
  end)
  check.equal(#faces, middle > 0 and 3 or 2, name)
  local flank = 2 * wide * (400 - (400 + 20 * floor + floor ^ 2) / 3)
  local volume = math.pi * (flank + middle * (400 - floor ^ 2))
  check.near(model:open_volume({ faces = faces }):sweep({}):quality().volume, volume, 0.025 * volume)
end

-- The head of a slot between two arcs, with a neck to the bore of a stator: its ends and its mouth are
-- missing.
do
  local model, faces = faces_of([[
Cylinder(1) = {0, 0, 0, 0, 0, 20, 60}; Cylinder(2) = {0, 0, 0, 0, 0, 20, 30};
Cylinder(3) = {0, 0, 0, 0, 0, 20, 44, Pi/8}; Cylinder(4) = {0, 0, 0, 0, 0, 20, 36, Pi/8};
BooleanDifference(5) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
Rotate{ {0, 0, 1}, {0, 0, 0}, -Pi/16 }{ Volume{5}; }
Box(6) = {20, -2, 0, 18, 4, 20};
BooleanDifference(7) = { Volume{1}; Delete; }{ Volume{2, 5, 6}; Delete; };]], function(face)
    local out = math.sqrt(face.centroid[1] ^ 2 + face.centroid[2] ^ 2)
    return face.kind ~= "plane" and face.radius > 31 and face.radius < 59 or
      face.kind == "plane" and math.abs(face.normal[3]) < 0.5 and out > 30
  end)
  check.equal(#faces, 7)
  local head, neck = math.pi / 16 * (44 ^ 2 - 36 ^ 2), 4 * (36 - 30)
  check.near(model:open_volume({ faces = faces }):sweep({}):quality().volume, 20 * (head + neck),
    0.02 * 20 * (head + neck))
end

-- A slot with round ends whose floor is in three coplanar parts, as boolean operations leave it: cells cannot
-- follow the edges between the parts as well as the rim.
for _, long in ipairs { 20, 40, 60 } do
  local model, faces = faces_of(([[
Box(1) = {-50, -20, -20, 100, 40, 20}; Box(2) = {%g, -6, -10, %g, 12, 11};
Cylinder(3) = {%g, 0, -10, 0, 0, 11, 6}; Cylinder(4) = {%g, 0, -10, 0, 0, 11, 6};
BooleanDifference(5) = { Volume{1}; Delete; }{ Volume{2:4}; Delete; };]]):format(-long / 2, long, -long / 2,
    long / 2), function(face)
    return face.kind == "cylinder" or math.abs(math.abs(face.centroid[2]) - 6) < 1e-6 or
      math.abs(face.normal[3]) > 0.5 and math.abs(face.centroid[3] + 10) < 1e-6
  end)
  local quality = model:open_volume({ faces = faces }):sweep({}):quality()
  local volume = 10 * (12 * long + math.pi * 36)
  check.near(quality.volume, volume, 0.01 * volume)
  check.that(quality.min_scaled_jacobian > 0.6, quality.min_scaled_jacobian)
end

-- A missing round wall between exact circles: facets that close it are chords, but nodes lie on the round.
do
  local model, faces = faces_of([[
Cylinder(1) = {0, 0, 0, 0, 0, 40, 25}; Cylinder(2) = {0, 0, 15, 0, 0, 6, 25};
Cylinder(3) = {0, 0, 15, 0, 0, 6, 21}; BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
BooleanDifference(5) = { Volume{1}; Delete; }{ Volume{4}; Delete; };]], function(face)
    return face.centroid[3] > 14.5 and face.centroid[3] < 21.5
  end)
  for order = 1, 2 do
    local mesh = model:open_volume({ faces = faces }):sweep { size = 1.5, layers = 4, order = order }
    local least = 25
    for i = 1, mesh.nodes do
      local x, y = mesh:node(i)
      local r = math.sqrt(x * x + y * y)
      if r > 24.5 then least = math.min(least, r) end
    end
    check.near(least, 25, order == 1 and 1e-6 or 1e-3)
  end
end

-- The ring below the rounds of a shallow groove: cells that are improved together with those of the other
-- half of the turn do not leave the rounds.
do
  local model, faces = faces_of([[
Point(1) = {0, 0, -9}; Point(2) = {25, 0, -9}; Point(3) = {25, 0, -4.5}; Point(4) = {22, 0, -4.5};
Point(5) = {22, 0, -3.5}; Point(6) = {21, 0, -3.5}; Point(7) = {21, 0, 3.5}; Point(8) = {22, 0, 3.5};
Point(9) = {22, 0, 4.5}; Point(10) = {25, 0, 4.5}; Point(11) = {25, 0, 9}; Point(12) = {0, 0, 9};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Circle(4) = {4, 5, 6}; Line(5) = {6, 7};
Circle(6) = {7, 8, 9}; Line(7) = {9, 10}; Line(8) = {10, 11}; Line(9) = {11, 12}; Line(10) = {12, 1};
Curve Loop(1) = {1:10}; Plane Surface(1) = {1};
Extrude { {0, 0, 1}, {0, 0, 0}, 2 * Pi } { Surface{1}; }]], function(face)
    return face.kind == "torus" or face.kind == "cylinder" and face.radius < 21.5
  end)
  check.equal(#faces, 3)
  local fidelity = model:open_volume({ faces = faces, full_turn = true }):sweep({ size = 1 }).fidelity
  check.near(fidelity.volume, fidelity.sealed_volume, 0.011 * fidelity.sealed_volume)
end
check.done()
