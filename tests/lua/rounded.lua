-- SPDX-License-Identifier: MIT
-- Products with rounded edges in a box, on its floor or hovering, upright or tilted: the room round and above
-- them is cut where the rounds are as steep as they are flat, and swept.
-- usage: lacuna rounded.lua
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")

local around, arc = 48, 12 -- facets of a circle and of a quarter of one
local half, high = 40, 60  -- of the box

--- A lathe profile of rings { radius, height } as bands of facets, and a disc in the last ring if `capped`.
local function band(model, name, rings, place, capped)
  local points, cells = {}, {}
  for _, ring in ipairs(rings) do
    for i = 0, around - 1 do
      local t = 2 * math.pi * i / around
      points[#points + 1] = place(ring[1] * math.cos(t), ring[1] * math.sin(t), ring[2])
    end
  end
  for j = 0, #rings - 2 do
    for i = 0, around - 1 do
      local a, b = j * around + i + 1, j * around + (i + 1) % around + 1
      cells[#cells + 1] = { a, b, b + around }
      cells[#cells + 1] = { a, b + around, a + around }
    end
  end
  if capped then
    points[#points + 1] = place(0, 0, rings[#rings][2])
    for i = 0, around - 1 do
      local last = (#rings - 1) * around + 1
      cells[#cells + 1] = { last + i, last + (i + 1) % around, #points }
    end
  end
  model:add_face { name = name, points = points, cells = cells }
end

local function disc(model, name, radius, height, place)
  local points, cells = { place(0, 0, height) }, {}
  for i = 0, around - 1 do
    local t = 2 * math.pi * i / around
    points[i + 2] = place(radius * math.cos(t), radius * math.sin(t), height)
    cells[i + 1] = { 1, i + 2, (i + 1) % around + 2 }
  end
  model:add_face { name = name, points = points, cells = cells }
end

--- A box and a cylinder in it with rounds of `round` at its top, and at its bottom if it hovers; what they
--- leave of the box, by the facets, is the second result. The skin of a `smooth` product is one face.
local function room(radius, height, round, lift, tilt, smooth)
  local model = lacuna.model()
  local c, s = math.cos(math.rad(tilt)), math.sin(math.rad(tilt))
  local function place(x, y, z)
    z = z - height / 2
    return { x * c + z * s, y, z * c - x * s + height / 2 + lift }
  end
  local function still(x, y, z) return { x, y, z } end
  local flat = around / 2 * math.sin(2 * math.pi / around) -- area of the polygon in a unit circle
  local function turned(from, to, step) -- rings of a quarter of a circle
    local rings = {}
    for k = from, to, step do
      local t = math.pi / 2 * k / arc
      rings[#rings + 1] = { radius - round + round * math.cos(t), round * math.sin(t) }
    end
    return rings
  end
  local function lathe(rings) -- volume under a profile
    local sum = 0
    for k = 1, #rings - 1 do
      local a, b = rings[k], rings[k + 1]
      sum = sum + (b[2] - a[2]) * flat * (a[1] ^ 2 + a[1] * b[1] + b[1] ^ 2) / 3
    end
    return sum
  end
  local top, low = turned(0, arc, 1), lift > 0 and round or 0
  local profile = {}
  for _, ring in ipairs(top) do profile[#profile + 1] = { ring[1], ring[2] + height - round } end
  if smooth then
    band(model, "product", { { radius, 0 }, table.unpack(profile) }, place, true)
  else
    band(model, "round_top", profile, place)
    band(model, "side", { { radius, low }, { radius, height - round } }, place)
    disc(model, "top", radius - round, height, place)
  end
  local taken = lathe(profile) + flat * radius ^ 2 * (height - round - low)
  if lift > 0 then
    local rings = turned(arc, 0, -1)
    for _, ring in ipairs(rings) do ring[2] = round - ring[2] end
    band(model, "round_bottom", rings, place)
    disc(model, "bottom", radius - round, 0, place)
    taken = taken + lathe(rings)
  end
  local points, cells = {}, {} -- the floor: whole, or from the square to the circle
  for i = 0, around - 1 do
    local t = 2 * math.pi * i / around
    local far = half / math.max(math.abs(math.cos(t)), math.abs(math.sin(t)))
    points[i + 1] = { far * math.cos(t), far * math.sin(t), 0 }
    points[i + 1 + around] = still(radius * math.cos(t), radius * math.sin(t), 0)
    local j = (i + 1) % around
    cells[#cells + 1] = { i + 1, j + 1, j + 1 + around }
    cells[#cells + 1] = { i + 1, j + 1 + around, i + 1 + around }
  end
  if lift > 0 then
    local corner = {}
    for i = 1, around do corner[i] = points[i] end
    corner[around + 1], points, cells = { 0, 0, 0 }, corner, {}
    for i = 1, around do cells[i] = { i, i % around + 1, around + 1 } end
  end
  model:add_face { name = "floor", points = points, cells = cells }
  for side = 0, 3 do
    local wall, triangles, from = {}, {}, around // 8 + side * around // 4
    for k = 0, around // 4 do
      local p = points[(from + k) % around + 1]
      wall[2 * k + 1], wall[2 * k + 2] = p, { p[1], p[2], high }
      if k > 0 then
        triangles[#triangles + 1] = { 2 * k - 1, 2 * k + 1, 2 * k + 2 }
        triangles[#triangles + 1] = { 2 * k - 1, 2 * k + 2, 2 * k }
      end
    end
    model:add_face { name = "wall_" .. side + 1, points = wall, cells = triangles }
  end
  local lid, fan = { { 0, 0, high } }, {}
  for i = 1, around do
    lid[i + 1] = { points[i][1], points[i][2], high }
    fan[i] = { 1, i + 1, i % around + 2 }
  end
  model:add_face { name = "lid", points = lid, cells = fan }
  return model, (2 * half) ^ 2 * high - taken
end

local runs = check.members_to_run(3)
for _, share in ipairs { 0.1, 0.2, 0.4 } do
  for _, lift in ipairs { 0, 12 } do
    for _, tilt in ipairs(lift > 0 and { 0, 4, 9 } or { 0 }) do
      if runs() then
        local at = ("round %g, lift %g, tilt %g"):format(share, lift, tilt)
        local model, volume = room(20, 25, share * 20, lift, tilt)
        local void = model:open_volume {
          source = { "floor", "top" }, target = lift > 0 and { "lid", "bottom" } or "lid", walls = "auto",
        }
        local quality = void:sweep { size = 5 }:quality()
        check.that(quality.certified, at)
        check.that(quality.min_scaled_jacobian >= 0.2, ("%s: %g"):format(at, quality.min_scaled_jacobian))
        check.that(math.abs(quality.volume / volume - 1) < 0.01, at .. ": volume")
      end
    end
  end
end

-- With nothing named the axis is found, also where the product is tilted and hovers.
local tilted, space = room(20, 25, 5, 12, 7)
local pieces = tilted:open_volume()
check.equal(#pieces:cut { auto = true }, 3)
check.near(pieces:sweep { size = 5 }:quality().volume / space, 1, 0.01)

-- Named with the round, the end keeps its flat half alone: the other half is a wall.
local model, volume = room(20, 25, 6, 0, 0)
local void = model:open_volume { source = { "floor", "top", "round_top" }, target = "lid", walls = "auto" }
check.near(void:sweep { size = 5 }:quality().volume / volume, 1, 0.01)

-- The skin of a product is one smooth face, as in an .stl file: its flat part belongs to the end, the upright
-- part is a wall. Swept whole as an end, the least value was 0.1.
for _, named in ipairs { true, false } do
  local one, space_above = room(20, 25, 6, 0, 0, true)
  local roles = { source = { "floor", "product" }, target = "lid", walls = "auto" }
  local over = one:open_volume(named and roles or nil)
  local found = over:sweep { size = 5 }:quality()
  check.near(found.volume / space_above, 1, 0.01)
  check.that(found.min_scaled_jacobian >= 0.3, tostring(found.min_scaled_jacobian))
end

-- A cup without its brim: the round at its floor is divided between end and wall; undivided, the least values
-- were 0.54, 0.30 and 0.15. Both halves keep the name.
local cup, floor, up = lacuna.model(), 12, { { 15, 3 }, { 15, 10 } }
local fillet = {}
for k = 0, arc do
  local t = math.pi / 2 * k / arc
  fillet[k + 1] = { floor + 3 * math.sin(t), 3 - 3 * math.cos(t) }
end
local function still(x, y, z) return { x, y, z } end
disc(cup, "bottom", floor, 0, still)
band(cup, "round", fillet, still)
band(cup, "side", up, still)
for size, bound in pairs { [3] = 0.65, [1.5] = 0.38, [0.75] = 0.2 } do
  local mesh = cup:open_volume { source = "bottom", walls = { "round", "side" } }:sweep { size = size }
  local least = mesh:quality().min_scaled_jacobian
  check.that(least >= bound, ("cup of size %g: %g"):format(size, least))
  local names = {}
  for _, group in ipairs(mesh:groups()) do names[group.name] = group end
  check.that(names.round ~= nil, "the round keeps its name")
end

-- Two cups, each of one smooth face, between whose brims the ring is missing: all walls are missing, so that
-- nothing of the cups is a wall, and cells run from cup to cup.
for _, gap in ipairs { 3, 8 } do
  local cups = lacuna.model()
  for k, name in ipairs { "inner", "outer" } do
    local radius, low, bend, rings = 30 + (k - 1) * gap, (2 - k) * gap, 10 + (k - 1) * gap / 2, {}
    for j = 0, 8 do rings[j + 1] = { radius, 100 - j / 8 * (100 - low - bend) } end
    for j = 1, arc do
      local t = math.pi / 2 * j / arc
      rings[#rings + 1] = { radius - bend + bend * math.cos(t), low + bend - bend * math.sin(t) }
    end
    band(cups, name, rings, still, true)
  end
  local mesh = cups:open_volume { source = "inner", target = "outer" }:sweep {}
  check.that(mesh:quality().min_scaled_jacobian > 0.4, gap)
  check.near(mesh:quality().volume / mesh.fidelity.sealed_volume, 1, 0.02)
end
check.done()
