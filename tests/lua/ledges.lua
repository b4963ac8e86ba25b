-- SPDX-License-Identifier: MIT
-- Ledges, shelves, stairs and bosses in a tray, flush with its walls or with each other, with a lid or not.
-- Each is filled to the brim, and to levels below it.
-- usage: lacuna ledges.lua
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")

local unit, deep = 4, 4 -- side of a block, blocks from the floor to the brim

--- The void above blocks piled in a tray: its model, roles and volume. `height` is that of each pile.
local function tray(height, side, with_lid)
  local planes, volume = {}, 0 -- unit squares by plane, side and place
  local function pile(i, j) return height[i] and height[i][j] or deep end
  local function add(plane, u, v, ...)
    planes[plane] = planes[plane] or {}
    planes[plane][u * 100 + v] = { u = u, v = v, ... }
  end
  for i = 0, side do
    for j = 0, side do
      local z, x, y = pile(i, j), pile(i + 1, j), pile(i, j + 1)
      if i > 0 and j > 0 then
        volume = volume + (deep - z) * unit ^ 3
        add("source " .. z, i, j, { i - 1, j - 1, z }, { i, j - 1, z }, { i, j, z }, { i - 1, j, z })
        if with_lid then
          add("target", i, j, { i - 1, j - 1, deep }, { i, j - 1, deep }, { i, j, deep }, { i - 1, j, deep })
        end
      end
      for k = math.min(z, x), j > 0 and math.max(z, x) - 1 or -1 do
        add(("x %d %s"):format(i, z < x), j, k,
          { i, j - 1, k }, { i, j, k }, { i, j, k + 1 }, { i, j - 1, k + 1 })
      end
      for k = math.min(z, y), i > 0 and math.max(z, y) - 1 or -1 do
        add(("y %d %s"):format(j, z < y), i, k,
          { i - 1, j, k }, { i, j, k }, { i, j, k + 1 }, { i - 1, j, k + 1 })
      end
    end
  end
  local model, roles = lacuna.model(), { source = {}, target = {}, walls = {} }
  local names = {}
  for plane in pairs(planes) do names[#names + 1] = plane end
  table.sort(names)
  for _, plane in ipairs(names) do -- a face for each connected set of squares
    local left = planes[plane]
    for place = 0, 100 * (side + 1) do
      local next, points, cells = { left[place] }, {}, {}
      left[place] = nil
      while #next > 0 do
        local square = table.remove(next)
        local n = #points
        for _, p in ipairs(square) do points[#points + 1] = { unit * p[1], unit * p[2], unit * p[3] } end
        cells[#cells + 1], cells[#cells + 2] = { n + 1, n + 2, n + 3 }, { n + 1, n + 3, n + 4 }
        for _, step in ipairs { 1, -1, 100, -100 } do
          local other = square.u * 100 + square.v + step
          next[#next + 1], left[other] = left[other], nil
        end
      end
      if #cells > 0 then
        local name = plane .. " " .. place
        model:add_face { name = name, points = points, cells = cells }
        table.insert(roles[plane:match "^source" or plane:match "^target" or "walls"], name)
      end
    end
  end
  return model, roles, volume
end

--- Whether piles touch along an edge alone, where no skin is.
local function touch_at_an_edge(height, side)
  for i = 1, side - 1 do
    for j = 1, side - 1 do
      local a, b, c, d = height[i][j], height[i + 1][j + 1], height[i][j + 1], height[i + 1][j]
      if math.min(a, b) > math.max(c, d) or math.min(c, d) > math.max(a, b) then return true end
    end
  end
end

--- The volume below a level, and the number of separate parts that the piles leave of it.
local function below(height, side, level)
  local volume, parts, seen = 0, 0, {}
  local function walk(i, j)
    if not height[i] or not height[i][j] or height[i][j] >= level or seen[i * 100 + j] then return false end
    seen[i * 100 + j] = true
    volume = volume + (level - height[i][j]) * unit ^ 3
    for _, step in ipairs { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } } do walk(i + step[1], j + step[2]) end
    return true
  end
  for i = 1, side do
    for j = 1, side do parts = parts + (walk(i, j) and 1 or 0) end
  end
  return volume, parts
end

local random = check.random(7)
local members, tried, refused = 0, 0, 0
while members < (check.whole and 200 or 16) do
  local side, height, text = members % 2 + 3, {}, {}
  for i = 1, side do
    height[i] = {}
    for j = 1, side do height[i][j] = math.max(0, math.floor(random(-2, 2.999))) end
    text[i] = table.concat(height[i])
  end
  if not touch_at_an_edge(height, side) then
    local with_lid = members % 4 == 3
    local at = table.concat(text, "/") .. (with_lid and ", with a lid" or "")
    local model, roles, volume = tray(height, side, with_lid)
    local quality = model:open_volume(roles):sweep { size = 2 }:quality()
    check.that(quality.certified, at)
    check.that(quality.min_scaled_jacobian >= 0.5, ("%s: %g"):format(at, quality.min_scaled_jacobian))
    check.that(math.abs(quality.volume / volume - 1) < 1e-9, at .. ": volume")
    local level = ({ 0.5, 1, 1.5, 2.5 })[members % 4 + 1]
    local filled, parts = below(height, side, level)
    roles.fill_to = { { 0, 0, unit * level }, { 0, 0, 1 } }
    if parts == 1 then
      local void = model:open_volume(roles)
      local fine, own = pcall(function() return void:sweep { size = 2 }:quality() end)
      tried, refused = tried + 1, refused + (fine and 0 or 1)
      check.that(not fine or own.certified and math.abs(own.volume / filled - 1) < 1e-9,
        ("%s, filled to %g: volume, wanted is %g"):format(at, level, filled))
    elseif parts > 1 then
      check.fails(function() model:open_volume(roles) end, parts .. " separate parts", "closure.fill_to")
    end
    members = members + 1
  end
end
-- Where the side of a ledge and of a pile above the level are one face, a few are refused.
check.that(refused <= 0.05 * tried, ("%d of %d levels refused"):format(refused, tried))

-- A level at the brim fills the tray; levels above it, and planes that are none, are refused.
local model, roles, volume = tray({ { 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 0 } }, 3)
roles.fill_to = { { 0, 0, deep * unit }, { 0, 0, 1 } }
local to_brim = model:open_volume(roles):sweep({ size = 2 }):quality().volume
check.that(math.abs(to_brim / volume - 1) < 1e-9, "brim: " .. to_brim)
roles.fill_to = { { 0, 0, 99 }, { 0, 0, 1 } }
check.fails(function() model:open_volume(roles) end, "closure.cut_misses")
for _, wrong in ipairs { 3, { { 0, 0, 1 } }, { { 0, 0, 1 }, { 0, 0, 0 } } } do
  roles.fill_to = wrong
  check.fails(function() model:open_volume(roles) end, "fill_to")
end
check.done()
