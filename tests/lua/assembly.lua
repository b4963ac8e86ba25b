-- SPDX-License-Identifier: MIT
-- Assemblies in recipes: what they take, what their mesh tells, what they write.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")
local params = lacuna.params { lacuna = "", scratch = "." }

local function open(model, name)
  return model:open_volume { source = "source", target = "target", walls = "auto", name = name }
end
local function core(name) return open(lacuna.synthetic.prism { sides = 6, radius = 1, height = 2 }, name) end
local function ring(name)
  return open(lacuna.synthetic.prism { sides = 6, radius = 2, height = 2, holes = 1, hole_radius = 1,
    drop = { "wall_2" } }, name)
end

-- One table for all, and options of one volume over them.
local a, b = core "core", ring()
local assembly = lacuna.assembly { a, b }
check.equal(tostring(assembly), "Assembly of 2 volumes")
local mesh = assembly:sweep { size = 0.4, [a] = { layers = 5 } }
check.equal(table.concat(mesh.regions, " "), "core volume_2")
check.equal(mesh.layers.core, 5)
check.equal(mesh.layers.volume_2, 5, "side by side, as many layers")
check.near(mesh.fidelity.volume, 12 * math.sqrt(3), 1e-9)
check.near(mesh.fidelity.regions.core.volume, 3 * math.sqrt(3), 1e-9)
check.equal(mesh:quality().certified, true)
check.equal(mesh:quality().hexes, mesh.hexes)

-- Nodes and cells are those of the whole, each node once.
local places, seen = {}, {}
for i = 1, mesh.nodes do
  local x, y, z = mesh:node(i)
  local key = ("%.12f %.12f %.12f"):format(x, y, z)
  check.that(not places[key], "node " .. i .. " is where node " .. tostring(places[key]) .. " is")
  places[key] = i
end
for i = 1, mesh.hexes do
  for _, n in ipairs { mesh:hex(i) } do seen[n] = true end
end
for i = 1, mesh.nodes do check.that(seen[i], "node " .. i .. " is of a cell") end
check.fails(function() mesh:node(mesh.nodes + 1) end, "node", "from 1 to")

local groups = {}
for _, group in ipairs(mesh:groups()) do groups[group.name] = group end
check.equal(groups.core.dim, 3)
check.equal(groups.core.cells + groups.volume_2.cells, mesh.hexes)
check.that(groups["core:wall:3"], "walls are told apart by their regions")

-- Every format; the quads are the skin of the whole, or those between the volumes too.
for _, ending in ipairs { ".msh", ".vtu", ".vtk", ".inp", ".bdf", ".unv" } do
  local path = params.scratch .. "/assembly" .. ending
  mesh:write(path)
  check.equal(lacuna.check(path).hexes, mesh.hexes, ending)
end
local function faces_of(path)
  local quads = 0
  for _, face in ipairs(lacuna.load(path):faces()) do quads = quads + face.area end
  return quads
end
mesh:write(params.scratch .. "/inside.msh", { interfaces = true })
check.equal(lacuna.check(params.scratch .. "/inside.msh").hexes, mesh.hexes)
check.fails(function() mesh:write(params.scratch .. "/a.msh", { quality = true }) end, "quality")
check.fails(function() core():sweep { size = 1 }:write(params.scratch .. "/a.msh", { interfaces = true }) end,
  "interfaces")

-- The calls of a Mesh: order 2 with nodes in the middle that both volumes have, regions, wedges.
check.equal(table.concat(core "alone":sweep { size = 0.5 }.regions, " "), "alone")
check.equal(mesh.order, 1)
check.equal(mesh.wedges, 0)
check.that(next(mesh.fidelity.regions.core.faces), "faces of a region")
check.equal(mesh.fidelity.faces, nil, "tags of faces are each volume's own")
check.fails(function() mesh:wedge(1) end, "wedge")
for _, serendipity in ipairs { false, true } do
  local curved = assembly:sweep { size = 0.6, order = 2, serendipity = serendipity }
  check.equal(curved.order, 2)
  check.equal(curved:quality().certified, true)
  check.near(curved:quality().volume, 12 * math.sqrt(3), 1e-9)
  local at = {}
  for i = 1, curved.nodes do
    local key = ("%.12f %.12f %.12f"):format(curved:node(i))
    check.that(not at[key], "node " .. i .. " is where node " .. tostring(at[key]) .. " is")
    at[key] = i
  end
  for _, ending in ipairs { ".msh", ".vtu", serendipity and ".inp" or ".vtk" } do
    local path = params.scratch .. "/curved" .. ending
    curved:write(path)
    check.equal(lacuna.check(path).hexes, curved.hexes, ending)
  end
end
check.fails(function() assembly:sweep { size = 0.6, order = 2, [a] = { order = 1 } } end, "core", "order")

