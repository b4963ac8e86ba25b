-- SPDX-License-Identifier: MIT
-- A bracket: a foot, a back and a rib, with two bolt holes in each plate. No single sweep fills it.
--
-- No roles are named. The bracket is cut along its inner edges into a foot, a back and a rib, which are swept
-- in three directions and share their nodes.
local lacuna = require "lacuna"

local params = lacuna.params {
  size   = 4,          -- edge length of the cells [mm]
  output = "bracket.msh",
}

-- The CAD is made here, so that the recipe needs no other file.
local cad_path = params.output:gsub("%.%w+$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write [[
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 60, 80, 10};
Box(2) = {0, 0, 10, 10, 80, 50};
Box(3) = {10, 36, 10, 35, 8, 35};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Cylinder(5) = {35, 18, -1, 0, 0, 12, 6};
Cylinder(6) = {35, 62, -1, 0, 0, 12, 6};
Cylinder(7) = {-1, 18, 40, 12, 0, 0, 6};
Cylinder(8) = {-1, 62, 40, 12, 0, 0, 6};
BooleanDifference(9) = { Volume{4}; Delete; }{ Volume{5:8}; Delete; };
]]
cad:close()
local bracket = lacuna.load(cad_path):open_volume { name = "bracket" }

local mesh = bracket:sweep { size = params.size }
print(mesh.report[1])
local quality = mesh:quality()
print(quality)
assert(#mesh.regions > 1 and mesh.tets == 0, "pieces of hexahedra alone")
assert(quality.certified and quality.min_scaled_jacobian > 0.4)
local solid = 60 * 80 * 10 + 10 * 80 * 50 + 35 * 8 * 35 - 4 * math.pi * 6 ^ 2 * 10
assert(math.abs(mesh.fidelity.volume - solid) < 0.01 * solid)
mesh:write(params.output)
print("written", params.output)
