-- SPDX-License-Identifier: MIT
-- Foam on all six sides of a product with rounded edges, in a box: a space with an outer and an inner skin.
-- Faces that point up are the source, faces that point down the target. Rounded edges are split along the
-- line where their surface is inclined by 45°, and the foam above, below and around the product is swept.
local lacuna = require "lacuna"

local params = lacuna.params {
  size   = 8,          -- edge length of the cells [mm]
  output = "foam.msh",
}

-- The CAD is made here, so that the recipe needs no other file.
local cad_path = params.output:gsub("%.%w+$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write [[
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 120, 90, 60};
Box(2) = {20, 20, 15, 80, 50, 30};
Fillet{2}{13:24}{8}
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
]]
cad:close()
local function at(height) return { near = { 60, 45, height } } end
local foam = lacuna.load(cad_path):open_volume {
  source = { at(0), at(45) }, target = { at(60), at(15) }, walls = "auto", name = "foam",
}

local mesh = foam:sweep { size = params.size }
local quality = mesh:quality()
print(quality)
assert(quality.certified and quality.min_scaled_jacobian > 0.3)

-- The product: a box grown on all sides by the radius of its edges.
local a, b, c, r = 80 - 16, 50 - 16, 30 - 16, 8
local product = a * b * c + 2 * r * (a * b + b * c + c * a) + math.pi * r ^ 2 * (a + b + c) +
  4 / 3 * math.pi * r ^ 3
local space = 120 * 90 * 60 - product
assert(math.abs(mesh.fidelity.volume - space) < 0.01 * space)
mesh:write(params.output)
print("written", params.output)
