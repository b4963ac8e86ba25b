-- SPDX-License-Identifier: MIT
-- Steps at one end and at both: what stands, hangs or floats in a can, stepped pins in stepped bores, stairs.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")
local params = lacuna.params { members = check.whole and 80 or 20 }

local around = 24
local function circle(r) return around / 2 * r * r * math.sin(2 * math.pi / around) end

--- Faces that turn about the z axis: { name, { r, z }, { r, z } … } each.
local function turned(lines)
  local model = lacuna.model()
  for _, line in ipairs(lines) do
    local points, cells, rings = {}, {}, {}
    for k = 2, #line do
      local r, z = line[k][1], line[k][2]
      rings[k - 1] = { first = #points + 1, tip = r == 0 }
      for i = 0, r == 0 and 0 or around - 1 do
        local t = 2 * math.pi * i / around
        points[#points + 1] = { r * math.cos(t), r * math.sin(t), z }
      end
    end
    for k = 1, #rings - 1 do
      for i = 0, around - 1 do
        local a, b, j = rings[k], rings[k + 1], (i + 1) % around
        local cell = { a.first + (a.tip and 0 or i) }
        if not a.tip then cell[2] = a.first + j end
        if not b.tip then cell[#cell + 1] = b.first + j end
        cell[#cell + 1] = b.first + (b.tip and 0 or i)
        cells[#cells + 1] = cell
      end
    end
    model:add_face { name = line[1], points = points, cells = cells }
  end
  return model
end

--- Lines of a turned skin that climbs from z to z, with its shoulders by the way they face; and the volume
--- within it. `sign`: +1 where the void is inside of it, -1 outside.
local function climb(name, radii, heights, sign, lines, roles)
  local volume = 0
  for k, r in ipairs(radii) do
    local low, high = heights[k], heights[k + 1]
    volume = volume + circle(r) * (high - low)
    if r > 0 then
      lines[#lines + 1] = { ("%s_wall_%d"):format(name, k), { r, low }, { r, high } }
      table.insert(roles.walls, lines[#lines][1])
    end
    local above = radii[k + 1]
    if above then
      lines[#lines + 1] = { ("%s_step_%d"):format(name, k), { r, high }, { above, high } }
      if r > above then lines[#lines][2], lines[#lines][3] = lines[#lines][3], lines[#lines][2] end
      table.insert((above - r) * sign > 0 and roles.source or roles.target, lines[#lines][1])
    end
  end
  return sign * volume
end

local function sweep(lines, roles, size)
  local model = turned(lines)
  local volume = model:open_volume(roles)
  return volume:sweep { size = size }, #model:open_volume(roles):cut()
end

-- Each of these by name: what they are and how many pieces.
local can = { { "floor", { 0, 0 }, { 2, 0 } }, { "side", { 2, 0 }, { 2, 5 } }, { "lid", { 0, 5 }, { 2, 5 } } }
local function with(...)
  local lines = { table.unpack(can) }
  for _, line in ipairs { ... } do lines[#lines + 1] = line end
  return lines
end
local top, skin, bottom = { "top", { 0, 3 }, { 1, 3 } }, { "skin", { 1, 2 }, { 1, 3 } },
  { "bottom", { 0, 2 }, { 1, 2 } }
local function holds(what, lines, roles, pieces, volume)
  local mesh, count = sweep(lines, roles, 0.3)
  check.equal(count, pieces, what)
  check.equal(mesh:quality().certified, true, what)
  check.that(math.abs(mesh.fidelity.volume - volume) < 0.02 * volume, what .. " " .. mesh.fidelity.volume)
end
holds("a drum floats in a can", with(top, skin, bottom),
  { source = { "floor", "top" }, target = { "lid", "bottom" }, walls = { "side", "skin" } }, 3,
  circle(2) * 5 - circle(1))
local standing = { "skin", { 1, 0 }, { 1, 3 } }
holds("a drum stands in a can without floor", { can[2], can[3], top, standing },
  { source = "top", target = "lid", walls = { "side", "skin" } }, 2, circle(2) * 5 - circle(1) * 3)
holds("a drum with a chamfered base stands in a can",
  { { "floor", { 0.7, 0 }, { 2, 0 } }, can[2], can[3], top,
    { "chamfer", { 0.7, 0 }, { 1, 0.3 } }, { "skin", { 1, 0.3 }, { 1, 3 } } },
  { source = { "floor", "top" }, target = "lid", walls = { "side", "chamfer", "skin" } }, 2,
  circle(2) * 5 - circle(1) * 2.7 - (circle(0.7) + circle(1) + circle(0.7 ^ 0.5)) * 0.1)
holds("a drum stands in a can without lid", { { "floor", { 1, 0 }, { 2, 0 } }, can[2], top, standing },
  { source = { "top", "floor" }, walls = { "side", "skin" } }, 2, circle(2) * 5 - circle(1) * 3)
holds("a drum floats in a can without lid", { can[1], can[2], top, skin, bottom },
  { source = { "floor", "top" }, target = "bottom", walls = { "side", "skin" } }, 3,
  circle(2) * 5 - circle(1))
holds("a flange, whose rims lie above each other",
  { { "b", { 0, 0 }, { 1, 0 } }, { "w1", { 1, 0 }, { 1, 2 } }, { "f1", { 1, 2 }, { 2, 2 } },
    { "w2", { 2, 2 }, { 2, 3 } }, { "f2", { 2, 3 }, { 1, 3 } }, { "w3", { 1, 3 }, { 1, 5 } },
    { "t", { 1, 5 }, { 0, 5 } } },
  { source = { "b", "f1" }, target = { "t", "f2" }, walls = { "w1", "w2", "w3" } }, 3,
  circle(1) * 4 + circle(2))

-- Stairs: the step ends at the walls beside it, and the plane of its riser cuts.
local stairs = lacuna.model()
local function quad(name, ...)
  stairs:add_face { name = name, points = { ... }, cells = { { 1, 2, 3, 4 } } }
end
quad("low", { 0, 0, 0 }, { 1, 0, 0 }, { 1, 2, 0 }, { 0, 2, 0 })
quad("riser", { 1, 0, 0 }, { 1, 0, 1 }, { 1, 2, 1 }, { 1, 2, 0 })
quad("high", { 1, 0, 1 }, { 2, 0, 1 }, { 2, 2, 1 }, { 1, 2, 1 })
quad("left", { 0, 0, 0 }, { 0, 2, 0 }, { 0, 2, 3 }, { 0, 0, 3 })
quad("right", { 2, 0, 1 }, { 2, 2, 1 }, { 2, 2, 3 }, { 2, 0, 3 })
quad("roof", { 0, 0, 3 }, { 2, 0, 3 }, { 2, 2, 3 }, { 0, 2, 3 })
for n, y in ipairs { 0, 2 } do
  stairs:add_face { name = "beside_" .. n, cells = { { 1, 2, 3, 6 }, { 3, 4, 5, 6 } },
    points = { { 0, y, 0 }, { 1, y, 0 }, { 1, y, 1 }, { 2, y, 1 }, { 2, y, 3 }, { 0, y, 3 } } }
end
local mesh = stairs:open_volume { source = { "low", "high" }, target = "roof",
  walls = { "riser", "left", "right", "beside_1", "beside_2" } }:sweep { size = 0.3 }
check.equal(#mesh.regions, 2)
check.near(mesh.fidelity.volume, 10, 1e-9)

-- A thick pin that stands on the floor of a box, whichever sides of the box are missing: the pin's skin, that
-- faces the other way, is most of what is given.
local function boxed_pin(sides)
  local model = lacuna.model()
  local function face(name, points, cells)
    model:add_face { name = name, points = points, cells = cells or { { 1, 2, 3, 4 } } }
  end
  local function corners(low, high, z)
    return { low, low, z }, { high, low, z }, { high, high, z }, { low, high, z }
  end
  local outer, inner = { corners(0, 4, 0) }, { corners(0.4, 3.6, 0) }
  face("floor", table.move(inner, 1, 4, 5, { corners(0, 4, 0) }),
    { { 1, 5, 6, 2 }, { 2, 6, 7, 3 }, { 3, 7, 8, 4 }, { 4, 8, 5, 1 } })
  face("tip", { corners(0.4, 3.6, 3.5) })
  face("lid", { corners(0, 4, 4) })
  local walls = {}
  local function stand(name, at, i, height)
    local a, b = at[i], at[i % 4 + 1]
    face(name .. i, { a, b, { b[1], b[2], height }, { a[1], a[2], height } })
    walls[#walls + 1] = name .. i
  end
  for i = 1, 4 do
    stand("skin_", inner, i, 3.5)
    if sides & 1 << (i - 1) ~= 0 then stand("side_", outer, i, 4) end
  end
  return model:open_volume { source = { "floor", "tip" }, target = "lid", walls = walls }
end
for sides = 0, 15, check.whole and 1 or 5 do
  local missing = boxed_pin(sides)
  check.that(missing:tree():find("pieces: 2", 1, true), "sides " .. sides)
  local pinned = missing:sweep { size = 0.8 }
  check.equal(pinned:quality().certified, true, "sides " .. sides)
  check.near(pinned.fidelity.volume, 64 - 3.5 * 3.2 ^ 2, 1e-9)
end

-- The tree says what it is cut into.
local drum = turned(with(top, skin, bottom)):open_volume { source = { "floor", "top" },
  target = { "lid", "bottom" }, walls = { "side", "skin" }, name = "air" }:tree()
check.that(drum:find("pieces: 3\n  air_1: class closed, level 0", 1, true), drum)
check.that(drum:find "air_1 and air_%d share void face", drum)

-- Two ends apart that no walls join.
check.fails(function()
  turned({ can[1], can[2], can[3], top }):open_volume { source = { "floor", "top" }, target = "lid",
    walls = "side" }:sweep { size = 0.3 }
end, "several separate parts", '"floor"', '"top"', "closure.steps")

-- A family: a pin of one to three diameters in a bore of one to three, steps either way.
local random = check.random(14)
local function heights(count, length, taken)
  local z = {}
  for k = 1, count - 1 do
    repeat
      z[k] = random(0.6, length - 0.6)
      local near = false
      for _, other in ipairs(taken) do near = near or math.abs(other - z[k]) < 0.35 end
    until not near
    taken[#taken + 1] = z[k]
  end
  table.sort(z)
  table.insert(z, 1, 0)
  z[#z + 1] = length
  return z
end
local meshed, refused, pieces = 0, {}, 0
for member = 1, params.members do
  local length, lines, taken = 5, {}, {}
  local roles = { source = { "start" }, target = { "stop" }, walls = {} }
  local pin, bore, low, high = {}, {}, math.floor(random(1, 3.999)), math.floor(random(1, 3.999))
  for k = 1, low do pin[k] = ({ 0.5, 0.7, 0.9, 1.1 })[math.floor(random(1, 4.999))] end
  for k = 1, high do bore[k] = ({ 1.6, 1.9, 2.2, 2.5 })[math.floor(random(1, 4.999))] end
  for _, radii in ipairs { pin, bore } do
    for k = #radii, 2, -1 do if radii[k] == radii[k - 1] then table.remove(radii, k) end end
  end
  if random(0, 1) < 0.2 then pin = { 0 } end
  local volume = climb("bore", bore, heights(#bore, length, taken), 1, lines, roles) +
    climb("pin", pin, heights(#pin, length, taken), -1, lines, roles)
  lines[#lines + 1] = { "start", { pin[1], 0 }, { bore[1], 0 } }
  lines[#lines + 1] = { "stop", { pin[#pin], length }, { bore[#bore], length } }
  local ok, found, count = pcall(sweep, lines, roles, 0.4)
  if ok then
    meshed, pieces = meshed + 1, pieces + count
    check.equal(found:quality().certified, true, "member " .. member)
    check.that(math.abs(found.fidelity.volume - volume) < 0.02 * volume,
      ("member %d: volume %g for %g"):format(member, found.fidelity.volume, volume))
  else
    local code = tostring(found):match "%[([%a_]+%.[%a_]+)%]"
    check.that(code, "refused by name: " .. tostring(found))
    refused[#refused + 1] = member .. " " .. code
  end
end
print(("%d meshed in %d pieces, %d refused"):format(meshed, pieces, #refused))
for _, line in ipairs(refused) do print(line) end
check.that(meshed >= 0.95 * params.members)

-- A groove round a shaft, and the gap in a sleeve: one of the two walls is missing, and there is no step.
for _, size in ipairs { { 10, 14, 2 }, { 10, 11, 5 }, { 1, 9, 0.5 }, { 3, 4, 20 } } do
  for _, drop in ipairs { "wall_1", "wall_2" } do
    local part = lacuna.synthetic.annulus { inner = size[1], outer = size[2], height = size[3], drop = drop }
    for _, ends in ipairs { { "source", "target" }, { "target", "source" } } do
      local void = part:open_volume { source = ends[1], target = ends[2], walls = "auto" }
      check.equal(#void:cut(), 1, drop .. " missing: it is swept as a whole")
    end
  end
end
local groove = lacuna.synthetic.annulus { inner = 10, outer = 14, height = 2, drop = "wall_1" }
local filled = groove:open_volume({ source = "source", target = "target", walls = "auto" }):sweep { size = 1 }
check.that(filled:quality().certified)
check.near(filled.fidelity.volume, filled.fidelity.sealed_volume, 0.02 * filled.fidelity.sealed_volume)

-- Each kind of fallback, where one piece has no hexahedra alone.
--- A block that stands in a box, its top a mesh of quads and triangles: what is above it has no hexes alone.
local function standing()
  local model = lacuna.model()
  local function quad(name, ...)
    model:add_face { name = name, points = { ... }, cells = { { 1, 2, 3, 4 } } }
  end
  local function ring(low, high, z)
    return { { low, low, z }, { high, low, z }, { high, high, z }, { low, high, z } }
  end
  local out, foot, top, lid = ring(0, 4, 0), ring(1, 3, 0), ring(1, 3, 1), ring(0, 4, 3)
  local floor = {}
  for i = 1, 4 do floor[i], floor[i + 4] = out[i], foot[i] end
  model:add_face { name = "floor", points = floor,
    cells = { { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 4, 8, 7 }, { 4, 1, 5, 8 } } }
  model:add_face { name = "lid", points = lid, cells = { { 1, 4, 3, 2 } } }
  for i = 1, 4 do
    local j = i % 4 + 1
    quad("outer_" .. i, out[i], out[j], lid[j], lid[i])
    quad("block_" .. i, foot[i], top[i], top[j], foot[j])
  end
  local points, cells = {}, {}
  for b = 0, 4 do
    for a = 0, 4 do points[#points + 1] = { 1 + a / 2, 1 + b / 2, 1 } end
  end
  for b = 0, 3 do
    for a = 0, 3 do
      local n = 5 * b + a + 1
      if a == b then
        cells[#cells + 1], cells[#cells + 2] = { n, n + 1, n + 6 }, { n, n + 6, n + 5 }
      else
        cells[#cells + 1] = { n, n + 1, n + 6, n + 5 }
      end
    end
  end
  model:add_face { name = "top", points = points, cells = cells, keep_mesh = true }
  return model:open_volume { source = { "floor", "top" }, target = "lid", walls = "auto", name = "room" }
end
check.fails(function() standing():sweep { size = 0.5 } end, "room_2", 'face 11 "top"', "8 triangles")
local with_wedges = standing():sweep { size = 0.5, fallback = "wedges" }
check.equal(table.concat(with_wedges.regions, " "), "room_1 room_2")
check.equal(with_wedges:quality().certified, true)
check.equal(with_wedges.wedges, 8 * with_wedges.layers.room_2)
check.equal(#with_wedges.left_out, 0)
check.near(with_wedges.fidelity.volume, 44, 1e-9)
local without = standing():sweep { size = 0.5, fallback = "leave_out" }
check.equal(table.concat(without.regions, " "), "room_1")
check.equal(without.left_out[1].region, "room_2")
check.equal(without.left_out[1].code, "surface.given_triangles")
check.near(without.fidelity.volume, 36, 1e-9)
-- What floats over something else with outlines that touch: a face that cannot be split is named.
for _, above in ipairs { { { 10, 8, 22 }, { 24, 20, 30 } }, { { 12, 4, 22 }, { 20, 26, 30 } },
  { { 8, 8, 22 }, { 28, 20, 30 } } } do
  local room = lacuna.model()
  local function add_box(name, low, high, inward)
    local function quad(side, a, b, c, d)
      local points = inward and { d, c, b, a } or { a, b, c, d }
      room:add_face { name = name .. side, points = points, cells = { { 1, 2, 3, 4 } } }
    end
    local x, y, z, X, Y, Z = low[1], low[2], low[3], high[1], high[2], high[3]
    quad("_low", { x, y, z }, { x, Y, z }, { X, Y, z }, { X, y, z })
    quad("_high", { x, y, Z }, { X, y, Z }, { X, Y, Z }, { x, Y, Z })
    quad("_1", { x, y, z }, { x, y, Z }, { x, Y, Z }, { x, Y, z })
    quad("_2", { X, y, z }, { X, Y, z }, { X, Y, Z }, { X, y, Z })
    quad("_3", { x, y, z }, { X, y, z }, { X, y, Z }, { x, y, Z })
    quad("_4", { x, Y, z }, { x, Y, Z }, { X, Y, Z }, { X, Y, z })
  end
  add_box("room", { 0, 0, 0 }, { 40, 30, 40 })
  add_box("below", { 8, 8, 6 }, { 28, 20, 14 }, true)
  add_box("above", above[1], above[2], true)
  local fine, why = pcall(function()
    return room:open_volume { source = { "room_low", "below_high", "above_high" },
      target = { "room_high", "below_low", "above_low" }, walls = "auto" }:sweep { size = 4 }
  end)
  check.that(fine or tostring(why):find "face %d+", tostring(why))
end

--- The skin of cells of a grid, those of `taken` left out, a face for each plane and side; and its volume.
local function room(x, y, z, taken)
  local function free(i, j, k)
    return x[i] and x[i + 1] and y[j] and y[j + 1] and z[k] and z[k + 1] and i > 0 and j > 0 and k > 0
      and not taken[i .. j .. k]
  end
  local faces, order, volume = {}, {}, 0
  local function quad(name, points)
    if not faces[name] then
      faces[name] = { points = {}, cells = {} }
      order[#order + 1] = name
    end
    local face = faces[name]
    local first = #face.points
    for _, p in ipairs(points) do face.points[#face.points + 1] = p end
    face.cells[#face.cells + 1] = { first + 1, first + 2, first + 3, first + 4 }
  end
  for i = 1, #x - 1 do for j = 1, #y - 1 do for k = 1, #z - 1 do
    if free(i, j, k) then
      local a, b, c, A, B, C = x[i], y[j], z[k], x[i + 1], y[j + 1], z[k + 1]
      volume = volume + (A - a) * (B - b) * (C - c)
      if not free(i - 1, j, k) then quad("x" .. a, { { a, b, c }, { a, b, C }, { a, B, C }, { a, B, c } }) end
      if not free(i + 1, j, k) then quad("X" .. A, { { A, b, c }, { A, B, c }, { A, B, C }, { A, b, C } }) end
      if not free(i, j - 1, k) then quad("y" .. b, { { a, b, c }, { A, b, c }, { A, b, C }, { a, b, C } }) end
      if not free(i, j + 1, k) then quad("Y" .. B, { { a, B, c }, { a, B, C }, { A, B, C }, { A, B, c } }) end
      if not free(i, j, k - 1) then quad("z" .. c, { { a, b, c }, { a, B, c }, { A, B, c }, { A, b, c } }) end
      if not free(i, j, k + 1) then quad("Z" .. C, { { a, b, C }, { A, b, C }, { A, B, C }, { a, B, C } }) end
    end
  end end end
  local model = lacuna.model()
  for _, name in ipairs(order) do
    model:add_face { name = name, points = faces[name].points, cells = faces[name].cells }
  end
  return model, volume, order
end

-- What stands at a wall or in a corner leaves columns of several lengths side by side. The layers asked for
-- are those of the longest, with roles and without, the lid given or not.
for _, taken in ipairs { { ["121"] = true }, { ["111"] = true }, { ["111"] = true, ["121"] = true } } do
  for _, lid in ipairs { true, false } do
    local whole, volume, names = room({ 0, 3, 8 }, { 0, 2, 4, 6 }, { 0, 2, 5 }, taken)
    local faces = {}
    for _, name in ipairs(names) do
      if lid or name ~= "Z5" then faces[#faces + 1] = name end
    end
    local opened = whole:open_volume { faces = faces }
    local mesh = opened:sweep { layers = 6, size = 1 }
    check.near(mesh.fidelity.volume, volume, 1e-9)
    check.that(mesh:quality().certified)
  end
end

-- A boss in a pocket of a solid, with a bore through both: the boss's top is a part of the floor, with the
-- bore covered, and the pocket's lid is flat.
do
  local model = lacuna.model()
  local function corners(x, y, X, Y, z) return { { x, y, z }, { X, y, z }, { X, Y, z }, { x, Y, z } } end
  local function ring(name, around, inside, up)
    local points, cells = {}, {}
    for k = 1, 4 do points[k], points[k + 4] = around[k], inside and inside[k] end
    if not inside then cells[1] = { 1, 2, 3, 4 } end
    for k = 1, inside and 4 or 0 do cells[k] = { k, k % 4 + 1, k % 4 + 5, k + 4 } end
    for k, c in ipairs(cells) do cells[k] = up and c or { c[1], c[4], c[3], c[2] } end
    model:add_face { name = name, points = points, cells = cells }
  end
  local function sides(name, low, high, outward)
    for k = 1, 4 do
      local n = k % 4 + 1
      model:add_face { name = name .. k, points = { low[k], low[n], high[n], high[k] },
        cells = { outward and { 1, 2, 3, 4 } or { 1, 4, 3, 2 } } }
    end
  end
  local function box(z) return corners(0, 0, 12, 8, z) end
  local function pocket(z) return corners(1, 1, 11, 7, z) end
  local function boss(z) return corners(4, 2, 8, 6, z) end
  local function bore(z) return corners(5, 3, 7, 5, z) end
  ring("bottom", box(0), bore(0), false)
  sides("outside", box(0), box(4), true)
  ring("brim", box(4), pocket(4), true)
  sides("pocket", pocket(1.5), pocket(4), false)
  ring("floor", pocket(1.5), boss(1.5), true)
  sides("boss", boss(1.5), boss(3), true)
  ring("top", boss(3), bore(3), true)
  sides("bore", bore(0), bore(3), false)
  local mesh = model:open_volume { source = "floor", walls = "auto" }:sweep { size = 1 }
  check.near(mesh.fidelity.volume, 10 * 6 * 2.5 - 4 * 4 * 1.5, 1e-9)
  check.that(mesh:quality().certified)
end

check.done()
