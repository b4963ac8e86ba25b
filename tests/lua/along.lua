-- SPDX-License-Identifier: MIT
-- Sources swept along a path: exact volumes, a family of sources and paths, refusals, the same bytes.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")
local pi, cos, sin = math.pi, math.cos, math.sin
local origin, X, Y, Z = { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }

-- --- sources ---------------------------------------------------------------------------------------------

-- Flat outlines { x, y } with cells, their areas, and x of their centroids.
local function regular(n)
  local shape = { points = {}, cells = {}, area = n / 2 * sin(2 * pi / n), x = 0 }
  for k = 1, n do shape.points[k] = { cos(2 * pi * k / n), sin(2 * pi * k / n) } end
  for k = 2, n - 1 do shape.cells[k - 1] = { 1, k, k + 1 } end
  return shape
end
local function ring(n, inner)
  local shape = { points = {}, cells = {}, area = n / 2 * sin(2 * pi / n) * (1 - inner ^ 2), x = 0 }
  for k = 1, n do
    local c, s = cos(2 * pi * k / n), sin(2 * pi * k / n)
    shape.points[k], shape.points[n + k] = { c, s }, { inner * c, inner * s }
    shape.cells[k] = { k, k % n + 1, n + k % n + 1, n + k }
  end
  return shape
end
local ell = { points = { { -1, -1 }, { 1, -1 }, { 1, 0 }, { 0, 0 }, { 0, 1 }, { -1, 1 } },
  cells = { { 1, 2, 3, 4 }, { 1, 4, 5, 6 } }, area = 3, x = -1 / 6 }
local shapes = { regular(3), regular(4), ell, ring(16, 0.5), regular(32) }
local cornered = { regular(3), regular(4), ell, ring(4, 0.5) }

-- A model of the shape in the plane through `at` along the unit vectors `u` and `v`.
local function model(shape, at, u, v, keep)
  local points, made = {}, lacuna.model()
  for i, p in ipairs(shape.points) do
    points[i] = {}
    for d = 1, 3 do points[i][d] = at[d] + p[1] * u[d] + p[2] * v[d] end
  end
  made:add_face { name = "start", points = points, cells = shape.cells, keep_mesh = keep }
  return made
end

local function open(shape, along, at, u, v)
  local void = model(shape, at or origin, u or X, v or Y):open_volume { source = "start", along = along }
  check.equal(void.class, "0")
  return void
end

-- Sweeps, and proves the cells and their volume.
local function sweep(void, options, volume, tolerance)
  local mesh = void:sweep(options)
  local quality = mesh:quality()
  check.that(quality.certified, "certified")
  if volume then check.near(quality.volume / volume, 1, tolerance) end
  return mesh, quality
end

-- --- exact volumes ---------------------------------------------------------------------------------------

