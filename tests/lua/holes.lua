-- SPDX-License-Identifier: MIT
-- Holes of a given end that have no walls, rough rims, and what closing assumes: what is refused, and what is
-- told on standard error.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }
local folder = check.empty_folder(params.scratch)

-- --- holes -------------------------------------------------------------------------------------------------

local function polygon(sides, radius)
  local area = sides * radius ^ 2 * math.sin(2 * math.pi / sides) / 2
  return area
end

for _, sides in ipairs { 3, 4, 6 } do
  for _, radius in ipairs { 0.1, 0.3 } do
    local drop = { "target" }
    local walls = {}
    for w = 1, sides do
      walls[w] = "wall_" .. w
      drop[w + 1] = "wall_" .. w + sides
    end
    local model = lacuna.synthetic.prism { sides = sides, holes = 1, hole_radius = radius, drop = drop }
    local covered, through = 2 * polygon(sides, 1), 2 * (polygon(sides, 1) - polygon(sides, radius))
    for _, roles in ipairs { { source = "source", walls = walls }, {} } do
      local function open(reading)
        local asked = { reading = reading }
        for key, value in pairs(roles) do asked[key] = value end
        return model:open_volume(asked)
      end
      -- Without a word on it, both volumes are told.
      local why = check.fails(function() open():sweep {} end, "closure.holes_open", 'holes = "cover"',
          'holes = "through"')
      local told = {}
      for number in why:gmatch("encloses (%d[%d.]*)") do told[#told + 1] = tonumber(number) end
      check.near(told[1], covered, 1e-5 * covered)
      check.near(told[2], through, 1e-5 * through)
      for what, volume in pairs { cover = covered, through = through } do
        local void = open()
        check.that(void:close { holes = what }.watertight)
        local mesh = void:sweep { layers = 2 }
        check.near(mesh.fidelity.sealed_volume, volume, 1e-6 * volume)
        check.that(mesh:quality().certified)
      end
      check.that(open(1):sweep { layers = 2 }.hexes > 0) -- a guess is taken
    end
  end
end

-- Where there is no such hole, nothing is to be said of it.
for _, drop in ipairs { { "target" }, { "source", "target" }, { "wall_1" } } do
  for _, what in ipairs { "cover", "through" } do
    local roles = { walls = { "wall_2", "wall_3", "wall_4" } }
    if drop[1] ~= "wall_1" then roles.walls[4] = "wall_1" end
    if #drop == 1 then roles.source = "source" end
    if drop[1] == "wall_1" then roles.target = "target" end
    local void = lacuna.synthetic.prism { sides = 4, drop = drop }:open_volume(roles)
    check.fails(function() void:close { holes = what } end, "closure.holes_unused")
  end
end

-- --- holes of walls beside a missing end -------------------------------------------------------------------

-- A prism or cylinder without its top; some walls have a square hole, from which a nozzle may lead.
-- Returns the model, the names of its walls and the volume with the top and without the nozzle.
local function holed_walls(sides, round, holes, nozzle)
  local height, cuts, model, walls = 2, 6, lacuna.model(), {}
  local function at(k, t, z)
    local a, b = 2 * math.pi * k / sides, 2 * math.pi * (k + 1) / sides
    local c = a + (b - a) * t
    if round then return { math.cos(c), math.sin(c), z } end
    return { (1 - t) * math.cos(a) + t * math.cos(b), (1 - t) * math.sin(a) + t * math.sin(b), z }
  end
  for k = 0, sides - 1 do
    local points, cells = {}, {}
    for i = 0, cuts do
      for j = 0, cuts do
        points[#points + 1] = at(k, i / cuts, height * j / cuts)
        local n = #points
        if i < cuts and j < cuts and not (k < holes and i == 2 and j == 3) then
          cells[#cells + 1] = { n, n + cuts + 1, n + cuts + 2, n + 1 }
        end
      end
    end
    walls[k + 1] = "w" .. k
    model:add_face { name = walls[k + 1], points = points, cells = cells }
  end
  local floor, fan, area = { { 0, 0, 0 } }, {}, 0
  local n = sides * cuts
  for i = 0, n - 1 do
    local p, q = at(i // cuts, i % cuts / cuts, 0), at((i + 1) // cuts, (i + 1) % cuts / cuts, 0)
    floor[i + 2], fan[i + 1] = p, { 1, (i + 1) % n + 2, i + 2 }
    area = area + (p[1] * q[2] - p[2] * q[1]) / 2
  end
  model:add_face { name = "floor", points = floor, cells = fan }
  for i = 1, nozzle and 4 or 0 do
    local ring = { at(0, 2 / 6, 1), at(0, 3 / 6, 1), at(0, 3 / 6, 4 / 3), at(0, 2 / 6, 4 / 3) }
    local a, b = ring[i], ring[i % 4 + 1]
    walls[#walls + 1] = "n" .. i
    model:add_face { name = "n" .. i, cells = { { 1, 2, 3, 4 } },
      points = { a, b, { 1.3 * b[1], 1.3 * b[2], b[3] }, { 1.3 * a[1], 1.3 * a[2], a[3] } } }
  end
  return model, walls, height * area
end

for _, sides in ipairs { 3, 4, 6 } do
  for _, round in ipairs { false, true } do
    for holes = 1, 2 do
      local model, walls, volume = holed_walls(sides, round, holes)
      for _, cap in ipairs { "auto", "flat", "parallel" } do
        for _, names in ipairs { walls, "auto" } do
          local void = model:open_volume { source = "floor", walls = names }
          check.equal(void.class, "IV")
          check.equal(void:close({ cap = cap }).void_faces, 1 + holes)
          local mesh = void:sweep { layers = 4 }
          check.near(mesh.fidelity.sealed_volume, volume, (round and 0.02 or 1e-9) * volume)
          check.that(mesh:quality().certified)
        end
      end
    end
  end
  -- A nozzle is no hole.
  local model, walls = holed_walls(sides, false, 1, true)
  check.fails(function() model:open_volume({ source = "floor", walls = walls }):close() end,
    "closure.loop_counts")
end

-- A void that was sealed while its roles were found is sealed anew by options of the first close{}.
for _, sides in ipairs { 4, 6 } do
  for _, cap in ipairs { "flat", "parallel" } do
    local model, _, volume = holed_walls(sides, false, 1)
    local void = model:open_volume {}
    if void.class == "IV" then
      check.equal(void:close({ cap = cap }).watertight, true)
      check.near(void:sweep({ layers = 4 }).fidelity.sealed_volume, volume, 1e-9 * volume)
    end
    check.that(void:close().watertight)
    check.fails(function() void:close { cap = cap } end, "lua.sealed", "first call of close()")
  end
end

-- --- what is told on standard error ------------------------------------------------------------------------

-- A recipe that sweeps `void` tells of an assumption once, or of none.
local function tells(code, recipe)
  local head = 'local lacuna = require "lacuna"\nlocal synthetic = lacuna.synthetic\n'
  check.write(folder .. "/recipe.lua", head .. recipe .. "\nvoid:close()\nvoid:sweep { layers = 4 }\n")
  local exit, out, err = check.run(params.lacuna, folder, { folder .. "/recipe.lua" })
  check.equal(exit, 0, err)
  local notes = {}
  for found in err:gmatch("note: [^\n]-%[(closure%.[%w_]+)%]") do notes[#notes + 1] = found end
  check.equal(table.concat(notes, " "), code or "", recipe .. "\n" .. err)
end

local function prism(options, roles)
  return ("local void = synthetic.prism { %s }:open_volume { %s }"):format(options, roles)
end
local ends = 'source = "source", target = "target"'

-- A wall was forgotten beside the missing end. One that takes little away is not worth a note.
tells("closure.end_moved", prism('sides = 4, drop = { "target", "wall_2" }',
  'source = "source", walls = { "wall_1", "wall_3", "wall_4" }'))
tells("closure.end_moved", prism('sides = 6, drop = { "target", "wall_2", "wall_3" }',
  'source = "source", walls = { "wall_1", "wall_4", "wall_5", "wall_6" }, class = "IV"'))
local chamfered = [[
local width = %g
local low = { { 0, 0, 0 }, { 3, 0, 0 }, { 3, 3 - width, 0 }, { 3 - width, 3, 0 }, { 0, 3, 0 } }
local model = lacuna.model()
model:add_face { name = "low", points = low, cells = { { 1, 3, 2 }, { 1, 4, 3 }, { 1, 5, 4 } } }
local walls = {}
for i, a in ipairs(low) do
  local b = low[i %% 5 + 1]
  if i ~= 3 then
    walls[#walls + 1] = model:add_face { points = { a, b, { b[1], b[2], 2 }, { a[1], a[2], 2 } },
      cells = { { 1, 2, 3, 4 } } }
  end
end
local void = model:open_volume { source = "low", walls = walls }]]
tells("closure.end_moved", chamfered:format(1.5))
tells(nil, chamfered:format(0.1))

-- Holes that are taken through because a guess was asked for.
local holed = [[
local drop = { "target", "wall_5", "wall_6", "wall_7", "wall_8" }
local void = synthetic.prism { sides = 4, holes = 1, hole_radius = %g, drop = drop }:open_volume {
  source = "source", walls = { "wall_1", "wall_2", "wall_3", "wall_4" }, reading = 1 }]]
tells("closure.edge_assumed closure.hole_through", holed:format(0.4))
tells("closure.edge_assumed", holed:format(0.1)) -- its flat walls are assumed, however small

-- Ends that are turned against each other: straight or a bend.
tells("closure.bend_assumed", prism('height = 4, bend = 60, drop = "walls"', ends))
tells(nil, prism('height = 4, bend = 15, drop = "walls"', ends))

-- A bore without walls bends as the walls round it.
local elbow = 'local void = synthetic.elbow { inner = 0.5, angle = %d, drop = { "wall_2" } }' ..
  ":open_volume { " .. ends .. ', walls = { "wall_1" } }'
tells("closure.loop_follows", elbow:format(60))
tells(nil, elbow:format(30))

-- A box with a missing target: a hole in a wall, and a wall that ends below the others.
local box = [[
local model = lacuna.model()
local function grid(name, o, u, v, nu, nv, skip)
  local points, cells = {}, {}
  for i = 0, nu do
    for j = 0, nv do
      points[#points + 1] = {}
      for c = 1, 3 do points[#points][c] = o[c] + u[c] * i + v[c] * j end
      local k = #points
      if i < nu and j < nv and not (skip and i == skip and j == skip) then
        cells[#cells + 1] = { k, k + nv + 1, k + nv + 2, k + 1 }
      end
    end
  end
  model:add_face { name = name, points = points, cells = cells }
end
grid("low", { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 3, 3)
grid("w1", { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, 3, 3, %s)
grid("w2", { 3, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 3, 3)
grid("w3", { 3, 3, 0 }, { -1, 0, 0 }, { 0, 0, 1 }, 3, 3)
grid("w4", { 0, 3, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, 3, %d)
local void = model:open_volume {}]]
tells("closure.hole_closed", box:format("1", 3))
tells("closure.walls_filled", box:format("nil", 1))
tells(nil, box:format("nil", 3))

-- A barrel with two opposite walls, which bulge by a share of its radius: too little to lead the void edges.
local barrel = [[
local sides, height, rows, bulge = 8, 2, 12, %g
local model = lacuna.model()
local function at(k, z)
  local r, angle = 1 + bulge * 4 * z / height * (1 - z / height), 2 * math.pi * k / sides
  return { r * math.cos(angle), r * math.sin(angle), z }
end
for _, z in ipairs { 0, height } do
  local points, cells = {}, {}
  for k = 1, sides do
    points[k] = at(k - 1, z)
    if k > 2 then cells[k - 2] = { 1, k - 1, k } end
  end
  model:add_face { name = z == 0 and "source" or "target", points = points, cells = cells }
end
for _, k in ipairs { 0, 4 } do
  local points, cells = {}, {}
  for row = 0, rows do
    points[2 * row + 1], points[2 * row + 2] = at(k, height * row / rows), at(k + 1, height * row / rows)
    if row > 0 then cells[row] = { 2 * row - 1, 2 * row, 2 * row + 2, 2 * row + 1 } end
  end
  model:add_face { name = "wall_" .. k, points = points, cells = cells }
end
local void = model:open_volume { source = "source", target = "target", walls = { "wall_0", "wall_4" } }]]
for _, bulge in ipairs { 0.032, 0.035, 0.038 } do
  tells("closure.straight_assumed", barrel:format(bulge))
end
tells(nil, barrel:format(0.01))

-- A prism whose missing top has a rim of one wave a side: a membrane, where a guess is asked for.
local waves = [[
local sides, cuts, wave = %d, 6, %g
local model = lacuna.model()
local floor, fan, n = { { 0, 0, 0 } }, {}, sides * cuts
local function at(i, z)
  local t = i %% cuts / cuts
  local a, b = 2 * math.pi * (i // cuts) / sides, 2 * math.pi * (i // cuts + 1) / sides
  return { (1 - t) * math.cos(a) + t * math.cos(b), (1 - t) * math.sin(a) + t * math.sin(b),
    z + (z > 0 and wave * math.cos(2 * math.pi * t) or 0) }
end
for i = 0, n - 1 do
  floor[i + 2], fan[i + 1] = at(i, 0), { 1, (i + 1) %% n + 2, i + 2 }
end
model:add_face { name = "floor", points = floor, cells = fan }
local walls = {}
for k = 0, sides - 1 do
  local points, cells = {}, {}
  for j = 0, cuts do
    local i = (k * cuts + j) %% n
    points[2 * j + 1], points[2 * j + 2] = at(i, 0), at(i, 1.2)
    if j > 0 then cells[j] = { 2 * j - 1, 2 * j + 1, 2 * j + 2, 2 * j } end
  end
  walls[k + 1] = model:add_face { points = points, cells = cells }
end
local void = model:open_volume { source = "floor", walls = walls, reading = 1 }]]
for _, sides in ipairs { 5, 6, 8 } do
  tells("closure.membrane", waves:format(sides, 0.2))
  tells(nil, waves:format(sides, 0))
end

-- A counterbore without its mouth, whose floor has a hole: its faces look into it, or out of it.
local counterbore = [[
local sides, radius, height, inward = %d, %g, 2, %s
local model = lacuna.model()
local function at(k, r, z)
  return { r * math.cos(2 * math.pi * k / sides), r * math.sin(2 * math.pi * k / sides), z }
end
local function add(name, points, cells)
  if inward then
    for _, cell in ipairs(cells) do
      cell[1], cell[2], cell[3], cell[4] = cell[4], cell[3], cell[2], cell[1]
    end
  end
  return model:add_face { name = name, points = points, cells = cells }
end
local points, cells = {}, {}
for k = 1, sides do
  points[k], points[k + sides] = at(k, 1, 0), at(k, radius, 0)
  local next = k %% sides + 1
  cells[k] = { k, k + sides, next + sides, next }
end
local walls = { add("floor", points, cells) }
for k = 1, sides do
  walls[k + 1] = add("wall_" .. k, { at(k, 1, 0), at(k + 1, 1, 0), at(k + 1, 1, height), at(k, 1, height) },
    { { 1, 2, 3, 4 } })
end
local void = model:open_volume { walls = walls }]]
for _, sides in ipairs { 4, 6 } do
  tells("closure.hole_covered", counterbore:format(sides, 0.4, "true"))
  tells(nil, counterbore:format(sides, 0.4, "false"))
  tells(nil, counterbore:format(sides, 0.1, "true"))
end

-- A tube that ends inside its shell: smooth ends run down to its rims like funnels.
local bundle = [[
local model, sides = lacuna.model(), 24
local function tube(name, x, radius, low, high, out)
  local points, cells = {}, {}
  for _, z in ipairs { low, high } do
    for k = 1, sides do
      local turn = 2 * math.pi * k / sides
      points[#points + 1] = { x + radius * math.cos(turn), radius * math.sin(turn), z }
    end
  end
  for k = 1, sides do
    local next = k %% sides + 1
    cells[k] = out and { k, next, next + sides, k + sides } or { next, k, k + sides, next + sides }
  end
  return model:add_face { name = name, points = points, cells = cells }
end
local void = model:open_volume { walls = {
  tube("shell", 0, 30, 0, 100, true), tube("through", -10, 5, 0, 100), tube("short", 10, 5, %g, %g) } }]]
tells("closure.membrane closure.membrane", bundle:format(20, 80))
tells(nil, bundle:format(0, 100))

-- Nothing is assumed where all is given.
tells(nil, prism("sides = 6", ends .. ', walls = "auto"'))
tells(nil, prism('sides = 6, drop = { "target" }', 'source = "source", walls = "auto"'))

-- A body in a void is named in a note, one beside it is not, nor one whose faces are given.
local floating = [[
local model = lacuna.model()
local function box(name, x, half, height)
  local p = {}
  for i = 0, 7 do
    local sx, sy, sz = (i + i // 2) %% 2 * 2 - 1, i // 2 %% 2 * 2 - 1, i // 4 * 2 - 1
    p[i + 1] = { x + half * sx, half * sy, height * sz }
  end
  local sides = { { 4, 3, 2, 1 }, { 5, 6, 7, 8 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 4, 8, 7 },
    { 4, 1, 5, 8 } }
  for i, side in ipairs(sides) do
    if name ~= "loose" or i > %d then model:add_face { name = name .. i, points = p, cells = { side } } end
  end
end
local boxes = { { "out", 0, 4, 4 }, { "in", 0, 2, 3 } }
table.insert(boxes, %d, { "loose", %g, 0.5, 0.5 })
for _, one in ipairs(boxes) do box(table.unpack(one)) end
local void = model:open_volume { %s }]]
local function tells_of_body(x, roles, wanted, place, dropped)
  check.write(folder .. "/recipe.lua",
    'local lacuna = require "lacuna"\n' .. floating:format(dropped or 0, place or 3, x, roles))
  local exit, _, err = check.run(params.lacuna, folder, { folder .. "/recipe.lua" })
  check.equal(exit, 0, err)
  local _, count = err:gsub('note: face %d+ "loose%d" lies inside the volume', "")
  check.equal(count, wanted, roles .. "\n" .. err)
end
for _, roles in ipairs { 'source = "in1", target = "in2", walls = "auto"',
  'faces = { "in1", "in2", "in3", "in4", "in5", "in6" }',
  'source = "in1", walls = { "in3", "in4", "in5", "in6" }' } do
  for _, x in ipairs { 0, 1, -1.2 } do tells_of_body(x, roles, 1) end
  for _, x in ipairs { 3, 10 } do tells_of_body(x, roles, 0) end
end
-- A shell, or one face of it, is named as a body is.
for dropped = 1, 5, 2 do
  tells_of_body(0, 'source = "in1", target = "in2", walls = "auto"', 1, 3, dropped)
  tells_of_body(3, 'source = "in1", target = "in2", walls = "auto"', 0, 3, dropped)
end
-- One whose tags are those of the void faces, too.
for place = 1, 3 do tells_of_body(0, 'faces = { "in1", "in3", "in4" }', 1, place) end
tells_of_body(0, 'source = { "in1", "loose2" }, target = { "in2", "loose1" }, ' ..
  'walls = { "in3", "in4", "in5", "in6", "loose3", "loose4", "loose5", "loose6" }', 0)

-- --- rough rims ------------------------------------------------------------------------------------------

-- A tube of facets, as of a bone that was cut: points of its rims are off a plane by a share of its diameter.
local function bone(seed, sides, height, rough, both)
  local random = check.random(seed)
  local points, cells = {}, {}
  local rings = 4
  for k = 0, rings do
    for i = 0, sides - 1 do
      local angle = 2 * math.pi * i / sides
      local radius = 1 + 0.15 * math.cos(3 * angle) + 0.05 * math.sin(2 * angle)
      local z = height * k / rings
      if k == rings or (both and k == 0) then z = z + random(-2, 2) * rough end
      points[#points + 1] = { radius * math.cos(angle), radius * math.sin(angle), z }
    end
  end
  for k = 0, rings - 1 do
    for i = 0, sides - 1 do
      local a, b = k * sides + i + 1, k * sides + (i + 1) % sides + 1
      cells[#cells + 1] = { a, b, b + sides }
      cells[#cells + 1] = { a, b + sides, a + sides }
    end
  end
  local model = lacuna.model()
  model:add_face { name = "wall", points = points, cells = cells }
  if not both then
    local floor, fan = { { 0, 0, 0 } }, {}
    for i = 1, sides do
      floor[i + 1] = points[i]
      fan[i] = { 1, i % sides + 2, i + 1 }
    end
    model:add_face { name = "floor", points = floor, cells = fan }
  end
  return model:open_volume { source = not both and "floor" or nil, walls = "wall" }
end

for seed = 1, 6 do
  for _, sides in ipairs { 24, 48, 96 } do
    for _, both in ipairs { false, true } do
      check.that(bone(seed, sides, 3, 0.045, both):close().watertight)
    end
  end
end
-- Numbers of nine digits put the start of a rim a rounding error away from the corner that it is.
local function spiked_tube(spike)
  local R, H, N, M, lines = 10, 30, 48, 10, { "solid w" }
  local function point(i, j)
    local angle = 2 * math.pi * (i % N) / N
    return ("vertex %.9g %.9g %.9g"):format(R * math.cos(angle), R * math.sin(angle),
      (H + (i % N == 0 and spike or 0)) * j / M)
  end
  local function facet(...)
    lines[#lines + 1] = "facet normal 0 0 0\nouter loop\n" .. table.concat({ ... }, "\n") ..
      "\nendloop\nendfacet"
  end
  for j = 0, M - 1 do
    for i = 0, N - 1 do
      facet(point(i, j), point(i + 1, j), point(i + 1, j + 1))
      facet(point(i, j), point(i + 1, j + 1), point(i, j + 1))
    end
  end
  lines[#lines + 1] = "endsolid w\nsolid bottom"
  for i = 0, N - 1 do facet("vertex 0 0 0", point(i + 1, 0), point(i, 0)) end
  lines[#lines + 1] = "endsolid"
  check.write(folder .. "/tube.stl", table.concat(lines, "\n"))
  return lacuna.load(folder .. "/tube.stl"):open_volume { source = "bottom", walls = "w" }
end
for _, spike in ipairs { 0.2, 0.6, 0.98, 1.6 } do
  check.that(spiked_tube(spike):sweep { size = 2.5 }:quality().certified)
end

-- So rough that it is no rim of a plane, or so low that the rim matters.
check.fails(function() bone(1, 48, 0.5, 0.12, true):close() end, "closure.shape_open")

-- --- equal circles of two parts ----------------------------------------------------------------------------

-- The gap under and round a bush in a stepped bore: flat faces in the two equal circles would fill the bore.
for _, gap in ipairs { 1, 3 } do
  for _, bore in ipairs { 10, 20 } do
    local file = ("%s/bush_%g_%g.geo"):format(folder, gap, bore)
    check.write(file, ([[SetFactory("OpenCASCADE");
Cylinder(1) = {0,0,-4, 0,0,16, 34}; Cylinder(2) = {0,0,-4, 0,0,4, %g}; Cylinder(3) = {0,0,0, 0,0,12, 30};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Cylinder(5) = {0,0,%g, 0,0,%g, 26}; Cylinder(6) = {0,0,%g, 0,0,%g, %g};
BooleanDifference(7) = { Volume{5}; Delete; }{ Volume{6}; Delete; };
]]):format(bore, gap, 12 - gap, gap, 12 - gap, bore))
    local model = lacuna.load(file)
    local function face(near) return { near = near } end
    local void = model:open_volume { faces = { face { 30, 0, 6 }, face { 28, 0, 0 }, face { 26, 0, 6 },
      face { (bore + 26) / 2, 0, gap } } }
    local mesh = void:sweep { size = 2 }
    local volume = math.pi * ((900 - 676) * 12 + (676 - bore ^ 2) * gap)
    check.near(mesh:quality().volume, volume, 0.01 * volume)
  end
end

-- The wall of a bore is missing. Where the space lies inside it, as in an island, flat faces may be meant:
-- that it goes on between them is said. Round it, as in a solid, it is not.
local island = [[SetFactory("OpenCASCADE");
Box(1) = {-10,-10,-10, 20,20,20}; Cylinder(2) = {-5,0,0, 10,0,0, 4}; Cylinder(3) = {-5,0,0, 10,0,0, %g};
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
]]
local around = '{ -10, 0, 0 }, { 10, 0, 0 }, { 0, -10, 0 }, { 0, 10, 0 }, { 0, 0, -10 }, { 0, 0, 10 }, '
for _, case in ipairs { { 3, around, true }, { 2, around, false }, { 3, "", false } } do
  local radius, box, wanted = table.unpack(case)
  check.write(folder .. "/island.geo", island:format(radius))
  check.write(folder .. "/recipe.lua", ([[
local model = require("lacuna").load %q
local faces = {}
for i, place in ipairs { %s{ 0, 4, 0 }, { -5, 0, 3.5 }, { 5, 0, 3.5 } } do faces[i] = { near = place } end
print(#faces, model:open_volume({ faces = faces }):close().watertight)
]]):format(folder .. "/island.geo", box))
  local exit, out, err = check.run(params.lacuna, folder, { folder .. "/recipe.lua" })
  check.equal(exit, 0, err)
  check.that(out:find "true", out)
  check.equal(err:find("closure.round_wall", 1, true) ~= nil, wanted, err)
end

check.done()
