-- SPDX-License-Identifier: MIT
-- Meshes of order 2: options, files, decks of hex20 whose middle nodes are kept; CalculiX solves what was
-- joined.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }

local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end

-- --- a block of N³ cells of 20 nodes with a void --------------------------------------------------------
-- Nodes by their place on a grid of half cells; corners are moved a little where they are inside, and so are
-- middle nodes, so that the given sides bend.
local N = 4
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

local function outside(low, high)
  return function(i, j, k)
    local at = { i, j, k }
    for axis = 1, 3 do
      if at[axis] < low[axis] or at[axis] >= high[axis] then return true end
    end
    return false
  end
end
local function face(low, high, axis, at)
  local box = { {}, {} }
  for k = 1, 3 do box[1][k], box[2][k] = low[k] / N - 0.05, high[k] / N + 0.05 end
  box[1][axis], box[2][axis] = at / N - 0.05, at / N + 0.05
  return { box = box }
end
local function given(at) return at > 0 and at < N end
local function roles(void)
  local found = { walls = {} }
  if given(void.low[3]) then found.source = face(void.low, void.high, 3, void.low[3]) end
  if given(void.high[3]) then found.target = face(void.low, void.high, 3, void.high[3]) end
  for axis = 1, 2 do
    for _, at in ipairs { void.low[axis], void.high[axis] } do
      if given(at) then table.insert(found.walls, face(void.low, void.high, axis, at)) end
    end
  end
  return found
end

-- Nodes and cells of a deck by their numbers.
local function deck(text)
  local nodes, cells, into, open = {}, {}, nil, nil
  for line in text:gmatch("[^\n]+") do
    if line:sub(1, 1) == "*" then
      local word = line:match("^%*(%a+)")
      into = word == "NODE" and nodes or word == "ELEMENT" and cells or nil
    elseif into then
      local numbers = {}
      for word in line:gmatch("[^,%s]+") do numbers[#numbers + 1] = assert(tonumber(word)) end
      if open then
        table.move(numbers, 1, #numbers, #open + 1, open)
      else
        check.that(into[numbers[1]] == nil, "number " .. numbers[1] .. " twice")
        into[numbers[1]] = { table.unpack(numbers, 2) }
      end
      open = into == cells and line:find(",%s*$") and (open or into[numbers[1]]) or nil
    end
  end
  return nodes, cells
end
local function size(list)
  local count = 0
  for _ in pairs(list) do count = count + 1 end
  return count
end

local ccx = os.execute("command -v ccx >/dev/null 2>&1")
if not ccx then print("CalculiX (ccx) is not here: no deck is solved") end

local function affine(x, y, z)
  return 0.001 * x + 0.0004 * y - 0.0002 * z, -0.0003 * x + 0.002 * y + 0.0001 * z,
    0.0005 * x - 0.0002 * y - 0.001 * z
end
-- Hooke's stresses of the displacement.
local function stresses()
  local e = { xx = 0.001, yy = 0.002, zz = -0.001, xy = 0.00005, xz = 0.00015, yz = -0.00005 }
  local lambda, mu = 210000 * 0.3 / (1.3 * 0.4), 210000 / 2.6
  local trace = lambda * (e.xx + e.yy + e.zz)
  return { trace + 2 * mu * e.xx, trace + 2 * mu * e.yy, trace + 2 * mu * e.zz, 2 * mu * e.xy, 2 * mu * e.xz,
    2 * mu * e.yz }
end
local function solve(class, text, nodes)
  local name = "solve_" .. class
  local base = params.scratch .. "/" .. name
  local lines = { "*STATIC\n*BOUNDARY" }
  for tag, at in pairs(nodes) do
    local outer = false
    for axis = 1, 3 do outer = outer or at[axis] < 1e-9 or at[axis] > 1 - 1e-9 end
    for axis, u in ipairs(outer and { affine(table.unpack(at)) } or {}) do
      lines[#lines + 1] = ("%d, %d, %d, %.12e"):format(tag, axis, axis, u)
    end
  end
  check.write(base .. ".inp", (text:gsub("%*STATIC", table.concat(lines, "\n"))))
  check.that(os.execute(("cd '%s' && ccx %s > %s.log 2>&1"):format(params.scratch, name, name)))
  local expected, points = stresses(), 0
  for line in read(base .. ".dat"):gmatch("[^\n]+") do
    local numbers = {}
    for word in line:gmatch("%S+") do numbers[#numbers + 1] = tonumber(word) end
    if #numbers == 8 then
      points = points + 1
      for s = 1, 6 do check.near(numbers[s + 2], expected[s], 1e-6 * expected[2]) end
    end
  end
  return points
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
  if ccx then check.equal(solve(void.class, written, after), 27 * size(all_cells), void.class) end

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

-- The same bytes for any number of threads.
local bytes
for _, threads in ipairs { 1, 2, 3 } do
  local path = params.scratch .. "/threads.msh"
  sweep({ order = 2, threads = threads }):write(path)
  bytes = bytes or read(path)
  check.that(read(path) == bytes)
end
check.done()
