-- SPDX-License-Identifier: MIT
-- Thin layers: names of elements, the direction of their stack, and interfaces split along faces.
-- usage: lacuna split.lua scratch=FOLDER ccx=PROGRAM
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { scratch = ".", lacuna = "", ccx = "" }
local function at(name) return params.scratch .. "/" .. name end
local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end

-- Nodes, elements by type, and sets of an Abaqus deck.
local function abaqus(path)
  local deck, kind, name = { nodes = {}, elements = {}, sets = {} }, nil, nil
  local pending
  for line in read(path):gmatch "[^\n]+" do
    if line:sub(1, 2) == "**" then
    elseif line:sub(1, 1) == "*" then
      kind = line:match "^%*(%w+)"
      name = line:match "[EN]L?SET=([^,]+)" or line:match "NAME=([^,]+)"
      if kind == "ELEMENT" then
        name = line:match "TYPE=([^,]+)"
        deck.elements[name] = deck.elements[name] or {}
      elseif kind == "NSET" then
        name = line:match "NSET=([^,]+)"
        deck.sets[name] = {}
      end
      pending = nil
    else
      local row = {}
      for word in line:gmatch "[^%s,]+" do row[#row + 1] = tonumber(word) end
      if kind == "NODE" then
        deck.nodes[row[1]] = { row[2], row[3], row[4] }
      elseif kind == "ELEMENT" then
        if pending then -- the nodes of an element go on
          table.move(row, 1, #row, #pending + 1, pending)
        else
          deck.elements[name][table.remove(row, 1)] = row
        end
        pending = line:find ",%s*$" and (pending or row) or nil
      elseif kind == "NSET" then
        for _, tag in ipairs(row) do deck.sets[name][tag] = true end
      end
    end
  end
  return deck
end
local function size(of)
  local count = 0
  for _ in pairs(of) do count = count + 1 end
  return count
end

-- --- element names ---------------------------------------------------------------------------------------

local model = lacuna.synthetic.prism { sides = 4, height = 0.1 }
local plate = model:open_volume { name = "layer" }:sweep { layers = 2, size = 0.5 }
for _, element in ipairs { "COH3D8", "COH3D8P", "GK3D8", "GK3D8N", "SC8R", "SC8RT", "CSS8", "c3d8i" } do
  plate:write(at "layer.inp", { element = element })
  local deck = abaqus(at "layer.inp")
  local cells = deck.elements[element:upper()]
  check.equal(size(cells), plate.hexes, element)
  -- The stack goes from nodes 1-4 to nodes 5-8, along the sweep.
  for _, cell in pairs(cells) do
    for k = 1, 4 do
      local low, high = deck.nodes[cell[k]], deck.nodes[cell[k + 4]]
      check.near(high[1] - low[1], 0, 1e-12)
      check.near(high[2] - low[2], 0, 1e-12)
      check.near(high[3] - low[3], 0.05, 1e-12)
    end
  end
end
check.fails(function() plate:write(at "no.inp", { element = "COH3D6" }) end, "eight nodes")
local second = model:open_volume():sweep { layers = 1, size = 0.5, order = 2, serendipity = true }
check.fails(function() second:write(at "no.inp", { element = "GK3D8" }) end, "twenty nodes")
do
  local fan = lacuna.model()
  fan:add_face { name = "source", keep_mesh = true, points = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0.5, 0 },
    { 1, 1, 0 },
    { 0, 1, 0 } }, cells = { { 1, 2, 4, 5 }, { 2, 3, 4 } } }
  local mixed = fan:open_volume { source = "source", along = { vector = { 0, 0, 0.1 } } }
    :sweep { layers = 1, wedges = true }
  for element, wedge in pairs { COH3D8 = "COH3D6", GK3D8 = "GK3D6", SC8R = "SC6R", C3D8I = "C3D6" } do
    mixed:write(at "mixed.inp", { element = element })
    check.equal(size(abaqus(at "mixed.inp").elements[wedge]), 1, element)
  end
  check.fails(function() mixed:write(at "no.inp", { element = "CSS8" }) end, "wedges", "SC8R")
end

-- --- interfaces ------------------------------------------------------------------------------------------

