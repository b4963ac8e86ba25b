-- SPDX-License-Identifier: MIT
-- Parts that stick out of their partner, levels at a rim, faces named twice, bodies that are opened whole.
-- usage: lacuna overhangs.lua lacuna=PROGRAM scratch=FOLDER
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local params = lacuna.params { lacuna = "lacuna", scratch = "." }

--- Solids from lines of Gmsh's language, with Open CASCADE.
local function solids(name, text)
  local path = params.scratch .. "/" .. name .. ".geo"
  check.write(path, 'SetFactory("OpenCASCADE");\n' .. text)
  return lacuna.load(path), path
end

local function volume_of(model, roles, size)
  local quality = model:open_volume(roles):sweep({ size = size, fallback = "mixed" }):quality()
  check.that(quality.certified)
  return quality.volume, quality
end

--- A sleeve from z = 0 to 100, and a shaft in it.
local function sleeved(from, to, off)
  return solids("sleeved", ([[
Cylinder(1) = {0,0,0, 0,0,100, 60};  Cylinder(2) = {0,0,0, 0,0,100, 50};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {%g,0,%g, 0,0,%g, 30};]]):format(off, from, to - from))
end

local function bore(model) return model:face { kind = "cylinder", radius = { 49, 51 } } end
local function shaft(model) return model:face { kind = "cylinder", radius = { 29, 31 } } end

-- --- parts that stick out ----------------------------------------------------------------------------------

for _, ends in ipairs { { -20, 120 }, { 0, 120 }, { -30, 100 } } do
  for _, off in ipairs { 0, 8 } do
    local model = sleeved(ends[1], ends[2], off)
    local at = ("shaft from %g to %g, %g off"):format(ends[1], ends[2], off)
    local both = { shaft(model), bore(model) }
    for _, roles in ipairs { { walls = both }, { source = both[1], target = both[2] } } do
      local volume, quality = volume_of(model, roles, 8)
      check.that(math.abs(volume / (math.pi * 1600 * 100) - 1) < 0.02, ("%s: %g"):format(at, volume))
      check.that(quality.min_scaled_jacobian > 0.5, at)
      -- Its ends are flat.
      local closed = model:open_volume(roles)
      closed:close()
      for _, face in ipairs(closed:model():faces()) do
        check.that(face.box[1][3] > -1e-6 and face.box[2][3] < 100 + 1e-6, at .. ": beyond the sleeve")
      end
    end
  end
end
-- Tubes as ends have no mean normal, so the missing rings are flat, wherever rounding turns their normals.
for _, off in ipairs { 2, 7 } do
  for turn = 0, 7 do
    local model = lacuna.model()
    local function tube(name, radius, aside, slant)
      local points, cells, sides = {}, {}, 48
      for k = 0, sides - 1 do
        local angle = 2 * math.pi * k / sides
        local x, y = radius * math.cos(angle), radius * math.sin(angle)
        local a, b = 2 * k + 1, 2 * ((k + 1) % sides) + 1
        points[a] = { x, y + aside, 0 }
        points[a + 1] = { x, y + aside, 120 + 1e-6 * (x * math.cos(slant) + y * math.sin(slant)) }
        cells[k + 1] = { a, b, b + 1, a + 1 }
      end
      model:add_face { name = name, points = points, cells = cells }
    end
    tube("inner", 25, off, turn * math.pi / 4)
    tube("outer", 35, 0, 2.4)
    local volume = model:open_volume { source = "inner", target = "outer" }
    local quality = volume:sweep({ size = 10, layers = 2 }):quality()
    check.that(math.abs(quality.volume / (math.pi * 600 * 120) - 1) < 0.03, quality.volume)
    check.that(quality.certified and quality.min_scaled_jacobian > 0.4, quality.min_scaled_jacobian)
  end
end

-- Bare walls: a pipe that is longer than its casing, round or elliptic, with the seam of the casing anywhere.
for member, half in ipairs { { 30, 30 }, { 40, 20 }, { 25, 22 } } do
  for _, seam in ipairs { 0, 0.7, 2.5 } do
    local tilt = member * 0.05
    local model = solids("casing", ([[
Disk(1) = {0,0,0, %g,%g};  Rotate { {0,0,1}, {0,0,0}, %g } { Surface{1}; }
Extrude {0,0,60} { Surface{1}; }
Cylinder(50) = {2,0,-10, 0,0,85, 8};  Rotate { {0,1,0}, {2,0,30}, %g } { Volume{50}; }
Delete { Volume{1, 50}; }  Delete { Surface{1, 3, 5, 6}; }]]):format(half[1], half[2], seam, tilt))
    local quality = model:open_volume {}:sweep { size = 6 }:quality()
    local truth = 60 * math.pi * (half[1] * half[2] - 64 / math.cos(tilt))
    check.that(math.abs(quality.volume / truth - 1) < 0.02,
      ("casing %d, %g: %g"):format(member, seam, quality.volume))
    check.that(quality.certified and quality.min_scaled_jacobian > 0.5, quality.min_scaled_jacobian)
  end
