-- SPDX-License-Identifier: MIT
-- MED: what mdump and medconforme of libmed-tools say of files, round trips, other programs' order of nodes.
-- usage: lacuna med.lua scratch=FOLDER mdump=PROGRAM medconforme=PROGRAM
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { scratch = ".", mdump = "", medconforme = "" }
local function at(name) return params.scratch .. "/" .. name end
local function said(command)
  local pipe <close> = assert(io.popen(command .. " 2>&1"))
  return pipe:read "a"
end

local function prism(given, options)
  return lacuna.synthetic.prism(given):open_volume { name = "foam" }:sweep(options)
end
local family = {
  { prism({ sides = 6, twist = 20 }, { layers = 3, size = 0.5 }), "MED_HEXA8", "MED_QUAD4" },
  { prism({ sides = 8, holes = 2 }, { layers = 2, size = 0.4 }), "MED_HEXA8", "MED_QUAD4" },
  { prism({ sides = 4 }, { layers = 2, size = 0.7, order = 2, serendipity = true }), "MED_HEXA20",
    "MED_QUAD8" },
  { prism({ sides = 4 }, { layers = 2, size = 0.7, order = 2 }), "MED_HEXA27", "MED_QUAD9" },
}
for i, member in ipairs(family) do
  local mesh, solid, face = table.unpack(member)
  local path = at(i .. ".med")
  mesh:write(path)
  if params.medconforme ~= "" then
    local text = said(("'%s' '%s'"):format(params.medconforme, path))
    check.that(select(2, text:gsub("conforme a", "")) >= 2, text)
  end
  if params.mdump ~= "" then
    local text = said(("'%s' '%s' NODALE FULL_INTERLACE 1"):format(params.mdump, path))
    check.that(text:find(solid, 1, true) and text:find(face, 1, true), solid .. " in mdump: " .. text)
    for _, group in ipairs { "source", "target", "foam" } do
      check.that(text:find(group, 1, true), group .. " in mdump")
    end
  end
  -- Back: the same nodes, cells, groups; the same file again.
  local quality = lacuna.check(path)
  check.equal(quality.hexes, mesh.hexes)
  check.near(quality.min_scaled_jacobian, mesh:quality().min_scaled_jacobian, 1e-6)
  check.near(quality.volume, mesh:quality().volume, 1e-9)
  lacuna.convert(path, at "2.msh")
  local model = lacuna.load(path)
  for _, name in ipairs { "source", "target" } do
    check.that(#model:faces { name = name } >= 1, name)
  end
  lacuna.convert(path, at "back.med")
  lacuna.convert(at "back.med", at "again.med")
  local function read(name)
    local file <close> = assert(io.open(at(name), "rb"))
    return file:read "a"
  end
  lacuna.convert(at "again.med", at "a.exo")
  lacuna.convert(path, at "b.exo")
  check.that(read "a.exo" == read "b.exo", "numbers and sets")
end

-- Numbers and sets of a deck by MED and back.
prism({ sides = 6 }, { layers = 2, size = 0.5 }):write(at "deck.inp", { first_node = 501, first_cell = 901 })
lacuna.convert(at "deck.inp", at "deck.med")
lacuna.convert(at "deck.med", at "deck_2.inp")
local function sets(path)
  local found, key = {}, nil
  for line in io.lines(path) do
    if line:sub(1, 1) == "*" then
      key = line:match "^%*NSET, NSET=(.*)" or line:match "^%*ELSET, ELSET=(.*)" or line:match "^%*NODE$" or
        line:match "^%*ELEMENT, TYPE=%w+"
      if key then found[key] = found[key] or {} end
    elseif key then
      for number in line:gmatch(key == "*NODE" and "^%d+" or "%d+") do
        table.insert(found[key], tonumber(number))
      end
    end
  end
  for name, list in pairs(found) do
    table.sort(list)
    found[name] = table.concat(list, " ")
  end
  return found
end
local before, after = sets(at "deck.inp"), sets(at "deck_2.inp")
for _, key in ipairs { "*NODE", "*ELEMENT, TYPE=C3D8", "source", "target" } do
  check.equal(after[key], before[key], key)
end

-- Nodes of periodic faces are groups of nodes.
do
  local faces = { { "wall_1", "wall_3" }, { "source", "target" } }
  local mesh = prism({ sides = 4 }, { layers = 2, size = 0.5, periodic = faces })
  mesh:write(at "periodic.med")
  lacuna.convert(at "periodic.med", at "periodic.inp")
  mesh:write(at "own.inp")
  local function members(name, set)
    local file <close> = assert(io.open(at(name)))
    local text, list = file:read "a", {}
    local rows = text:match("%*NSET, NSET=" .. set .. "\n([^*]*)")
    for n in rows:gmatch "%d+" do list[#list + 1] = tonumber(n) end
    table.sort(list)
    return table.concat(list, " ")
  end
  for p = 1, #faces do
    for _, side in ipairs { "_a", "_b" } do
      local set = "periodic_" .. p .. side
      check.equal(members("periodic.inp", set), members("own.inp", set))
    end
  end
end

-- Units: declared for the axes, and read.
lacuna.load(at "deck.inp", { unit = "cm" }):open_volume { along = { vector = { 0, 0, 1 } },
  source = lacuna.load(at "deck.inp", { unit = "cm" }):face { name = "target" }.tag }
  :sweep { layers = 1 }:write(at "unit.med")
check.fails(function() lacuna.load(at "unit.med", { unit = "mm" }) end, "is in cm")

-- Damaged and cut off: an error of ours, whatever the library does.
local file <close> = assert(io.open(at "1.med", "rb"))
local bytes = file:read "a"
local random = check.random(7)
for i = 1, check.whole and 500 or 25 do
  local from = math.floor(random(1, #bytes))
  check.write(at "damaged.med", i % 2 == 0 and bytes:sub(1, from) or
    bytes:sub(1, from) .. string.char(math.floor(random(0, 255))) .. bytes:sub(from + 2))
  local fine, why = pcall(lacuna.check, at "damaged.med")
  check.that(fine or tostring(why.code):match "^io%." or why.code == "lua.no_hexahedra", tostring(why))
end
check.fails(function()
  check.write(at "text.med", "no MED file\n")
  lacuna.load(at "text.med")
end, "expected a MED file")
check.done()
