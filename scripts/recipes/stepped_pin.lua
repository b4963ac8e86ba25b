-- SPDX-License-Identifier: MIT
-- The gap between a stepped pin and a stepped bore: the pin steps inward as it rises, and so does the bore.
--
-- The source lies at two heights, below and on the pin's shoulder, and so does the target, above and below
-- the bore's shoulder. Void faces hang from the rims of both shoulders to the opposite end, and cut the gap
-- into three rings that are swept and joined.
local lacuna = require "lacuna"

local params = lacuna.params {
  size   = 1.2,        -- edge length of the quads [mm]
  output = "stepped_pin.msh",
}

-- The CAD is made here, so that the recipe needs no other file.
local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write [[
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 30, 15};
Cylinder(2) = {0, 0, 30, 0, 0, 20, 12};
Cylinder(3) = {0, 0, 0, 0, 0, 20, 10};
Cylinder(4) = {0, 0, 20, 0, 0, 30, 7};
BooleanUnion(5) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
BooleanDifference(6) = { Volume{5}; Delete; }{ Volume{3, 4}; Delete; };
]]
cad:close()
local part = lacuna.load(cad_path)

local gap = part:open_volume { name = "grease",
  source = { { near = { 12, 0, 0 } }, { near = { 8.5, 0, 20 } } },
  target = { { near = { 10, 0, 50 } }, { near = { 13.5, 0, 30 } } },
  walls = { kind = "cylinder" } }
print("class", gap.class)
for _, ring in ipairs(gap:cut()) do print(ring) end

local mesh = gap:sweep { size = params.size }
for _, line in ipairs(mesh.report) do print(line) end
print(mesh:quality())
assert(#mesh.regions == 3, "below the bore's shoulder, beside both, above the pin's")
local quality = mesh:quality()
assert(quality.certified and quality.min_scaled_jacobian > 0.5)
local space = math.pi * (15 ^ 2 * 30 + 12 ^ 2 * 20 - 10 ^ 2 * 20 - 7 ^ 2 * 30)
assert(math.abs(mesh.fidelity.volume - space) < 0.01 * space)
mesh:write(params.output)
print("written", params.output)
