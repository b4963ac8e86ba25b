-- SPDX-License-Identifier: MIT
-- A tray and boards in it as solids of their own: on its floor, on each other, flush with its walls. What two
-- faces share does not bound the void. Rounded products touch the floor in less than their outline.
-- usage: lacuna touching.lua scratch=FOLDER
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local params = lacuna.params { scratch = "." }

local unit, side, deep = 4, 4, 4 -- of the grid that the boards lie on; side and depth of the tray in units

local function add(model, name, ...)
  local points = { ... }
  for i, p in ipairs(points) do points[i] = { unit * p[1], unit * p[2], unit * p[3] } end
  model:add_face { name = name, points = points, cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
end

--- The six faces of a box, the names of those at its bottom and top last.
local function box(model, name, x, y, z, u, v, w)
  add(model, name .. " 1", { x, y, z }, { x, v, z }, { x, v, w }, { x, y, w })
  add(model, name .. " 2", { u, y, z }, { u, y, w }, { u, v, w }, { u, v, z })
  add(model, name .. " 3", { x, y, z }, { x, y, w }, { u, y, w }, { u, y, z })
  add(model, name .. " 4", { x, v, z }, { u, v, z }, { u, v, w }, { x, v, w })
  add(model, name .. " 5", { x, y, z }, { u, y, z }, { u, v, z }, { x, v, z })
  add(model, name .. " 6", { x, y, w }, { x, v, w }, { u, v, w }, { u, y, w })
end

local function touch_at_an_edge(height)
  for i = 1, side - 1 do
    for j = 1, side - 1 do
      local a, b, c, d = height[i][j], height[i + 1][j + 1], height[i][j + 1], height[i + 1][j]
      if math.min(a, b) > math.max(c, d) or math.min(c, d) > math.max(a, b) then return true end
    end
  end
end

local random = check.random(11)
local function whole(low, high) return math.floor(random(low, high + 0.999)) end
local members = 0
while members < (check.whole and 150 or 12) do
  local height, boards, volume = {}, {}, deep * side * side
  for i = 1, side do
    height[i] = {}
    for j = 1, side do height[i][j] = 0 end
  end
  for _ = 1, whole(1, 3) do
    local x, y = whole(0, side - 1), whole(0, side - 1)
    local u, v, thick = whole(x + 1, math.min(x + 2, side)), whole(y + 1, math.min(y + 2, side)), whole(1, 2)
    local low, level = height[x + 1][y + 1], true
    for i = x + 1, u do for j = y + 1, v do level = level and height[i][j] == low end end
    if level and low + thick < deep then
      for i = x + 1, u do for j = y + 1, v do height[i][j] = low + thick end end
      boards[#boards + 1] = { x, y, low, u, v, low + thick }
      volume = volume - (u - x) * (v - y) * thick
    end
  end
  if not touch_at_an_edge(height) then
    local open = members % 3 > 0 -- without a lid
    local model, text = lacuna.model(), {}
    box(model, "tray", 0, 0, 0, side, side, deep)
    for n, board in ipairs(boards) do
      box(model, "board " .. n, table.unpack(board))
      text[n] = table.concat(board, " ")
    end
    local roles = { source = { "tray 5" }, target = {}, walls = members % 3 == 1 and "auto" or {} }
    if not open then roles.target[1] = "tray 6" end
    for n = 0, #boards do
      local covered = false -- by a board of the same outline: both share one face
      for _, above in ipairs(boards) do
        local own = boards[n]
        covered = covered or own and above[3] == own[6] and above[1] == own[1] and above[2] == own[2]
            and above[4] == own[4] and above[5] == own[5]
      end
      if n > 0 and not (covered and roles.walls == "auto") then
        table.insert(roles.source, ("board %d 6"):format(n))
      end
      for k = 1, roles.walls ~= "auto" and 4 or 0 do
        table.insert(roles.walls, (n > 0 and "board " .. n or "tray") .. " " .. k)
      end
    end
    if open and roles.walls == "auto" then roles.target[1] = "tray 6" end
    local at = ("%s, way %d"):format(table.concat(text, ", "), members % 3)
    local fine, mesh = pcall(function() return model:open_volume(roles):sweep { size = 2 } end)
    check.that(fine, ("%s: %s"):format(at, mesh))
    local quality = mesh:quality()
    check.that(quality.certified and quality.min_scaled_jacobian >= 0.3,
      ("%s: %g"):format(at, quality.min_scaled_jacobian))
    check.that(math.abs(quality.volume / (volume * unit ^ 3) - 1) < 1e-9, at .. ": volume")
    members = members + 1
  end
end

-- Ends that meet in the circle of a floor and a product with other facets are an error, not a crash.
local function turned(model, name, count, from, to)
  local points, cells = {}, {}
  for _, ring in ipairs { from, to } do
    for i = 0, count - 1 do
      local t = 2 * math.pi * i / count
      points[#points + 1] = { ring[1] * math.cos(t), ring[1] * math.sin(t), ring[2] }
    end
  end
  for i = 0, count - 1 do
    local j = (i + 1) % count
    cells[2 * i + 1] = { i + 1, j + 1, count + j + 1 }
    cells[2 * i + 2] = { i + 1, count + j + 1, count + i + 1 }
  end
  model:add_face { name = name, points = points, cells = cells }
end
local apart = lacuna.model()
turned(apart, "floor", 36, { 8, 0 }, { 40, 0 })
turned(apart, "outer", 36, { 40, 0 }, { 40, 40 })
turned(apart, "lid", 36, { 40, 40 }, { 0, 40 })
turned(apart, "round", 48, { 8, 0 }, { 12, 4 })
turned(apart, "side", 48, { 12, 4 }, { 12, 20 })
turned(apart, "top", 48, { 12, 20 }, { 0, 20 })
check.fails(function()
  apart:open_volume { source = { "floor", "top" }, target = "lid", walls = { "outer", "round", "side" } }
    :sweep { size = 4 }
end, "meet in vertex")

-- A product of CAD with rounded edges all round stands on the floor of its box, on less than its outline.
for round = 2, 6, 2 do
  local path = params.scratch .. "/rounded.geo"
  check.write(path, ([[SetFactory("OpenCASCADE");
Box(1) = {0,0,0, 60,60,40};
Cylinder(2) = {30,30,0, 0,0,20, 12};
Fillet{2}{13,15}{%d}]]):format(round))
  local spandrel = (1 - math.pi / 4) * round ^ 2 -- its centre is 0.2234 radii off the corner
  local taken = math.pi * 12 ^ 2 * 20 - 2 * 2 * math.pi * (12 - 0.2234 * round) * spandrel
  local model = lacuna.load(path)
  local roles = { source = { 5, 11 }, target = 6, walls = "auto" }
  for way, volume in ipairs { model:open_volume(), model:open_volume(roles) } do
    local quality = volume:sweep { size = 4 }:quality()
    local at = ("round %d, way %d"):format(round, way)
    check.that(quality.certified and quality.min_scaled_jacobian >= 0.2,
      ("%s: %g"):format(at, quality.min_scaled_jacobian))
    check.that(math.abs(quality.volume / (60 * 60 * 40 - taken) - 1) < 0.01, at .. ": volume")
  end
end

-- A family of such products in a carton: cylinders and boxes, rounds of 2 to 40 % of the side, on the floor,
-- hovering and tilted. The rounds at the corners of a box on the floor meet the floor in one vertex.
local tried, meshed = 0, 0
for n = 1, 200, check.whole and 1 or 59 do
  local draw = check.random(n)
  local is_box, place = n % 2 == 0, n // 2 % 3
  local a, b, h, lift = draw(16, 30), draw(16, 30), draw(12, 24), place > 0 and draw(6, 12) or 0
  local round = draw(0.02, 0.4) * math.min(a, h, is_box and b or h)
  local solid = is_box
    and ("Box(2) = {%g,%g,%g, %g,%g,%g};\nFillet{2}{13:24}{%g}"):format(-a / 2, -b / 2, lift, a, b, h, round)
    or ("Cylinder(2) = {0,0,%g, 0,0,%g, %g};\nFillet{2}{13,15}{%g}"):format(lift, h, a / 2, round)
  local taken
  if is_box then
    local u, v, w = a - 2 * round, b - 2 * round, h - 2 * round
    taken = u * v * w + 2 * round * (u * v + v * w + w * u) + math.pi * round ^ 2 * (u + v + w)
      + 4 / 3 * math.pi * round ^ 3
  else
    taken = math.pi * a ^ 2 / 4 * h - (4 - math.pi) * math.pi * (a / 2 - 0.2234 * round) * round ^ 2
  end
  local turn = ""
  if place == 2 then
    local way = draw(0, 2 * math.pi)
    turn = ("Rotate{{%g,%g,0},{0,0,%g},%g}{Volume{2};}"):format(math.cos(way), math.sin(way), lift + h / 2,
      math.rad(draw(1, 10)))
  end
  local path = params.scratch .. "/filleted.geo"
  check.write(path, 'SetFactory("OpenCASCADE");\nBox(1) = {-35,-35,0, 70,70,55};\n' .. solid .. "\n" .. turn)
  tried = tried + 1
  local fine, mesh = pcall(function() return lacuna.load(path):open_volume():sweep { size = 4 } end)
  if fine then
    meshed = meshed + 1
    local quality = mesh:quality()
    check.that(quality.certified and quality.min_scaled_jacobian >= 0.1,
      ("filleted product %d: %g"):format(n, quality.min_scaled_jacobian))
    check.that(math.abs(quality.volume / (70 * 70 * 55 - taken) - 1) < 0.01, n .. ": volume")
  end
end
check.that(meshed >= 0.9 * tried, ("%d of %d filleted products meshed"):format(meshed, tried))
-- A board on a floor touches it over an area. A refusal for another reason says that reason.
do
  local path = params.scratch .. "/board.geo"
  check.write(path, [[SetFactory("OpenCASCADE"); Box(1) = {0,0,0, 40,30,20}; Box(2) = {3,3,3, 34,24,20};
    BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; }; Box(4) = {10,10,3, 12,8,5};]])
  local model = lacuna.load(path)
  local inside = model:faces { box = { { 2.9, 2.9, 2.9 }, { 37.1, 27.1, 20.1 } } }
  check.fails(function()
    model:open_volume { faces = inside, fill_to = { { 0, 0, 26 }, { 0, 0, 1 } } }
  end, "the plane misses the volume", "closure.cut_misses")
end

-- Two products in an open carton, a lying cylinder that hovers and another cylinder or a box beside it. The
-- ends of the products point the other way than the walls of the carton that they face.
for n = 1, 6 do
  local draw = check.random(400 + n)
  local lying = n % 2 == 0
  local path, far, up = params.scratch .. "/two.geo", draw(78, 84), draw(4, 8)
  local radius, own = draw(9, 12), draw(6, 8)
  check.write(path, ([[SetFactory("OpenCASCADE"); Box(1) = {-3,-3,-3, 136,66,63}; Box(2) = {0,0,0, 130,60,70};
    BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
    Cylinder(4) = {12,30,%g, 40,0,0, %g}; %s]]):format(radius + up, radius,
    lying and ("Cylinder(5) = {%g,29,%g, 32,0,0, %g};"):format(far, own + up + 1, own)
    or ("Box(5) = {%g,%g,0, 36,%g,%g};"):format(far, 29 - own, 2 * own, 2 * own)))
  local model = lacuna.load(path)
  local inside = model:faces { box = { { -0.1, -0.1, -0.1 }, { 130.1, 60.1, 60.1 } } }
  local quality = model:open_volume { faces = inside }:sweep { size = 5 }:quality()
  local taken = math.pi * radius ^ 2 * 40 + (lying and math.pi * own ^ 2 * 32 or 36 * (2 * own) ^ 2)
  check.that(quality.certified and quality.min_scaled_jacobian >= 0.3,
    ("two products %d: %g"):format(n, quality.min_scaled_jacobian))
  check.near(quality.volume / (130 * 60 * 60 - taken), 1, 0.01)
end

-- A product of facets whose edges are all rounded is one smooth face: only the flat part of it is in contact.
do
  local model, around, arc, radius, high, round = lacuna.model(), 24, 4, 15, 18, 5
  local rings, taken = {}, 0
  for k = 0, arc do
    local t = math.pi / 2 * k / arc
    rings[k + 1] = { radius - round + round * math.sin(t), round - round * math.cos(t) }
    rings[2 * arc + 2 - k] = { rings[k + 1][1], high - rings[k + 1][2] }
  end
  local points, cells = {}, {}
  for j, ring in ipairs(rings) do
    for i = 0, around - 1 do
      local t = 2 * math.pi * i / around
      points[#points + 1] = { 30 + ring[1] * math.cos(t), 30 + ring[1] * math.sin(t), ring[2] }
      local a, b = (j - 1) * around + i + 1, (j - 1) * around + (i + 1) % around + 1
      if rings[j + 1] then
        cells[#cells + 1] = { a, b, b + around }
        cells[#cells + 1] = { a, b + around, a + around }
      end
    end
    local next = rings[j + 1] or ring
    taken = taken + (next[2] - ring[2]) * (ring[1] ^ 2 + ring[1] * next[1] + next[1] ^ 2) / 3
      * around / 2 * math.sin(2 * math.pi / around)
  end
  for _, j in ipairs { 0, #rings - 1 } do
    local height = rings[j + 1][2]
    points[#points + 1] = { 30, 30, height }
    for i = 0, around - 1 do
      local a, b = j * around + i + 1, j * around + (i + 1) % around + 1
      cells[#cells + 1] = height == 0 and { b, a, #points } or { a, b, #points }
    end
  end
  model:add_face { name = "product", points = points, cells = cells }
  for _, side in ipairs { { 0, 0, 60, 0 }, { 60, 0, 60, 60 }, { 60, 60, 0, 60 }, { 0, 60, 0, 0 } } do
    local a, b, c, d = table.unpack(side)
    model:add_face { points = { { a, b, 0 }, { c, d, 0 }, { c, d, 50 }, { a, b, 50 } },
      cells = { { 1, 3, 2 }, { 1, 4, 3 } } }
  end
  for _, z in ipairs { 0, 50 } do
    model:add_face { points = { { 0, 0, z }, { 60, 0, z }, { 60, 60, z }, { 0, 60, z } },
      cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
  end
  local quality = model:open_volume():sweep { size = 5 }:quality()
  check.that(quality.certified and quality.min_scaled_jacobian >= 0.25, quality.min_scaled_jacobian)
  check.near(quality.volume / (60 * 60 * 50 - taken), 1, 0.01)
end

-- A pocket with a slot in its side up to the mouth is one cavity first, then each part alone.
do
  local path = params.scratch .. "/slotted.geo"
  check.write(path, [[SetFactory("OpenCASCADE"); Box(1) = {0,0,0, 60,50,40}; Box(2) = {10,10,20, 30,30,20};
    Box(3) = {40,20,30, 20,10,10}; BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2,3}; Delete; };]])
  local found = lacuna.load(path):cavities()
  check.near(found[1].volume / (30 * 30 * 20 + 20 * 10 * 10), 1, 1e-6)
  check.equal(#found, 3)
end

check.done()
