-- SPDX-License-Identifier: MIT
-- CalculiX's patch test across the interfaces of assemblies: an affine displacement of the skin of what three
-- recipes make is the same stress in every cell, in every region.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "", recipes = "" }

local block = dofile(arg[0]:match("^(.*/)") .. "unit_block.lua")(check, params.scratch, 1)

if not block.ccx then
  check.done()
  return
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
  local nodes = {}
  for key, count in pairs(uses) do
    check.that(count <= 2, "a side of three cells")
    for _, n in ipairs(count == 1 and of[key] or {}) do nodes[n] = true end
  end
  return nodes
end

for name, options in pairs { packed_box = { "layers=7", "size=14" }, resin = { "layers=4", "size=0.4" },
  gasket = { "layers=2", "size=1" } } do
  local base = params.scratch .. "/" .. name
  local words = { params.recipes .. "/" .. name .. ".lua", "output=" .. base .. ".inp" }
  table.move(options, 1, #options, #words + 1, words)
  local code, _, err = check.run(params.lacuna, params.scratch, words)
  check.equal(code, 0, err)
  local text = block.read(base .. ".inp")
  local nodes, cells, regions = block.deck(text)
  if name == "packed_box" then regions = { "foam" } end -- pieces of one void are one set, which has a card
  check.that(#regions >= (name == "packed_box" and 1 or 3), name)
  local lines = { text, "*MATERIAL, NAME=test", "*ELASTIC", "210000, 0.3" }
  for _, region in ipairs(regions) do
    lines[#lines + 1] = ("*SOLID SECTION, ELSET=%s, MATERIAL=test"):format(region)
  end
  lines[#lines + 1] = "*STEP\n*STATIC"
  for _, region in ipairs(regions) do lines[#lines + 1] = "*EL PRINT, ELSET=" .. region .. "\nS" end
  lines[#lines + 1] = "*END STEP\n"
  local outer, count = skin(cells), block.size(cells)
  local points = block.solve(name, table.concat(lines, "\n"), nodes, function(tag) return outer[tag] end)
  check.equal(points, 8 * count, name)
  print(("%s: %d cells in %d regions, the same stress at %d points"):format(name, count, #regions, points))
end
check.done()
