-- SPDX-License-Identifier: MIT
-- Boundary layers and intervals as recipes ask for them, and what is refused.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"

local function box(drop)
  local model = lacuna.synthetic.prism { sides = 4, radius = math.sqrt(2), height = 2, drop = drop }
  local walls = drop and { "wall_1", "wall_3" } or "auto"
  return model:open_volume { source = "source", target = "target", walls = walls }, model
end

-- Distances of the nodes from a plane through a wall's middle, least above nothing.
local function least_distance(mesh, face)
  local least = math.huge
  for i = 1, mesh.nodes do
    local p = { mesh:node(i) }
    local d = 0
    for k = 1, 3 do d = d + (p[k] - face.centroid[k]) * face.normal[k] end
    d = math.abs(d)
    if d > 1e-9 and d < least then least = d end
  end
  return least
end

-- Walls by name, tag, Face, selector and word; one table or several.
do
  local ways = {
    function() return "wall_1" end,
    function(model) return model:face("wall_1").tag end,
    function(model) return model:face "wall_1" end,
    function(model) return { near = model:face("wall_1").centroid } end,
    function() return { "wall_1" } end,
    function(model) return { model:face "wall_1", "wall_2" } end,
    function() return "walls" end,
  }
  for _, way in ipairs(ways) do
    local volume, model = box()
    local mesh = volume:sweep { layers = 2, size = 0.4,
      boundary_layers = { walls = way(model), first = 0.03, growth = 1.5, count = 3 } }
    check.near(least_distance(mesh, model:face "wall_1"), 0.03, 1e-9)
    check.that(mesh:quality().certified)
  end
  local volume, model = box()
  local mesh = volume:sweep { layers = 2, size = 0.4, boundary_layers = {
    { walls = "wall_1", first = 0.03, count = 2 }, { walls = "wall_2", first = 0.05 } } }
  check.near(least_distance(mesh, model:face "wall_1"), 0.03, 1e-9)
  check.near(least_distance(mesh, model:face "wall_2"), 0.05, 1e-9)
  local said
  for _, line in ipairs(mesh.report) do said = said or line:find("boundary layers of", 1, true) end
  check.that(said, "the report says what was reached")
end

-- Walls in rings over each other: "walls" gives all of them the rows of those below, and one in the middle
-- has none by itself.
for sides = 3, 7 do
  for rings = 2, 5 do
    local model, heights = lacuna.model(), {}
    for ring = 0, rings do heights[ring] = ring + 0.3 * math.sin(ring) end
    local function point(i, level)
      local angle = 2 * math.pi * i / sides
      return { 2 * math.cos(angle), 2 * math.sin(angle), heights[level] }
    end
    for name, level in pairs { source = 0, target = rings } do
      local points, cells = {}, {}
      for i = 1, sides do points[i] = point(i, level) end
      for i = 2, sides - 1 do cells[i - 1] = { 1, i, i + 1 } end
      model:add_face { name = name, points = points, cells = cells }
    end
    for ring = 1, rings do
      for i = 1, sides do
        model:add_face { name = ("wall_%d_%d"):format(ring, i), cells = { { 1, 2, 3, 4 } },
          points = { point(i, ring - 1), point(i + 1, ring - 1), point(i + 1, ring), point(i, ring) } }
      end
    end
    local function volume()
      return model:open_volume { source = "source", target = "target", walls = "auto" }
    end
    local what = sides .. " sides, " .. rings .. " rings"
    local rows = { walls = "walls", first = 0.03, growth = 1.5, count = 2 }
    local mesh = volume():sweep { layers = 6, size = 0.5, boundary_layers = rows }
    for ring = 1, rings do
      check.near(least_distance(mesh, model:face("wall_" .. ring .. "_1")), 0.03, 1e-9, what)
    end
    if rings > 2 then
      rows.walls = "wall_2_1"
      check.fails(function() volume():sweep { layers = 6, size = 0.5, boundary_layers = rows } end,
          "touches neither source nor target", 'walls = "walls"', "surface.layers_unreached")
    end
  end
end

-- Void walls have names too.
do
  local name
  for face in pairs(box({ "wall_2", "wall_4" }):sweep({ layers = 1, size = 0.5 }).fidelity.faces) do
    if type(face) == "string" and face:find "^void:" then name = name or face end
  end
  local mesh = box { "wall_2", "wall_4" }:sweep { layers = 2, size = 0.4,
    boundary_layers = { walls = name, first = 0.04, count = 2 } }
  local _, whole = box()
  local both = { least_distance(mesh, whole:face "wall_2"), least_distance(mesh, whole:face "wall_4") }
  check.near(math.min(table.unpack(both)), 0.04, 1e-9)
end

