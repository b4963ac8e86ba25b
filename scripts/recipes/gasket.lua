-- SPDX-License-Identifier: MIT
-- A thin gasket between two flanges, with a bore and bolt holes through all three: one mesh.
local lacuna = require "lacuna"

local params = lacuna.params {
  layers = 3,          -- hexahedra through each of the three
  size   = 0.6,        -- edge length of the quads on the flanges [mm]
  bolts  = 4,
  output = "gasket.msh",
}

-- The CAD is made here, so that the recipe needs no other file.
local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write [[
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 1, 5};
Cylinder(2) = {0, 0, 1, 0, 0, 0.3, 5};
Cylinder(3) = {0, 0, 1.3, 0, 0, 1, 5};
Cylinder(4) = {0, 0, -1, 0, 0, 5, 2};
]]
local tools = { "4" }
for i = 1, params.bolts do
  local angle = 2 * math.pi * i / params.bolts + 0.3
  cad:write(("Cylinder(%d) = {%.15g, %.15g, -1, 0, 0, 5, 0.5};\n"):format(10 + i, 3.5 * math.cos(angle),
    3.5 * math.sin(angle)))
  tools[#tools + 1] = tostring(10 + i)
end
local holes = table.concat(tools, ", ")
for i = 1, 3 do
  cad:write(("BooleanDifference(%d) = { Volume{%d}; Delete; }{ Volume{%s};%s };\n"):format(19 + i, i, holes,
    i == 3 and " Delete;" or ""))
end
cad:write "BooleanFragments{ Volume{20}; Delete; }{ Volume{21, 22}; Delete; }\n"
cad:close()
local part = lacuna.load(cad_path)

-- A disc from one height to another: its flat faces, and the cylinders between them.
local function disc(name, low, high)
  local walls = {}
  for _, face in ipairs(part:faces { kind = "cylinder" }) do
    local z = face.centroid[3]
    if z > low and z < high then walls[#walls + 1] = face end
  end
  local function flat(z) return part:face { kind = "plane", near = { 4.6, 0, z } } end
  return part:open_volume { name = name, source = flat(low), target = flat(high), walls = walls }
end

local mesh = lacuna.assembly { disc("below", 0, 1), disc("gasket", 1, 1.3), disc("above", 1.3, 2.3) }
  :sweep { layers = params.layers, size = params.size }
for _, line in ipairs(mesh.report) do print(line) end
print(mesh:quality())
local quality = mesh:quality()
assert(quality.certified and quality.min_scaled_jacobian > 0.3)
local exact = math.pi * 2.3 * (25 - 4 - params.bolts * 0.25)
assert(math.abs(mesh.fidelity.volume - exact) < 0.02 * exact)
mesh:write(params.output)
print("written", params.output)
