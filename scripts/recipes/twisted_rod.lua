-- SPDX-License-Identifier: MIT
-- A fuel rod with four lobes that turns about its axis, from its bottom face alone.
local lacuna = require "lacuna"

local params = lacuna.params {
  layers = 60,         -- hexahedra along the rod
  size   = 0.8,        -- edge length of the quads on the bottom [mm]
  twist  = 270,        -- degrees on the whole height
  output = "twisted_rod.msh",
}

local rod, points, cells, n = lacuna.model(), { { 0, 0, 0 } }, {}, 96
local area = 0
local function corner(k)
  local angle = 2 * math.pi * k / n
  local radius = 5 * (1 + 0.25 * math.cos(4 * angle))
  return { radius * math.cos(angle), radius * math.sin(angle), 0 }
end
for k = 1, n do
  local p, q = corner(k), corner(k + 1)
  points[k + 1], cells[k] = p, { 1, k + 1, k % n + 2 }
  area = area + (p[1] * q[2] - p[2] * q[1]) / 2
end
rod:add_face { name = "bottom", points = points, cells = cells }

local fuel = rod:open_volume {
  source = "bottom", along = { vector = { 0, 0, 60 }, twist = params.twist }, name = "fuel",
}
local mesh = fuel:sweep { size = params.size, layers = params.layers }
for _, line in ipairs(mesh.report) do print(line) end
local quality = mesh:quality()
print(quality)
assert(quality.certified and quality.min_scaled_jacobian > 0.5)
assert(math.abs(quality.volume / (60 * area) - 1) < 0.02, quality.volume)
mesh:write(params.output)
print("written", params.output)
