-- SPDX-License-Identifier: MIT
-- A bottle with shoulder and neck stands in a box with a lid; two sides of the box were never modelled.
--
-- The bottle is turned from an outline; its top is flat. The floor round it and the top are the source, the
-- lid the target. A void face hangs from the rim of the top up to the lid.
local lacuna = require "lacuna"

local params = lacuna.params {
  layers = 24,         -- hexahedra from the floor to the lid
  size   = 6,          -- edge length of the quads on the floor [mm]
  output = "bottle.msh",
}

-- The CAD is made here, so that the recipe needs no other file: the bottle's outline, turned round.
local cad_path = params.output:gsub("%.%w+$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write [[
SetFactory("OpenCASCADE");
Point(1) = {50, 40, 0};
Point(2) = {72, 40, 0};
Point(3) = {72, 40, 50};
Point(4) = {66, 40, 62};
Point(5) = {59, 40, 70};
Point(6) = {58, 40, 76};
Point(7) = {58, 40, 90};
Point(8) = {50, 40, 90};
Line(1) = {1, 2};
Line(2) = {2, 3};
Spline(3) = {3, 4, 5, 6};
Line(4) = {6, 7};
Line(5) = {7, 8};
Line(6) = {8, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
Extrude{ {0, 0, 1}, {50, 40, 0}, 2*Pi }{ Surface{1}; }
Box(2) = {0, 0, 0, 100, 80, 120};
BooleanDifference(3) = { Volume{2}; Delete; }{ Volume{1}; Delete; };
]]
cad:close()
local part = lacuna.load(cad_path)

-- All of the bottle, and the box's sides at the left and behind.
local walls, tops = {}, {}
for _, face in ipairs(part:faces()) do
  local x, y, z = table.unpack(face.centroid)
  local upright = math.abs(face.normal[3]) < 0.5
  if face.kind == "plane" and not upright then
    if z < 119 then tops[#tops + 1] = face end
  elseif face.kind ~= "plane" or x < 1 or y > 79 then
    walls[#walls + 1] = face
  end
end
assert(#tops == 2, "the floor and the bottle's top")
local void = part:open_volume { name = "air", source = tops, target = { near = { 1, 1, 120 } },
  walls = walls }
print("class", void.class)

-- The missing sides are flat: their void edges are straight, whatever the bottle's walls do.
local pieces = void:cut()
for _, piece in ipairs(pieces) do piece:close { edge_shape = "straight" } end
local mesh = lacuna.assembly(pieces):sweep { layers = params.layers, size = params.size }
for _, line in ipairs(mesh.report) do print(line) end
local quality = mesh:quality()
print(quality)
assert(#mesh.regions == 2, "round the bottle, and above it")
assert(quality.certified and quality.min_scaled_jacobian > 0.4)
local space = mesh.fidelity.sealed_volume
assert(math.abs(mesh.fidelity.volume - space) < 0.005 * space)
mesh:write(params.output)
print("written", params.output)
