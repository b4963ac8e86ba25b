-- SPDX-License-Identifier: MIT
-- The recipe language as RECIPES.md has it: names, kinds of results, what stays what.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"

-- The module.
check.equal(math.type(tonumber(lacuna.version:match("^%d+"))), "integer")
check.equal(type(lacuna.gmsh_version), "string")

-- Faces of a hand-made model: a unit cube without its lid.
local corners = {
  { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 },
}
local function cube(names)
  local sides = {
    bottom = { 4, 3, 2, 1 }, south = { 1, 2, 6, 5 }, east = { 2, 3, 7, 6 }, north = { 3, 4, 8, 7 },
        west = { 4, 1, 5, 8 },
    top = { 5, 6, 7, 8 },
  }
  local model, faces = lacuna.model(), {}
  for i, name in ipairs(names) do
    faces[i] = model:add_face { name = name, points = corners, cells = { sides[name] } }
  end
  return model, faces
end
local names = { "bottom", "south", "east", "north", "west" }
local model, added = cube(names)

for i, face in ipairs(added) do
  check.equal(face.tag, i, "tags count in the order of adding")
  check.equal(face.name, names[i])
  check.equal(face.kind, "plane")
  check.near(face.area, 1, 1e-14)
  check.equal(face.loops, 1)
  check.equal(face.edges, 4)
  check.equal(face.has_mesh, false)
  check.equal(#face.normal, 3)
  check.equal(#face.centroid, 3)
end
check.near(added[1].normal[3], -1, 1e-14)
check.near(added[1].centroid[1], 0.5, 1e-14)
check.equal(tostring(added[2]), 'face 2 "south"')

-- Faces by all that selects them; conditions are combined with "and".
check.equal(#model:faces(), 5)
check.equal(#model:faces {}, 5)
check.equal(#model:faces { tags = { 1, 3 } }, 2)
check.equal(#model:faces { tags = { 1, 3 }, name = "east" }, 1)
check.equal(#model:faces { name = "nobody" }, 0)
check.equal(#model:faces { kind = "plane" }, 5)
check.equal(#model:faces { facing = { 0, -2, 0.1 } }, 1)
check.equal(#model:faces { facing = { 1, 1, 0 } }, 0, "45 degrees are more than 30")
check.equal(#model:faces { area = { 0.5, math.huge } }, 5)
check.equal(#model:faces { area = { 2, 3 } }, 0)
check.equal(model:face { near = { 1.2, 0.5, 0.5 } }, added[3])
check.equal(model:face(4), added[4])
check.equal(model:face "west", added[5])
check.equal(model:face(added[5]), added[5])
check.that(added[1] ~= added[2])
check.fails(function() model:face(99) end, "99", '1 "bottom"')
check.fails(function() model:face { kind = "plane" } end, "selects 5:", '"bottom"', '"west"')

-- Roles by every way to name a face, and what becomes of them.
local function class_of(roles) return model:open_volume(roles).class end
check.equal(class_of { source = 1, walls = { 2, 3, 4, 5 } }, "IV")
check.equal(class_of { source = "bottom", walls = "auto" }, "IV")
check.equal(class_of { source = added[1], walls = { added[2], "east", 4, { tags = 5 } } }, "IV")
check.equal(class_of { source = { facing = { 0, 0, -1 } }, walls = { tags = { 2, 3, 4, 5 } } }, "IV")
check.equal(class_of { target = 1, walls = "auto", source = {} } , "IV")
check.equal(class_of { walls = { 2, 3, 4, 5 } }, "V")

-- A selection that found nothing is no way to say "none", until faces are put into it.
local nothing = model:faces { kind = "torus", area = { 2, 3 } }
check.equal(#nothing, 0)
check.fails(function() return class_of { source = nothing, walls = { 2, 3, 4, 5 } } end, "'source'",
  'model:faces{ area = …, kind = "torus" }', "empty result", "{}")
check.fails(function() return class_of { source = 1, walls = nothing } end, "'walls'", '"torus"')
nothing[1] = added[1]
check.equal(class_of { source = nothing, walls = "auto" }, "IV")

-- A volume, open and sealed.
local void = model:open_volume { source = 1, walls = "auto" }
local found = void:classify()
check.equal(found.class, "IV")
check.equal(found.free_loops, 1)
check.equal(#found.wall_free_source, 0)
check.equal(#found.wall_free_target, 0)
check.that(#found.reasons > 0)
check.equal(void:is_watertight(), false)
check.equal(#void:free_edges(), 4)
for _, edge in ipairs(void:free_edges()) do
  check.near(edge.length, 1, 1e-14)
  check.that(edge.tag > 0 and edge.from > 0 and edge.to > 0)
end
check.equal(void:override_class "IV", void)
check.fails(function() void:override_class "I" end, "I")
check.fails(function() void:override_class "VI" end, '"VI"', "closed")
check.that(void:tree():find('face 1 "bottom"', 1, true))
check.that(void:describe():find("class:  IV", 1, true))

local closure = void:close()
check.equal(closure.void_edges, 0)
check.equal(closure.void_faces, 1)
check.equal(closure.watertight, true)
check.that(#closure.algorithms > 0)
check.equal(void:close().void_faces, 1, "sealed once")
check.equal(void.class, "IV", "a volume keeps the class it was given with")
check.equal(void:is_watertight(), true)
check.equal(#void:free_edges(), 0)
check.fails(function() void:override_class "V" end, "before close()")
check.fails(function() void:close { edge_shape = "straight" } end, "sealed already")

-- Void edges: left smooth, and given by hand; a cap like the given end.
local function bend(drop)
  return lacuna.synthetic.prism { sides = 4, height = 4, bend = 90, facets = 8, drop = drop }
end
local straight = bend("walls"):open_volume { source = "source", target = "target" }
check.equal(straight:close { edge_shape = "straight" }.void_edges, 4)
local smooth = bend("walls"):open_volume { source = "source", target = "target" }
check.equal(smooth:close { edge_shape = "smooth", cap = "auto" }.void_edges, 4)
local sealed = smooth:sweep { layers = 12, size = 0.5 }
check.near(sealed:quality().volume, 8, 8 * 0.03)
check.that(straight:sweep { layers = 12, size = 0.5 }:quality().volume < 7)

local by_hand = bend("walls"):open_volume { source = "source", target = "target" }
local pair = by_hand:match().vertices[1]
check.fails(function() by_hand:close { void_edges = { { pair[1], 99 } } } end, "vertex 99")
check.fails(function() by_hand:close { cap = "flat" } end, "both given")
check.equal(by_hand:close { void_edges = { { pair[2], pair[1], { { 0.5, 0, 2 } } } } }.void_edges, 4)

-- A mesh: the count law, numbers from 1, groups that cover skin and volume.
local mesh = void:sweep { layers = 3, size = 0.5 }
check.equal(mesh.layers, 3)
check.equal(tostring(mesh.report), table.concat(mesh.report, "\n"))
local taken = 0
for stage, seconds in pairs(mesh.report.seconds) do
  check.equal(type(stage), "string")
  check.that(seconds >= 0)
  taken = taken + 1
end
check.that(taken >= 4, taken .. " stages")
check.equal(mesh.hexes % 3, 0)
check.equal(mesh.nodes % 4, 0)
check.that(mesh.hexes >= 12)
local low, high = math.huge, -math.huge
for i = 1, mesh.hexes do
  local cell = { mesh:hex(i) }
  check.equal(#cell, 8)
  low, high = math.min(low, table.unpack(cell)), math.max(high, table.unpack(cell))
end
check.equal(low, 1)
check.equal(high, mesh.nodes)
check.equal(select("#", mesh:node(mesh.nodes)), 3)
check.fails(function() mesh:node(0) end, "from 1 to", "found 0")
check.fails(function() mesh:hex(mesh.hexes + 1) end, "from 1 to")
for kind, columns in pairs { wedge = 6, pyramid = 5, tet = 4 } do
  local none = mesh:cells(kind)
  check.equal(("%d %d %s"):format(none.rows, none.columns, none.type), ("0 %d int32"):format(columns))
end
check.fails(function() mesh:cells("prism") end, "lua.bad_value")
check.fails(function() model:face { 999 } end, "the argument's value [1]", "999")
local cells = {}
for _, group in ipairs(mesh:groups()) do
  cells[group.name] = group.cells
  check.that(group.dim == 2 or group.dim == 3)
end
check.equal(cells.volume, mesh.hexes)
check.equal(cells.source * 3, mesh.hexes)
check.equal(cells.target, cells.source)
check.that(cells.bottom == cells.source, "names the faces had are kept")
local quality = mesh:quality()
check.equal(quality.inverted, 0)
check.equal(quality.certified, true)
check.that(quality.min_scaled_jacobian > 0 and quality.min_scaled_jacobian <= quality.mean_scaled_jacobian)
check.near(quality.volume, 1, 1e-12)
local binned = 0
for _, cells_in_bin in ipairs(quality.histogram) do binned = binned + cells_in_bin end
check.equal(binned, mesh.hexes)
check.that(#quality.worst > 0 and quality.worst[1].scaled_jacobian == quality.min_scaled_jacobian)
check.equal(quality.metrics[1].min, quality.min_scaled_jacobian)
check.that(tostring(quality):find("\n"), "quality prints as a table")
check.that(tostring(quality):find("shape: volume", 1, true), "with a line on the shape")
local shape = mesh.fidelity
check.near(shape.volume, 1, 1e-12)
check.near(shape.sealed_volume, 1, 1e-12)
check.that(shape.max_distance < 1e-9 and shape.mean_distance <= shape.max_distance)
local on_faces = 0
for tag, face in pairs(shape.faces) do
  check.that(math.type(tag) == "integer" or tag:find("^void:%d+$"), "faces go by tag or group")
  check.that(face.max_distance < 1e-9 and face.mean_distance <= face.max_distance and #face.place == 3)
  on_faces = on_faces + face.quads
end
check.that(on_faces > 0)

-- Written and read again.
local path = os.tmpname()
os.remove(path)
path = path .. ".msh"
for _, options in ipairs { {}, { binary = false }, { version = 2.2 } } do
  mesh:write(path, options)
  local again = lacuna.check(path)
  check.equal(again.hexes, mesh.hexes)
  check.near(again.min_scaled_jacobian, quality.min_scaled_jacobian, 1e-12)
  os.remove(path)
end

for _, ending in ipairs { ".vtu", ".vtk" } do
  local other = path:gsub("%.msh$", ending)
  mesh:write(other)
  local file <close> = assert(io.open(other, "rb"))
  check.that(file:seek "end" > mesh.nodes * 3 * 8, "the coordinates alone are longer than that")
  os.remove(other)
end

-- Roles that are found rather than named.
local whole = lacuna.synthetic.barrel()
for _, roles in ipairs { {}, { faces = { 1, 2, 3 } }, { faces = { "source", "target", "wall_1" } } } do
  local guessed = whole:open_volume(roles)
  check.equal(guessed.class, "closed")
  check.that(guessed:describe():find("likely roles:", 1, true))
end
check.equal(whole:open_volume().class, "closed")
check.equal(lacuna.synthetic.barrel({ drop = "target" }):open_volume().class, "IV")
check.equal(lacuna.synthetic.elbow({ drop = { "source", "target" } }):open_volume().class, "V")

-- What a model is made of, as a table and in words, from one source.
local plate = lacuna.synthetic.plate { holes = 2 }
local told, words = plate:info(), plate:describe()
check.equal(#told.faces, #plate:faces())
check.equal(#told.cavities, 2)
check.equal(#plate:cavities(), 2)
check.equal(told.closed_parts, 1)
check.equal(#told.free_edges, 0)
for i, cavity in ipairs(told.cavities) do
  check.equal(cavity.kind, "bore")
  check.equal(plate:open_volume({ faces = cavity.faces }).class, cavity.class)
  check.that(words:find("bore: open_volume{ faces = { " .. table.concat(cavity.faces, ", "), 1, true))
  local bore = plate:face(cavity.faces[1])
  check.equal(told.faces[1].use, "outer skin")
  check.that(bore.radius > 0 and #bore.axis == 3 and #bore.box == 2 and #bore.neighbours == 2)
end
local holed = lacuna.synthetic.plate { drop = "target" }
check.that(#holed:info().free_edges > 0 and holed:describe():find("free edges: ", 1, true))
check.fails(function() plate:open_volume { faces = { 1, 2 }, reading = 9 } end, "reading")

-- Every way to give layers and sizes makes the layers asked for.
local function swept(options)
  return cube(names):open_volume({ source = 1, walls = "auto" }):sweep(options)
end
check.equal(swept({ layers = 2, size = 0.5 }).layers, 2)
check.equal(swept({ layers = { 0.2, 0.5, 1 }, size = 0.5 }).layers, 3)
for _, mode in ipairs { "geometric", "bell", "both_ends" } do
  check.equal(swept({ layers = { count = 4, bias = 2, mode = mode }, size = 0.5 }).layers, 4)
end
local calls = 0
local graded = swept { layers = 1, size = function(x, y, z)
  check.that(x > -1 and x < 2 and y > -1 and y < 2 and z > -1 and z < 2)
  calls = calls + 1
  return 0.25
end }
check.that(calls > 0)
check.that(graded.hexes >= 12)

-- A size function that fails, with its own message, or gives nonsense.
check.fails(function() swept { layers = 1, size = function() error("no size here") end } end, "no size here")
local thrown = {}
local fine, caught = pcall(swept, { layers = 1, size = function() error(thrown) end })
check.that(not fine and rawequal(caught, thrown), "any Lua value can be thrown through the kernel")
for _, nonsense in ipairs { 0, -1, 0 / 0, math.huge, "1", {} } do
  check.fails(function() swept { layers = 1, size = function() return nonsense end } end, "option 'size'",
      "positive number")
end
check.fails(function() swept { layers = 1, size = function() coroutine.yield() end } end, "yield")

-- Objects may be released early, and say so.
local kept
do
  local early <close> = cube(names)
  kept = early
end
check.fails(function() kept:faces() end, "released")
check.fails(function() model.faces {} end, "colon")
check.fails(function() return model.open_volum end, "nearest is 'open_volume'")
check.fails(function() cube(names):face(added[1]) end, "another model")

-- The language server's stub names every function there is, and no other.
local stub <close> = assert(io.open(arg[0]:match("^(.*/)") .. "../../lua/lacuna.d.lua"))
local stubbed = { Model = {}, Volume = {}, Mesh = {}, Assembly = {}, AssemblyMesh = {}, QuadMesh = {},
  Buffer = {},
  lacuna = {}, synthetic = {} }
for line in stub:lines() do
  local owner, name = line:match("^function ([%w]+)[.:]([%w_]+)%(")
  if owner then stubbed[owner][name] = true end
end
local prism = lacuna.synthetic.prism {}
local space = prism:open_volume { source = "source", target = "target", walls = "auto" }
local assembly = lacuna.assembly { space }
local real = {
  Model = debug.getmetatable(model).methods, Volume = debug.getmetatable(void).methods,
  Mesh = debug.getmetatable(mesh).methods, Assembly = debug.getmetatable(assembly).methods,
  AssemblyMesh = debug.getmetatable(assembly:sweep { layers = 2, size = 1 }).methods, lacuna = lacuna,
  QuadMesh = debug.getmetatable(prism:quads { size = 1 }).methods,
  Buffer = debug.getmetatable(mesh:cells()).methods, synthetic = lacuna.synthetic,
}
for owner, functions in pairs(real) do
  for name, value in pairs(functions) do
    if type(value) == "function" then
      check.that(stubbed[owner][name], owner .. "." .. name .. " is not in the stub")
    end
  end
  for name in pairs(stubbed[owner]) do
    check.equal(type(functions[name]), "function", owner .. "." .. name .. " of the stub")
  end
end

check.done()
