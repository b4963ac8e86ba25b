-- SPDX-License-Identifier: MIT
-- Every option of every call: an unknown key names the nearest known one, and a wrong value is told which
-- option of which call it is, what was expected and what was found.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"

local function volume()
  return lacuna.synthetic.prism({ drop = "walls" }):open_volume { source = "source", target = "target" }
end

local square = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }

-- call = { how to call it with these options, { option = a good value, ... } }
local calls = {
  load = { function(o) lacuna.load("nowhere.step", o) end,
      { "tolerance", "feature_angle", "keep_mesh", "scale", "cad_seconds", "cad_megabytes", "without" } },
  model = { lacuna.model, { "tolerance" } },
  add_face = { function(o) lacuna.model():add_face(o) end, { "name", "points", "cells", "keep_mesh" } },
  faces = { function(o) lacuna.model():faces(o) end,
    { "tags", "name", "kind", "facing", "near", "area", "box", "touching", "free",
    "region", "radius", "normal_within", "within" } },
  open_volume = { function(o) lacuna.synthetic.barrel():open_volume(o) end,
      { "source", "target", "walls", "faces", "class" } },
  view = { function(o) lacuna.synthetic.barrel():view("never_written.html", o) end, { "title" } },
  picture = { function(o) lacuna.synthetic.barrel():picture("never_written.png", o) end,
      { "width", "height", "view", "facets" } },
  match = { function(o) volume():match(o) end, { "method", "vertices", "loops", "flip" } },
  close = { function(o) volume():close(o) end, { "edge_shape", "void_edges", "cap", "holes" } },
  sweep = { function(o) volume():sweep(o) end,
            { "layers", "size", "curvature", "gap", "max_deviation", "quads",
                "order", "serendipity", "min_scaled_jacobian", "improve", "threads" } },
  ["synthetic.prism"] = { lacuna.synthetic.prism,
            { "sides", "radius", "height", "holes", "hole_radius", "twist", "taper", "bend", "facets",
                "drop" } },
  ["synthetic.annulus"] = { lacuna.synthetic.annulus, { "inner", "outer", "height", "facets", "drop" } },
  ["synthetic.elbow"] = { lacuna.synthetic.elbow,
      { "radius", "inner", "bend_radius", "angle", "facets", "drop" } },
  ["synthetic.barrel"] = { lacuna.synthetic.barrel, { "radius", "height", "bulge", "facets", "drop" } },
  ["synthetic.plate"] = { lacuna.synthetic.plate,
      { "length", "width", "height", "holes", "hole_radius", "facets", "drop" } },
}
for name, entry in pairs(calls) do
  local call, keys = table.unpack(entry)
  for _, key in ipairs(keys) do
    -- The last letter twice: one edit away from this key, and from no other.
    local typo = key .. key:sub(-1)
    check.fails(function() call { [typo] = 1 } end, name .. ":", "'" .. typo .. "'", "'" .. key .. "'",
        "The keys are:")
    -- No option takes a coroutine.
    check.fails(function() call { [key] = coroutine.create(print) } end, name .. ":", "'" .. key .. "'",
        "must be", "a thread")
  end
  check.fails(function() call { 7 } end, name .. ":", "7", "without a name")
  check.fails(function() call(true) end, name .. ":", "found true")
end

-- Values that are of the right type and still wrong.
local function wrong(name, key, values, expected)
  for _, value in ipairs(values) do
    local message = check.fails(function() calls[name][1] { [key] = value } end, name .. ":", "'" .. key,
        expected)
    if type(value) == "number" and value == value and math.abs(value) < math.huge then
      check.that(message:find(tostring(value), 1, true), "what was found is told: " .. message)
    end
  end
end
local huge, nan = math.huge, 0 / 0
wrong("model", "tolerance", { 0, -1, nan, huge, "1", true, {} }, "a positive number")
wrong("load", "tolerance", { 0, -1, nan, huge, "1", true, {} }, "a positive number")
wrong("load", "scale", { 0, -1, nan, huge, "1" }, "a positive number")
wrong("load", "cad_seconds", { 0, -1, nan, "1" }, "a positive number")
wrong("load", "cad_megabytes", { 0, -1, nan, "1" }, "a positive number")
wrong("load", "feature_angle", { 0, -1, nan, "1" }, "a positive number")
wrong("load", "feature_angle", { 181 }, "degrees")
wrong("load", "keep_mesh", { 1, "true" }, "true or false")
wrong("add_face", "name", { "", 1 }, "a word in quotes")
wrong("add_face", "points", { 1, {}, { { 0, 0, 0 } } }, "at least three points")
wrong("add_face", "points", { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1 } } }, "{ x, y, z }")
wrong("add_face", "points", { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, nan } } }, "a number")
wrong("add_face", "cells", { 1, {} }, "triangles")
wrong("add_face", "cells", { { { 1, 2 } }, { 1, 2, 3 } }, "three or four")
wrong("add_face", "cells", { { { 0, 1, 2 } } }, "count from 1")
wrong("add_face", "cells", { { { 1.5, 2, 3 } } }, "a positive whole number")
wrong("add_face", "cells", { { { 1, 2, 1 } } }, "point 1 twice")
check.fails(function() lacuna.model():add_face { points = square, cells = { { 1, 2, 5 } } } end, "cells[1]",
    "point 5", "4 points")
