-- SPDX-License-Identifier: MIT
-- A void of a deck that no sweep fills is filled with pyramids and tetrahedra, and both are written as one
-- deck: its nodes, quads, numbers, sets and cards stay, and CalculiX finds one stress in all kinds of cells.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { scratch = "" }

local N = 5
local block = dofile(arg[0]:match("^(.*/)") .. "unit_block.lua")(check, params.scratch, N)

-- The void in the middle: a cell with arms to five sides. Nodes inside the block are moved, so that quads are
-- warped and no cut follows them.
local function is_void(i, j, k)
  local apart = math.abs(i - 2) + math.abs(j - 2) + math.abs(k - 2)
  return apart == 0 or (apart == 1 and k < 3)
end
local function node(i, j, k) return 10 + i + (N + 1) * (j + (N + 1) * k) end
local function place(i, j, k)
  local at = { i, j, k }
  if math.min(i, j, k) > 0 and math.max(i, j, k) < N then
    at = { i + 0.1 * math.sin(i + 2 * j + 3 * k), j + 0.1 * math.cos(3 * i - j + k),
      k + 0.1 * math.sin(i - j) }
  end
  return at[1] / N, at[2] / N, at[3] / N
end

local own = { body = {}, core = {}, shaft = {} } -- cells; the shaft leads from the void to the top
for k = 0, N - 1 do
  for j = 0, N - 1 do
    for i = 0, N - 1 do
      local cells = is_void(i, j, k) and own.core or i == 2 and j == 2 and k > 2 and own.shaft or own.body
      cells[#cells + 1] = { node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
        node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1) }
    end
  end
end

local edges = { { 1, 2 }, { 2, 3 }, { 3, 4 }, { 4, 1 }, { 5, 6 }, { 6, 7 }, { 7, 8 }, { 8, 5 }, { 1, 5 },
  { 2, 6 }, { 3, 7 }, { 4, 8 } }

