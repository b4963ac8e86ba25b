-- SPDX-License-Identifier: MIT
-- Copies and patterns of meshes: cells stay positive, faces that coincide become one, wrong use is refused.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")
local params = lacuna.params { lacuna = "lacuna", scratch = "." }
local pi, cos, sin = math.pi, math.cos, math.sin
local origin, X, Y, Z = { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }

-- The outline { { x, y }, … }, all seen from its first corner, as a face, swept by `along`.
local function swept(outline, along, options, name)
  local sheet, points, cells = lacuna.model(), {}, {}
  for i, p in ipairs(outline) do
    points[i] = { p[1], p[2], 0 }
    if i > 2 then cells[i - 2] = { 1, i - 1, i } end
  end
  sheet:add_face { name = "floor", points = points, cells = cells }
  return sheet:open_volume { source = "floor", along = along, name = name }:sweep(options)
end
local function box(size, name, at)
  local x = at or 0
  return swept({ { x, 0 }, { x + 1, 0 }, { x + 1, 1 }, { x, 1 } }, { vector = { 0, 0, 1 } },
    { size = size or 0.5, layers = 2 }, name)
end
-- A sector of a ring: from one radius to another, of so many in a full turn, `n` quads round.
local function sector(count, name)
  local low, high, step = 1, 2, 2 * pi / count
  return swept({ { low, 0 }, { high, 0 }, { high * cos(step), high * sin(step) },
    { low * cos(step), low * sin(step) } }, { vector = { 0, 0, 0.5 } }, { size = 0.34, layers = 2 }, name)
end

local function same_quality(mesh, other, times)
  local a, b = mesh:quality(), other:quality()
  check.that(b.certified, "certified")
  check.near(b.min_scaled_jacobian, a.min_scaled_jacobian, 1e-9)
  check.near(b.volume / a.volume, times, 1e-9)
end

-- --- copies ----------------------------------------------------------------------------------------------

local moves = {
  { translate = { 5, -1, 2 } },
  { rotate = { { 1, 2, 3 }, { 1, 1, 0 }, 50 } },
  { mirror = { { 3, 0, 0 }, { 1, 0.2, -0.1 } } },
}
local ell = { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } }
for _, options in ipairs { { order = 1 }, { order = 2 }, { order = 2, serendipity = true } } do
  options.size, options.layers = 0.6, 3
  local mesh = swept(ell, { axis = { { -2, 0, 0 }, Y }, angle = -60 }, options)
  for _, move in ipairs(moves) do
    local copy = mesh:copy(move)
    check.equal(copy.nodes, mesh.nodes)
    check.equal(copy.hexes, mesh.hexes)
    check.equal(copy.order, mesh.order)
    same_quality(mesh, copy, 1)
    same_quality(mesh, copy:copy(move.mirror and move or { translate = X }), 1)
  end
  local x, y, z = mesh:copy { translate = { 5, -1, 2 } }:node(7)
  local a, b, c = mesh:node(7)
  check.that(x == a + 5 and y == b - 1 and z == c + 2)
end
-- Wedges are turned over too.
do
  local sheet = lacuna.model()
  sheet:add_face { name = "floor", points = { origin, X, { 1, 1, 0 }, Y, { 2, 0, 0 } }, keep_mesh = true,
    cells = { { 1, 2, 3, 4 }, { 2, 5, 3 } } }
  local mesh = sheet:open_volume { source = "floor", along = { vector = Z } }:sweep { layers = 2,
    wedges = true, quads = "keep" }
  check.equal(mesh.wedges, 2)
  same_quality(mesh, mesh:copy { mirror = { origin, X } }, 1)
  local both = mesh:copy { mirror = { { 0, 0, 1 }, Z } }
  same_quality(mesh, lacuna.assembly { mesh, both }:sweep(), 2)
end