-- Blocks of a grid, each a volume of an assembly; { name = { x0, x1, y0, y1, z0, z1 } }.
local function block_model(box)
  local x0, x1, y0, y1, z0, z1 = table.unpack(box)
  local block = lacuna.model()
  local function face(name, ...)
    block:add_face { name = name, points = { ... }, cells = { { 1, 2, 3, 4 } } }
  end
  face("source", { x0, y0, z0 }, { x0, y1, z0 }, { x1, y1, z0 }, { x1, y0, z0 })
  face("target", { x0, y0, z1 }, { x1, y0, z1 }, { x1, y1, z1 }, { x0, y1, z1 })
  face("south", { x0, y0, z0 }, { x1, y0, z0 }, { x1, y0, z1 }, { x0, y0, z1 })
  face("north", { x0, y1, z0 }, { x0, y1, z1 }, { x1, y1, z1 }, { x1, y1, z0 })
  face("west", { x0, y0, z0 }, { x0, y0, z1 }, { x0, y1, z1 }, { x0, y1, z0 })
  face("east", { x1, y0, z0 }, { x1, y1, z0 }, { x1, y1, z1 }, { x1, y0, z1 })
  return block
end
local function assembly(boxes, layers, periodic)
  local volumes, names = {}, {}
  for name in pairs(boxes) do names[#names + 1] = name end
  table.sort(names)
  for _, name in ipairs(names) do
    volumes[#volumes + 1] = block_model(boxes[name]):open_volume { source = "source", target = "target",
      walls = { "south", "north", "west", "east" }, name = name }
  end
  return lacuna.assembly(volumes):sweep { layers = layers or 2, size = 0.5, periodic = periodic }
end
-- Nodes by their place: how many stand there.
local function stacked(deck)
  local by = {}
  for tag, p in pairs(deck.nodes) do
    local key = ("%.6f %.6f %.6f"):format(p[1], p[2], p[3])
    by[key] = by[key] or {}
    table.insert(by[key], tag)
  end
  return by
end

-- Two blocks: every node of the face between them is doubled; each side keeps the nodes of its own cells.
local two = assembly { a = { 0, 1, 0, 1, 0, 1 }, b = { 1, 2, 0, 1, 0, 1 } }
for _, faces in ipairs { "all", { { "a", "b" } }, { { "b", "a" } }, { "a:east" }, "b:west" } do
  local split = lacuna.split_interface(two, { faces = faces, element = "coh3d8", name = "glue" })
  check.equal(split.nodes, two.nodes + 9)
  check.equal(split.hexes, two.hexes)
  check.equal(split.interface_cells, 4)
  check.near(split:quality().min_scaled_jacobian, two:quality().min_scaled_jacobian, 1e-12)
  split:write(at "two.inp")
  local deck = abaqus(at "two.inp")
  check.equal(size(deck.elements.COH3D8), 4)
  check.equal(size(deck.elements.C3D8), two.hexes)
  local of = {} -- the side of each node, by the cells that have it
  for _, cell in pairs(deck.elements.C3D8) do
    local x = 0
    for _, n in ipairs(cell) do x = x + deck.nodes[n][1] / 8 end
    for _, n in ipairs(cell) do
      check.that(not of[n] or of[n] == (x < 1 and "a" or "b"), "a node of both sides")
      of[n] = x < 1 and "a" or "b"
    end
  end
  for _, cell in pairs(deck.elements.COH3D8) do
    for k = 1, 4 do
      check.equal(of[cell[k]], "a")
      check.equal(of[cell[k + 4]], "b")
      for axis = 1, 3 do check.equal(deck.nodes[cell[k]][axis], deck.nodes[cell[k + 4]][axis]) end
    end
    -- From a to b: the normal of nodes 1-2-3 points to +x.
    local p, q, r = deck.nodes[cell[1]], deck.nodes[cell[2]], deck.nodes[cell[3]]
    local normal = (q[2] - p[2]) * (r[3] - p[3]) - (q[3] - p[3]) * (r[2] - p[2])
    check.that(normal > 0, "the direction of the stack")
  end
  for n in pairs(deck.sets.a_east) do check.equal(of[n], "a", "sets follow") end
  for n in pairs(deck.sets.b_west) do check.equal(of[n], "b", "sets follow") end
  check.equal(size(deck.sets.a_east), 9)
end
-- Other formats hold the same cells, as hexahedra of a group of their own.
local glued = lacuna.split_interface(two, { faces = "all", name = "glue" })
local groups = {}
for _, group in ipairs(glued:groups()) do groups[group.name] = group.cells end
check.equal(groups.glue, 4)
for _, ending in ipairs { "msh", "vtu", "bdf", "unv", "exo", "k", "feb" } do
  glued:write(at("two." .. ending))
  if ending ~= "feb" then
    local made = lacuna.convert(at("two." .. ending), at "back.exo")
    check.equal(made.nodes, glued.nodes, ending)
  end
end
check.that(read(at "two.k"):find("glue\n.-%*SECTION_SOLID\n%s+%d+%s+19\n"), "cohesive solids")

-- A cross of four blocks: the nodes of the middle line are there once for each region that is cut off.
local cross = assembly { a = { 0, 1, 0, 1, 0, 1 }, b = { 1, 2, 0, 1, 0, 1 }, c = { 1, 2, 1, 2, 0, 1 },
  d = { 0, 1, 1, 2, 0, 1 } }
local function on_the_line(faces)
  lacuna.split_interface(cross, { faces = faces }):write(at "cross.inp")
  local count
  for key, tags in pairs(stacked(abaqus(at "cross.inp"))) do
    if key:match "^1%.000000 1%.000000" then
      check.that(not count or count == #tags)
      count = #tags
    end
  end
  return count
end
check.equal(on_the_line "all", 4)
check.equal(on_the_line { { "a", "b" } }, 1) -- an end of the interface inside the mesh
check.equal(on_the_line { { "a", "b" }, { "c", "d" } }, 2)
check.equal(on_the_line { { "a", "b" }, { "b", "c" } }, 2)
check.equal(on_the_line { { "a", "b" }, { "b", "c" }, { "c", "d" } }, 3)

-- Three regions that meet: their nodes are tripled.
local three = assembly { a = { 0, 2, 0, 1, 0, 1 }, b = { 0, 1, 1, 2, 0, 1 }, c = { 1, 2, 1, 2, 0, 1 } }
local split = lacuna.split_interface(three, { faces = "all" })
split:write(at "three.inp")
local most = 0
for _, tags in pairs(stacked(abaqus(at "three.inp"))) do most = math.max(most, #tags) end
check.equal(most, 3)
check.equal(split.nodes, three.nodes + 2 * 3 + 2 * 6 + 2 * 3)

-- A crack tip: the last cells share the nodes of the tip.
local crack = lacuna.split_interface(cross, { faces = { { "a", "b" } } })
crack:write(at "crack.inp")
local tips = 0
for _, cell in pairs(abaqus(at "crack.inp").elements.COH3D8) do
  for k = 1, 4 do if cell[k] == cell[k + 4] then tips = tips + 1 end end
end
check.equal(tips, 4)

-- Pairs of periodic faces are those of the doubled nodes too: each node has its image in the same region.
-- Directions are those of the swept cells.
do
  local whole = assembly({ a = { 0, 1, 0, 1, 0, 1 }, b = { 1, 2, 0, 1, 0, 1 } }, 2, { { "south", "north" } })
  local mesh = lacuna.split_interface(whole, { faces = "all", name = "glue" })
  mesh:write(at "periodic.inp", { orientation = true })
  local deck, text = abaqus(at "periodic.inp"), read(at "periodic.inp")
  local function members(name)
    local found = {}
    for tag in text:match("%*NSET, NSET=" .. name .. "\n([^*]*)"):gmatch "%d+" do
      found[#found + 1] = tonumber(tag)
    end
    return found
  end
  local near, image = members "periodic_1_a", members "periodic_1_b"
  check.equal(#near, #image)
  check.equal(#near, 15 + 3)
  for k, tag in ipairs(near) do
    local p, q = deck.nodes[tag], deck.nodes[image[k]]
    check.near(q[1] - p[1], 0, 1e-12)
    check.near(q[2] - p[2], 1, 1e-12)
    check.near(q[3] - p[3], 0, 1e-12)
    check.equal(deck.sets.a_east[tag], deck.sets.a_east[image[k]])
    check.equal(deck.sets.b_west[tag], deck.sets.b_west[image[k]])
  end
  check.that(text:find("*EQUATION", 1, true))
  local rows = 0
  for lines in text:gmatch "%*DISTRIBUTION, NAME=[^\n]*\n[^\n]*\n([^*]*)" do
    for _ in lines:gmatch "%d+, [^\n]*\n" do rows = rows + 1 end
  end
  check.equal(rows, mesh.hexes, "directions of each swept cell")
  mesh:write(at "periodic.bdf", { orientation = true })
  local listed = 0
  for list in read(at "periodic.bdf"):gmatch "MATCID,%d+,([^A-Z]*)" do
    for _ in list:gmatch "%d+" do listed = listed + 1 end
  end
  check.equal(listed, mesh.hexes)
  mesh:write(at "periodic.feb", { orientation = true })
  local _, axes = read(at "periodic.feb"):gsub("<elem lid=", "")
  check.equal(axes, mesh.hexes)
  mesh:write(at "periodic.vtu", { orientation = true })
  mesh:write(at "periodic.msh")
  check.that(read(at "periodic.msh"):find("$Periodic", 1, true))
end

-- Nodes are those of the file.
do
  local deck = abaqus(at "cross.inp")
  local whole = lacuna.split_interface(cross, { faces = { { "a", "b" }, { "b", "c" }, { "c", "d" } } })
  check.equal(whole.nodes, size(deck.nodes))
  for n = 1, whole.nodes do
    local p = { whole:node(n) }
    for axis = 1, 3 do check.near(p[axis], deck.nodes[n][axis], 1e-12) end
  end
end

-- Between the layers of one sweep: each level has its nodes twice, and cells stand in the direction of the
-- sweep. Groups of both sides; nodes and cells of the whole keep their numbers; splits at several levels.
local function ply(order, layers)
  return block_model { 0, 2, 0, 1, 0, 3 }:open_volume { source = "source", target = "target", name = "ply",
    walls = { "south", "north", "west", "east" } }:sweep { layers = layers, size = 0.5, order = order,
    serendipity = order == 2 or nil }
end
for _, levels in ipairs { 1, { 1 }, { 2, 1 } } do
  local whole = ply(1, 3)
  local split = lacuna.split_interface(whole, { faces = levels, name = "resin" })
  local count = levels == 1 and 1 or #levels
  check.equal(split.nodes, whole.nodes + count * 15)
  check.equal(split.hexes, whole.hexes)
  check.equal(split.interface_cells, count * 8)
  check.near(split:quality().volume, 6, 1e-12)
  check.near(split.fidelity.volume, 6, 1e-12)
  check.equal(split.layers.ply, 3)
  split:write(at "ply.inp")
  whole:write(at "whole.inp")
  local deck, before = abaqus(at "ply.inp"), abaqus(at "whole.inp")
  for n, p in pairs(before.nodes) do
    for axis = 1, 3 do check.equal(deck.nodes[n][axis], p[axis]) end
  end
  for _, cell in pairs(deck.elements.COH3D8) do
    local p, q, r = deck.nodes[cell[1]], deck.nodes[cell[2]], deck.nodes[cell[3]]
    local up = (q[1] - p[1]) * (r[2] - p[2]) - (q[2] - p[2]) * (r[1] - p[1])
    check.that(up > 0, "the direction of the stack")
    check.that(cell[5] > whole.nodes and cell[1] <= whole.nodes)
    for k = 1, 4 do
      check.that(deck.sets[("level_%.0f_target"):format(p[3])][cell[k]])
      check.that(deck.sets[("level_%.0f_source"):format(p[3])][cell[k + 4]])
    end
  end
  local names = {}
  for _, group in ipairs(split:groups()) do names[group.name] = group.cells end
  check.equal(names["level_1:target"], 8)
  check.equal(names["level_1:source"], 8)
  check.equal(names.ply, whole.hexes)
  check.equal(names.west, 6)
  for _, ending in ipairs { "msh", "vtu", "bdf", "unv", "exo", "k" } do
    split:write(at("ply." .. ending))
    check.equal(lacuna.convert(at("ply." .. ending), at "back.exo").nodes, split.nodes, ending)
  end
end

-- What is refused.
local function refused(mesh, options, ...)
  check.fails(function() lacuna.split_interface(mesh, options) end, ...)
end
refused(two, { faces = "nothing" }, "share the named faces", '{ "a", "b" }')
refused(two, {}, "no faces are named")
refused(two, { faces = "all", element = "SC8R" }, "SC8R", "COH3D8")
refused(glued, { faces = "all" }, "was split before")
refused(plate, { faces = "all" }, "assembly")
refused(plate, { faces = 2 }, "layer 2", "last layer is 2")
refused(ply(1, 3), { faces = 3 }, "layer 3", "from 1 to 2")
refused(two, { faces = 1 }, "2 parts")
refused(3, { faces = 1 }, "a mesh of hexahedra")
check.fails(function() glued:pattern { translate = { 0, 0, 9 }, count = 2 } end, "was split", "pattern first")
refused(two, { faces = { { "a" } } }, "pairs of regions")
check.fails(function() glued:write(at "polyMesh") end, "polyMesh")
check.fails(function() lacuna.assembly { glued } : sweep { layers = 1 } end, "was split")
local quadratic = lacuna.assembly {
  block_model { 0, 1, 0, 1, 0, 1 }:open_volume { source = "source", target = "target", name = "a",
    walls = { "south", "north", "west", "east" } },
  block_model { 1, 2, 0, 1, 0, 1 }:open_volume { source = "source", target = "target", name = "b",
    walls = { "south", "north", "west", "east" } } }
  :sweep { layers = 1, size = 0.5, order = 2, serendipity = true }

-- --- order 2 ---------------------------------------------------------------------------------------------

-- Cells of order 2 have the middle nodes of the sides of both regions, and a node of their own between every
-- two opposite nodes, where a mixed element has its multipliers.

-- Points, cells as { type =, nodes of the file }, and the region of each cell of a legacy VTK file.
local function vtk(path)
  local text, deck = read(path), { points = {}, cells = {} }
  local function block(head)
    local from = select(2, text:find("\n" .. head .. " [^\n]*\n"))
    local all = {}
    for word in text:sub(from + 1):match("^[%d%s%.%-%+e]+"):gmatch "%S+" do all[#all + 1] = tonumber(word) end
    return all
  end
  local at_points, cells, types = block "POINTS", block "CELLS", block "CELL_TYPES"
  for k = 1, #at_points, 3 do table.insert(deck.points, { table.unpack(at_points, k, k + 2) }) end
  local k = 1
  for _, kind in ipairs(types) do
    deck.cells[#deck.cells + 1] = { type = kind, table.unpack(cells, k + 1, k + cells[k]) }
    k = k + cells[k] + 1
  end
  return deck
end
local kSolids = { [25] = 20, [29] = 27, [26] = 15, [32] = 18, [24] = 10, [27] = 13 }
local function key_of_place(p) return ("%.9f %.9f %.9f"):format(p[1], p[2], p[3]) end
-- Cells without thickness: their corners 1-4 lie at the places of corners 5-8.
local function thin_cells(deck)
  local thin, thick = {}, {}
  for _, cell in ipairs(deck.cells) do
    if kSolids[cell.type] then
      local corners = cell.type == 26 or cell.type == 32
      local half, is_thin = corners and 3 or 4, cell.type ~= 24 and cell.type ~= 27
      for c = 1, half do
        local low, high = deck.points[cell[c] + 1], deck.points[cell[c + half] + 1]
        is_thin = is_thin and key_of_place(low) == key_of_place(high)
      end
      table.insert(is_thin and thin or thick, cell)
    end
  end
  return thin, thick
end
-- Corners and middle nodes of the sides of a cell's bottom and top, in VTK's order; of hex27 their centres.
local kBottom, kTop = { 1, 2, 3, 4, 9, 10, 11, 12, 25 }, { 5, 6, 7, 8, 13, 14, 15, 16, 26 }

local function blocks(full, periodic, boxes)
  local volumes = {}
  for name, box in pairs(boxes or { a = { 0, 1, 0, 1, 0, 1 }, b = { 1, 2, 0, 1, 0, 1 } }) do
    volumes[#volumes + 1] = { name = name, box = box }
  end
  table.sort(volumes, function(a, b) return a.name < b.name end)
  for k, one in ipairs(volumes) do
    volumes[k] = block_model(one.box):open_volume { source = "source", target = "target", name = one.name,
      walls = { "south", "north", "west", "east" } }
  end
  return lacuna.assembly(volumes):sweep { layers = 2, size = 0.5, order = 2, serendipity = not full,
    periodic = periodic }
end

for _, full in ipairs { false, true } do
  local whole = blocks(full, { { "south", "north" } })
  local split = lacuna.split_interface(whole, { faces = "all", name = "glue" })
  local nodes, solid = full and 27 or 20, full and 29 or 25
  -- 21 nodes of four quads of order 2 are doubled (25 with centres), and each pair has a node between.
  check.equal(split.interface_cells, 4)
  check.equal(split.nodes, whole.nodes + (full and 2 * 25 or 21 + 9))
  check.equal(split.hexes, whole.hexes)
  check.near(split:quality().min_scaled_jacobian, whole:quality().min_scaled_jacobian, 1e-12)
  split:write(at "thin.vtk", { binary = false })
  local deck = vtk(at "thin.vtk")
  check.equal(#deck.points, split.nodes)
  local thin, thick = thin_cells(deck)
  check.equal(#thin, 4)
  check.equal(#thick, whole.hexes)
  local of, used = {}, {}
  for _, cell in ipairs(thick) do
    check.equal(cell.type, solid)
    check.equal(#cell, nodes, "neighbours keep order 2")
    local x = 0
    for c = 1, 8 do x = x + deck.points[cell[c] + 1][1] / 8 end
    for _, n in ipairs(cell) do
      check.that(not of[n] or of[n] == (x < 1 and "a" or "b"), "a node of both sides")
      of[n], used[n] = x < 1 and "a" or "b", true
    end
  end
  -- Sides of the neighbours, by their nodes: a side of the interface is one of each neighbour's.
  local sides = {}
  local kFaces = { { 1, 4, 3, 2, 12, 11, 10, 9, 25 }, { 5, 6, 7, 8, 13, 14, 15, 16, 26 },
    { 1, 2, 6, 5, 9, 18, 13, 17, 23 }, { 2, 3, 7, 6, 10, 19, 14, 18, 22 }, { 3, 4, 8, 7, 11, 20, 15, 19, 24 },
    { 4, 1, 5, 8, 12, 17, 16, 20, 21 } }
  local function side_key(cell, face)
    local list = {}
    for k = 1, full and 9 or 8 do list[k] = ("%06d"):format(cell[face[k]]) end
    table.sort(list)
    return table.concat(list, " ")
  end
  for _, cell in ipairs(thick) do
    for _, face in ipairs(kFaces) do sides[side_key(cell, face)] = true end
  end
  local between = {}
  for _, cell in ipairs(thin) do
    check.equal(cell.type, solid)
    check.equal(#cell, nodes)
    check.that(sides[side_key(cell, kBottom)] and sides[side_key(cell, kTop)], "the interface conforms")
    for k = 1, full and 9 or 8 do
      check.equal(of[cell[kBottom[k]]], "a")
      check.equal(of[cell[kTop[k]]], "b")
      local low, high = deck.points[cell[kBottom[k]] + 1], deck.points[cell[kTop[k]] + 1]
      check.equal(key_of_place(low), key_of_place(high))
    end
    -- The other nodes are of no neighbour, and lie where the two they stand between are.
    local upright = { [17] = 1, [18] = 2, [19] = 3, [20] = 4, [21] = 12, [22] = 10, [23] = 9, [24] = 11,
      [27] = 25 }
    for k, low in pairs(upright) do
      if k <= nodes then
        check.that(not of[cell[k]], "a node of its own")
        local pair = cell[low]
        check.that(not between[cell[k]] or between[cell[k]] == pair, "cells share the node between two nodes")
        between[cell[k]], used[cell[k]] = pair, true
        check.equal(key_of_place(deck.points[cell[k] + 1]), key_of_place(deck.points[pair + 1]))
      end
    end
  end
  check.equal(size(between), full and 25 or 9)
  check.equal(size(used), split.nodes, "every node is one of a cell")
  -- The nodes that the mesh gives are those of the file.
  for n = 1, split.nodes, 7 do
    local x, y, z = split:node(n)
    check.equal(key_of_place { x, y, z }, key_of_place(deck.points[n]))
  end
  local places = split:coordinates()
  check.equal(places.rows, split.nodes)
  for n, x, y, z in places:each() do check.equal(key_of_place { x, y, z }, key_of_place(deck.points[n])) end
  -- Periodic pairs hold all nodes of the cells on the two faces.
  local function members(name)
    local list = {}
    for n in read(at "thin.vtk"):match("\nnodes:" .. name .. " [^\n]*\n([^\n]*)"):gmatch "%d+" do
      list[#list + 1] = deck.points[tonumber(n) + 1]
    end
    return list
  end
  local near, image, on_face = members "periodic_1_a", members "periodic_1_b", 0
  check.equal(#near, #image)
  for k, p in ipairs(near) do
    check.equal(key_of_place { p[1], p[2] + 1, p[3] }, key_of_place(image[k]))
  end
  for _, p in ipairs(deck.points) do on_face = on_face + (math.abs(p[2]) < 1e-9 and 1 or 0) end
  check.equal(#near, on_face)

  -- Round trips: the same cells from every format that holds them.
  local plain = lacuna.split_interface(blocks(full), { faces = "all", name = "glue" })
  plain:write(at "thin.vtk", { binary = false })
  local endings = full and { "msh", "vtu", "exo" } or { "msh", "vtu", "exo", "bdf", "unv" }
  if pcall(plain.write, plain, at "thin.med") then endings[#endings + 1] = "med" end
  local function shape_of(path)
    local own = vtk(path)
    local list = {}
    for _, cell in ipairs((thin_cells(own))) do
      local row = { cell.type }
      for _, n in ipairs(cell) do row[#row + 1] = n .. " at " .. key_of_place(own.points[n + 1]) end
      list[#list + 1] = table.concat(row, ", ")
    end
    table.sort(list)
    return table.concat(list, "\n"), #own.points
  end
  local expected = shape_of(at "thin.vtk")
  for _, ending in ipairs(endings) do
    plain:write(at("thin." .. ending))
    lacuna.convert(at("thin." .. ending), at "back.vtk", { binary = false })
    local found, points = shape_of(at "back.vtk")
    check.equal(found, expected, ending)
    check.equal(points, plain.nodes, ending)
  end
  plain:write(at "thin.feb")
  local feb = read(at "thin.feb")
  check.that(feb:find(('<Elements type="hex%d" name="glue'):format(nodes)), "FEBio")
  -- Formats that have no such element say so.
  for _, ending in ipairs { "inp", "k" } do
    check.fails(function() plain:write(at("no." .. ending)) end,
      "no element of " .. nodes .. " nodes without", '"none"', ".med")
  end
end
-- Junctions, the tip of a crack, and layers.
do
  local cross = blocks(false, nil, { a = { 0, 1, 0, 1, 0, 1 }, b = { 1, 2, 0, 1, 0, 1 },
    c = { 1, 2, 1, 2, 0, 1 }, d = { 0, 1, 1, 2, 0, 1 } })
  local function counts(faces)
    lacuna.split_interface(cross, { faces = faces }):write(at "cross.vtk", { binary = false })
    local deck, on_line, own = vtk(at "cross.vtk"), {}, {}
    local thin, thick = thin_cells(deck)
    local of_cells = {}
    for _, cell in ipairs(thick) do for _, n in ipairs(cell) do of_cells[n] = true end end
    for n, p in ipairs(deck.points) do
      if math.abs(p[1] - 1) + math.abs(p[2] - 1) < 1e-9 then
        local key = key_of_place(p)
        on_line[key] = (on_line[key] or 0) + (of_cells[n - 1] and 1 or 0)
        own[key] = (own[key] or 0) + (of_cells[n - 1] and 0 or 1)
      end
    end
    check.equal(size(on_line), 5, "corners and middle nodes of two layers")
    local corner, middle = key_of_place { 1, 1, 0 }, key_of_place { 1, 1, 0.25 }
    check.equal(own[middle] or 0, 0, "no node between middle nodes of cells of 20 nodes")
    check.equal(on_line[corner], on_line[middle], "middle nodes are doubled like corners")
    return on_line[corner], own[corner], #thin
  end
  local function expect(faces, doubled, between, cells)
    local d, b, c = counts(faces)
    check.equal(d, doubled)
    check.equal(b, between)
    check.equal(c, cells)
  end
  expect("all", 4, 4, 16)
  expect({ { "a", "b" } }, 1, 1, 4) -- the tip: one node, and the middle node of the last cells
  expect({ { "a", "b" }, { "c", "d" } }, 2, 1, 8) -- both pairs of cells stand between the same two nodes
  expect({ { "a", "b" }, { "b", "c" } }, 2, 1, 8)
  local single = block_model { 0, 1, 0, 1, 0, 1 }:open_volume { source = "source", target = "target",
    walls = { "south", "north", "west", "east" } }:sweep { layers = 3, size = 0.5, order = 2 }
  local plies = lacuna.split_interface(single, { faces = { 1, 2 } })
  check.equal(plies.interface_cells, 8)
  check.equal(plies.nodes, single.nodes + 2 * (25 + 25))
end

-- --- CalculiX --------------------------------------------------------------------------------------------

if params.ccx == "" then
  print "left out: calculix-ccx is not installed"
  check.done()
  return
end
local function solve(name, deck)
  check.write(at(name .. ".inp"), deck)
  local command = "cd '%s' && rm -f %s.dat && '%s' %s > %s.log 2>&1"
  os.execute(command:format(params.scratch, name, params.ccx, name, name))
  local file = io.open(at(name .. ".dat"))
  if not file then return nil end
  local found = {}
  for line in file:lines() do
    local n, x, y, z = line:match "^%s*(%d+)%s+(%S+)%s+(%S+)%s+(%S+)%s*$"
    if n then found[tonumber(n)] = { tonumber(x), tonumber(y), tonumber(z) } end
  end
  file:close()
  return found
end
local steel = [[
*MATERIAL, NAME=steel
*ELASTIC
210000., 0.3
]]
-- Two blocks pulled apart: with the doubled nodes tied to each other they are as before they were split.
local function pulled(deck, ties, sections)
  return deck:gsub("%*ELEMENT, TYPE=COH3D8.-\n%*", "*") .. steel .. sections .. ties .. [[
*STEP
*STATIC
*BOUNDARY
a_west, 1, 3
b_east, 1, 1, 0.01
*NODE PRINT, NSET=b_east
U
*END STEP
]]
end
two:write(at "one.inp")
local section = "*SOLID SECTION, ELSET=a, MATERIAL=steel\n*SOLID SECTION, ELSET=b, MATERIAL=steel\n"
local one = solve("whole", pulled(read(at "one.inp"), "", section))
check.that(one and size(one) == 9, "CalculiX solves the mesh before it is split")
glued:write(at "glued.inp")
local ties, done = {}, {}
for _, cell in pairs(abaqus(at "glued.inp").elements.COH3D8) do
  for k = 1, 4 do
    if not done[cell[k + 4]] then
      done[cell[k + 4]] = true
      for axis = 1, 3 do
        ties[#ties + 1] = ("*EQUATION\n2\n%d, %d, 1., %d, %d, -1.\n"):format(cell[k + 4], axis, cell[k], axis)
      end
    end
  end
end
local text = read(at "glued.inp"):gsub("%*ELSET, ELSET=glue\n[^*]*", "")
local tied = solve("tied", pulled(text, table.concat(ties), section))
check.that(tied, "CalculiX solves the tied mesh")
local function places(deck, found)
  local by = {}
  for n, u in pairs(found) do
    local p = deck.nodes[n]
    by[("%.6f %.6f %.6f"):format(p[1], p[2], p[3])] = u
  end
  return by
end
local before, after = places(abaqus(at "one.inp"), one), places(abaqus(at "glued.inp"), tied)
for place, u in pairs(before) do
  for axis = 1, 3 do check.near(after[place][axis], u[axis], 1e-8) end
end

-- The same at order 2, between regions and between layers: middle nodes are doubled like corners. Tied in
-- pairs they move as before.
local function second_order(whole, options, faces, region)
  options.element = "none"
  local split = lacuna.split_interface(whole, options)
  check.equal(split.interface_cells, 0)
  check.equal(split.hexes, whole.hexes)
  split:write(at "second.inp")
  whole:write(at "first.inp")
  local by, pairs_of, doubled = stacked(abaqus(at "second.inp")), {}, 0
  for _, tags in pairs(by) do
    if #tags > 1 then
      doubled = doubled + 1
      for axis = 1, 3 do
        pairs_of[#pairs_of + 1] = ("*EQUATION\n2\n%d, %d, 1., %d, %d, -1.\n"):format(tags[2], axis, tags[1],
          axis)
      end
    end
  end
  check.equal(doubled, split.nodes - whole.nodes)
  local function deck(name, ties)
    local sections = ""
    for _, one in ipairs(region) do
      sections = sections .. "*SOLID SECTION, ELSET=" .. one .. ", MATERIAL=steel\n"
    end
    return read(at(name .. ".inp")) .. steel .. sections .. ties .. ([[
*STEP
*STATIC
*BOUNDARY
FROM, 1, 3
TO, 1, 3, 0.01
*NODE PRINT, NSET=TO
U
*END STEP
]]):gsub("FROM", faces[1]):gsub("TO", faces[2])
  end
  local before = solve("before", deck("first", ""))
  local after = solve("after", deck("second", table.concat(pairs_of)))
  check.that(before and after and size(before) == size(after) and size(after) > 9)
  local deck_before, deck_after = abaqus(at "first.inp"), abaqus(at "second.inp")
  local here = places(deck_before, before)
  for place, u in pairs(places(deck_after, after)) do
    for axis = 1, 3 do check.near(u[axis], here[place][axis], 1e-8) end
  end
  -- Every node is one of a cell.
  local sides = {}
  for _, cells in pairs(deck_after.elements) do
    for _, cell in pairs(cells) do
      for _, n in ipairs(cell) do sides[n] = sides[n] or cell end
    end
  end
  check.equal(size(sides), split.nodes, "every node is one of a cell")
end
second_order(quadratic, { faces = "all" }, { "a_west", "b_east" }, { "a", "b" })
second_order(ply(2, 3), { faces = { 2 } }, { "source", "target" }, { "ply" })

-- Of the names of thin layers, those that CalculiX knows (2.20: none) bend as a beam of the same section; so
-- does C3D8I.
local strip = block_model { 0, 10, 0, 1, 0, 0.2 }:open_volume { source = "source", target = "target",
  walls = { "south", "north", "west", "east" }, name = "strip" }:sweep { layers = 1, size = 0.5 }
local known = 0
for _, element in ipairs { "C3D8I", "SC8R", "CSS8", "COH3D8", "GK3D8" } do
  strip:write(at "strip.inp", { element = element })
  local found = solve("bent", read(at "strip.inp") .. steel .. [[
*SOLID SECTION, ELSET=strip, MATERIAL=steel
*STEP
*STATIC
*BOUNDARY
west, 1, 3
*CLOAD
east, 3, -0.01
*NODE PRINT, NSET=east
U
*END STEP
]])
  if found and size(found) > 0 then
    known = known + 1
    local count = size(found)
    local exact = -0.01 * count * 10 ^ 3 / (3 * 210000 * 1 * 0.2 ^ 3 / 12)
    for _, u in pairs(found) do check.near(u[3] / exact, 1, 0.03) end
  else
    check.that(element ~= "C3D8I", "CalculiX knows C3D8I")
    print(("left out: CalculiX does not know %s"):format(element))
  end
end
check.that(known > 0)
check.done()
