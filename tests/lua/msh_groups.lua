-- SPDX-License-Identifier: MIT
-- Groups of .msh files do not overlap, whoever writes them; pieces of one void are one region; an .msh that
-- is turned into a deck keeps its regions apart, and its skin becomes no shells.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "." }

local function path(name) return params.scratch .. "/" .. name end
local function read(name)
  local file <close> = assert(io.open(name, "rb"))
  return file:read("a")
end

-- --- an .msh as it lies in the file

local nodes_of = { [2] = 3, [3] = 4, [5] = 8, [6] = 6, [10] = 9, [12] = 27, [16] = 8, [17] = 20 }
local flat = { [2] = true, [3] = true, [10] = true, [16] = true }

-- Reads numbers of a section, as text or as they lie.
local function cursor(text, at, binary)
  local self = {}
  function self.number(kind)
    if binary then
      local value
      value, at = string.unpack("<" .. kind, text, at)
      return value
    end
    local _, last, word = text:find("(%S+)", at)
    at = last + 1
    return tonumber(word)
  end
  function self.skip(bytes, numbers)
    if binary then
      at = at + bytes
    else
      for _ = 1, numbers do _, at = text:find("%S+", at) at = at + 1 end
    end
  end
  return self
end

-- { { dim =, groups = { names }, cells = } … }: the entities that have cells, with all their groups; in
-- version 2.2 one for each pair of group and entity.
local function entities_of(name)
  local text = read(name)
  local version, binary = text:match "^%$MeshFormat\n(%S+) (%d)"
  binary = binary == "1"
  local names = {}
  local said = text:match "%$PhysicalNames\n(.-)%$EndPhysicalNames"
  for dim, tag, label in said:gmatch '(%d+) (%d+) "(.-)"\n' do
    check.that(not names[dim .. " " .. tag], "a tag twice")
    names[dim .. " " .. tag] = label
  end
  local found, order = {}, {}
  local function entity(dim, tag, groups, more)
    local key = dim .. " " .. tag .. more
    if not found[key] then
      found[key] = { dim = dim, groups = groups, cells = 0 }
      order[#order + 1] = found[key]
    end
    return found[key]
  end
  local function label(dim, tag) return names[dim .. " " .. tag] or "physical " .. tag end
  local start = select(2, text:find("\n$Elements\n", 1, true)) + 1
  if version == "2.2" then
    local _, last, count = text:find("^(%d+)\n", start)
    local from, done = cursor(text, last + 1, binary), 0
    while done < tonumber(count) do
      if not binary then from.number() end
      local kind = from.number "i4"
      local many = binary and from.number "i4" or 1
      check.equal(from.number "i4", 2, "tags of a cell")
      for _ = 1, many do
        if binary then from.number "i4" end
        local physical, own = from.number "i4", from.number "i4"
        from.skip(4 * nodes_of[kind], nodes_of[kind])
        local dim = flat[kind] and 2 or 3
        local at = entity(dim, own, { label(dim, physical) }, " " .. physical)
        at.cells = at.cells + 1
      end
      done = done + many
    end
    return order
  end
  local whole = {}
  for _, section in ipairs { "Entities", "PartitionedEntities" } do
    local _, last = text:find("\n$" .. section .. "\n", 1, true)
    if last then
      local from = cursor(text, last + 1, binary)
      local parts = section ~= "Entities"
      if parts then
        from.number "I8"
        for _ = 1, 2 * from.number "I8" do from.number "i4" end
      end
      local counts = { from.number "I8", from.number "I8", from.number "I8", from.number "I8" }
      for dim = 1, 3 do
        for _ = 1, counts[dim + 1] do
          local tag = from.number "i4"
          if parts then
            from.number "i4" from.number "i4"
            for _ = 1, from.number "I8" do from.number "i4" end
          end
          from.skip(48, 6)
          local groups = {}
          for k = 1, from.number "I8" do groups[k] = label(dim, from.number "i4") end
          for _ = 1, from.number "I8" do from.number "i4" end
          whole[dim .. " " .. tag] = groups
        end
      end
    end
  end
  local from = cursor(text, start, binary)
  local blocks = from.number "I8"
  from.skip(24, 3)
  for _ = 1, blocks do
    local dim, tag, kind, many = from.number "i4", from.number "i4", from.number "i4", from.number "I8"
    from.skip(8 * many * (nodes_of[kind] + 1), many * (nodes_of[kind] + 1))
    local at = entity(dim, tag, whole[dim .. " " .. tag], "")
    at.cells = at.cells + many
  end
  return order
end

-- { [dim] = { [group] = cells } } of a file in which no cell is in two groups of a dimension, or in none.
local function disjoint(name)
  local cells = { [2] = {}, [3] = {} }
  for _, entity in ipairs(entities_of(name)) do
    check.equal(#entity.groups, 1, name .. ": groups " .. table.concat(entity.groups, ", "))
    local group = entity.groups[1]
    cells[entity.dim][group] = (cells[entity.dim][group] or 0) + entity.cells
  end
  return cells
end
local function sum(cells)
  local all = 0
  for _, count in pairs(cells) do all = all + count end
  return all
end
local function names(cells)
  local all = {}
  for name in pairs(cells) do all[#all + 1] = name end
  table.sort(all)
  return table.concat(all, " ")
end

-- { [name] = cells } of mesh:groups() of a dimension.
local function groups_of(mesh, dim)
  local cells = {}
  for _, group in ipairs(mesh:groups()) do
    if group.dim == dim then
      check.that(not cells[group.name], group.name .. " is there twice")
      cells[group.name] = group.cells
    end
  end
  return cells
end

local formats = {
  {}, { binary = false }, { version = 2.2 }, { version = 2.2, binary = false },
}

-- --- boxes

-- Faces of a box with names: bottom, top and four sides; those named false are left out.
local function box(low, high, labels)
  local model = lacuna.model()
  local corners = {}
  for k = 0, 7 do
    corners[k + 1] = {}
    for axis = 1, 3 do corners[k + 1][axis] = (k >> (axis - 1)) % 2 == 0 and low[axis] or high[axis] end
  end
  for k, c in ipairs { { 1, 3, 4, 2 }, { 5, 6, 8, 7 }, { 1, 2, 6, 5 }, { 2, 4, 8, 6 }, { 4, 3, 7, 8 },
    { 3, 1, 5, 7 } } do
    local points = {}
    for i = 1, 4 do points[i] = corners[c[i]] end
    if labels[k] ~= false then
      local name = labels[k] ~= "" and labels[k] or nil
      model:add_face { name = name, points = points, cells = { { 1, 2, 3, 4 } } }
    end
  end
  return model
end
local function volume_of(model, name)
  local faces = model:faces()
  local walls = {}
  for k = 3, #faces do walls[#walls + 1] = faces[k] end
  return model:open_volume { source = faces[1], target = faces[2], walls = walls, name = name }
end

-- --- one void: a region has its name, a face the name it was given, else its role

local random = check.random(7)
local function pick(list) return list[1 + math.floor(random(0, #list - 1e-9))] end
for member = 1, 24 do
  local labels, expected = {}, {}
  for k = 1, 6 do
    labels[k] = pick { "", "inlet", "hot side", "wall_" .. k, k == 1 and "source" or "rim" }
    local role = k == 1 and "source" or k == 2 and "target" or "wall:" .. k
    local name = labels[k] == "" and role or labels[k]
    expected[name] = (expected[name] or 0) + (k < 3 and 4 or 6)
  end
  local same = true
  for k = 2, 6 do same = same and labels[k] == labels[1] end
  local name = pick { "", "resin", "hot side" }
  local mesh = volume_of(box({ 0, 0, 0 }, { 1, 1, 1 }, labels), name ~= "" and name or nil)
    :sweep { size = 0.5, layers = 3, order = 1 + member % 2, serendipity = member % 4 == 1 or nil }
  for i, format in ipairs(formats) do
    local file = path("one." .. i .. ".msh")
    mesh:write(file, format)
    local cells = disjoint(file)
    if not same then
      for group, count in pairs(expected) do check.equal(cells[2][group], count, group) end
    end
    check.equal(sum(cells[2]), 2 * 4 + 4 * 6)
    check.equal(names(cells[3]), name ~= "" and name or "volume")
    check.equal(sum(cells[3]), mesh.hexes)
    check.equal(lacuna.check(file).hexes, mesh.hexes)
  end
  -- mesh:groups() has all; with groups = "all" the file has.
  local all, skin = groups_of(mesh, 3), groups_of(mesh, 2)
  for _, role in ipairs { "source", "target", "wall:3", "wall:6" } do check.that(skin[role], role) end
  local file = path "all.msh"
  mesh:write(file, { groups = "all" })
  local found = { [2] = {}, [3] = {} }
  for _, entity in ipairs(entities_of(file)) do
    for _, group in ipairs(entity.groups) do
      found[entity.dim][group] = (found[entity.dim][group] or 0) + entity.cells
    end
  end
  for dim, groups in pairs { [2] = skin, [3] = all } do
    check.equal(names(found[dim]), names(groups))
    for group, count in pairs(groups) do check.equal(found[dim][group], count, group) end
  end
end

-- A name that all faces have, whatever their role, tells none apart: then their roles do.
local mesh = volume_of(box({ 0, 0, 0 }, { 1, 1, 1 }, { "b", "b", "b", "b", "b", "b" })):sweep { size = 0.5 }
mesh:write(path "alike.msh")
check.equal(names(disjoint(path "alike.msh")[2]), "source target wall:3 wall:4 wall:5 wall:6")
check.equal(groups_of(mesh, 2).b, 6 * 4)
check.fails(function() mesh:write(path "a.inp", { groups = "all" }) end, "groups")
check.fails(function() mesh:write(path "a.msh", { groups = "some" }) end, "groups", "all")

-- Streamed, in parts, and facets; a void face has its role too.
for i, format in ipairs { {}, { version = 2.2 }, { partitions = 3 },
  { partitions = 2, ghosts = 1, binary = false } } do
  local void = volume_of(box({ 0, 0, 0 }, { 1, 1, 2 }, { "", "inlet", "", "left", false, "" }), "gel")
  local file = path("streamed." .. i .. ".msh")
  void:sweep_to(file, { size = 0.5, layers = 4, write = format })
  local cells = disjoint(file)
  check.equal(names(cells[2]), "inlet left source void:1 wall:3 wall:5")
  check.equal(names(cells[3]), "gel")
  for _, binary in ipairs { true, false } do
    void:write_facets(path "facets.msh", { binary = binary })
    check.equal(names(disjoint(path "facets.msh")[2]), "inlet left source void:1 wall:3 wall:5")
  end
end
do -- what 2.2 cannot hold is said
  local recipe = path "old.lua"
  check.write(recipe, ([[
    local lacuna = require "lacuna"
    local mesh = lacuna.synthetic.prism { sides = 4 }:open_volume {}:sweep { size = 1 }
    mesh:write("old.msh", { version = 2.2, groups = "all" })
  ]]))
  local code, _, said = check.run(params.lacuna, params.scratch, { "old.lua" })
  check.equal(code, 0, said)
  check.that(said:find("note: [^\n]*2%.2 holds one group"), said)
  disjoint(path "old.msh")
end

-- --- a void that is swept in pieces is one region

-- What stands in a box: `count` blocks of rising heights in a row on its floor.
local function boxed(count)
  local model = lacuna.model()
  local function quad(name, a, b, c, d)
    model:add_face { name = name, points = { a, b, c, d }, cells = { { 1, 2, 3, 4 } } }
  end
  local function sides(name, low, high, z1, z2)
    local ring = { { low[1], low[2] }, { high[1], low[2] }, { high[1], high[2] }, { low[1], high[2] } }
    for k = 1, 4 do
      local a, b = ring[k], ring[k % 4 + 1]
      quad(name .. k, { a[1], a[2], z1 }, { b[1], b[2], z1 }, { b[1], b[2], z2 }, { a[1], a[2], z2 })
    end
  end
  local length = 3 * count + 1
  local points, cells = { { 0, 0, 0 }, { length, 0, 0 }, { length, 4, 0 }, { 0, 4, 0 } }, {}
  local function add(x, y) points[#points + 1] = { x, y, 0 } return #points end
  -- The floor between the blocks, and in front of and behind them.
  local function flat_cell(x1, x2, y1, y2)
    cells[#cells + 1] = { add(x1, y1), add(x2, y1), add(x2, y2), add(x1, y2) }
  end
  for k = 0, 2 * count do
    local low, high = k // 2 * 3 + (k % 2), k // 2 * 3 + (k % 2 == 0 and 1 or 3)
    flat_cell(low, high, 0, 1)
    if k % 2 == 0 then flat_cell(low, high, 1, 3) end
    flat_cell(low, high, 3, 4)
  end
  model:add_face { name = "floor", points = points, cells = cells }
  quad("lid", { 0, 0, 6 }, { length, 0, 6 }, { length, 4, 6 }, { 0, 4, 6 })
  sides("side_", { 0, 0 }, { length, 4 }, 0, 6)
  local source = { "floor" }
  for k = 1, count do
    local low, high, top = { 3 * k - 2, 1 }, { 3 * k, 3 }, k
    quad("top_" .. k, { low[1], low[2], top }, { high[1], low[2], top }, { high[1], high[2], top },
      { low[1], high[2], top })
    sides("skin_" .. k .. "_", low, high, 0, top)
    source[#source + 1] = "top_" .. k
  end
  return model, source
end

local function ring_of(name)
  local model, n = lacuna.model(), 24
  local section = { { 3, -0.5 }, { 4, -0.5 }, { 4, 0.5 }, { 3, 0.5 } }
  for w = 1, 4 do
    local points, cells = {}, {}
    for i = 0, n - 1 do
      local a = 2 * math.pi * i / n
      for _, k in ipairs { w, w % 4 + 1 } do
        local r, z = section[k][1], section[k][2]
        points[#points + 1] = { r * math.cos(a), r * math.sin(a), z }
      end
      local j = (i + 1) % n
      cells[#cells + 1] = { 2 * i + 1, 2 * i + 2, 2 * j + 2, 2 * j + 1 }
    end
    model:add_face { name = w == 1 and "seal" or nil, points = points, cells = cells }
  end
  return model:open_volume { full_turn = true, name = name }
end

-- Cells of the sets of elements of an Abaqus deck, and the kinds of its elements.
local function sets_of(name)
  local sets, kinds, set, elements, goes_on = {}, {}, nil, false, false
  for line in io.lines(name) do
    if line:find "^%*" then
      set = (line:lower():match "elset=([^,]+)")
      elements = line:lower():find "^%*element" ~= nil
      local kind = line:match "TYPE=([^,]+)"
      if elements then kinds[kind] = (kinds[kind] or 0) end
      if set then sets[set] = sets[set] or {} end
    elseif set then
      if elements then
        if not goes_on then sets[set][tonumber(line:match "%d+")] = true end
        goes_on = line:find ",$" ~= nil
      else
        for number in line:gmatch "%d+" do sets[set][tonumber(number)] = true end
      end
    end
  end
  local count = {}
  for of, members in pairs(sets) do
    count[of] = 0
    for _ in pairs(members) do count[of] = count[of] + 1 end
  end
  return count, kinds
end

-- Two names and that of all cells, in order.
local function with_all(a, b)
  local all = { a, b, "volume" }
  table.sort(all)
  return table.concat(all, " ")
end

local function check_pieces(made, name, whole)
  check.that(#made.regions >= 1)
  local solid, skin = groups_of(made, 3), groups_of(made, 2)
  check.equal(names(solid), name == "volume" and "volume" or name .. " volume")
  for group, cells in pairs(solid) do check.equal(cells, made.hexes, group) end
  for group in pairs(skin) do check.that(not group:find "_%d+:" and not group:find "^cut_", group) end
  for i, format in ipairs(formats) do
    made:write(path("pieces." .. i .. ".msh"), format)
    local cells = disjoint(path("pieces." .. i .. ".msh"))
    check.equal(names(cells[3]), name)
    check.equal(sum(cells[3]), made.hexes)
    if whole then check.equal(names(cells[2]), whole) end
  end
  for _, ending in ipairs { "inp", "vtu", "unv", "exo", "bdf" } do made:write(path("pieces." .. ending)) end
  local sets = sets_of(path "pieces.inp")
  check.equal(sets[name:lower()], made.hexes)
  for set in pairs(sets) do
    check.that(not set:find("^" .. name:lower() .. "_%d") and not set:find "^piece_", set)
  end
  check.equal(lacuna.check(path "pieces.1.msh").hexes, made.hexes)
end

for count = 1, 3 do
  for _, turned in ipairs { false, true } do
    local model, source = boxed(count)
    local walls = {}
    for _, face in ipairs(model:faces()) do
      if face.name:find "^s" then walls[#walls + 1] = face end
    end
    for _, name in ipairs { "resin", "" } do
      local function void()
        return model:open_volume { source = turned and "lid" or source, target = turned and source or "lid",
          walls = walls, name = name ~= "" and name or nil }
      end
      local made = void():sweep { size = 1, layers = 6, quads = "paved" }
      check.equal(#made.regions, count + 1)
      check_pieces(made, name ~= "" and name or "volume")
      -- The ends are those of the void, whichever piece they bound.
      local skin = groups_of(made, 2)
      local ends = 0
      for _, end_of in ipairs(source) do ends = ends + skin[end_of] end
      check.equal(skin[turned and "target" or "source"], ends)
      check.equal(skin[turned and "source" or "target"], skin.lid)
      void():sweep_to(path "pieces.to.msh", { size = 1, layers = 6, quads = "paved" })
      check.equal(names(disjoint(path "pieces.to.msh")[3]), name ~= "" and name or "volume")
    end
  end
end
check_pieces(ring_of "seat":sweep { size = 0.4 }, "seat", "seal wall:2 wall:3 wall:4")
check_pieces(ring_of():sweep { size = 0.4 }, "volume", "seal wall:2 wall:3 wall:4")

-- --- assemblies: roles are told apart by the member's name

local unnamed = { "", "", "", "", "", "" }
local function slab(z, name, labels)
  return volume_of(box({ 0, 0, z }, { 1, 1, z + 1 }, labels or unnamed), name)
end
do
  local model, source = boxed(1)
  local walls = {}
  for _, face in ipairs(model:faces()) do
    if face.name:find "^s" then walls[#walls + 1] = face end
  end
  local stepped = model:open_volume { source = source, target = "lid", walls = walls, name = "resin" }
  local over = volume_of(box({ 0, 0, 6 }, { 4, 4, 7 }, { "", "outlet", "", "", "", "" }), "air")
  local function second() return slab(1, "fluid2", { "", "", "", "rim", "", "" }) end
  local first = slab(0, "fluid1")
  for _, both in ipairs {
    lacuna.assembly { stepped, over }:sweep { size = 1, quads = "paved" },
    lacuna.assembly { first, second() }:sweep { size = 0.5 },
    lacuna.assembly { first, second() }:sweep { size = 0.5, order = 2, serendipity = true },
    lacuna.assembly { slab(0, "fluid1"):sweep { size = 0.5 }, second() }:sweep { size = 0.5 },
  } do
    local one, two = "fluid1", "fluid2"
    if groups_of(both, 3).resin then one, two = "air", "resin" end
    local solid, skin = groups_of(both, 3), groups_of(both, 2)
    check.equal(names(solid), with_all(one, two))
    check.equal(solid[one] + solid[two], both.hexes)
    check.that(skin["fluid1:source"] and skin["fluid2:target"] or skin["air:source"], "ends of members")
    for group in pairs(skin) do
      check.that(group ~= "source" and group ~= "target" and not group:find "^wall:", group)
      check.that(not group:find(one .. ":" .. one, 1, true), group)
    end
    for i, format in ipairs { {}, { binary = false }, { version = 2.2 }, { interfaces = true },
      { partitions = 2 } } do
      local file = path("assembly." .. i .. ".msh")
      both:write(file, format)
      local cells = disjoint(file)
      check.equal(names(cells[3]), one .. " " .. two)
      check.equal(cells[3][one], solid[one])
      check.equal(cells[3][two], solid[two])
      if one == "fluid1" then
        check.equal(cells[2].rim, skin.rim)
        check.that(cells[2]["fluid1:source"] and cells[2]["fluid2:target"], names(cells[2]))
      end
    end
    both:write(path "assembly.all.msh", { groups = "all" })
    -- Again as it came: names do not pile up.
    if one == "fluid1" and both.order == 1 then
      local more = lacuna.assembly { both, slab(2, "fluid3") }:sweep { size = 0.5 }
      check.that(groups_of(more, 2)["fluid1:source"] and groups_of(more, 2).rim, "kept")
      for group in pairs(groups_of(more, 2)) do check.that(not group:find ":.*:.*:", group) end
    end

    -- An .msh as a deck: its regions apart, its skin sets.
    for _, from in ipairs { "assembly.1.msh", "assembly.3.msh", "assembly.4.msh", "assembly.all.msh" } do
      lacuna.convert(path(from), path "turned.inp")
      local sets, kinds = sets_of(path "turned.inp")
      check.equal(sets[one], solid[one], from)
      check.equal(sets[two], solid[two], from)
      for kind in pairs(kinds) do check.that(kind:find "^C3D", "elements " .. kind) end
      local text = read(path "turned.inp")
      check.that(text:find "%*SURFACE" and text:find "%*NSET", from)
      check.that(text:find(one == "fluid1" and "NAME=fluid1_source" or "NAME=floor"), from)
      lacuna.convert(path(from), path "turned.bdf")
      check.that(not read(path "turned.bdf"):find "CQUAD", from)
      lacuna.convert(path(from), path "turned.exo")
      check.that(not read(path "turned.exo"):find "SHELL", from)
      for _, ending in ipairs { "inp", "exo" } do
        local back = lacuna.load(path("turned." .. ending))
        local source = ending == "inp" and "fluid1_source" or "fluid1:source"
        if one == "fluid1" then check.equal(#back:faces { name = source }, 1, ending) end
      end
      -- The page shows them by name.
      lacuna.view(path(from), path "turned.html")
      for _, region in ipairs { one, two } do
        check.that(read(path "turned.html"):find('"name":"' .. region .. '"', 1, true), region)
      end
      lacuna.convert(path(from), path "again.msh")
      check.equal(names(disjoint(path "again.msh")[3]), one .. " " .. two)
    end
  end
end

-- Shells stay shells: of a surface alone, and those that lie on no solid.
slab(0, "a"):write_facets(path "shell.msh")
lacuna.convert(path "shell.msh", path "shell.inp")
check.equal(names(select(2, sets_of(path "shell.inp"))), "S3")

-- Regions that have numbers alone, or none of their own, stay apart too.
check.write(path "numbers.msh", [[
$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
12
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
9 0 0 2
10 1 0 2
11 1 1 2
12 0 1 2
$EndNodes
$Elements
4
1 3 2 0 1 1 2 3 4
2 3 2 0 9 1 2 6 5
3 5 2 0 1 1 2 3 4 5 6 7 8
4 5 2 0 2 5 6 7 8 9 10 11 12
$EndElements
]])
lacuna.convert(path "numbers.msh", path "numbers.inp")
local sets, kinds = sets_of(path "numbers.inp")
check.equal(sets.volume_1, 1)
check.equal(sets.volume_2, 1)
check.equal(names(kinds), "C3D8")

-- --- a deck and what fills its void

for _, ending in ipairs { "inp", "bdf", "msh" } do
  local blocks = lacuna.assembly { slab(0, "below"), slab(2, "above") }:sweep { size = 0.5, layers = 2 }
  local file = path("deck." .. ending)
  blocks:write(file)
  local model = lacuna.load(file)
  local function at(z) return { box = { { -0.1, -0.1, z - 0.1 }, { 1.1, 1.1, z + 0.1 } } } end
  local filled = model:open_volume { source = at(1), target = at(2), name = "glue" }:sweep { layers = 2 }
  for i, format in ipairs { {}, { version = 2.2 }, { binary = false } } do
    format.with = model
    local joined = path("joined." .. i .. ".msh")
    filled:write(joined, format)
    local cells = disjoint(joined)
    check.equal(cells[3].glue, filled.hexes, ending)
    check.equal(sum(cells[3]), filled.hexes + blocks.hexes)
    if ending ~= "bdf" then check.equal(names(cells[3]), "above below glue") end
    check.equal(lacuna.check(joined).hexes, filled.hexes + blocks.hexes)
  end
  filled:write(path "joined.inp", { with = model })
  local joined, types = sets_of(path "joined.inp")
  check.equal(joined.glue, filled.hexes)
  check.equal(names(types), "C3D8")
end

-- A void in a deck that is swept in pieces joins it as one region: over a floor with a pillar on it, between
-- four sides and a lid.
do
  local function solid(low, high, name) return volume_of(box(low, high, unnamed), name) end
  local mould = lacuna.assembly {
    solid({ 0, 0, -1 }, { 4, 4, 0 }, "floor"), solid({ 1, 1, 0 }, { 3, 3, 1 }, "pillar"),
    solid({ 0, 0, 3 }, { 4, 4, 4 }, "lid"), solid({ -1, 0, 0 }, { 0, 4, 3 }, "left"),
    solid({ 4, 0, 0 }, { 5, 4, 3 }, "right"), solid({ 0, -1, 0 }, { 4, 0, 3 }, "front"),
    solid({ 0, 4, 0 }, { 4, 5, 3 }, "back"),
  }:sweep { size = 1 }
  for _, ending in ipairs { "inp", "bdf", "msh" } do
    mould:write(path("mould." .. ending))
    local model = lacuna.load(path("mould." .. ending))
    local function within(x1, x2, y1, y2, z1, z2, area)
      local e = 0.01
      local low, high = { x1 - e, y1 - e, z1 - e }, { x2 + e, y2 + e, z2 + e }
      return { box = { low, high }, area = { area - e, area + e } }
    end
    local void = model:open_volume { name = "resin",
      source = { model:face(within(0, 4, 0, 4, 0, 0, 12)), model:face(within(1, 3, 1, 3, 1, 1, 4)) },
      target = within(0, 4, 0, 4, 3, 3, 16),
      walls = { within(1, 1, 1, 3, 0, 1, 2), within(3, 3, 1, 3, 0, 1, 2), within(1, 3, 1, 1, 0, 1, 2),
        within(1, 3, 3, 3, 0, 1, 2), within(0, 0, 0, 4, 0, 3, 12), within(4, 4, 0, 4, 0, 3, 12),
        within(0, 4, 0, 0, 0, 3, 12), within(0, 4, 4, 4, 0, 3, 12) } }
    local made = void:sweep { layers = 3, size = 1 }
    check.equal(#made.regions, 2)
    check.equal(names(groups_of(made, 3)), "resin volume")
    check.equal(groups_of(made, 2).source, 16)
    check.equal(groups_of(made, 2).target, 16)
    made:write(path "filled.inp", { with = model })
    local sets = sets_of(path "filled.inp")
    check.equal(sets.resin, made.hexes, ending)
    for set in pairs(sets) do check.that(not set:find "^resin_", set) end
    made:write(path "filled.msh", { with = model })
    local cells = disjoint(path "filled.msh")
    check.equal(cells[3].resin, made.hexes)
    check.equal(sum(cells[3]), made.hexes + mould.hexes)
    for region in pairs(cells[3]) do check.that(not region:find "^resin_", region) end
    made:write(path "filled.bdf", { with = model })
    check.equal(select(2, read(path "filled.bdf"):gsub(" of resin\n", "")), ending == "bdf" and 1 or 0)
  end
end
check.done()
