-- SPDX-License-Identifier: MIT
-- A bottle and a block stand in a box, with room above them; two sides of the box were never modelled.
--
-- The source lies at several heights: the floor, the bottle's top and the block's. Void faces hang from the
-- rims of the tops up to the lid, and cut the space into three pieces that are closed, swept and joined.
local lacuna = require "lacuna"

local params = lacuna.params {
  layers = 14,         -- hexahedra from the floor to the lid
  size   = 6,          -- edge length of the quads on the floor [mm]
  output = "packed_box.msh",
}

-- The CAD is made here, so that the recipe needs no other file.
local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write [[
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 120, 80, 90};
Cone(2) = {35, 40, 0, 0, 0, 60, 20, 12};
Box(3) = {70, 22, 0, 32, 36, 45};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
]]
cad:close()
local part = lacuna.load(cad_path)

-- Of the box's sides those at the right and in front; all of the bottle's and the block's.
local walls = { { kind = "cone" } }
for _, face in ipairs(part:faces { kind = "plane" }) do
  local x, y = table.unpack(face.centroid)
  if math.abs(face.normal[3]) < 0.5 and x > 1 and y < 79 then walls[#walls + 1] = face end
end
local void = part:open_volume { name = "foam", source = { kind = "plane", facing = { 0, 0, -1 } },
  target = { near = { 1, 1, 90 } }, walls = walls }
print("class", void.class)

local mesh = void:sweep { layers = params.layers, size = params.size }
for _, line in ipairs(mesh.report) do print(line) end
print(mesh:quality())
assert(#mesh.regions == 3, "round the two, above the bottle, above the block")
local quality = mesh:quality()
assert(quality.certified and quality.min_scaled_jacobian > 0.4)
local bottle = math.pi * 60 / 3 * (20 ^ 2 + 20 * 12 + 12 ^ 2)
local space = 120 * 80 * 90 - bottle - 32 * 36 * 45
assert(math.abs(mesh.fidelity.volume - space) < 0.01 * space)
mesh:write(params.output)
print("written", params.output)
