-- SPDX-License-Identifier: MIT
-- The void between a box and what is packed in it.
--
-- Two products, a tapered bottle and a can, stand in a box. Known are the floor and the lid of the space
-- between (both with the holes the products leave), the skins of the products and two of the box's four
-- sides. The other two sides were never modelled: no CAD program would call this a body. Lacuna adds what is
-- missing, one edge and two faces, and fills the space with hexahedra.
--
--   scripts/run scripts/recipes/first_void.lua layers=16 size=4 output=foam.msh
local lacuna = require "lacuna"

local params = lacuna.params {
  layers = 12,                -- hexahedra from the floor to the lid
  size   = 5.0,               -- edge length of the quads on the floor [mm]
  output = "first_void.msh",
}

-- The CAD is made here, so that the recipe needs no other file; usually it is lacuna.load "box.step".
local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write [[
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 120, 80, 60};
Cone(2) = {38, 40, 0, 0, 0, 60, 22, 12};
Cylinder(3) = {88, 40, 0, 0, 0, 60, 15};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
]]
cad:close()

local part = lacuna.load(cad_path)
print(part:describe())

local void = part:open_volume {
  source = { kind = "plane", facing = { 0, 0, -1 } },
  target = { kind = "plane", facing = { 0, 0, 1 } },
  walls  = {
    { kind = "cone" },
    { kind = "cylinder" },
    { kind = "plane", facing = { -1, 0, 0 } },
    { kind = "plane", facing = { 0, 1, 0 } },
  },
}
print("class", void.class)
assert(void.class == "II", "two neighbouring sides are missing, so one corner of the floor is on no wall")

local closure = void:close()
print("added", closure.void_edges .. " edge, " .. closure.void_faces .. " faces",
      table.concat(closure.algorithms, ", "))
assert(closure.void_edges == 1 and closure.void_faces == 2 and closure.watertight)

local mesh = void:sweep { layers = params.layers, size = params.size }
print(mesh:quality())
mesh:write(params.output)
print("written", params.output)