end

-- A boss without its wall, with a bore through boss and plate: the bore is not cut off at the plate. The
-- plate may lack its bottom as well.
for member, boss in ipairs { { 8, 15, 4 }, { 12, 6, 9 }, { 6, 30, 2.5 } } do
  local radius, height, bore = boss[1], boss[2], boss[3]
  local without = "b() = Surface In BoundingBox{-21,-16,-1e-3, 21,16,1e-3};  Delete { Surface{b()}; }"
  for _, bottom in ipairs { "", without } do
    local low, high, top = 10 - 1e-3, 10 + height + 1e-3, 10 + height - 1e-3
    local model = solids("boss", ([[
Box(1) = {-20,-15,0, 40,30,10};  Cylinder(2) = {3,0,10, 0,0,%g, %g};  Cylinder(3) = {3,0,-1, 0,0,99, %g};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
BooleanDifference(5) = { Volume{4}; Delete; }{ Volume{3}; Delete; };
Delete { Volume{5}; }
w() = Surface In BoundingBox{-10,-13,%g, 16,13,%g};  w() -= Surface In BoundingBox{-10,-13,%g, 16,13,%g};
Delete { Surface{w()}; }
%s]]):format(height, radius, bore, low, high, top, high, bottom))
    local quality = model:open_volume {}:sweep { size = 4 }:quality()
    local truth = 12000 + math.pi * (radius ^ 2 * height - bore ^ 2 * (10 + height))
    check.that(math.abs(quality.volume / truth - 1) < 0.02,
      ("boss %d: %g, not %g"):format(member, quality.volume, truth))
  end
end

-- A round pocket without its wall, with a pin that is higher than the plate: the pin is not cut off.
for member, pocket in ipairs { { 12, 4, 5, 3 }, { 10, 6, 3, 8 }, { 13, 2, 9, 1.5 } } do
  local radius, depth, pin, above = table.unpack(pocket)
  local model = solids("pocket", ([[
Box(1) = {-20,-15,0, 40,30,10};  Cylinder(2) = {3,0,%g, 0,0,9, %g};  Cylinder(3) = {3,0,%g, 0,0,%g, %g};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
BooleanUnion(5) = { Volume{4}; Delete; }{ Volume{3}; Delete; };
Delete { Volume{5}; }
w() = Surface In BoundingBox{-12,-14,%g, 18,14,10.1};  w() -= Surface In BoundingBox{-12,-14,%g, 18,14,%g};
Delete { Surface{w()}; }]]):format(10 - depth, radius, 10 - depth, depth + above, pin, 9.9 - depth,
    9.9 - depth, 10.1 - depth))
  local quality = model:open_volume {}:sweep { size = 4 }:quality()
  local truth = 12000 + math.pi * (pin ^ 2 * (depth + above) - radius ^ 2 * depth)
  check.that(math.abs(quality.volume / truth - 1) < 0.02,
    ("pocket %d: %g, not %g"):format(member, quality.volume, truth))
end

