-- SPDX-License-Identifier: MIT
-- CalculiX's patch test across the interfaces of assemblies: an affine displacement of the skin of what three
-- recipes make is the same stress in every cell, in every region.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "", recipes = "" }

if not os.execute("command -v ccx >/dev/null 2>&1") then
  print("CalculiX (ccx) is not here: nothing is solved")
  check.done()
  return
end

local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end

-- Nodes, cells and names of regions of a deck.
local function deck(text)
  local nodes, cells, regions, into = {}, {}, {}, nil
  for line in text:gmatch("[^\n]+") do
    if line:sub(1, 1) == "*" then
      into = line:match("^%*NODE%f[%W]") and nodes or line:match("^%*ELEMENT") and cells or nil
      if into == cells then regions[#regions + 1] = line:match("ELSET=([%w_]+)") end
    elseif into then
      local numbers = {}
      for word in line:gmatch("[^,%s]+") do numbers[#numbers + 1] = assert(tonumber(word)) end
      into[numbers[1]] = { table.unpack(numbers, 2) }
    end
  end
  return nodes, cells, regions
end

-- Nodes of sides that one cell alone has.
local function skin(cells)
  local sides = { { 1, 2, 3, 4 }, { 5, 6, 7, 8 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 4, 8, 7 },
    { 4, 1, 5, 8 } }
  local uses, of = {}, {}
  for _, corners in pairs(cells) do
    for _, side in ipairs(sides) do
      local own = {}
      for k, c in ipairs(side) do own[k] = corners[c] end
      table.sort(own)
      local key = table.concat(own, " ")
      uses[key], of[key] = (uses[key] or 0) + 1, own
    end
  end
  local nodes, inner = {}, 0
  for key, count in pairs(uses) do
    check.that(count <= 2, "a side of three cells")
    if count == 2 then inner = inner + 1 end
    for _, n in ipairs(count == 1 and of[key] or {}) do nodes[n] = true end
  end
  return nodes, inner
end

local E, NU = 210000, 0.3
local gradient = { { 0.001, 0.0004, -0.0002 }, { -0.0003, 0.002, 0.0001 }, { 0.0005, -0.0002, -0.001 } }
local function stresses()
  local lambda, mu = E * NU / ((1 + NU) * (1 - 2 * NU)), E / (2 * (1 + NU))
  local trace = gradient[1][1] + gradient[2][2] + gradient[3][3]
  local found = {}
  for k = 1, 3 do found[k] = lambda * trace + 2 * mu * gradient[k][k] end
  for _, pair in ipairs { { 1, 2 }, { 1, 3 }, { 2, 3 } } do
    local i, j = table.unpack(pair)
    found[#found + 1] = mu * (gradient[i][j] + gradient[j][i])
  end
  return found
end

for name, options in pairs { packed_box = { "layers=7", "size=14" }, resin = { "layers=4", "size=0.4" },
  gasket = { "layers=2", "size=1" } } do
  local base = params.scratch .. "/" .. name
  local words = { params.recipes .. "/" .. name .. ".lua", "output=" .. base .. ".inp" }
  table.move(options, 1, #options, #words + 1, words)
  local code, _, err = check.run(params.lacuna, params.scratch, words)
  check.equal(code, 0, err)
  local text = read(base .. ".inp")
  local nodes, cells, regions = deck(text)
  check.that(#regions >= 3, name)
  local lines = { text, "*MATERIAL, NAME=test", "*ELASTIC", E .. ", " .. NU }
  for _, region in ipairs(regions) do
    lines[#lines + 1] = ("*SOLID SECTION, ELSET=%s, MATERIAL=test"):format(region)
  end
  lines[#lines + 1] = "*STEP\n*STATIC\n*BOUNDARY"
  local outer, count = skin(cells), 0
  for tag in pairs(outer) do
    for axis = 1, 3 do
      local u = 0
      for k = 1, 3 do u = u + gradient[axis][k] * nodes[tag][k] end
      lines[#lines + 1] = ("%d, %d, %d, %.12e"):format(tag, axis, axis, u)
    end
  end
  for _ in pairs(cells) do count = count + 1 end
  for _, region in ipairs(regions) do lines[#lines + 1] = "*EL PRINT, ELSET=" .. region .. "\nS" end
  lines[#lines + 1] = "*END STEP\n"
  check.write(base .. "_solved.inp", table.concat(lines, "\n"))
  check.that(os.execute(("cd '%s' && ccx %s_solved > %s.log 2>&1"):format(params.scratch, name, name)), name)
  local expected, points = stresses(), 0
  for line in read(base .. "_solved.dat"):gmatch("[^\n]+") do
    local numbers = {}
    for word in line:gmatch("%S+") do numbers[#numbers + 1] = tonumber(word) end
    if #numbers == 8 then
      points = points + 1
      for s = 1, 6 do check.near(numbers[s + 2], expected[s], 1e-6 * expected[2]) end
    end
  end
  check.equal(points, 8 * count, name)
  print(("%s: %d cells in %d regions, the same stress at %d points"):format(name, count, #regions, points))
end
check.done()
