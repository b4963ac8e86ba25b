-- SPDX-License-Identifier: MIT
-- A pipe from its section alone, along a line with two bends in different planes, narrowing on its way.
local lacuna = require "lacuna"

local params = lacuna.params {
  layers = 72,         -- hexahedra along the pipe
  size   = 3.0,        -- edge length of the quads on the section [mm]
  output = "pipe_bend.msh",
}
local pi, cos, sin = math.pi, math.cos, math.sin

local ring, points, cells, n = lacuna.model(), {}, {}, 48
for k = 1, n do
  local c, s = cos(2 * pi * k / n), sin(2 * pi * k / n)
  points[k], points[n + k] = { 12 * c, 12 * s, 0 }, { 9 * c, 9 * s, 0 }
  cells[k] = { k, k % n + 1, n + k % n + 1, n + k }
end
ring:add_face { name = "inlet", points = points, cells = cells }

-- Up, a bend to x, a bend to y: straight parts of 40 and quarters of circles of radius 40.
local radius, straight = 40, 40
local quarter = radius * pi / 2
local length = 3 * straight + 2 * quarter
local function place(t)
  local s = t * length
  local x, y, z = 0, 0, math.min(s, straight)
  local a = math.max(0, math.min(s - straight, quarter)) / radius
  x, z = x + radius * (1 - cos(a)), z + radius * sin(a)
  x = x + math.max(0, math.min(s - straight - quarter, straight))
  local b = math.max(0, math.min(s - 2 * straight - quarter, quarter)) / radius
  x, y = x + radius * sin(b), y + radius * (1 - cos(b))
  return x, y + math.max(0, s - 2 * straight - 2 * quarter), z
end
local narrow = 0.7
local function scale(h) return 1 - (1 - narrow) * h * h * (3 - 2 * h) end

local pipe = ring:open_volume { source = "inlet", along = { path = place, scale = scale }, name = "steel" }
assert(pipe.class == "0")
local mesh = pipe:sweep { size = params.size, layers = params.layers }
for _, line in ipairs(mesh.report) do print(line) end
local quality = mesh:quality()
print(quality)
assert(quality.certified and quality.min_scaled_jacobian > 0.8)
-- The section times the length, with the mean of scale².
local area, mean, steps = n / 2 * sin(2 * pi / n) * (12 ^ 2 - 9 ^ 2), 0, 1000
for k = 1, steps do mean = mean + scale((k - 0.5) / steps) ^ 2 / steps end
assert(math.abs(quality.volume / (area * length * mean) - 1) < 0.02, quality.volume)
mesh:write(params.output)
print("written", params.output)
