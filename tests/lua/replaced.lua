-- SPDX-License-Identifier: MIT
-- A component of a deck is left out, its room is filled, and the deck is handed back.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "", shared = "" }

local N = 6
local block = dofile(arg[0]:match("^(.*/)") .. "unit_block.lua")(check, params.scratch, N)

-- A block with a plug from the middle to the top, nodes inside moved a little. A spring stands on one of the
-- nodes that only the plug's cells have.
local plug = { low = { 2, 2, 2 }, high = { 4, 4, N } }
local is_outside = block.outside(plug.low, plug.high)
local function node(i, j, k) return 10 + i + (N + 1) * (j + (N + 1) * k) end
local function place(i, j, k)
  local at = { i, j, k }
  if i > 0 and i < N and j > 0 and j < N and k > 0 and k < N then
    at = { i + 0.07 * math.sin(i + 2 * j + 3 * k), j + 0.07 * math.cos(3 * i - j + k),
      k + 0.05 * math.sin(i - j) }
  end
  return at[1] / N, at[2] / N, at[3] / N
end
local SPRING = node(3, 3, 4)

local function cells()
  local found = {}
  for k = 0, N - 1 do
    for j = 0, N - 1 do
      for i = 0, N - 1 do
        local corners = {}
        for c, d in ipairs { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 },
          { 1, 1, 1 }, { 0, 1, 1 } } do
          corners[c] = node(i + d[1], j + d[2], k + d[3])
        end
        found[#found + 1] = { tag = 1000 + #found, corners = corners, body = is_outside(i, j, k) }
      end
    end
  end
  return found
end
local all = cells()

local function list(cell, from, to) return table.concat(cell.corners, ", ", from or 1, to or 8) end

local function inp(spring)
  local lines = { "*HEADING\na block with a plug\n*NODE" }
  local function add(...) lines[#lines + 1] = string.format(...) end
  for k = 0, N do
    for j = 0, N do
      for i = 0, N do add("%d, %.12g, %.12g, %.12g", node(i, j, k), place(i, j, k)) end
    end
  end
  for _, body in ipairs { true, false } do
    add("*ELEMENT, TYPE=C3D8, ELSET=%s", body and "body" or "plug")
    for _, cell in ipairs(all) do
      if cell.body == body then add("%d, %s", cell.tag, list(cell)) end
    end
  end
  if spring then add("*ELEMENT, TYPE=SPRINGA, ELSET=springs\n5000, %d, %d", SPRING, node(0, 0, 0)) end
  add("*ELSET, ELSET=some\n1000, 1001, %d", 1000 + 2 + N * (2 + N * 2))
  add("*ELSET, ELSET=core\nplug")
  add("*NSET, NSET=line\n%d, %d, %d", node(3, 3, 0), node(3, 3, 3), node(3, 3, 5))
  add("*SURFACE, NAME=top\n%d, S2", 1000 + 2 + N * (2 + N * (N - 1)))
  add("*MATERIAL, NAME=steel\n*ELASTIC\n210000., 0.3\n*MATERIAL, NAME=foam\n*ELASTIC\n210000., 0.3")
  add("*SOLID SECTION, ELSET=body, MATERIAL=steel\n*SOLID SECTION, ELSET=plug, MATERIAL=foam")
  if spring then add("*SPRING, ELSET=springs\n\n1.") end
  add("*STEP\n*STATIC")
  if spring then add("*CLOAD\n%d, 1, 5.", node(3, 3, 5)) end
  add("*EL PRINT, ELSET=body\nS\n*EL PRINT, ELSET=plug\nS\n*END STEP")
  return table.concat(lines, "\n") .. "\n"
end

local function bdf()
  local lines = { "BEGIN BULK" }
  local function add(...) lines[#lines + 1] = string.format(...) end
  for k = 0, N do
    for j = 0, N do
      for i = 0, N do add("GRID,%d,,%.12g,%.12g,%.12g", node(i, j, k), place(i, j, k)) end
    end
  end
  for _, cell in ipairs(all) do
    add("CHEXA,%d,%d,%s,\n,%s", cell.tag, cell.body and 7 or 8, list(cell, 1, 6):gsub(" ", ""),
      list(cell, 7, 8):gsub(" ", ""))
  end
  add("PSOLID,7,1\nPSOLID,8,2\nMAT1,1,210000.,,.3\nMAT1,2,10.,,.3")
  add("CELAS2,5000,1.,%d,1,%d,1", SPRING, node(0, 0, 0))
  add("FORCE,3,%d,0,1.,1.,0.,0.\nSPC1,4,123,%d,%d", node(3, 3, 5), node(0, 0, 0), node(3, 3, 3))
  add("PLOAD4,3,%d,1.\nENDDATA", 1000 + 2 + N * (2 + N * (N - 1)))
  return table.concat(lines, "\n") .. "\n"
end

local function said(call)
  local path = params.scratch .. "/say.lua"
  check.write(path, 'local lacuna = require "lacuna"\n' .. call)
  local code, out, err = check.run(params.lacuna, params.scratch, { "--verbose", "say.lua" })
  check.equal(code, 0, err)
  return out .. err
end

check.write(params.scratch .. "/plug.inp", inp(true))
check.write(params.scratch .. "/solved.inp", inp(false))
check.write(params.scratch .. "/plug.bdf", bdf())
local own = 4 -- nodes inside the plug and on its top, where it is 2 cells wide, but for the spring's
local function pit(model, with)
  local roles = block.roles(plug)
  if with then -- the plug is there: its faces are those between the two
    for _, role in ipairs { roles.source, table.unpack(roles.walls) } do role.free = false end
  end
  roles.name = "plug"
  return model:open_volume(roles):sweep { layers = 4, size = 1 / N }
end

-- Everything is as it was, and the new cells are the plug.
local function judge(name, text)
  local before, old = block.deck(block.read(("%s/%s.inp"):format(params.scratch, name)))
  local after, new = block.deck(text)
  check.equal(block.size(new), block.size(old))
  check.equal(block.size(after), (N + 1) ^ 3 // 1 + (name == "plug" and 1 or 0)) -- the spring's own node
  local kept = 0
  for tag, at in pairs(before) do
    if after[tag] then
      for axis = 1, 3 do check.equal(after[tag][axis], at[axis]) end
      kept = kept + 1
    end
  end
  check.equal(kept, (N + 1) ^ 3 // 1 - own + (name == "plug" and 1 or 0))
  for _, cell in ipairs(all) do
    if cell.body then check.equal(table.concat(new[cell.tag], ", "), list(cell)) end
    check.equal(new[cell.tag] == nil, not cell.body)
  end
  -- The new cells are the plug now: its set, its section, what is printed of it.
  check.that(text:find("*SOLID SECTION, ELSET=plug, MATERIAL=foam", 1, true))
  check.that(not text:find("ELSET=plug, MATERIAL=steel", 1, true))
  check.that(text:find("*ELSET, ELSET=some\n1000, 1001\n", 1, true))
  -- What held the plug holds the new cells, what lay on it lies on them.
  local cells, own = {}, 0
  for tag in pairs(new) do
    if not old[tag] then own = own + 1 end
  end
  for tag in text:match("ELSET=core\n([^*]+)"):gmatch "%d+" do cells[tonumber(tag)] = true end
  check.equal(block.size(cells), own)
  for tag in pairs(cells) do check.that(new[tag] and not old[tag]) end
  local tag = text:match "NAME=top\n(%d+), S%d\n"
  check.that(cells[tonumber(tag)], "top")
  check.that(text:find(("*NSET, NSET=line\n%d, %d\n"):format(node(3, 3, 0), node(3, 3, 2)), 1, true) == nil)
  check.that(text:find(("*NSET, NSET=line\n%d\n"):format(node(3, 3, 0)), 1, true))
  if name == "solved" and block.ccx then check.equal(block.solve("replaced", text, after), 8 * #all) end
end

-- Left out on loading or on writing; CalculiX takes it.
for _, name in ipairs { "plug", "solved" } do
  local path = ("%s/%s.inp"):format(params.scratch, name)
  local loaded = lacuna.load(path, { without = "PLUG" })
  local one = pit(loaded)
  check.equal(one.hexes, 16)
  one:write(params.scratch .. "/one.inp", { with = loaded })
  local whole = lacuna.load(path)
  local two = pit(whole, true)
  two:write(params.scratch .. "/two.inp", { with = whole, without = { "core" } })
  for _, written in ipairs { "one", "two" } do
    judge(name, block.read(("%s/%s.inp"):format(params.scratch, written)))
  end
end

-- Another name: the plug's set is gone, and so is its section; the new region has its own.
do
  local loaded = lacuna.load(params.scratch .. "/plug.inp", { without = "plug" })
  local roles = block.roles(plug)
  roles.name, roles.material = "filler", "steel"
  loaded:open_volume(roles):sweep { layers = 4, size = 1 / N }
    :write(params.scratch .. "/other.inp", { with = loaded })
  local text = block.read(params.scratch .. "/other.inp")
  check.that(not text:find("SECTION, ELSET=plug", 1, true))
  check.that(text:find("SECTION, ELSET=body, MATERIAL=steel", 1, true))
  check.that(text:find("SECTION, ELSET=filler, MATERIAL=steel", 1, true))
end

-- Cells that come back as others are noted with the option that keeps their type; so is another material.
do
  local path = params.scratch .. "/reduced.inp"
  check.write(path, (inp(false):gsub("TYPE=C3D8, ELSET=plug", "TYPE=C3D8R, ELSET=plug")))
  local function notes(name, options)
    return said(([[local part = lacuna.load("reduced.inp", { without = "plug" })
part:open_volume({ source = { near = { 0.5, 0.5, 1 / 3 } }, walls = "auto", name = %q })
  :sweep { layers = 4, size = 1 / %d }:write("reduced_out.inp", { with = part%s })]])
      :format(name, N, options))
  end
  local element = "note: %s has elements C3D8, while some that were left out are C3D8R; element = \"C3D8R\""
  local material = "note: filler: its material is steel, that of body beside it, while elements that were " ..
    "left out have foam"
  for _, name in ipairs { "plug", "filler" } do
    local text = notes(name, "")
    check.that(text:find(element:format(name), 1, true), text)
    check.equal(text:find(material, 1, true) ~= nil, name == "filler", text)
    text = notes(name, ', element = "C3D8R"')
    check.that(not text:find("left out are", 1, true), text)
  end
end

-- Nastran: by the property's number; what loads still name is said.
do
  local path = params.scratch .. "/plug.bdf"
  local out = params.scratch .. "/replaced.bdf"
  for _, part in ipairs { 8, "8", "pid:8", "PID:8" } do
    local loaded = lacuna.load(path, { without = part })
    pit(loaded):write(out, { with = loaded })
    local text = block.read(out)
    check.equal(select(2, text:gsub("GRID%*", "")), (N + 1) ^ 3 // 1 + 1)
    check.that(text:find("PSOLID,8,2", 1, true) and text:find("PSOLID,9,1", 1, true))
    check.equal(lacuna.check(out).hexes, N ^ 3 // 1)
    for _, ending in ipairs { "msh", "vtu", "vtk", "unv", "inp", "exo" } do
      local other = params.scratch .. "/replaced." .. ending
      pit(loaded):write(other, { with = loaded })
      check.equal(lacuna.check(other).hexes, N ^ 3 // 1)
    end
  end
  local notes = said('lacuna.load("plug.bdf", { without = 8 })')
  for _, words in ipairs { "16 elements are left out, and 3 nodes", "FORCE names", "SPC1 names",
    "PLOAD4 names" } do
    check.that(notes:find(words, 1, true), words .. "\n" .. notes)
  end
  notes = said('lacuna.load("plug.inp", { without = "plug" })')
  for _, words in ipairs { "16 elements are left out, and 3 nodes", "some loses 1 of 3",
    "core loses 16 of 16", "top loses 1 of 1", "line loses 2 of 3", "*CLOAD names" } do
    check.that(notes:find(words, 1, true), words .. "\n" .. notes)
  end
  -- The volume called as the property is the property.
  local loaded = lacuna.load(path, { without = 8 })
  local roles = block.roles(plug)
  roles.name = "pid:8"
  loaded:open_volume(roles):sweep { layers = 4, size = 1 / N }:write(out, { with = loaded })
  local text = block.read(out)
  check.that(text:find("PSOLID,8,2", 1, true) and not text:find("PSOLID,9", 1, true))
  check.equal(#lacuna.load(out):faces { region = "pid:8", free = true }, 1)
end

-- An equation keeps the nodes of its terms, and none whose number equals the number of terms, a
-- direction or a coefficient.
for terms = 2, 5 do
  for _, named in ipairs { false, true } do -- whether the last term is a node of the plug
    local lines = { "*NODE" }
    for n = 0, 11 do
      local corner = n % 4
      lines[#lines + 1] = ("%d, %d, %d, %d"):format(n + 1, (corner + 1) // 2 % 2, corner // 2, 2 - n // 4)
    end
    lines[#lines + 1] = "*ELEMENT, TYPE=C3D8, ELSET=body\n1, 9, 10, 11, 12, 5, 6, 7, 8\n"
      .. "*ELEMENT, TYPE=C3D8, ELSET=plug\n2, 5, 6, 7, 8, 1, 2, 3, 4\n*EQUATION"
    for _, last in ipairs { 8, named and 4 or 9 } do
      lines[#lines + 1] = "** another\n" .. terms
      local row = {}
      for t = 1, terms do
        row[#row + 1] = ("%d, %d, %d"):format(t == terms and last or 4 + t, 1 + t % 3, t % 2 + 1)
        if t == terms or #row == 4 then lines[#lines + 1], row = table.concat(row, ", "), {} end
      end
    end
    check.write(params.scratch .. "/tied.inp", table.concat(lines, "\n") .. "\n")
    local notes = said('lacuna.load("tied.inp", { without = "plug" })')
    local gone = ("1 elements are left out, and %d nodes"):format(named and 3 or 4)
    check.that(notes:find(gone, 1, true), gone .. "\n" .. notes)
  end
end

-- The directions of a coupling are no nodes.
check.write(params.scratch .. "/coupled.inp", [[
*NODE
1, 0, 0, 2
2, 1, 0, 2
3, 1, 1, 2
4, 0, 1, 2
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
9, 0, 0, 0
10, 1, 0, 0
11, 1, 1, 0
12, 0, 1, 0
*ELEMENT, TYPE=C3D8, ELSET=body
1, 9, 10, 11, 12, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=plug
2, 5, 6, 7, 8, 1, 2, 3, 4
*KINEMATIC COUPLING, REF NODE=9
5, 1, 3
]])
local coupled = said 'lacuna.load("coupled.inp", { without = "plug" })'
check.that(coupled:find("and 4 nodes", 1, true), coupled)

-- Refused, by name.
do
  local path = params.scratch .. "/plug.inp"
  check.fails(function() lacuna.load(path, { without = "plugs" }) end, "plugs", "body, plug")
  check.fails(function() lacuna.load(path, { without = { "plug", "body" } }) end, "plug, body",
    "all elements of")
  check.fails(function() lacuna.load(path, { without = {} }) end, "without", "name or number")
  check.fails(function() lacuna.load(path, { without = true }) end, "without", "name or number")
  check.fails(function() lacuna.load(params.scratch .. "/plug.bdf", { without = 9 }) end, "9", "pid:7, pid:8")
  local loaded = lacuna.load(path, { without = "plug" })
  local mesh = pit(loaded)
  local out = params.scratch .. "/refused.inp"
  check.fails(function() mesh:write(out, { with = loaded, without = "nothing" }) end, "nothing")
  check.fails(function() mesh:write(out, { without = "plug" }) end, "without")
  -- Forgotten: the mesh lies over the deck's own elements, and a note says so.
  check.that(said [[
    lacuna.synthetic.prism { sides = 4 }:open_volume {}:sweep { layers = 2, size = 1 }:write "cube.inp"
    local cube = lacuna.load "cube.inp"
    cube:open_volume { source = "source", target = "target", walls = "auto", name = "again" }
      :sweep { layers = 2 }:write("twice.inp", { with = cube })
  ]]:find "note: the mesh overlaps %d+ of the deck's elements, such as element %d+")
end

-- A real deck: bricks of property 1 to 3; the middle one is left out and filled between its neighbours.
do
  local path = params.shared .. "/data/fem/contact_model.bdf"
  if params.shared == "" or not check.exists(path) then
    print("skipped: " .. path .. " is not here")
  else
    local whole = lacuna.load(path)
    local before = lacuna.check(path)
    check.that(before.hexes == 675 and #whole:faces() == 18)
    local loaded = lacuna.load(path, { without = 2 })
    check.equal(#loaded:faces(), 12)
    local mesh = loaded:open_volume {
      source = { region = "pid:1", facing = { 1, 0, 0 } },
      target = { region = "pid:3", facing = { -1, 0, 0 } },
      name = "pid:2",
    }:sweep { layers = 5 }
    local out = params.scratch .. "/contact.bdf"
    mesh:write(out, { with = loaded })
    local after = lacuna.check(out)
    check.equal(after.hexes, 450 + mesh.hexes)
    check.near(after.volume, 20 * 10 * 30.2, 1e-6 * before.volume) -- the gaps are filled too
    local text, given = block.read(out), block.read(path)
    for _, card in ipairs { "PSOLID", "MAT1", "CORD2C", "BCTSET", "SPC1" } do
      local line = given:match("\n(" .. card .. "[^\n]*)")
      check.that(text:find(line, 1, true), card)
    end
  end
end

check.done()
