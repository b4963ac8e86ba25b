-- SPDX-License-Identifier: MIT
-- One open volume of `lacuna.synthetic` closed and swept into about `hexes` hexahedra: a line of JSON with
-- seconds by stage, peak memory and quality. Each run should be a process of its own; grow.py makes many.
-- usage: lacuna row.lua [shape=disc] [hexes=100000] [threads=0] [output=] [stream=false] [commit=]
-- With stream the layers are made as they are written, by volume:sweep_to, without a field of quality.
local lacuna = require "lacuna"

local params = lacuna.params { shape = "disc", hexes = 100000, threads = 0, output = "",
  stream = false, commit = "" }

-- What is given and what is left out, by name: every class of the paper, flat and curved, straight and bent.
local synthetic = lacuna.synthetic
local shapes = {
  block = { 1.4, function()
    return synthetic.prism { sides = 4, height = 1.4, drop = "walls" }
  end, "mapped" },
  along = { 1.4, function() -- the same from its source alone
    return synthetic.prism { sides = 4, height = 1.4, drop = { "walls", "target" } }
  end, "mapped", { vector = { 0, 0, 1.4 } } },
  disc = { 2, function() return synthetic.prism { sides = 96, drop = "walls" } end },
  plate = { 0.5, function() return synthetic.plate { holes = 5, drop = { "wall_1", "wall_2" } } end },
  slot = { 4, function()
    return synthetic.prism { sides = 4, height = 4, drop = { "wall_1", "wall_3" } }
  end },
  ring = { 1, function() return synthetic.annulus { drop = "wall_1" } end },
  pipe = { 1.5 * math.pi, function() return synthetic.elbow { inner = 0.5, drop = "wall_2" } end },
  barrel = { 2, function() return synthetic.barrel { drop = "target" } end },
  frame = { 0.5, function() return synthetic.plate { holes = 3, drop = { "source", "target" } } end },
  twisted = { 2, function() return synthetic.prism { sides = 6, facets = 4, twist = 90 } end },
}

local function named(model, name)
  for _, face in ipairs(model:info().faces) do
    if face.name == name then return face end
  end
end

-- The highest mark of memory that this process reached, where the system tells it.
local function peak_mib()
  local file <close> = io.open("/proc/self/status")
  local text = file and file:read("a") or ""
  local kib = text:match("VmHWM:%s*(%d+)")
  return kib and tonumber(kib) / 1024 or 0
end

local function encoded(value)
  if type(value) == "string" then return ("%q"):format(value) end
  if type(value) == "number" then return (math.type(value) == "integer" and "%d" or "%.6g"):format(value) end
  local keys, parts = {}, {}
  for key in pairs(value) do keys[#keys + 1] = key end
  table.sort(keys)
  for i, key in ipairs(keys) do parts[i] = ("%q: %s"):format(key, encoded(value[key])) end
  return "{" .. table.concat(parts, ", ") .. "}"
end

local shape = assert(shapes[params.shape], "no shape is called " .. params.shape)
local start = os.clock()
local height, make, style, along = table.unpack(shape)
local model = make()
local ends = { source = named(model, "source") and "source", target = named(model, "target") and "target" }
local volume = along and model:open_volume { source = "source", along = along } or
  model:open_volume { source = ends.source, target = ends.target,
    walls = ends.source and "auto" or model:faces() }
volume:close()
local closed = os.clock()

-- Cells about as long as they are wide; a frame's source is as large as a plate's.
local area = named(ends.source and model or synthetic.plate { holes = 3 }, "source").area
local layers = math.max(2, math.floor(height * (params.hexes / (area * height)) ^ (1 / 3) + 0.5))
local options = { layers = layers, size = (area * layers / params.hexes) ^ 0.5, quads = style }
if params.threads > 0 then options.threads = params.threads end
local mesh, stages, swept, least, mean
if params.stream then
  options.write = { quality = false }
  mesh = volume:sweep_to(params.output, options)
  assert(mesh.streamed, "the mesh was held in memory")
  stages, swept, least = mesh.seconds, os.clock(), mesh.min_scaled_jacobian
  mean = tonumber(tostring(mesh):match("at least, ([%d.]+) on average"))
else
  mesh = volume:sweep(options)
  stages, swept = mesh.report.seconds, os.clock()
  if params.output ~= "" then mesh:write(params.output) end
end
local written = os.clock()
if not params.stream then
  local quality = mesh:quality()
  least, mean = quality.min_scaled_jacobian, quality.mean_scaled_jacobian
end

print(encoded {
  shape = params.shape, class = volume.class, commit = params.commit, version = lacuna.version,
  hexes = mesh.hexes, layers = mesh.layers, threads = params.threads,
  processor_seconds = { close = closed - start, sweep = swept - closed, write = written - swept,
    total = written - start },
  stage_seconds = stages, hexes_per_second = mesh.hexes / (written - start),
  peak_mib = peak_mib(),
  min_scaled_jacobian = least, mean_scaled_jacobian = mean,
})
