-- SPDX-License-Identifier: MIT
-- volume:sweep_to: the bytes of sweep and write, for every class and format, in memory that hardly grows
-- with the layers. usage: lacuna sweep_to.lua lacuna=PROGRAM scratch=FOLDER [cells=1e8]: measured there
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"

local params = lacuna.params { lacuna = "lacuna", scratch = ".", cells = 0 }
local function path(name) return params.scratch .. "/" .. name end

local function bytes(name)
  local file <close> = assert(io.open(path(name), "rb"))
  return file:read("a")
end

local formats = {
  { "msh" }, { "msh", { binary = false } }, { "msh", { version = 2.2 } },
  { "msh", { version = 2.2, binary = false, quality = true } }, { "msh", { quality = false } },
  { "msh", { quality = { "shape", "volume" } } },
  { "vtu" }, { "vtk" }, { "vtk", { binary = false, quality = "skew" } },
  { "inp" }, { "bdf" }, { "unv" }, { "exo" }, { "msh", { partitions = 3, ghosts = 1 } },
  { "msh", { partitions = 2, binary = false } },
}

-- Sweep one volume both ways and compare the bytes; the volume is made anew for each file of layers.
local function same(what, make, options, only)
  local whole = make():sweep(options)
  for i, format in ipairs(only or formats) do
    local ending, write = format[1], format[2]
    whole:write(path("whole." .. ending), write)
    local all = {}
    for key, value in pairs(options) do all[key] = value end
    all.write, all.threads = write, 1 + i % 3
    local report = make():sweep_to(path("layered." .. ending), all)
    check.that(bytes("whole." .. ending) == bytes("layered." .. ending), what .. ", format " .. i)
    check.equal(report.hexes, whole.hexes, what)
    check.equal(report.nodes, whole.nodes, what)
    check.equal(report.layers, whole.layers, what)
    check.that(#report >= #whole.report and tostring(report):find("all certified", 1, true), what)
    if options.streamed == nil then check.that(report.streamed, what .. ": was held in memory") end
  end
end

local function open(shape, options)
  return function() return lacuna.synthetic[shape](options):open_volume {} end
end
local function drop(...) return { sides = 6, twist = 20, drop = { ... } } end

-- --- every class

local classes = {
  closed = drop(), I = drop("walls"), II = drop("wall_1", "wall_2", "wall_3"), III = drop("wall_2"),
  IV = drop("target"), V = drop("source", "target"),
}
for name, options in pairs(classes) do
  local make = open("prism", options)
  check.equal(make().class, name)
  same("class " .. name, make, { layers = 7, size = 0.2 })
end

-- --- decks: the volume's name and material, wedges

local decks = { { "inp" }, { "nas" }, { "dat" }, { "unv" }, { "exo" } }
local function named()
  return lacuna.synthetic.prism(drop()):open_volume { name = "bar 1", material = "steel" }
end
same("a name and a material", named, { layers = 5, size = 0.2 }, decks)

-- --- placements: affine, fitted, straight; holes; what comes with heights of its own

local few = { { "msh" }, { "vtu" }, { "inp" }, { "exo" } }
same("holes", open("prism", { holes = 2, sides = 8 }), { layers = 5, size = 0.1 }, few)
same("a taper", open("prism", { taper = 0.6, twist = 30 }), { layers = { 0.1, 0.3, 1 }, size = 0.2 }, few)
same("an elbow", open("elbow", { angle = 90 }), { layers = 20, size = 0.2 }, few)
same("one layer", open("plate", {}), { layers = 1, size = 0.2 }, few)

-- --- more layers than are made at once

local function block(bend)
  return open("prism", { sides = 4, height = 3, bend = bend })
end
same("layers in several parts", block(0), { layers = 60, size = 0.013 }, check.whole and few or { { "msh" } })

-- --- metrics that compare each cell with the mean of all, which is known once all layers were made

local relative = { { "msh", { quality = { "relative_size_squared", "shape_and_size" } } },
  { "vtu", { quality = "shear_and_size" } } }
if check.whole then same("bent layers in several parts", block(40), { layers = 60, size = 0.013 }, few) end
same("a mean over several parts", block(40), { layers = 60, size = 0.013 }, check.whole and relative
  or { relative[2] })
same("a mean over layers of different heights", open("prism", { taper = 0.6, twist = 30 }),
  { layers = { 0.1, 0.3, 1 }, size = 0.2 }, relative)

-- --- order 2: cells of 27 nodes, which decks have not, and of 20; paved and mapped, straight and bent

local curved = {}
for _, format in ipairs(formats) do
  local ending = format[1]
  if ending ~= "inp" and ending ~= "bdf" and ending ~= "unv" then curved[#curved + 1] = format end
end
for name, options in pairs(classes) do
  same("order 2, class " .. name, open("prism", options),
    { layers = 7, size = 0.25, order = 2, serendipity = true }, name ~= "closed" and few or nil)
  same("order 2, hex27, class " .. name, open("prism", options), { layers = 6, size = 0.3, order = 2 },
    name ~= "III" and { { "msh" } } or curved)
end
for _, serendipity in ipairs { false, true } do
  local function same_curved(what, make, options)
    options.order, options.serendipity = 2, serendipity
    same("order 2, " .. what, make, options, { { "msh" }, { "vtu" } })
  end
  same_curved("holes", open("prism", { holes = 2, sides = 8 }), { layers = 5, size = 0.15 })
  same_curved("a taper", open("prism", { taper = 0.6, twist = 30 }), { layers = { 0.1, 0.3, 1 }, size = 0.2 })
  same_curved("an elbow", open("elbow", { angle = 90 }), { layers = 20, size = 0.2 })
  same_curved("one layer", open("plate", {}), { layers = 1, size = 0.2 })
  same_curved("layers in several parts", block(40), { layers = 30, size = 0.04 })
end
do
  local make, options = open("prism", drop()), { layers = 6, size = 0.3, order = 2 }
  local write = { partitions = 2, ghosts = 1 }
  local held = {}
  make():sweep(options):write(path("curved.pvtu"), write)
  for _, name in ipairs { "curved.pvtu", "curved_0.vtu", "curved_1.vtu" } do held[name] = bytes(name) end
  options.write = write
  check.that(make():sweep_to(path("curved.pvtu"), options).streamed)
  for name, whole in pairs(held) do check.that(bytes(name) == whole, name) end
end

-- --- what is not layers as they are placed is held in memory, and the report says so

do
  local options = { layers = 4, size = 0.3, boundary_layers = { walls = "walls", first = 0.02, count = 2 } }
  open("prism", drop())():sweep(options):write(path("whole.msh"))
  local report = open("prism", drop())():sweep_to(path("rows.msh"), options)
  check.equal(report.streamed, false)
  check.that(tostring(report):find("held in memory", 1, true))
  check.that(bytes("whole.msh") == bytes("rows.msh"), "boundary layers")
end

-- --- volumes in pieces, and several volumes

local part_formats = {
  { "msh" }, { "msh", { binary = false } }, { "msh", { version = 2.2 } },
  { "msh", { version = 2.2, binary = false } }, { "vtu" }, { "vtk" }, { "vtk", { binary = false } },
  { "inp" }, { "bdf" }, { "unv" }, { "exo", nil, "held" }, { "msh", { partitions = 2 }, "held" },
  { "msh", { interfaces = true }, "held" },
}

-- Sweep several volumes both ways; all is streamed but where the format has it held, or `held` says so.
local function same_parts(what, make, options, held)
  local whole = make():sweep(options)
  for i, format in ipairs(part_formats) do
    local ending, write = format[1], format[2]
    whole:write(path("whole." .. ending), write)
    local all = { write = write }
    for key, value in pairs(options) do all[key] = value end
    local report = make():sweep_to(path("pieces." .. ending), all)
    check.that(bytes("whole." .. ending) == bytes("pieces." .. ending), what .. ", format " .. i)
    check.equal(report.hexes, whole.hexes, what)
    check.equal(report.nodes, whole.nodes, what)
    local is_held = held or format[3] ~= nil
    check.equal(report.streamed, not is_held, what .. ", format " .. i)
    check.equal(tostring(report):find("were held in memory", 1, true) ~= nil, is_held)
    check.equal(#report, #whole.report + (is_held and 1 or 0), what)
    if not is_held then check.equal(table.concat(report, "\n"), table.concat(whole.report, "\n")) end
  end
end

do
  local function of(options, name)
    return lacuna.synthetic.prism(options):open_volume { source = "source", target = "target",
      walls = "auto", name = name }
  end
  -- A core in a ring that lacks the wall between them: straight, twisted, tapered, with a core that came
  -- with no wall either, and one whose members are not all streamed.
  local function core_and_ring(shape, more)
    return function()
      local own, round = { sides = 6, height = 2 }, { sides = 6, radius = 2, height = 2, holes = 1,
        hole_radius = 1, drop = { "wall_2" } }
      for key, value in pairs(shape) do own[key], round[key] = value, value end
      local core, ring = of(own, "core"), of(round, "ring")
      local assembly = lacuna.assembly { core, ring }
      if not more then return assembly end
      local function own_options(options)
        local all = { [core] = more }
        for key, value in pairs(options) do all[key] = value end
        return all
      end
      return {
        sweep = function(_, options) return assembly:sweep(own_options(options)) end,
        sweep_to = function(_, to, options) return assembly:sweep_to(to, own_options(options)) end,
      }
    end
  end
  same_parts("core and ring", core_and_ring {}, { size = 0.4, layers = 6 })
  same_parts("twisted", core_and_ring { twist = 20 }, { size = 0.4, layers = 7 })
  same_parts("tapered", core_and_ring { taper = 0.7 }, { size = 0.4 })
  same_parts("cells that are moved", core_and_ring { taper = 0.7, twist = 15 }, { size = 0.4 }, true)
  same_parts("a core with rows at its ends", core_and_ring({},
    { boundary_layers = { walls = "source", first = 0.05, count = 2 } }), { size = 0.4 }, true)
end

do
  -- A stair of two steps.
  local function stair()
    local model = lacuna.model()
    local function face(name, ...)
      local points, cell = { ... }, {}
      for i = 1, #points do cell[i] = i end
      local cells = { cell }
      if #points == 6 then cells = { { 1, 2, 5, 6 }, { 2, 3, 4, 5 } } end
      model:add_face { name = name, points = points, cells = cells }
    end
    face("bottom", { 0, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 2, 1, 0 }, { 2, 0, 0 }, { 1, 0, 0 })
    face("low", { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 })
    face("high", { 1, 0, 2 }, { 2, 0, 2 }, { 2, 1, 2 }, { 1, 1, 2 })
    face("riser", { 1, 0, 1 }, { 1, 0, 2 }, { 1, 1, 2 }, { 1, 1, 1 })
    face("left", { 0, 0, 0 }, { 0, 0, 1 }, { 0, 1, 1 }, { 0, 1, 0 })
    face("right", { 2, 0, 0 }, { 2, 1, 0 }, { 2, 1, 2 }, { 2, 0, 2 })
    for y = 0, 1 do
      local function at(x, z) return { x, y, z } end
      model:add_face { name = "side" .. y, points = { at(0, 0), at(1, 0), at(2, 0), at(2, 2), at(1, 2),
        at(1, 1), at(0, 1) }, cells = { { 1, 2, 6, 7 }, { 2, 3, 4 }, { 2, 4, 6 }, { 4, 5, 6 } } }
    end
    return model:open_volume { source = "bottom", target = { "low", "high" },
      walls = { "left", "right", "riser", "side0", "side1" } }
  end
  same_parts("a stair", stair, { size = 0.25 })
  same_parts("a stair of order 2", stair, { size = 0.5, order = 2, serendipity = true }, true)
  local own = stair():sweep_to(path("pieces.pvtu"), { size = 0.25, write = { partitions = 2 } })
  check.that(own.hexes > 0 and #bytes("pieces_1.vtu") > 0)
  stair():sweep_to(path("shown.msh"), { size = 0.25, write = { gmsh_options = true } })
  open("prism", drop())():sweep_to(path("one.msh"), { layers = 4, write = { gmsh_options = true } })
  check.that(bytes("shown.msh.opt") == bytes("one.msh.opt") and #bytes("one.msh.opt") > 0, "options beside")
end

-- --- what is refused is refused before anything is made, and leaves no file

local void = open("prism", drop())()
local function refused(name, options, ...)
  check.fails(function() void:sweep_to(path(name), options) end, ...)
  check.that(not io.open(path(name), "rb"), name .. " is there")
end
refused("no.txt", { layers = 4 }, ".exo .e")
refused("no.msh", { layers = 4, write = { partitions = 5 } }, "layers is 4")
refused("no.pvtu", { layers = 4, write = { partitions = 0 } }, "partitions")
refused("no.msh", { layers = 4, write = { partitions = 2, version = 2.2 } }, "4.1")
refused("no.msh", { layers = 4, write = { ghosts = 1 } }, "ghosts", "partitions")
refused("no.vtu", { layers = 4, write = { partitions = 2 } }, "partitions")
refused("no.vtu", { layers = 4, write = { gmsh_options = true } }, "gmsh_options")
refused("no.msh", { layers = 4, write = { interfaces = true } }, "interfaces", "one volume")
refused("no.inp", { layers = 4, write = { quality = "shape" } }, "quality")
refused("no.msh", { layers = 4, write = { with = 1 } }, "write", "with")
refused("no.msh", { layers = 4, write = 3 }, "write", "a table of options")
refused("no.vtu", { layers = 4, write = { version = 2.2 } }, "version")
refused("no.msh", { layres = 4 }, "layres", "layers")
refused("no.msh", { layers = 4, min_scaled_jacobian = 0.999999 }, "below the limit")
local alone = lacuna.assembly { void }
check.fails(function() alone:sweep_to(path("no.msh"), { [3] = 4 }) end, "sweep_to: the keys")

-- --- memory

local recipe = path("memory.lua")
do
  local file <close> = assert(io.open(recipe, "w"))
  file:write([[
local lacuna = require "lacuna"
local p = lacuna.params { layers = 100, size = 0.01, order = 1, output = "" }
local void = lacuna.synthetic.prism { sides = 4, drop = { "wall_1" } }:open_volume {}
local report = void:sweep_to(p.output, { layers = p.layers, size = p.size, order = p.order,
  write = { quality = false } })
assert(report.streamed)
for line in io.lines("/proc/self/status") do
  local kilobytes = line:match("^VmHWM:%s*(%d+)")
  if kilobytes then print(report.hexes, kilobytes) end
end
]])
end
local function peak(layers, size, order)
  local words = ("%s %s layers=%d size=%.9g order=%d output=%s"):format(params.lacuna, recipe, layers, size,
    order or 1, path("memory.msh"))
  local run = assert(io.popen(words))
  local hexes, kilobytes = run:read("a"):match("(%d+)%s+(%d+)")
  run:close()
  os.remove(path("memory.msh"))
  return tonumber(hexes), tonumber(kilobytes) * 1024
end
if io.open("/proc/self/status") then
  local few_cells, low = peak(60, 0.01)
  local many_cells, high = peak(240, 0.01)
  check.equal(many_cells, 4 * few_cells)
  -- Rims and the skin's quads grow with the layers: well below the 24 bytes a cell of the nodes alone.
  check.that(high - low < 6 * (many_cells - few_cells),
    ("%d cells took %d bytes, %d took %d"):format(few_cells, low, many_cells, high))
  -- Of order 2 a cell has eight nodes of its own: 192 bytes.
  few_cells, low = peak(60, 0.02, 2)
  many_cells, high = peak(240, 0.02, 2)
  check.that(high - low < 48 * (many_cells - few_cells),
    ("%d cells of order 2 took %d bytes, %d took %d"):format(few_cells, low, many_cells, high))
  if params.cells > 0 then
    local across = (params.cells / 1000) ^ 0.5
    local cells, most = peak(1000, 2 ^ 0.5 / across)
    print(("%d cells: %d MB at most"):format(cells, most // 1e6))
    check.that(most <= 300e6, "more than 300 MB")
  end
end
check.done()