check.fails(function() lacuna.model():add_face { points = square } end, "'cells' is missing")
check.fails(function() lacuna.model():add_face { cells = { { 1, 2, 3 } } } end, "'points' is missing")
check.fails(function() lacuna.model():add_face() end, "add_face:", "nothing")
wrong("faces", "tags", { "1", 1.5, { "a" } }, "a whole number")
wrong("faces", "kind", { "plain", 1 }, "plane")
wrong("faces", "facing", { { 0, 0 }, 1 }, "three numbers")
wrong("faces", "facing", { { 0, 0, 0 } }, "a direction")
wrong("faces", "near", { { 0, 0 }, "here" }, "three numbers")
wrong("faces", "area", { 1, { 1 }, { 1, 2, 3 } }, "{ min, max }")
wrong("faces", "area", { { 2, 1 } }, "increasing order")
wrong("open_volume", "source", { 99, "nobody", { 99 }, { "nobody" } }, "the model has face 1 \"source\"")
wrong("open_volume", "walls", { { tags = 99 } }, "selects no face")
wrong("open_volume", "class", { "VI", 2 }, "one of I, II, III, IV, V, closed")
wrong("match", "method", { "neerest" }, 'did you mean "nearest"?')
wrong("match", "vertices", { 1, { 1 }, { { 1 } } }, "{ source, target }")
wrong("match", "loops", { { { 0, 1 } } }, "a positive whole number")
wrong("match", "flip", { 1, { 0 }, { 1.5 } }, "must be")
wrong("close", "edge_shape", { "bent", 1 }, "straight, follow")
wrong("close", "void_edges", { 1, { 1 }, { { 1 } }, { { 1, 2, {}, 4 } } }, "{ from, to, points }")
wrong("close", "void_edges", { { { 0, 1 } }, { { 1, 1.5 } } }, "a positive whole number")
wrong("close", "void_edges", { { { 1, 2, 3 } } }, "an array of points {x, y, z}")
wrong("close", "void_edges", { { { 1, 2, { 3 } } }, { { 1, 2, { { 0, 0 } } } } }, "three numbers")
wrong("close", "void_edges", { { { 1, 2, { { 0, 0, nan } } } } }, "void_edges[1][3][1]")
wrong("close", "cap", { "round", 1 }, "flat, parallel")
wrong("close", "holes", { "covr", "auto", 1 }, "cover, through")
wrong("sweep", "layers", { 0, -3, 2.5, nan, huge, "8", true }, "a positive whole number")
wrong("sweep", "layers", { { 0.5, 0.5, 1 }, { 0, 1 }, { 0.5, 1.5 } }, "increasing heights")
wrong("sweep", "layers", { { 0.2, 0.5 } }, "must end with the height 1")
wrong("sweep", "layers", { { bias = 2 } }, "no 'count'")
check.fails(function() volume():sweep { layers = { count = 0 } } end, "sweep: layers", "'count'", "found 0")
check.fails(function() volume():sweep { layers = { count = 2, bias = -1 } } end, "'bias'", "found -1")
check.fails(function() volume():sweep { layers = { count = 2, mode = "bel" } } end, "'mode'",
    'did you mean "bell"?')
check.fails(function() volume():sweep { layers = { cuont = 2 } } end, "'cuont'", "'count'")
wrong("sweep", "size", { 0, -1, nan, huge, "1", {} }, "a positive number")
wrong("sweep", "quads", { "pave" }, 'did you mean "paved"?')
wrong("sweep", "curvature", { -1, 1.5, "12" }, "must be")
wrong("sweep", "gap", { 0, -1, 1.5 }, "a positive whole number")
wrong("sweep", "max_deviation", { 0, -1, nan, huge }, "must be")
wrong("sweep", "order", { 0, 3, 1.5 }, "must be")
wrong("sweep", "min_scaled_jacobian", { -0.1, 1.1 }, "[0, 1]")
wrong("sweep", "threads", { 0, -1, 1.5 }, "a positive whole number")
wrong("sweep", "threads", { 1025 }, "to 1024")
for _, quads in ipairs { "mapped", "gmsh", "keep" } do
  check.fails(function() volume():sweep { layers = 1, rows = 2, quads = quads } end, "sweep:", "'rows'",
      "paved")
  check.fails(function() volume():sweep { layers = 1, row_height = 0.1, quads = quads } end, "sweep:",
      "'rows'", "paved")
