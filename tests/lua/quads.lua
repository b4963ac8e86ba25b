-- SPDX-License-Identifier: MIT
-- Quads on faces without layers: they conform, lie on their faces, keep given quads; all formats have them.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")
local params = lacuna.params { lacuna = "lacuna", scratch = "." }

-- Sides by how many quads have them, and the nodes that quads use.
local function sides_of(mesh)
  local uses, used, nodes = {}, {}, 0
  for i = 1, mesh.quads do
    local quad = { mesh:quad(i) }
    for k = 1, 4 do
      local a, b = quad[k], quad[k % 4 + 1]
      local key = math.min(a, b) .. " " .. math.max(a, b)
      uses[key] = (uses[key] or 0) + 1
      if not used[a] then used[a], nodes = true, nodes + 1 end
    end
  end
  local counts, sides = {}, 0
  for _, count in pairs(uses) do counts[count], sides = (counts[count] or 0) + 1, sides + 1 end
  return counts, nodes - sides + mesh.quads
end

-- Closed bodies: each side has two quads, and the faces their area.
for sides = 3, 8 do
  for _, holes in ipairs { 0, sides > 4 and 1 or 0 } do
    local body = lacuna.synthetic.prism { sides = sides, radius = 2, height = 1.5, holes = holes }
    for _, size in ipairs { 0.3, 0.7 } do
      local mesh = body:quads { size = size }
      local counts, euler = sides_of(mesh)
      check.equal(counts[1], nil, "free sides")
      check.equal(counts[3], nil, "sides of three quads")
      check.equal(euler, 2 - 2 * holes)
      local quality = mesh:quality()
      check.near(quality.area / quality.face_area, 1, 1e-12)
      check.that(quality.min_scaled_jacobian > 0.2, quality.min_scaled_jacobian)
      check.equal(mesh.hexes, 0)
      check.equal(mesh.layers, 0)
    end
  end
end

-- Three faces at one edge, as a stiffened panel: its sides have three quads.
local panel = lacuna.model()
panel:add_face { name = "left", points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 2, 0 }, { 0, 2, 0 } },
  cells = { { 1, 2, 3, 4 } } }
panel:add_face { name = "right", points = { { 1, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 1, 2, 0 } },
  cells = { { 1, 2, 3, 4 } } }
panel:add_face { name = "rib", points = { { 1, 0, 0 }, { 1, 2, 0 }, { 1, 2, 1 }, { 1, 0, 1 } },
  cells = { { 1, 2, 3, 4 } } }
local ribbed = panel:quads { size = 0.5 }
check.equal(ribbed.quads, 2 * 8 + 8)
check.equal(ribbed.nodes, 5 * 3 + 5 * 4)
check.equal(sides_of(ribbed)[3], 4)
check.equal(table.concat(ribbed.regions, " "), "left right rib")
-- Some of the faces, by name.
check.equal(panel:quads({ faces = { "left", "rib" }, size = 0.5 }).quads, 16)
check.equal(panel:quads({ faces = "rib", size = function(_, y) return 0.25 + 0.1 * y end }).hexes, 0)

