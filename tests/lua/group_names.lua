-- SPDX-License-Identifier: MIT
-- Groups hold the quads of the faces they are named for, whatever names the input gave to faces.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }

local function cells_of(mesh)
  local cells = {}
  for _, group in ipairs(mesh:groups()) do
    check.that(not cells[group.name], group.name .. " is there twice")
    cells[group.name] = group.cells
  end
  return cells
end

-- A cube with a name for each face: bottom, top, and four sides.
local function cube(names)
  local model = lacuna.model()
  local points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 },
    { 0, 1, 1 } }
  for k, c in ipairs { { 1, 4, 3, 2 }, { 5, 6, 7, 8 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 4, 8, 7 },
    { 4, 1, 5, 8 } } do
    local corners = {}
    for i = 1, 4 do corners[i] = points[c[i]] end
    model:add_face { name = names[k], points = corners, cells = { { 1, 2, 3, 4 } } }
  end
  return model
end
local function volume_of(model)
  local faces = model:faces()
  return model:open_volume { source = faces[1], target = faces[2],
    walls = { faces[3], faces[4], faces[5], faces[6] } }
end

-- A face named as another face's role, or as a group of another face, is told apart.
for _, names in ipairs { { "target", "source" }, { "Target", "SOURCE" } } do
  for k, name in ipairs { "wall", "source", "wall:4", "source_2" } do names[k + 2] = name end
  local mesh = volume_of(cube(names)):sweep { size = 0.5, layers = 3 }
  local cells = cells_of(mesh)
  local per_side = cells["wall:3"]
  check.equal(cells.source, 4)
  check.equal(cells.target, 4)
  check.equal(cells["wall:4"], per_side)
  check.equal(cells["wall:4_2"], per_side)
  check.equal(cells.source_2, per_side)
  check.that(cells[names[1] .. "_2"] or cells[names[1] .. "_3"], "the name of the source is lost")
  for _, ending in ipairs { "msh", "inp", "unv", "exo", "bdf" } do
    mesh:write(params.scratch .. "/roles." .. ending)
  end
end
-- A face that is named as its own role has one group, as ever.
local plain = cells_of(volume_of(cube { "source", "target" }):sweep { size = 0.5, layers = 3 })
check.equal(plain.source, 4)
check.equal(plain.target, 4)
check.that(not plain.source_2 and not plain.target_2)

-- In a deck a face keeps its name where another's group would be called the same.
local named = { "f1", "f2", "wall_4", "wall_3", "wall_6", "wall 5" }
local cubes = cube(named)
volume_of(cubes):sweep { size = 0.5, layers = 3 }:write(params.scratch .. "/clash.inp")
local deck = lacuna.load(params.scratch .. "/clash.inp")
for k, name in ipairs { "f1", "f2", "wall_4", "wall_3", "wall_6", "wall_5" } do
  local given, back = cubes:face(named[k]).centroid, deck:face(name).centroid
  for i = 1, 3 do
    check.that(math.abs(given[i] - back[i]) < 1e-9, name .. " is on another face")
  end
end

