-- SPDX-License-Identifier: MIT
-- Class V: walls alone.
--
-- The outer skin of a plate with rounded corners and two holes through it: neither of its flat sides is
-- given. The six free loops are told apart into those below and those above, and both ends are made.
local lacuna = require "lacuna"

local params = lacuna.params {
  layers = 6,
  size   = 2.5,
  output = "class_5.msh",
}

local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write [[
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 70, 40, 10};
Disk(2) = {20, 20, 0, 9};
Disk(3) = {50, 20, 0, 7};
BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{2, 3}; Delete; };
Extrude { 0, 0, 12 } { Surface{4}; }
]]
cad:close()

local part = lacuna.load(cad_path)
local walls = {}
for _, face in ipairs(part:faces()) do
  if math.abs(face.normal[3]) < 0.5 then walls[#walls + 1] = face end
end
assert(#walls == 10, "four flat sides, four corners, two holes")

local void = part:open_volume { walls = walls }
print("class", void.class)
assert(void.class == "V", void.class)

local closure = void:close()
print("added", closure.void_edges .. " edges, " .. closure.void_faces .. " faces")
assert(closure.void_edges == 0 and closure.void_faces == 2 and closure.watertight)

local mesh = void:sweep { layers = params.layers, size = params.size }
print(mesh:quality())
mesh:write(params.output)
print("written", params.output)
