-- SPDX-License-Identifier: MIT
-- Class III: source, target and some of the walls, and every corner is on one of them.
--
-- A rectangular duct round a bend. The two cylinders it runs between are given, exact, and keep their shape;
-- the flat sides are missing. Their rims are closed already, so that faces alone have to be made.
local lacuna = require "lacuna"

local params = lacuna.params {
  bend   = 110.0,   -- [degrees]
  layers = 30,
  size   = 1.5,
  output = "class_3.msh",
}

local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write(([[
SetFactory("OpenCASCADE");
Point(1) = {12, 0, -5};
Point(2) = {24, 0, -5};
Point(3) = {24, 0, 5};
Point(4) = {12, 0, 5};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Extrude { {0, 0, 1}, {0, 0, 0}, %.17g*Pi/180 } { Surface{1}; }
]]):format(params.bend))
cad:close()

local part = lacuna.load(cad_path)
local angle = math.rad(params.bend)
local void = part:open_volume {
  source = { near = { 18, 0, 0 } },
  target = { near = { 18 * math.cos(angle), 18 * math.sin(angle), 0 } },
  walls  = { kind = "cylinder" },
}
print("class", void.class)
assert(void.class == "III", void.class)

local closure = void:close()
print("added", closure.void_edges .. " edges, " .. closure.void_faces .. " faces")
assert(closure.void_edges == 0 and closure.void_faces == 2 and closure.watertight)

local mesh = void:sweep { layers = params.layers, size = params.size }
print(mesh:quality())
mesh:write(params.output)
print("written", params.output)
