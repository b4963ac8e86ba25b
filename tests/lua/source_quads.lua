-- SPDX-License-Identifier: MIT
-- Which way each source is meshed, said in the report, and rows of a height of their own.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"

-- A straight prism over corners that go round anticlockwise; walls by their side.
local function prism(corners, height)
  local model, n = lacuna.model(), #corners
  local function at(k, z)
    local p = corners[(k - 1) % n + 1]
    return { p[1], p[2], z }
  end
  local function lid(name, z, cells)
    local points = {}
    for k = 1, n do points[k] = at(k, z) end
    model:add_face { name = name, points = points, cells = cells }
  end
  return model, at, lid
end

local function ell(a, b)
  -- An L of arms a long and 1 wide, b up.
  local corners = { { 0, 0 }, { a, 0 }, { a, 1 }, { 1, 1 }, { 1, b }, { 0, b } }
  local model, at, lid = prism(corners, 1)
  lid("source", 0, { { 1, 4, 2 }, { 2, 4, 3 }, { 1, 6, 4 }, { 6, 5, 4 } })
  lid("target", 1, { { 1, 2, 4 }, { 2, 3, 4 }, { 1, 4, 6 }, { 6, 4, 5 } })
  for k = 1, 6 do
    model:add_face { name = "wall_" .. k, points = { at(k, 0), at(k + 1, 0), at(k + 1, 1), at(k, 1) },
        cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
  end
  return model:open_volume { source = "source", target = "target", walls = "auto" }
end

local function said(mesh, what)
  for _, line in ipairs(mesh.report) do
    if line:find(what, 1, true) then return true end
  end
  return false, table.concat(mesh.report, "\n")
end

-- Faces of right angles are submapped, by "auto" and by "mapped", whatever the size: one grid, nothing lost.
for _, size in ipairs { 0.31, 0.17, 0.093 } do
  for _, quads in ipairs { "auto", "mapped" } do
    local mesh = ell(2.7, 3.4):sweep { layers = 2, size = size, quads = quads }
    check.that(said(mesh, "submapped"))
    check.that(mesh:quality().min_scaled_jacobian > 0.9, "a grid of squares")
  end
end

local function disc()
  return lacuna.synthetic.barrel { radius = 1, height = 1, bulge = 0 }:open_volume { source = "source",
      target = "target", walls = "auto" }
end

-- Depths of the source's nodes below its rim, from the shallowest.
local function depths(mesh)
  local found = {}
  for i = 1, mesh.nodes do
    local x, y, z = mesh:node(i)
    if math.abs(z) < 1e-9 then found[#found + 1] = 1 - math.sqrt(x * x + y * y) end
  end
  table.sort(found)
  return found
end

for _, height in ipairs { 0.03, 0.08 } do
  local mesh = disc():sweep { layers = 2, size = 0.1, rows = 2, row_height = height }
  check.that(said(mesh, "2 rows of their own height"))
  local near = { 0, 0, 0 }
  for _, depth in ipairs(depths(mesh)) do
    for row = 0, 2 do
      if math.abs(depth - row * height) < 0.1 * height then near[row + 1] = near[row + 1] + 1 end
    end
    check.that(depth < 0.1 * height or depth > 0.9 * height, "a node within the first row")
  end
  check.that(near[1] >= 60 and near[2] >= near[1] and near[3] >= near[1], "nodes at each row's end")
end

-- A height that changes, and rows alone, as high as the size.
do
  local mesh = disc():sweep { layers = 2, size = 0.1,
      row_height = function(x) return x > 0 and 0.06 or 0.04 end }
  check.that(said(mesh, "1 row of its own height"))
  check.that(said(disc():sweep { layers = 1, size = 0.1, rows = 3 }, "3 rows"))
end

-- Rings are meshed in rows around the hole by default, at least three, however thin they are.
for _, inner in ipairs { 0.4, 0.6, 0.8, 0.9, 0.99, 0.999 } do
  local mesh = lacuna.synthetic.annulus { inner = inner, height = 0.5, facets = 120 }:open_volume {
    source = "source", target = "target", walls = "auto" }:sweep { layers = 1 }
  check.that(said(mesh, "rings"))
  check.that(mesh:quality().min_scaled_jacobian > 0.95, "a ring of rows")
  local radii = {}
  for _, depth in ipairs(depths(mesh)) do radii[math.floor(4 * depth / (1 - inner) + 0.5)] = true end
  check.that(radii[0] and radii[1] and radii[3] and radii[4], "fewer than three rows")
end

-- A tube of facets, which has no seam, gets a grid around it; sides follow the size however long it is.
local function longest_side(mesh)
  local longest = 0
  for q = 1, mesh.hexes // mesh.layers do
    local cell = { mesh:hex(q) }
    for k = 1, 4 do
      local a, b = { mesh:node(cell[k]) }, { mesh:node(cell[k % 4 + 1]) }
      longest = math.max(longest, math.sqrt((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2 + (a[3] - b[3]) ^ 2))
    end
  end
  return longest
end
for _, tube in ipairs {
  { lacuna.synthetic.annulus { inner = 10, outer = 14, height = 20, drop = { "source", "target" } }, 3 },
  { lacuna.synthetic.annulus { inner = 10, outer = 14, height = 130, drop = { "source", "target" } }, 3 },
  { lacuna.synthetic.elbow { inner = 0.6, angle = 60, drop = { "source", "target" } }, 0.2 },
  { lacuna.synthetic.elbow { inner = 0.6, angle = 180, drop = { "source", "target" } }, 0.2 },
} do
  local void = tube[1]:open_volume { source = "wall_2", target = "wall_1" }
  local mesh = void:sweep { layers = 3, size = tube[2] }
  check.that(said(mesh, "mapped"))
  check.that(mesh:quality().min_scaled_jacobian > 0.8, "a grid round a tube")
  check.that(longest_side(mesh) < 1.6 * tube[2], "longer than the size")
end

-- Between coarse tubes the grid follows the corners of both from rim to rim: no volume is lost.
local function coarse_tube(model, name, sides, radius, height)
  local points, cells = {}, {}
  for k = 0, sides - 1 do
    local a = 2 * math.pi * k / sides
    for z = 0, 1 do points[#points + 1] = { radius * math.cos(a), radius * math.sin(a), z * height } end
    local low, next = 2 * k + 1, 2 * ((k + 1) % sides) + 1
    cells[#cells + 1] = { low, next, next + 1 }
    cells[#cells + 1] = { low, next + 1, low + 1 }
  end
  model:add_face { name = name, points = points, cells = cells }
  return height * sides * radius ^ 2 * math.sin(2 * math.pi / sides) / 2
end
for _, sides in ipairs { { 14, 16 }, { 12, 18 }, { 16, 14 } } do
  local model = lacuna.model()
  local inner, outer = coarse_tube(model, "inner", sides[1], 0.66, 12),
    coarse_tube(model, "outer", sides[2], 0.82, 12)
  local mesh = model:open_volume { source = "inner", target = "outer" }:sweep {}
  check.near(mesh:quality().volume, outer - inner, 1e-3 * (outer - inner))
end

-- Strips whose middle is shifted across: a grid of sheared quads has 0.4 and less, so they are paved.
for _, strip in ipairs { { 1, 0.6 }, { 1, 1 }, { 2, 0.6 }, { 2, 1 } } do
  local height, reach = strip[1], strip[2]
  local points, cells = {}, {}
  for i = 0, 40 do
    local x = i / 10
    local u = (x - 2) / (2 * reach)
    local shift = math.abs(u) < 1 and -(1 + math.cos(math.pi * u)) or 0
    points[#points + 1], points[#points + 2] = { x, shift, 0 }, { x, shift + height, 0 }
    if i > 0 then cells[i] = { 2 * i - 1, 2 * i + 1, 2 * i + 2, 2 * i } end
  end
  local model = lacuna.model()
  model:add_face { name = "strip", points = points, cells = cells }
  local void = model:open_volume { source = "strip", along = { vector = { 0, 0, 1 } } }
  local quality = void:sweep { size = 0.3 }:quality()
  check.that(quality.min_scaled_jacobian > 0.7, ("a strip %g high: %g"):format(height,
    quality.min_scaled_jacobian))
end

-- Square frames: the outer sides have at least two quads more than those of the window, so that a grid runs
-- round it in whole rows. Before, sides of 7 and 5 round ones of 5 and 4 were paved, with 0.59.
for _, case in ipairs { { 8, 6, 1, 1.5 }, { 7, 4, 1, 1.4 }, { 12, 7, 1, 1.3 } } do
  local a, b, wide, size = table.unpack(case)
  local points, cells = {}, {}
  for k, p in ipairs { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } } do
    points[k] = { p[1] * a / 2, p[2] * b / 2, 0 }
    points[k + 4] = { p[1] * (a / 2 + wide), p[2] * (b / 2 + wide), 0 }
    cells[k] = { k, k + 4, k % 4 + 5, k % 4 + 1 }
  end
  local model = lacuna.model()
  model:add_face { name = "frame", points = points, cells = cells }
  local mesh = model:open_volume { source = "frame", along = { vector = { 0, 0, 1 } } }:sweep { size = size }
  check.that(mesh:quality().min_scaled_jacobian > 0.7, ("%g x %g frame: %g"):format(a, b,
    mesh:quality().min_scaled_jacobian))
end

check.fails(function() disc():sweep { layers = 1, size = 0.1, rows = 0 } end, "rows")
check.fails(function() disc():sweep { layers = 1, size = 0.1, row_height = -1 } end, "row_height")
check.fails(function() disc():sweep { layers = 1, size = 0.1, row_height = function() return 0 end } end,
    "row_height", "positive")
check.fails(function() disc():sweep { layers = 1, size = 0.1, rows = 1, quads = "gmsh" } end, "rows", "paved")
check.done()
