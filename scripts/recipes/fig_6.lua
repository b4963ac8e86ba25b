-- SPDX-License-Identifier: MIT
-- The open volume of the paper's Figure 6: a source, a target and one wall, which one void edge and two void
-- faces close.
--
-- Here it is a wedge of a cylinder: its curved side is given, and the two flat ones that meet on the axis are
-- not. The corner on the axis is the wall-free vertex, the axis the void edge.
local lacuna = require "lacuna"

local params = lacuna.params {
  angle  = 100.0,   -- of the wedge [degrees]
  layers = 16,
  size   = 1.6,
  output = "fig_6.msh",
}

local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write(([[
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 30, 20, %.17g*Pi/180};
]]):format(params.angle))
cad:close()

local part = lacuna.load(cad_path)
local void = part:open_volume {
  source = { kind = "plane", facing = { 0, 0, -1 } },
  target = { kind = "plane", facing = { 0, 0, 1 } },
  walls  = { kind = "cylinder" },
}
print("class", void.class)
assert(void.class == "II", void.class)

local closure = void:close()
print(void:tree())
assert(closure.void_edges == 1 and closure.void_faces == 2 and closure.watertight)

local mesh = void:sweep { layers = params.layers, size = params.size }
print(mesh:quality())
mesh:write(params.output)
print("written", params.output)
