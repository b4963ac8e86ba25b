-- SPDX-License-Identifier: MIT
-- Round holes that wind around each other: walls without vertices do not tell how their loops rotate, and if
-- each rotated on its own, cells between them would fold.
-- usage: lacuna twisted.lua
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")

local height, levels, twist = 3, 16, math.rad(120)

--- A wall round (x, y) that turns about the z axis on its way up. @param hole  seen from inside
local function add_wall(model, name, x, y, radius, facets, hole)
  local points, cells = {}, {}
  for j = 0, levels do
    local c, s = math.cos(twist * j / levels), math.sin(twist * j / levels)
    for i = 0, facets - 1 do
      local a = 2 * math.pi * i / facets
      local px, py = x + radius(a) * math.cos(a), y + radius(a) * math.sin(a)
      points[#points + 1] = { c * px - s * py, s * px + c * py, height * j / levels }
    end
  end
  for j = 0, levels - 1 do
    for i = 0, facets - 1 do
      local a, b = j * facets + i + 1, j * facets + (i + 1) % facets + 1
      local c, d = b + facets, a + facets
      cells[#cells + 1] = hole and { a, c, b } or { a, b, c }
      cells[#cells + 1] = hole and { a, d, c } or { a, c, d }
    end
  end
  model:add_face { name = name, points = points, cells = cells }
end

for _, case in ipairs { { lobes = 0, holes = 2 }, { lobes = 0, holes = 3 }, { lobes = 4, holes = 3 } } do
  local model, walls = lacuna.model(), { "outer" }
  local function outer(a) return case.lobes == 0 and 1 or 1 + 0.15 * math.cos(case.lobes * a) end
  add_wall(model, "outer", 0, 0, outer, 48)
  for h = 1, case.holes do
    local at = 2 * math.pi * h / case.holes
    walls[h + 1] = "hole_" .. h
    add_wall(model, walls[h + 1], 0.5 * math.cos(at), 0.5 * math.sin(at), function() return 0.2 end, 16, true)
  end
  local quality = model:open_volume { walls = walls }:sweep { size = 0.25, layers = 12 }:quality()
  check.that(quality.certified and quality.min_scaled_jacobian > 0.4,
      ("%d lobes, %d holes: %s"):format(case.lobes, case.holes, quality.min_scaled_jacobian))
end

-- A duct of 40 x 20 that becomes one of 20 x 40: a quarter turn to the left and one to the right fit equally
-- well, so its walls are not twisted; a note tells that other pairs of vertices fit.
do
  local model = lacuna.model()
  for name, side in pairs { low = { 20, 10, 0 }, high = { 10, 20, 30 } } do
    local a, b, z = table.unpack(side)
    model:add_face { name = name, points = { { -a, -b, z }, { a, -b, z }, { a, b, z }, { -a, b, z } },
      cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
  end
  local volume = model:open_volume { source = "low", target = "high" }
  check.equal(#volume:match().notes, 1)
  check.near(volume:sweep { size = 5 }:quality().volume / 26000, 1, 1e-6)
end

-- An L whose notch lies at the next corner above: the shapes fit after a quarter turn, which is noted.
do
  local model = lacuna.model()
  local function corners(z, turned)
    local points = { { 0, 0 }, { 30, 0 }, { 30, 10 }, { 10, 10 }, { 10, 30 }, { 0, 30 } }
    for _, p in ipairs(points) do
      local x, y = p[1] - 15, p[2] - 15
      p[1], p[2], p[3] = turned and -y or x, turned and x or y, z
    end
    return points
  end
  for _, z in ipairs { 0, 30 } do
    model:add_face { name = "z" .. z, points = corners(z, z > 0),
      cells = { { 1, 2, 3 }, { 1, 3, 4 }, { 1, 4, 5 }, { 1, 5, 6 } } }
  end
  local notes = model:open_volume { source = "z0", target = "z30" }:match().notes
  check.that(table.concat(notes, "\n"):find("is turned by 90°", 1, true))
end

check.done()