-- The skin of a copy faces outward, mirrored or not.
do
  local function enclosed(mesh)
    local base = params.scratch .. "/outward.msh"
    mesh:write(base, { version = 2.2, binary = false })
    local file <close> = assert(io.open(base))
    local text, at, sum = file:read "a", {}, 0
    for n, x, y, z in text:match "%$Nodes\n%d+\n(.-)%$EndNodes":gmatch "(%d+) (%S+) (%S+) (%S+)" do
      at[n] = { tonumber(x), tonumber(y), tonumber(z) }
    end
    local function det(p, q, r)
      return p[1] * (q[2] * r[3] - q[3] * r[2]) - p[2] * (q[1] * r[3] - q[3] * r[1]) +
          p[3] * (q[1] * r[2] - q[2] * r[1])
    end
    for a, b, c, d in text:gmatch "\n%d+ 3 2 %d+ %d+ (%d+) (%d+) (%d+) (%d+)%f[\n]" do
      sum = sum + (det(at[a], at[b], at[c]) + det(at[a], at[c], at[d])) / 6
    end
    return sum
  end
  local mesh = swept(ell, { vector = { 0.3, 0.2, 1 } }, { size = 0.6, layers = 3 })
  check.near(enclosed(mesh), 3, 1e-12)
  for _, move in ipairs(moves) do check.near(enclosed(mesh:copy(move)), 3, 1e-12) end
end

-- --- patterns --------------------------------------------------------------------------------------------

-- Translated boxes have the nodes and groups of one long box.
for _, count in ipairs { 1, 2, 7 } do
  local row = box(0.25):pattern { translate = X, count = count }
  check.equal(row.hexes, 32 * count)
  check.equal(row.nodes, (4 * count + 1) * 5 * 3)
  check.near(row:quality().volume, count, 1e-12)
  local cells = {}
  for _, group in ipairs(row:groups()) do cells[group.name] = group.cells end
  check.equal(cells.source, 16 * count)
  check.equal(cells.target, 16 * count)
  check.equal(cells.volume, 32 * count)
  check.equal(cells["void:1"] + cells["void:2"] + cells["void:3"] + cells["void:4"], 16 * count + 16)
end
-- Grids of grids join at faces, edges and corners.
for _, order in ipairs { 1, 2 } do
  local cell = swept({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }, { vector = Z },
    { size = 0.5, layers = 2, order = order })
  local grid = cell:pattern { translate = X, count = 3 }:pattern { translate = Y, count = 4 }:pattern {
    translate = Z, count = 2 }
  check.equal(grid.hexes, 8 * 24)
  check.equal(grid.nodes, (6 * order + 1) * (8 * order + 1) * (4 * order + 1))
  same_quality(cell, grid, 24)
