-- SPDX-License-Identifier: MIT
-- The table of formats: the reference, the errors and the help of the program list the same endings and
-- options. Dialects of Abaqus decks, and sets of several decks that are joined.
-- usage: lacuna formats.lua lacuna=PROGRAM scratch=FOLDER
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "lacuna", scratch = "." }
local function path(name) return params.scratch .. "/" .. name end
local function read(name)
  local file <close> = assert(io.open(name, "rb"))
  return file:read("a")
end

local function set_of(text, pattern)
  local found, count = {}, 0
  for word in text:gmatch(pattern) do found[word], count = true, count + 1 end
  return found, count
end
local function same(found, expected, what)
  for word in pairs(expected) do check.that(found[word], what .. ": lacks " .. word) end
  for word in pairs(found) do check.that(expected[word], what .. ": has " .. word) end
end

local reference = read(arg[0]:match("^(.*/)") .. "../../docs/reference.md")
-- Rows of the first table behind a heading: { endings, last column } …
local function rows(heading)
  local _, at = reference:find("\n" .. heading .. "\n", 1, true)
  local found = {}
  for row in reference:sub(at + 1):match("\n(|.-)\n\n"):gmatch "[^\n]+" do
    local first, last = row:match "^| (.-) |", row:match ".*| (.-) |$"
    if first and first:find "`" then found[#found + 1] = { first, last } end
  end
  return found
end
local function endings(table_rows)
  local all = {}
  for _, row in ipairs(table_rows) do
    for ending in row[1]:gmatch "`([%w.]+)`" do all[ending] = true end
    if row[2]:find "`%.vtu`" then all[".vtu"] = true end
  end
  return all
end

-- --- endings

local mesh = lacuna.synthetic.prism { sides = 4 }:open_volume {}:sweep { layers = 2, size = 1 }
local written_rows = rows "### `mesh:write`"
local written = endings(written_rows)
local message = check.fails(function() mesh:write(path "mesh.none") end, "lua.unknown_ending")
local listed, count = set_of(message:match "mesh files end in ([^%[]*)", "[.%w]+")
check.that(count > 10)
same(listed, written, "written")

check.write(path "mesh.none", "of no format")
local all_read = check.fails(function() lacuna.load(path "mesh.none") end, "io.unknown_ending")
local read_listed = set_of(all_read:match "supported endings are ([^%[]*)", "%.[%w_]+")
local described = {}
for _, row in ipairs(rows "### Files that are read") do
  for ending in row[1]:gmatch "`(%.[%w_]+)`" do described[ending] = true end
end
same(read_listed, described, "read")

local function help(command)
  local pipe <close> = assert(io.popen(("'%s' %s --help"):format(params.lacuna, command)))
  return pipe:read("a")
end
local decks = {} -- that hold cells, and are written from decks
for ending in pairs(written) do decks[ending] = ending ~= ".pvtu" or nil end
local convert = help "convert"
same((set_of(convert:match "of OUT: (.-)%. Nodes", "[.%w]+")), decks, "convert writes")
local meshes = set_of(help("check"):match "of a mesh: (.-)%.\n", "%.%w+")
check.that(meshes[".mesh"] and meshes[".vtu"] and not meshes[".stl"] and not meshes.polyMesh)
check.that(not (convert .. help "check"):find "%%%u", "a word was left in the help")

-- --- options: the reference says which a format has, and others are refused

local values = { version = 4.1, binary = false, quality = false, groups = "one", gmsh_options = false,
  partitions = 1, element = "C3D8" }
for _, row in ipairs(written_rows) do
  for ending in row[1]:gmatch "`([%w.]+)`" do
    for option, value in pairs(values) do
      local file = path(ending:sub(1, 1) == "." and "options" .. ending or ending)
      local fine, why = pcall(function() mesh:write(file, { [option] = value }) end)
      local has = row[2]:find("`" .. option .. "`", 1, true) ~= nil
      if option == "gmsh_options" and not has then goto next end -- false is no request
      check.that(fine == has, ("%s, option %s: %s"):format(ending, option, tostring(why)))
      if not fine then check.that(tostring(why):find("idle_option", 1, true), tostring(why)) end
      ::next::
    end
  end
end

-- --- *NSET, ELSET=: all nodes of the elements of a set

-- A row of `n` cells from number `first` on, with sets of all nodes and of all cells.
local function deck(first, n, shift, nodes, cells, more)
  local lines = { "*NODE, NSET=" .. nodes }
  local function add(...) lines[#lines + 1] = string.format(...) end
  for i = 0, n do
    for k, corner in ipairs { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } } do
      add("%d, %g, %g, %g", first + 4 * i + k - 1, corner[1], corner[2], i + shift)
    end
  end
  add("*ELEMENT, TYPE=C3D8, ELSET=%s", cells)
  for i = 0, n - 1 do
    local tags = {}
    for k = 0, 7 do tags[#tags + 1] = first + 4 * i + k end
    add("%d, %s", first + i, table.concat(tags, ", "))
  end
  return table.concat(lines, "\n") .. "\n" .. (more or "")
end
local function members(text, name)
  local found = {}
  local inside = text:match("%*NSET, NSET=" .. name .. "\n([^*]*)")
  check.that(inside, "no set " .. name)
  for word in inside:gmatch "%d+" do found[#found + 1] = tonumber(word) end
  return found
end
check.write(path "nset.inp", deck(1, 4, 0, "NALL", "EALL", [[
*ELSET, ELSET=ENDS
1, 4
*NSET, NSET=NENDS, ELSET=ENDS
*NSET, NSET=MORE, ELSET=ENDS
9
]]))
lacuna.convert(path "nset.inp", path "nset_back.inp")
local back = read(path "nset_back.inp")
check.equal(table.concat(members(back, "NENDS"), " "), "1 2 3 4 5 6 7 8 13 14 15 16 17 18 19 20")
check.equal(#members(back, "MORE"), 17)
check.write(path "nset_none.inp", deck(1, 2, 0, "NALL", "EALL", "*NSET, NSET=N, ELSET=NONE\n"))
check.fails(function() lacuna.convert(path "nset_none.inp", path "nset_back.inp") end, "NONE", "line ")
check.write(path "nset_part.inp", "*PART, NAME=P\n" .. deck(1, 2, 0, "N", "E") .. [[
*END PART
*ASSEMBLY, NAME=A
*INSTANCE, NAME=I, PART=P
*END INSTANCE
*NSET, NSET=ALL, ELSET=I.E
*END ASSEMBLY
]])
lacuna.convert(path "nset_part.inp", path "nset_back.inp")
check.equal(#members(read(path "nset_back.inp"), "ALL"), 12)
local _, out, err = check.run(params.lacuna, params.scratch, { "convert", "nset_part.inp", "nset_back.inp" })
check.that((out .. err):find("note: nset_back.inp: the instance I becomes one mesh without *PART and " ..
  "*INSTANCE; names in cards lose \"I.\"", 1, true), out .. err)

-- --- sets of all of one of several decks get what joins them

-- Two blocks, and the void between them; the sets are called alike or not, and the decks may have sections.
local function section(name, material)
  return ("*MATERIAL, NAME=%s\n*ELASTIC\n1000., 0.3\n*SOLID SECTION, ELSET=%s, MATERIAL=%s\n")
    :format(material, name, material)
end
-- Members of an ELSET, which may name other sets.
local cells_of
function cells_of(text, name)
  local found = {}
  for inside in text:gmatch("%*ELEMENT[^\n]*ELSET=" .. name .. "\n([^*]*)") do
    for cell in ("\n" .. inside):gmatch "\n%s*(%d+)" do found[tonumber(cell)] = true end
  end
  for inside in text:gmatch("%*ELSET, ELSET=" .. name .. "\n([^*]*)") do
    for word in inside:gmatch "[^,%s]+" do
      local cells = tonumber(word) and { [tonumber(word)] = true } or cells_of(text, word)
      for cell in pairs(cells) do found[cell] = true end
    end
  end
  return found
end
for _, case in ipairs { { "NALL", "EALL", 0, "NALL_2", "EALL_2" }, { "ALL_NODES", "ALL", 100 } } do
  for _, sections in ipairs { false, true } do
    local nodes, cells, add, nodes2, cells2 = table.unpack(case)
    local function half(first, shift, nall, body, eall, material)
      return deck(first, 2, shift, nall, body,
        ("*ELSET, ELSET=%s\n%s\n%s"):format(eall, body, sections and section(eall, material) or ""))
    end
    check.write(path "low.inp", half(1, 0, "NALL", "below", "EALL", "m"))
    check.write(path "high.inp", half(1 + add, 3, nodes, "above", cells, "n"))
    check.write(path "join.lua", ([[
    local lacuna = require "lacuna"
    local both = lacuna.load { "low.inp", "high.inp" }
    local function at(z) return { box = { { -0.1, -0.1, z - 0.1 }, { 1.1, 1.1, z + 0.1 } } } end
    local void = both:open_volume { name = "between", source = at(2), target = at(3) }
    void:sweep { layers = 1, size = 1 }:write("joined.inp", { with = both, renumber = %s })
    ]]):format(add == 0))
    local exit, _, told = check.run(params.lacuna, params.scratch, { "join.lua" })
    check.equal(exit, 0, told)
    local joined = read(path "joined.inp")
    local between = cells_of(joined, "between")
    check.that(next(between), joined)
    local has = {}
    for _, name in ipairs { "EALL", cells2 or cells } do
      local held = cells_of(joined, name)
      local all = true
      for cell in pairs(between) do all = all and held[cell] end
      has[#has + 1] = all and name or nil
    end
    -- Two sections would give the cells two materials; cards of a deck with other numbers are left out.
    local once = sections and add > 0
    check.equal(table.concat(has, " "), once and "EALL" or "EALL " .. (cells2 or cells), told)
    check.equal(told:find("note: [^\n]*is not in the set ALL,") ~= nil, once, told)
    for _, name in ipairs { "NALL", nodes2 or nodes } do check.equal(#members(joined, name), 16, name) end
    check.that(not told:find "hold all of one deck", told)
  end
end

check.done()