-- Ends.
do
  local mesh = box():sweep { size = 0.4,
    boundary_layers = { walls = { "source", "target" }, first = 0.1, growth = 2, count = 2 } }
  local heights = {}
  for i = 1, mesh.nodes do
    local _, _, z = mesh:node(i)
    heights[("%.6f"):format(z)] = true
  end
  for _, z in ipairs { 0.1, 0.3, 1.7, 1.9 } do check.that(heights[("%.6f"):format(z)], "a layer at " .. z) end
end

-- Intervals: by edge, vertices, wall and for the sweep.
do
  local volume = box()
  volume:close()
  local edge, from, to = volume:tree():match "edge (%d+) %(vertices (%d+)%-(%d+)%)"
  check.that(edge, "the tree names edges with vertices")
  edge, from, to = math.tointeger(edge), math.tointeger(from), math.tointeger(to)
  for _, what in ipairs { edge, { from, to }, "wall_1" } do
    local mesh = volume:sweep { layers = 2, size = 0.5, quads = "mapped", intervals = { { what, 7 } } }
    check.that(mesh.hexes % 7 == 0, "seven columns")
  end
  check.that(volume:sweep { size = 0.5, intervals = { { "sweep", 5, 3 } } }.layers == 5)
  check.that(volume:sweep { size = 0.5, intervals = { { "sweep", count = 5, bias = 3 } } }.layers == 5)
end

-- Rows without number, without room or too thin to be told apart are refused before any is made.
do
  local volume = lacuna.synthetic.prism { sides = 4, height = 2 }:open_volume()
  local function rows(first, count, growth)
    return function()
      volume:sweep { size = 0.5,
        boundary_layers = { walls = "walls", first = first, count = count, growth = growth } }
    end
  end
  check.fails(rows(0.01, 1000000000), "boundary_layers", "1000000000", "sweep.too_many")
  check.fails(rows(0.01, 900), "boundary_layers", "900 rows", "across", "surface.layers_room")
  check.fails(rows(0.01, 20, 0.1), "boundary_layers", "tolerance", "surface.layers_room")
  check.fails(rows(1e-12, 2), "boundary_layers", "tolerance", "surface.layers_room")
end

-- In an assembly, for the volumes that have the face: layers along a face that two share, on both sides.
do
  local model = lacuna.model()
  local corners = { { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 2 } }
  for level = 0, 2 do
    local points = {}
    for k, c in ipairs(corners) do points[k] = { c[1], c[2], level } end
    model:add_face { name = "level_" .. level, points = points, cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
  end
  local volumes = {}
  for level = 0, 1 do
    local walls = {}
    for k = 1, 4 do
      local a, b = corners[k], corners[k % 4 + 1]
      walls[k] = ("wall_%d_%d"):format(level, k)
      model:add_face { name = walls[k], cells = { { 1, 2, 3 }, { 1, 3, 4 } }, points = {
        { a[1], a[2], level }, { b[1], b[2], level }, { b[1], b[2], level + 1 }, { a[1], a[2], level + 1 } } }
    end
    volumes[level + 1] = function()
      return model:open_volume { name = "v" .. level, source = "level_" .. level,
        target = "level_" .. (level + 1), walls = walls }
    end
  end
  local function both() return lacuna.assembly { volumes[1](), volumes[2]() } end
  local mesh = both():sweep { size = 0.5,
    boundary_layers = { walls = "level_1", first = 0.05, growth = 1.5, count = 2 } }
  local heights = {}
  for i = 1, mesh.nodes do
    local _, _, z = mesh:node(i)
    heights[("%.6f"):format(z)] = true
  end
  for _, z in ipairs { 0.875, 0.95, 1.05, 1.125 } do
    check.that(heights[("%.6f"):format(z)], "a layer at " .. z)
  end
  check.that(both():sweep({ size = 0.5, intervals = { { "sweep", 4 } } }).layers.v0 == 4)
end

-- What is refused, and in which words.
local function refused(options, ...)
  options.size = 0.4
  check.fails(function() box():sweep(options) end, ...)
end
refused({ boundary_layers = { first = 0.1 } }, "walls")
refused({ boundary_layers = { walls = "wall_1" } }, "first")
refused({ boundary_layers = { walls = "wall_9", first = 0.1 } }, "wall_9")
refused({ boundary_layers = { walls = "wall_1", first = -1 } }, "positive")
refused({ boundary_layers = { walls = "wall_1", first = 0.1, rows = 3 } }, "rows")
refused({ boundary_layers = "wall_1" }, "table")
refused({ boundary_layers = { walls = { "wall_1", "wall_3" }, first = 0.6, count = 2 } }, "room")
refused({ intervals = { { 1 } } }, "count")
refused({ intervals = { { 999, 3 } } }, "999")
refused({ intervals = { { "wall_1", 3, 2 } } }, "direction")
refused({ layers = 3, intervals = { { "sweep", 4 } } }, "layers")

check.done()
