-- SPDX-License-Identifier: MIT
-- Meshes of order 2: options, files, decks of hex20 whose middle nodes are kept; CalculiX solves what was
-- joined.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }

-- --- a block of N³ cells of 20 nodes with a void --------------------------------------------------------
-- Nodes by their place on a grid of half cells; corners are moved a little where they are inside, and so are
-- middle nodes, so that the given sides bend.
local N = 4
local block = dofile(arg[0]:match("^(.*/)") .. "unit_block.lua")(check, params.scratch, N)
local outside, roles, deck, size, read = block.outside, block.roles, block.deck, block.size, block.read
local function node(a, b, c) return 10 + a + (2 * N + 1) * (b + (2 * N + 1) * c) end
local function inside(a) return a > 0 and a < 2 * N end
local function corner(i, j, k)
  local x, y, z = i, j, k
  if inside(2 * i) and inside(2 * j) and inside(2 * k) then
    x = x + 0.05 * math.sin(i + 2 * j + 3 * k)
    y = y + 0.05 * math.cos(3 * i - j + k)
    z = z + 0.04 * math.sin(i - j)
  end
  return { x / N, y / N, z / N }
end
local function place(a, b, c)
  local low = corner(a // 2, b // 2, c // 2)
  local high = corner((a + 1) // 2, (b + 1) // 2, (c + 1) // 2)
  local at = {}
  for axis = 1, 3 do at[axis] = (low[axis] + high[axis]) / 2 end
  if (a + b + c) % 2 == 1 and inside(a) and inside(b) and inside(c) then
    at[1] = at[1] + 0.006 * math.sin(a + 2 * b)
    at[2] = at[2] + 0.006 * math.cos(b + 3 * c)
    at[3] = at[3] + 0.006 * math.sin(c - a)
  end
  return at[1], at[2], at[3]
end
local corners = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 }, { 0, 0, 2 }, { 2, 0, 2 }, { 2, 2, 2 },
  { 0, 2, 2 } }
local middles = { { 1, 0, 0 }, { 2, 1, 0 }, { 1, 2, 0 }, { 0, 1, 0 }, { 1, 0, 2 }, { 2, 1, 2 }, { 1, 2, 2 },
  { 0, 1, 2 }, { 0, 0, 1 }, { 2, 0, 1 }, { 2, 2, 1 }, { 0, 2, 1 } }

