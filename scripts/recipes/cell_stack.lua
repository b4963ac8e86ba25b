-- SPDX-License-Identifier: MIT
-- A battery module: a cell of four sheets with a rounded outline is meshed once, stacked, and mirrored.
local lacuna = require "lacuna"

local params = lacuna.params {
  cells  = 20,         -- in each stack
  size   = 4.0,        -- edge length of the quads on a sheet [mm]
  output = "cell_stack.msh",
}

-- Half a sheet: its straight side is where the stack is mirrored.
local points, cell, n = { { 0, 0 }, { 30, 0 } }, {}, 8
for k = 0, n do
  local angle = math.pi / 2 * k / n
  points[#points + 1] = { 30 + 10 * math.sin(angle), 10 - 10 * math.cos(angle) }
end
points[#points + 1] = { 40, 30 }
points[#points + 1] = { 0, 30 }
local area = 0
for i, p in ipairs(points) do
  local q = points[i % #points + 1]
  area, cell[i] = area + (p[1] * q[2] - p[2] * q[1]) / 2, i
end

-- A fan of triangles from a point inside, for the outline has more than four corners.
local function floor_at(z)
  local model, places, fan = lacuna.model(), { { 20, 15, z } }, {}
  for i, p in ipairs(points) do
    places[i + 1], fan[i] = { p[1], p[2], z }, { 1, i + 1, i % #points + 2 }
  end
  model:add_face { name = "floor", points = places, cells = fan }
  return model
end

local height, sheets = 0, {}
for i, sheet in ipairs { { "copper", 0.4 }, { "anode", 1 }, { "separator", 0.4 }, { "cathode", 1 } } do
  sheets[i] = floor_at(height):open_volume {
    name = sheet[1], source = "floor", along = { vector = { 0, 0, sheet[2] } },
  }
  height = height + sheet[2]
end
local one = lacuna.assembly(sheets):sweep { size = params.size, layers = 1 }
local stack = one:pattern { translate = { 0, 0, height }, count = params.cells }
local mirrored = stack:copy { mirror = { { 0, 0, 0 }, { 1, 0, 0 } }, name = "mirrored" }
local mesh = lacuna.assembly({ stack, mirrored }):sweep()
print(mesh, table.concat(mesh.regions, " "))

local quality = mesh:quality()
print(quality)
assert(quality.certified and quality.min_scaled_jacobian > 0.3)
assert(mesh.hexes == 2 * params.cells * one.hexes)
assert(mesh.nodes < 2 * stack.nodes) -- both halves share the nodes between them
assert(math.abs(quality.volume / (2 * params.cells * height * area) - 1) < 0.01) -- by chords of the rounding
mesh:write(params.output)
print("written", params.output)