local mitred = { { 0, 0, 0 }, { 0, 0, 3 }, { 4, 0, 3 }, { 7, 3, 3 }, { 7, 3, 8 } }
for _, shape in ipairs(cornered) do
  local mesh = sweep(open(shape, { vector = { 0.5, -0.25, 3 } }), { layers = 3, size = 0.7 },
    3 * shape.area, 1e-12)
  check.equal(mesh.layers, 3)
  sweep(open(shape, { vector = { 0, 0, 2 }, scale = 0.5 }), { layers = 3, size = 0.7 },
    2 * shape.area * 7 / 12, 1e-12)
  -- The mean of the sections is off the line where the shape's centroid is.
  if shape.x == 0 then sweep(open(shape, { path = mitred }), { size = 0.7 }, shape.area * (12 + 18 ^ 0.5),
    1e-12) end
  sweep(open(shape, { path = mitred, frame = "fixed" }, origin, { 0.8, 0, -0.6 }, Y), { size = 0.7 },
    shape.area * (7 * 0.6 + 8 * 0.8), 1e-12)
  for n = 3, 4 do
    local angle, r = 100 * pi / 180, 3 + shape.x
    sweep(open(shape, { axis = { origin, Z }, angle = 100 }, { 3, 0, 0 }, X, Z), { layers = n, size = 0.7 },
      shape.area * r * n * sin(angle / n), 1e-12)
  end
  mesh = sweep(open(shape, { axis = { origin, Z }, angle = -360 }, { 3, 0, 0 }, X, Z), { layers = 12,
    size = 0.7 },
    shape.area * (3 + shape.x) * 12 * sin(pi / 6), 1e-12)
  check.equal(#mesh.regions, 1)
end

-- --- a family --------------------------------------------------------------------------------------------

local random = check.random(38)
local kinds = {
  -- Each gives along, the place and directions of the source, and the volume.
  function(shape)
    local way = { random(-1, 1), random(-1, 1), random(1, 5) }
    return { vector = way, twist = random(-20, 20) * way[3] }, origin, X, Y, way[3] * shape.area, 0.08
  end,
  function(shape)
    local angle, r = random(20, 350), random(1.5, 5)
    return { axis = { origin, Z }, angle = angle }, { r, 0, 0 }, X, Z,
      shape.area * (r + shape.x) * angle * pi / 180, 0.08
  end,
  function(shape)
    local turns, r = random(0.5, 3), random(2, 4)
    return { helix = { origin, Z, random(2.5, 6), turns } }, { r, 0, 0 }, X, Z,
      shape.area * (r + shape.x) * turns * 2 * pi, 0.08
  end,
  function(shape) -- an S in space
    local height = random(8, 14)
    local wave = random(0.1, 0.35) * (height / 8) ^ 2 -- the path's radius is 1.5 and more
    local function path(t)
      return wave * (1 - cos(2 * pi * t)), wave / 2 * (1 - cos(4 * pi * t)), height * t
    end
    return { path = path }, origin, X, Y
  end,
  function(shape) -- a spiral that widens
    local r, turns, rise = random(2.5, 4), random(0.5, 2), random(0, 3)
    local function path(t)
      local a = 2 * pi * turns * t
      local own = r + 3 * turns * t
      return own * cos(a), own * sin(a), rise * t
    end
    return { path = path }, { r, 0, 0 }, X, Z
  end,
  function(shape) -- corners
    local points = { { 0, 0, 0 }, { 0, 0, random(2, 4) } }
    for k = 1, 3 do
      local last = points[#points]
      local a, b = random(-0.6, 0.6), random(-0.6, 0.6)
      points[#points + 1] = { last[1] + 4 * sin(a), last[2] + 4 * sin(b), last[3] + 4 * cos(a) }
    end
    return { path = points, scale = random(0.6, 1.2) }, origin, X, Y
  end,
}
local run = check.members_to_run(25)
for member = 1, 300 do
  local shape, kind = shapes[member % #shapes + 1], kinds[(member // #shapes) % #kinds + 1]
  local along, at, u, v, volume, tolerance = kind(shape)
  if run() then
    local _, quality = sweep(open(shape, along, at, u, v), { size = 0.6 }, volume, tolerance)
    check.that(quality.min_scaled_jacobian > 0.3, ("member %d: scaled Jacobian %g"):format(member,
      quality.min_scaled_jacobian))
  end
end

-- A helix of five turns.
local _, coil = sweep(open(regular(16), { helix = { origin, Z, 3, 5 } }, { 4, 0, 0 }, X, Z), { size = 0.6 },
  shapes[4].area / 0.75 * 4 * 10 * pi, 0.03)
check.that(coil.min_scaled_jacobian > 0.3)

-- Both hands of a helix advance by the pitch; a negative pitch goes back.
for _, case in ipairs { { 3, 0.25 }, { 3, -0.25 }, { -3, 0.25 }, { -3, -0.25 } } do
  local pitch, turns = table.unpack(case)
  local volume = open(regular(4), { helix = { origin, Z, pitch, turns } }, { 4, 0, 0 }, X, Z)
  local mesh = volume:sweep { size = 0.6 }
  local x, y, z = 0, 0, 0
  local row = mesh.nodes // (mesh.layers + 1)
  for i = mesh.nodes - row + 1, mesh.nodes do
    local px, py, pz = mesh:node(i)
    x, y, z = x + px / row, y + py / row, z + pz / row
  end
  check.near(x, 0, 1e-12)
  check.that(y * turns > 0)
  check.near(z, pitch / 4, 0.2) -- the mean of the section's nodes is near its centroid
end

-- --- normals and faces -----------------------------------------------------------------------------------

-- A quarter of a cylinder of radius 2 and height 1, and an offset of it.
local function shell(faces, keep)
  local made, points, cells = lacuna.model(), {}, {}
  for k = 0, faces do
    local a = pi / 2 * k / faces
    points[2 * k + 1], points[2 * k + 2] = { 2 * cos(a), 2 * sin(a), 0 }, { 2 * cos(a), 2 * sin(a), 1 }
    if k > 0 then cells[k] = { 2 * k - 1, 2 * k + 1, 2 * k + 2, 2 * k } end
  end
  made:add_face { name = "start", points = points, cells = cells, keep_mesh = keep }
  return made
end
local function thick(normals, keep)
  return shell(24, keep):open_volume { source = "start", along = { normals = normals } }
end
sweep(thick(0.5), { layers = 2, size = 0.2 }, pi / 4 * (2.5 ^ 2 - 4), 0.01)
sweep(thick { 0.25, 0.5 }, { layers = 2, size = 0.2 }, pi / 4 * (2.5 ^ 2 - 1.75 ^ 2), 0.01)
sweep(thick(function(x, y, z) return 0.5 + 0.2 * z end), { layers = 2, size = 0.2 },
  pi / 4 * ((2.6) ^ 2 - 4), 0.02)
local kept = sweep(thick(0.5, true), { layers = 2 }, pi / 4 * (2.5 ^ 2 - 4), 0.01)
check.equal(kept.hexes, 48)

local roof = lacuna.model()
roof:add_face { name = "roof", points = { { -3, -3, 2 }, { 3, -3, 2 }, { 3, 3, 5 }, { -3, 3, 5 } },
  cells = { { 1, 2, 3, 4 } } }
for _, shape in ipairs(cornered) do
  if shape.x == 0 then
    sweep(open(shape, { to = roof:face "roof" }), { layers = 2, size = 0.7 }, 3.5 * shape.area, 1e-12)
  end
end

-- Long facets of a source are split, so that its target follows a bent face between their corners.
for _, lean in ipairs { 0, 0.3 } do
  for _, shape in ipairs { regular(4), ell, ring(16, 0.5), regular(32) } do
    local roof, points, cells, n = lacuna.model(), {}, {}, 48
    local function height(x, y) return 1 + lean * x + 0.25 * cos(2 * x) * sin(1.5 * y + 1) end
    for j = 0, n do
      for i = 0, n do
        local x, y = 3 * i / n - 1.5, 3 * j / n - 1.5
        points[#points + 1] = { x, y, height(x, y) }
        if i < n and j < n then
          local a = j * (n + 1) + i + 1
          cells[#cells + 1] = { a, a + 1, a + n + 2 }
          cells[#cells + 1] = { a, a + n + 2, a + n + 1 }
        end
      end
    end
    roof:add_face { name = "roof", points = points, cells = cells }
    local mesh = sweep(open(shape, { to = roof:face "roof" }), { layers = 2, size = 0.1 })
    local worst = 0
    for i = 1, mesh.nodes do
      local x, y, z = mesh:node(i)
      if z > 0.75 * height(x, y) then worst = math.max(worst, math.abs(z - height(x, y))) end
    end
    check.that(worst < 0.02, ("%g off the face"):format(worst))
  end
end

-- --- given walls -----------------------------------------------------------------------------------------

-- A wall over the side y = -1 of a square, of `rows` by `columns` facets, bent outward by `bulge`; the path
-- is straight, or a turn about the x axis at y = -3.
local function walled(rows, columns, bulge, turn, height, keep)
  local made, points, cells = model({ points = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } },
    cells = { { 1, 2, 3, 4 } } }, origin, X, Y), {}, {}
  for j = 0, rows do
    local h, out = j / rows * height, 0
    for i = 0, columns do
      out = bulge * sin(pi * j / rows) * sin(pi * i / columns)
      local a = turn and -turn * h * pi / 180 or 0
      points[#points + 1] = turn and { 2 * i / columns - 1, (2 - out) * cos(a) - 3, -(2 - out) * sin(a) }
        or { 2 * i / columns - 1, -1 - out, 2 * h }
      if i > 0 and j > 0 then
        local n = #points
        cells[#cells + 1] = { n - columns - 2, n - columns - 1, n, n - 1 }
      end
    end
  end
  made:add_face { name = "side", points = points, cells = cells, keep_mesh = keep }
  return made:open_volume { source = "start", walls = "side",
    along = turn and { axis = { { 0, -3, 0 }, X }, angle = turn } or { vector = { 0, 0, 2 } } }
end
for _, rows in ipairs { 1, 3 } do
  for _, columns in ipairs { 1, 4 } do
    local mesh = sweep(walled(rows, columns, 0, nil, 1), { layers = 3, size = 0.5 }, 8, 1e-12)
    local found = {}
    for _, group in ipairs(mesh:groups()) do found[group.name] = group.cells end
    check.equal(found.side, 12)
    local void = 0 -- three walls and the target
    for name in pairs(found) do if name:find "^void:" then void = void + 1 end end
    check.equal(void, 4)
  end
end
-- Its shape and its mesh win: a bulge adds its volume, and quads stay node for node.
do
  local rows, columns, added = 6, 8, 0
  local void = walled(rows, columns, 0.3, nil, 1)
  local mesh = sweep(void, { layers = 6, size = 0.25 }, 8 + 0.3 * (4 / pi ^ 2) * 4, 0.01)
  check.that(mesh:quality().min_scaled_jacobian > 0.3)
  local kept = walled(4, 5, 0, nil, 1, true):sweep { size = 0.4 }
  check.near(kept:quality().volume, 8, 1e-12)
  check.equal(kept.layers, 4)
  local there = {}
  for n = 1, kept.nodes do there[("%.15g %.15g %.15g"):format(kept:node(n))] = true end
  for j = 0, 4 do
    for i = 0, 5 do
      check.that(there[("%.15g %.15g %.15g"):format(2 * i / 5 - 1, -1, 2 * j / 4)], "a node of the wall")
    end
  end
end
-- Along a turn: walls of facets as fine as the path's own, finer and coarser.
for _, rows in ipairs { 6, 18, 30 } do
  local mesh = sweep(walled(rows, 2, 0, 90, 1), { layers = 9, size = 0.5 }, 4 * 3 * pi / 2, 0.02)
  check.that(mesh:quality().min_scaled_jacobian > 0.8)
end
check.fails(function() walled(2, 2, 0, nil, 0.7):close() end, "closure.along_walls", "at")
check.fails(function() walled(6, 2, 0.2, 90, 0.7):close() end, "closure.along_walls", "at")

-- --- edges of the model and decks ------------------------------------------------------------------------

local guided = model(shapes[2], origin, X, Y)
guided:add_face { name = "guide", points = { origin, { 0, 0, 4 }, { 0, 3, 4 }, { 0, 3, 0 } },
  cells = { { 1, 2, 3, 4 } } }
local tags = {}
for _, edge in ipairs(guided:info().free_edges) do
  if edge.face == guided:face "guide".tag then tags[#tags + 1] = edge.tag end
end
-- In either order, from the end nearer to the source, and round the corner.
for _, path in ipairs { { tags[1], tags[2] }, { tags[2], tags[1] } } do
  sweep(guided:open_volume { source = "start", along = { path = path } }, { size = 0.5 }, 2 * 7, 1e-12)
end

-- A deck's quads are kept node for node, and its sets of edges are those of the walls; one ends on an edge.
local deck = os.tmpname() .. ".inp"
local lines = { "*NODE" }
for j = 0, 2 do
  for i = 0, 2 do lines[#lines + 1] = ("%d, %d, %d, 0"):format(3 * j + i + 1, i, j) end
end
lines[#lines + 1] = [[
*ELEMENT, TYPE=S4, ELSET=PLATE
1, 1, 2, 5, 4
2, 2, 3, 6, 5
3, 4, 5, 8, 7
4, 5, 6, 9, 8
*SURFACE, NAME=BOTTOM, TYPE=ELEMENT
1, S1
2, S1
*SURFACE, NAME=LEFT, TYPE=ELEMENT
1, S4
*ELEMENT, TYPE=B31, ELSET=RAIL
11, 7, 8
12, 8, 9
*ELEMENT, TYPE=T3D2
13, 6, 9
*ELSET, ELSET=STAY
13
*NSET, NSET=CORNERS
1, 3, 7, 9
*NSET, NSET=ALL, GENERATE
1, 9, 1
*NSET, NSET=MIDDLE
5
]]
check.write(deck, table.concat(lines, "\n"))
local plate = lacuna.load(deck)
local slab = sweep(plate:open_volume { source = 1, along = { axis = { { -3, 0, 0 }, Y }, angle = -360 } },
  { layers = 12 })
check.equal(slab.hexes, 48)
slab = sweep(plate:open_volume { source = 1, along = { vector = { 0, 0, 3 } } }, { layers = 3 }, 12, 1e-12)
check.equal(slab.nodes, 36)
local sets = {}
for _, group in ipairs(slab:groups()) do sets[group.name] = group.cells end
check.equal(sets.BOTTOM, 6)
check.equal(sets.LEFT, 3)
check.equal(sets.RAIL, 6, "beams")
check.equal(sets.STAY, 3, "a set of trusses")
-- Sets of nodes are those over them in all layers: of one mesh, a copy, a pattern, a split mesh, an assembly.
local function node_sets(path)
  local found, name = {}, nil
  local file <close> = assert(io.open(path))
  for line in file:lines() do
    if line:sub(1, 1) == "*" then
      name = line:match "^%*NSET, NSET=(.+)"
      if name then found[name] = found[name] or 0 end
    elseif name then
      for _ in line:gmatch "%d+" do found[name] = found[name] + 1 end
    end
  end
  return found
end
local function check_sets(mesh, copies)
  mesh:write(deck .. ".inp")
  local found = node_sets(deck .. ".inp")
  for set, nodes in pairs { CORNERS = 4, ALL = 9, MIDDLE = 1 } do
    check.equal(found[set], nodes * 4 * copies, set)
  end
  os.remove(deck .. ".inp")
end
check_sets(slab, 1)
check_sets(slab:copy { translate = { 0, 0, 9 } }, 1)
check_sets(slab:pattern { translate = { 0, 0, 9 }, count = 2 }, 2)
check_sets(lacuna.split_interface(slab, { faces = 2, element = "none" }), 5 / 4)
do
  local function part(from) return plate:open_volume { source = 1, name = from,
    along = { vector = { 0, 0, from == "up" and 3 or -3 } } } end
  check_sets(lacuna.assembly { part "up" }:sweep { layers = 3 }, 1)
  check_sets(lacuna.assembly { slab, part "down" }:sweep { layers = 3 }, 7 / 4)
  local turned = plate:open_volume { source = 1, along = { axis = { { -3, 0, 0 }, Y }, angle = 360 } }
    :sweep { layers = 12 }
  check_sets(turned, 3)
  local of_turn = {}
  for _, group in ipairs(turned:groups()) do of_turn[group.name] = group.cells end
  check.equal(of_turn.BOTTOM, 24, "sets of both halves of a full turn")
  check.equal(of_turn.LEFT, 12)
  check.equal(of_turn.RAIL, 24)
  local bent = plate:open_volume { source = 1, along = { vector = { 0, 0, 3 } } }
    :sweep { layers = 3, order = 2, serendipity = true }
  bent:write(deck .. ".inp")
  check.equal(node_sets(deck .. ".inp").CORNERS, 4 * 7, "middle nodes too")
  os.remove(deck .. ".inp")
  slab:write(deck .. ".exo")
  check.equal(lacuna.convert(deck .. ".exo", deck .. ".inp").nodes, slab.nodes)
  check.equal(node_sets(deck .. ".inp").MIDDLE, 4)
  os.remove(deck .. ".exo")
  os.remove(deck .. ".inp")
end
local kept_nodes = 0
for n = 1, slab.nodes do
  local x, y, z = slab:node(n)
  if z == 0 and x % 1 == 0 and y % 1 == 0 then kept_nodes = kept_nodes + 1 end
end
check.equal(kept_nodes, 9, "nodes of the deck, bit for bit")
os.remove(deck)

-- --- the rest of the language ----------------------------------------------------------------------------

local void = open(ell, { vector = { 0, 0, 2 } })
local closure = void:close()
check.equal(closure.void_faces, 7)
check.equal(closure.void_edges, 12)
check.that(closure.watertight)
check.that(void:describe():find "class:  0")
local mesh = void:sweep { size = 0.5, order = 2, boundary_layers = { walls = { "start" }, first = 0.05,
  count = 2 } }
check.that(mesh:quality().certified)
local names = {}
for _, group in ipairs(mesh:groups()) do names[group.name] = group.cells end
check.that(names.source and names.target and names["void:1"] and names.start, "groups")

-- Two elbows on one line share the face between them.
local first = open(shapes[4], { axis = { { 3, 0, 0 }, Y }, angle = 90, })
local second = open(shapes[4], { vector = { 0, 0, -3 } })
local both = lacuna.assembly { first, second }:sweep { size = 0.5 }
check.that(both:quality().certified)

-- Pieces of a cut.
check.equal(#open(ell, { axis = { { 4, 0, 0 }, Y }, angle = 180 }):cut { plane = { { 4, 0, 4 }, X } }, 2)

-- One exact solid, where there is CAD.
local has_cad, version = pcall(function() return lacuna.gmsh_version end)
if has_cad and version then
  local function solid(along, shape, volume, faces)
    local path, one = os.tmpname() .. ".step", open(shape, along, { 3, 0, 0 }, X, Z)
    one:close()
    local written = one:write_cad(path)
    os.remove(path)
    check.near(written.volume / volume, 1, 1e-9)
    check.equal(written.faces, faces)
  end
  solid({ vector = { 0.5, -2, 0.3 } }, shapes[5], 2 * shapes[5].area, 34)
  solid({ axis = { origin, Z }, angle = 100 }, ell, 3 * (3 - 1 / 6) * 100 * pi / 180, 8)
  solid({ axis = { origin, Z }, angle = 360 }, shapes[2], 2 * 3 * 2 * pi, 8)
end

-- The same bytes for any number of threads.
local bytes = {}
for _, threads in ipairs { 1, 4 } do
  local path = os.tmpname() .. ".msh"
  open(shapes[4], { helix = { origin, Z, 4, 1 }, twist = 30 }, { 3, 0, 0 }, X, Z):sweep { size = 0.5,
    threads = threads }:write(path)
  local file <close> = assert(io.open(path, "rb"))
  bytes[#bytes + 1] = file:read "a"
  os.remove(path)
end
check.that(bytes[1] == bytes[2], "bytes")

-- --- sources with an edge on the axis ---------------------------------------------------------------------

-- Half sections { radius, height }: a cylinder, a cone, a ball, a cup, and a spool with two edges there.
local half_disc = { { 0, -1 } }
for k = 1, 4 do half_disc[k + 1] = { sin(pi * k / 4), -cos(pi * k / 4) } end
local sections = {
  { { 0, 0 }, { 1, 0 }, { 1, 2 }, { 0, 2 } },
  { { 0, 0 }, { 1, 0 }, { 0, 2 } },
  half_disc,
  { { 0, 0 }, { 2, 0 }, { 2, 2 }, { 1, 2 }, { 1, 1 }, { 0, 1 } },
  { { 0, 0 }, { 2, 0 }, { 2, 3 }, { 0, 3 }, { 0, 2 }, { 1, 2 }, { 1, 1 }, { 0, 1 } },
}
--- A model of a section as a polygon cut into triangles, and its area times the radius of its centroid.
local function section(points)
  local left, cells, moment = {}, {}, 0
  for k = 1, #points do left[k] = k end
  local function turn(a, b, c)
    local p, q, r = points[a], points[b], points[c]
    return (q[1] - p[1]) * (r[2] - p[2]) - (q[2] - p[2]) * (r[1] - p[1])
  end
  local function is_ear(k)
    local a, b, c = left[(k - 2) % #left + 1], left[k], left[k % #left + 1]
    if turn(a, b, c) <= 1e-12 then return false end
    for _, other in ipairs(left) do
      if other ~= a and other ~= b and other ~= c and turn(a, b, other) >= 0 and turn(b, c, other) >= 0 and
        turn(c, a, other) >= 0 then
        return false
      end
    end
    return true, a, b, c
  end
  while #left > 2 do
    local found = false
    for k = 1, #left do
      local ear, a, b, c = is_ear(k)
      if ear then
        cells[#cells + 1] = { a, b, c }
        moment = moment + turn(a, b, c) / 2 * (points[a][1] + points[b][1] + points[c][1]) / 3
        table.remove(left, k)
        found = true
        break
      end
    end
    assert(found)
  end
  return { points = points, cells = cells }, moment
end
local function on_axis(points, angle)
  local shape, moment = section(points)
  return open(shape, { axis = { origin, Z }, angle = angle }, origin, X, Z), moment
end
for i, points in ipairs(sections) do
  for _, angle in ipairs { 50, -120, 300, 360 } do
    local void, moment = on_axis(points, angle)
    local turn = math.abs(angle) * pi / 180
    local n = math.ceil(turn * 4)
    local mesh, quality = sweep(void, { layers = n, size = 0.3, wedges = true },
      moment * n * sin(turn / n), 1e-12)
    check.that(mesh.wedges > 0 and mesh.wedges % n == 0, ("section %d: %d wedges"):format(i, mesh.wedges))
    check.that(mesh.hexes > 0 and quality.min_scaled_jacobian > 0.02,
      ("section %d: least %g"):format(i, quality.min_scaled_jacobian))
    check.near(mesh.fidelity.sealed_volume / (moment * turn), 1, 1e-12)
    check.equal(mesh.regions[#mesh.regions], "volume_axis")
    check.equal(mesh.layers.volume, n)
    local sets = {}
    for _, group in ipairs(mesh:groups()) do sets[group.name] = group.cells end
    check.equal(sets.source ~= nil and sets.target ~= nil, angle ~= 360)
    check.equal(sets.source, sets.target)
    check.equal(sets.volume, mesh.hexes + mesh.wedges)
    if angle == 300 then
      local file = os.tmpname() .. ".msh"
      mesh:write(file)
      local again = lacuna.check(file)
      check.that(again.certified, "certified")
      check.equal(again.wedges, mesh.wedges)
      os.remove(file)
    end
  end
end
do
  local void, moment = on_axis(sections[1], 90)
  local mesh = void:sweep { wedges = true } -- layers by default lose less than a percent
  check.near(mesh:quality().volume / (moment * pi / 2), 1, 0.01)
  check.that(void:sweep { size = 0.3, fallback = "wedges" }.wedges > 0, "no wedges")
  check.fails(function() void:sweep { size = 0.3 } end, "closure.along_axis", "wedges = true")
  check.fails(function() void:close() end, "closure.along_axis", "wedges = true")
  check.fails(function() lacuna.assembly { void }:sweep { wedges = true } end, "closure.along_axis")
  check.fails(function() void:sweep { wedges = true, layers = { 0.5, 1 } } end, "sweep.axis_layers", "number")
  check.fails(function() on_axis(sections[1], 360):sweep { wedges = true, layers = 3 } end,
    "sweep.axis_layers", "4")
  check.fails(function() void:sweep { wedges = true, order = 2 } end, "sweep.order")
  local both_sides = { { -1, 0 }, { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { -1, 1 } }
  check.fails(function() on_axis(both_sides, 90):sweep { wedges = true } end, "closure.along")
  check.fails(function()
    open(section(sections[1]), { helix = { origin, Z, 1, 1 } }, origin, X, Z)
  end, "closure.along_axis", "strip")
  local written = {}
  for k, threads in ipairs { 1, 4 } do
    local file = os.tmpname() .. ".msh"
    void:sweep { wedges = true, size = 0.2, threads = threads }:write(file)
    local opened <close> = assert(io.open(file, "rb"))
    written[k] = opened:read "a"
    os.remove(file)
  end
  check.that(written[1] == written[2], "other bytes with four threads")
end

-- --- refusals --------------------------------------------------------------------------------------------

-- `along` is refused with the code and the words.
local function refused(along, code, ...)
  local words = table.concat({ code or "", ... }, ", ")
  local fine, message = pcall(function() open(shapes[2], along, { 3, 0, 0 }, X, Z):close() end)
  check.that(not fine, "not refused: " .. words)
  if code then check.equal(message.code, code, tostring(message)) end
  for _, word in ipairs { ... } do
    check.that(tostring(message):find(word, 1, true), ("'%s' is not in: %s"):format(word,
      tostring(message)))
  end
end
refused({}, nil, "has no path")
refused({ vectr = X }, nil, "vector")
refused({ vector = Y, path = { origin, X } }, nil, "one of them")
refused({ axis = { origin, Z } }, nil, "angle")
refused({ vector = Y, angle = 3 }, nil, "angle")
refused({ vector = Y, frame = "fixed" }, nil, "frame")
refused({ path = {} }, nil, "path")
refused({ helix = { origin, Z } }, nil, "helix")
refused({ normals = "thick" }, nil, "normals")
refused({ vector = origin }, "closure.along_direction", "vector")
refused({ axis = { origin, Z }, angle = 400 }, "closure.along_angle", "400", "360")
refused({ axis = { { 4, 0, 0 }, Z }, angle = 90 }, "closure.along_axis", "vertex", "core")
refused({ axis = { { 3, 0, 0 }, Z }, angle = 90 }, "closure.along_axis")
refused({ axis = { { 2.9, 0, 0 }, Z }, angle = 90 }, "closure.along_folds")
refused({ axis = { origin, Z }, angle = 360, twist = 90 }, "closure.along_full_turn")
refused({ helix = { origin, Z, 1, 0 } }, "closure.along_turns")
refused({ path = { origin } }, "closure.along_path", "2")
refused({ path = function(t) return t, nil, 0 end }, "closure.along_path")
refused({ path = function(t) return 0, t, math.abs(t - 0.5) * 3 end }, "closure.along_path", "points")
refused({ path = { origin, Y, Y } }, "geometry.path_short", "0, 1, 0")
refused({ path = { origin, { 0, 4, 0 }, { 0, 2, 1 } } }, "geometry.path_corner", "90")
refused({ path = { 77 } }, "closure.along_edge", "77")
refused({ path = { 1, 3 } }, "closure.along_edge", "order")
refused({ vector = Y, twist = function(h) return "x" end }, "closure.along_profile", "twist")
refused({ vector = Y, scale = function(h) return 2 end }, "closure.along_profile", "1")
refused({ vector = Y, scale = -1 }, "closure.along_scale")
refused({ normals = function() return "x" end }, "closure.along_thickness")
refused({ normals = 1, twist = 3 }, "closure.along_distorted", "twist")
refused({ to = roof:face "roof" }, "closure.along_to", "nowhere")
refused({ vector = X }, "closure.along_folds")
refused({ path = { { 3, 0, 0 }, { 3, 3, 0 }, { 3, 3, 0.5 }, { 3, -3, 0.5 } } }, "closure.along_folds",
  "bend")
refused({ helix = { origin, Z, 0.5, 2 } }, "closure.along_crosses", "at")
refused({ path = { { 3, 0, 0 }, { 3, 9, 0 }, { 9, 9, 0 }, { 9, 4, 0 }, { -3, 4, 0 } } },
  "closure.along_crosses", "at")
check.fails(function() thick(-2.5):close() end, "fold", "thickness fits")
check.fails(function() open(ell, { vector = Z }):sweep { layers = { 0.5, 1 }, frobnicate = 1 } end,
  "frobnicate")
check.fails(function() open(ell, { path = mitred }):sweep { layers = 3, size = 1 } end, "layers", "4")
check.fails(function() open(ell, { vector = Z }):close { cap = "flat" } end, "cap", "along")
check.fails(function() open(ell, { vector = Z }):close { edge_shape = "smooth" } end, "edge_shape")
check.fails(function() open(ell, { vector = Z }):close { holes = "cover" } end, "holes")
check.fails(function() open(ell, { vector = Z }):close { void_edges = { { 1, 2 } } } end, "void_edges")
check.fails(function() model(ell, origin, X, Y):open_volume { along = { vector = Z } } end, "source alone")
check.fails(function() open(ell, { path = function() error "mine" end }) end, "mine")
local pair = model(ell, origin, X, Y)
pair:add_face { name = "far", points = { { 9, 0, 0 }, { 10, 0, 0 }, { 9, 1, 0 } }, cells = { { 1, 2, 3 } } }
check.fails(function() pair:open_volume { source = { "start", "far" }, along = { vector = Z } } end,
  "touch")
check.fails(function() pair:open_volume { source = "start", target = "far", along = { vector = Z } } end,
  "alone")
check.fails(function() pair:open_volume { source = "start", walls = "auto", along = { vector = Z } } end,
  "alone")
check.fails(function()
  pair:open_volume { source = "start", walls = "far", along = { vector = Z } }:close()
end, "closure.along_walls", "at (9, 0, 0)")
check.fails(function() pair:open_volume { source = "start", walls = "far",
  along = { axis = { { 0, 9, 0 }, X }, angle = 360 } } end, "closure.along_walls", "full turn")
local ball = lacuna.model()
ball:add_face { name = "ball", points = { origin, X, Y, Z }, cells = { { 1, 3, 2 }, { 1, 2, 4 }, { 1, 4,
  3 }, { 2, 3, 4 } } }
check.fails(function() ball:open_volume { source = { tags = { 1, 2, 3, 4 } },
  along = { vector = Z } } end, "closed")

-- Turns of which a layer spans a right angle stay valid at order 2.
for _, radius in ipairs { 1.3, 2, 4 } do
  local turn = open(regular(4), { axis = { { -radius, 0, 0 }, Y }, angle = 270 })
  local _, quality = sweep(turn, { layers = 3, size = 0.7, order = 2 })
  check.that(quality.min_scaled_jacobian > 0.5, ("radius %g: %g"):format(radius, quality.min_scaled_jacobian))
end
check.done()