local function inp(part, order)
  local lines = { "*HEADING", "a block with a void", "*NODE, NSET=all" }
  local function add(...) lines[#lines + 1] = string.format(...) end
  local used, cells, tags = {}, {}, {}
  local function take(cell, i, j, k, places)
    for _, d in ipairs(places) do
      local a, b, c = 2 * i + d[1], 2 * j + d[2], 2 * k + d[3]
      cell[#cell + 1] = node(a, b, c)
      used[cell[#cell]] = { a, b, c }
    end
  end
  for k = 0, N - 1 do
    for j = 0, N - 1 do
      for i = 0, N - 1 do
        if part(i, j, k) then
          local cell = {}
          take(cell, i, j, k, corners)
          if order == 2 then take(cell, i, j, k, middles) end
          cells[#cells + 1] = cell
        end
      end
    end
  end
  for tag in pairs(used) do tags[#tags + 1] = tag end
  table.sort(tags)
  for _, tag in ipairs(tags) do add("%d, %.12g, %.12g, %.12g", tag, place(table.unpack(used[tag]))) end
  add("*ELEMENT, TYPE=%s, ELSET=part", order == 2 and "C3D20" or "C3D8")
  for c, cell in ipairs(cells) do
    add("%d, %s%s", 10000 + c, table.concat(cell, ", ", 1, math.min(#cell, 12)), #cell > 12 and "," or "")
    if #cell > 12 then add("%s", table.concat(cell, ", ", 13)) end
  end
  add("*MATERIAL, NAME=steel\n*ELASTIC\n210000., 0.3")
  add("*SOLID SECTION, ELSET=part, MATERIAL=steel\n*SOLID SECTION, ELSET=volume, MATERIAL=steel")
  add("*STEP\n*STATIC")
  add("*EL PRINT, ELSET=part\nS\n*EL PRINT, ELSET=volume\nS\n*END STEP")
  return table.concat(lines, "\n") .. "\n", #tags, #cells
end

local voids = {
  { class = "I", low = { 0, 0, 1 }, high = { N, N, 3 } },
  { class = "II", low = { 1, 1, 1 }, high = { N, N, 3 } },
  { class = "III", low = { 1, 0, 1 }, high = { 3, N, 3 } },
  { class = "IV", low = { 1, 1, 1 }, high = { 3, 3, N } },
  { class = "V", low = { 1, 1, 0 }, high = { 3, 3, N } },
  { class = "closed", low = { 1, 1, 1 }, high = { 3, 3, 3 } },
}
for _, void in ipairs(voids) do
  local path = params.scratch .. "/" .. void.class .. ".inp"
  local text, _, cells = inp(outside(void.low, void.high), 2)
  check.write(path, text)
  local model = lacuna.load(path)
  local volume = model:open_volume(roles(void))
  check.equal(volume.class, void.class)
  local layers = void.high[3] - void.low[3]
  local mesh = volume:sweep { layers = layers, size = 1 / N, order = 2, serendipity = true }
  check.equal(mesh.order, 2)
  check.that(mesh:quality().certified)
  local joined = params.scratch .. "/joined_" .. void.class .. ".inp"
  mesh:write(joined, { with = model })
  local written = read(joined)
  local before, old_cells = deck(text)
  local after, all_cells = deck(written)
  -- What was there is there; every place of the block, corner or middle, has one node.
  for tag, at in pairs(before) do
    for axis = 1, 3 do check.equal(after[tag][axis], at[axis]) end
  end
  for tag, cell in pairs(old_cells) do
    check.equal(table.concat(all_cells[tag], " "), table.concat(cell, " "))
  end
  check.equal(size(all_cells), cells + mesh.hexes)
  local places = {}
  for tag, at in pairs(after) do
    local key = ("%.7f %.7f %.7f"):format(table.unpack(at))
    check.that(not places[key], "two nodes at " .. key)
    places[key] = tag
  end
  -- The void is filled by the cells that were left out: as many nodes of each kind as the whole block has.
  check.equal(size(after), (N + 1) ^ 3 // 1 + 3 * N * (N + 1) ^ 2 // 1, void.class)
  check.equal(lacuna.check(joined).hexes, N * N * N)
  check.that(lacuna.check(joined).certified)
  if block.ccx then check.equal(block.solve(void.class, written, after), 27 * size(all_cells), void.class) end

  -- Of order 1 the mesh does not go with the deck, and the other way round.
  local out = params.scratch .. "/refused.inp"
  if void.class == "IV" then
    local flat = volume:sweep { layers = void.high[3] - void.low[3], size = 1 / N }
    check.fails(function() flat:write(out, { with = model }) end, "middle node", "order = 2")
    check.fails(function() mesh:write(out, { element = "C3D8" }) end, "C3D20", "order 2")
    mesh:write(params.scratch .. "/reduced.inp", { element = "C3D20R" })
    check.that(read(params.scratch .. "/reduced.inp"):find("TYPE=C3D20R", 1, true))
    check.write(path, (inp(outside(void.low, void.high), 1)))
    local old = lacuna.load(path)
    local second = old:open_volume(roles(void)):sweep { layers = void.high[3] - void.low[3], size = 1 / N,
      order = 2, serendipity = true }
    check.fails(function() second:write(out, { with = old }) end, "no middle node", "order = 1")
    check.that(not check.exists(out))
  end
end

-- --- round shapes -----------------------------------------------------------------------------------------
local ring = lacuna.synthetic.annulus { inner = 0.5, outer = 1, height = 1 }:open_volume()
local function sweep(options)
  options.size, options.curvature, options.layers = 0.4, 8, 2
  return ring:sweep(options)
end
local flat = sweep {}
check.equal(flat.order, 1)
local meshes = { [20] = sweep { order = 2, serendipity = true }, [27] = sweep { order = 2 } }
for nodes, mesh in pairs(meshes) do
  check.equal(mesh.order, 2)
  check.equal(mesh.hexes, flat.hexes)
  check.that(mesh.report[#mesh.report - 2]:find("hex" .. nodes, 1, true))
  -- Bent sides leave less of the volume out than straight ones.
  local lost = function(m) return math.abs(1 - m.fidelity.volume / m.fidelity.sealed_volume) end
  check.that(lost(mesh) < lost(flat) / 2)
  check.near(mesh:quality().volume, mesh.fidelity.volume, 1e-12)
  check.that(mesh:node(mesh.nodes))
  local formats = nodes == 27 and { "msh", "vtu", "vtk" } or { "msh", "vtu", "vtk", "inp", "bdf", "unv" }
  for _, format in ipairs(formats) do
    local path = params.scratch .. "/ring" .. nodes .. "." .. format
    mesh:write(path)
    local found = lacuna.check(path)
    check.equal(found.hexes, mesh.hexes, format)
    check.near(found.volume, mesh.fidelity.volume, 1e-9, format)
    check.near(found.min_scaled_jacobian, mesh:quality().min_scaled_jacobian, 1e-9, format)
  end
  for i, options in ipairs { { version = 2.2 }, { version = 2.2, binary = false }, { binary = false } } do
    local path = params.scratch .. "/ring" .. nodes .. "_" .. i .. ".msh"
    mesh:write(path, options)
    check.near(lacuna.check(path).volume, mesh.fidelity.volume, 1e-9)
  end
end
check.fails(function() meshes[27]:write(params.scratch .. "/a.inp") end, "27 nodes", "serendipity")
check.fails(function() sweep { serendipity = true } end, "serendipity", "order = 2")
check.fails(function() sweep { order = 3 } end, "order", "1 or 2")

-- Nodes in the middle of given quads stay where they are: a ring of hex27 whose bore is filled, the middles
-- of the bore's quads moved a little.
do
  local path = params.scratch .. "/full_ring.msh"
  sweep({ order = 2 }):write(path, { binary = false, groups = "all" })
  local lines, at_node, centres, moved = {}, {}, {}, {}
  local part, block
  for line in io.lines(path) do
    lines[#lines + 1] = line
    if line:sub(1, 1) == "$" then part, block = line, nil end
    local numbers = {}
    for word in line:gmatch("%S+") do numbers[#numbers + 1] = tonumber(word) end
    if part == "$Elements" and #numbers == 4 and block ~= "size" then block = numbers[3] end
    if part == "$Elements" and #numbers == 10 and block == 10 then centres[#centres + 1] = numbers[10] end
    if part == "$Nodes" and #numbers == 3 then at_node[#at_node + 1] = #lines end
  end
  -- Nodes are written in the order of their numbers.
  for _, tag in ipairs(centres) do
    local x, y, z = lines[at_node[tag]]:match("(%S+) (%S+) (%S+)")
    local out = math.sqrt(x * x + y * y)
    if math.abs(out - 0.5) < 0.02 and z * 1 > 0.01 and z * 1 < 0.99 then
      local line = ("%.17g %.17g %.17g"):format(x * 1.01, y * 1.01, z + 0.004)
      lines[at_node[tag]] = line
      moved[#moved + 1] = line
    end
  end
  check.that(#moved > 8, "quads on the bore")
  check.write(path, table.concat(lines, "\n") .. "\n")
  local model = lacuna.load(path, { feature_angle = 60 })
  local bore = model:face "wall:4"
  local void = model:open_volume { walls = bore }
  local mesh = void:sweep { order = 2, size = 0.2 }
  check.that(mesh:quality().certified)
  local has = {}
  for n = 1, mesh.nodes do has[("%.17g %.17g %.17g"):format(mesh:node(n))] = true end
  for _, line in ipairs(moved) do check.that(has[line], line) end
  local whole = lacuna.check(path).hexes + mesh.hexes
  for _, ending in ipairs { "msh", "vtu", "vtk", "exo" } do
    local joined = params.scratch .. "/full_joined." .. ending
    mesh:write(joined, { with = model })
    check.equal(lacuna.check(joined).hexes, whole)
  end
  -- Every place has one node.
  local places = {}
  mesh:write(params.scratch .. "/full_text.msh", { with = model, binary = false })
  local nodes = read(params.scratch .. "/full_text.msh"):match("%$Nodes\n(.-)%$EndNodes")
  for x, y, z in nodes:gmatch("\n(%S+) (%S+) (%S+) ?%f[\n]") do
    local key = ("%.9f %.9f %.9f"):format(x, y, z)
    check.that(not places[key], "two nodes at " .. key)
    places[key] = true
  end
  check.that(size(places) > #centres)
  local without = void:sweep { order = 2, serendipity = true, size = 0.2 }
  local out = params.scratch .. "/refused.msh"
  check.fails(function() without:write(out, { with = model }) end, "centre node", "serendipity")
  check.that(not check.exists(out))
end

-- The same bytes for any number of threads.
local bytes
for _, threads in ipairs { 1, 2, 3 } do
  local path = params.scratch .. "/threads.msh"
  sweep({ order = 2, threads = threads }):write(path)
  bytes = bytes or read(path)
  check.that(read(path) == bytes)
end
check.done()
