-- SPDX-License-Identifier: MIT
-- CalculiX's patch test across the interfaces of assemblies: an affine displacement of the skin of what three
-- recipes make, and of hexahedra below pyramids and tetrahedra, is the same stress in every cell, in every
-- region.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "", recipes = "" }

local block = dofile(arg[0]:match("^(.*/)") .. "unit_block.lua")(check, params.scratch, 1)

if not block.ccx then
  check.done()
  return
end

-- Corners of the sides of cells, by their number of nodes. A pyramid is a brick with a repeated node.
local kSides = {
  [4] = { { 1, 2, 3 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 1, 4 } },
  [8] = { { 1, 2, 3, 4 }, { 5, 6, 7, 8 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 4, 8, 7 }, { 4, 1, 5, 8 } },
}

-- Nodes of sides that one cell alone has.
local function skin(cells)
  local uses, of = {}, {}
  for _, corners in pairs(cells) do
    for _, side in ipairs(kSides[#corners]) do
      local own, has = {}, {}
      for _, c in ipairs(side) do
        local node = corners[c]
        if not has[node] then own[#own + 1] = node end
        has[node] = true
      end
      table.sort(own)
      local key = table.concat(own, " ")
      if #own > 2 then uses[key], of[key] = (uses[key] or 0) + 1, own end
    end
  end
  local nodes = {}
  for key, count in pairs(uses) do
    check.that(count <= 2, "a side of three cells")
    for _, n in ipairs(count == 1 and of[key] or {}) do nodes[n] = true end
  end
  return nodes
end

-- Solve a deck of order 1. @return  the number of its cells, and of places of one stress
local function solve(name, text, regions)
  local nodes, cells = block.deck(text)
  local lines = { text, "*MATERIAL, NAME=test", "*ELASTIC", "210000, 0.3" }
  for _, region in ipairs(regions) do
    lines[#lines + 1] = ("*SOLID SECTION, ELSET=%s, MATERIAL=test"):format(region)
  end
  lines[#lines + 1] = "*STEP\n*STATIC"
  for _, region in ipairs(regions) do lines[#lines + 1] = "*EL PRINT, ELSET=" .. region .. "\nS" end
  lines[#lines + 1] = "*END STEP\n"
  local outer, expected = skin(cells), 0
  for _, corners in pairs(cells) do expected = expected + (#corners == 4 and 1 or 8) end
  local points = block.solve(name, table.concat(lines, "\n"), nodes, function(tag) return outer[tag] end)
  check.equal(points, expected, name)
  print(("%s: %d cells in %d regions, the same stress at %d points"):format(name, block.size(cells), #regions,
    points))
end

for name, options in pairs { packed_box = { "layers=7", "size=14" }, resin = { "layers=4", "size=0.4" },
  gasket = { "layers=2", "size=1" } } do
  local base = params.scratch .. "/" .. name
  local words = { params.recipes .. "/" .. name .. ".lua", "output=" .. base .. ".inp" }
  table.move(options, 1, #options, #words + 1, words)
  local code, _, err = check.run(params.lacuna, params.scratch, words)
  check.equal(code, 0, err)
  local text = block.read(base .. ".inp")
  local _, _, regions = block.deck(text)
  if name == "packed_box" then regions = { "foam" } end -- pieces of one void are one set, which has a card
  check.that(#regions >= (name == "packed_box" and 1 or 3), name)
  solve(name, text, regions)
end

-- A prism of five sides below a pointed roof with a hole inside, which cannot be swept. The prism's quads are
-- paved and its top slants.
do
  local rim = { { 0, 0 }, { 1.3, 0.1 }, { 1.6, 0.9 }, { 0.7, 1.4 }, { -0.2, 0.8 } }
  local function face(model, points)
    local cells = {}
    for k = 2, #points - 1 do cells[k - 1] = { 1, k, k + 1 } end
    model:add_face { points = points, cells = cells }
  end
  local base, roof, floor, top, tip = lacuna.model(), lacuna.model(), {}, {}, { 0.8, 0.5, 1.9 }
  for k, p in ipairs(rim) do
    floor[#rim + 1 - k], top[k] = { p[1], p[2], 0 }, { p[1], p[2], 1 + 0.1 * p[1] }
  end
  local lid = {}
  for k = 1, #rim do lid[k] = top[#rim + 1 - k] end
  face(base, floor)
  face(base, top)
  face(roof, lid)
  for k = 1, #rim do
    local next = k % #rim + 1
    face(base, { floor[#rim + 1 - k], floor[#rim + 1 - next], top[next], top[k] })
    face(roof, { top[k], top[next], tip })
  end
  local hole = { { 0.7, 0.5, 1.3 }, { 0.8, 0.5, 1.3 }, { 0.7, 0.6, 1.3 }, { 0.7, 0.5, 1.4 } }
  for _, side in ipairs { { 1, 2, 3 }, { 1, 4, 2 }, { 2, 4, 3 }, { 3, 4, 1 } } do
    face(roof, { hole[side[1]], hole[side[2]], hole[side[3]] })
  end
  local both = lacuna.assembly { base:open_volume { name = "base" }, roof:open_volume { name = "roof" } }
  local mesh = both:sweep { size = 0.25, fallback = "mixed" }
  check.that(mesh.hexes > 0 and mesh.pyramids > 0 and mesh.tets > 0, "not all kinds of cells")
  local path = params.scratch .. "/roof.inp"
  mesh:write(path)
  solve("roof", block.read(path), { "base", "roof" })
end
check.done()
