-- SPDX-License-Identifier: MIT
-- Faces of two bodies that touch or face each other: found, and written as ties and contacts.
-- usage: lacuna contacts.lua scratch=FOLDER lacuna=PROGRAM ccx=PROGRAM
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { scratch = ".", lacuna = "", ccx = "" }
local function at(name) return params.scratch .. "/" .. name end
local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end

-- The faces of a box { x0, x1, y0, y1, z0, z1 }, turned about the x axis, in a model.
local function add_block(model, name, box, degrees)
  local x, y, z = { box[1], box[2] }, { box[3], box[4] }, { box[5], box[6] }
  local c, s = math.cos(math.rad(degrees or 0)), math.sin(math.rad(degrees or 0))
  local sides = {
    bottom = { 1, 1, 1, 1, 2, 1, 2, 2, 1, 2, 1, 1 }, top = { 1, 1, 2, 2, 1, 2, 2, 2, 2, 1, 2, 2 },
    south = { 1, 1, 1, 2, 1, 1, 2, 1, 2, 1, 1, 2 }, north = { 1, 2, 1, 1, 2, 2, 2, 2, 2, 2, 2, 1 },
    west = { 1, 1, 1, 1, 1, 2, 1, 2, 2, 1, 2, 1 }, east = { 2, 1, 1, 2, 2, 1, 2, 2, 2, 2, 1, 2 } }
  for _, side in ipairs { "bottom", "top", "south", "north", "west", "east" } do
    local points, at_corner = {}, sides[side]
    for k = 0, 3 do
      local p, q, r = x[at_corner[3 * k + 1]], y[at_corner[3 * k + 2]], z[at_corner[3 * k + 3]]
      points[k + 1] = { p, c * q - s * r, s * q + c * r }
    end
    model:add_face { name = name .. side, points = points, cells = { { 1, 2, 3, 4 } } }
  end
end
local function block(name, box, options)
  local model = lacuna.model()
  add_block(model, "", box, options and options.turned)
  return model:open_volume { source = "bottom", target = "top", walls = { "south", "north", "west", "east" },
    name = name, glued = not options or options.glued }
end
local base, lid = { 0, 2, 0, 2, 0, 1 }, { 0.5, 1.5, 0.5, 1.5, 1, 2 }
local function raised(box, by) return { box[1], box[2], box[3], box[4], box[5] + by, box[6] + by } end

-- --- finding ---------------------------------------------------------------------------------------------