-- What is refused.
check.fails(function() lacuna.assembly {} end, "give volumes")
check.fails(function() lacuna.assembly { a, a } end, "volumes[2]", "already")
check.fails(function() lacuna.assembly { a, 3 } end, "volumes[2]", "a Volume")
check.fails(function() assembly:sweep { [core()] = {} } end, "volumes of the assembly")
check.fails(function() assembly:sweep { size = 0.4, [a] = { layers = 5 }, [b] = { layers = 6 } } end,
  "core", "volume_2", "5 and 6", "assembly.layers")
check.fails(function() assembly:sweep { sise = 0.4 } end, "sise", "size")
check.fails(function() assembly:sweep { size = 0.4, [a] = { [b] = { layers = 2 } } } end,
  "one volume", "names of options")
local round = { size = 0.4 }
round[a] = round
check.fails(function() assembly:sweep(round) end, "one volume", "names of options")
-- A face that some volume has may be named for all; one that none has may not, nor one of another volume.
for _, option in ipairs { "boundary_layers", "intervals" } do
  local function of(name)
    return option == "intervals" and { { name, 7 } } or { walls = name, first = 0.01, count = 2 }
  end
  check.fails(function() assembly:sweep { size = 0.4, [option] = of "wal_1" } end,
    option, '"wal_1"', 'nearest is "wall_1"', "no volume", "surface.no_such_face")
  check.fails(function() assembly:sweep { size = 0.4, [a] = { [option] = of "typo" } } end,
    option .. "' of core", "core does not have", "surface.no_such_face")
end
check.fails(function()
  assembly:sweep { size = 0.4, boundary_layers = { walls = 77, first = 0.01, count = 2 } }
end, "boundary_layers", "face 77", "no volume", "surface.no_such_face")
check.fails(function() lacuna.assembly { core "x", ring "x" }:sweep { size = 0.4 } end, 'named "x"')

-- A volume that is being swept cannot be part of one.
check.fails(function()
  assembly:sweep { layers = 2, size = function()
    a:sweep { layers = 2, size = 0.4 }
    return 0.4
  end }
end, "sweep")
-- Steps: what stands in a box gets room above it.
local function boxed()
  local model = lacuna.model()
  local function quad(name, a, b, c, d)
    model:add_face { name = name, points = { a, b, c, d }, cells = { { 1, 2, 3, 4 } } }
  end
  local function sides(name, low, high, z1, z2, inward)
    local p = { { low, low }, { high, low }, { high, high }, { low, high } }
    for i = 1, 4 do
      local a, b = p[i], p[i % 4 + 1]
      if inward then a, b = b, a end
      quad(name .. i, { a[1], a[2], z1 }, { b[1], b[2], z1 }, { b[1], b[2], z2 }, { a[1], a[2], z2 })
    end
  end
  model:add_face { name = "floor", points = { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 },
      { 1, 1, 0 }, { 3, 1, 0 }, { 3, 3, 0 }, { 1, 3, 0 } },
    cells = { { 1, 5, 6, 2 }, { 2, 6, 7, 3 }, { 3, 7, 8, 4 }, { 4, 8, 5, 1 } } }
  quad("top", { 1, 1, 1.5 }, { 1, 3, 1.5 }, { 3, 3, 1.5 }, { 3, 1, 1.5 })
  quad("lid", { 0, 0, 4 }, { 4, 0, 4 }, { 4, 4, 4 }, { 0, 4, 4 })
  sides("side_", 0, 4, 0, 4, false)
  sides("skin_", 1, 3, 0, 1.5, true)
  return model