-- Node sets of a source swept along a path hold the nodes of all layers, also in its deck.
do
  local lines = { "*NODE" }
  for k = 0, 7 do
    local corner = k % 4
    lines[k + 2] = ("%d, %d, %d, 0"):format(k + 1, (corner + 1) // 2 % 2 + 5 * (k // 4), corner // 2)
  end
  lines[#lines + 1] = "*ELEMENT, TYPE=S4, ELSET=ONE\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=S4, ELSET=TWO\n"
    .. "2, 5, 6, 7, 8\n*NSET, NSET=HELD\n1, 4\n*NSET, NSET=LOADED\n3, 6\n*NSET, NSET=APART\n7, 8\n"
  check.write(params.scratch .. "/nsets.inp", table.concat(lines, "\n"))
  check.write(params.scratch .. "/nsets.lua", [[
    local deck = require("lacuna").load "nsets.inp"
    deck:open_volume { source = { region = "ONE" }, along = { vector = { 0, 0, 1 } } }:sweep { layers = 2 }
      :write("swept.inp", { with = deck })]])
  local code, out, err = check.run(params.lacuna, params.scratch, { "nsets.lua" })
  check.equal(code, 0, err)
  check.that(not (out .. err):find "node sets", out .. err)
  -- A set of nodes holds those of all layers over them.
  local held, before = "", ""
  for line in io.lines(params.scratch .. "/swept.inp") do
    if before == "*NSET, NSET=HELD" then held = line end
    before = line
  end
  check.equal(select(2, held:gsub("%d+", "")), 6, "nodes of HELD")
end

-- A name may hold what XML marks tags with; what no file can hold is refused where it is given.
local signs = cube { "f1 < 2", "f2 & 3", "a > b", "it's", "f5", "f6" }
local faces = signs:faces()
signs:open_volume { source = faces[1], target = faces[2], walls = "auto", name = "p > 5 & q < 6" }
  :sweep { size = 0.5, layers = 2 }:write(params.scratch .. "/signs.vtu")
check.equal(lacuna.check(params.scratch .. "/signs.vtu").hexes, 8)

-- VTK's files are read without groups, and a note names those that are lost, in text and in bytes.
do
  local cubes = cube { "f1", "f2", "f3", "f4", "f5", "f6" }
  local ends = cubes:faces()
  local mesh = cubes:open_volume { source = ends[1], target = ends[2], walls = "auto", name = "steel" }
    :sweep { size = 0.5, layers = 2 }
  for name, options in pairs { ["told.vtu"] = {}, ["told.vtk"] = {}, ["text.vtk"] = { binary = false } } do
    mesh:write(params.scratch .. "/" .. name, options)
    check.write(params.scratch .. "/told.lua", ('require("lacuna").load("%s")'):format(name))
    local code, out, err = check.run(params.lacuna, params.scratch, { "told.lua" })
    check.equal(code, 0, err)
    check.that((out .. err):find "note: [^\n]*groups[^\n]*'f1'[^\n]*%.msh", name .. ": " .. out .. err)
  end
end
for _, name in ipairs { "a\nb", "a\0b", 'a"b', "" } do
  check.fails(function() cube { name } end, "name")
end
for _, part in ipairs { "", "foam\0x" } do
  check.fails(function() lacuna.load(params.scratch .. "/signs.vtu", { without = part }) end, "without")
end
-- Solids of STEP files give their names to their faces, after the roles; default labels do not.
if lacuna.gmsh_version ~= "none" then
  local files = { named = {}, plain = {} }
  for i, part in ipairs { { "carton", "0, 0, 0, 60, 60, 40" }, { "phone", "20, 20, 0, 20, 20, 10" } } do
    local name, box = table.unpack(part)
    local path = params.scratch .. "/" .. name
    check.write(path .. ".geo", 'SetFactory("OpenCASCADE"); Box(1) = {' .. box .. "};")
    lacuna.load(path .. ".geo"):open_volume():write_cad(path .. "_plain.step")
    local file <close> = assert(io.open(path .. "_plain.step"))
    local text, count = file:read("a"):gsub("PRODUCT%(%s*'[^']*',%s*'[^']*'",
      ("PRODUCT('%s','%s'"):format(name, name))
    check.equal(count, 1)
    check.write(path .. "_named.step", text)
    for kind, list in pairs(files) do list[i] = path .. "_" .. kind .. ".step" end
  end
  check.equal(#lacuna.load(files.plain):faces { name = "phone" }, 0)
  local parts = lacuna.load(files.named)
  check.equal(#parts:faces "phone", 6)
  check.equal(#parts:faces { region = "carton" }, 6)
  local mesh = parts:open_volume({ name = "foam" }):sweep { size = 10 }
  local quads = {}
  for _, group in ipairs(mesh:groups()) do quads[group.name] = group.cells end
  check.that(quads.phone > 0 and quads.carton > 0 and quads.source > 0 and quads.target > 0)
  mesh:write(params.scratch .. "/foam.msh")
  local one = lacuna.load(params.scratch .. "/foam.msh")
  check.that(#one:faces "source" > 0 and #one:faces { name = "phone" } == 0)
end

check.done()
