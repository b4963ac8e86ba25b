-- SPDX-License-Identifier: MIT
-- What errors, notes and lists say to type works when it is typed.
-- usage: lacuna remedies.lua scratch=FOLDER lacuna=PROGRAM [cad=false]
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = ".", cad = true }
local function at(name) return params.scratch .. "/" .. name end

--- What the program says on standard error of a recipe, which may fail.
local function said_of(recipe)
  check.write(at "recipe.lua", 'local lacuna = require "lacuna"\n' .. recipe)
  local code, _, err = check.run(params.lacuna, params.scratch, { at "recipe.lua" })
  return err, code
end

local function refusal(call, code)
  local fine, found = pcall(call)
  check.that(not fine, "nothing failed")
  check.equal(found.code, code, tostring(found))
  return found.message
end

--- Faces of a prism: "source" below, "target" above, walls "w1" ….
local function prism(sides, height, names)
  local model, low, high = lacuna.model(), {}, {}
  for i = 1, sides do
    local a = 2 * math.pi * i / sides
    low[i], high[i] = { math.cos(a), math.sin(a), 0 }, { math.cos(a), math.sin(a), height }
  end
  local function fan(name, points)
    local cells = {}
    for i = 2, sides - 1 do cells[#cells + 1] = { 1, i, i + 1 } end
    model:add_face { name = name, points = points, cells = cells }
  end
  if names.source ~= false then fan("source", low) end
  if names.target ~= false then fan("target", high) end
  for i = 1, sides do
    local j = i % sides + 1
    if names.walls == nil or names.walls[i] then
      model:add_face { name = "w" .. i, points = { low[i], low[j], high[j], high[i] },
        cells = { { 1, 2, 3, 4 } } }
    end
  end
  return model, low, high
end
local function volume_of(sides, height) return sides / 2 * math.sin(2 * math.pi / sides) * height end

-- --- faces that hang on a closed skin are named ------------------------------------------------------------

for _, sides in ipairs { 3, 4, 7 } do
  for length = 1, 3 do
    local model, low = prism(sides, 2, {})
    for k = 1, length do
      local function out(i, by) return { (1 + by) * low[i][1], (1 + by) * low[i][2], 0 } end
      model:add_face { name = "fin" .. k, points = { out(1, k - 1), out(2, k - 1), out(2, k), out(1, k) },
        cells = { { 1, 2, 3, 4 } } }
    end
    local message = refusal(function() model:open_volume() end, "topology.not_manifold")
    local advice, left, faces = message:match "leave out (.*): without", {}, {}
    check.that(advice, message)
    for name in advice:gmatch '"([^"]+)"' do left[name] = true end
    for k = 1, length do check.that(left["fin" .. k], message) end
    for _, face in ipairs(model:faces()) do
      if not left[face.name] then faces[#faces + 1] = face end
    end
    local mesh = model:open_volume({ faces = faces }):sweep { size = 0.5 }
    check.near(mesh:quality().volume, volume_of(sides, 2), 1e-9)
  end
end

-- --- walls that exist nowhere ------------------------------------------------------------------------------

-- Walls beside a path may be any of those that the path makes.
for _, sides in ipairs { 3, 4, 6 } do
  for subset = 1, 2 ^ sides - 2 do
    local walls, named = {}, {}
    for i = 1, sides do
      walls[i] = subset >> (i - 1) & 1 == 1
      if walls[i] then named[#named + 1] = "w" .. i end
    end
    local model = prism(sides, 2, { target = false, walls = walls })
    local void = model:open_volume { source = "source", walls = named, along = { vector = { 0, 0, 2 } } }
    check.near(void:sweep({ size = 1 }):quality().volume, volume_of(sides, 2), 1e-9)
  end
end
-- The refusal gives the vector.
for _, sides in ipairs { 3, 4, 6 } do
  for _, height in ipairs { 0.5, 3 } do
    local model = prism(sides, height, { target = false, walls = { true } })
    local message = refusal(function()
      model:open_volume({ source = "source", walls = "w1" }):sweep { size = 1 }
    end, "closure.wall_missing")
    local along = message:match "along = (%b{})"
    check.that(along, message)
    local void = model:open_volume { source = "source", walls = "w1", along = load("return " .. along)() }
    check.near(void:sweep({ size = 1 }):quality().volume, volume_of(sides, height), 1e-9)
    -- Nor do two faces without roles determine a volume.
    refusal(function() model:open_volume():sweep() end, "topology.no_roles")
  end
end

-- --- a size does not change quads that are kept -----------------------------------------------------------

for _, sides in ipairs { 6, 8, 12 } do
  for _, bulge in ipairs { 0.2, 0.5 } do
    local recipe = ([[
local sides, rows, model = %d, 12, lacuna.model()
local function place(i, k)
  local a, r = 2 * math.pi * i / sides, 1 + %g * math.sin(math.pi * k / rows)
  return { r * math.cos(a), r * math.sin(a), 2 * k / rows }
end
local disc, quads, wall, cells = {}, {}, {}, {}
for i = 0, sides - 1 do disc[i + 1] = place(i, 0) end
disc[sides + 1] = { 0, 0, 0 }
for i = 1, sides, 2 do quads[#quads + 1] = { i, i + 1, (i + 1) %% sides + 1, sides + 1 } end
model:add_face { name = "source", points = disc, cells = quads, keep_mesh = true }
for k = 0, rows do
  for i = 0, sides - 1 do wall[#wall + 1] = place(i, k) end
end
for k = 0, rows - 1 do
  for i = 0, sides - 1 do
    local j = (i + 1) %% sides
    local low, high = k * sides + 1, (k + 1) * sides + 1
    cells[#cells + 1] = { low + i, low + j, high + j, high + i }
  end
end
model:add_face { name = "wall", points = wall, cells = cells }
local void = model:open_volume { source = "source", walls = "wall" }
]]):format(sides, bulge)
    local said, code = said_of(recipe .. "void:sweep { layers = 2 }")
    check.equal(code, 0, said)
    local quads, size, layers = said:match 'quads = ("%l+"), size = ([%d.]+) and layers = (%d+)'
    check.that(quads, said)
    for _, options in ipairs { ("layers = %s"):format(layers),
      ("quads = %s, size = %s, layers = %s"):format(quads, size, layers) } do
      local told, fine = said_of(recipe .. "void:sweep { " .. options .. " }")
      check.that(fine == 0 and not told:find("volume than the sealed shape", 1, true), told)
    end
  end
end

-- --- decks -------------------------------------------------------------------------------------------------

-- A bore through two regions is one cavity, in every format that has regions.
for _, ending in ipairs { "inp", "bdf", "k", "unv", "msh", "vtu" } do
  local tube = lacuna.synthetic.annulus { inner = 1, outer = 2, height = 3 }
  local whole = tube:open_volume { source = "source", target = "target", walls = "auto", name = "tube" }
  local halves = whole:cut { plane = { { 0, 0, 1 }, { 0, 0, 1 } } }
  local mesh = lacuna.assembly(halves):sweep { size = 0.5 }
  mesh:write(at("tube." .. ending))
  local deck = lacuna.load(at("tube." .. ending))
  local found = deck:cavities()
  check.equal(#found, 1, ending)
  check.equal(found[1].kind, "bore", ending)
  local filled = deck:open_volume({ faces = found[1].faces }):sweep { size = 0.5 }
  check.near(filled:quality().volume, found[1].volume, 0.02 * found[1].volume)
end

-- A material that the deck lacks is noted before meshing, and one that is taken from a neighbour when it is.
do
  local pieces = {}
  local rest = lacuna.synthetic.prism({ sides = 4, height = 3 }):open_volume {
    source = "source", target = "target", walls = "auto", name = "bar" }
  pieces[1], rest = table.unpack(rest:cut { plane = { { 0, 0, 1 }, { 0, 0, 1 } } })
  pieces[2], pieces[3] = table.unpack(rest:cut { plane = { { 0, 0, 2 }, { 0, 0, 1 } } })
  local mesh = lacuna.assembly(pieces):sweep { size = 0.5, layers = 2 }
  mesh:write(at "bar.inp")
  local file <close> = assert(io.open(at "bar.inp", "a"))
  file:write "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000, 0.3\n"
  for _, region in ipairs(mesh.regions) do
    file:write("*SOLID SECTION, ELSET=", region, ", MATERIAL=STEEL\n")
  end
  file:close()
  for _, whole in ipairs { "void", "lacuna.assembly { void }" } do
    for _, material in ipairs { "", "steel", "RUBBER" } do
      local said = said_of(([[
local deck = lacuna.load("bar.inp", { without = "%s" })
local void = deck:open_volume { source = "cut_1", target = "cut_2", name = "foam", material = %s }
io.stderr:write "opened\n"
%s:sweep({ layers = 2 }):write("filled.inp", { with = deck })
]]):format(mesh.regions[2], material == "" and "nil" or ("%q"):format(material), whole))
      local before, after = said:match "^(.*)opened(.*)$"
      check.equal(before:find("note: material = RUBBER: [^\n]*STEEL") ~= nil, material == "RUBBER", said)
      check.equal(after:find("io.no_material", 1, true) ~= nil, material == "RUBBER", said)
      check.equal(after:find("note: foam: its material is STEEL", 1, true) ~= nil, material == "", said)
    end
  end
end

if not params.cad then
  check.done()
  return
end

-- --- lists of cavities -------------------------------------------------------------------------------------

-- The outside of a flanged bend is no inner void, also where bolt holes join both sides of a flange.
for _, bolts in ipairs { 0, 4, 6 } do
  for _, degrees in ipairs { 45, 90 } do
    local lines = { 'SetFactory("OpenCASCADE");' }
    local function add(...) lines[#lines + 1] = (...):format(select(2, ...)) end
    local a = math.rad(degrees)
    local ends = { { { 60, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 } },
      { { 60 * math.cos(a), 0, -60 * math.sin(a) }, { -math.sin(a), 0, -math.cos(a) },
        { math.cos(a), 0, -math.sin(a) } } }
    for k, radius in ipairs { 20, 15 } do add("Disk(%d) = {60, 0, 0, %g};", k, radius) end
    for k = 1, 2 do
      add("b%d() = Extrude { {0, 1, 0}, {0, 0, 0}, %.15g } { Surface{%d}; };", k, a, k)
    end
    for k, frame in ipairs(ends) do
      local o, t, n = table.unpack(frame)
      add("Cylinder(%d) = {%.15g, 0, %.15g, %.15g, 0, %.15g, 35};", 100 + k, o[1], o[3], 8 * t[1], 8 * t[3])
      add("Cylinder(%d) = {%.15g, 0, %.15g, %.15g, 0, %.15g, 15};", 200 + k, o[1], o[3], 9 * t[1], 9 * t[3])
      for i = 1, bolts do
        local u, v = 28 * math.cos(2 * math.pi * i / bolts), 28 * math.sin(2 * math.pi * i / bolts)
        add("Cylinder(%d) = {%.15g, %.15g, %.15g, %.15g, 0, %.15g, 2.5};", 200 + 10 * i + k,
          o[1] + u * n[1] - t[1], v, o[3] + u * n[3] - t[3], 12 * t[1], 12 * t[3])
      end
    end
    add "u() = BooleanUnion{ Volume{b1(1)}; Delete; }{ Volume{101, 102}; Delete; };"
    local tools = { "201", "202" }
    for i = 1, bolts do tools[#tools + 1] = ("%d, %d"):format(201 + 10 * i, 202 + 10 * i) end
    add("BooleanDifference{ Volume{u(0)}; Delete; }{ Volume{b2(1), %s}; Delete; }", table.concat(tools, ", "))
    check.write(at "bend.geo", table.concat(lines, "\n") .. "\n")
    local bores = 0
    for _, cavity in ipairs(lacuna.load(at "bend.geo"):cavities()) do
      check.that(cavity.kind ~= "inner void", "the outside of a bend")
      if cavity.kind == "bore" then bores = bores + 1 end
    end
    check.equal(bores, 1 + 2 * bolts)
  end
end

-- The faces that a note gives for a pocket are those of the body in it, too, whatever its tags are.
for _, first in ipairs { "stem", "bone" } do
  local solids = {
    stem = "Cone(1) = {0, 0, 14, 0, 0, 116, 4, 8};\nSphere(2) = {0, 0, 14, 4};\n" ..
      "BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };\n",
    bone = "Cone(4) = {0, 0, 14, 0, 0, 116, 5, 9};\nSphere(5) = {0, 0, 14, 5};\n" ..
      "BooleanUnion(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };\n" ..
      "Cylinder(7) = {0, 0, -10, 0, 0, 140, 18};\n" ..
      "BooleanDifference(8) = { Volume{7}; Delete; }{ Volume{6}; Delete; };\n" }
  local paths = {}
  for k, name in ipairs { first, first == "stem" and "bone" or "stem" } do
    paths[k] = name .. ".geo"
    check.write(at(paths[k]), 'SetFactory("OpenCASCADE");\n' .. solids[name])
  end
  local load_both = ("local model = lacuna.load { %q, %q }\n"):format(paths[1], paths[2])
  local said = said_of(load_both .. "model:open_volume()")
  local faces = said:match "bodies in it%) give faces=(%b{})"
  check.that(faces, said)
  local told, code = said_of(load_both .. ([[
local mesh = model:open_volume({ faces = %s }):sweep { size = 2 }
assert(math.abs(mesh:quality().volume / 4860 - 1) < 0.02, mesh:quality().volume)
]]):format(faces))
  check.equal(code, 0, told)
end

check.done()
