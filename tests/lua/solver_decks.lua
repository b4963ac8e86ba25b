-- SPDX-License-Identifier: MIT
-- Decks of LS-DYNA and files of FEBio, read by small parsers of their own by the rules of the keyword
-- references; round trips of decks keep numbers and sets; damaged decks are errors.
-- usage: lacuna solver_decks.lua scratch=FOLDER
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { scratch = ".", lacuna = "" }
local function at(name) return params.scratch .. "/" .. name end
local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end

local function sub(a, b) return { a[1] - b[1], a[2] - b[2], a[3] - b[3] } end
local function cross(a, b)
  return { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] }
end
local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end
-- Six times the volume under a polygon seen from the origin.
local function under(points)
  local sum = 0
  for k = 2, #points - 1 do sum = sum + dot(points[1], cross(points[k], points[k + 1])) end
  return sum
end
local faces = { { 1, 4, 3, 2 }, { 5, 6, 7, 8 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 4, 8, 7 },
  { 4, 1, 5, 8 } }
-- The volume of a hexahedron whose corners may repeat, as every solver sees degenerate ones.
local function volume_of(corners)
  local sum = 0
  for _, face in ipairs(faces) do
    local middle, points = { 0, 0, 0 }, {}
    for i, k in ipairs(face) do
      points[i] = corners[k]
      for axis = 1, 3 do middle[axis] = middle[axis] + corners[k][axis] / 4 end
    end
    for i = 1, 4 do sum = sum + under { middle, points[i], points[i % 4 + 1] } end
  end
  return sum / 6
end

-- --- LS-DYNA: fields in columns; cards without their comments --------------------------------------------

