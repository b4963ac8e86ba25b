-- SPDX-License-Identifier: MIT
-- Meshes as decks, alone and joined to the deck they fill a void of; CalculiX solves what was joined.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }

local function count(text, pattern) return select(2, text:gsub(pattern, "")) end

-- A block of N³ cells, each moved a little where it is inside; `part(i, j, k)` says which cells there are.
local N = 6
local block = dofile(arg[0]:match("^(.*/)") .. "unit_block.lua")(check, params.scratch, N)
local outside, roles, deck, size, read = block.outside, block.roles, block.deck, block.size, block.read
local function node(i, j, k) return 10 + i + (N + 1) * (j + (N + 1) * k) end
local function place(i, j, k)
  local x, y, z = i, j, k
  if i > 0 and i < N and j > 0 and j < N and k > 0 and k < N then
    x = x + 0.07 * math.sin(i + 2 * j + 3 * k)
    y = y + 0.07 * math.cos(3 * i - j + k)
    z = z + 0.05 * math.sin(i - j)
  end
  return x / N, y / N, z / N
end

-- The deck of the cells that are kept: nodes, cells, a set, a material, and a step.
local function inp(part)
  local lines = { "*HEADING", "a block with a void", "*NODE, NSET=all" }
  local function add(...) lines[#lines + 1] = string.format(...) end
  local used, cells = {}, {}
  for k = 0, N - 1 do
    for j = 0, N - 1 do
      for i = 0, N - 1 do
        if part(i, j, k) then
          local corners = {}
          for c, d in ipairs { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 },
            { 1, 1, 1 }, { 0, 1, 1 } } do
            corners[c] = node(i + d[1], j + d[2], k + d[3])
            used[corners[c]] = { i + d[1], j + d[2], k + d[3] }
          end
          cells[#cells + 1] = corners
        end
      end
    end
  end
  local nodes = {}
  for tag in pairs(used) do nodes[#nodes + 1] = tag end
  table.sort(nodes)
  for _, tag in ipairs(nodes) do add("%d, %.12g, %.12g, %.12g", tag, place(table.unpack(used[tag]))) end
  add("*ELEMENT, TYPE=C3D8, ELSET=part")
  for c, corners in ipairs(cells) do add("%d, %s", 1000 + c, table.concat(corners, ", ")) end
  add("*ELSET, ELSET=first")
  add("1001, 1002")
  add("*MATERIAL, NAME=steel\n*ELASTIC\n210000., 0.3")
  add("*MATERIAL, NAME=\"soft foam\"\n*ELASTIC\n10., 0.1")
  add("*SOLID SECTION, ELSET=part, MATERIAL=steel")
  add("*STEP\n*STATIC")
  add("*EL PRINT, ELSET=part\nS\n*EL PRINT, ELSET=foam\nS\n*END STEP")
  return table.concat(lines, "\n") .. "\n", #nodes, #cells
end

-- Voids of every class: a box of cells that reaches the block's outside where something is missing.
local voids = {
  { class = "I", low = { 0, 0, 2 }, high = { N, N, 4 } },
  { class = "II", low = { 2, 2, 2 }, high = { N, N, 4 } },
  { class = "III", low = { 2, 0, 2 }, high = { 4, N, 4 } },
  { class = "IV", low = { 2, 2, 2 }, high = { 4, 4, N } },
  { class = "V", low = { 2, 2, 0 }, high = { 4, 4, N } },
  { class = "closed", low = { 2, 2, 2 }, high = { 4, 4, 5 } },
}

for _, void in ipairs(voids) do
  local path = params.scratch .. "/" .. void.class .. ".inp"
  local text, nodes, cells = inp(outside(void.low, void.high))
  check.write(path, text)
  local model = lacuna.load(path)
  local asked = roles(void)
  asked.name, asked.material = "foam", "Steel"
  local volume = model:open_volume(asked)
  check.equal(volume.class, void.class)
  local mesh = volume:sweep { layers = void.high[3] - void.low[3], size = 1 / N }
  local joined = params.scratch .. "/joined_" .. void.class .. ".inp"
  mesh:write(joined, { with = model })
  local written = read(joined)
  local before, old_cells = deck(text)
  local after, all_cells = deck(written)
  -- What was there is there, with its number; the void is filled with no node twice.
  for tag, at in pairs(before) do
    for axis = 1, 3 do check.equal(after[tag][axis], at[axis]) end
  end
  for tag, corners in pairs(old_cells) do
    check.equal(table.concat(all_cells[tag], " "), table.concat(corners, " "))
  end
  check.equal(size(all_cells), cells + mesh.hexes)
  local places = {}
  for tag, at in pairs(after) do
    local key = ("%.7f %.7f %.7f"):format(table.unpack(at))
    check.that(not places[key], "two nodes at " .. key)
    places[key] = tag
  end
  local before_step, steps = text:match("(%*MATERIAL.-)(%*STEP.*)$")
  local section = "*SOLID SECTION, ELSET=foam, MATERIAL=steel\n"
  check.that(written:find(before_step .. section .. steps, 1, true), "cards are not verbatim")
  for _, group in ipairs(mesh:groups()) do -- source, target, every wall and void face
    local name = group.name:gsub("[^%w_-]", "_")
    check.that(written:find("SET=" .. name .. "%f[^%w_-]"), name)
    local surface = "*SURFACE, TYPE=ELEMENT, NAME=" .. name
    check.that(group.dim == 3 or written:find(surface, 1, true), surface)
  end
  for _, set in ipairs { "first", "all", "source", "target" } do
    check.that(written:find("SET, [EN]+SET=" .. set .. "\n") or written:find("SET=" .. set), set)
  end
  if block.ccx then check.equal(block.solve(void.class, written, after), 8 * size(all_cells), void.class) end
end

-- Alone: every format reads back with its cells, and numbers go on from where they are told.
do
  local path = params.scratch .. "/IV.inp"
  local void = voids[4]
  local model = lacuna.load(path)
  local mesh = model:open_volume(roles(void)):sweep { layers = 4, size = 1 / N }
  -- The name of the region and its material, in every format.
  local function named(name, material)
    local asked = roles(void)
    asked.name, asked.material = name, material
    return model:open_volume(asked):sweep { layers = 4, size = 1 / N }
  end
  local foam = named("foam", "Soft Foam")
  check.equal(foam:groups()[#foam:groups()].name, "foam")
  local called = { inp = "ELSET=foam", bdf = "$ property of foam", unv = "foam\n", msh = "\"foam\"" }
  for ending, says in pairs(called) do
    foam:write(params.scratch .. "/named." .. ending)
    check.that(read(params.scratch .. "/named." .. ending):find(says, 1, true), ending)
  end
  foam:write(params.scratch .. "/named.inp", { with = model })
  check.that(read(params.scratch .. "/named.inp"):find("ELSET=foam, MATERIAL=soft foam", 1, true))
  mesh:write(params.scratch .. "/unnamed.inp", { with = model }) -- the neighbour's
  check.that(read(params.scratch .. "/unnamed.inp"):find("ELSET=volume, MATERIAL=steel", 1, true))
  local missing = named("foam", "wood")
  local unknown = function() missing:write(params.scratch .. "/no.inp", { with = model }) end
  check.fails(unknown, "wood", "steel, soft foam")
  check.that(not check.exists(params.scratch .. "/no.inp"))
  missing:write(params.scratch .. "/alone_wood.inp")
  check.that(read(params.scratch .. "/alone_wood.inp"):find("ELSET=foam, MATERIAL=wood", 1, true))
  check.fails(function() named('a"b') end, "name")
  check.fails(function() named("a", "b,c") end, "material")
  for _, format in ipairs { "inp", "bdf", "nas", "dat", "unv" } do
    local alone = params.scratch .. "/alone." .. format
    mesh:write(alone, { first_node = 501, first_cell = 901 })
    check.equal(lacuna.check(alone).hexes, mesh.hexes, format)
    local text = read(alone)
    check.that(text:find("501", 1, true) and text:find("901", 1, true), format)
    check.that(#lacuna.load(alone):faces() >= 6, format)
    local joined = params.scratch .. "/other." .. format
    mesh:write(joined, { with = model })
    check.equal(lacuna.check(joined).hexes, N * N * N, format)
  end
  local alone = read(params.scratch .. "/alone.bdf")
  check.equal(count(alone, "GRID%*"), mesh.nodes)
  check.equal(count(alone, "CHEXA"), mesh.hexes)
  check.that(alone:find("$ nodes of source", 1, true))
  mesh:write(params.scratch .. "/soft.inp", { element = "c3d8i" })
  check.that(read(params.scratch .. "/soft.inp"):find("TYPE=C3D8I", 1, true))

  local out = params.scratch .. "/refused.inp"
  check.fails(function() mesh:write(out, { element = "C3D20" }) end, "element", "C3D20", "C3D8I")
  local taken = function() mesh:write(out, { with = model, first_node = 12 }) end
  check.fails(taken, "first_node", "12", "first free")
  check.fails(function() mesh:write(out, { with = model, first_cell = 1001 }) end, "first_cell", "1001")
  check.fails(function() mesh:write(out, { with = lacuna.model() }) end, "with", "loaded")
  check.fails(function() mesh:write(out, { quality = true }) end, "quality")
  local judged = { with = model, quality = true }
  check.fails(function() mesh:write(params.scratch .. "/a.msh", judged) end, "quality")
  check.fails(function() mesh:write(params.scratch .. "/a.msh", { first_cell = 3 }) end, "first_cell")
  check.that(not check.exists(out))
  -- A mesh whose walls have other rows than the deck's.
  local plain = lacuna.load(path, { keep_mesh = false })
  local loose = plain:open_volume(roles(void)):sweep { layers = 3, size = 0.3 }
  check.fails(function() loose:write(out, { with = plain }) end, "face", "of the mesh's", "quads")
end

-- A deck whose two parts have nodes of their own where they meet: the void between three of them.
do
  local function split(low_part)
    local lines = { "BEGIN BULK" }
    local function add(...) lines[#lines + 1] = string.format(...) end
    local function block(first, cell, property, z, twice)
      for k = 0, 1 do
        for j = 0, 1 do
          for i = 0, 2 do add("GRID,%d,,%d.,%d.,%d.", first + i + 3 * j + 6 * k, i, j, z + k) end
        end
      end
      if twice then -- the second cell has nodes of its own
        for k = 0, 1 do
          for j = 0, 1 do add("GRID,%d,,1.,%d.,%d.", first + 50 + 2 * k + j, j, z + k) end
        end
      end
      for i = 0, 1 do
        local n = {}
        for k = 0, 1 do
          for _, d in ipairs { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } } do
            local tag = first + i + d[1] + 3 * d[2] + 6 * k
            if twice and i == 1 and d[1] == 0 then tag = first + 50 + 2 * k + d[2] end
            n[#n + 1] = tag
          end
        end
        add("CHEXA,%d,%d,%d,%d,%d,%d,%d,%d,", cell + i, property, table.unpack(n, 1, 6))
        add(",%d,%d", n[7], n[8])
      end
    end
    block(100, 1, 7, 0, low_part)
    block(200, 11, 8, 2, false)
    add("PSOLID,7,5\nPSOLID,8,5\nMAT1,5,70000.,,0.3\nMAT8,12,1.,1.,.3,1.\nMAT1,1,210000.,,0.3\nCBUSH,77,3,100\nENDDATA")
    return table.concat(lines, "\n") .. "\n"
  end
  for _, twice in ipairs { false, true } do
    local path = params.scratch .. "/between.bdf"
    check.write(path, split(twice))
    local model = lacuna.load(path)
    local mesh = model:open_volume {
      source = { box = { { -0.1, -0.1, 0.9 }, { 2.1, 1.1, 1.1 } } },
      target = { box = { { -0.1, -0.1, 1.9 }, { 2.1, 1.1, 2.1 } } },
    }:sweep { layers = 2 }
    local joined = params.scratch .. "/between_joined.bdf"
    if twice then
      local why = check.fails(function() mesh:write(joined, { with = model }) end, "nodes", "merge")
      check.that(why:find("node 107 and node 152", 1, true) or why:find("node 110 and node 153", 1, true),
        why)
    else
      mesh:write(joined, { with = model })
      local text = read(joined)
      check.equal(count(text, "GRID%*"), 24 + 6)
      check.equal(count(text, "CHEXA"), 4 + 4)
      for _, card in ipairs { "MAT1,1,210000.,,0.3", "CBUSH,77,3,100", "PSOLID,9,5" } do
        check.that(text:find(card, 1, true), card)
      end
      check.that(text:find("CHEXA         78       9", 1, true), "cells go on above all elements")
      check.equal(lacuna.check(joined).hexes, 8)
      for material, says in pairs { [12] = "PSOLID,9,12", [1] = "PSOLID,9,1", [3] = "" } do
        local other = model:open_volume {
          source = { box = { { -0.1, -0.1, 0.9 }, { 2.1, 1.1, 1.1 } } },
          target = { box = { { -0.1, -0.1, 1.9 }, { 2.1, 1.1, 2.1 } } },
          name = "glue", material = material,
        }:sweep { layers = 2 }
        if material == 3 then
          local why = check.fails(function() other:write(joined, { with = model }) end, "material = 3")
          check.that(why:find("5, 12, 1", 1, true), why)
        else
          other:write(joined, { with = model })
          check.that(read(joined):find("$ property of glue\n" .. says .. "\n", 1, true), says)
        end
      end
    end
  end
end
-- Two decks of a part each, as one model and as two; numbers that both have are refused by name, or raised.
do
  local function slab(format, first, property, z, cards)
    local lines = { format == "bdf" and "BEGIN BULK" or "*NODE" }
    local function add(...) lines[#lines + 1] = string.format(...) end
    for k = 0, 1 do
      for j = 0, 1 do
        for i = 0, 2 do
          local form = format == "bdf" and "GRID,%d,,%d.,%d.,%d." or "%d,%d.,%d.,%d."
          add(form, first + i + 3 * j + 6 * k, i, j, z + k)
        end
      end
    end
    if format == "inp" then add("*ELEMENT, TYPE=C3D8, ELSET=part%d", property) end
    for i = 0, 1 do
      local n = {}
      for k = 0, 1 do
        for _, d in ipairs { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } } do
          n[#n + 1] = first + i + d[1] + 3 * d[2] + 6 * k
        end
      end
      if format == "bdf" then
        add("CHEXA,%d,%d,%d,%d,%d,%d,%d,%d,", first + i, property, table.unpack(n, 1, 6))
        add(",%d,%d", n[7], n[8])
      else
        add("%d,%s", first + i, table.concat(n, ","))
      end
    end
    for _, card in ipairs(cards) do add("%s", card) end
    return table.concat(lines, "\n") .. "\n"
  end
  local ends = {
    source = { box = { { -0.1, -0.1, 0.9 }, { 2.1, 1.1, 1.1 } } },
    target = { box = { { -0.1, -0.1, 1.9 }, { 2.1, 1.1, 2.1 } } },
    name = "glue",
  }
  local function cards(format, property, material)
    if format == "bdf" then
      return { ("PSOLID,%d,%s"):format(property, material), ("MAT1,%s,1.,,.3"):format(material), "ENDDATA" }
    end
    return { ("*MATERIAL, NAME=M%s\n*ELASTIC\n1.,.3"):format(material),
      ("*SOLID SECTION, ELSET=part%d, MATERIAL=M%s"):format(property, material), "*STEP\n*STATIC\n*END STEP" }
  end
  for _, format in ipairs { "bdf", "inp" } do
    local function file(name, ...)
      check.write(params.scratch .. "/" .. name .. "." .. format, slab(format, ...))
      return params.scratch .. "/" .. name .. "." .. format
    end
    local low = file("low", 1, 7, 0, cards(format, 7, 5))
    local high = file("high", 101, 8, 2, cards(format, 8, 6))
    local same = file("same", 1, 7, 2, cards(format, 7, 6))
    local joined = params.scratch .. "/two." .. format
    local whole = lacuna.load { low, high }
    local mesh = whole:open_volume(ends):sweep { layers = 2 }
    mesh:write(joined, { with = whole })
    local text = read(joined)
    check.equal(lacuna.check(joined).hexes, 8)
    local kept = {
      bdf = { "PSOLID,7,5", "PSOLID,8,6", "MAT1,5,", "MAT1,6,", "PSOLID,9,5" },
      inp = { "NAME=M5", "NAME=M6", "ELSET=part7", "ELSET=part8", "ELSET=glue, MATERIAL=M5" },
    }
    for _, card in ipairs(kept[format]) do
      check.that(text:find(card, 1, true), card)
    end
    check.equal(count(text, "ENDDATA"), format == "bdf" and 1 or 0)
    check.equal(count(text, "%*STEP"), format == "inp" and 1 or 0)
    check.equal(count(text, format == "bdf" and "GRID%*" or "\n%d+, %-?%d*%.%d*, "), 24 + 6)
    mesh:write(joined, { with = { whole } })
    check.equal(read(joined), text)
    -- Numbers that clash.
    local clash = lacuna.load { low, same }
    local again = clash:open_volume(ends):sweep { layers = 2 }
    check.fails(function() again:write(joined, { with = clash }) end, "node 1 ", "low", "same", "renumber")
    again:write(joined, { with = clash, renumber = true })
    check.equal(lacuna.check(joined).hexes, 8)
    check.that(not read(joined):find(format == "bdf" and "MAT1,6" or "NAME=M6", 1, true))
    again:write(params.scratch .. "/two.msh", { with = clash, renumber = true })
    check.equal(lacuna.check(params.scratch .. "/two.msh").hexes, 8)
    check.fails(function() again:write(joined, { renumber = true }) end, "renumber")
    check.fails(function() again:write(joined, { with = {} }) end, "with")
    check.fails(function() again:write(joined, { with = { 7 } }) end, "with")
  end
end
check.done()
