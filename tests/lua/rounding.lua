-- SPDX-License-Identifier: MIT
-- Voids in blocks of a deck that were bent a little, or turned and written with few digits: the default
-- tolerance follows the sides of the cells and the digits, and what looks flat is flat.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }

local n, size = 6, 5 -- cells each way, and the side of a cell

local function turned(x, y, z)
  local function turn(a, b, angle)
    return math.cos(angle) * a - math.sin(angle) * b, math.sin(angle) * a + math.cos(angle) * b
  end
  x, y, z = x - n * size / 2, y - n * size / 2, z - n * size / 2
  x, y = turn(x, y, 0.3)
  y, z = turn(y, z, 0.17)
  return x, y, z
end
local function flat(x, y, z) return x, y, z end
-- Bends the cells by 0.02 % of their sides at most.
local function bent(x, y, z)
  local length = n * size
  local b = math.sin(math.pi * x / length) * math.sin(math.pi * y / length) * math.sin(math.pi * z / length)
  return x + 1e-3 * b, y - 1.3e-3 * b, z + 0.8e-3 * b
end

-- A deck of a block of cells without some of them, and how many these are.
local function deck(path, is_void, place, digits)
  local function node(i, j, k) return 1 + i + (n + 1) * (j + (n + 1) * k) end
  local cells, used, missing = {}, {}, 0
  for i = 0, n - 1 do
    for j = 0, n - 1 do
      for k = 0, n - 1 do
        if is_void(i, j, k) then
          missing = missing + 1
        else
          local c = { node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
            node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1) }
          cells[#cells + 1] = #cells + 1 .. ", " .. table.concat(c, ", ")
          for _, p in ipairs(c) do used[p] = true end
        end
      end
    end
  end
  local nodes, number = {}, "%." .. digits .. "g"
  local line = "%d, " .. number .. ", " .. number .. ", " .. number
  for k = 0, n do
    for j = 0, n do
      for i = 0, n do
        local p = node(i, j, k)
        if used[p] then nodes[#nodes + 1] = line:format(p, place(i * size, j * size, k * size)) end
      end
    end
  end
  check.write(path, "*NODE\n" .. table.concat(nodes, "\n") .. "\n*ELEMENT, TYPE=C3D8, ELSET=BLOCK\n" ..
    table.concat(cells, "\n") .. "\n")
  return missing
end

local function boxes(...)
  local all = { ... }
  return function(i, j, k)
    for _, b in ipairs(all) do
      if b[1] <= i and i < b[2] and b[3] <= j and j < b[4] and b[5] <= k and k < b[6] then return true end
    end
    return false
  end
end

local voids = {
  steps = boxes({ 1, 3, 1, 5, 4, 6 }, { 3, 5, 1, 5, 3, 6 }),
  low_pillar = function(i, j, k)
    local is_pillar = i >= 2 and i < 4 and j >= 2 and j < 4 and k < 4
    return k >= 2 and i > 0 and i < 5 and j > 0 and j < 5 and not is_pillar
  end,
  undercut = boxes({ 2, 4, 2, 4, 3, 6 }, { 1, 5, 1, 5, 1, 3 }),
  slot = boxes({ 0, 6, 2, 4, 4, 6 }, { 0, 6, 1, 5, 2, 4 }),
  corner = boxes({ 1, 6, 1, 3, 1, 3 }, { 1, 3, 1, 6, 1, 3 }, { 1, 3, 1, 3, 1, 6 }),
  crossing = boxes({ 0, 6, 2, 4, 1, 3 }, { 2, 4, 0, 6, 3, 5 }),
}
local names = {}
for name in pairs(voids) do names[#names + 1] = name end
table.sort(names)

-- Each void is filled with the cells that it lost, node for node, or the deck would refuse the mesh.
for _, name in ipairs(names) do
  for _, written in ipairs { { flat, 9 }, { bent, 12 }, { turned, 9 }, { turned, 6 }, { turned, 5 } } do
    local place, digits = table.unpack(written)
    local path = params.scratch .. "/" .. name .. ".inp"
    local missing = deck(path, voids[name], place, digits)
    local model = lacuna.load(path)
    local mesh = model:open_volume { faces = model:cavities()[1].faces }:sweep {}
    local at = name .. " with " .. digits .. " digits"
    check.equal(mesh.hexes, missing, at)
    check.near(mesh:quality().volume, missing * size ^ 3, 1e-4 * missing * size ^ 3)
    mesh:write(params.scratch .. "/joined.inp", { with = model })
    -- The tolerance: two units of the last digit, or a thousandth of a side.
    check.near(model.tolerance, math.max(2 * 10.0 ^ (2 - digits), 1e-3 * size), 2e-6 * size, at)
  end
end

-- A box hovers above the floor of a pocket. Where its outline runs along lines of the floor's mesh, cuts do
-- too; elsewhere they do not cross the mesh, of which every quad is kept.
for _, low in ipairs { 10, 12 } do
  local block, insert = params.scratch .. "/pocket.inp", params.scratch .. "/insert.stl"
  local removed = deck(block, boxes { 1, 5, 1, 5, 2, 6 }, flat, 9)
  local high, facets = low + 5, {}
  local function facet(...)
    local lines = {}
    for _, p in ipairs { ... } do lines[#lines + 1] = "vertex " .. table.concat(p, " ") end
    facets[#facets + 1] = "facet normal 0 0 0\nouter loop\n" .. table.concat(lines, "\n") ..
      "\nendloop\nendfacet\n"
  end
  local bottom = { { low, low, 15 }, { high, low, 15 }, { high, high, 15 }, { low, high, 15 } }
  for i, a in ipairs(bottom) do
    local b = bottom[i % 4 + 1]
    facet(a, b, { b[1], b[2], 30 })
    facet(a, { b[1], b[2], 30 }, { a[1], a[2], 30 })
  end
  facet(bottom[1], bottom[3], bottom[2])
  facet(bottom[1], bottom[4], bottom[3])
  check.write(insert, "solid insert\n" .. table.concat(facets) .. "endsolid insert\n")
  local model = lacuna.load { block, insert }
  local faces = {}
  for _, cavity in ipairs(model:cavities()) do
    if #cavity.faces > #faces then faces = cavity.faces end
  end
  local mesh = model:open_volume { faces = faces }:sweep { fallback = "mixed" }
  local expected = removed * size ^ 3 - 5 * 5 * 15
  check.near(mesh:quality().volume, expected, 1e-6 * expected)
  check.that(low == 12 or mesh.tets == 0)
  mesh:write(params.scratch .. "/out.inp")
  local floor = 0
  for line in io.lines(params.scratch .. "/out.inp") do
    local x, y, z = line:match "^%s*%d+,%s*(%S+),%s*(%S+),%s*(%S+)$"
    if z and tonumber(z) == 2 * size then
      floor = floor + 1
      check.that(tonumber(x) % size == 0 and tonumber(y) % size == 0, line)
    end
  end
  check.equal(floor, 25)
end

-- Numbers that are short because they are exact give no larger tolerance, nor do a few long ones among them.
do
  local path = params.scratch .. "/exact.inp"
  for _, scale in ipairs { 1, 0.001, 123 } do
    deck(path, voids.steps, function(x, y, z) return scale * x, scale * y, scale * z end, 9)
    local model = lacuna.load(path)
    check.near(model.tolerance, 1e-3 * scale * size, 1e-9 * scale)
  end
end

-- Parts that are closer than that share their nodes, with a note; with a smaller tolerance they do not.
do
  local path = params.scratch .. "/gap.inp"
  deck(path, function(i) return i == n - 1 end, function(x, y, z) return x, y, z end, 12)
  local file = io.open(path, "a")
  file:write "*NODE\n"
  for i, at in ipairs { { 25.003, 0 }, { 30, 0 }, { 30, 5 }, { 25.003, 5 } } do
    for k = 0, 1 do file:write(("%d, %.12g, %g, %g\n"):format(1000 + 4 * k + i, at[1], at[2], 5 * k)) end
  end
  file:write "*ELEMENT, TYPE=C3D8, ELSET=OTHER\n5000, 1001, 1002, 1003, 1004, 1005, 1006, 1007, 1008\n"
  file:close()
  local function is_noted(options)
    local recipe = ("require('lacuna').load(%q, %s)"):format(path, options)
    local _, _, notes = check.run(params.lacuna, params.scratch, { "-" }, recipe)
    return notes:find("points that are up to 0.003 apart are read as one", 1, true) ~= nil
  end
  check.that(is_noted "{}")
  check.that(not is_noted "{ tolerance = 1e-3 }")
end

-- The tolerance of a coarse file does not swallow the cells of a fine one.
do
  local fine, coarse = params.scratch .. "/fine.inp", params.scratch .. "/coarse_cells.inp"
  deck(fine, voids.steps, function(x, y, z) return x / 1000, y / 1000, z / 1000 end, 12)
  deck(coarse, voids.steps, function(x, y, z) return 1000 + 10 * x, 10 * y, 10 * z end, 12)
  for _, files in ipairs { { fine, coarse }, { coarse, fine } } do
    local model = lacuna.load(files)
    check.that(model.tolerance <= 1.001e-6 * model.diagonal, model.tolerance)
  end
end

-- Numbers with a unit as large as the cells merge no nodes: the tolerance is at most a hundredth of a side.
do
  local path = params.scratch .. "/coarse.inp"
  deck(path, voids.steps, function(x, y, z) return 2e5 / 3 + x, y / 7, z end, 5)
  local model = lacuna.load(path)
  check.that(model.tolerance <= 0.01 * size)
end

check.done()
