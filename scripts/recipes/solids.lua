-- SPDX-License-Identifier: MIT
-- A file of solids that touch, meshed as it is: a board on four standoffs on a base with a pin through it.
-- One call opens every solid; each is swept its own way, and they share nodes where they touch.
local lacuna = require "lacuna"

local params = lacuna.params {
  file   = "",           -- a STEP file of solids; empty: the board is made here
  size   = 0.5,          -- edge length of the quads [mm]
  output = "solids.msh",
}

if params.file == "" then
  params.file = params.output:gsub("%.msh$", "") .. ".geo"
  local cad <close> = assert(io.open(params.file, "w"))
  cad:write [[
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 8, 5, 0.8};
Box(2) = {0.5, 0.5, 1.8, 7, 4, 0.4};
Cylinder(3) = {1.5, 1.2, 0.8, 0, 0, 1, 0.4};
Cylinder(4) = {6.5, 1.2, 0.8, 0, 0, 1, 0.4};
Cylinder(5) = {1.5, 3.8, 0.8, 0, 0, 1, 0.4};
Cylinder(6) = {6.5, 3.8, 0.8, 0, 0, 1, 0.4};
Cylinder(7) = {4, 2.5, -0.5, 0, 0, 1.6, 0.6};
BooleanDifference{ Volume{1}; Delete; }{ Volume{7}; }
Physical Volume("base") = {1};
Physical Volume("board") = {2};
Physical Volume("standoff") = {3:6};
Physical Volume("pin") = {7};
]]
end

local model = lacuna.load(params.file)
print(table.concat(model.regions, " "))
local mesh = lacuna.assembly(model:bodies()):sweep { size = params.size }
for _, name in ipairs(mesh.regions) do print(name, mesh.fidelity.regions[name].volume) end
local quality = mesh:quality()
print(quality)
assert(quality.certified and quality.min_scaled_jacobian > 0.3)
mesh:write(params.output)
print("written", params.output)