end
-- Ten times 0.1 is 1 but for rounding.
local steps, sum = {}, 0
for i = 1, 10 do sum = sum + 0.1; steps[i] = sum end
check.that(sum ~= 1)
check.equal(volume():sweep({ layers = steps, size = 1 }).layers, 10)
-- More cells than anybody means are refused at once where one of both numbers asks for them.
do
  local function refused(what, call)
    local start = os.clock()
    check.fails(call, "sweep.many_cells", "both 'size' and 'layers'")
    check.that(os.clock() - start < 1, what .. " is refused at once")
  end
  local synthetic = lacuna.synthetic
  local shapes = {
    prism = synthetic.prism { radius = 40, height = 80 },
    annulus = synthetic.annulus { outer = 40, inner = 20, height = 80 },
    elbow = synthetic.elbow { radius = 20, bend_radius = 60 },
    barrel = synthetic.barrel { radius = 40, height = 80 },
    plate = synthetic.plate { length = 80, width = 80, height = 10 },
    twisted = synthetic.prism { radius = 40, height = 80, twist = 30, taper = 0.5, holes = 1 },
  }
  for name, model in pairs(shapes) do
    local function open()
      return model:open_volume { source = "source", target = "target", walls = "auto" }
    end
    refused(name, function() open():sweep { size = 0.002 } end)
    refused(name, function() open():sweep { size = 0.05 } end)
    refused(name, function() open():sweep { layers = 10000000 } end)
    refused(name, function() open():sweep { size = function() return 0.02 end } end)
    refused(name, function() open():sweep_to("never_made.msh", { size = 0.002 }) end)
    refused(name, function() lacuna.assembly({ open() }):sweep { size = 0.002 } end)
  end
  -- An assembly is counted as a whole: each of these has 30 million.
  local both = lacuna.model()
  for _, shift in ipairs { 0, 1 } do
    local low = { { shift, 0, 0 }, { shift + 1, 0, 0 }, { shift + 1, 1, 0 }, { shift, 1, 0 } }
    local high = {}
    for i, p in ipairs(low) do high[i] = { p[1], p[2], 1 } end
    both:add_face { name = "low" .. shift, points = low, cells = { { 1, 4, 3, 2 } } }
    both:add_face { name = "high" .. shift, points = high, cells = { { 1, 2, 3, 4 } } }
  end
  local function pair()
    return lacuna.assembly { both:open_volume { source = "low0", target = "high0", name = "left" },
      both:open_volume { source = "low1", target = "high1", name = "right" } }
  end
  refused("assembly", function() pair():sweep { size = 30e6 ^ (-1 / 3) } end)
  refused("assembly", function() pair():sweep_to("never_made.msh", { size = 30e6 ^ (-1 / 3) }) end)
  -- Meshes that faces came with are counted, not what the size would make there.
  local given = lacuna.model()
  local function grid(name, at)
    local points, cells = {}, {}
    for i = 0, 3 do for j = 0, 3 do points[#points + 1] = at(i / 3, j / 3) end end
    for i = 0, 2 do
      for j = 1, 3 do cells[#cells + 1] = { 4 * i + j, 4 * i + j + 4, 4 * i + j + 5, 4 * i + j + 1 } end
    end
    given:add_face { name = name, points = points, cells = cells, keep_mesh = true }
  end
  grid("source", function(u, v) return { v, u, 0 } end)
  grid("wall", function(u, v) return { u, 0, v } end)
  given:add_face { name = "target", points = { { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } },
    cells = { { 1, 2, 3, 4 } } }
  local kept = given:open_volume { source = "source", target = "target", walls = "wall" }
  check.equal(kept:sweep({ size = 1e-4 }).hexes, 27)
end
wrong("picture", "width", { 0, -1, 2.5, "8" }, "a positive whole number")
wrong("picture", "width", { 15, 16385 }, "16 to 16384")
wrong("picture", "view", { "izo" }, 'did you mean "iso"?')
wrong("picture", "view", { { 0, 0 } }, "three numbers")
wrong("synthetic.prism", "sides", { 2, 3.5, "6" }, "at least 3")
wrong("synthetic.prism", "radius", { 0, -1, huge }, "a positive number")
wrong("synthetic.prism", "holes", { -1, 0.5 }, "at least 0")
wrong("synthetic.prism", "bend", { 300 }, "folds")
wrong("synthetic.prism", "drop", { { "wall_7" }, { "sauce" } }, "not a face of this volume")
wrong("synthetic.annulus", "inner", { 1, 2 }, "below 'outer'")
wrong("synthetic.elbow", "bend_radius", { 0.5, 1 }, "above 'radius'")

-- Arguments by themselves.
check.fails(function() lacuna.load() end, "load:", "path", "nothing")
check.fails(function() lacuna.load(7) end, "load:", "found 7")
check.fails(function() lacuna.load { "a.step", 7 } end, "load:", "path[2]", "found 7")
check.fails(function() lacuna.model(7) end, "model:", "found 7")
check.fails(function() lacuna.params(7) end, "params:", "found 7")

-- The recipe's own file and line, from however deep in the binary the error comes.
local line = debug.getinfo(1, "l").currentline + 1
local message = check.fails(function() lacuna.synthetic.prism { side = 3 } end)
check.that(message:find("options.lua:" .. line .. ":", 1, true), message)

check.done()
