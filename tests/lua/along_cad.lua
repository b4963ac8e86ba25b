-- SPDX-License-Identifier: MIT
-- Sources of CAD along a path: exact edges and faces, edges as paths, solids for CAD, and files written a
-- layer at a time.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")
local params = lacuna.params { scratch = "." }
local pi = math.pi

local function load(name, text)
  local path = params.scratch .. "/" .. name .. ".geo"
  local file <close> = assert(io.open(path, "w"))
  file:write('SetFactory("OpenCASCADE");\n', text)
  file:close()
  return lacuna.load(path)
end
-- A disc with a hole at x = 10 in the plane of x and z, and a quarter of a tube with edges to follow.
local part = load("disc", [[
Disk(1) = {10, 0, 0, 2};
Disk(2) = {10.5, 0, 0, 0.5};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Rotate{{1, 0, 0}, {10, 0, 0}, Pi / 2} { Surface{3}; }
]])
local source = part:faces()[1]
local area = pi * (4 - 0.25)
local Z = { { 0, 0, 0 }, { 0, 0, 1 } }
-- The centroid of the disc with its hole.
local centre = (10 * 4 - 10.5 * 0.25) / 3.75

local function sweep(along, volume, options)
  options = options or { size = 1 }
  local void = part:open_volume { source = source, along = along, name = "coil" }
  local mesh = void:sweep(options)
  local quality = mesh:quality()
  check.that(quality.certified and quality.min_scaled_jacobian > 0.3)
  check.near(quality.volume / volume, 1, options.order == 2 and 2e-3 or 0.08)
  return void, mesh
end
local cases = {
  { { vector = { 1, -6, 0 } }, 6 * area },
  { { axis = Z, angle = -100 }, area * centre * 100 / 180 * pi },
  { { helix = { { 0, 0, 0 }, { 0, 0, 1 }, 6, 1 } }, area * centre * 2 * pi },
}
for _, case in ipairs(cases) do
  local void = sweep(case[1], case[2])
  local made = void:write_cad(params.scratch .. "/solid.step")
  check.near(made.volume / case[2], 1, 1e-9) -- walls of round edges are splines
  if not case[1].helix then sweep(case[1], case[2], { size = 1, order = 2 }) end
end
-- Splines have as many spans as the turns of a square need; and a twisted bar.
do
  local sheet = lacuna.model()
  sheet:add_face { name = "s", points = { { 9, 0, 0 }, { 11, 0, 0 }, { 11, 0, 2 }, { 9, 0, 2 } },
    cells = { { 1, 2, 3, 4 } } }
  local function volume(along)
    local void = sheet:open_volume { source = "s", along = along }
    void:close()
    return void:write_cad(params.scratch .. "/swept.brep").volume
  end
  for _, turns in ipairs { 0.5, 3, 5, 10, 25 } do
    check.near(volume { helix = { { 0, 0, 0 }, { 0, 0, 1 }, 6, turns } } / (4 * 10 * 2 * turns * pi), 1, 1e-9)
  end
  check.near(volume { vector = { 0, 8, 0 }, twist = 300 } / 32, 1, 1e-9)
end

-- The bytes of sweep_to are those of write, for what is placed in layers.
for i, case in ipairs(cases) do
  for _, ending in ipairs { "msh", "vtu", "inp" } do
    local function open() return part:open_volume { source = source, along = case[1], name = "coil" } end
    local path = ("%s/%d.%s"):format(params.scratch, i, ending)
    local write = { quality = ending ~= "inp" and false or nil }
    local report = open():sweep_to(path, { size = 1.2, write = write })
    check.that(report.streamed, "streamed")
    open():sweep({ size = 1.2 }):write(path .. ".whole." .. ending, write)
    local function bytes(name)
      local file <close> = assert(io.open(name, "rb"))
      return file:read "a"
    end
    check.that(bytes(path) == bytes(path .. ".whole." .. ending), "other bytes of " .. ending)
  end
end

-- Beside a volume of another class, and with boundary layers.
local beside = part:open_volume { source = source, along = { vector = { 0, -3, 0 } }, name = "first" }
local turned = part:open_volume { source = source, along = { axis = Z, angle = 45 }, name = "second" }
local both = lacuna.assembly { beside, turned }:sweep { size = 1 }
check.that(both:quality().certified)
check.near(both:quality().volume / (area * 3 + area * centre * pi / 4), 1, 0.08)
local thin = part:open_volume { source = source, along = { axis = Z, angle = 90 } }:sweep { size = 0.8,
  boundary_layers = { walls = "walls", first = 0.02, growth = 1.4, count = 4 } }
check.that(thin:quality().certified and thin:quality().min_scaled_jacobian > 0.2)

-- Along a round edge of CAD, named by its tag: a square follows a quarter of a circle of radius 5.
local tray = load("tray", [[
Point(1) = {5, 0, 0}; Point(2) = {0, 0, 0}; Point(3) = {0, 5, 0};
Circle(1) = {1, 2, 3};
Extrude{0, 0, 4} { Curve{1}; }
Rectangle(10) = {0, 0, 0, 1, 1};
Rotate{{1, 0, 0}, {0, 0, 0}, Pi / 2} { Surface{10}; }
Translate{4.5, 0, -0.5} { Surface{10}; }
]])
local round
for _, edge in ipairs(tray:info().free_edges) do
  if math.abs(edge.length - 2.5 * pi) < 0.05 then round = round or edge.tag end
end
local square = tray:face { kind = "plane" }
local rail = tray:open_volume { source = square, along = { path = { round } } }
  :sweep { size = 0.25, layers = 32 }
check.near(rail:quality().volume / (2.5 * pi), 1, 1e-3)
check.that(rail:quality().min_scaled_jacobian > 0.9)

-- A cylinder's face grows along its normals, by exact circles.
local half = load("half", "Cylinder(1) = {0, 0, 0, 0, 0, 5, 2, Pi};")
local mantle = half:face { kind = "cylinder" }
local coat = half:open_volume { source = mantle, along = { normals = 0.5 } }:sweep { size = 0.4, layers = 2 }
check.near(coat:quality().volume / (pi / 2 * (2.5 ^ 2 - 4) * 5), 1, 0.01)


-- A pin through a shorter bore: the rims of a tube coincide in its section, so nothing is laid out between
-- the outlines of both ends, and the other plans fill the room.
local pin = load("pin", [[
Cylinder(1) = {0, 0, -5, 0, 0, 20, 5};
Box(2) = {-15, -15, 0, 30, 30, 10};
Cylinder(3) = {0, 0, -1, 0, 0, 12, 5.5};
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
]])
local around = pin:open_volume { source = { radius = { 4.9, 5.1 } }, target = { radius = { 5.4, 5.6 } } }
check.that(around:sweep({ size = 1, layers = 3 }):quality().certified)
check.done()
