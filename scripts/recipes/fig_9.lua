-- SPDX-License-Identifier: MIT
-- The open volume of the paper's Figure 9: two cylinders, one inside the other, and nothing else.
--
-- The inner one is the source, the outer one the target, and the sweep goes outward. The walls are the rings
-- above and below; with a closed edge on each side they have no four corners to map, so they are made as
-- strips between two loops (Algorithm 5).
local lacuna = require "lacuna"

local params = lacuna.params {
  inner  = 10.0,
  outer  = 18.0,
  height = 24.0,
  layers = 8,
  size   = 1.6,
  output = "fig_9.msh",
}

local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write(([[
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, %.17g, %.17g};
Cylinder(2) = {0, 0, 0, 0, 0, %.17g, %.17g};
]]):format(params.height, params.inner, params.height, params.outer))
cad:close()

local part = lacuna.load(cad_path)
local cylinders = part:faces { kind = "cylinder" }
table.sort(cylinders, function(a, b) return a.area < b.area end)
assert(#cylinders == 2)

local void = part:open_volume { source = cylinders[1], target = cylinders[2] }
print("class", void.class)
assert(void.class == "I", void.class)

local closure = void:close()
print("added", closure.void_faces .. " faces", table.concat(closure.algorithms, ", "))
assert(closure.void_faces == 2 and closure.watertight)

local mesh = void:sweep { layers = params.layers, size = params.size }
print(mesh:quality())
mesh:write(params.output)
print("written", params.output)
