-- SPDX-License-Identifier: MIT
-- The oil in a cast block: two bores that cross, from four sides. Only their walls are given.
--
-- The four mouths are closed by flat faces. The oil is cut where the bores meet, and each piece is swept.
-- At other sizes a sweep may not fit a piece; it is then filled with tetrahedra and pyramids on shared quads.
local lacuna = require "lacuna"

local params = lacuna.params {
  size   = 4.5,        -- edge length of the cells [mm]
  output = "crossing_bores.msh",
}

-- The CAD is made here, so that the recipe needs no other file.
local cad_path = params.output:gsub("%.%w+$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write [[
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 100, 70, 60};
Cylinder(2) = {-1, 35, 30, 102, 0, 0, 14};
Cylinder(3) = {50, -1, 30, 0, 72, 0, 9};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
]]
cad:close()
local block = lacuna.load(cad_path)
local oil = block:open_volume { faces = block:faces { kind = "cylinder" }, name = "oil" }

local mesh = oil:sweep { size = params.size, fallback = "mixed" }
print(("%d hexahedra, %d pyramids, %d tetrahedra"):format(mesh.hexes, mesh.pyramids, mesh.tets))
local quality = mesh:quality()
print(quality)
assert(quality.certified and quality.min_scaled_jacobian > 0.02)

-- The wide bore, and the narrow one outside it: each of its fibres begins on the wide one's wall.
local space = math.pi * 14 ^ 2 * 100
local strips = 1000
for i = 1, strips do
  local z = 9 * (2 * (i - 0.5) / strips - 1)
  space = space + 2 * (18 / strips) * 2 * math.sqrt(9 ^ 2 - z ^ 2) * (35 - math.sqrt(14 ^ 2 - z ^ 2))
end
assert(math.abs(mesh.fidelity.volume - space) < 0.015 * space)
mesh:write(params.output)
print("written", params.output)
