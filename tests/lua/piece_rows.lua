-- SPDX-License-Identifier: MIT
-- Boundary layers of CAD volumes that are swept in pieces: tees, crosses and rings, one table on all walls.
local check = dofile(arg[0]:match "^(.*[/\\])" .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { scratch = "." }

local function load(name, text)
  local path = ("%s/%s.geo"):format(params.scratch, name)
  local file <close> = assert(io.open(path, "w"))
  file:write('SetFactory("OpenCASCADE");\n', text)
  file:close()
  return lacuna.load(path)
end

-- Pipes of radius 20 and `radius` that meet at right angles. First rows are as thick as asked in each.
local function pipes(radius, both)
  return load("pipes", ([[
Cylinder(1) = {-60, 0, 0, 120, 0, 0, 20};
Cylinder(2) = {0, 0, %g, 0, 0, %g, %g};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
]]):format(both and -60 or 0, both and 120 or 60, radius))
end
local cases = { { 14 }, { 19, true } }
if check.whole then cases = { { 8 }, { 10 }, { 14 }, { 19 }, { 14, true }, { 19, true } } end
for n, case in ipairs(cases) do
  local radius, both = case[1], case[2]
  local part, first = pipes(radius, both), 0.2 * n
  local water = part:open_volume { faces = part:faces { kind = "cylinder" } }
  local plain = water:sweep { size = 5 }
  local mesh = water:sweep { size = 5,
    boundary_layers = { walls = "walls", first = first, growth = 1.3, count = 3 } }
  check.equal(#mesh.regions, both and 4 or 3)
  check.equal(mesh:quality().certified, true)
  check.near(mesh.fidelity.volume, plain.fidelity.sealed_volume, 0.01 * plain.fidelity.sealed_volume)
  local main, branch = math.huge, math.huge
  for i = 1, mesh.nodes do
    local x, y, z = mesh:node(i)
    local height = 20 - math.sqrt(y * y + z * z)
    if math.abs(x) > 30 and height > 0.1 * first then main = math.min(main, height) end
    height = radius - math.sqrt(x * x + y * y)
    if math.abs(z) > 40 and height > 0.1 * first then branch = math.min(branch, height) end
  end
  check.near(main, first, 0.03 * first)
  check.near(branch, first, 0.03 * first)
end

-- A ring: sides of thin rows cross the sliver between the rim's facets and its exact arc.
local ring = load("ring", [[
Cylinder(1) = {0, 0, 0, 0, 0, 30, 30};
Cylinder(2) = {0, 0, 0, 0, 0, 30, 20};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
]])
for _, first in ipairs { 0.3, 0.1, 0.05 } do
  local mesh = ring:open_volume { full_turn = true }:sweep { size = 2,
    boundary_layers = { walls = "walls", first = first, count = 3 } }
  check.near(mesh:quality().volume / (500 * math.pi * 30), 1, 0.01)
  check.that(mesh:quality().min_scaled_jacobian > 0.9)
end
check.done()
