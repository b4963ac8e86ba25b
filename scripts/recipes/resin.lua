-- SPDX-License-Identifier: MIT
-- Resin round two fibres, and the fibres: three volumes, one mesh.
--
-- Front and back of the resin were never modelled. It is closed, and its mesh shares every node with those of
-- the fibres, so that what is written is one conformal mesh with a region each.
local lacuna = require "lacuna"

local params = lacuna.params {
  layers = 12,         -- hexahedra along the fibres
  size   = 0.15,       -- edge length of the quads across them [mm]
  output = "resin.msh",
}

-- The CAD is made here, so that the recipe needs no other file.
local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write [[
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 4, 2, 3};
Cylinder(2) = {1, 1, 0, 0, 0, 3, 0.4};
Cylinder(3) = {2.7, 0.9, 0, 0, 0, 3, 0.5};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2, 3}; Delete; }
]]
cad:close()
local part = lacuna.load(cad_path)

local function at(x, y, z) return part:face { near = { x, y, z } } end

-- A fibre: the disc below, the disc above, the skin at the fibre's right.
local function fibre(name, x, y, radius)
  return part:open_volume { name = name, source = at(x, y, 0), target = at(x, y, 3),
    walls = part:face { kind = "cylinder", near = { x + radius, y, 1.5 } } }
end

local first, second = fibre("fibre_1", 1, 1, 0.4), fibre("fibre_2", 2.7, 0.9, 0.5)
local resin = part:open_volume { name = "resin", source = at(0.1, 0.1, 0), target = at(0.1, 0.1, 3),
  walls = { { kind = "cylinder" }, at(0, 1, 1.5), at(4, 1, 1.5) } }
print("class of the resin", resin.class)
assert(resin.class == "III", resin.class)

local mesh = lacuna.assembly { resin, first, second }:sweep { layers = params.layers, size = params.size }
for _, line in ipairs(mesh.report) do print(line) end
print(mesh:quality())
local quality = mesh:quality()
assert(quality.certified and quality.min_scaled_jacobian > 0.5)
assert(math.abs(mesh.fidelity.volume - 24) < 1e-6, "what the resin lacks the fibres have")
mesh:write(params.output)
print("written", params.output)
