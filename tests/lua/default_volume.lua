-- SPDX-License-Identifier: MIT
-- Without numbers the mesh has the sealed volume within 1 %: coarse facets round bars and tubes, straight, bent,
-- twisted, bulged and with noise, of order 1 and 2, alone and stacked.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")
local params = lacuna.params { only = "" }

-- Noise that is the same each time.
local seed = 1
local function random()
  seed = (seed * 16807) % 2147483647
  return seed / 2147483647
end

--- Rings of points round a way from bottom to top. `bend`: how far the way turns [radian]; `twist` likewise;
--- `bulge`: how much wider it is half way; `noise`: share of the radius.
local function rings(o)
  local result = {}
  for k = 0, o.rows do
    local t = k / o.rows
    local radius = o.radius * (1 + (o.bulge or 0) * 4 * t * (1 - t))
    local angle, across = (o.bend or 0) * t, o.length / (o.bend or 1)
    local ring = {}
    for i = 0, o.sides - 1 do
      local a = 2 * math.pi * i / o.sides + (o.twist or 0) * t + (o.turn or 0)
      local r = radius * (1 + (o.noise or 0) * (random() - 0.5))
      local x, y, z = r * math.cos(a), r * math.sin(a), o.length * t
      if o.bend then
        local out = across + x
        x, z = out * math.cos(angle) - across, out * math.sin(angle)
      end
      ring[#ring + 1] = { x, y, z }
    end
    result[#result + 1] = ring
  end
  return result
end

--- A wall of triangles between rings, its points and cells; `inside`: it faces the other way.
local function wall(list, inside)
  local points, cells, n = {}, {}, #list[1]
  for _, ring in ipairs(list) do
    for _, p in ipairs(ring) do points[#points + 1] = p end
  end
  for k = 0, #list - 2 do
    for i = 0, n - 1 do
      local j = (i + 1) % n
      local a, b, c, d = k * n + i + 1, k * n + j + 1, (k + 1) * n + j + 1, (k + 1) * n + i + 1
      for _, t in ipairs { { a, b, c }, { a, c, d } } do cells[#cells + 1] = inside and { t[3], t[2], t[1] } or t end
    end
  end
  return points, cells
end

local function cross(a, b)
  return { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] }
end

--- Volume within rings, their ends fans about the middle.
local function within(list)
  local sum = 0
  local function add(a, b, c)
    local n = cross(b, c)
    sum = sum + (a[1] * n[1] + a[2] * n[2] + a[3] * n[3]) / 6
  end
  local points, cells = wall(list)
  for _, t in ipairs(cells) do add(points[t[1]], points[t[2]], points[t[3]]) end
  for end_, ring in pairs { [-1] = list[1], [1] = list[#list] } do
    local middle = { 0, 0, 0 }
    for _, p in ipairs(ring) do for d = 1, 3 do middle[d] = middle[d] + p[d] / #ring end end
    for i, p in ipairs(ring) do
      local q = ring[i % #ring + 1]
      if end_ < 0 then add(middle, q, p) else add(middle, p, q) end
    end
  end
  return sum
end

local function bar(o)
  local list = rings(o)
  local model = lacuna.model()
  local points, cells = wall(list)
  local faces = { model:add_face { name = "wall", points = points, cells = cells } }
  local volume = within(list)
  if o.bore then
    local inner = rings(o.bore)
    points, cells = wall(inner, true)
    faces[2] = model:add_face { name = "bore", points = points, cells = cells }
    volume = volume - within(inner)
  end
  return model:open_volume { walls = faces }, volume
end

local least, worst = 1, 0
local function judge(what, volume, mesh)
  local off = mesh:quality().volume / volume - 1
  if params.only ~= "" then print(string.format("%+.2f %%  %.2f  %d  %s", 100 * off, mesh:quality().min_scaled_jacobian, mesh:quality().hexes or 0, what)) end
  worst = math.max(worst, math.abs(off))
  check.that(math.abs(off) <= 0.01, what .. string.format(": volume within 1 %%, off by %.2f %%", 100 * off))
end

local members = {}
local function member(what, o) members[#members + 1] = { what = what, o = o } end
for sides = 5, 40, 7 do
  member("prism " .. sides, { sides = sides, radius = 1, length = 2, rows = 1 })
  member("noise " .. sides, { sides = sides, radius = 1, length = 3, rows = 5, noise = 0.05 })
  member("twist " .. sides, { sides = sides, radius = 1, length = 4, rows = 8, twist = 0.6 })
  member("ruled " .. sides, { sides = sides, radius = 1, length = 4, rows = 1, twist = 2 * math.pi / sides })
  member("bend " .. sides, { sides = sides, radius = 1, length = 6, rows = 9, bend = 1.5 })
  member("barrel " .. sides, { sides = sides, radius = 1, length = 2, rows = 6, bulge = 0.3 })
  member("tube " .. sides, { sides = sides, radius = 1, length = 3, rows = 1,
    bore = { sides = math.max(5, sides - 2), radius = 0.8, length = 3, rows = 1, turn = 0.1 } })
end
for _, m in ipairs(members) do
  for order = 1, 2 do
    local volume, exact = bar(m.o)
    if m.what:find(params.only, 1, true) then
      judge(m.what .. " of order " .. order, exact, volume:sweep { order = order })
    end
  end
end
check.done(#members .. " members, off by at most " .. string.format("%.2f %%", 100 * worst))
