-- SPDX-License-Identifier: MIT
-- Water in a tee of two tubes: the side branch is narrower, and its end was never modelled.
--
-- A tee cannot be swept from one end to another. It is cut where the branch joins, by three void faces that
-- meet in a line across the branch's mouth, into three arms that are swept from their ends to that place.
local lacuna = require "lacuna"

local params = lacuna.params {
  radius = 20,         -- of the main tube [mm]
  branch = 14,         -- radius of the side branch [mm]; as wide as the main tube at most
  size   = 4,          -- edge length of the quads [mm]
  output = "tee.msh",
}

-- The CAD is made here, so that the recipe needs no other file.
local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write(([[
SetFactory("OpenCASCADE");
Cylinder(1) = {-60, 0, 0, 120, 0, 0, %g};
Cylinder(2) = {0, 0, 0, 0, 0, 60, %g};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
]]):format(params.radius, params.branch))
cad:close()
local part = lacuna.load(cad_path)

local void = part:open_volume { name = "water", source = { near = { -60, 0, 0 } },
  target = { near = { 60, 0, 0 } }, walls = { kind = "cylinder" } }
print("class", void.class)
for _, arm in ipairs(void:cut()) do print(arm) end

local mesh = void:sweep { size = params.size }
for _, line in ipairs(mesh.report) do print(line) end
print(mesh:quality())
assert(#mesh.regions == 3, "two arms of the main tube, and the branch")
local quality = mesh:quality()
assert(quality.certified and quality.min_scaled_jacobian > 0.3)
assert(math.abs(mesh.fidelity.volume / mesh.fidelity.sealed_volume - 1) < 0.02)
mesh:write(params.output)
print("written", params.output)