end
-- A ring closes; with a mirrored half as well.
for _, count in ipairs { 3, 8, 12 } do
  local part = sector(count, "steel")
  local ring = part:pattern { rotate = { origin, Z, 360 / count }, count = count }
  local half = part.nodes - 3 * (part.hexes / 2 / 3 + 1) -- a sector has three rows of quads across
  check.equal(ring.hexes, count * part.hexes)
  check.equal(#ring.regions, 1)
  check.equal(ring.regions[1], "steel")
  same_quality(part, ring, count)
  local nodes = {}
  for i = 1, ring.nodes do -- no two nodes in one place
    local x, y, z = ring:node(i)
    local key = ("%.6f %.6f %.6f"):format(x + 0.0, y + 0.0, z + 0.0):gsub("%-(0%.0+)%f[%D]", "%1")
    check.that(not nodes[key], "two nodes in one place: " .. key)
    nodes[key] = true
  end
  check.that(half > 0)
end
-- Sectors that share the axis.
do
  local slice = swept({ { 0, 0 }, { 1, 0 }, { cos(pi / 3), sin(pi / 3) } }, { vector = Z },
    { size = 0.3, layers = 2 })
  local disc = slice:pattern { rotate = { origin, Z, 60 }, count = 6 }
  same_quality(slice, disc, 6)
  local own = 0
  for i = 1, disc.nodes do
    local x, y = disc:node(i)
    if x * x + y * y < 1e-20 then own = own + 1 end
  end
  check.equal(own, 3)
end
-- Numbered regions are in the group of all.
do
  local row = box(nil, "cell"):pattern { translate = X, count = 3, numbered = true }
  check.equal(table.concat(row.regions, " "), "cell_1 cell_2 cell_3")
  local cells = {}
  for _, group in ipairs(row:groups()) do cells[group.name] = group.cells end
  check.equal(cells.cell_2, 8)
  check.equal(cells.volume, 24)
end
-- An assembly and a full turn as patterns.
do
  local model = lacuna.model()
  model:add_face { name = "s", points = { origin, X, { 1, 1, 0 }, Y }, cells = { { 1, 2, 3, 4 } } }
  local a = model:open_volume { source = "s", along = { vector = { 0, 0, -0.5 } }, name = "foil" }
  local b = model:open_volume { source = "s", along = { vector = Z }, name = "paste" }
  local pair = lacuna.assembly { a, b }:sweep { size = 0.5, layers = 2 }
  local stack = pair:pattern { translate = { 0, 0, 1.5 }, count = 10 }
  check.equal(table.concat(stack.regions, " "), "foil paste")
  check.equal(stack.nodes, 9 * 41)
  check.near(stack:quality().volume, 15, 1e-12)
  local ring = swept({ { 3, 0 }, { 4, 0 }, { 4, 1 }, { 3, 1 } }, { axis = { origin, Y }, angle = 360 },
    { size = 0.5, layers = 12 })
  local tube = ring:pattern { translate = Y, count = 3 }
  same_quality(ring, tube, 3)
  check.equal(tube.nodes, 12 * 3 * 7)
  check.equal(ring:copy({ translate = X }).nodes, ring.nodes)
end

-- --- assemblies of copies --------------------------------------------------------------------------------

local left = box(nil, "left")
local both = lacuna.assembly { left, left:copy { mirror = { X, X }, name = "right" } }:sweep()
check.equal(both.nodes, 5 * 3 * 3)
check.equal(table.concat(both.regions, " "), "left right")
same_quality(left, both, 2)
-- A volume swept between two copies shares the nodes of both.
do
  local model = lacuna.model()
  model:add_face { name = "s", points = { { 1, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 } },
    cells = { { 1, 2, 3, 4 } } }
  local middle = model:open_volume { source = "s", along = { vector = Z }, name = "middle" }
  local three = lacuna.assembly { left, middle, left:copy { translate = { 2, 0, 0 }, name = "right" } }
    :sweep { size = 0.5 }
  check.equal(three.nodes, 7 * 3 * 3)
end

-- --- files -----------------------------------------------------------------------------------------------

local ring = sector(6, "steel"):pattern { rotate = { origin, Z, 60 }, count = 6 }
for _, ending in ipairs { "msh", "vtu", "vtk", "inp", "bdf", "unv", "exo" } do
  local path = params.scratch .. "/ring." .. ending
  ring:write(path)
  local read = lacuna.load(path)
  local area = 0
  for _, face in ipairs(read:faces { free = true }) do area = area + face.area end
  local side = 2 * sin(pi / 6)
  check.near(area, 2 * 6 * (4 - 1) * sin(pi / 3) / 2 + 0.5 * 6 * (1 + 2) * side, 1e-6) -- no face inside
end
local twice = box():pattern { translate = X, count = 2 }
twice:write(params.scratch .. "/a.msh")
box():pattern({ translate = X, count = 2 }):write(params.scratch .. "/b.msh")
local function bytes(name)
  local file <close> = assert(io.open(params.scratch .. "/" .. name, "rb"))
  return file:read "a"
end
check.that(bytes "a.msh" == bytes "b.msh", "the same bytes")
-- Copies make their nodes as they are written; files are the same once another format has them stored.
local function ring_of_eight()
  return sector(8, "steel"):pattern { rotate = { origin, Z, 45 }, count = 8 }
end
local function grid_of_twelve()
  return box():pattern({ translate = X, count = 3 }):pattern { translate = Y, count = 4 }
end
for _, made in ipairs { ring_of_eight, grid_of_twelve } do
  for _, ending in ipairs { "msh", "vtu", "inp" } do
    local pattern = made()
    local path = "pattern." .. ending
    pattern:write(params.scratch .. "/" .. path)
    local before = bytes(path)
    pattern:write(params.scratch .. "/stored.exo")
    pattern:write(params.scratch .. "/" .. path)
    check.that(before == bytes(path), "other bytes of " .. ending)
  end
end
local function peak() -- in bytes, where the system tells it
  local file <close> = io.open "/proc/self/status"
  local kib = file and file:read("a"):match "VmHWM:%s*(%d+)"
  return kib and tonumber(kib) * 1024
end
do
  local mesh = swept({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }, { vector = Z },
    { size = 1 / 28, layers = 28 })
  local before = peak()
  local many = mesh:pattern { translate = X, count = 100 }
  many:write(params.scratch .. "/many.vtu")
  check.equal(many.hexes, 100 * 28 ^ 3)
  if before then check.that(peak() < 1.2 * before + 24 * many.nodes, "memory of a pattern") end
end

-- --- refusals --------------------------------------------------------------------------------------------

local one = box()
-- A gap that is too small to be meant is said.
local apart = one:pattern { translate = { 1.0001, 0, 0 }, count = 2 }
check.that(tostring(apart.report):find("copies come within 0.0001", 1, true), "a gap")
check.fails(function() one:copy {} end, "translate", "rotate", "mirror")
check.fails(function() one:copy { translate = X, mirror = { origin, X } } end, "mirror", "translate")
check.fails(function() one:copy { rotate = { origin, Z } } end, "angle")
check.fails(function() one:copy { mirror = { origin, origin } } end, "a normal of length 0")
-- A plane is { point, normal } or has these names, wherever one is given.
local half = { 0.5, 0, 0 }
for _, plane in ipairs { { half, X }, { point = half, normal = X } } do
  local void = lacuna.synthetic.prism { sides = 4 }:open_volume {}
  check.equal(#void:cut { plane = plane }, 2)
  check.that(one:copy { mirror = plane }.hexes == one.hexes)
end
for _, wrong in ipairs { { half }, { point = half }, { half, X, 1 }, { point = half, normal = X, angle = 3 },
    "x" } do
  check.fails(function() one:copy { mirror = wrong } end, "a plane { point, normal }")
end
check.fails(function() one:copy { shift = X } end, "shift", "translate")
check.fails(function() one:pattern { translate = X } end, "count")
check.fails(function() one:pattern { translate = X, count = 0 } end, "count")
check.fails(function() one:pattern { mirror = { origin, X }, count = 2 } end, "mirror")
-- Copies that overlap, in part or wholly; each says where, or which.
check.fails(function() one:pattern { translate = { 0.4, 0, 0 }, count = 2 } end, "assembly.overlap", "copy 1")
check.fails(function() one:pattern { rotate = { origin, Z, 360 }, count = 2 } end, "assembly.overlap")
check.fails(function() one:pattern { translate = { 0.4, 0.3, 0.2 }, count = 3 } end, "assembly.overlap", "(")
check.fails(function() one:pattern { rotate = { { 1, 0.5, 0 }, Z, 30 }, count = 3 } end, "assembly.overlap")
-- Faces that coincide in part, or with other quads.
check.fails(function() one:pattern { translate = { 1, 0.5, 0 }, count = 2 } end, "assembly.part_of_face")
local uneven = swept({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }, { vector = Z },
  { size = 0.5, layers = { 0.3, 1 } })
check.fails(function()
  lacuna.assembly { uneven, uneven:copy { rotate = { { 1, 0, 0.5 }, Y, 180 } } }:sweep()
end, "assembly.not_shared", "(")
check.fails(function() lacuna.assembly { left, left:copy { translate = X } }:sweep() end,
  "assembly.same_name", "left")
-- A copy that floats beside the mesh is part of it.
check.equal(one:pattern({ translate = { 2, 0, 0 }, count = 2 }).nodes, 2 * one.nodes)

check.done()
