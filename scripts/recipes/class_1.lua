-- SPDX-License-Identifier: MIT
-- Class I: a source and a target, and nothing between them.
--
-- Two polygons given as facets, the upper one smaller and turned. The match finds which corner goes to which;
-- every wall is made, and the nodes lie on straight lines from the source to the target.
local lacuna = require "lacuna"

local params = lacuna.params {
  sides  = 6,
  radius = 20.0,
  height = 45.0,
  twist  = 25.0,    -- of the target against the source [degrees]
  taper  = 0.6,     -- radius of the target / radius of the source
  layers = 18,
  size   = 3.0,
  output = "class_1.msh",
}

-- A polygon as a fan of triangles round its middle.
local function polygon(radius, height, turn)
  local points, cells = { { 0, 0, height } }, {}
  for i = 1, params.sides do
    local angle = 2 * math.pi * i / params.sides + math.rad(turn)
    points[i + 1] = { radius * math.cos(angle), radius * math.sin(angle), height }
    cells[i] = { 1, i + 1, i % params.sides + 2 }
  end
  return points, cells
end

local model = lacuna.model()
local points, cells = polygon(params.radius, 0, 0)
model:add_face { name = "below", points = points, cells = cells }
points, cells = polygon(params.radius * params.taper, params.height, params.twist)
model:add_face { name = "above", points = points, cells = cells }

local void = model:open_volume { source = "below", target = "above" }
print("class", void.class)
assert(void.class == "I")

local closure = void:close()
print("added", closure.void_edges .. " edges, " .. closure.void_faces .. " faces")
assert(closure.void_edges == params.sides and closure.void_faces == params.sides and closure.watertight)

local mesh = void:sweep { layers = params.layers, size = params.size }
print(mesh:quality())
mesh:write(params.output)
print("written", params.output)