local function fields(line, first, width)
  local found, from = {}, 1
  while from <= #line do
    local to = from + (#found == 0 and first or width) - 1
    found[#found + 1] = line:sub(from, to):match "^%s*(.-)%s*$"
    from = to + 1
  end
  return found
end

local function dyna(path)
  local deck = { nodes = {}, solids = {}, shells = {}, parts = {}, sections = {}, sets = {}, ended = false }
  local card, lines
  local function finish()
    if not card then return end
    local titled = card:match "^(.*)_TITLE$"
    local name = titled and lines[1]
    local rest = table.move(lines, titled and 2 or 1, #lines, 1, {})
    local keyword = (titled or card):gsub("_LIST$", "")
    if keyword == "NODE" then
      for _, line in ipairs(rest) do
        local f = fields(line, 8, 16)
        local tag = assert(math.tointeger(tonumber(f[1])), line)
        check.that(not deck.nodes[tag], "a node twice")
        deck.nodes[tag] = { assert(tonumber(f[2])), assert(tonumber(f[3])), assert(tonumber(f[4])) }
      end
    elseif keyword:match "^ELEMENT_S" then
      local per = keyword == "ELEMENT_SOLID_H20" and 3 or 1
      local at_line = 1
      while at_line <= #rest do
        local f = fields(rest[at_line], 8, 8)
        local own = per
        if #f == 2 and per == 1 then own = 2 end
        local nodes = {}
        for k = 3, #f do nodes[#nodes + 1] = math.tointeger(tonumber(f[k])) end
        for more = 1, own - 1 do
          for _, field in ipairs(fields(rest[at_line + more], 8, 8)) do
            nodes[#nodes + 1] = math.tointeger(tonumber(field))
          end
        end
        at_line = at_line + own
        local into = keyword:match "SHELL" and deck.shells or deck.solids
        local tag = math.tointeger(tonumber(f[1]))
        check.that(not into[tag], "an element twice")
        into[tag] = { part = math.tointeger(tonumber(f[2])), nodes = nodes }
      end
    elseif keyword == "PART" then
      for k = 1, #rest, 2 do
        local f = fields(rest[k + 1], 10, 10)
        deck.parts[math.tointeger(tonumber(f[1]))] = { title = rest[k], section = tonumber(f[2]) }
      end
    elseif keyword == "SECTION_SOLID" then
      local f = fields(rest[1], 10, 10)
      deck.sections[tonumber(f[1])] = tonumber(f[2])
    elseif keyword:match "^SET_" then
      local members, ids = {}, fields(rest[1], 10, 10)
      for k = 2, #rest do
        local row = {}
        for _, field in ipairs(fields(rest[k], 10, 10)) do row[#row + 1] = math.tointeger(tonumber(field)) end
        if keyword == "SET_SEGMENT" then
          check.equal(#row, 4, "a segment has four nodes")
          members[#members + 1] = table.concat(row, " ")
        else
          for _, tag in ipairs(row) do members[#members + 1] = tag end
        end
      end
      local key = keyword .. " " .. (name or ids[1])
      check.that(not deck.sets[key], "a set twice: " .. key)
      deck.sets[key] = members
    end
  end
  for line in read(path):gmatch "([^\n]*)\n" do
    if line:sub(1, 1) == "*" then
      finish()
      check.that(not deck.ended, "a card behind *END")
      card, lines = line:match "^%*(%S+)", {}
      deck.ended = card == "END"
    elseif line:sub(1, 1) ~= "$" then
      check.that(#line <= 80, "a line of more than 80 columns")
      lines[#lines + 1] = line
    end
  end
  finish()
  check.that(deck.ended, "no *END")
  return deck
end

local function dyna_volume(deck, what)
  local sum = 0
  for tag, solid in pairs(deck.solids) do
    local corners = {}
    for k = 1, 8 do corners[k] = assert(deck.nodes[solid.nodes[k]], what) end
    local own = volume_of(corners)
    check.that(own > 0, what .. ": volume of solid " .. tag)
    sum = sum + own
    local part = deck.parts[solid.part]
    check.that(part and deck.sections[part.section], what .. ": a part and its section")
  end
  return sum
end

local function size(of)
  local count = 0
  for _ in pairs(of) do count = count + 1 end
  return count
end

-- What must be the same: nodes, elements, sets, whatever their order in the file.
local function text_of(deck, renamed)
  local lines = {}
  for tag, p in pairs(deck.nodes) do
    lines[#lines + 1] = ("node %d %.9g %.9g %.9g"):format(tag, p[1], p[2], p[3])
  end
  for _, kind in ipairs { "solids", "shells" } do
    for tag, e in pairs(deck[kind]) do
      local part = deck.parts[e.part]
      lines[#lines + 1] = ("%s %d %s: %s"):format(kind, tag, part and part.title or e.part,
        table.concat(e.nodes, " "))
    end
  end
  for key, members in pairs(deck.sets) do
    local sorted = {}
    for i, member in ipairs(members) do
      local row = {}
      for word in tostring(member):gmatch "%d+" do row[#row + 1] = tonumber(word) end
      table.sort(row)
      sorted[i] = table.concat(row, " ")
    end
    table.sort(sorted)
    lines[#lines + 1] = (renamed and key:match "^%S+" or key) .. " = " .. table.concat(sorted, ", ")
  end
  table.sort(lines)
  return table.concat(lines, "\n")
end

-- The same but for the order in the file; else the first line that differs is the message.
local function same(found, expected, what, renamed)
  local a, b = text_of(found, renamed), text_of(expected, renamed)
  if a == b then return check.equal(true, true) end
  local of = {}
  for line in b:gmatch "[^\n]+" do of[line] = true end
  for line in a:gmatch "[^\n]+" do check.that(of[line], what .. ": not expected: " .. line) end
  local has = {}
  for line in a:gmatch "[^\n]+" do has[line] = true end
  for line in b:gmatch "[^\n]+" do check.that(has[line], what .. ": missing: " .. line) end
end

-- --- FEBio: tags and comma lists -------------------------------------------------------------------------

local elements_of = { hex8 = 8, hex20 = 20, hex27 = 27, penta6 = 6, tet4 = 4, pyra5 = 5 }
local facets_of = { quad4 = 4, quad8 = 8, quad9 = 9, tri3 = 3, tri6 = 6 }
local function integers(text)
  local found = {}
  for word in text:gmatch "[^,]+" do found[#found + 1] = assert(math.tointeger(tonumber(word)), text) end
  return found
end

local function febio(path)
  local text = read(path)
  check.that(text:match '^<%?xml version="1.0"[^>]*%?>\n<febio_spec version="4.0">', "the head")
  local mesh = assert(text:match "<Mesh>(.-)</Mesh>")
  local found = { nodes = {}, parts = {}, node_sets = {}, surfaces = {}, element_sets = {}, domains = {} }
  for id, inside in mesh:match("<Nodes.-</Nodes>"):gmatch '<node id="(%d+)">([^<]*)</node>' do
    local x, y, z = inside:match "^([^,]+),([^,]+),([^,]+)$"
    found.nodes[tonumber(id)] = { assert(tonumber(x)), assert(tonumber(y)), assert(tonumber(z)) }
  end
  local ids = {}
  for kind, name, inside in mesh:gmatch '<Elements type="(%w+)" name="([^"]+)">(.-)</Elements>' do
    check.that(elements_of[kind], kind)
    check.that(not found.parts[name], "a part twice: " .. name)
    local part = { kind = kind, cells = {} }
    found.parts[name] = part
    for id, list in inside:gmatch '<elem id="(%d+)">([^<]*)</elem>' do
      check.that(not ids[id], "an element twice")
      ids[id] = true
      local nodes = integers(list)
      check.equal(#nodes, elements_of[kind])
      for _, node in ipairs(nodes) do check.that(found.nodes[node], "an unknown node") end
      part.cells[#part.cells + 1] = nodes
    end
  end
  for name, list in mesh:gmatch '<NodeSet name="([^"]+)">([^<]*)</NodeSet>' do
    check.that(not found.node_sets[name], "a set twice: " .. name)
    found.node_sets[name] = integers(list)
  end
  for name, list in mesh:gmatch '<ElementSet name="([^"]+)">([^<]*)</ElementSet>' do
    check.that(not found.element_sets[name] and not found.parts[name], "a set twice: " .. name)
    found.element_sets[name] = integers(list)
  end
  for name, inside in mesh:gmatch '<Surface name="([^"]+)">(.-)</Surface>' do
    local surface = {}
    for kind, id, list in inside:gmatch '<(%w+) id="(%d+)">([^<]*)</%w+>' do
      local nodes = integers(list)
      check.equal(#nodes, facets_of[kind])
      check.equal(tonumber(id), #surface + 1)
      surface[#surface + 1] = nodes
    end
    found.surfaces[name] = surface
  end
  for kind, name, material in text:match("<MeshDomains>(.-)</MeshDomains>"):gmatch
    '<(%w+) name="([^"]+)" mat="([^"]+)"/>' do
    check.that(found.parts[name], "a domain without elements")
    found.domains[name] = { kind = kind, material = material }
  end
  for name in pairs(found.parts) do check.that(found.domains[name], "elements without a domain: " .. name) end
  return found
end

local degenerate = {
  hex8 = { 1, 2, 3, 4, 5, 6, 7, 8 }, penta6 = { 1, 2, 3, 3, 4, 5, 6, 6 }, tet4 = { 1, 2, 3, 3, 4, 4, 4, 4 },
  pyra5 = { 1, 2, 3, 4, 5, 5, 5, 5 },
}
degenerate.hex20, degenerate.hex27 = degenerate.hex8, degenerate.hex8

-- --- a family --------------------------------------------------------------------------------------------

local function prism(given, options)
  return lacuna.synthetic.prism(given):open_volume { name = "foam" }:sweep(options)
end
local family = {
  { "sides", prism({ sides = 6, twist = 20 }, { layers = 4, size = 0.4 }) },
  { "holes", prism({ sides = 8, holes = 2 }, { layers = 2, size = 0.25 }) },
  { "open", prism({ sides = 6, drop = { "wall_1", "wall_2" } }, { layers = 3, size = 0.4 }) },
  { "bent", prism({ sides = 4, height = 3, bend = 40 }, { layers = 8, size = 0.4 }) },
}
do -- wedges: triangles on the source
  local model = lacuna.model()
  local ring, top, cells = {}, {}, {}
  for k = 0, 5 do
    local x, y = math.cos(k * math.pi / 3), math.sin(k * math.pi / 3)
    ring[k + 1], top[k + 1] = { x, y, 0 }, { x, y, 1 }
    cells[k + 1] = { 7, (k + 1) % 6 + 1, k + 1 }
  end
  ring[7] = { 0, 0, 0 }
  model:add_face { name = "source", points = ring, cells = cells, keep_mesh = true }
  family[#family + 1] = { "wedges", model:open_volume { source = "source", along = { vector = { 0, 0, 1 } },
    name = "foam" }:sweep { layers = 2, wedges = true } }
end
for _, member in ipairs(family) do
  local name, mesh = table.unpack(member)
  mesh:write(at(name .. ".k"))
  local deck = dyna(at(name .. ".k"))
  check.equal(size(deck.nodes), mesh.nodes, name)
  check.equal(size(deck.solids), mesh.hexes + mesh.wedges, name)
  check.near(dyna_volume(deck, name), mesh.fidelity.volume, 1e-6 * mesh.fidelity.volume)
  check.equal(deck.parts[1].title, "foam", name)
  check.equal(#deck.sets["SET_SOLID foam"], mesh.hexes + mesh.wedges, name)
  -- All segments together are the skin, seen from outside; some are in several sets.
  local skin, counted = 0, {}
  for key, members in pairs(deck.sets) do
    if key:match "^SET_SEGMENT" then
      local nodes = {}
      for _, segment in ipairs(members) do
        local points, last = {}, nil
        for word in segment:gmatch "%d+" do
          nodes[tonumber(word)] = true
          if word ~= last then points[#points + 1] = deck.nodes[tonumber(word)] end
          last = word
        end
        if not counted[segment] then skin = skin + under(points) / 6 end
        counted[segment] = true
      end
      check.equal(size(nodes), #deck.sets[key:gsub("SEGMENT", "NODE")], name .. " " .. key)
    end
  end
  check.near(skin, mesh.fidelity.volume, 1e-2 * mesh.fidelity.volume)

  -- Back and forth: the same numbers and sets.
  lacuna.convert(at(name .. ".k"), at(name .. "_2.k"))
  same(dyna(at(name .. "_2.k")), deck, name .. " by .k")
  for _, ending in ipairs { "inp", "exo" } do
    lacuna.convert(at(name .. ".k"), at(name .. "_3." .. ending))
    lacuna.convert(at(name .. "_3." .. ending), at(name .. "_4.k"))
    same(dyna(at(name .. "_4.k")), deck, name .. " by ." .. ending, ending == "inp") -- which has other names
  end
  local quality = lacuna.check(at(name .. ".k"))
  check.near(quality.min_scaled_jacobian, mesh:quality().min_scaled_jacobian, 1e-5)

  mesh:write(at(name .. ".feb"))
  local feb = febio(at(name .. ".feb"))
  check.equal(size(feb.nodes), mesh.nodes, name)
  local cells, volume = 0, 0
  for _, part in pairs(feb.parts) do
    for _, nodes in ipairs(part.cells) do
      local corners = {}
      for k, i in ipairs(degenerate[part.kind]) do corners[k] = feb.nodes[nodes[i]] end
      local own = volume_of(corners)
      check.that(own > 0, name)
      cells, volume = cells + 1, volume + own
    end
  end
  check.equal(cells, mesh.hexes + mesh.wedges, name)
  check.near(volume, mesh.fidelity.volume, 1e-6 * mesh.fidelity.volume)
  check.that(feb.node_sets.source and feb.surfaces.source and feb.domains.foam.kind == "SolidDomain", name)
  check.equal(feb.domains.foam.material, "foam")
  local outside = 0
  counted = {}
  for _, surface in pairs(feb.surfaces) do
    for _, nodes in ipairs(surface) do
      local points = {}
      for k = 1, #nodes % 3 == 0 and 3 or 4 do points[k] = feb.nodes[nodes[k]] end
      local key = table.concat(nodes, " ")
      if not counted[key] then outside = outside + under(points) / 6 end
      counted[key] = true
    end
  end
  check.near(outside, mesh.fidelity.volume, 1e-2 * mesh.fidelity.volume)
end

-- Order 2: middle nodes lie in the middle of the sides that they are listed for.
local edges = { { 1, 2 }, { 2, 3 }, { 3, 4 }, { 4, 1 }, { 5, 6 }, { 6, 7 }, { 7, 8 }, { 8, 5 },
  { 1, 5 }, { 2, 6 },
  { 3, 7 }, { 4, 8 } }
local function check_middles(nodes, cell, what)
  for k, edge in ipairs(edges) do
    for axis = 1, 3 do
      local middle = (nodes[cell[edge[1]]][axis] + nodes[cell[edge[2]]][axis]) / 2
      check.near(nodes[cell[8 + k]][axis], middle, 1e-9)
    end
  end
  check.that(#cell >= 20, what)
end
local straight = { sides = 4, radius = 1, height = 2 }
local curved = prism(straight, { layers = 2, size = 0.7, order = 2, serendipity = true })
curved:write(at "curved.k")
local deck = dyna(at "curved.k")
for _, solid in pairs(deck.solids) do check_middles(deck.nodes, solid.nodes, "hex20") end
check.equal(deck.sections[1], 23)
lacuna.convert(at "curved.k", at "curved_2.k")
same(dyna(at "curved_2.k"), deck, "order 2")
local full = prism(straight, { layers = 2, size = 0.7, order = 2 })
full:write(at "full.feb")
local feb = febio(at "full.feb")
for _, cell in ipairs(feb.parts.foam.cells) do
  check_middles(feb.nodes, cell, "hex27")
  for i, face in ipairs { faces[3], faces[4], faces[5], faces[6], faces[1], faces[2] } do
    for axis = 1, 3 do
      local sum = 0
      for _, k in ipairs(face) do sum = sum + feb.nodes[cell[k]][axis] / 4 end
      check.near(feb.nodes[cell[20 + i]][axis], sum, 1e-9)
    end
  end
end
check.equal(#feb.surfaces.source[1], 9)
check.fails(function() full:write(at "full.k") end, "27 nodes", "serendipity = true")

-- --- decks as others write them --------------------------------------------------------------------------

local cube = [[
*KEYWORD
*TITLE
a drop test
*PART
lower block
         7         1         1
$ comment
upper block
         9         1         2
*SECTION_SOLID
         1         1
*MAT_ELASTIC
         1  7.85E-09  210000.0       0.3
*BOUNDARY_SPC_SET
         4         0         1         1         1
*NODE
]]
local corner = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 },
  { 0, 1, 1 }, { 0, 0, 2 }, { 1, 0, 2 }, { 1, 1, 2 }, { 0, 1, 2 } }
local function node_lines(form)
  local lines = {}
  for i, p in ipairs(corner) do lines[i] = form:format(100 + i, p[1], p[2], p[3]) end
  return table.concat(lines, "\n") .. "\n"
end
local rest = [[
*ELEMENT_SOLID
       1       7     101     102     103     104     105     106     107     108
       2       9
     105     106     107     108     109     110     111     112       0       0
*ELEMENT_BEAM
       1       3     101     102     103
*SET_NODE_LIST
         4       0.0
       101       102       103       104
*SET_SEGMENT
         5
       105       106       107       108
*SET_SOLID_GENERATE_TITLE
both
         6
         1        99
*SET_NODE_COLUMN
         8
       101       1.0
*END
]]
local kinds = {
  columns = cube .. node_lines("%8d%16.7f%16.7f%16.7f       7       7") .. rest,
  commas = cube .. node_lines("%d,%g,%g,%g") .. rest,
  ten = cube:gsub("%*KEYWORD", "*KEYWORD I10=Y") .. node_lines("%10d%16.7f%16.7f%16.7f") ..
    rest:gsub("(%*ELEMENT_SOLID\n)(.-)(%*ELEMENT_BEAM)", function(a, b, c)
      return a .. b:gsub("[^\n]+", function(line) return (line:gsub("........", "  %0")) end) .. c
    end),
}
for kind, text in pairs(kinds) do
  check.write(at(kind .. ".k"), text)
  local model = lacuna.load(at(kind .. ".k"))
  local regions = {}
  for _, face in ipairs(model:faces { region = "lower block" }) do regions[#regions + 1] = face.tag end
  check.that(#regions > 0, kind .. ": faces of a part")
  check.equal(#model:faces { name = "segments_5" }, 1, kind .. ": the face between two parts")
  lacuna.convert(at(kind .. ".k"), at(kind .. "_out.k"))
  local out = read(at(kind .. "_out.k"))
  for _, kept in ipairs { "*BOUNDARY_SPC_SET", "*MAT_ELASTIC", "*ELEMENT_BEAM", "*SET_NODE_COLUMN",
    "a drop test" } do
    check.that(select(2, out:gsub(kept, "")) == 1, kind .. ": " .. kept .. " is kept, once")
  end
  lacuna.convert(at(kind .. ".k"), at(kind .. ".exo"))
  lacuna.convert(at(kind .. ".exo"), at(kind .. "_back.k"))
  local back = dyna(at(kind .. "_back.k"))
  check.equal(size(back.nodes), 12, kind)
  check.equal(table.concat(back.sets["SET_NODE nodes_4"], " "), "101 102 103 104", kind)
  check.equal(table.concat(back.sets["SET_SEGMENT segments_5"], " "), "105 106 107 108", kind)
  check.equal(table.concat(back.sets["SET_SOLID both"], " "), "1 2", kind)
  check.equal(back.parts[back.solids[2].part].title, "upper block", kind)
end
check.that(read(at "columns_out.k"):find("       7       7\n", 1, true), "constraints of nodes are kept")
check.write(at "part.k", "*KEYWORD\n" .. cube:match "%*PART.*" ..
  node_lines "%8d%16.7f%16.7f%16.7f" .. "*END\n")
check.write(at "whole.k", "*KEYWORD\n*INCLUDE\npart.k\n" .. rest)
check.equal(#lacuna.load(at "whole.k"):faces { region = "upper block" } > 0, true)

-- What cannot be read is refused, and says what to do.
local function refused(text, ...)
  check.write(at "bad.k", text)
  check.fails(function() lacuna.load(at "bad.k") end, ...)
end
local whole = kinds.columns
refused(whole:gsub("101     102     103", "&n1     102     103"), "is a parameter", "write its value")
refused(whole:gsub("%*SET_NODE_LIST", "*INCLUDE_TRANSFORM\nx.k\n*SET_NODE_LIST"), "*INCLUDE_TRANSFORM")
refused(whole:gsub("     101     102     103     104     105", "     101     101     101     104     105"),
  "repeats nodes")
refused(whole:gsub("       2       9\n", "       1       9\n"), "element 1", "is defined twice")
refused("*KEYWORD\n*END\n", "*NODE")
refused(whole:gsub("%*ELEMENT_BEAM",
    "*ELEMENT_SHELL\n       2       7     101     102     103     104\n*ELEMENT_BEAM"),
  "element 2", "each shell its own number")
lacuna.convert(at "columns.k", at "columns.feb")
check.fails(function() lacuna.load(at "columns.feb") end, ".feb")

-- Cut off or damaged anywhere: an error of ours or a deck, nothing else.
local random = check.random(39)
for _, text in pairs(kinds) do
  for _ = 1, check.whole and 2000 or 60 do
    local from = math.floor(random(1, #text))
    local damaged = random(0, 1) < 0.5 and text:sub(1, from)
      or text:sub(1, from) .. string.char(math.floor(random(32, 126))) ..
        text:sub(from + math.floor(random(1, 9)))
    check.write(at "damaged.k", damaged)
    local fine, why = pcall(lacuna.check, at "damaged.k")
    check.that(fine or tostring(why.code):match "^io%." or why.code == "lua.no_hexahedra", tostring(why))
  end
end

-- With the deck that it fills: the numbers of the deck stay, and its cards.
do
  local model = lacuna.load(at "columns.k")
  local top = model:face { near = { 0.5, 0.5, 2 } }
  local void = model:open_volume { source = top, along = { vector = { 0, 0, 1 } }, name = "cap" }
  local mesh = void:sweep { layers = 2 }
  mesh:write(at "joined.k", { with = model })
  local joined = dyna(at "joined.k")
  check.equal(size(joined.solids), 4)
  check.equal(size(joined.nodes), 12 + 8)
  check.equal(joined.parts[joined.solids[4].part].title, "cap")
  check.that(joined.parts[joined.solids[4].part].section ~= 1, "a section of its own")
  check.that(read(at "joined.k"):find("*MAT_ELASTIC", 1, true))
end
check.done()
