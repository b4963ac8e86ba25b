-- SPDX-License-Identifier: MIT
-- Class II: source, target and some of the walls; a corner of the source, and one of the target, is on none
-- of them.
--
-- A prism with a hole, two of its outer walls gone that were neighbours: the edge between them has to be made
-- too.
local lacuna = require "lacuna"

local params = lacuna.params {
  layers = 14,
  size   = 0.14,
  output = "class_2.msh",
}

local model = lacuna.synthetic.prism {
  sides = 5, radius = 1, height = 1.6, holes = 1, twist = 15, taper = 0.8,
  drop = { "wall_1", "wall_2" },
}
local void = model:open_volume { source = "source", target = "target", walls = "auto" }
print(void:describe())
assert(void.class == "II", void.class)

local closure = void:close()
print("added", closure.void_edges .. " edge, " .. closure.void_faces .. " faces")
assert(closure.void_edges == 1 and closure.void_faces == 2 and closure.watertight)

local mesh = void:sweep { layers = params.layers, size = params.size }
print(mesh:quality())
mesh:write(params.output)
print("written", params.output)