-- A block above another one is found within its distance, and not below that; turned bodies alike.
for _, turned in ipairs { 0, 17, 90 } do
  for _, apart in ipairs { 0.001, 0.05, 0.4 } do
    local bodies = lacuna.assembly { block("base", base, { turned = turned }),
      block("lid", raised(lid, apart), { turned = turned }) }
    check.equal(#bodies:contacts { gap = 0.9 * apart }, 0)
    local found = bodies:contacts { gap = 1.1 * apart }
    check.equal(#found, 1)
    check.equal(found[1].name, "base_lid")
    check.equal(#found[1].faces, 1)
    check.near(found[1].least, apart, 1e-9)
    check.near(found[1].width, apart, 1e-9)
    check.near(found[1].area, 1, 1e-9)
  end
end
-- What shares nodes is in no contact; with nodes of its own it is. A plate between two blocks is beside both,
-- and they are not beside each other.
local plate = { 0, 2, 0, 2, 1, 1.1 }
for _, glued in ipairs { true, false } do
  local bodies = lacuna.assembly { block("base", base), block("plate", plate, { glued = glued }),
    block("lid", raised(lid, 0.1)) }
  local found = bodies:contacts { gap = 0.5 }
  check.equal(#found, glued and 0 or 2)
  for _, pair in ipairs(found) do check.that(pair.a == "plate" or pair.b == "plate") end
end
-- Bodies of a model: its connected parts.
do
  local model = lacuna.model()
  add_block(model, "base_", base)
  check.fails(function() model:contacts { gap = 1 } end, "one body", "lacuna.load")
  add_block(model, "lid_", raised(lid, 0.1))
  check.equal(#model:contacts { gap = 0.05 }, 0)
  local found = model:contacts { gap = 0.2 }
  check.equal(#found, 1)
  check.equal(model:face(found[1].faces[1][1]).name, "base_top")
  check.equal(model:face(found[1].faces[1][2]).name, "lid_bottom")
end

-- --- meshes ----------------------------------------------------------------------------------------------

local function cells(mesh, group)
  for _, of in ipairs(mesh:groups()) do if of.name == group then return of.cells end end
  return 0
end
-- Nodes of its own, of any size: the counts are those of both meshes alone.
for _, order in ipairs { 1, 2 } do
  local a, b = block("base", base), block("lid", lid, { glued = false })
  local sizes = { order = order, layers = 2, [a] = { size = 0.5 }, [b] = { size = 0.2 } }
  local mesh = lacuna.assembly { a, b }:sweep(sizes)
  local nodes, hexes = 0, 0
  for name, box in pairs { base = base, lid = lid } do
    local alone = block(name, box):sweep { order = order, layers = 2, size = name == "base" and 0.5 or 0.2 }
    nodes, hexes = nodes + alone.nodes, hexes + alone.hexes
  end
  check.equal(mesh.nodes, nodes)
  check.equal(mesh.hexes, hexes)
  check.equal(#mesh.contacts, 1)
  local pair = mesh.contacts[1]
  check.equal(pair.type, "tie")
  -- The lid's bottom is covered as a whole: it is the slave.
  check.equal(cells(mesh, pair.slave), 25)
  check.equal(cells(mesh, pair.master), 16)
end
-- Both sides covered alike: the finer one is the slave. What was found may be given back, and changed.
do
  local a, b = block("a", base), block("b", raised(base, 1), { glued = false })
  local bodies = lacuna.assembly { a, b }
  local pairs_found = bodies:contacts()
  pairs_found[1].type, pairs_found[1].name = "contact", "joint"
  local mesh = bodies:sweep { layers = 1, contacts = { pairs = pairs_found }, [a] = { size = 0.4 },
    [b] = { size = 1 } }
  check.equal(#mesh.contacts, 1)
  check.equal(mesh.contacts[1].type, "contact")
  check.equal(cells(mesh, "joint_slave"), 25)
  check.equal(cells(mesh, "joint_master"), 4)
  local again = lacuna.assembly { a, b }:sweep { layers = 1, size = 1, contacts = { pairs = mesh.contacts } }
  check.equal(again.contacts[1].name, "joint")
  local apart = block("c", { 5, 6, 0, 1, 0, 1 })
  check.fails(function() lacuna.assembly { mesh, apart }:sweep {} end, "contact pairs")
end
-- A pin in a bore that it fills, each in facets of its own fineness, and a body that is cut into pieces.
do
  local function round(name, radius, hole, sides, from, to)
    local model = lacuna.model()
    local function ring(r, z, points)
      for k = 0, sides - 1 do
        local turn = 2 * math.pi * k / sides
        points[#points + 1] = { r * math.cos(turn), r * math.sin(turn), z }
      end
    end
    local function wall(r, face)
      local points, around = {}, {}
      ring(r, from, points)
      ring(r, to, points)
      for k = 1, sides do around[k] = { k, k % sides + 1, sides + k % sides + 1, sides + k } end
      model:add_face { name = face, points = points, cells = around }
    end
    for face, z in pairs { source = from, target = to } do
      local points, all = {}, {}
      ring(radius, z, points)
      if hole then ring(hole, z, points) else points[#points + 1] = { 0, 0, z } end
      for k = 1, sides do
        local n = k % sides + 1
        all[k] = hole and { k, n, sides + n, sides + k } or { k, n, sides + 1 }
      end
      model:add_face { name = face, points = points, cells = all }
    end
    wall(radius, "outside")
    if hole then wall(hole, "bore") end
    return model:open_volume { name = name, source = "source", target = "target",
      walls = hole and { "outside", "bore" } or { "outside" }, glued = hole ~= nil }
  end
  local mesh = lacuna.assembly { round("plate", 3, 1, 48, 0, 1), round("pin", 1, nil, 36, -1, 2) }
    :sweep { size = 0.3 }
  check.equal(#mesh.contacts, 1)
  check.that(cells(mesh, "plate_pin_slave") > 0 and cells(mesh, "plate_pin_master") > 0)
  check.equal(cells(mesh, "plate_pin_slave"), cells(mesh, "plate:wall:" .. mesh.contacts[1].faces[1][1]))
end

-- --- files -----------------------------------------------------------------------------------------------

local function three(kind)
  local a, b, c = block("base", base), block("lid", lid, { glued = false }), block("cap", raised(lid, 1.01))
  return lacuna.assembly { a, b, c }:sweep { layers = 1, size = 0.5,
    contacts = { gap = 0.02, pairs = { { a = "cap", b = "lid", type = kind, name = "open" } } } }
end
local mesh = three "contact"
check.equal(#mesh.contacts, 2)
mesh:write(at "three.inp")
local text = read(at "three.inp")
for _, side in ipairs { "slave", "master" } do
  check.that(text:find("*SURFACE, TYPE=ELEMENT, NAME=base_lid_" .. side, 1, true))
  check.that(text:find("*SURFACE, TYPE=ELEMENT, NAME=open_" .. side, 1, true))
end
check.that(text:find("%*TIE, NAME=base_lid, POSITION TOLERANCE=[%d.E-]+, ADJUST=NO\n" ..
  "base_lid_slave, base_lid_master\n"))
check.that(text:find("*CONTACT PAIR, INTERACTION=open, TYPE=SURFACE TO SURFACE\n" ..
  "open_slave, open_master\n", 1, true))
check.that(text:find("*SURFACE INTERACTION, NAME=open\n", 1, true))

-- Nastran: each face of a region is one of its element, in the plane of the pair.
mesh:write(at "three.bdf")
do
  local grids, solids, faces, sets, card = {}, {}, {}, {}, nil
  for line in read(at "three.bdf"):gmatch "[^\n]+" do
    local fields = {}
    if line:find "," then
      for field in (line .. ","):gmatch "([^,]*)," do fields[#fields + 1] = field end
    else
      local width = line:sub(1, 8):find "%*" and 16 or 8
      fields[1] = line:sub(1, 8):match "^%S*"
      for k = 9, #line, width do
        fields[#fields + 1] = line:sub(k, k + width - 1):match "^%s*(%S*)"
      end
    end
    local name = fields[1]:match "^%u+"
    if name then card = { name } end
    if line:sub(1, 1) == "$" then card = nil end
    for k = 2, card and #fields or 0 do card[#card + 1] = fields[k] end
    if card and card[1] == "GRID" then grids[tonumber(card[2])] = card end
    if card and card[1] == "CHEXA" then solids[tonumber(card[2])] = card end
    if card and card[1] == "BSURFS" then faces[tonumber(card[2])] = card end
    if card and (card[1] == "BGSET" or card[1] == "BCTSET") then sets[card[1]] = card end
  end
  check.equal(#faces, 4)
  check.equal(tonumber(sets.BGSET[3]) + 1, tonumber(sets.BGSET[4]))
  check.equal(tonumber(sets.BCTSET[3]) + 1, tonumber(sets.BCTSET[4]))
  for _, region in ipairs(faces) do
    check.equal((#region - 5) % 4, 0)
    local height
    for k = 6, #region, 4 do
      local corners = {}
      for n = 4, 11 do corners[tonumber(solids[tonumber(region[k])][n])] = true end
      for n = 1, 3 do
        local grid = tonumber(region[k + n])
        check.that(corners[grid], "a corner of its element")
        local z = tonumber(grids[grid][6] or grids[grid][#grids[grid]])
        height = height or z
        check.near(z, height, 1e-12)
      end
    end
  end
end
-- LS-DYNA: segment sets of both sides by number, of as many segments as the groups have faces.
local names = { "base_lid", "open" }
mesh:write(at "three.k")
do
  local cards, sets = {}, {}
  for keyword, body in (read(at "three.k") .. "*"):gmatch "%*([%u_]+)[^\n]*\n([^*]*)" do
    local lines = {}
    for line in body:gmatch "[^\n]+" do lines[#lines + 1] = line end
    if keyword == "SET_SEGMENT_TITLE" then
      sets[tonumber(lines[2])] = { name = lines[1], count = #lines - 2 }
    end
    if keyword:find "^CONTACT" then cards[#cards + 1] = { keyword, lines } end
  end
  check.equal(#cards, 2)
  for _, card in ipairs(cards) do
    local keyword, lines = card[1], card[2]
    check.equal(#lines, 4, "identification, surfaces, friction, thicknesses")
    local name = lines[1]:sub(11)
    local function field(line, k) return tonumber(lines[line]:sub(10 * k - 9, 10 * k)) end
    check.that(keyword == (name == "open" and "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID"
      or "CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET_ID"), keyword)
    for k, side in ipairs { "slave", "master" } do
      local set = sets[field(2, k)]
      check.equal(set.name, name .. "_" .. side)
      check.equal(set.count, cells(mesh, set.name))
      check.equal(field(2, 2 + k), 0, "a set of segments")
    end
    check.that(name == "open" or (field(4, 3) < 0 and field(4, 3) == field(4, 4)), "a distance alone")
  end
  local again = lacuna.load(at "three.k")
  check.that(#again:faces() > 0)
end

-- FEBio: pairs of named surfaces; tags that open are closed.
mesh:write(at "three.feb")
do
  text = read(at "three.feb")
  local open = {}
  for close, word, alone in text:gmatch "<(/?)([%a_]%w*)[^<>]-(/?)>" do
    if close == "/" then check.equal(table.remove(open), word) end
    if close .. alone == "" then open[#open + 1] = word end
  end
  check.equal(#open, 0)
  for k, kind in ipairs { "tied", "sliding" } do
    local first, second = text:match('<SurfacePair name="' .. names[k] .. '">%s*<primary>(.-)</primary>%s*' ..
      '<secondary>(.-)</secondary>%s*</SurfacePair>.*</Mesh>')
    check.that(text:find('<Surface name="' .. first .. '">', 1, true) and first:find "_slave")
    check.that(text:find('<Surface name="' .. second .. '">', 1, true) and second:find "_master")
    local body = text:match('<Contact>.*<contact type="' .. kind .. '%-elastic" name="' .. names[k] ..
      '" surface_pair="' .. names[k] .. '">(.-)</contact>.*</Contact>')
    check.equal(body:find "<search_radius>%d" ~= nil, kind == "tied", body)
  end
  check.that(text:find "</MeshDomains>%s*<Contact>")
end

-- With a deck: two bodies of equal meshes fill its gap. Each shares the deck's nodes beside it, and they are
-- tied to each other and share none, whatever the scale.
do
  local prism = lacuna.synthetic.prism { sides = 4, height = 3 }
  local rest = prism:open_volume { source = "source", target = "target", walls = "auto" }
  local low, high = table.unpack(rest:cut { plane = { { 0, 0, 1 }, { 0, 0, 1 } } })
  local middle, top = table.unpack(high:cut { plane = { { 0, 0, 2 }, { 0, 0, 1 } } })
  local blocks = lacuna.assembly({ low, middle, top }):sweep { size = 0.5, layers = 2 }
  blocks:write(at "gap.inp")
  for _, scale in ipairs { 1, 1000 } do
    local deck = lacuna.load(at "gap.inp", { without = blocks.regions[2], scale = scale })
    local halves = {}
    for k, name in ipairs { "lower", "upper" } do
      local void = deck:open_volume { source = "cut_1", target = "cut_2", name = name, glued = k == 1 }
      void:close()
      halves[k] = void:cut { plane = { { 0, 0, 1.5 * scale }, { 0, 0, 1 } } }[k]
    end
    local filler = lacuna.assembly(halves):sweep { layers = 1 }
    check.equal(#filler.contacts, 1)
    for _, ending in ipairs { "inp", "bdf", "k", "feb" } do
      filler:write(at("joined." .. ending), { with = deck })
    end
    text = read(at "joined.inp")
    local pair = filler.contacts[1]
    check.that(text:find("*SURFACE, TYPE=ELEMENT, NAME=" .. pair.slave, 1, true))
    local tolerance = text:match("%*TIE, NAME=" .. pair.name .. ", POSITION TOLERANCE=([%d.E-]+), ADJUST" ..
      "=NO\n" .. pair.slave .. ", " .. pair.master .. "\n")
    check.that(tonumber(tolerance) < 1e-3, "in the deck's lengths")
    local heights = {}
    for z in text:match("%*NODE\n([^*]*)"):gmatch "%d+, [^,]+, [^,]+, ([^,\n]+)\n" do
      local at_height = ("%.3f"):format(tonumber(z))
      heights[at_height] = (heights[at_height] or 0) + 1
    end
    local layer = heights["0.000"]
    check.equal(heights["1.000"], layer)
    check.equal(heights["1.500"], 2 * layer)
    check.equal(heights["2.000"], layer)
    check.that(read(at "joined.k"):find("*CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET_ID", 1, true))
    check.that(read(at "joined.bdf"):find("BGSET", 1, true))
    check.that(read(at "joined.feb"):find("tied-elastic", 1, true))
  end
end

-- Other formats hold the groups, and a note says that there are no pairs.
for _, ending in ipairs { ".vtu", ".msh", ".unv", ".exo" } do
  check.write(at "note.lua", ([[
local lacuna = require "lacuna"
local bars = {}
for k = 1, 2 do
  local prism = lacuna.synthetic.prism { sides = 4, height = k }
  local whole = prism:open_volume { source = "source", target = "target", walls = "auto", name = "bar" .. k,
    glued = k == 1 }
  bars[k] = k == 1 and whole or whole:cut { plane = { { 0, 0, 1 }, { 0, 0, 1 } } }[2]
end
local mesh = lacuna.assembly(bars):sweep { size = 1, layers = 1 }
assert(#mesh.contacts == 1)
mesh:write("note%s")]]):format(ending))
  local code, out, err = check.run(params.lacuna, params.scratch, { "note.lua" })
  check.equal(code, 0, err)
  local note = "note: note%S+: ties and contacts are not written; [^\n]*_slave, [^\n]*_master"
  check.that((out .. err):find(note), ending .. out .. err)
end

-- A volume that is not glued and touches nothing is named in a note.
check.write(at "alone.lua", [[
local lacuna = require "lacuna"
local prism = lacuna.synthetic.prism { sides = 4 }
local volumes = {}
for k = 1, 2 do
  local whole = prism:open_volume { source = "source", target = "target", walls = "auto", name = "bar" .. k,
    glued = k == 1 }
  volumes[k] = whole:cut { plane = { { 0, 0, 0.6 + 0.4 * k }, { 0, 0, 1 } } }[k]
end
assert(#lacuna.assembly(volumes):sweep({ size = 1, layers = 1 }).contacts == 0)]])
local code, out, err = check.run(params.lacuna, params.scratch, { "alone.lua" })
check.equal(code, 0, err)
check.that((out .. err):find "note: bar2_2 is not glued, and is in contact with no volume", out .. err)

-- --- what is refused -------------------------------------------------------------------------------------

local function sweep(contacts)
  return function()
    lacuna.assembly { block("base", base), block("lid", lid) }
      :sweep { layers = 1, size = 1, contacts = contacts }
  end
end
check.fails(sweep { gap = -1 }, "gap", "0 or larger")
check.fails(sweep { type = "weld" }, "type", "tie")
check.fails(sweep { pairs = { { a = "base" } } }, "two regions")
check.fails(sweep { pairs = { "base" } }, "a table")
check.fails(sweep { pairs = { { a = "base", b = "lip" } } }, "no region", "lip", "lid")
check.fails(sweep { pairs = { { a = "base", b = "lid" } } }, "without common nodes", "glued = false")
check.fails(sweep { gaps = 1 }, "gap")
check.fails(function() lacuna.assembly { block("base", base) }:contacts { type = "tie" } end, "type")
check.fails(function() block("base", base):sweep { contacts = { gap = 1 } } end, "contacts")
check.fails(function()
  lacuna.assembly { block("a", base), block("a", lid, { glued = false }) }:sweep { size = 1 }
end, "two volumes", "a")
check.fails(function() -- through each other
  lacuna.assembly { block("a", base), block("b", raised(lid, -0.5), { glued = false }) }:sweep { size = 1 }
end, "may touch, but not overlap")
check.fails(function()
  local a, b = block("a", base), block("b", lid, { glued = false })
  local c = block("c", raised(base, -1), { glued = false })
  lacuna.assembly { a, b, c }:sweep { size = 1,
    contacts = { pairs = { { a = "a", b = "b", name = "x" }, { a = "a", b = "c", name = "x" } } } }
end, "two pairs", "x")

-- A gap narrower than what sides cut off the arcs is noted: the meshes may overlap before any load.
if lacuna.gmsh_version ~= "none" then
  check.write(at "fit.lua", [[
local lacuna = require "lacuna"
local curvature = lacuna.params { curvature = 12 }.curvature
local function body(name, text)
  local geo <close> = assert(io.open(name .. ".geo", "w"))
  geo:write('SetFactory("OpenCASCADE");' .. text)
  geo:close()
  return lacuna.load(name .. ".geo"):open_volume { name = name, glued = false }
end
local plate = body("plate", "Box(1) = {-40, -40, 0, 80, 80, 10}; Cylinder(2) = {0, 0, -1, 0, 0, 12, 10.05};"
  .. "BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }")
local pin = body("pin", "Cylinder(1) = {0, 0, -10, 0, 0, 30, 10};")
local mesh = lacuna.assembly { plate, pin }:sweep { size = 6, curvature = curvature,
  contacts = { gap = 0.06, type = "contact" } }
assert(#mesh.contacts == 1)
]])
  for curvature, noted in pairs { [12] = true, [100] = false } do
    local code, _, log = check.run(params.lacuna, params.scratch, { "fit.lua", "curvature=" .. curvature })
    check.equal(code, 0, log)
    check.equal(log:find("contact plate_pin: the faces come within 0.0", 1, true) ~= nil, noted, log)
  end
end

-- --- CalculiX --------------------------------------------------------------------------------------------

if params.ccx == "" then
  print "left out: calculix-ccx is not installed"
  check.done()
  return
end
local function solve(name, deck)
  check.write(at(name .. ".inp"), deck)
  local command = "cd '%s' && rm -f %s.dat && OMP_NUM_THREADS=1 '%s' %s > %s.log 2>&1"
  os.execute(command:format(params.scratch, name, params.ccx, name, name))
  local log, sum, count = read(at(name .. ".log")), { 0, 0, 0 }, 0
  check.that(not log:find "%*ERROR", name .. log:sub(-600))
  for line in read(at(name .. ".dat")):gmatch "[^\n]+" do
    local _, x, y, z = line:match "^%s*(%d+)%s+(%S+)%s+(%S+)%s+(%S+)%s*$"
    if x then
      count = count + 1
      for k, v in ipairs { x, y, z } do sum[k] = sum[k] + tonumber(v) end
    end
  end
  check.that(count > 0, name)
  for k = 1, 3 do sum[k] = sum[k] / count end
  return sum, log
end
local function loaded(deck, load)
  return deck .. [[
*MATERIAL, NAME=steel
*ELASTIC
210000., 0.3
*SOLID SECTION, ELSET=a, MATERIAL=steel
*SOLID SECTION, ELSET=b, MATERIAL=steel
*STEP
*STATIC
*BOUNDARY
a_source, 1, 3
]] .. load .. [[
*NODE PRINT, NSET=b_target
U
*END STEP
]]
end
local tall = { 0, 1, 0, 1, 0, 2 }
local function pair(glued, size_b, kind)
  local a, b = block("a", tall), block("b", raised(tall, 2), { glued = glued })
  local joined = lacuna.assembly { a, b }:sweep { layers = 4, element = nil, [a] = { size = 0.25 },
    [b] = { size = size_b }, contacts = { type = kind } }
  joined:write(at "pair.inp", { element = "C3D8I" })
  return read(at "pair.inp")
end
-- Peeled from the side and pulled, two blocks are as one where they are tied; also where their nodes differ.
local peel = "b_west, 1, 1, -0.01\n"
local pull = "b_target, 3, 3, 0.01\n"
for name, load in pairs { peel = peel, pull = pull } do
  local one = solve(name .. "_one", loaded(pair(true, 0.25), load))
  for size, bound in pairs { [0.25] = 1e-3, [0.35] = 1e-2 } do
    local tied = solve(name .. "_tied", loaded(pair(false, size), load))
    for k = 1, 3 do check.near(tied[k], one[k], bound * 0.01) end
  end
end
-- Pressed together they are as one, and CalculiX says that it found contact elements.
local press = "b_target, 3, 3, -0.01\nb_target, 1, 2\n"
local pressed, log = solve("pressed", loaded(pair(false, 0.25, "contact"), press))
check.near(pressed[3], -0.01, 1e-9)
check.that(log:find "[Cc]ontact", log:sub(1, 400))
check.done()
