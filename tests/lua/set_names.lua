-- SPDX-License-Identifier: MIT
-- Sets of nodes, sets of elements and surfaces never have one name where a format has one space of names, and
-- CalculiX finds the load on every surface that is written.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }
local ccx = os.execute("command -v ccx >/dev/null 2>&1")
if not ccx then print("CalculiX (ccx) is not here: no load is applied") end

local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end

-- Names of a deck as CalculiX has them; no two that it takes for one.
local function names_of(text)
  local all = { NSET = {}, ELSET = {}, SURFACE = {} }
  local function add(kind, name)
    check.that(#name <= 80, name .. " is longer than CalculiX reads")
    check.that(not all[kind][name:upper()], kind .. " " .. name .. " is there twice")
    all[kind][name:upper()] = true
  end
  local regions = {} -- a region of two kinds of cells is put in its set twice
  for line in text:gmatch "[^\n]+" do
    local word, rest = line:match "^%*(%u+)(.*)"
    if word == "SURFACE" then add("SURFACE", rest:match "NAME=([^,%s]+)") end
    local kind, name
    if word == "NSET" or word == "ELSET" or word == "NODE" or word == "ELEMENT" then
      kind, name = rest:match "([NE]L?SET)=([^,%s]+)"
    end
    if kind and not (word == "ELEMENT" and regions[name]) then add(kind, name) end
    if kind and word == "ELEMENT" then regions[name] = true end
  end
  for name in pairs(all.SURFACE) do
    check.that(not all.ELSET[name], name .. " is an element set and a surface")
  end
  return all
end

-- The force that CalculiX finds for a pressure of 1 on each of some surfaces, with a set of nodes held.
local function forces(name, text, held, region, surfaces)
  local lines = { text, "*MATERIAL, NAME=m\n*ELASTIC\n1000., 0.3",
    ("*SOLID SECTION, ELSET=%s, MATERIAL=m\n*BOUNDARY\n%s, 1, 3, 0."):format(region, held) }
  for _, surface in ipairs(surfaces) do
    lines[#lines + 1] = ("*STEP\n*STATIC\n*DSLOAD, OP=NEW\n%s, P, 1.\n*NODE PRINT, NSET=%s, " ..
      "TOTALS=ONLY\nRF\n*END STEP"):format(surface, held)
  end
  check.write(("%s/%s.inp"):format(params.scratch, name), table.concat(lines, "\n") .. "\n")
  check.that(os.execute(("cd '%s' && ccx %s >%s.log 2>&1"):format(params.scratch, name, name)), name)
  local found = {}
  for x, y, z in read(("%s/%s.dat"):format(params.scratch, name)):gmatch "\n%s+(%S+)%s+(%S+)%s+(%S+)\n" do
    found[#found + 1] = math.sqrt(x ^ 2 + y ^ 2 + z ^ 2)
  end
  check.equal(#found, #surfaces, name)
  return found
end

-- A box of 1 x 1 whose faces have names: bottom, top, and four sides.
local function box(names, low, high)
  local model = lacuna.model()
  local points = {}
  for _, z in ipairs { low or 0, high or 2 } do
    for _, at in ipairs { { 0, 0, z }, { 1, 0, z }, { 1, 1, z }, { 0, 1, z } } do points[#points + 1] = at end
  end
  for k, c in ipairs { { 1, 4, 3, 2 }, { 5, 6, 7, 8 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 4, 8, 7 },
    { 4, 1, 5, 8 } } do
    local corners = {}
    for i = 1, 4 do corners[i] = points[c[i]] end
    model:add_face { name = names[k], points = corners, cells = { { 1, 2, 3, 4 } } }
  end
  return model
end
local orders = {
  { element = "C3D8", side = 0.25, sweep = { size = 0.5, layers = 4 } }, -- area of a quad of a wall
  { element = "C3D20R", side = 0.5, sweep = { size = 0.5, layers = 2, order = 2, serendipity = true } },
}

-- A family: names of faces and of the volume drawn from those that get in each other's way, in any capitals.
local long = ("t"):rep(78)
local pool = { "bar", "Bar", "bar_cells", "source_cells", "TARGET_CELLS", "target 2", "target_2", "wall_3",
  "wall 3", "wall:4", "Source", "volume", long .. "_front", long .. "_back",
  long:upper() .. "_front", "p", "q", "r" }
local random = check.random(32)
for member = 1, 20 do
  local left, names = { table.unpack(pool) }, {}
  for k = 1, 6 do names[k] = table.remove(left, math.floor(random(1, #left + 1))) end
  local faces = box(names)
  local all = faces:faces()
  local volume = faces:open_volume { source = all[1], target = all[2],
    walls = { all[3], all[4], all[5], all[6] }, name = pool[math.floor(random(1, #pool + 1))] }
  local kind = orders[1 + member % 2]
  local mesh = volume:sweep(kind.sweep)
  local path = ("%s/family_%d.inp"):format(params.scratch, member)
  mesh:write(path, { element = kind.element })
  local text = read(path)
  local found = names_of(text)
  for _, plain in ipairs { "SOURCE", "TARGET" } do
    check.that(found.NSET[plain] and found.SURFACE[plain] and not found.ELSET[plain], plain)
  end
  if ccx and member <= 6 then
    -- Of the source, whose nodes are held, a reaction says nothing.
    local loaded, areas = {}, {}
    for name, sides in text:gmatch "NAME=([^\n]+)\n([^*]+)" do
      local area = 0
      for side in sides:gmatch "S(%d)" do area = area + (tonumber(side) > 2 and kind.side or 0.25) end
      if not sides:find "S1" then
        loaded[#loaded + 1], areas[#areas + 1] = name, area
      end
    end
    check.that(#loaded >= 6)
    local region = text:match "%*ELEMENT, TYPE=%w+, ELSET=([^%s,]+)"
    local found = forces("family_" .. member .. "_solved", text, "source", region, loaded)
    for k, force in ipairs(found) do -- the share of nodes that are held is no reaction: of a wall up to 1 / 8
      check.that(force < 1.001 * areas[k] and force > 0.87 * areas[k], loaded[k])
      if loaded[k] == "target" then check.near(force, 1, 1e-3) end
    end
  end
  -- Other formats: groups of a universal file are of nodes and elements both; SET1 has numbers.
  for _, ending in ipairs { "unv", "bdf", "exo", "msh" } do
    local other = ("%s/family_%d.%s"):format(params.scratch, member, ending)
    mesh:write(other)
    if ending == "bdf" then
      local ids, groups, any = {}, {}, {} -- a name in other capitals that has the same nodes is one set
      for group, id in read(other):gmatch "%$ nodes of ([^\n]+)\nSET1%s+(%d+)" do
        check.that(not ids[id] and not groups[group], group)
        ids[id], groups[group], any[group:lower()] = true, true, true
      end
      check.that(any.source and any.target)
    end
    -- And what was read from them is written with names of its own again.
    local back = ("%s/family_%d_%s.inp"):format(params.scratch, member, ending)
    local code, _, err = check.run(params.lacuna, params.scratch, { "convert", other, back })
    check.equal(code, 0, err)
    names_of(read(back))
  end
  local unv = ("%s/family_%d_back.unv"):format(params.scratch, member)
  check.equal(check.run(params.lacuna, params.scratch, { "convert", path, unv }), 0)
  local groups = {}
  for group in read(unv):match("\n  2467\n(.*)"):gmatch "\n *%d+ +0 +0 +0 +0 +0 +0 +%d+\n([^\n]+)" do
    check.that(not groups[group], group)
    groups[group] = true
  end
  check.that(next(groups))
end

-- A deck keeps its names; those of a mesh that joins it make room, and a line says so without --verbose.
do
  local ring = lacuna.synthetic.annulus { inner = 4.8, outer = 7, height = 5 }
  ring:open_volume({ source = "source", target = "target", walls = "auto", name = "steel" })
    :sweep({ layers = 3, size = 2 }):write(params.scratch .. "/ring.inp")
  local text = read(params.scratch .. "/ring.inp")
  names_of(text)
  check.write(params.scratch .. "/named.inp", text .. "*ELSET, ELSET=Foam\n1\n*NSET, NSET=void_1\n1\n" ..
    "*SURFACE, TYPE=NODE, NAME=void_2\n1\n*ELSET, ELSET=VOID_1\n2\n")
  check.write(params.scratch .. "/join.lua", [[
    local lacuna = require "lacuna"
    local steel = lacuna.load "named.inp"
    steel:open_volume { walls = steel:face { near = { 4.8, 0, 2.5 } }, name = "foam" }:sweep { size = 2 }
      :write("joined.inp", { with = steel })]])
  local code, _, err = check.run(params.lacuna, params.scratch, { "join.lua" })
  check.equal(code, 0, err)
  local joined = read(params.scratch .. "/joined.inp")
  local found = names_of(joined)
  check.that(found.ELSET.FOAM and found.ELSET.FOAM_2 and found.NSET.VOID_1 and found.NSET.VOID_1_2)
  check.that(joined:find("*ELSET, ELSET=Foam\n1\n", 1, true) and joined:find("NSET=void_1\n1\n", 1, true))
  check.that(not found.SURFACE.VOID_1 and found.SURFACE.VOID_1_2 and found.SURFACE.VOID_2_2)
  local note = err:match "note: [^\n]*"
  check.that(note and note:find("foam is called foam_2", 1, true) and note:find("void_1_2", 1, true), err)
end

-- In MSH the quads between a deck and a mesh are the deck's, each once, and their group keeps its name.
do
  local cube = box { "z0", "z1", "y0", "x1", "y1", "x0" }
  cube:open_volume({ source = "z0", target = "z1", walls = "auto" }):sweep({ size = 0.5 })
    :write(params.scratch .. "/cube.msh")
  check.write(params.scratch .. "/beside.lua", [[
    local lacuna = require "lacuna"
    local cube = lacuna.load "cube.msh"
    cube:open_volume { source = "x0", along = { vector = { -0.5, 0, 0 } }, name = "top" }:sweep {}
      :write("beside.msh", { with = cube, version = 2.2, binary = false })]])
  local code, _, err = check.run(params.lacuna, params.scratch, { "beside.lua" })
  check.equal(code, 0, err)
  check.that(not err:find "is called", err)
  local quads = {}
  for nodes in read(params.scratch .. "/beside.msh"):gmatch "\n%d+ 3 2 %d+ %d+ (%d+ %d+ %d+ %d+)" do
    local corners = {}
    for node in nodes:gmatch "%d+" do corners[#corners + 1] = tonumber(node) end
    table.sort(corners)
    local key = table.concat(corners, " ")
    check.that(not quads[key], key)
    quads[key] = true
  end
  check.that(next(quads))
end

-- An assembly whose members share names of faces and volumes.
do
  local lower = box { "b", "joint", "A", "side", "x", "y" }
  local upper = box({ "under", "top", "A", "b", "a_cells", "y" }, 2, 3)
  local a = lower:open_volume { source = lower:face "b", target = lower:face "joint", walls = "auto",
    name = "A" }
  local b = upper:open_volume { source = upper:face "under", target = upper:face "top", walls = "auto",
    name = "b" }
  local path = params.scratch .. "/assembly.inp"
  lacuna.assembly({ a, b }):sweep({ size = 0.5 }):write(path)
  names_of(read(path))
end
check.done()
