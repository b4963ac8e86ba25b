-- SPDX-License-Identifier: MIT
-- Rings swept round their whole turn: the last layer is the first one's neighbour, and nothing else is left.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")

-- A ring about the z axis, of facets: its section's points { r, z } counter-clockwise, a wall for each range
-- of them. `wave` lifts it as it goes round, `twist` turns its section about { middle, 0 } by so many sides.
local function ring(shape)
  local model, n, section = lacuna.model(), shape.turns or 48, shape.section
  local function at(k, i)
    local a, point = 2 * math.pi * (i % n) / n, section[(k - 1) % #section + 1]
    local r, z = point[1], point[2]
    if shape.bulge then -- the section is larger on one side of the ring
      local more = 1 + shape.bulge * math.cos(a - shape.phase)
      r, z = shape.middle + (r - shape.middle) * more, z * more
    end
    if shape.twist then
      local t = shape.twist * i / n * 2 * math.pi / #section
      r, z = shape.middle + (r - shape.middle) * math.cos(t) - z * math.sin(t),
        (r - shape.middle) * math.sin(t) + z * math.cos(t)
    end
    return { r * math.cos(a) * (shape.oval or 1), r * math.sin(a),
      z + (shape.wave or 0) * math.sin(2 * a) }
  end
  for w, range in ipairs(shape.walls) do
    local points, cells, wide = {}, {}, range[2] - range[1]
    for i = 0, n - 1 do
      for k = range[1], range[2] do points[#points + 1] = at(k, i) end
    end
    local function id(k, i) return (i % n) * (wide + 1) + k + 1 end
    for i = 0, n - 1 do
      for k = 0, wide - 1 do
        cells[#cells + 1] = { id(k, i), id(k + 1, i), id(k + 1, i + 1) }
        cells[#cells + 1] = { id(k, i), id(k + 1, i + 1), id(k, i + 1) }
      end
    end
    if shape.drop ~= w then model:add_face { name = "wall_" .. w, points = points, cells = cells } end
  end
  return model
end

local square = { { 3, -0.5 }, { 4, -0.5 }, { 4, 0.5 }, { 3, 0.5 } }
local four = { { 1, 2 }, { 2, 3 }, { 3, 4 }, { 4, 5 } }
local function regular(sides, radius)
  local points = {}
  for k = 1, sides do
    local a = 2 * math.pi * k / sides
    points[k] = { 4 + radius * math.cos(a), radius * math.sin(a) }
  end
  return points
end
local function each(sides)
  local walls = {}
  for k = 1, sides do walls[k] = { k, k + 1 } end
  return walls
end

-- Nothing but walls is left, each hex has a neighbour on both sides along the sweep, and no node is there
-- twice.
local function check_whole(mesh, volume)
  check.equal(mesh:quality().certified, true)
  -- As strictly as a plain sweep of a given size, which tells of a loss above 2 %.
  check.that(mesh.fidelity.volume / mesh.fidelity.sealed_volume > 0.975, "the volume of the mesh")
  check.that(mesh.fidelity.volume / mesh.fidelity.sealed_volume < 1.005, "the volume of the mesh")
  -- One region, and no groups but those of its walls.
  check.equal(#mesh.regions, 1)
  local solid = 0
  for _, group in ipairs(mesh:groups()) do
    if group.dim == 3 then
      solid = solid + 1
      check.equal(group.cells, mesh.hexes)
    else
      check.that(not group.name:find "cut_", group.name)
    end
  end
  -- That of its name and that of all cells; without a name they are one.
  check.equal(solid, mesh.regions[1] == "piece" and 1 or 2, "the region, and the volume")
  if volume then check.near(mesh.fidelity.sealed_volume, volume, 0.005 * volume) end
  local uses, places, sides = {}, {}, { { 1, 2, 3, 4 }, { 5, 6, 7, 8 } }
  for i = 1, mesh.hexes do
    local hex = { mesh:hex(i) }
    for _, side in ipairs(sides) do
      local corners = {}
      for k, c in ipairs(side) do corners[k] = hex[c] end
      table.sort(corners)
      local key = table.concat(corners, " ")
      uses[key] = (uses[key] or 0) + 1
    end
  end
  local quads = 0
  for _, count in pairs(uses) do
    check.equal(count, 2, "hexes at a quad across the sweep")
    quads = quads + 1
  end
  check.equal(quads, mesh.hexes)
  for i = 1, mesh.nodes do
    local place = ("%.9f %.9f %.9f"):format(mesh:node(i))
    check.that(not places[place], "a node twice")
    places[place] = true
  end
  local layers = 0
  for _, count in pairs(mesh.layers) do layers = layers + count end
  check.equal(mesh.nodes % layers, 0, "nodes over, of whole layers")
  check.equal(mesh.hexes % layers, 0, "hexes over, of whole layers")
  return layers
end

local function swept(model, options)
  return model:open_volume { full_turn = true }:sweep(options or { size = 0.3 })
end

-- Sections with and without corners, mapped and paved.
local exact = 48 / 2 * math.sin(2 * math.pi / 48) * (16 - 9)
check_whole(swept(ring { section = square, walls = four }), exact)
check_whole(swept(ring { section = regular(5, 0.8), walls = each(5) }))
check_whole(swept(ring { section = regular(24, 0.8), walls = { { 1, 25 } } }))
-- No axis: oval, and up and down.
check_whole(swept(ring { section = square, walls = four, oval = 1.5 }))
check_whole(swept(ring { section = square, walls = four, wave = 0.4 }))
-- Twisted onto itself by all four sides of its section.
check_whole(swept(ring { section = regular(4, 0.7), walls = each(4), middle = 4, twist = 4, turns = 96 }))
-- A wall is missing.
for drop = 1, 4 do check_whole(swept(ring { section = square, walls = four, drop = drop }), exact) end

-- The section turns by any number of its sides: each strip of wall runs into another, or round several times.
local function turning(sides, twist)
  local made, n = lacuna.model(), 72
  local function at(k, i)
    if i == n then k, i = k + twist, 0 end
    local t, a = 2 * math.pi * (k % sides + twist * i / n) / sides, 2 * math.pi * i / n
    local r = 4 + 0.7 * math.cos(t)
    return { r * math.cos(a), r * math.sin(a), 0.7 * math.sin(t) }
  end
  for k = 1, sides do
    local points, cells = {}, {}
    for i = 0, n do points[2 * i + 1], points[2 * i + 2] = at(k, i), at(k + 1, i) end
    for i = 1, 2 * n - 1, 2 do
      cells[i], cells[i + 1] = { i, i + 1, i + 3 }, { i, i + 3, i + 2 }
    end
    made:add_face { name = "strip_" .. k, points = points, cells = cells }
  end
  return made
end
local turned, family = 0, 0
for sides = 3, 6 do
  for twist = 0, sides do
    family = family + 1
    local fine, found = pcall(swept, turning(sides, twist))
    if fine then
      turned = turned + 1
      check_whole(found)
    else
      check.that(tostring(found):find "%[[%a_]+%.[%a_]+%]", "refused by name: " .. tostring(found))
    end
  end
end
print(("%d of %d twisted rings closed onto themselves"):format(turned, family))
check.that(turned >= 0.75 * family) -- a section whose quads are not alike after the turn is refused

-- Halves share the layers by how long they are, though one has more wall.
for _, phase in ipairs { 0.5, 1.57, 2.5 } do
  local volume = ring { section = regular(4, 0.7), walls = each(4), middle = 4, bulge = 0.5, turns = 96,
    phase = phase }:open_volume { full_turn = true }
  local first, angles = volume:cut()[1]:model(), {}
  for _, face in ipairs(first:faces()) do
    if face.name:find "^cut_" then
      angles[#angles + 1] = math.atan(face.centroid[2], face.centroid[1])
    end
  end
  local share = math.abs(angles[1] - angles[2]) / (2 * math.pi)
  local middle = math.cos((angles[1] + angles[2]) / 2) * first:face("wall_1").centroid[1] +
    math.sin((angles[1] + angles[2]) / 2) * first:face("wall_1").centroid[2]
  if middle < 0 then share = 1 - share end
  local bulging = volume:sweep { size = 0.3, layers = 60 }
  check.equal(check_whole(bulging), 60)
  local cells
  for _, line in ipairs(bulging.report) do cells = cells or tonumber(line:match "cells: (%d+)") end
  check.near(cells * 60 // bulging.hexes / 60, share, 0.02)
end

-- The layers asked for are those of the whole turn.
for _, layers in ipairs { 24, 31 } do
  local model = ring { section = square, walls = four }
  check.equal(check_whole(swept(model, { size = 0.3, layers = layers })), layers)
end
local volume = ring { section = square, walls = four }:open_volume { walls = { 1, 2, 3, 4 }, full_turn = true,
  name = "seat" }
check.that(volume:tree():find "seat_1 and seat_2 share", "what the halves share")
check.equal(#volume:cut(), 2)
local mesh = lacuna.assembly { volume }:sweep { size = 0.3, layers = 24 }
check.equal(check_whole(mesh), 24)
check.equal(mesh.layers.seat, 24)
for _, name in ipairs { "ring.msh", "ring.inp", "ring.vtu", "ring.bdf" } do
  local path = os.tmpname()
  os.remove(path)
  path = path .. name
  mesh:write(path)
  check.equal(#lacuna.load(path):faces(), 4, name .. ": the walls")
  os.remove(path)
end
local halves = volume:cut()
mesh = lacuna.assembly(halves):sweep { size = 0.3, [halves[1]] = { layers = { count = 20, bias = 2 } },
  [halves[2]] = { layers = 10 } }
check.equal(#mesh.regions, 2, "cut by hand, they are two")
check.that(mesh.layers.seat_1 == 20 and mesh.layers.seat_2 == 10, "layers of each")

-- Rows on all walls meet in the cuts: of one table, each wall has its rows all round, whatever the section.
for n, sides in ipairs { 4, 6, 3 } do
  local asked = { walls = "walls", first = 0.03 + 0.01 * n, growth = 1.2, count = n }
  local model = ring { section = regular(sides, 0.8), walls = each(sides), turns = 192 }
  local whole = model:open_volume { full_turn = true }
  local plain, rows = whole:sweep { size = 0.25 }, whole:sweep { size = 0.25, boundary_layers = asked }
  check.equal(rows:quality().certified, true)
  check.near(rows.fidelity.volume, plain.fidelity.volume, 0.01 * plain.fidelity.volume)
  local least = math.huge
  local inner = 0.8 * math.cos(math.pi / sides) -- from the middle of the section to its sides
  for i = 1, rows.nodes do
    local x, y, z = rows:node(i)
    local r, most = math.sqrt(x * x + y * y) - 4, -math.huge
    for k = 1, sides do
      local a = 2 * math.pi * (k - 0.5) / sides
      most = math.max(most, r * math.cos(a) + z * math.sin(a))
    end
    if inner - most > 0.1 * asked.first then least = math.min(least, inner - most) end
  end
  check.near(least, asked.first, 0.05 * asked.first)
end

-- What is refused.
local model = ring { section = square, walls = four }
local function refused(roles, options, ...)
  check.fails(function() model:open_volume(roles):sweep(options or { size = 0.3 }) end, ...)
end
refused({ source = 1, walls = { 2, 3, 4 }, full_turn = true }, nil, "full_turn", "no source")
refused({ full_turn = true, class = "closed" }, nil, "full_turn")
refused({ full_turn = true }, { size = 0.3, layers = 3 }, "at least 4 layers", "3")
refused({ full_turn = true }, { size = 0.3, layers = { count = 20, bias = 2 } }, "bias")
check.fails(function() model:open_volume { full_turn = true }:close() end, "full-turn", "cut()")
model = lacuna.synthetic.prism { sides = 6, radius = 1, height = 3 }
refused({ full_turn = true }, nil, "no plane through the centre", "volume:cut")

-- Ends that share an edge, as of a pie: refused by name, and swept along the edge as the error says.
local function pie(angle)
  local made, n = lacuna.model(), 12
  local function at(i, z) return { 2 * math.cos(angle * i / n), 2 * math.sin(angle * i / n), z } end
  local function add(name, points, cells)
    made:add_face { name = name, points = points, cells = cells }
  end
  local two = { { 1, 2, 3 }, { 1, 3, 4 } }
  for name, i in ipairs { 0, n } do
    add(name == 1 and "first" or "last", { { 0, 0, 0 }, at(i, 0), at(i, 3), { 0, 0, 3 } }, two)
  end
  for name, z in ipairs { 0, 3 } do
    local points, cells = { { 0, 0, z } }, {}
    for i = 0, n do points[i + 2] = at(i, z) end
    for i = 1, n do cells[i] = { 1, i + 1, i + 2 } end
    add(name == 1 and "low" or "high", points, cells)
  end
  local points, cells = {}, {}
  for i = 0, n do points[2 * i + 1], points[2 * i + 2] = at(i, 0), at(i, 3) end
  for i = 1, 2 * n - 1, 2 do
    cells[#cells + 1], cells[#cells + 2] = { i, i + 2, i + 3 }, { i, i + 3, i + 1 }
  end
  add("round", points, cells)
  return made
end
for _, angle in ipairs { 0.5, math.pi / 2, 2.5 } do
  local made = pie(angle)
  local function ends(walls)
    return function() made:open_volume { source = "first", target = "last", walls = walls } end
  end
  check.fails(ends { "low", "high" }, "share edge", '"low"', '"high"')
  check.fails(ends "round", "share edge", "sweep along that edge")
  local along = made:open_volume { source = "low", target = "high", walls = "auto" }:sweep { size = 0.4 }
  check.equal(along:quality().certified, true)
  check.equal(along.wedges, 0)
end
check.done()
