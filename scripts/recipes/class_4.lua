-- SPDX-License-Identifier: MIT
-- Class IV: a source and all its walls, and no target.
--
-- A cup with a post in the middle, to be filled to the brim: the floor is a ring, the walls are a cone and a
-- cylinder, and the surface of the filling is made from the two circles they end in.
local lacuna = require "lacuna"

local params = lacuna.params {
  layers = 14,
  size   = 2.0,
  output = "class_4.msh",
}

local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write [[
SetFactory("OpenCASCADE");
Cone(1) = {0, 0, 0, 0, 0, 30, 14, 22};
Cylinder(2) = {2, 0, 0, 0, 0, 30, 6};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
]]
cad:close()

local part = lacuna.load(cad_path)
local void = part:open_volume {
  source = { kind = "plane", facing = { 0, 0, -1 } },
  walls  = { { kind = "cone" }, { kind = "cylinder" } },
}
print("class", void.class)
assert(void.class == "IV", void.class)

local closure = void:close()
print("added", closure.void_edges .. " edges, " .. closure.void_faces .. " face")
assert(closure.void_edges == 0 and closure.void_faces == 1 and closure.watertight)

local mesh = void:sweep { layers = params.layers, size = params.size }
print(mesh:quality())
mesh:write(params.output)
print("written", params.output)
