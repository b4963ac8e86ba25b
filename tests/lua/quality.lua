-- SPDX-License-Identifier: MIT
-- quality = mesh:quality(), lacuna.check and the option `quality` of mesh:write.
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local params = lacuna.params { lacuna = "", scratch = "" }
local folder = check.empty_folder(params.scratch)

local void = lacuna.synthetic.prism { sides = 5, holes = 1, twist = 40, taper = 0.6 }:open_volume()
void:close()
local mesh = void:sweep { layers = 6 }
local quality = mesh:quality()

-- Rows in order and by name, one a metric.
local names = { "scaled_jacobian", "scaled_jacobian_with_centre", "jacobian", "shape", "shear", "condition",
  "max_aspect_frobenius", "med_aspect_frobenius", "oddy", "skew", "taper", "max_edge_ratio", "edge_ratio",
  "full_edge_ratio", "stretch", "diagonal", "dimension", "volume", "distortion", "relative_size_squared",
  "shape_and_size", "shear_and_size" }
check.equal(#quality.metrics, #names)
for i, name in ipairs(names) do
  local row = quality.metrics[name]
  check.equal(quality.metrics[i], row, name)
  check.equal(row.name, name)
  check.that(row.min <= row.mean and row.mean <= row.max, name)
  check.that(row.deviation >= 0 and row.deviation <= row.max - row.min, name)
  check.that(row.outside >= 0 and row.outside <= mesh.hexes, name)
  check.near(row.outside_share, row.outside / mesh.hexes, 1e-15)
  check.that(row.worst.value == row.min or row.worst.value == row.max, name)
  check.that(row.worst.layer >= 1 and row.worst.layer <= 6, name)
  check.equal((row.worst.cell - 1) // (mesh.hexes // 6) + 1, row.worst.layer, name)
  if row.acceptable then
    local low, high = row.acceptable[1], row.acceptable[2]
    check.that(low < high, name)
    -- All inside exactly where the least and the largest are.
    check.equal(row.outside == 0, row.min >= low - 1e-9 and row.max <= high + 1e-9, name)
  else
    check.equal(row.outside, 0, name)
  end
end

-- A buffer of a metric: a row for each of mesh:cells(kind).
for _, name in ipairs(names) do
  local values, low, sum = mesh:field(name), math.huge, 0
  for _, value in values:each() do low, sum = math.min(low, value), sum + value end
  local row = quality.metrics[name]
  check.equal(values.rows, mesh.hexes)
  check.near(low, row.min, 1e-6 * math.max(1, math.abs(row.min)))
  check.near(sum / values.rows, row.mean, 1e-6 * math.max(1, math.abs(row.mean)))
end
check.equal(mesh:field("volume", "wedge").rows, 0)
check.fails(function() mesh:field "skevv" end, "lua.bad_value", 'did you mean "skew"')
check.fails(function() mesh:field("skew", "wedge") end, "lua.bad_value", "hexahedra only", '"volume"')
check.fails(function() mesh:field("skew", "prism") end, "lua.bad_value")

-- The fields are the same measure as the row.
check.equal(quality.metrics.scaled_jacobian.min, quality.min_scaled_jacobian)
check.near(quality.metrics.scaled_jacobian.mean, quality.mean_scaled_jacobian, 1e-12)
check.equal(quality.metrics.scaled_jacobian.worst.cell, quality.worst[1].cell)
check.equal(quality.metrics.scaled_jacobian.worst.value, quality.worst[1].scaled_jacobian)
for i = 2, #quality.worst do
  check.that(quality.worst[i - 1].scaled_jacobian <= quality.worst[i].scaled_jacobian)
end

-- The worst cells are one of each column, its least, of every kind of mesh; and so are those that a refusal
-- names. What improves cells is a stage of its own.
local improved_some, left_some = 0, 0
local runs = check.members_to_run(3) -- seven of 20
for sides = 3, 7 do
  for _, options in ipairs { { layers = 9 }, { layers = 9, size = 0.2, improve = false },
    { layers = 9, size = 0.4, order = 2 }, { layers = 30, size = 0.4, wedges = true } } do
    if not runs() then goto next end
    local shape = lacuna.synthetic.prism { sides = sides, twist = 90, taper = 0.4, holes = sides % 2,
      height = 1 }
    local swept = shape:open_volume():sweep(options)
    local columns = (swept.hexes + swept.wedges) // options.layers
    local worst, met = swept:quality().worst, {}
    check.equal(#worst, math.min(10, columns))
    for i, cell in ipairs(worst) do
      local column = (cell.cell - 1) % columns
      check.that(not met[column], "column " .. column .. " is named twice")
      met[column] = true
      check.that(i == 1 or worst[i - 1].scaled_jacobian <= cell.scaled_jacobian)
    end
    check.equal(worst[1].scaled_jacobian, swept:quality().min_scaled_jacobian)
    local said = tostring(swept.report):find("improved: ", 1, true) or
        tostring(swept.report):find("untangled: ", 1, true)
    local seconds = swept.report.seconds
    if said then
      improved_some = improved_some + 1
      check.that(seconds.improving and seconds.improving > 0, "seconds of improving")
    end
    if options.improve == false then
      left_some = left_some + 1
      check.equal(seconds.improving, nil)
    end
    check.that(seconds["proof of every cell"] > 0)
    options.min_scaled_jacobian, options.layers = 1, 9 -- 30 layers take 40 s: each piece is improved
    local message = check.fails(function() shape:open_volume():sweep(options) end, "quality.below_limit")
    met = {}
    local first = message:match("^(.-) %(swept from the ") or message -- those of other plans follow
    for cell in first:gmatch("cell (%d+)") do
      local column = (tonumber(cell) - 1) % columns
      check.that(not met[column], "column " .. column .. " is named twice in the refusal")
      met[column] = true
    end
    check.that(next(met), message)
    check.that(message:find("lower 'min_scaled_jacobian'", 1, true) and not message:find("mixed", 1, true))
    ::next::
  end
end
check.that(improved_some > 0 and left_some > 0)

-- In an assembly too, whose cells are numbered part by part.
do
  local behind = lacuna.synthetic.prism { sides = 6, twist = 60, height = 2 }
  local before = lacuna.model()
  local low, high = {}, {}
  for i = 0, 5 do
    local a = i * math.pi / 3
    low[i + 1], high[i + 1] = { 1.2 * math.cos(a), math.sin(a), -1 }, { math.cos(a), math.sin(a), 0 }
  end
  local fan = { { 1, 2, 3, 4 }, { 1, 4, 5, 6 } }
  before:add_face { name = "source", points = low, cells = fan }
  before:add_face { name = "target", points = high, cells = fan }
  local both = lacuna.assembly { behind:open_volume { name = "a", source = "source", target = "target",
    walls = "auto" }, before:open_volume { name = "b", source = "source", target = "target" } }
  local swept = both:sweep { layers = 8, size = 0.3 }
  local worst, met = swept:quality().worst, {}
  local own = {}
  for _, group in ipairs(swept:groups()) do own[group.name] = group.cells end
  check.equal(#worst, 10)
  for _, cell in ipairs(worst) do
    local at = cell.cell - 1
    local column = at < own.a and "a" .. at % (own.a // 8) or "b" .. (at - own.a) % (own.b // 8)
    check.that(not met[column], "column " .. column .. " is named twice")
    met[column] = true
  end
end

-- Where the worst cell is: the mean of its nodes.
local x = 0
for _, node in ipairs { mesh:hex(quality.worst[1].cell) } do x = x + mesh:node(node) / 8 end
check.near(quality.worst[1].centre[1], x, 1e-12)

-- All fields are met by pairs(), the metrics included, asked for or not.
local met = {}
for key in pairs(mesh:quality()) do met[key] = true end
for _, key in ipairs { "min_scaled_jacobian", "mean_scaled_jacobian", "inverted", "certified", "worst",
    "histogram", "metrics" } do
  check.that(met[key], key)
end
check.equal(quality.no_such_field, nil)

-- Printed: counts, a histogram, a line a metric with its range. The least scaled Jacobian stands there once,
-- at order 2 too, where that of the corners is another number.
local text = tostring(quality)
local bent = lacuna.synthetic.prism { sides = 6, twist = 40, height = 1.5 }:open_volume {}
for _, order in ipairs { 1, 2 } do
  local own = bent:sweep { size = 0.4, order = order }:quality()
  local printed = tostring(own)
  check.equal(select(2, printed:gsub("[Ss]caled.Jacobian +least", "")), 1)
  check.that(printed:find(("least %12.4f"):format(own.min_scaled_jacobian), 1, true))
  check.that(not printed:find "\nscaled_jacobian +[%d.]+ ")
end
for _, words in ipairs { "hexahedra", "###", "0.5 to 1", "shape_and_size", "full_edge_ratio", "%" } do
  check.that(text:find(words, 1, true), words)
end
check.equal(tostring(mesh:quality()), text)

-- The numbers of a file are those of the mesh, though its layers are not known any more.
local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end
mesh:write(folder .. "/a.msh")
local checked = lacuna.check(folder .. "/a.msh")
for _, name in ipairs(names) do
  -- sizes: the mean is summed otherwise
  check.near(checked.metrics[name].min, quality.metrics[name].min, 1e-12)
  check.near(checked.metrics[name].max, quality.metrics[name].max, 1e-9 * math.abs(quality.metrics[name].max))
  check.equal(checked.metrics[name].outside, quality.metrics[name].outside, name)
  check.equal(checked.metrics[name].worst.layer, nil, name)
end

-- `lacuna check` prints the same.
local code, out = check.run(params.lacuna, folder, { "check", "a.msh" })
check.equal(code, 0)
for _, words in ipairs { "###", "0.5 to 1", "shape_and_size", "scaled Jacobian" } do
  check.that(out:find(words, 1, true), words)
end

-- What goes along into files.
local function fields(options, ending)
  local path = folder .. "/b" .. (ending or ".msh")
  mesh:write(path, options)
  local found = {}
  local pattern = ending == ".vtu" and 'Float64" Name="([%w_]+)"' or '%$ElementData\n1\n"([%w_]+)"'
  for name in read(path):gmatch(pattern) do found[#found + 1] = name end
  return table.concat(found, " ")
end
check.equal(fields(), "scaled_jacobian")
check.equal(fields { binary = false }, "scaled_jacobian")
check.equal(fields { quality = true }, "scaled_jacobian")
check.equal(fields { quality = false }, "")
check.equal(fields { quality = {} }, "")
check.equal(fields { quality = "shape" }, "shape")
check.equal(fields { quality = { "skew", "shape", "skew" } }, "skew shape")
check.equal(fields { version = 2.2 }, "")
check.equal(fields { version = 2.2, quality = true }, "scaled_jacobian")
check.equal(fields(nil, ".vtu"), "scaled_jacobian")
check.equal(fields({ quality = { "taper", "oddy" } }, ".vtu"), "taper oddy")
check.fails(function() fields { quality = "shap" } end, "quality", "shap", "did you mean \"shape\"")
check.fails(function() fields { quality = { "shape", "beauty" } } end, "quality[2]", "beauty")
check.fails(function() fields { quality = 3 } end, "quality", "found 3")
check.that(not check.exists(folder .. "/c.msh"))

-- A file with each kind of solid: counts, the least of each, metrics where they are defined.
local top = 1 + 0.5 ^ 0.5
check.write(folder .. "/mixed.msh", ([[
$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
12
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
9 0.5 0.5 %.17g
10 1.5 0.5 1.5
11 2 0.5 0
12 2 0.5 1
$EndNodes
$Elements
4
1 5 2 0 1 1 2 3 4 5 6 7 8
2 7 2 0 1 5 6 7 8 9
3 4 2 0 1 6 7 9 10
4 6 2 0 1 2 11 3 6 12 7
$EndElements
]]):format(top))
local mixed = lacuna.check(folder .. "/mixed.msh")
for _, kind in ipairs { "hexes", "wedges", "pyramids", "tets" } do
  check.equal(mixed[kind], 1, kind)
  check.that(mixed.least[kind] >= mixed.min_scaled_jacobian, kind)
end
check.near(mixed.least.hexes, 1, 1e-12)
check.near(mixed.least.pyramids, 1, 1e-12)
check.that(mixed.certified)
check.equal(mixed.metrics.volume.cells, 4)
check.equal(mixed.metrics.shape.cells, 1)
check.that(tostring(mixed):find "pyramids" and tostring(mixed):find "of the tetrahedra")
check.equal(quality.least.tets, nil)
check.near(quality.least.hexes, quality.min_scaled_jacobian, 0)
-- A pyramid is a brick there, and a pyramid again when it is read.
for _, ending in ipairs { ".inp", ".unv", ".bdf", ".exo", ".vtk" } do
  lacuna.convert(folder .. "/mixed.msh", folder .. "/mixed" .. ending)
  local again = lacuna.check(folder .. "/mixed" .. ending)
  check.equal(again.pyramids, 1, ending)
  check.near(again.volume, mixed.volume, 1e-9, ending)
  check.equal(#lacuna.load(folder .. "/mixed" .. ending):info().faces > 0, true, ending)
end

-- What is kept for a quality goes with it: many of them do not pile up.
for _ = 1, 200 do mesh:quality() end
collectgarbage()
collectgarbage()
check.that(collectgarbage("count") < 50000)

check.done()
