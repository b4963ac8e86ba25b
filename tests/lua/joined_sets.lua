-- SPDX-License-Identifier: MIT
-- Sets of a deck hold the nodes and cells that join it where they held all, or all of what is replaced; those
-- that cannot are named. Surfaces lie where they lay.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }
local ccx = os.execute("command -v ccx >/dev/null 2>&1")
if not ccx then print("CalculiX (ccx) is not here: no load is applied") end

local function path(name) return params.scratch .. "/" .. name end
local function read(name)
  local file <close> = assert(io.open(path(name), "rb"))
  return file:read("a")
end

-- Nodes, cells, sets and surfaces of a deck. Sets in sets and ranges are resolved.
local function parse(text)
  local deck = { nodes = {}, cells = {}, NSET = {}, ELSET = {}, SURFACE = {} }
  deck.list = { nodes = {}, cells = {} }
  local modes = { NODE = "nodes", ELEMENT = "cells", NSET = "set", ELSET = "set", SURFACE = "sides" }
  local mode, set, range, open
  local function of(kind, name)
    deck[kind][name:upper()] = deck[kind][name:upper()] or {}
    return deck[kind][name:upper()]
  end
  for line in text:gmatch "[^\n]+" do
    if line:sub(1, 1) == "*" then
      local word = line:match "^%*+([%a ]*)"
      mode, set, open = modes[word], nil, nil
      local kind, name = line:match "([NE]L?SET)=([^,%s]+)"
      if kind and mode then set = of(kind, name) end
      if mode == "sides" then set = of("SURFACE", line:match "NAME=([^,%s]+)") end
      range = line:find "GENERATE"
    elseif mode == "sides" then
      local cell, side = line:match "(%d+), *S(%d)"
      set[#set + 1] = { tonumber(cell), tonumber(side) }
    elseif mode then
      local words = {}
      for word in line:gmatch "[^,%s]+" do words[#words + 1] = tonumber(word) or word end
      if mode == "set" and range then
        for tag = words[1], words[2], words[3] or 1 do set[tag] = true end
      elseif mode == "set" then
        for _, word in ipairs(words) do
          if type(word) == "number" then set[word] = true else
            for tag in pairs(deck.NSET[word:upper()] or deck.ELSET[word:upper()]) do set[tag] = true end
          end
        end
      elseif open then
        table.move(words, 1, #words, #open + 1, open)
      else
        deck[mode][words[1]] = { table.unpack(words, 2) }
        table.insert(deck.list[mode], words[1])
        if set then set[words[1]] = true end
      end
      open = mode == "cells" and line:find ",%s*$" and (open or deck.cells[words[1]]) or nil
    end
  end
  return deck
end

local function count(set)
  local n = 0
  for _ in pairs(set) do n = n + 1 end
  return n
end
local function same(found, wanted, name)
  check.that(found, name .. " is not there")
  for tag in pairs(wanted) do check.that(found[tag], ("%s lacks %d"):format(name, tag)) end
  check.equal(count(found), count(wanted), name)
end

-- Area of a surface, and how low and high its nodes are.
local kSides = { { 1, 2, 3, 4 }, { 5, 6, 7, 8 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 4, 8, 7 },
  { 4, 1, 5, 8 } }
local function extent(deck, surface)
  local area, low, high = 0, math.huge, -math.huge
  for _, side in ipairs(surface) do
    local p = {}
    for k, c in ipairs(kSides[side[2]]) do p[k] = deck.nodes[deck.cells[side[1]][c]] end
    local a, b = {}, {}
    for k = 1, 3 do a[k], b[k] = p[3][k] - p[1][k], p[4][k] - p[2][k] end
    area = area + math.sqrt((a[2] * b[3] - a[3] * b[2]) ^ 2 + (a[3] * b[1] - a[1] * b[3]) ^ 2 +
      (a[1] * b[2] - a[2] * b[1]) ^ 2) / 2
    for k = 1, 4 do low, high = math.min(low, p[k][3]), math.max(high, p[k][3]) end
  end
  return area, low, high
end

-- A ring of steel round a core of foam, as one deck.
local function core_of(ring, sizes, order)
  return ring:open_volume({ walls = ring:face { near = { 4.8, 0, 2.5 } }, name = "foam" })
    :sweep { size = sizes, order = order, serendipity = order == 2 or nil }
end
for _, order in ipairs { 1, 2 } do
  lacuna.synthetic.annulus { inner = 4.8, outer = 7, height = 5 }
    :open_volume({ source = "source", target = "target", walls = "auto", name = "steel" })
    :sweep({ layers = 4, size = 1.2, order = order, serendipity = order == 2 or nil })
    :write(path("ring" .. order .. ".inp"))
  local ring = lacuna.load(path("ring" .. order .. ".inp"))
  core_of(ring, 1.2, order):write(path("plain" .. order .. ".inp"), { with = ring })
end

-- Sets that hold all, or all of the core, in the ways that decks have to say so.
local function numbers(list) return table.concat(list, ",\n") end
local function keys(set)
  local list = {}
  for tag in pairs(set) do list[#list + 1] = tag end
  table.sort(list)
  return list
end
local function corenodes(deck)
  local found = {}
  for cell in pairs(deck.ELSET.FOAM) do
    for _, node in ipairs(deck.cells[cell]) do found[node] = true end
  end
  return found
end
local function last(list) return math.max(table.unpack(list)) end
local ways = {
  list = function(text, deck)
    return text .. "*NSET, NSET=NALL\n" .. numbers(deck.list.nodes) ..
      "\n*ELSET, ELSET=EALL\n" .. numbers(deck.list.cells) ..
      "\n*ELSET, ELSET=CORE\n" .. numbers(keys(deck.ELSET.FOAM)) ..
      "\n*NSET, NSET=CORE\n" .. numbers(keys(corenodes(deck))) .. "\n"
  end,
  generate = function(text, deck)
    return text .. ("*NSET, NSET=NALL, GENERATE\n1, %d, 1\n*ELSET, ELSET=EALL, GENERATE\n1, %d\n"):format(
      last(deck.list.nodes) + 3, last(deck.list.cells) + 40) ..
      ("*ELSET, ELSET=CORE, GENERATE\n%d, %d\n"):format(keys(deck.ELSET.FOAM)[1], last(deck.list.cells)) ..
      "*NSET, NSET=CORE\n" .. numbers(keys(corenodes(deck))) .. "\n"
  end,
  nested = function(text, deck)
    text = text:gsub("%*NODE\n", "*NODE, NSET=NALL\n", 1)
    return text .. "*ELSET, ELSET=EALL\nsteel, foam\n*ELSET, ELSET=CORE\nfoam\n*NSET, NSET=CORE\n" ..
      numbers(keys(corenodes(deck))) .. "\n"
  end,
}
for way, add in pairs(ways) do
  for _, order in ipairs { 1, 2 } do
    local name = way .. order
    local text = read("plain" .. order .. ".inp")
    local before = parse(text)
    text = add(text, before)
    -- Surfaces and sets of nodes of a person's own, on the core's ends, and sets that lose some.
    local ends = {}
    for surface, sides in pairs(before.SURFACE) do
      local _, low, high = extent(before, sides)
      local foam = before.ELSET.FOAM[sides[1][1]]
      if foam and high - low < 1e-9 then ends[low > 2 and "LID" or "FLOOR"] = surface end
    end
    for own, surface in pairs(ends) do
      local sides = text:match("NAME=" .. surface:lower() .. "\n([^*]+)")
      text = text .. ("*SURFACE, NAME=%s\n%s*NSET, NSET=%s\n%s\n"):format(own, sides, own,
        numbers(keys(before.NSET[surface])))
    end
    local inner = keys(before.ELSET.FOAM)
    local lid = keys(before.NSET[ends.LID])
    text = text .. ("*ELSET, ELSET=SOME\n1, %d\n*ELSET, ELSET=RIND\n1, 2\n*NSET, NSET=POINT\n%d\n")
      :format(inner[1], lid[#lid])
    text = text .. "*MATERIAL, NAME=m\n*ELASTIC\n1000., 0.3\n*SOLID SECTION, ELSET=EALL, MATERIAL=m\n" ..
      "*NSET, NSET=HELD\nFLOOR, source\n*BOUNDARY\nHELD, 1, 3\n*STEP\n*STATIC\n*DSLOAD\nLID, P, 2.\n" ..
      "*NODE PRINT, NSET=HELD, TOTALS=ONLY\nRF\n*END STEP\n"
    check.write(path(name .. ".inp"), text)
    local old = parse(text)
    for _, size in ipairs(order == 1 and { 0.7, 2 } or { 2 }) do
      check.write(path "replace.lua", ([[
        local lacuna = require "lacuna"
        local old = lacuna.load("%s.inp", { without = "foam" })
        old:open_volume({ walls = old:face { near = { 4.8, 0, 2.5 } }, name = "foam" })
          :sweep({ size = %g, order = %d, serendipity = %s }):write("new.inp", { with = old })]])
        :format(name, size, order, order == 2 and "true" or "nil"))
      local code, _, err = check.run(params.lacuna, params.scratch, { "replace.lua" })
      check.equal(code, 0, err)
      local new = parse(read "new.inp")
      local foam = {}
      for cell in pairs(new.cells) do foam[cell] = not before.ELSET.STEEL[cell] or nil end
      same(new.NSET.NALL, new.nodes, "NALL")
      same(new.ELSET.EALL, new.cells, "EALL")
      same(new.ELSET.CORE, foam, "CORE")
      same(new.ELSET.FOAM, foam, "FOAM")
      same(new.NSET.CORE, corenodes(new), "CORE")
      same(new.ELSET.STEEL, before.ELSET.STEEL, "STEEL")
      same(new.ELSET.RIND, old.ELSET.RIND, "RIND")
      for own, surface in pairs(ends) do
        local wanted, low, high = extent(old, old.SURFACE[own])
        for _, which in ipairs { own, surface } do
          local area, at, to = extent(new, new.SURFACE[which])
          check.near(area, wanted, 1e-6 * wanted)
          check.that(math.abs(at - low) < 1e-9 and math.abs(to - high) < 1e-9, which)
        end
        local nodes = {}
        for _, side in ipairs(new.SURFACE[own]) do
          for _, k in ipairs(kSides[side[2]]) do nodes[new.cells[side[1]][k]] = true end
        end
        for node in pairs(nodes) do check.that(new.NSET[own][node], own) end
        if order == 1 then same(new.NSET[own], nodes, own) end
      end
      for surface, sides in pairs(new.SURFACE) do -- no cell that is not there
        for _, side in ipairs(sides) do check.that(new.cells[side[1]], surface) end
      end
      for _, kind in ipairs { "NSET", "ELSET" } do
        for set, members in pairs(new[kind]) do
          for tag in pairs(members) do check.that(new[kind == "NSET" and "nodes" or "cells"][tag], set) end
        end
      end
      -- What is lost is said, and nothing else.
      local lost = err:match "note: [^\n]*lost members[^\n]*"
      check.that(lost and lost:find "SOME" and lost:find "POINT", err)
      for _, set in ipairs { "NALL", "EALL", "CORE", "FOAM", "LID", "FLOOR", "HELD", "RIND", "STEEL" } do
        check.that(not lost:upper():find("[ ,]" .. set .. "%f[^%w_]"), lost)
      end
      if ccx and way == "list" then
        check.that(os.execute(("cd '%s' && ccx new >new.log 2>&1"):format(params.scratch)))
        local z = read("new.dat"):match "total force.-\n%s+%S+%s+%S+%s+(%S+)"
        local area = extent(new, new.SURFACE.LID)
        -- Sides of order 2 bulge beyond their corners.
        check.near(math.abs(tonumber(z)), 2 * area, (order == 1 and 1e-3 or 0.02) * area)
      end
    end
  end
end

-- The same sets by way of other formats; and where nothing is left out and a void is filled.
for _, ending in ipairs { "unv", "exo" } do
  for _, way in ipairs { "list", "generate" } do
    local text = read "plain1.inp"
    check.write(path "old.inp", ways[way](text, parse(text)))
    check.equal(check.run(params.lacuna, params.scratch, { "convert", "old.inp", "old." .. ending }), 0)
    local old = lacuna.load(path("old." .. ending), { without = "foam" })
    core_of(old, 0.7):write(path("new." .. ending), { with = old })
    check.equal(check.run(params.lacuna, params.scratch, { "convert", "new." .. ending, "back.inp" }), 0)
    local new = parse(read "back.inp")
    same(new.NSET.NALL, new.nodes, ending .. " NALL")
    same(new.ELSET.EALL, new.cells, ending .. " EALL")
    local foam = {}
    for cell in pairs(new.cells) do foam[cell] = not new.ELSET.STEEL[cell] or nil end
    same(new.ELSET.CORE, foam, ending .. " CORE")
  end
end
for order, all in ipairs { "EALL", "All" } do
  local text = read("ring" .. order .. ".inp")
  text = text:gsub("%*NODE\n", "*NODE, NSET=Nodes\n", 1) ..
    ("*ELSET, ELSET=%s\nsteel\n*ELSET, ELSET=whole\nsteel\n"):format(all)
  check.write(path "open.inp", text)
  local open = lacuna.load(path "open.inp")
  core_of(open, 1.2, order):write(path "filled.inp", { with = open })
  local new, before = parse(read "filled.inp"), parse(text)
  same(new.NSET.NODES, new.nodes, "Nodes")
  same(new.ELSET[all:upper()], new.cells, all)
  same(new.ELSET.WHOLE, new.cells, "whole")
  same(new.ELSET.STEEL, before.cells, "steel") -- a body's own name
  same(new.NSET.SOURCE, before.NSET.SOURCE, "source")
end

-- Nastran: SET1 cards are kept as they stand, and those that name what is left out are said.
do
  local ring = lacuna.load(path "ring1.inp")
  local mesh = core_of(ring, 1.2)
  mesh:write(path "old.bdf", { with = ring })
  check.write(path "old.bdf", (read("old.bdf"):gsub("ENDDATA", "SET1,77,1,THRU,9999\nENDDATA")))
  check.write(path "replace.lua", [[
    local lacuna = require "lacuna"
    local old = lacuna.load("old.bdf", { without = 2 })
    old:open_volume({ walls = old:face { near = { 4.8, 0, 2.5 } } })
      :sweep({ size = 1 }):write("new.bdf", { with = old })]])
  local code, _, err = check.run(params.lacuna, params.scratch, { "replace.lua" })
  check.equal(code, 0, err)
  check.that(err:find("note: [^\n]*SET1"), err)
end
check.done()
