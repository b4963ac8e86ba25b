-- SPDX-License-Identifier: MIT
-- Runs recipes as they are and draws what they close and mesh. Called by scripts/gallery, in a folder that is
-- thrown away.
local lacuna = require "lacuna"
local params = lacuna.params { root = ".", only = "" }

local wanted, all = {}, true
for name in params.only:gmatch("%S+") do wanted[name], all = true, false end

-- What a recipe closed, as it was before and after, and what it wrote. The methods of the classes are called
-- through here while it runs.
local prism = lacuna.synthetic.prism()
local volume = prism:open_volume { source = "source", target = "target", walls = "auto" }
local methods = {
  Volume = debug.getmetatable(volume).methods,
  Mesh = debug.getmetatable(volume:sweep { layers = 1, size = 1 }).methods,
  AssemblyMesh = debug.getmetatable(lacuna.assembly({ volume }):sweep { layers = 1, size = 1 }).methods,
}
local made
local function watch(class, name, note)
  local real = methods[class][name]
  methods[class][name] = function(object, ...)
    note(object)
    return real(object, ...)
  end
end
local function open_picture(object)
  if made.open then object:picture(made.open.path, made.open.options) end
  made.volume = object
end
watch("Volume", "close", open_picture)
for _, class in ipairs { "Mesh", "AssemblyMesh" } do
  watch(class, "write", function(object) made.mesh = object end)
end

-- A picture: of the volume while it is open ("open"), of the sealed one ("volume") or of the mesh.
local function picture(of, name, options)
  options = options or {}
  options.width, options.height = options.width or 600, options.height or 450
  if of == "mesh" then
    options.colour = options.colour or "origin"
  end
  return { of = of, name = name, options = options, path = params.root .. "/docs/gallery/" .. name .. ".png" }
end

local function recipe(name, pictures)
  local some = all
  made = {}
  for _, p in ipairs(pictures) do
    some = some or wanted[p.name]
    if p.of == "open" then made.open = p end
  end
  if not some then return end
  arg = { [0] = name, "output=" .. name .. ".msh" }
  local print_all = print
  print = function() end
  dofile(params.root .. "/scripts/recipes/" .. name .. ".lua")
  print = print_all
  for _, p in ipairs(pictures) do
    if p.of ~= "open" then made[p.of]:picture(p.path, p.options) end
    print(p.name)
  end
end

local low = { 0.8, -1.2, 0.75 }
recipe("fig_6", { picture("open", "fig_6a"), picture("mesh", "fig_6b") })
recipe("fig_8", {
  picture("open", "fig_8a", { view = { 0.5, -1, 0.7 } }),
  picture("volume", "fig_8b", { view = "top", facets = true }),
  picture("volume", "fig_8c", { view = { 0.5, -1, 0.7 }, facets = true }),
  picture("mesh", "fig_8d", { view = { 0.5, -1, 0.7 } }),
})
recipe("fig_9", { picture("mesh", "fig_9") })
recipe("class_1", { picture("mesh", "fig_10a") })
recipe("class_2", { picture("mesh", "fig_10b", { view = { -1, 1.6, 0.9 } }) })
recipe("class_3", { picture("mesh", "fig_10c") })
recipe("class_4", {
  picture("mesh", "fig_10d", { cut = { point = { 0, 0, 0 }, normal = { 0.5, -0.866, 0 } } }),
})
recipe("class_5", { picture("mesh", "fig_10e") })
recipe("first_void", {
  picture("mesh", "first_void"),
  picture("mesh", "first_void_inside", { cut = { point = { 0, 40, 0 }, normal = { 0, -1, 0 } }, view = low }),
})
recipe("packed_box", { picture("mesh", "packed_box_inside",
    { cut = { point = { 0, 39, 0 }, normal = { 0, -1, 0 } }, colour = "region", view = low }) })
recipe("resin", { picture("mesh", "resin_inside",
    { cut = { point = { 0, 1, 0 }, normal = { 0, -1, 0 } }, colour = "region", view = low }) })
recipe("tee", { picture("mesh", "tee_inside",
    { cut = { point = { 0, 0, 0 }, normal = { 0, -1, 0 } }, colour = "region", view = low }) })
recipe("stepped_pin", { picture("mesh", "stepped_pin_inside",
    { cut = { point = { 0, 0, 0 }, normal = { 0, -1, 0 } }, colour = "region", view = low }) })
recipe("bottle", { picture("mesh", "bottle_inside",
    { cut = { point = { 0, 40, 0 }, normal = { 0, -1, 0 } }, colour = "region", view = low }) })
recipe("both_sides", { picture("mesh", "both_sides", { colour = "region", view = low }) })
recipe("boundary_layers", { picture("mesh", "boundary_layers", { view = { 0.3, -0.8, 1.2 } }) })
recipe("bracket", { picture("mesh", "bracket", { colour = "region" }) })
recipe("crossing_bores", { picture("mesh", "crossing_bores") })
recipe("pipe_bend", { picture("mesh", "pipe_bend", { view = { 0.7, -1, 0.6 } }) })
recipe("twisted_rod", { picture("mesh", "twisted_rod") })
recipe("cell_stack", { picture("mesh", "cell_stack", { colour = "region", view = low }) })
recipe("foam", { picture("mesh", "foam",
    { cut = { point = { 0, 45, 0 }, normal = { 0, -1, 0 } }, view = low }) })
