-- SPDX-License-Identifier: MIT
-- Resin round five fibres of different lengths that stand in it, and the fibres: one mesh, a region each.
--
-- The resin's floor and lid were modelled, and two of its four sides. Its source lies at six heights, on the
-- floor and on the five tips: void faces hang from the rims of the tips up to the lid, and cut the resin into
-- a column above each fibre and what stands round them all. The fibres share every node of their skins and
-- tips with it.
local lacuna = require "lacuna"

local params = lacuna.params {
  size   = 0.2,        -- edge length of the quads [mm]
  output = "fibres.msh",
}

-- The CAD is made here, so that the recipe needs no other file.
local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
local fibres = { -- x, y, length, radius [mm]
  { 0.8, 0.8, 2.6, 0.35 }, { 2.2, 0.7, 1.9, 0.4 }, { 3.3, 1.2, 3.1, 0.3 },
  { 1.3, 2.1, 1.3, 0.4 }, { 2.7, 2.2, 2.3, 0.45 },
}
cad:write 'SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 4, 3, 4};\n'
for n, fibre in ipairs(fibres) do
  cad:write(("Cylinder(%d) = {%g, %g, 0, 0, 0, %g, %g};\n"):format(n + 1, table.unpack(fibre)))
end
cad:write "BooleanFragments{ Volume{1}; Delete; }{ Volume{2:6}; Delete; }\n"
cad:close()
local part = lacuna.load(cad_path)

local volumes, tips, skins = {}, {}, {}
for n, fibre in ipairs(fibres) do
  local x, y, length, radius = table.unpack(fibre)
  tips[n] = part:face { near = { x, y, length } }
  skins[n] = part:face { kind = "cylinder", near = { x + radius, y, length / 2 } }
  volumes[n] = part:open_volume { name = "fibre_" .. n, source = part:face { near = { x, y, 0 } },
    target = tips[n], walls = skins[n] }
end
local walls = { part:face { near = { 0, 1.5, 2 } }, part:face { near = { 2, 0, 2 } }, table.unpack(skins) }
local floor = part:face { near = { 0.05, 0.05, 0 } }
volumes[#volumes + 1] = part:open_volume { name = "resin", source = { floor, table.unpack(tips) },
  target = part:face { near = { 2, 1.5, 4 } }, walls = walls }
print(volumes[#volumes]:tree())

local mesh = lacuna.assembly(volumes):sweep { size = params.size }
for _, line in ipairs(mesh.report) do print(line) end
print(mesh:quality())
assert(#mesh.regions == 11, "five fibres, the column above each of them, and the resin round them")
local quality = mesh:quality()
assert(quality.certified and quality.min_scaled_jacobian > 0.3)
assert(math.abs(mesh.fidelity.volume - 48) < 0.01 * 48, "what the resin lacks the fibres have")
mesh:write(params.output)
print("written", params.output)
