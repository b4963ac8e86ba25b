-- SPDX-License-Identifier: MIT
-- Thin rows of cells along the walls that count: a channel with two tubes across it, closed by its lid.
local lacuna = require "lacuna"

local params = lacuna.params {
  size   = 1.2,     -- edge length of the quads between the rows [mm]
  layers = 10,
  first  = 0.05,    -- thickness of the cells at the tubes and at the floor [mm]
  growth = 1.5,     -- of each row over the one before
  count  = 5,       -- rows
  output = "boundary_layers.msh",
}

-- The CAD is made here, so that the recipe needs no other file: a block with a draft, two tubes through it.
local cad_path = params.output:gsub("%.msh$", "") .. ".geo"
local cad <close> = assert(io.open(cad_path, "w"))
cad:write [[
SetFactory("OpenCASCADE");
Point(1) = {0, 0, 0};   Point(2) = {20, 0, 0};   Point(3) = {20, 10, 0};   Point(4) = {0, 10, 0};
Point(5) = {0, 1, 8};   Point(6) = {20, 1, 8};   Point(7) = {20, 9, 8};    Point(8) = {0, 9, 8};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Line(5) = {5, 6};  Line(6) = {6, 7};  Line(7) = {7, 8};  Line(8) = {8, 5};
Line(9) = {1, 5};  Line(10) = {2, 6}; Line(11) = {3, 7}; Line(12) = {4, 8};
Curve Loop(1) = {1, 2, 3, 4};     Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8};     Plane Surface(2) = {2};
Curve Loop(3) = {1, 10, -5, -9};  Plane Surface(3) = {3};
Curve Loop(4) = {2, 11, -6, -10}; Plane Surface(4) = {4};
Curve Loop(5) = {3, 12, -7, -11}; Plane Surface(5) = {5};
Curve Loop(6) = {4, 9, -8, -12};  Plane Surface(6) = {6};
Surface Loop(1) = {1, 2, 3, 4, 5, 6}; Volume(1) = {1};
Cylinder(2) = {6, 5, -1, 0, 0, 10, 1.5};
Cylinder(3) = {14, 5, -1, 0, 0, 10, 1.5};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
]]
cad:close()
local part = lacuna.load(cad_path)

-- The lid is not there: the void is closed over it.
local floor = part:face { kind = "plane", facing = { 0, 0, -1 } }
local lid   = part:face { kind = "plane", facing = { 0, 0, 1 } }
local sides = {}
for _, face in ipairs(part:faces()) do
  if face.tag ~= floor.tag and face.tag ~= lid.tag then sides[#sides + 1] = face end
end
local channel = part:open_volume { source = floor, walls = sides }
local tubes   = part:faces { kind = "cylinder" }
local slanted = part:face { facing = { 0, -1, 0.1 }, normal_within = 15 }

local thick = params.first * (params.growth ^ params.count - 1) / (params.growth - 1)
local mesh = channel:sweep {
  size = params.size, layers = params.layers + params.count,
  boundary_layers = {
    { walls = { tubes[1], tubes[2], floor }, first = params.first, growth = params.growth,
      count = params.count },
    { walls = slanted, first = 2 * params.first, growth = 1.2, count = 3 },
  },
  intervals = { { sides[1].tag == slanted.tag and sides[2] or sides[1], 14 } },
}
for _, line in ipairs(mesh.report) do print(line) end
print(mesh:quality())

-- The rows are as thick as was asked for: the nodes nearest to the floor, to a tube and to the slanted wall.
local near_floor, near_tube, near_wall = math.huge, math.huge, math.huge
local function nearer(least, d) return d > 1e-3 * params.first and d < least and d or least end
local n, c = slanted.normal, slanted.centroid
for i = 1, mesh.nodes do
  local x, y, z = mesh:node(i)
  near_floor = nearer(near_floor, z)
  near_tube  = nearer(near_tube, math.sqrt((x - 6) ^ 2 + (y - 5) ^ 2) - 1.5)
  near_wall  = nearer(near_wall, math.abs((x - c[1]) * n[1] + (y - c[2]) * n[2] + (z - c[3]) * n[3]))
end
print(("first rows: %.4f at the floor, %.4f at a tube, %.4f at the slanted wall; %.3f in all at the tubes")
  :format(near_floor, near_tube, near_wall, thick))
assert(math.abs(near_floor - params.first) < 0.01 * params.first)
assert(math.abs(near_wall - 2 * params.first) < 0.01 * params.first)
assert(mesh:quality().certified and mesh:quality().min_scaled_jacobian > 0.3)
mesh:write(params.output)
print("written", params.output)