-- Order 2: middle nodes on round faces.
local function tube(order, serendipity)
  local points, cells, n = {}, {}, 96
  for k = 0, n - 1 do
    local a = 2 * math.pi * k / n
    points[#points + 1] = { math.cos(a), math.sin(a), 0 }
    points[#points + 1] = { math.cos(a), math.sin(a), 2 }
    cells[#cells + 1] = { 2 * k + 1, 2 * (k + 1) % (2 * n) + 1, 2 * (k + 1) % (2 * n) + 2, 2 * k + 2 }
  end
  local model = lacuna.model()
  local half = {}
  for i = 1, n // 2 do half[i] = cells[i] end
  model:add_face { name = "half", points = points, cells = half }
  return model:quads { size = 0.5, order = order, serendipity = serendipity }
end
local straight, full, eight = tube(1), tube(2), tube(2, true)
check.equal(full.order, 2)
check.equal(full.quads, straight.quads)
check.equal(full.nodes - eight.nodes, full.quads)
check.equal(full:cells().columns, 9)
check.equal(eight:cells("quad").columns, 8)
for i = 1, full.nodes do
  local x, y = full:node(i)
  check.near(x * x + y * y, 1, 0.0025) -- chords of 96 facets sag by 0.0005
end
check.equal(#full:coordinates(), full.nodes)

-- Given quads stay, and the mesh is a model again, to be swept.
local kept = lacuna.model()
kept:add_face { name = "plate", points = { { 0, 0, 0 }, { 1, 0.1, 0 }, { 2, 0, 0 }, { 2, 1, 0 },
  { 1, 0.8, 0 }, { 0, 1, 0 } }, cells = { { 1, 2, 5, 6 }, { 2, 3, 4, 5 } }, keep_mesh = true }
local plate = kept:quads { size = 0.1 }
check.equal(plate.quads, 2)
check.equal(plate.nodes, 6)
local solid = ribbed:model():open_volume { source = "left", along = { vector = { 0, 0, -1 } } }
  :sweep { layers = 3 }
check.equal(solid.hexes, 24)

-- Every format, and back.
local roof = lacuna.synthetic.prism { sides = 5, radius = 2, height = 1 }
for order = 1, 2 do
  local mesh = roof:quads { size = 0.6, order = order, serendipity = order == 2 }
  for _, ending in ipairs { "msh", "vtu", "vtk", "inp", "bdf", "unv", "exo" } do
    local path = ("%s/roof_%d.%s"):format(params.scratch, order, ending)
    mesh:write(path)
    local read, area, quads = lacuna.load(path), 0, 0
    for _, face in ipairs(read:faces()) do area = area + face.area end
    check.near(area, mesh:quality().area, 1e-5)
    local checked = lacuna.check(path)
    check.equal(checked.quads, mesh.quads)
    check.near(checked.min_scaled_jacobian, mesh:quality().min_scaled_jacobian, 1e-4)
    local named = ending == "msh" or ending == "inp" or ending == "exo"
    if named then check.equal(read:face("source").name, "source") end
    check.equal(read:quads({ quads = order == 1 and "keep" or "auto", size = 0.6 }).hexes, quads)
  end
end
local groups = {}
for _, group in ipairs(roof:quads({ size = 0.6 }):groups()) do groups[group.name] = group.cells end
check.that(groups.source > 0 and groups.wall_3 > 0)
ribbed:picture(params.scratch .. "/ribbed.png")
ribbed:view(params.scratch .. "/ribbed.html")
check.that(tostring(ribbed):find "24 quads")

-- --- refusals --------------------------------------------------------------------------------------------

check.fails(function() panel:quads { size = -1 } end, "size")
check.fails(function() panel:quads { faces = "none" } end, "none")
check.fails(function() panel:quads { faces = {}, size = 1 } end, "fill.no_faces")
check.fails(function() panel:quads { layers = 3 } end, "layers")
check.fails(function() panel:quads { order = 3 } end, "1 or 2")
check.fails(function() panel:quads { quads = "keep" } end, "left")
check.fails(function() ribbed:write(params.scratch .. "/x.vtu", { with = panel }) end, "with")
check.fails(function() ribbed:write(params.scratch .. "/x.stl2") end, "stl2")
check.fails(function() lacuna.assembly { ribbed } end, "Mesh")
-- Triangles alone have no quality of quads.
local triangle = params.scratch .. "/triangle.inp"
do
  local file <close> = assert(io.open(triangle, "w"))
  file:write "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n*ELEMENT, TYPE=S3, ELSET=A\n1, 1, 2, 3\n"
end
check.fails(function() lacuna.check(triangle) end, "lua.no_hexahedra", "quads")

check.done()
