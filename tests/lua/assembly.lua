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

-- What is refused.
check.fails(function() lacuna.assembly {} end, "give volumes")
check.fails(function() lacuna.assembly { a, a } end, "volumes[2]", "already")
check.fails(function() lacuna.assembly { a, 3 } end, "volumes[2]", "a Volume")
check.fails(function() assembly:sweep { [core()] = {} } end, "volumes of the assembly")
check.fails(function() assembly:sweep { size = 0.4, [a] = { layers = 5 }, [b] = { layers = 6 } } end,
  "core", "volume_2", "5 and 6", "assembly.layers")
check.fails(function() assembly:sweep { sise = 0.4 } end, "sise", "size")
check.fails(function() lacuna.assembly { core "x", ring "x" }:sweep { size = 0.4 } end, 'named "x"')

-- A volume that is being swept cannot be part of one.
check.fails(function()
  assembly:sweep { layers = 2, size = function()
    a:sweep { layers = 2, size = 0.4 }
    return 0.4
  end }
end, "sweep")
check.done()
