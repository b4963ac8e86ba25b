-- SPDX-License-Identifier: MIT
-- Without numbers the mesh has the sealed volume within 1 %: coarse facets round bars, tubes and parts of
-- tubes, straight, bent, twisted, bulged, domed and with noise, of order 1 and 2, alone and stacked.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")

-- Noise that is the same each time.
local seed = 1
local function random()
  seed = (seed * 16807) % 2147483647
  return seed / 2147483647
end

--- Rings of points round a way from bottom to top. `bend`: how far the way turns [radian]; `twist` likewise;
--- `bulge`: how much wider it is half way; `waves`: of the radius on the way; `noise`: share of the radius.
local function rings(o)
  local result = {}
  for k = 0, o.rows do
    local t = k / o.rows
    local radius = o.radius * (1 + (o.bulge or 0) * 4 * t * (1 - t))
      * (1 + (o.waves and 0.15 * math.sin(2 * math.pi * o.waves * t) or 0))
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
      for _, t in ipairs { { a, b, c }, { a, c, d } } do
        cells[#cells + 1] = inside and { t[3], t[2], t[1] } or t
      end
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

--- A part of an elliptic tube, of `angle` [radian] and straight, between `inner` and 1.
local function shell(o)
  local model = lacuna.model()
  local arcs = {}
  for k, r in ipairs { o.inner, 1 } do
    arcs[k] = {}
    for i = 0, o.sides do
      local a = o.angle * i / o.sides
      arcs[k][i + 1] = { r * math.cos(a), o.flat * r * math.sin(a) }
    end
  end
  local last = o.sides + 1
  local sections = { arcs[1], { arcs[1][1], arcs[2][1] }, arcs[2], { arcs[2][last], arcs[1][last] } }
  local walls = {}
  for k, line in ipairs(sections) do
    local points, cells = {}, {}
    for i, p in ipairs(line) do
      points[2 * i - 1], points[2 * i] = { p[1], p[2], 0 }, { p[1], p[2], 2 }
      if i > 1 then
        local a, b, c, d = 2 * i - 3, 2 * i - 1, 2 * i, 2 * i - 2
        for _, t in ipairs { { a, b, c }, { a, c, d } } do
          cells[#cells + 1] = k == 1 and { t[3], t[2], t[1] } or t
        end
      end
    end
    walls[k] = model:add_face { name = "wall_" .. k, points = points, cells = cells }
  end
  local area = o.sides / 2 * math.sin(o.angle / o.sides) * (1 - o.inner ^ 2) * o.flat
  return model:open_volume { walls = walls }, 2 * area
end

--- A bar with a dome over its top: the dome is the source, the walls are there, the other end is missing.
local function domed(o)
  local list = rings(o)
  local model = lacuna.model()
  local points, cells = wall(list)
  local walls = { model:add_face { name = "wall", points = points, cells = cells } }
  local top, steps, dome = list[#list], o.steps or 6, {}
  for k = 0, steps - 1 do
    local t, ring = k / steps * math.pi / 2, {}
    for i, p in ipairs(top) do
      ring[i] = { p[1] * math.cos(t), p[2] * math.cos(t), o.length + o.rise * math.sin(t) }
    end
    dome[#dome + 1] = ring
    if k > 0 then list[#list + 1] = ring end
  end
  points, cells = wall(dome)
  points[#points + 1] = { 0, 0, o.length + o.rise }
  local n, last = #top, (steps - 1) * #top
  for i = 0, n - 1 do cells[#cells + 1] = { last + i + 1, last + (i + 1) % n + 1, #points } end
  local cap = model:add_face { name = "dome", points = points, cells = cells }
  -- The last ring is flat: what is above it is a pyramid.
  local area = 0
  for i, p in ipairs(dome[steps]) do
    local q = dome[steps][i % n + 1]
    area = area + (p[1] * q[2] - p[2] * q[1]) / 2
  end
  local rise = o.length + o.rise - dome[steps][1][3]
  return model:open_volume { source = cap, walls = walls }, within(list) + area * rise / 3
end

--- Two bars that share a face, the upper one narrower half way.
local function stacked(o)
  local low = rings { sides = o.sides, radius = 1, length = 2, rows = 5, bulge = o.bulge }
  local high = rings { sides = o.sides, radius = 1, length = 1, rows = 5, bulge = -o.bulge }
  for _, ring in ipairs(high) do
    for _, p in ipairs(ring) do p[3] = p[3] + 2 end
  end
  local model = lacuna.model()
  local points, cells = wall(low)
  local below = model:add_face { name = "low", points = points, cells = cells }
  points, cells = wall(high)
  local above = model:add_face { name = "high", points = points, cells = cells }
  points, cells = { { 0, 0, 2 } }, {}
  for i, p in ipairs(high[1]) do
    points[i + 1] = p
    cells[i] = { 1, i + 1, i % o.sides + 2 }
  end
  local middle = model:add_face { name = "middle", points = points, cells = cells }
  return lacuna.assembly {
    model:open_volume { source = middle, walls = { below }, name = "below" },
    model:open_volume { source = middle, walls = { above }, name = "above" } }, within(low) + within(high)
end

local worst = 0
local function judge(what, volume, mesh)
  local off = mesh:quality().volume / volume - 1
  worst = math.max(worst, math.abs(off))
  check.that(math.abs(off) <= 0.01, what .. string.format(": volume within 1 %%, off by %.2f %%", 100 * off))
end

local members = {}
local function member(what, o, make) members[#members + 1] = { what = what, o = o, make = make or bar } end
for sides = 12, 40, 7 do
  member("prism " .. sides, { sides = sides, radius = 1, length = 2, rows = 1 })
  member("noise " .. sides, { sides = sides, radius = 1, length = 3, rows = 5, noise = 0.05 })
  member("twist " .. sides, { sides = sides, radius = 1, length = 4, rows = 8, twist = 0.6 })
  member("ruled " .. sides, { sides = sides, radius = 1, length = 4, rows = 1, twist = 2 * math.pi / sides })
  member("bend " .. sides, { sides = sides, radius = 1, length = 6, rows = 9, bend = 1.5 })
  member("barrel " .. sides, { sides = sides, radius = 1, length = 2, rows = 6, bulge = 0.3 })
  member("waist " .. sides, { sides = sides, radius = 1, length = 2, rows = 6, bulge = -0.4 })
  member("dome " .. sides, { sides = sides, radius = 1, length = 2, rows = 1, rise = 0.4 }, domed)
  member("stack " .. sides, { sides = sides, bulge = 0.2 }, stacked)
  member("tube " .. sides, { sides = sides, radius = 1, length = 3, rows = 1,
    bore = { sides = sides - 2, radius = 0.8, length = 3, rows = 1, turn = 0.1 } })
end
for _, inner in ipairs { 0.5, 0.8, 0.95 } do
  for _, angle in ipairs { 1, 2, math.pi } do
    member(("part of a tube, %g, %.1f rad"):format(inner, angle),
      { sides = 24, inner = inner, angle = angle, flat = 0.5 }, shell)
  end
end
-- Few facets, with sharp creases between them.
for _, sides in ipairs { 6, 8, 12 } do
  for _, bulge in ipairs { -0.8, -0.5, 0.5, 1 } do
    member(("barrel %d by %g"):format(sides, bulge),
      { sides = sides, radius = 1, length = 2, rows = 6, bulge = bulge })
  end
  for _, rows in ipairs { 6, 12 } do
    member(("twist %d by 120 in %d"):format(sides, rows),
      { sides = sides, radius = 1, length = 4, rows = rows, twist = 2 * math.pi / 3 })
  end
  for waves = 1, 3 do
    member(("waves %d of %d"):format(waves, sides),
      { sides = sides, radius = 1, length = 4, rows = 8 * waves, waves = waves })
  end
  for _, twist in ipairs { 0.3, 0.8 } do
    member(("ruled %d by %g"):format(sides, twist),
      { sides = sides, radius = 1, length = 4, rows = 1, twist = twist })
  end
  member("stack by half " .. sides, { sides = sides, bulge = 0.5 }, stacked)
end
for steps = 2, 4 do
  member("dome 12 of " .. steps,
    { sides = 12, radius = 1, length = 2, rows = 1, rise = 0.4, steps = steps }, domed)
end
local runs, run = check.members_to_run(11), 0 -- ten of 101
for _, m in ipairs(members) do
  if not runs() then goto next end
  run = run + 1
  for order = 1, 2 do
    local volume, exact = m.make(m.o)
    judge(m.what .. " of order " .. order, exact, volume:sweep { order = order })
  end
  ::next::
end
check.done(run .. " members, off by at most " .. string.format("%.2f %%", 100 * worst))