-- A pulley without one of its cones and the opposite end: its bore does not stick out of the cone that is
-- left.
for _, height in ipairs { 4, 10 } do
  local model = solids("pulley", ([[
Cone(1) = {0,0,0, 0,0,%g, 25,20};  Cone(2) = {0,0,%g, 0,0,%g, 20,25};  Cylinder(3) = {0,0,-1, 0,0,99, 5};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
BooleanDifference(5) = { Volume{4}; Delete; }{ Volume{3}; Delete; };]]):format(height, height, height))
  local faces = {}
  for _, face in ipairs(model:faces()) do
    local low, high = face.box[1][3], face.box[2][3]
    if not (high < 1e-3 or low > height / 2 and high - low > 1) then faces[#faces + 1] = face end
  end
  check.equal(#faces, 3, "faces of a pulley")
  local open = model:open_volume { faces = faces }
  open:close()
  local top = 0
  for _, face in ipairs(open:model():faces()) do top = math.max(top, face.box[2][3]) end
  check.near(top, 2 * height, 1e-3, "pulley of " .. height)
end

-- The faces of a shell mesh are oriented anyhow: a pipe still ends in the plane of a pan's rim.
for flips = 0, 31 do
  local model = lacuna.model()
  local function grid(name, count, at, turned) -- count: cells along both sides
    local points, cells = {}, {}
    for j = 0, count[2] do
      for i = 0, count[1] do points[#points + 1] = at(i / count[1], j / count[2]) end
    end
    for j = 0, count[2] - 1 do
      for i = 1, count[1] do
        local a = j * (count[1] + 1) + i
        local cell = { a, a + 1, a + count[1] + 2, a + count[1] + 1 }
        cells[#cells + 1] = turned and { cell[4], cell[3], cell[2], cell[1] } or cell
      end
    end
    model:add_face { name = name, points = points, cells = cells }
  end
  local function pan(u, v, t) return { (120 + 20 * t) * (u - 0.5), (80 + 20 * t) * (v - 0.5), 60 * t } end
  local function is_turned(k) return flips >> k & 1 == 1 end
  grid("floor", { 14, 10 }, function(u, v) return pan(u, v, 0) end, is_turned(0))
  for k = 1, 4 do
    grid("wall", { k < 3 and 14 or 10, 6 }, function(u, t)
      local aside = k % 2
      if k < 3 then return pan(u, aside, t) end
      return pan(aside, u, t)
    end, is_turned(k))
  end
  local function pipe(angle, radius, z)
    return { 10 + radius * math.cos(2 * math.pi * angle), radius * math.sin(2 * math.pi * angle), z }
  end
  grid("pipe", { 24, 4 }, function(u, t) return pipe(u, 9, 20 + 75 * t) end)
  grid("end", { 24, 1 }, function(u, t) return pipe(u, 9 * t, 20) end)
  local open = model:open_volume {}
  open:close()
  local high = 0
  for _, face in ipairs(open:model():faces()) do high = math.max(high, face.box[2][3]) end
  check.near(high, 60, 1e-6, "orientations " .. flips)
end

do -- A level below the upper rim is another such plane.
  local model = sleeved(-20, 120, 0)
  local volume = volume_of(model, { walls = { shaft(model), bore(model) },
    fill_to = { { 0, 0, 90 }, { 0, 0, 1 } } }, 8)
  check.that(math.abs(volume / (math.pi * 1600 * 90) - 1) < 0.02, tostring(volume))
end

-- A shaft that ends inside its sleeve: the slanted ends are noted, and a level there makes the end flat.
do
  local model = sleeved(20, 120, 0)
  local roles = { source = shaft(model), target = bore(model) }
  local function said(volume)
    volume:close()
    return volume:describe():find("past the plane", 1, true) ~= nil
  end
  check.that(said(model:open_volume(roles)), "slanted end: no note")
  roles.fill_to = { { 0, 0, 20 }, { 0, 0, -1 } }
  check.that(not said(model:open_volume(roles)))
  local volume = volume_of(model, roles, 8)
  check.that(math.abs(volume / (math.pi * 1600 * 80) - 1) < 0.02, tostring(volume))
end

-- A stepped shaft with a fillet at its shoulder, longer than its sleeve: no single sweep fills the room, so
-- it is cut at the shoulder. The faces are those of the room, or its walls.
do
  local model = solids("stepped", [[
Cylinder(1) = {0,0,-30, 0,0,70, 20};  Cylinder(2) = {0,0,40, 0,0,70, 15};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
c[] = Unique(Abs(Boundary{ Surface{ Abs(Boundary{ Volume{3}; }) }; }));
For i In {0 : #c[]-1}
  b[] = BoundingBox Curve{c[i]};
  If (Abs(b[2] - 40) < 0.1 && Abs(b[5] - 40) < 0.1 && b[3] < 16)
    Fillet{3}{c[i]}{2}
  EndIf
EndFor
Cylinder(4) = {0,0,0, 0,0,80, 31};  Cylinder(5) = {0,0,0, 0,0,80, 25};
BooleanDifference(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };]])
  local faces = { model:face { kind = "torus" }, model:face { kind = "plane", near = { 0, 18.5, 40 } } }
  for _, r in ipairs { 15, 20, 25 } do
    faces[#faces + 1] = model:face { kind = "cylinder", radius = { r - 0.1, r + 0.1 } }
  end
  for _, name in ipairs { "faces", "walls" } do
    local quality = model:open_volume { [name] = faces }:sweep({ size = 3 }):quality()
    check.that(math.abs(quality.volume / 78456.5 - 1) < 0.02, name .. ": " .. quality.volume)
    check.that(quality.min_scaled_jacobian > 0.3, name)
  end
end

-- Films thinner than the sag of their facets, on one axis and off it, also at the void rings that end them.
for _, off in ipairs { 0, 0.05, 0.08 } do
  local model = solids("film", ([[
Cylinder(1) = {0,0,0, 0,0,60, 32};  Cylinder(2) = {0,0,0, 0,0,60, 25.1};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {%g,0,-20, 0,0,100, 25};]]):format(off))
  local quality = model:open_volume {
    source = model:face { kind = "cylinder", radius = { 24, 25.05 } },
    target = model:face { kind = "cylinder", radius = { 25.05, 26 } } }
    :sweep({ size = 4, layers = 3 }):quality()
  check.that(math.abs(quality.volume / (math.pi * (25.1 ^ 2 - 25 ^ 2) * 60) - 1) < 0.02, "film " .. off)
  check.that(quality.min_scaled_jacobian > 0.3, "film " .. off)
end

-- A body that stands in a pocket, or floats in it, and sticks out of its mouth or ends in its plane. No roles
-- are named.
for _, body in ipairs {
  { "Box(9) = {18,13,11.5, 14,14,13.5};", 14 * 14 * 13.5 },
  { "Box(9) = {18,13,10, 14,14,15};", 14 * 14 * 15 },
  { "Cylinder(9) = {25,20,12, 0,0,13, 6};", math.pi * 36 * 13 },
  { "Box(9) = {16,12,11.5, 17,17,20};", 17 * 17 * 13.5 },
  { "Box(9) = {16,12,10, 17,17,20};", 17 * 17 * 15 },
  { "Cylinder(9) = {25,20,10, 0,0,30, 6};", math.pi * 36 * 15 },
  { "Sphere(9) = {25,20,25, 6};", 2 / 3 * math.pi * 216 } } do
  local model = solids("pocket", [[
Box(1) = {0,0,0, 50,40,25};  Box(2) = {15,10,10, 20,20,15};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
]] .. body[1])
  local inner = model:faces { box = { { 14.9, 9.9, 9.9 }, { 35.1, 30.1, 60 } } }
  local volume, quality = volume_of(model, { faces = inner }, 2)
  check.that(math.abs(volume / (6000 - body[2]) - 1) < 0.02, body[1] .. volume)
  check.that(quality.min_scaled_jacobian > 0.3, body[1])
end

-- Tubes in the holes of their sheets: both circles of a hole are exact, their facets differ.
for n = 1, 2 do
  local text = [[
Cylinder(1) = {0,0,0, 0,0,60, 34};  Cylinder(2) = {0,0,10, 0,0,40, 30};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
]]
  for i = 1, n do
    local x, turn = 12 * (2 * i - n - 1), 0.3 * i
    text = text .. ([[
Cylinder(%d) = {%g,0,-1, 0,0,62, 5};
BooleanDifference{ Volume{3}; Delete; }{ Volume{%d}; Delete; }
Cylinder(%d) = {%g,0,0, 0,0,60, 5};  Rotate {{0,0,1},{%g,0,0},%g} { Volume{%d}; }
]]):format(10 + i, x, 10 + i, 20 + i, x, x, turn, 20 + i)
  end
  local model = solids("sheets", text)
  local inner = model:faces { box = { { -30.1, -30.1, 9.9 }, { 30.1, 30.1, 50.1 } } }
  for _, tube in ipairs(model:faces { kind = "cylinder", radius = { 4.9, 5.1 } }) do
    if tube.box[2][3] - tube.box[1][3] > 50 then inner[#inner + 1] = tube end
  end
  local volume, quality = volume_of(model, { faces = inner }, 3)
  check.that(math.abs(volume / (40 * math.pi * (900 - 25 * n)) - 1) < 0.02, n .. " tubes: " .. volume)
  check.that(quality.min_scaled_jacobian > 0.5, n .. " tubes")
end

-- A frame on a larger plate, with or without a block on the plate in it: only the part of the plate inside
-- the frame bounds the room.
for _, block in ipairs { false, true } do
  local model = solids("frame", [[
Box(1) = {-50,-50,-5, 100,100,5};
Box(2) = {-33,-33,0, 66,66,20};  Box(3) = {-30,-30,0, 60,60,20};
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
]] .. (block and "Box(5) = {-10,-8,0, 20,16,6};" or ""))
  local floor = model:face { kind = "plane", facing = { 0, 0, 1 }, near = { 0, 29, 0 } }
  local inner = model:faces { box = { { -30.1, -30.1, -0.1 }, { 30.1, 30.1, 20.1 } } }
  local volume = volume_of(model, { faces = { floor, table.unpack(inner) } }, 5)
  check.near(volume, 72000 - (block and 1920 or 0), 1e-6)
  if not block then
    check.near(volume_of(model, { source = floor, walls = inner }, 5), 72000, 1e-6)
  end
end

-- Parts that reach into each other, by little or much, are refused by name.
for _, deep in ipairs { 0.001, 0.5, 10 } do
  for _, place in ipairs { ("20,20,%g"):format(-deep), ("%g,20,0"):format(-deep),
    ("60,50,%g"):format(40 - deep) } do
    local model = solids("product", ([[
Box(1) = {0,0,0, 120,90,40};  Box(2) = {%s, 60,40,30};]]):format(place))
    check.fails(function()
      model:open_volume { faces = model:faces() }:sweep { size = 8 }
    end, "topology.faces_cross")
  end
end

-- Pieces of cuts that cross a bore share the common part of their cut faces.
do
  local shell = solids("chamber", [[
Cylinder(1) = {0,0,0, 0,0,134, 100};  Cylinder(2) = {0,0,0, 0,0,134, 12.5};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };]])
  local whole = shell:open_volume { source = { facing = { 0, 0, -1 }, kind = "plane" },
    target = { facing = { 0, 0, 1 }, kind = "plane" }, walls = "auto", name = "shell" }
  local low, rest = table.unpack(whole:cut { plane = { { 0, 0, 40 }, { 0, 0, 1 } } })
  local middle, high = table.unpack(rest:cut { plane = { { 0, 0, 90 }, { 0, 0, 1 } } })
  local function half(piece, y)
    local parts = piece:cut { plane = { { 0, y, 0 }, { 0, y, 0 } } }
    return parts[#parts]
  end
  local mesh = lacuna.assembly { half(low, 5), middle, half(high, -5) }:sweep { size = 20 }
  check.that(mesh:quality().min_scaled_jacobian > 0.3, "chamber")
end

-- Products that touch the floor along a line or at a point: where there is no mesh, both faces are named.
local refused = 0
for _, product in ipairs { "Cylinder(2) = {20,45,%g, 70,0,0, %g};",
  "Cylinder(2) = {50,10,%g, 0,70,0, %g};", "Cylinder(2) = {40,30,%g, 50,30,0, %g};" } do
  for _, lift in ipairs { 0, 1 } do
    local model = solids("product", "Box(1) = {0,0,0, 120,90,40};  " .. product:format(15 + lift, 15))
    local faces = model:faces()
    for i = #faces, 1, -1 do
      if faces[i].kind == "plane" and faces[i].box[1][3] == 40 then table.remove(faces, i) end
    end
    local ok, failed = pcall(function() model:open_volume { faces = faces }:sweep { size = 8 } end)
    if lift == 0 then
      check.that(ok or failed.code == "topology.faces_touch", tostring(failed))
      refused = refused + (ok and 0 or 1)
    else
      check.that(ok or failed.code ~= "topology.faces_touch", tostring(failed))
    end
  end
end
check.that(refused > 0, "no product is refused")

-- Two pipes and a pipe between them, cut between the two: the ends of each piece are its own, and mouths that
-- closed the walls of the whole may be among them.
for _, radius in ipairs { 7, 10 } do
  for _, cut in ipairs { 0, 10 } do
    local model = solids("pipes", ([[
Cylinder(1) = {-60,-40,0, 120,0,0, 15};  Cylinder(2) = {-60,40,0, 120,0,0, 15};
Cylinder(3) = {0,-40,0, 0,80,0, %g};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };]]):format(radius))
    local whole = model:open_volume { faces = model:faces { kind = "cylinder" }, name = "pipes" }
    local halves = whole:cut { plane = { { 0, cut, 0 }, { 0, 1, 0 } } }
    check.equal(#halves, 2)
    local mesh = lacuna.assembly(halves):sweep { size = 5 }
    local fidelity = mesh.fidelity
    check.that(math.abs(fidelity.volume / fidelity.sealed_volume - 1) < 0.01, "pipes")
    check.equal(mesh:quality().certified, true)
  end
end

-- A hub with ribs: a piece that takes no ends from the whole is returned without them.
do
  local model = solids("hub", [[
Cylinder(1) = {0,0,0, 0,0,10, 60};  Cylinder(2) = {0,0,0, 0,0,60, 25};
Point(101) = {20,-4,10};  Point(102) = {55,-4,10};  Point(103) = {20,-4,56};
Line(101) = {101,102};  Line(102) = {102,103};  Line(103) = {103,101};
Curve Loop(101) = {101,102,103};  Plane Surface(101) = {101};
r[] = Extrude {0,8,0} { Surface{101}; };
t[] = Rotate {{0,0,1},{0,0,0},Pi/2} { Duplicata { Volume{r[1]}; } };
u[] = Rotate {{0,0,1},{0,0,0},Pi} { Duplicata { Volume{r[1]}; } };
w[] = Rotate {{0,0,1},{0,0,0},-Pi/2} { Duplicata { Volume{r[1]}; } };
BooleanUnion(201) = { Volume{1}; Delete; }{ Volume{2, r[1], t[0], u[0], w[0]}; Delete; };
Cylinder(202) = {0,0,-1, 0,0,70, 15};
For k In {0:3}
  Cylinder(210+k) = {48*Cos(Pi/4+k*Pi/2), 48*Sin(Pi/4+k*Pi/2), -1, 0,0,12, 4.5};
EndFor
BooleanDifference(203) = { Volume{201}; Delete; }{ Volume{202, 210, 211, 212, 213}; Delete; };]])
  local upper = model:open_volume { name = "hub" }:cut { plane = { { 0, 0, 10 }, { 0, 0, 1 } } }[2]
  local below, above = table.unpack(upper:cut { plane = { { 0, 4, 0 }, { 0, 1, 0 } } })
  local low, mid = table.unpack(below:cut { plane = { { 0, -4, 0 }, { 0, 1, 0 } } })
  for _, piece in ipairs { above, low } do
    local first = piece:cut { plane = { { 4, 0, 0 }, { 1, 0, 0 } } }[1]
    check.equal(#first:cut { plane = { { -4, 0, 0 }, { 1, 0, 0 } } }, 2)
  end
end

-- --- levels at a rim ---------------------------------------------------------------------------------------

do
  local model = solids("canal", [[
Cylinder(1) = {0,0,0, 0,0,80, 16};  Cylinder(2) = {0,0,20, 0,0,60, 10};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0,0,30, 0,0,80, 5};]])
  local function round(r) return model:face { kind = "cylinder", radius = { r - 1, r + 1 } } end
  local function flat(z) return model:face { kind = "plane", near = { 0, 0, z } } end
  local canal, stem, floor, tip, head = round(10), round(5), flat(20), flat(30), flat(110)
  for _, level in ipairs { 80, 79.99, 60 } do
    local exact = math.pi * (100 * (level - 20) - 25 * (level - 30))
    for i, roles in ipairs {
      { faces = { floor, canal, stem, tip } },
      { faces = { floor, canal, stem, tip, head } },
      { source = { floor }, target = { tip }, walls = { canal, stem } },
      { source = { floor, tip }, walls = { canal, stem } },
    } do
      roles.fill_to = { { 0, 0, level }, { 0, 0, 1 } }
      local volume = volume_of(model, roles, 2)
      check.that(math.abs(volume / exact - 1) < 0.02,
        ("level %g, roles %d: %g, exact %g"):format(level, i, volume, exact))
    end
  end
  -- Where the side of the stem is not named, no face at the level closes the void.
  for _, level in ipairs { 80, 79.99 } do
    check.fails(function()
      local roles = { source = floor, target = tip, walls = "auto" }
      roles.fill_to = { { 0, 0, level }, { 0, 0, 1 } }
      model:open_volume(roles):sweep { size = 2, fallback = "mixed" }
    end)
  end
  -- A level leaves the sweep as it is.
  for _, level in ipairs { 80, 79.99, 60 } do
    local volume, quality = volume_of(model, { source = floor, walls = "auto",
      fill_to = { { 0, 0, level }, { 0, 0, 1 } } }, 2)
    local exact = math.pi * 100 * (level - 20)
    check.that(math.abs(volume / exact - 1) < 0.02, ("level %g: %g, exact %g"):format(level, volume, exact))
    check.that(quality.min_scaled_jacobian > 0.6, ("level %g"):format(level))
  end
  -- Without a level, the rim of the canal is the level.
  local volume = volume_of(model, { source = { floor, tip }, walls = { canal, stem } }, 2)
  check.that(math.abs(volume / (math.pi * (6000 - 1250)) - 1) < 0.02, tostring(volume))
end

local kTray = [[
Box(1) = {0,0,0, 120,80,25};  Box(2) = {3,3,3, 114,74,22};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Box(4) = {30,20,9, 60,40,2};]]
do
  local model = solids("tray", kTray)
  local inner = model:faces { box = { { 2.9, 2.9, 2.9 }, { 117.1, 77.1, 25.1 } } }
  for level, taken in pairs { [25] = 4800, [20] = 4800, [8] = 0 } do
    local exact = 114 * 74 * (level - 3) - taken
    local void = model:open_volume { faces = inner, fill_to = { { 0, 0, level }, { 0, 0, 1 } } }
    local mesh = void:sweep { size = 8 }
    check.near(mesh:quality().volume, exact, 1e-6 * exact)
    local most = -math.huge
    for i = 1, mesh.nodes do most = math.max(most, (select(3, mesh:node(i)))) end
    check.near(most, level, 1e-12)
  end
  check.fails(function()
    model:open_volume { faces = inner, fill_to = { { 0, 0, 30 }, { 0, 0, 1 } } }
  end, "closure.cut_misses")
end

-- --- faces named twice -------------------------------------------------------------------------------------

do
  local model = sleeved(0, 100, 0)
  local a, b = shaft(model), bore(model)
  local exact = volume_of(model, { faces = { a, b } }, 8)
  check.equal(volume_of(model, { faces = { a, b, a } }, 8), exact)
  check.equal(volume_of(model, { walls = { a, b, b } }, 8), exact)
  check.fails(function() model:open_volume { source = { a }, walls = { a, b } } end,
    "topology.face_in_two_roles")
end

-- --- a body opened whole -----------------------------------------------------------------------------------

--- What the program says of `lacuna fill` on standard error, and the volume that it prints.
local function fill(path, ...)
  local code, out, err = check.run(params.lacuna, params.scratch, { "fill", path, "filled.vtu", "size=8",
    "fallback=mixed", ... })
  check.equal(code, 0, err)
  return tonumber(out:match "volume:? +([%d.e+-]+)"), err
end

--- The faces that a note gives for a cavity, each as a word of the command line.
local function advised(err)
  local words = {}
  for tag in (err:match "faces={([%d, ]+)}" or ""):gmatch "%d+" do words[#words + 1] = "faces=" .. tag end
  return table.unpack(words)
end

do
  local _, path = solids("tray", (kTray:gsub("Box%(4%)[^;]*;", "")))
  local whole, err = fill(path)
  check.that(err:find("the body itself is filled", 1, true), err)
  local resin, silent = fill(path, advised(err))
  check.that(not silent:find("itself", 1, true), silent)
  check.near(resin, 114 * 74 * 22, 1e-3 * resin)
  check.near(whole, 120 * 80 * 25 - 114 * 74 * 22, 1e-3 * whole)

  local _, tube = solids("tube", [[
Cylinder(1) = {0,0,0, 0,0,100, 60};  Cylinder(2) = {0,0,0, 0,0,100, 50};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };]])
  _, err = fill(tube)
  check.that(math.abs(fill(tube, advised(err)) / (math.pi * 2500 * 100) - 1) < 0.02, err)

  -- The hollow between the halves of a mould.
  local _, mould = solids("mould", [[
Box(1) = {-50,-50,-60, 100,100,60};  Cylinder(2) = {0,0,-40, 0,0,40, 30};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Box(4) = {-50,-50,0, 100,100,30};  Cylinder(5) = {0,0,-30, 0,0,30, 20};
BooleanUnion(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };]])
  _, err = fill(mould)
  local part = math.pi * (900 * 40 - 400 * 30)
  check.that(math.abs(fill(mould, advised(err)) / part - 1) < 0.02, err)

  local _, block = solids("block", "Box(1) = {0,0,0, 20,20,20};")
  _, err = fill(block)
  check.that(not err:find("note", 1, true), err)
end

-- --- the notes of a volume that is cut ---------------------------------------------------------------------

-- A sweep says of the sealed volume what close() says, also where it cuts the volume into pieces.
do
  local _, path = solids("shaft_within", [[
Cylinder(1) = {0,0,0, 0,0,100, 60};  Cylinder(2) = {0,0,0, 0,0,100, 50};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0,0,20, 0,0,80, 30};]])
  local function noted(calls)
    local recipe = params.scratch .. "/noted.lua"
    local file = assert(io.open(recipe, "w"))
    file:write(([[
local model = require "lacuna".load %q
local volume = model:open_volume { faces = model:faces { kind = "cylinder", radius = { 29, 51 } } }
]]):format(path), calls)
    file:close()
    local code, _, err = check.run(params.lacuna, params.scratch, { recipe })
    check.equal(code, 0, err)
    local codes = {}
    for name in err:gmatch "%[(closure%.[%w_]+)%]" do codes[#codes + 1] = name end
    return table.concat(codes, " ")
  end
  local told = noted "volume:close()  volume:sweep { size = 8 }"
  check.that(told:find("closure.flat_assumed", 1, true), told)
  check.equal(noted "volume:sweep { size = 8 }", told)
end

-- --- tubes through the plates at both ends of a shell ------------------------------------------------------

do
  local shell = solids("exchanger", [[
Cylinder(1) = {0,0,0, 100,0,0, 34};  Cylinder(2) = {4,0,0, 92,0,0, 30};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0,12,0, 100,0,0, 6};  Cylinder(5) = {0,-12,0, 100,0,0, 6};
BooleanDifference(6) = { Volume{3}; Delete; }{ Volume{4,5}; Delete; };
Cylinder(7) = {-15,12,0, 130,0,0, 6};  Cylinder(8) = {-15,-12,0, 130,0,0, 6};]])
  local inner = shell:face { kind = "cylinder", radius = { 29, 31 } }
  local tubes = shell:faces { kind = "cylinder", radius = { 5.9, 6.1 } } -- and the bores of the plates
  local ends = shell:faces { kind = "plane", area = { 100, 120 } }
  local function plate(x) return shell:face { kind = "plane", near = { x, 0, 25 } } end
  local walls = { inner, table.unpack(tubes) }
  for way, roles in ipairs {
    { source = plate(4), target = plate(96), walls = walls },
    { source = plate(4), target = plate(96), walls = { inner, tubes[5], tubes[6], table.unpack(ends) } },
    { faces = { plate(4), plate(96), table.unpack(walls) } },
  } do
    local quality = shell:open_volume(roles):sweep({ size = 5 }):quality()
    check.that(quality.certified and quality.min_scaled_jacobian >= 0.7, quality.min_scaled_jacobian)
    check.that(math.abs(quality.volume / (92 * math.pi * (900 - 72)) - 1) < 0.005, way)
  end
end

-- --- faces that continue each other ------------------------------------------------------------------------

-- Nozzles that were fused to a shell: narrow faces of the shell's cylinder remain round their mouths. They
-- are meshed with the shell's face, also where the mouth lies across the seam.
for _, nozzle in ipairs { { 0, 1, 0 }, { 0.4, 1, 0 }, { 0, 1, 12 }, { 0, -1, 5 } } do
  local slope, side, off = table.unpack(nozzle)
  local axis = ("%g,%g,%g"):format(60 * slope, 0, 60 * side)
  local model = solids("nozzle", ([[
Cylinder(1) = {0,0,0, 120,0,0, 43};  Cylinder(2) = {0,0,0, 120,0,0, 40};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {50,%g,0, %s, 12};
BooleanUnion(5) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
Cylinder(6) = {0,0,0, 120,0,0, 40};  Cylinder(7) = {50,%g,0, %s, 10};
BooleanUnion(8) = { Volume{6}; Delete; }{ Volume{7}; Delete; };
BooleanDifference(9) = { Volume{5}; Delete; }{ Volume{8}; Delete; };]]):format(off, axis, off, axis))
  local shell = model:faces { kind = "cylinder", radius = { 39, 41 } }
  local bore = model:faces { kind = "cylinder", radius = { 9, 11 } }
  table.move(bore, 1, #bore, #shell + 1, shell)
  local quality = model:open_volume { faces = shell }:sweep({ size = 7 }):quality()
  check.that(quality.certified and quality.min_scaled_jacobian > 0.25, quality.min_scaled_jacobian)
  local truth = 1600 * math.pi * 120
  for i = -99.5, 99.5 do -- strips of the nozzle beyond the shell's cylinder
    local y = i / 10
    truth = truth + 0.2 * math.sqrt(100 - y * y) * (60 - math.sqrt(1600 - (y + off) ^ 2))
  end
  if slope == 0 then check.that(math.abs(quality.volume / truth - 1) < 0.01, quality.volume / truth) end
end

-- The seat of a squashed O-ring: the ring touches the floor and the lid, so that only the part of these faces
-- beside the ring bounds the gap.
do
  local model = solids("seat", [[
Cylinder(1) = {0,0,-6, 0,0,10, 45};  Cylinder(2) = {0,0,0, 0,0,4, 33.8};  Cylinder(3) = {0,0,0, 0,0,4, 26.2};
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
BooleanDifference(5) = { Volume{1}; Delete; }{ Volume{4}; Delete; };
Cylinder(6) = {0,0,4, 0,0,5, 45};
Torus(7) = {0,0,2, 30, 2.6};  Box(8) = {-50,-50,0, 100,100,4};
BooleanIntersection(9) = { Volume{7}; Delete; }{ Volume{8}; Delete; };]])
  local walls = { { kind = "cylinder", radius = { 33, 34 } }, { kind = "plane", near = { 33.7, 0, 0 } },
    { kind = "plane", near = { 33.7, 0, 4 } },
    { kind = "torus", near = { 32.4, 0, 3 } }, { kind = "torus", near = { 32.4, 0, 1 } } }
  local quality = model:open_volume({ walls = walls, full_turn = true }):sweep({ size = 0.7 }):quality()
  local flat = 30 + math.sqrt(2.6 ^ 2 - 4) -- radius where the ring leaves the floor
  local truth = math.pi * (33.8 ^ 2 - flat ^ 2) * 4
  for k = 0, 399 do
    local z = -2 + (k + 0.5) / 100
    truth = truth - math.pi * ((30 + math.sqrt(2.6 ^ 2 - z * z)) ^ 2 - flat ^ 2) / 100
  end
  check.near(quality.volume, truth, 0.02 * truth)
  check.that(quality.certified and quality.min_scaled_jacobian > 0.5, quality.min_scaled_jacobian)
end

-- Where a model lies does not change what is hollow in it: this pipe with a flange has no bore.
for _, at in ipairs { "0,0,0", "100,0,0", "0,-300,50", "-70,80,400" } do
  local model = solids("flange", ([[
Cylinder(1) = {%s, 0,0,80, 9};  Cone(2) = {%s, 0,0,-7, 9,20};
BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; }]]):format(at, at))
  check.equal(#model:cavities(), 0, at)
end

-- --- bores that cross --------------------------------------------------------------------------------------

do
  local tee = solids("tee", [[
Cylinder(1) = {0,0,-60, 0,0,120, 25};  Cylinder(2) = {0,0,0, 70,0,0, 18};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0,0,-60, 0,0,120, 20};  Cylinder(5) = {0,0,0, 70,0,0, 12.5};
BooleanUnion(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };
BooleanDifference(7) = { Volume{3}; Delete; }{ Volume{6}; Delete; };]])
  local all = tee:cavities()
  for _, cavity in ipairs(all) do check.that(cavity.volume <= all[1].volume) end
  check.that(all[1].volume > math.pi * 400 * 120)
end

-- Slots through a block that are narrower or wider at the mouth: all of the slot is the first cavity.
for _, widths in ipairs { { 24, 14 }, { 10, 24 }, { 24, 14, 30 }, { 8, 16, 24 } } do
  local lines, exact, word = {}, 0, table.concat(widths, ", ")
  for level, width in ipairs(widths) do
    lines[level] = ("Box(%d) = {0, %g, %g, 200, %g, 8};"):format(level + 1, -width / 2,
      8 * (level - 1 - #widths), width)
    exact = exact + 200 * 8 * width
  end
  check.write(params.scratch .. "/slot.geo", ([[SetFactory("OpenCASCADE");
    Box(1) = {0, -40, -50, 200, 80, 50};
    %s
    BooleanDifference(9) = { Volume{1}; Delete; }{ Volume{2:%d}; Delete; };]]):format(
    table.concat(lines, "\n"), #widths + 1))
  local model = lacuna.load(params.scratch .. "/slot.geo")
  local first = model:cavities()[1]
  check.near(first.volume, exact, 1e-6 * exact, word)
  local mesh = model:open_volume({ faces = first.faces }):sweep { size = 6 }
  check.near(mesh:quality().volume, exact, 1e-6 * exact, word)
end

check.done()
