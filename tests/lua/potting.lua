-- SPDX-License-Identifier: MIT
-- Pots with boards on standoffs or floating, components on the boards and posts beside them, filled to the
-- brim, which is missing, or to a level below it. The faces come as the skin of the resin, as solids that
-- touch, or as one solid.
-- usage: lacuna potting.lua scratch=FOLDER [first=N last=N]
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local params = lacuna.params { scratch = ".", first = 0, last = -1 }

local kNear, kWall = 1e-3, 4 -- a tolerance; thickness of the pot's walls

--- The pot `number` as CAD: its file, its size, its height levels and the exact volume of the resin.
local function pot(number)
  local draw = check.random(6007 * number + 31)
  for _ = 1, 5 do draw(0, 1) end
  local function whole(low, high) return math.min(high, math.floor(draw(low, high + 1))) end
  local function kind() return draw(0, 1) < 0.6 and "round" or "square" end
  local long, wide, under, thick = draw(50, 90), draw(36, 60), draw(4, 8), draw(1.6, 3)
  local deep = under + thick + draw(8, 16)
  local round = draw(0, 1) < 0.4 and draw(3, 8) or 0
  local floats = draw(0, 1) < 0.25
  local p = { long = long, wide = wide, deep = deep, low = under, high = under + thick, floats = floats,
    form = ({ "skin", "solids", "one" })[number % 3 + 1] }
  local lines, count, taken = { 'SetFactory("OpenCASCADE");' }, 0, 0
  local function add(text, ...) lines[#lines + 1] = text:format(...) end
  local function solid(text, ...)
    count = count + 1
    add(text, count, ...)
    return count
  end
  local function box(x, y, z, u, v, w) return solid("Box(%d) = {%g,%g,%g, %g,%g,%g};", x, y, z, u, v, w) end
  local function post(x, y, z, height, half, of)
    if of == "round" then
      taken = taken + math.pi * half ^ 2 * height
      return solid("Cylinder(%d) = {%g,%g,%g, 0,0,%g, %g};", x, y, z, height, half)
    end
    taken = taken + 3.2 * half ^ 2 * height
    return box(x - half, y - 0.8 * half, z, 2 * half, 1.6 * half, height)
  end
  local cavity = box(0, 0, 0, long, wide, deep)
  if round > 0 then add("Fillet{%d}{1,3,5,7}{%g}", cavity, round) end
  local beside = draw(6, 10)
  local x, y, u, v = beside, beside, long - beside, wide - beside
  if draw(0, 1) < 0.3 then u = x + (u - x) * draw(0.5, 0.8) end
  local inside, all = {}, {} -- what stands on the floor, and what is in the pot
  if not floats then
    local number_of, half, of = whole(2, 4), draw(2, 3.2), kind()
    local off = half + 1
    local places = { { x + off, y + off }, { u - off, v - off }, { u - off, y + off }, { x + off, v - off } }
    for i = 1, number_of do inside[i] = post(places[i][1], places[i][2], 0, under, half, of) end
  end
  local board = box(x, y, under, u - x, v - y, thick)
  taken = taken + (u - x) * (v - y) * thick
  local parts = {}
  for i = 1, whole(0, 3) do
    local half, height = math.min(draw(2, 3.5), (u - x) / 9), draw(2, 0.7 * (deep - p.high))
    parts[i] = post(x + (u - x) * i / 4, y + (v - y) * draw(0.3, 0.7), p.high, height, half, kind())
  end
  if draw(0, 1) < 0.3 and u < long - 2 * beside then
    inside[#inside + 1] = post((u + long) / 2, wide / 2, 0, draw(3, deep - 2), draw(1.5, 2.5), kind())
  end
  if draw(0, 1) < 0.25 and p.form ~= "skin" then p.level = deep - draw(0.5, 2) end
  for _, list in ipairs { inside, { board }, parts } do table.move(list, 1, #list, #all + 1, all) end
  local function united(list) return table.concat(list, ",") end
  if p.form == "skin" then
    add("all() = {%s};", united(all))
    if #all > 1 then add("all() = BooleanUnion{ Volume{%d}; Delete; }{ Volume{%s}; Delete; };", all[1],
        table.concat(all, ",", 2)) end
    add("BooleanDifference{ Volume{%d}; Delete; }{ Volume{all()}; Delete; }", cavity)
  else
    local outer = box(-kWall, -kWall, -kWall, long + 2 * kWall, wide + 2 * kWall, deep + kWall)
    add("BooleanDifference(500) = { Volume{%d}; Delete; }{ Volume{%d}; Delete; };", outer, cavity)
    local one = p.form == "one"
    if one and floats and #parts > 0 then
      add("BooleanUnion{ Volume{%d}; Delete; }{ Volume{%s}; Delete; }", board, united(parts))
    end
    local joined = one and not floats and all or inside
    if #joined > 0 then
      add("BooleanUnion{ Volume{500}; Delete; }{ Volume{%s}; Delete; }", united(joined))
    end
  end
  p.path = params.scratch .. "/pot.geo"
  check.write(p.path, table.concat(lines, "\n") .. "\n")
  p.volume = (long * wide - (4 - math.pi) * round ^ 2) * (p.level or deep) - taken
  p.size = draw(0, 1) < 0.5 and draw(2.5, 4) or nil
  return p
end

--- The roles of the faces in the pot; those in its brim are left out.
local function roles(p, model)
  local found = { source = {}, walls = {}, name = "resin" }
  local within = { { -kNear, -kNear, -kNear }, { p.long + kNear, p.wide + kNear, p.deep + kNear } }
  for _, face in ipairs(model:faces { box = within }) do
    local up, at = face.normal[3], face.centroid[3]
    if p.form == "skin" and math.abs(up) > 0.9 then -- normals of the resin, or of what floats in it
      up = (math.abs(at - p.low) < kNear or at > p.deep - kNear) and -1 or 1
      if math.abs(at - p.high) < kNear and face.area < 50 then up = nil end -- a part's bottom on the board
    end
    if up and up > 0.9 then
      table.insert(found.source, face)
    elseif up and up > -0.9 then
      table.insert(found.walls, face)
    elseif up and at < p.deep - kNear then
      found.target = found.target or {}
      table.insert(found.target, face)
    end
  end
  if p.level then found.fill_to = { { 0, 0, p.level }, { 0, 0, 1 } } end
  return found
end

local function fills(number)
  local p = pot(number)
  local at = ("%d %s%s%s"):format(number, p.form, p.floats and ", floating" or "",
    p.level and ", level" or "")
  local fine, mesh = pcall(function()
    local model = lacuna.load(p.path)
    return model:open_volume(roles(p, model)):sweep { size = p.size }
  end)
  check.that(fine, at .. ": " .. tostring(mesh))
  local quality = mesh:quality()
  check.that(quality.certified and quality.min_scaled_jacobian > 0.2, ("%s: %g"):format(at,
    quality.min_scaled_jacobian))
  check.that(math.abs(quality.volume / p.volume - 1) < (p.size and 0.02 or 0.01), at .. ": volume")
  return ("%s: least scaled Jacobian %.3f, volume %+.4f"):format(at, quality.min_scaled_jacobian,
    quality.volume / p.volume - 1)
end

check.family(params, fills)
