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

-- The fields are the same measure as the row.
check.equal(quality.metrics.scaled_jacobian.min, quality.min_scaled_jacobian)
check.near(quality.metrics.scaled_jacobian.mean, quality.mean_scaled_jacobian, 1e-12)
check.equal(quality.metrics.scaled_jacobian.worst.cell, quality.worst[1].cell)
check.equal(quality.metrics.scaled_jacobian.worst.value, quality.worst[1].scaled_jacobian)
for i = 2, #quality.worst do
  check.that(quality.worst[i - 1].scaled_jacobian <= quality.worst[i].scaled_jacobian)
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

-- Printed: counts, a histogram, a line a metric with its range.
local text = tostring(quality)
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

-- What is kept for a quality goes with it: many of them do not pile up.
for _ = 1, 200 do mesh:quality() end
collectgarbage()
collectgarbage()
check.that(collectgarbage("count") < 50000)

check.done()
