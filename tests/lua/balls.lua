-- SPDX-License-Identifier: MIT
-- Bodies without concave edges around a sphere or a cone: cut through its centre by three planes at right
-- angles, into parts that are divided at their middles. Pipes and domes with balls.
-- usage: lacuna balls.lua scratch=FOLDER
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local params = lacuna.params { scratch = "." }

--- Bodies by name: a function of random() that returns geometry for Open CASCADE and the volume.
local bodies = {
  ball = function(random)
    local r = random(0.5, 2)
    return ("Sphere(1) = {%.15g, 1, 2, %.15g};"):format(random(-1, 1), r), 4 / 3 * math.pi * r ^ 3
  end,
  -- A single smooth face, without the centre of a sphere.
  ellipsoid = function(random)
    local a, b, c = random(0.8, 1.6), random(0.8, 1.6), random(0.8, 1.6)
    return ("Sphere(1) = {0, 0, 0, 1}; Dilate{ {0, 0, 0}, {%.15g, %.15g, %.15g} }{ Volume{1}; }")
        :format(a, b, c), 4 / 3 * math.pi * a * b * c
  end,
  lens = function(random)
    local r, apart = random(0.8, 1.2), random(0.7, 1.1)
    local high = r - apart / 2
    return ("Sphere(1) = {0, 0, 0, %.15g}; Sphere(2) = {0, 0, %.15g, %.15g};\n"):format(r, apart, r) ..
        "BooleanIntersection{ Volume{1}; Delete; }{ Volume{2}; Delete; }",
        2 * math.pi * high ^ 2 * (r - high / 3)
  end,
  cone = function(random)
    local r, high = random(0.6, 1.2), random(1, 2)
    return ("Cone(1) = {0, 0, 0, 0, 0, %.15g, %.15g, 0};"):format(high, r), math.pi * r ^ 2 * high / 3
  end,
  dent = function(random)
    local r, high = random(0.4, 0.7), random(1.2, 2)
    return ("Box(1) = {0, 0, 0, 2, 2, %.15g}; Sphere(2) = {%.15g, 1, %.15g, %.15g};\n"):format(
        high, random(0.9, 1.1), high, r) .. "BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }",
        4 * high - 2 / 3 * math.pi * r ^ 3
  end,
  -- Three edges at a corner are rounded. Rims of the parts beside that corner correspond to several edges.
  corner = function(random)
    local r, size = random(0.3, 0.7), { random(1.5, 3), random(1.5, 3), random(1.5, 3) }
    local lost = r ^ 2 * (1 - math.pi / 4) * (size[1] + size[2] + size[3] - 3 * r) + r ^ 3 * (1 - math.pi / 6)
    return ("Box(1) = {0,0,0, %.15g,%.15g,%.15g}; e() = Curve In BoundingBox{%.15g,%.15g,%.15g, 9,9,9};\n")
        :format(size[1], size[2], size[3], -1, -1, size[3] - 1e-3) .. ([[
e() += Curve In BoundingBox{%.15g,%.15g,-1, 9,9,9};  f() = {};
For i In {0 : #e[]-1}
  b[] = BoundingBox Curve{e[i]};
  If ((b[0] > %.15g) + (b[1] > %.15g) + (b[2] > %.15g) == 2)
    f() += {e[i]};
  EndIf
EndFor
v() = Fillet{1}{f()}{%.15g};]]):format(size[1] - 1e-3, size[2] - 1e-3, size[1] - 1e-3, size[2] - 1e-3,
        size[3] - 1e-3, r), size[1] * size[2] * size[3] - lost
  end,
}

local names = {}
for name in pairs(bodies) do names[#names + 1] = name end
table.sort(names)
for _, name in ipairs(names) do
  for number = 1, check.whole and 10 or 1 do
    local random = check.random(7919 * number + #name)
    for _ = 1, 5 do random(0, 1) end
    local geo, volume = bodies[name](random)
    -- Turned, so that no plane of the cuts is one of coordinates.
    local turned = ("\nRotate{ {1, 2, 3}, {0, 0, 0}, %.15g }{ Volume{1}; }\n"):format(random(0, 1))
    local file = ("%s/%s%d.geo"):format(params.scratch, name, number)
    check.write(file, 'SetFactory("OpenCASCADE");\n' .. geo .. turned)
    local mesh = lacuna.load(file):open_volume {}:sweep {}
    local quality = mesh:quality()
    check.that(quality.certified and mesh.tets == 0 and mesh.wedges == 0, name)
    check.near(quality.volume, volume, 0.02 * volume)
    check.that(quality.min_scaled_jacobian > 0.2, name .. ": " .. quality.min_scaled_jacobian)
  end
end

-- Bodies in a room with flat ends: cut where they turn over; the underside of a lip is a wall.
local rooms = {
  egg = { "Box(1) = {-20,-20,-20, 40,40,40};  Sphere(2) = {0,0,0, 10};"
    .. "Dilate { {0,0,0}, {1, 1.2, 1.5} } { Volume{2}; }", 64e3 - 2400 * math.pi },
  ring = { "Cylinder(1) = {0,0,0, 0,0,20, 25};  Torus(2) = {0,0,8, 14, 5};",
    12500 * math.pi - 700 * math.pi ^ 2 },
  tilted = { "Box(1) = {-20,-20,-20, 40,40,40};  Sphere(2) = {0,0,0, 10};"
    .. "Dilate { {0,0,0}, {1, 1.2, 1.5} } { Volume{2}; }  Rotate { {1,2,0}, {0,0,0}, 0.2 } { Volume{2}; }",
    64e3 - 2400 * math.pi },
  rings = { "Cylinder(1) = {0,0,0, 0,0,20, 25};  Torus(2) = {0,0,7, 18, 4};  Torus(3) = {0,0,13, 7, 4};",
    12500 * math.pi - 800 * math.pi ^ 2 },
  lip = { [[
Point(1) = {0,0,0};  Point(2) = {12,0,0};  Point(3) = {15,0,3};  Point(4) = {15,0,40};  Point(5) = {14,0,46};
Point(6) = {9,0,54};  Point(7) = {7,0,60};  Point(8) = {7,0,72};  Point(9) = {8,0,72};  Point(10) = {8,0,78};
Point(11) = {0,0,78};  Point(12) = {12,0,3};
Line(1) = {1,2};  Circle(2) = {2,12,3};  Line(3) = {3,4};  Spline(4) = {4,5,6,7};  Line(5) = {7,8};
Line(6) = {8,9};  Line(7) = {9,10};  Line(8) = {10,11};  Line(9) = {11,1};
Curve Loop(1) = {1:9};  Plane Surface(1) = {1};
bottle[] = Extrude { {0,0,1}, {0,0,0}, 2*Pi } { Surface{1}; };
Box(2) = {-25,-25,-8, 50,50,95};
BooleanDifference(9) = { Volume{2}; Delete; }{ Volume{bottle[1]}; Delete; };
Recursive Delete { Surface{1}; }]],
    237500 - 39730 },
}
for name, room in pairs(rooms) do
  local path, last = params.scratch .. "/" .. name .. ".geo", name == "rings" and 3 or 2
  check.write(path, 'SetFactory("OpenCASCADE");\n' .. room[1] .. (name == "lip" and "" or
    ("\nBooleanDifference(9) = { Volume{1}; Delete; }{ Volume{2:%d}; Delete; };"):format(last)))
  local quality = lacuna.load(path):open_volume {}:sweep({ size = 3 }):quality()
  check.near(quality.volume, room[2], 0.05 * room[2]) -- three cells across a ring
  check.that(quality.certified and quality.min_scaled_jacobian > 0.3, name)
end

-- A bent tube with a round end of two faces: joining them gives the same ends again. The tube is refused, not
-- joined for ever.
for number, bend in ipairs(check.whole and { 2, 1.6, 2.5, 3 } or { 2, 2.5 }) do
  local r = 0.8
  local file = ("%s/bent%d.geo"):format(params.scratch, number)
  check.write(file, ([[
SetFactory("OpenCASCADE");  r = %.15g;  b = %.15g;
Cylinder(1) = {0, 0, -2, 0, 0, 2, r};  Disk(99) = {0, 0, 0, r};  Sphere(50) = {b, 0, b, r};
t[] = Extrude{ {0, 1, 0}, {b, 0, 0}, Pi/2 }{ Surface{99}; };
BooleanUnion(60) = { Volume{1}; Delete; }{ Volume{t[1]}; Delete; };
BooleanUnion(61) = { Volume{60}; Delete; }{ Volume{50}; Delete; };]]):format(r, bend))
  local ok, why = pcall(function() return lacuna.load(file):open_volume {}:sweep {} end)
  check.that(ok or why.code == "surface.wall_edge", tostring(why))
end

-- The parameters of a sphere that the poles bound may end a rounding error beyond them, where normals point
-- inward: facets there are as large as elsewhere, and lie along the sphere.
do
  local file = params.scratch .. "/capsule"
  check.write(file .. ".geo", [[
SetFactory("OpenCASCADE");
Cylinder(1) = {-60, 0, 0, 120, 0, 0, 40};
Sphere(2) = {-60, 0, 0, 40};
Sphere(3) = {60, 0, 0, 40};
BooleanUnion{ Volume{1}; Delete; }{ Volume{2, 3}; Delete; }
]])
  lacuna.load(file .. ".geo"):open_volume():write_cad(file .. ".step")
  lacuna.load(file .. ".step"):open_volume():write_facets(file .. ".obj")
  local points, facets = {}, 0
  for line in io.lines(file .. ".obj") do
    local x, y, z = line:match "^v (%S+) (%S+) (%S+)"
    if x then points[#points + 1] = { tonumber(x), tonumber(y), tonumber(z) } end
    local a, b, c = line:match "^f (%d+)%S* (%d+)%S* (%d+)"
    if a then
      local p, q, r = points[tonumber(a)], points[tonumber(b)], points[tonumber(c)]
      local u, v, out = {}, {}, {}
      for k = 1, 3 do u[k], v[k], out[k] = q[k] - p[k], r[k] - p[k], p[k] + q[k] + r[k] end
      out[1] = out[1] > 180 and out[1] - 180 or out[1] < -180 and out[1] + 180 or 0
      local n = { u[2] * v[3] - u[3] * v[2], u[3] * v[1] - u[1] * v[3], u[1] * v[2] - u[2] * v[1] }
      local along, length, radius = 0, 0, 0
      for k = 1, 3 do
        along, length, radius = along + n[k] * out[k], length + n[k] ^ 2, radius + out[k] ^ 2
      end
      check.that(along > 0.9 * math.sqrt(length * radius), line)
      facets = facets + 1
    end
  end
  check.that(facets > 500 and facets < 5000, facets)
end

-- Bent faces that meet without a crease are one wall where cells cannot follow the edge between them: a pipe
-- whose corner is a ball. A nozzle at the side of a dome is no poor sweep, but its default size loses volume,
-- so the dome is meshed in pieces.
do
  local random = check.random(36)
  local function swept(name, geo, volume)
    local file = ("%s/%s.geo"):format(params.scratch, name)
    check.write(file, 'SetFactory("OpenCASCADE");\n' .. geo)
    local quality = lacuna.load(file):open_volume {}:sweep({}):quality()
    check.near(quality.volume, volume, 0.02 * volume)
    check.that(quality.certified and quality.min_scaled_jacobian > 0.2, name)
  end
  for number = 1, check.whole and 6 or 2 do
    local r, a, b = random(8, 14), random(30, 60), random(30, 60)
    swept("corner" .. number, ([[
Sphere(3) = {0,0,0, %.15g};  Cylinder(1) = {0,0,0, %.15g,0,0, %.15g};
Cylinder(2) = {0,0,0, 0,%.15g,0, %.15g};
BooleanUnion(9) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };]]):format(r, a, r, b, r),
      math.pi * r ^ 2 * (a + b) + (math.pi - 4) / 3 * r ^ 3)
  end
  for number = 1, check.whole and 3 or 1 do
    local r, q, lean, out = random(30, 50), random(0.18, 0.2), random(0.7, 0.8), random(1.5, 1.6)
    q, out = q * r, out * r
    local x, z = math.sin(lean), math.cos(lean)
    swept("nozzle" .. number, ([[
Sphere(1) = {0,0,0, %.15g, 0, Pi/2, 2*Pi};  Cylinder(2) = {%.15g,0,%.15g, %.15g,0,%.15g, %.15g};
BooleanUnion(9) = { Volume{1}; Delete; }{ Volume{2}; Delete; };]]):format(
        r, 0.4 * r * x, 0.4 * r * z, (out - 0.4 * r) * x, (out - 0.4 * r) * z, q),
      math.pi * q ^ 2 * out + 2 / 3 * math.pi * (r ^ 2 - q ^ 2) ^ 1.5)
  end
end

check.done()