end
local model = boxed()
local walls = {}
for _, face in ipairs(model:faces()) do
  if face.name:find "^s" then walls[#walls + 1] = face end
end
local function stepped()
  return model:open_volume { source = { "floor", "top" }, target = "lid", walls = walls }
end
local whole = stepped():sweep { layers = 8, size = 0.5, quads = "paved" }
check.equal(#whole.regions, 2)
check.equal(whole.layers.piece_1, 8)
check.equal(whole.layers.piece_2, 5)
check.near(whole.fidelity.volume, 64 - 6, 1e-9)
check.equal(whole:quality().certified, true)
local pieces = stepped():cut()
check.equal(#pieces, 2)
check.near(lacuna.assembly(pieces):sweep { size = 0.5 }.fidelity.volume, 58, 1e-9)
check.done()

-- A gap a little wider than the tolerance is named, with the tolerance that closes it.
local function slab(z, tolerance, name)
  local model = lacuna.model { tolerance = tolerance }
  local function quad(name, a, b, c, d)
    model:add_face { name = name, points = { a, b, c, d }, cells = { { 1, 2, 3, 4 } } }
  end
  quad("source", { 0, 0, z }, { 1, 0, z }, { 1, 1, z }, { 0, 1, z })
  quad("target", { 0, 0, z + 1 }, { 1, 0, z + 1 }, { 1, 1, z + 1 }, { 0, 1, z + 1 })
  quad("side", { 0, 0, z }, { 1, 0, z }, { 1, 0, z + 1 }, { 0, 0, z + 1 })
  return open(model, name or ("at_%.0f"):format(z))
end
local apart = lacuna.assembly { slab(0), slab(1.0001) }:sweep { size = 0.5 }
local miss = apart.report.near_misses[1]
check.equal(#apart.report.near_misses, 1)
check.equal(miss.a .. " " .. miss.b, "at_0 at_1")
check.equal(miss.face_a .. " " .. miss.face_b, "2 1")
check.near(miss.width, 1e-4, 1e-9)
check.near(miss.area, 1, 1e-9)
check.that(not miss.reach_in and not miss.edge)
check.that(tostring(apart.report):find(miss.message, 1, true), "the report has it")
local wider = miss.tolerance
local together = lacuna.assembly { slab(0, wider), slab(1.0001, wider) }:sweep { size = 0.5 }
check.equal(#together.report.near_misses, 0)
check.equal(apart.nodes - together.nodes, 9)

-- Meshes made before stay as they are: their cells, names and numbers of layers.
local function layer(z, name) return slab(z, nil, name) end
local first = layer(0, "first"):sweep { size = 0.4, layers = { count = 4, bias = 2 }, quads = "paved" }
local both = lacuna.assembly { layer(1, "second"), first }
check.equal(tostring(both), "Assembly of 1 volumes and 1 mesh")
local two = both:sweep { size = 0.25 }
check.equal(table.concat(two.regions, " "), "second first")
check.equal(two.layers.first, 4)
check.near(two.fidelity.volume, 2, 1e-9)
check.equal(two:quality().certified, true)
local function places_of(mesh)
  local at = {}
  for i = 1, mesh.nodes do at[("%.17g %.17g %.17g"):format(mesh:node(i))] = true end
  return at
end
local function check_kept(mesh, before)
  local at = places_of(mesh)
  for i = 1, before.nodes do
    check.that(at[("%.17g %.17g %.17g"):format(before:node(i))], "node " .. i .. " stays where it is")
  end
end
check_kept(two, first)
-- Again, with what came out; the mesh of an assembly is as many regions as it has.
local three = lacuna.assembly { two, layer(2, "third") }:sweep { size = 0.5 }
check.equal(table.concat(three.regions, " "), "second first third")
check_kept(three, two)
check.near(three.fidelity.volume, 3, 1e-9)
local names = {}
for _, group in ipairs(three:groups()) do
  check.that(not names[group.name], group.name .. " is there once")
  names[group.name] = group
end
check.equal(names.first.cells, first.hexes)
check.that(names["second:source"] and names["third:target"] and names["first:source"])
for _, ending in ipairs { ".msh", ".inp", ".vtu" } do
  three:write(params.scratch .. "/fixed" .. ending)
  check.equal(lacuna.check(params.scratch .. "/fixed" .. ending).hexes, three.hexes, ending)
end
check.equal(lacuna.assembly({ first }):sweep().nodes, first.nodes)
check.fails(function() lacuna.assembly { first, first } end, "array already")
check.fails(function() lacuna.assembly { first, layer(1, "first") }:sweep { size = 1 } end, "first")
check.fails(function() lacuna.assembly { first, 7 } end, "AssemblyMesh")
check.fails(function() lacuna.assembly { first, layer(1) }:sweep { size = 1, [first] = { layers = 2 } } end,
  "keys")

-- A volume whose faces came with quads keeps them, however much finer its neighbour is to be.
do
  local path = params.scratch .. "/kept.inp"
  slab(0, nil, "kept"):sweep { layers = 2, size = 0.5 }:write(path)
  for _, size in ipairs { 0.5, 0.2 } do
    local kept = lacuna.load(path):open_volume { source = "source", target = "target", walls = "auto",
      name = "kept" }
    local mesh = lacuna.assembly { kept, slab(1) }:sweep { size = size }
    check.equal(mesh.layers.kept, 2)
    check.equal(mesh.layers.at_1, size == 0.5 and 2 or 5)
    check.near(mesh.fidelity.volume, 2, 1e-9)
    check.equal(mesh.hexes, 4 * (2 + mesh.layers.at_1))
  end
end

-- One cylinder in two volumes with other facets each is one face; volumes that overlap by less than facets
-- are off it are refused, and a gap that they hide is named.
local function pipe(inner, outer, facets, name)
  return open(lacuna.synthetic.annulus { inner = inner, outer = outer, height = 1, facets = facets }, name)
end
for _, facets in ipairs { { 32, 24 }, { 12, 13 }, { 16, 24 } } do
  local pipes = lacuna.assembly { pipe(1, 1.5, facets[1], "in"), pipe(1.5, 2, facets[2], "out") }
  local one = pipes:sweep { size = 0.25 }
  local sealed = one.fidelity.regions
  check.near(one:quality().volume, sealed["in"].sealed_volume + sealed.out.sealed_volume, 0.2)
  check.equal(#one.report.near_misses, 0)
end
for _, facets in ipairs { { 64, 64 }, { 64, 48 } } do
  check.fails(function()
    local over = lacuna.assembly { pipe(0.5, 1, facets[1], "in"), pipe(0.999, 1.5, facets[2], "out") }
    over:sweep { size = 0.25 }
  end, "same side", "assembly.overlap")
end
local hidden = lacuna.assembly { pipe(0.5, 1, 32, "in"), pipe(1.003, 1.5, 32, "out") }:sweep { size = 0.25 }
check.equal(#hidden.report.near_misses, 1)
check.near(hidden.report.near_misses[1].width, 0.003, 1e-4)
check.that(hidden.report.near_misses[1].message:find "0.0048", "the sag is told")

-- Parts that overlap are refused at every depth beyond the tolerance. With a tolerance that joins them, the
-- rib is shortened and the plate stays flat.
local function block(name, from, to, turn, tolerance)
  local points = {}
  for _, z in ipairs { from[3], to[3] } do
    for _, p in ipairs { { from[1], from[2] }, { to[1], from[2] }, { to[1], to[2] }, { from[1], to[2] } } do
      points[#points + 1] = { p[1] * math.cos(turn) - p[2] * math.sin(turn),
                              p[1] * math.sin(turn) + p[2] * math.cos(turn), z }
    end
  end
  local model = lacuna.model { tolerance = tolerance }
  local sides = {
    { 1, 4, 3, 2 }, { 5, 6, 7, 8 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 4, 8, 7 }, { 4, 1, 5, 8 },
  }
  for i, side in ipairs(sides) do
    local a, b, c, d = table.unpack(side)
    model:add_face { name = name .. i, points = points, cells = { { a, b, c }, { a, c, d } } }
  end
  return model:open_volume { name = name }
end
for _, turn in ipairs { 0, 0.3 } do
  for _, sink in ipairs { 0.02, 0.1, 0.3 } do
    local function both(tolerance)
      return block("plate", { 0, 0, 0 }, { 120, 70, 5 }, turn, tolerance),
             block("rib", { 10, 33, 5 - sink }, { 110, 37, 27 }, turn, tolerance)
    end
    check.fails(function() lacuna.assembly { both() }:sweep { size = 3 } end, "assembly.overlap")
    local plate, rib = both(1.6 * sink)
    for _, members in ipairs { { plate, rib }, turn == 0 and { rib, plate } or nil } do
      local joined = lacuna.assembly(members):sweep { size = 3 }
      check.near(joined:quality().volume, 120 * 70 * 5 + 100 * 4 * 22, 1e-6)
    end
  end
end

-- Long bars that cross have no facet with its middle in the other bar.
for _, at in ipairs { 20, 37.3, 81 } do
  for _, up in ipairs { 0, 1 } do
    local one = block("one", { 0, 0, 0 }, { 200, 2, 2 }, 0)
    local other = block("other", { at, -90, up }, { at + 2, 110, up + 2 }, 0)
    check.fails(function() lacuna.assembly { one, other }:sweep { size = 1.5 } end, "assembly.overlap")
  end
end

-- Sides that intervals ask for on an edge that volumes share are those of all of them.
local function cube(z) return slab(z, nil, "cube" .. z) end
local low, high = cube(0), cube(1)
for _, options in ipairs {
  { intervals = { { "side", 6 } } }, { [low] = { intervals = { { "side", 6 } } } },
  { [high] = { intervals = { { "side", 6 } } } },
} do
  options.size = 0.25
  local stacked = lacuna.assembly { low, high }:sweep(options)
  check.equal(stacked.hexes, 2 * 4 * 4 * 6)
end

-- A mesh that stays as it is was not loaded: no advice to load it otherwise.
local moved = lacuna.model()
for _, face in ipairs { { "source", 1 }, { "target", 2 } } do
  local z = face[2]
  moved:add_face { name = face[1], cells = { { 1, 2, 3, 4 } },
    points = { { 0.2, 0.2, z }, { 0.6, 0.2, z }, { 0.6, 0.6, z }, { 0.2, 0.6, z } } }
end
local kept = cube(0):sweep { size = 0.25 }
local why = select(2, pcall(function()
  lacuna.assembly { kept, open(moved, "part") }:sweep { size = 0.25 }
end))
check.that(tostring(why):find("mesh that must not change", 1, true), tostring(why))
check.that(not tostring(why):find("keep_mesh", 1, true), tostring(why))
