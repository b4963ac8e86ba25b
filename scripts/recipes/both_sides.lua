-- SPDX-License-Identifier: MIT
-- Two voids on both sides of a given plate: each is closed by itself, and they share the plate's quads.
--
-- The plate is one face that both voids have as an end. Of the box below three sides are modelled, of the
-- channel above, which covers only part of the plate, two. The plate is split along the channel's rim.
local lacuna = require "lacuna"

local params = lacuna.params {
  size   = 0.5,        -- edge length of the quads on the plate [mm]
  output = "both_sides.msh",
}

local function quad(model, name, a, b, c, d)
  return model:add_face { name = name, points = { a, b, c, d }, cells = { { 1, 2, 3, 4 } } }
end
local plate = { { 0, 0, 0 }, { 8, 0, 0 }, { 8, 5, 0 }, { 0, 5, 0 } }

local below = lacuna.model()
quad(below, "plate", table.unpack(plate))
quad(below, "floor", { 0, 0, -3 }, { 8, 0, -3 }, { 8, 5, -3 }, { 0, 5, -3 })
quad(below, "left", { 0, 0, -3 }, { 0, 5, -3 }, { 0, 5, 0 }, { 0, 0, 0 })
quad(below, "right", { 8, 0, -3 }, { 8, 5, -3 }, { 8, 5, 0 }, { 8, 0, 0 })
quad(below, "front", { 0, 0, -3 }, { 8, 0, -3 }, { 8, 0, 0 }, { 0, 0, 0 })

local above = lacuna.model()
quad(above, "plate", { 2, 0, 0 }, { 6, 0, 0 }, { 6, 5, 0 }, { 2, 5, 0 })
quad(above, "lid", { 2, 0, 2 }, { 6, 0, 2 }, { 6, 5, 2 }, { 2, 5, 2 })
quad(above, "left", { 2, 0, 0 }, { 2, 5, 0 }, { 2, 5, 2 }, { 2, 0, 2 })
quad(above, "right", { 6, 0, 0 }, { 6, 5, 0 }, { 6, 5, 2 }, { 6, 0, 2 })

local box = below:open_volume { name = "box", source = "floor", target = "plate",
  walls = { "left", "right", "front" } }
local channel = above:open_volume { name = "channel", source = "plate", target = "lid",
  walls = { "left", "right" } }

local mesh = lacuna.assembly { box, channel }:sweep { size = params.size }
for _, line in ipairs(mesh.report) do print(line) end
local quality = mesh:quality()
print(quality)
assert(quality.certified and quality.min_scaled_jacobian > 0.9)
assert(math.abs(mesh.fidelity.volume - (8 * 5 * 3 + 4 * 5 * 2)) < 1e-9)
mesh:write(params.output)
print("written", params.output)
