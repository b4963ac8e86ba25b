-- SPDX-License-Identifier: MIT
-- The void face of the paper's Figure 8: bent in space, yet it lies out in its Newell plane without folding.
--
-- An oval cup with a post in it. Its rim is a saddle, high at the two ends and low at the two sides; the post
-- ends flat, half way up. The floor and the two walls are given; the face that closes them is triangulated in
-- the Newell plane of its two loops and lifted back (Algorithm 4).
local lacuna = require "lacuna"

local params = lacuna.params {
  bow    = 16.0,    -- from the lowest to the highest point of the rim
  layers = 12,
  size   = 2.0,
  output = "fig_8.msh",
  facets = "",      -- a file for the facets of the sealed volume, say fig_8.stl
}

-- The rim is cut by a lying cylinder that meets the oval's ends `bow` above its sides.
local half_length, lowest = 24.0, 16.0
local radius = (half_length ^ 2 + params.bow ^ 2) / (2 * params.bow)

local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write(([[
SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, %.17g, 17};
Disk(2) = {0, 0, 0, 6};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
rims() = Boundary{ Surface{3}; };
side() = Extrude { 0, 0, %.17g } { Curve{rims(0)}; };
Extrude { 0, 0, %.17g } { Curve{rims(1)}; }
Cylinder(1) = {0, -50, %.17g, 0, 100, 0, %.17g};
BooleanDifference { Surface{side(1)}; Delete; }{ Volume{1}; Delete; }
]]):format(half_length, lowest + params.bow + 1, lowest + params.bow / 2, lowest + radius, radius))
cad:close()

local part = lacuna.load(cad_path)
assert(#part:faces() == 3)
local floor = part:face { kind = "plane" }

local void = part:open_volume { source = floor, walls = "auto" }
print("class", void.class)
assert(void.class == "IV", void.class)

local closure = void:close()
print("added", closure.void_faces .. " face", table.concat(closure.algorithms, ", "))
assert(closure.void_edges == 0 and closure.void_faces == 1 and closure.watertight)
print(void:tree())
if params.facets ~= "" then void:write_facets(params.facets) end

local mesh = void:sweep { layers = params.layers, size = params.size }
print(mesh:quality())
mesh:write(params.output)
print("written", params.output)
