-- SPDX-License-Identifier: MIT
-- Faces without roles: where the likeliest way to sweep them fails another that encloses the same is taken,
-- and the report says so. Sizes and layers that nobody asked for are said with what they were taken from.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")

local function lines(mesh, start)
  local found = {}
  for _, line in ipairs(mesh.report) do
    if line:sub(1, #start) == start then found[#found + 1] = line end
  end
  return found
end

local function only(mesh, start)
  local found = lines(mesh, start)
  check.equal(#found, 1, start)
  return found[1]
end

--- A block of flat faces; `facets` along each edge.
local function block(x, y, z, facets)
  local model = lacuna.model()
  local function face(name, o, u, v)
    local points, cells, n = {}, {}, facets or 1
    for j = 0, n do
      for i = 0, n do
        local p = {}
        for k = 1, 3 do p[k] = o[k] + u[k] * i / n + v[k] * j / n end
        points[#points + 1] = p
      end
    end
    for j = 0, n - 1 do
      for i = 1, n do
        local a = j * (n + 1) + i
        cells[#cells + 1] = { a, a + 1, a + n + 2 }
        cells[#cells + 1] = { a, a + n + 2, a + n + 1 }
      end
    end
    model:add_face { name = name, points = points, cells = cells }
  end
  local X, Y, Z = { x, 0, 0 }, { 0, y, 0 }, { 0, 0, z }
  face("low", { 0, 0, 0 }, Y, X)
  face("high", { 0, 0, z }, X, Y)
  face("front", { 0, 0, 0 }, X, Z)
  face("back", { 0, y, 0 }, Z, X)
  face("left", { 0, 0, 0 }, Z, Y)
  face("right", { x, 0, 0 }, Y, Z)
  return model
end

-- Layers asked for and an interval along the sweep contradict each other; across another way they do not.
local model = block(4, 3, 2)
local turned = 0
for edge = 1, 12 do
  local volume = model:open_volume {}
  local mesh = volume:sweep { layers = 3, size = 1, intervals = { { edge, 5 } } }
  check.equal(mesh:quality().certified, true)
  check.that(math.abs(mesh:quality().volume - 24) < 1e-9)
  local said = lines(mesh, "roles: ")
  if #said > 0 then
    turned = turned + 1
    check.that(#said >= 2 and said[1]:find("surface.sides_asked", 1, true), said[1])
    check.that(said[#said]:find("instead, which encloses the same volume", 1, true), said[#said])
  end
end
check.equal(turned, 4, "edges along the likeliest way")

-- Where no way does, the first error stands and the volume is as it was.
local volume = model:open_volume {}
volume:close()
local before = volume:describe()
local contradiction = { { "sweep", 5 } }
check.fails(function() volume:sweep { layers = 3, size = 1, intervals = contradiction } end, "for 3")
check.equal(volume:describe(), before)

-- Roles that were named are kept to.
check.fails(function()
  for edge = 1, 12 do
    model:open_volume({ source = { "low" }, target = { "high" },
        walls = { "front", "back", "left", "right" } })
      :sweep { layers = 3, size = 1, intervals = { { edge, 5 } } }
  end
end, "intervals")

--- A block on an L without its top, whose rim bends in no plane.
local function ell(up, along, over)
  local function top(x, y) return { x, y, 3 + up * math.sin(along * x) * math.cos(over * y) } end
  local rim = { { -1.5, -1, 0 }, { 1.5, -1, 0 }, { 1.5, 0, 0 }, { 0, 0, 0 }, { 0, 1, 0 }, { -1.5, 1, 0 } }
  local found = lacuna.model()
  local cells = { { 1, 3, 2 }, { 1, 4, 3 }, { 1, 6, 4 }, { 4, 6, 5 } }
  found:add_face { name = "low", points = rim, cells = cells }
  for i, a in ipairs(rim) do
    local b = rim[i % #rim + 1]
    local points, cells = { a, b }, { { 1, 2, 3 } }
    for k = 8, 0, -1 do
      points[#points + 1] = top(a[1] + (b[1] - a[1]) * k / 8, a[2] + (b[2] - a[2]) * k / 8)
      if k > 0 then cells[#cells + 1] = { 1, #points, #points + 1 } end
    end
    found:add_face { name = "side_" .. i, points = points, cells = cells }
  end
  return found
end

-- What it lacks is that top: it is not read across.
for _, bends in ipairs { { 0.4, 1.5, 1.2 }, { 0.3, 2.5, 2 }, { 0.5, 1, 2 } } do
  local read = ell(table.unpack(bends)):open_volume {}
  read:close()
  check.that(read.class == "III" or read.class == "IV", read.class)
  check.that(read:describe():find("is a smooth face over a rim", 1, true), "what is open is told")
  check.that(read:sweep { layers = 4, size = 0.3 }.hexes > 0)
end

-- Where that leaves much of the volume open, naming the roles does not tell it: who asks for a guess gets it.
for _, bends in ipairs { { 1.6, 1.5, 1.2 }, { 1.4, 2.5, 2 } } do
  local function open(reading)
    return ell(table.unpack(bends)):open_volume { source = "low",
      walls = { "side_1", "side_2", "side_3", "side_4", "side_5", "side_6" }, reading = reading }
  end
  local refused = open()
  check.fails(function() refused:close() end, "closure.shape_open")
  check.fails(function() refused:sweep { layers = 4, size = 0.3 } end, "reading = 1")
  check.that(refused:close { cap = "flat" }.watertight)
  check.that(open(1):sweep { layers = 4, size = 0.3 }.hexes > 0)
  check.fails(function() open(2) end, "with named roles there is only reading = 1")
end

-- A pocket that is missing whole leaves a hole, which is closed in its plane: the report says so.
for _, inset in ipairs { 0.5, 1 } do
  local pocketed = block(4, 3, 2)
  local lid = {}
  for _, off in ipairs { 0, inset } do
    for _, p in ipairs { { off, off }, { 4 - off, off }, { 4 - off, 3 - off }, { off, 3 - off } } do
      lid[#lid + 1] = { p[1], p[2], 2 }
    end
  end
  local cells = {}
  for i = 1, 4 do
    local j = i % 4 + 1
    cells[#cells + 1] = { i, j, j + 4 }
    cells[#cells + 1] = { i, j + 4, i + 4 }
  end
  pocketed:add_face { name = "lid", points = lid, cells = cells }
  for _, roles in ipairs { { faces = { "low", "front", "back", "left", "right", "lid" } },
      { source = "front", target = "back", walls = { "low", "left", "right", "lid" } } } do
    local mesh = pocketed:open_volume(roles):sweep { size = 0.5, layers = 4 }
    check.that(only(mesh, "closed: "):find("a hole of face %d+ \"lid\" is closed in its plane"))
    check.that(math.abs(mesh:quality().volume - 24) < 1e-9)
  end
end

-- Sizes and layers by default.
local counts = {}
for _, facets in ipairs { 20, 40, 80 } do
  local mesh = block(4, 3, 2, facets):open_volume({}):sweep()
  counts[#counts + 1] = mesh:quality().hexes
  check.that(only(mesh, "size: "):find("by default, a twentieth of the diagonal of the source rims' box", 1,
    true))
  check.that(only(mesh, "layer count: "):find "%d+ by default")
end
check.that(math.max(table.unpack(counts)) <= 1.1 * math.min(table.unpack(counts)), "finer facets, finer mesh")
local coarse = block(4, 3, 0.1):open_volume({ source = { "front" } , target = { "back" },
  walls = { "low", "high", "left", "right" } }):sweep()
check.that(only(coarse, "size: "):find("the mean side of the facets on the source's rims", 1, true))
check.equal(#lines(block(4, 3, 2):open_volume({}):sweep { size = 1, layers = 2 }, "size: "), 0)
check.equal(#lines(block(4, 3, 2):open_volume({}):sweep { size = 1, layers = 2 }, "layer count: "), 0)

check.done()