--- The block as a deck. @param parts  the sets of cells that it has. @param order  of these
--- @param bend  of the middle of one side beside the void, into it
local function deck(parts, order, bend)
  local lines, tag, at, middles = { "*HEADING\na block\n*NODE" }, 10000, {}, {}
  local function add(...) lines[#lines + 1] = string.format(...) end
  for k = 0, N do
    for j = 0, N do
      for i = 0, N do
        at[node(i, j, k)] = { place(i, j, k) }
        add("%d, %.12g, %.12g, %.12g", node(i, j, k), place(i, j, k))
      end
    end
  end
  local last = node(N, N, N)
  local function with_middles(cell)
    local all = { table.unpack(cell) }
    for _, edge in ipairs(order == 2 and edges or {}) do
      local a, b = cell[edge[1]], cell[edge[2]]
      local key = math.min(a, b) .. " " .. math.max(a, b)
      if not middles[key] then
        last = last + 1
        middles[key] = last
        local is_bent = math.min(a, b) == node(1, 2, 2) and math.max(a, b) == node(1, 3, 2)
        add("%d, %.12g, %.12g, %.12g", last, (at[a][1] + at[b][1]) / 2 + (is_bent and bend or 0),
          (at[a][2] + at[b][2]) / 2, (at[a][3] + at[b][3]) / 2)
      end
      all[#all + 1] = middles[key]
    end
    return all
  end
  local cells = {}
  for _, part in ipairs(parts) do
    for k, cell in ipairs(own[part]) do cells[part .. k] = with_middles(cell) end
  end
  for _, part in ipairs(parts) do
    add("*ELEMENT, TYPE=%s, ELSET=%s", order == 2 and "C3D20" or "C3D8", part)
    for k in ipairs(own[part]) do
      tag = tag + 1
      local all = cells[part .. k]
      add("%d, %s", tag, table.concat(all, ", ", 1, math.min(#all, 10)))
      if #all > 10 then lines[#lines] = lines[#lines] .. ",\n" .. table.concat(all, ", ", 11) end
    end
  end
  add("*ELSET, ELSET=all, GENERATE\n10001, %d", tag)
  add("*MATERIAL, NAME=steel\n*ELASTIC\n210000., 0.3")
  for _, part in ipairs(parts) do add("*SOLID SECTION, ELSET=%s, MATERIAL=steel", part) end
  add("*STEP\n*STATIC\n*EL PRINT, ELSET=all\nS\n*END STEP\n")
  return table.concat(lines, "\n")
end

--- The faces of a box of cells [low, high).
local function faces_in(model, low, high)
  local box, room = { {}, {} }, 0.5 / N
  for axis = 1, 3 do box[1][axis], box[2][axis] = low[axis] / N - room, high[axis] / N + room end
  return model:faces { box = box }
end

--- The joined mesh in every format; as an Abaqus deck, with the nodes and cells that were given, solved.
local function judge(name, mesh, with)
  local hexes = mesh.hexes
  for _, part in ipairs(with.parts) do hexes = hexes + #own[part] end
  for _, ending in ipairs { "inp", "bdf", "msh", "vtu", "exo", "unv" } do
    local out = ("%s/joined_%s.%s"):format(params.scratch, name, ending)
    mesh:write(out, { with = with.model })
    local quality = lacuna.check(out)
    check.equal(quality.certified, true, ending)
    check.equal(quality.pyramids, mesh.pyramids, ending)
    check.equal(quality.tets, mesh.tets, ending)
    check.equal(quality.hexes, hexes, ending)
    check.near(quality.volume, 1, 1e-7)
  end
  local text = block.read(("%s/joined_%s.inp"):format(params.scratch, name))
  local nodes, cells = block.deck(text)
  local before, kept = block.deck(deck(with.parts, mesh.order))
  for tag, at in pairs(before) do
    for axis = 1, 3 do check.equal(nodes[tag][axis], at[axis]) end
  end
  for tag, corners in pairs(kept) do
    check.equal(table.concat(cells[tag], " "), table.concat(corners, " "))
  end
  check.equal(block.size(cells), hexes + mesh.pyramids + mesh.tets)
  local _, sections = text:gsub("SOLID SECTION, ELSET=core, MATERIAL=steel", "")
  check.equal(sections, 1)
  if block.ccx then
    local points = block.solve(name, text, nodes)
    local of_brick, of_tet = 8, 1
    if mesh.order == 2 then of_brick, of_tet = 27, 4 end
    check.equal(points, of_brick * (hexes + mesh.pyramids) + of_tet * mesh.tets)
  end
end

-- The void, or cells that are left out on loading: what fills them takes their place.
for _, case in ipairs { { "void", { "body", "shaft" }, 1 }, { "replaced", { "body", "shaft", "core" }, 1 },
  { "void_2", { "body", "shaft" }, 2 } } do
  local name, parts, order = table.unpack(case)
  local path = ("%s/%s.inp"):format(params.scratch, name)
  check.write(path, deck(parts, order))
  local model = lacuna.load(path, { without = parts[3] })
  local void = model:open_volume { faces = faces_in(model, { 1, 1, 1 }, { 4, 4, 3 }), name = "core",
    material = "steel" }
  check.equal(void:is_watertight(), true)
  local mesh = void:sweep { size = 1 / N, fallback = "mixed", order = order, serendipity = order == 2 }
  check.that(mesh.pyramids > 0 and mesh.tets > 0, mesh.hexes .. " hexahedra")
  judge(name, mesh, { model = model, parts = { "body", "shaft" } })
  if order == 2 then
    local full = void:sweep { size = 1 / N, fallback = "mixed", order = 2 }
    check.fails(function() full:write(params.scratch .. "/full.vtu", { with = model }) end, "io.mixed_order",
      "serendipity = true")
    local first = void:sweep { size = 1 / N, fallback = "mixed" }
    check.fails(function() first:write(params.scratch .. "/first.inp", { with = model }) end,
      "io.mixed_order", "order = 2")
  end
end

-- A given side that bends a little is kept; one that leaves no room for a pyramid is refused.
for _, bend in ipairs { 0.02, 0.18 } do
  local path = params.scratch .. "/bent.inp"
  check.write(path, deck({ "body", "shaft" }, 2, bend))
  local model = lacuna.load(path)
  local void = model:open_volume { faces = faces_in(model, { 1, 1, 1 }, { 4, 4, 3 }), name = "core" }
  local options = { size = 1 / N, fallback = "mixed", order = 2, serendipity = true }
  if bend < 0.1 then
    local out = params.scratch .. "/bent_joined.vtu"
    void:sweep(options):write(out, { with = model })
    check.equal(lacuna.check(out).certified, true)
  else
    check.fails(function() void:sweep(options) end, "fill.second_order", "order = 1")
  end
end

-- The shaft is missing too. It is swept, and the void below it gets a pyramid on its quad.
for order = 1, 2 do
  local path = params.scratch .. "/shaft.inp"
  check.write(path, deck({ "body" }, order))
  local model = lacuna.load(path)
  local is_of_shaft, void = {}, {}
  local shaft = faces_in(model, { 2, 2, 3 }, { 3, 3, 5 })
  for _, face in ipairs(shaft) do is_of_shaft[face.tag] = true end
  for _, face in ipairs(faces_in(model, { 1, 1, 1 }, { 4, 4, 3 })) do
    if not is_of_shaft[face.tag] then void[#void + 1] = face end
  end
  local mesh = lacuna.assembly {
    model:open_volume { walls = shaft, name = "shaft", material = "steel" },
    model:open_volume { faces = void, name = "core", material = "steel" },
  }:sweep { size = 1 / N, fallback = "mixed", order = order, serendipity = order == 2 }
  check.equal(mesh.hexes, 2)
  check.that(mesh.pyramids > 0 and mesh.tets > 0, "no tetrahedra")
  judge("several_" .. order, mesh, { model = model, parts = { "body" } })
end
check.done()
