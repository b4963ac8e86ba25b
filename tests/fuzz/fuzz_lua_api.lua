-- SPDX-License-Identifier: MIT
-- Calls everything `lacuna` registers in random order with generated arguments. Run by fuzz_lua_api.cpp,
-- which hands over the module, the classes by name, what is bounded in C++, and the seed.
local lacuna, classes, host, seed = ...

local random, pick = math.random, nil
math.randomseed(seed)
function pick(list) return list[random(#list)] end
local function chance(p) return random() < p end

-- --- objects in every state -----------------------------------------------------------------

local kMostObjects = 12 -- of a class, so that memory stays flat and states are met again
local pool = { Model = {}, Face = {}, Volume = {}, Mesh = {}, Quality = {} }

local function class_of(value)
  if type(value) ~= "userdata" and type(value) ~= "table" then return nil end
  local ok, meta = pcall(debug.getmetatable, value)
  return ok and meta and classes[meta] or nil
end

local function keep(value)
  local class = class_of(value)
  if class then
    local list = pool[class]
    if #list < kMostObjects then list[#list + 1] = value else list[random(kMostObjects)] = value end
  elseif type(value) == "table" and class_of(rawget(value, 1)) then
    for i = 1, math.min(3, #value) do keep(value[i]) end
  end
  return value
end

local function any_of(class) return #pool[class] > 0 and pick(pool[class]) or nil end
local function forget(class, object)
  local list = pool[class] or {}
  for i = #list, 1, -1 do
    if rawequal(list[i], object) then table.remove(list, i) end
  end
end
local function any_object() return any_of(pick { "Model", "Face", "Volume", "Mesh", "Quality" }) end

local function release(object) -- as the end of a <close> variable
  local meta = debug.getmetatable(object)
  if meta and rawget(meta, "__close") then
    local c <close> = object
  end
end

-- --- values -----------------------------------------------------------------

local numbers = { 0, -0.0, 1, 2, 3, 4, 7, -1, -3, 0.5, 0.1, 1e-9, 1e-300, 5e-324, 1e9, 1e308, -1e308, 1 / 0,
  -1 / 0, 0 / 0, 2 ^ 31, 2147483647, -2147483648, 2 ^ 53, math.maxinteger, math.mininteger, 100000 }
local words = { "", "source", "target", "walls", "wall_1", "wall_2", "auto", "x", "a\0b", "\255\254", "%s%n",
  "0x10", "7", "nan", ("long"):rep(300), "I", "closed", "true", "layers", "a\nb", "pid:7" }

local value, options, act
local function odd_table(depth)
  local kind = random(9)
  if kind == 1 then return {} end
  if kind == 2 then
    local t = {}
    t.t = t
    t[1] = t
    return t
  elseif kind == 3 then
    local t = { value(depth + 1) }
    for _ = 1, 300 do t = { t } end
    return t
  elseif kind == 4 then
    local t = {}
    for i = 1, random(5) do t[i] = value(depth + 1) end
    return t
  elseif kind == 5 then return { [value(depth + 1) or 1] = 1, [0] = 2 } end
  if kind == 6 then return { 0, 0, pick(numbers) } end
  return setmetatable(chance(0.5) and { value(depth + 1) } or {}, {
    __index = function(_, key) return act(value, key) end,
    __len = function() return act(function() return pick(numbers) end) end,
    __pairs = function() return act(function() return next, {}, nil end) end,
    __call = function() return act(value) end,
    __name = pick(words),
    __tostring = function() return act(function() return value(depth + 1) end) end,
    __eq = function() return act(function() return true end) end,
    __close = function() act() end,
  })
end

function value(depth)
  depth = type(depth) == "number" and depth or 0
  local kind = random(depth > 3 and 5 or 11)
  if kind == 1 then return nil end
  if kind <= 3 then return pick(numbers) end
  if kind == 4 then return pick(words) end
  if kind == 5 then return chance(0.5) end
  if kind == 6 then return function(...) return act(value, ...) end end
  if kind == 7 then return any_object() end
  if kind == 8 then return pick { coroutine.create(function() end), io.stdout, print, host.light } end
  if kind == 9 then return options(pick { "sweep", "match", "open_volume", "write" }) end
  return odd_table(depth)
end

-- --- callbacks that misbehave -----------------------------------------------------------------

local depth = 0
-- Does something it should not while the binding works, then returns what `result` makes.
function act(result, ...)
  local kind = random(14)
  if kind == 1 then error(pick { "raised", { "raised" }, 7 }, random(0, 2)) end
  if kind == 2 then pcall(coroutine.yield, 1) end
  if kind == 3 then coroutine.yield(1) end
  if kind == 4 then collectgarbage() end
  if kind == 5 then
    local object = any_object()
    if object then release(object) end
  end
  if kind == 6 then
    local list = pool[pick { "Model", "Volume", "Mesh", "Face", "Quality" }]
    for i = #list, 1, -1 do list[i] = nil end
    collectgarbage()
  end
  if kind == 7 and depth < 3 then
    depth = depth + 1
    local volume = any_of("Volume")
    if volume then
      host.count()
      pcall(function() keep(volume:sweep(options("sweep"))) end)
    end
    depth = depth - 1
  end
  if kind == 8 and depth < 3 then
    depth = depth + 1
    pcall(host.step, true)
    depth = depth - 1
  end
  if kind == 9 then
    local model = any_of("Model")
    if model then pcall(function() model:add_face(options("add_face")) end) end
  end
  if kind == 10 then return select(random(3), nil, value(3), {}) end
  if kind == 11 then
    local volume = any_of("Volume")
    if volume then
      pcall(function()
        volume[pick { "close", "match" }](volume)
        volume:override_class(pick { "I", "II", "III", "IV", "V", "closed" })
      end)
    end
  end
  if result then return result(...) end
end

local function size_function()
  local calls, from, size = 0, random(1, 40), pick { 0.2, 0.3, 0.5, 1 }
  return function(x)
    calls = calls + 1
    if calls == from then return act(function() return size end) end
    return size + 0.1 * math.sin(x)
  end
end

-- Garbage whose finalizers do the same while a binding allocates. No hook stops a finalizer: only short work.
local function litter()
  for _ = 1, random(4) do
    setmetatable({}, { __gc = function()
      local volume, model, mesh = any_of("Volume"), any_of("Model"), any_of("Mesh")
      local kind = random(6)
      if kind == 1 and volume then release(volume) end
      if kind == 2 and volume then pcall(volume.close, volume) end
      if kind == 3 and volume then pcall(volume.override_class, volume, pick { "I", "III", "V" }) end
      if kind == 4 and model then
        pcall(model.add_face, model,
            { points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, cells = { { 1, 2, 3 } } })
        pcall(model.faces, model)
      end
      if kind == 5 and mesh then release(mesh) end
      if kind == 6 and model then release(model) end
    end })
  end
end

-- --- arguments -----------------------------------------------------------------

local files = { "a.msh", "b.msh", "a.stl", "b.obj", "c.vtk", "c.vtu", "d.inp", "sub/a.msh", "none/a.msh",
    "a.html",
  "", "a", ".msh", "a\0.msh", "b.unv", "b.bdf", ("n"):rep(300) .. ".msh" }
local function path() return pick(files) end
local function list_of(make, most)
  local list = {}
  for i = 1, random(0, most or 3) do list[i] = make() end
  return list
end
local function face_ref()
  return pick { function() return any_of("Face") end, function() return random(0, 8) end,
    function() return pick { "source", "target", "wall_1", "wall_2", "wall_3" } end,
    function() return options("faces") end }()
end
local function face_refs() return chance(0.6) and face_ref() or list_of(face_ref) end
local function vector() return { random(-2, 2), random(-2, 2), random(-2, 2) } end
local function small() return random(1, 5) end
local function length() return pick { 0.2, 0.3, 0.5, 1, 3 } end
local function flag() return chance(0.5) end
local function pair() return { random(0, 12), random(0, 12) } end
local function drop()
  return pick { "target", "source", "walls", "wall_1", { "target", "wall_1" }, { "wall_2" }, {} }
end
local function facets() return random(1, 3) end
local function metric()
  return pick { "scaled_jacobian", "shape", "volume", "oddy", "distortion", "edge_ratio", "none" }
end

-- What each call takes: key -> a maker of values that may be right.
local keys = {
  load = { tolerance = length, feature_angle = function() return random(0, 180) end, keep_mesh = flag,
      scale = length },
  faces = { tags = function() return chance(0.5) and random(8) or list_of(small) end,
    name = function() return pick(words) end,
        kind = function() return pick { "plane", "discrete", "torus" } end,
    facing = vector, near = vector, area = function() return { 0, pick(numbers) } end },
  add_face = { name = function() return pick(words) end,
    points = function() return list_of(vector, 6) end, keep_mesh = flag,
    cells = function() return list_of(function() return list_of(small, 5) end, 4) end },
  open_volume = { source = face_refs, target = face_refs, faces = face_refs,
    walls = function() return chance(0.6) and "auto" or face_refs() end,
    class = function() return pick { "I", "II", "III", "IV", "V", "closed" } end,
    name = function() return pick(words) end,
    material = function() return pick { 1, "steel", "a,b", 0 } end },
  face_from = { near = vector, angle = function() return pick { 5, 20, 90, 180, 200 } end, free = flag,
    region = function() return pick(words) end },
  match = { vertices = function() return list_of(pair) end, loops = function() return list_of(pair) end,
    flip = function() return list_of(small) end,
        method = function() return pick { "aligned", "nearest" } end },
  close = { edge_shape = function() return pick { "auto", "straight", "follow", "smooth" } end,
    cap = function() return pick { "auto", "flat", "parallel" } end,
    void_edges = function()
      return list_of(function()
        return { small(), small(), chance(0.5) and list_of(vector) or nil }
      end)
    end },
  sweep = { layers = function()
      return pick { 2, 3, { 0.3, 1 }, { 0.5, 0.2 }, { count = 3, bias = 2, mode = "bell" }, { count = 2 }, 1 }
    end,
    size = function() return chance(0.4) and size_function() or length() end,
    quads = function() return pick { "auto", "paved", "mapped", "gmsh", "keep" } end,
    curvature = function() return pick { 0, 8, 12, 40, -1 } end, gap = small, max_deviation = length,
    rows = small, row_height = function() return chance(0.5) and size_function() or length() end,
    order = function() return random(1, 2) end, serendipity = flag,
    min_scaled_jacobian = function() return pick { -1, 0, 0.5, 2 } end,
    improve = function() return pick { true, false, { iterations = 3 }, { seconds = 0.01 } } end,
    threads = function() return pick { 1, 2, 4, 100000 } end },
  write = { version = function() return pick { 4.1, 2.2 } end, binary = flag,
    quality = function() return pick { true, false, metric(), list_of(metric) } end, renumber = flag,
    first_node = small, first_cell = small, gmsh_options = flag },
  write_facets = { binary = flag },
  view = { title = function() return pick(words) end,
    show = function() return pick { "auto", "faces", "cells" } end },
  picture = { width = function() return random(1, 90) end, height = function() return random(1, 90) end,
    view = function() return chance(0.5) and pick { "iso", "top", "left" } or vector() end,
    colour = function() return pick { "quality", "layer", "groups", "region", "origin" } end,
    cut = function() return { point = vector(), normal = vector() } end,
    layers = function() return { random(0, 3), random(0, 5) } end, edges = flag, legend = flag },
  write_cad = { tolerance = length, deviation = length },
  prism = { sides = function() return random(3, 6) end, radius = length, height = length,
    holes = function() return random(0, 2) end, hole_radius = function() return 0.1 end, twist = length,
    taper = length, bend = length, facets = facets, drop = drop },
  annulus = { inner = length, outer = length, height = length, facets = facets, drop = drop },
  elbow = { radius = length, inner = length, bend_radius = length, angle = length, facets = facets,
      drop = drop },
  barrel = { radius = length, height = length, bulge = length, facets = facets, drop = drop },
  plate = { length = length, width = length, height = length, holes = function() return random(0, 2) end,
    hole_radius = function() return 0.1 end, facets = facets, drop = drop },
}
keys.sweep_to, keys.face = keys.sweep, keys.faces

-- How likely a key is given, and given wrongly: most calls should reach the kernel.
local kGiven, kWrong = 0.35, 0.04
function options(name)
  local known, made = keys[name], {}
  if not known then return value() end
  local order = {}
  for key in pairs(known) do order[#order + 1] = key end
  table.sort(order)
  local needed = { points = true, cells = true, layers = true, facets = true, drop = true }
  needed.near = name == "face_from"
  for _, key in ipairs(order) do
    if chance(needed[key] and 0.9 or kGiven) then
      local made_value
      if chance(kWrong) then made_value = value(1) else made_value = known[key]() end
      made[key] = made_value
    end
  end
  if chance(0.02) then made[pick(words)] = value(1) end
  if chance(0.02) then
    made = setmetatable({}, { __index = made, __pairs = function() return act(pairs, made) end })
  end
  return made
end

-- Arguments after the object, for the call of that name.
local right = {
  load = function() return chance(0.8) and path() or list_of(path),
      chance(0.3) and options("load") or nil end,
  check = path,
  params = function() return { width = 1, name = "x", flag = true, sub = odd_table(2) } end,
  model = function() end,
  gmsh_version = function() end,
  face = face_ref,
  faces = function() if chance(0.5) then return options("faces") end end,
  open_volume = function()
    if chance(0.5) then return nil end
    if chance(0.5) then return { source = "source", target = "target", walls = "auto" } end
    return options("open_volume")
  end,
  override_class = function() return pick { "I", "II", "III", "IV", "V", "closed" } end,
  match = function() if chance(0.5) then return options("match") end end,
  close = function() if chance(0.5) then return options("close") end end,
  write = function() return path(), chance(0.5) and options("write") or nil end,
  write_facets = function() return path(), chance(0.5) and options("write_facets") or nil end,
  write_cad = function() return pick { "a.stp.txt", "a", "", "a.msh" }, options("write_cad") end,
  sweep_to = function() return path(), options("sweep") end,
  view = function()
    if chance(0.5) then return "a.html", chance(0.5) and options("view") or nil end
    return path(), pick { "b.html", "b.png", "" }, chance(0.5) and options("view") or nil
  end,
  picture = function()
    local small_one = options("picture") -- large ones take time
    for _, key in ipairs { "width", "height" } do rawset(small_one, key, rawget(small_one, key) or 40) end
    return pick { "a.png", "a.html" }, small_one
  end,
  node = function() return random(0, 60) end,
  hex = function() return random(0, 30) end,
}

local function arguments(name)
  if chance(0.08) then return table.pack(value(), value(), value()) end
  if right[name] then return table.pack(right[name]()) end
  return table.pack(options(name))
end

-- --- what there is to call -----------------------------------------------------------------

local targets, names = {}, {}
local function target(name, class, call, short)
  targets[#targets + 1] = { name = name, class = class, call = call, short = short, reached = 0,
      returned = 0 }
end
local function sorted(t)
  local list = {}
  for key in pairs(t) do list[#list + 1] = key end
  table.sort(list)
  return list
end
for _, key in ipairs(sorted(lacuna)) do
  if type(lacuna[key]) == "function" then target("lacuna." .. key, nil, lacuna[key], key) end
end
for _, key in ipairs(sorted(lacuna.synthetic)) do
  target("synthetic." .. key, nil, lacuna.synthetic[key], key)
end
for meta, class in pairs(classes) do names[class] = meta end
for _, class in ipairs(sorted(names)) do
  local meta = names[class]
  for _, key in ipairs(sorted(meta)) do
    if type(meta[key]) == "function" then target(class .. "." .. key, class, meta[key], key) end
  end
  for _, key in ipairs(sorted(meta.methods or {})) do
    target(class .. ":" .. key, class, meta.methods[key], key)
  end
  local _, fields = debug.getupvalue(meta.__index, 3)
  for _, key in ipairs(sorted(fields or {})) do
    target(class .. "." .. key, class, function(object) return object[key] end, key)
  end
end
target("Quality.metrics", "Quality", function(object) return object.metrics end, "metrics")
target("lacuna.gmsh_version", nil, function() return lacuna.gmsh_version end, "gmsh_version")

local heavy = { __gc = true, __close = true } -- release objects: seldom, or none would live

-- --- a step -----------------------------------------------------------------

local function makes_fault(message)
  if type(message) ~= "string" then return false end
  for _, sign in ipairs { "vector::", "basic_string", "unknown error inside", "std::", "map::at", "bad_",
      "deque::" } do
    if message:find(sign, 1, true) then return true end
  end
  return depth == 0 and message:find("[lua.busy]", 1, true) and true or false
end

function host.step(nested)
  local t = pick(targets)
  if heavy[t.short] and chance(0.8) then return end
  local made = arguments(t.short)
  local object
  if t.class then
    object = any_of(t.class)
    if chance(0.03) then object = value() end
    if t.class == "Mesh" and not object then return end
    table.insert(made, 1, object)
    made[1], made.n = object, made.n + 1
  end
  -- Only what the pool holds may be finalized by hand: another class's finalizer is no binding's to be called
  -- with, and Lua code of a recipe reaches none (`__metatable`).
  if heavy[t.short] and class_of(object) ~= t.class then return end
  t.reached = t.reached + 1
  if chance(0.1) then litter() end
  local call = t.call
  if chance(0.05) then
    call = function(...) return select(2, coroutine.resume(coroutine.create(t.call), ...)) end
  end
  local results
  if nested then
    host.count()
    results = table.pack(pcall(call, table.unpack(made, 1, made.n)))
  else
    results = table.pack(host.call(t.name, call, table.unpack(made, 1, made.n)))
  end
  if results[1] then
    t.returned = t.returned + 1
    for i = 2, results.n do keep(results[i]) end
  elseif makes_fault(results[2]) then
    host.fault(t.name .. ": " .. results[2])
  elseif type(results[2]) == "string" and results[2]:find("has been released", 1, true) and chance(0.7) then
    forget(t.class, object) -- released ones are met often enough
  elseif host.show then
    host.show(t.name, tostring(results[2]))
  end
end

-- Start with something of each kind, and again whenever the pool is dry.
function host.sow()
  for _, shape in ipairs { "prism", "annulus", "plate", "barrel", "elbow" } do
    local ok, model = pcall(lacuna.synthetic[shape], { facets = 1, drop = pick { {}, "target", "wall_1" } })
    if ok then
      keep(model)
      local found, volume = pcall(model.open_volume, model)
      if found then keep(volume) end
    end
  end
  keep(lacuna.model())
  for _, volume in ipairs(pool.Volume) do
    local ok, mesh = pcall(volume.sweep, volume, { layers = 2, size = 0.5, improve = false, threads = 1 })
    if ok then
      keep(mesh)
      keep(mesh:quality())
    end
  end
end

function host.reseed(n)
  if #pool.Volume < 4 or #pool.Mesh < 2 then host.sow() end
  math.randomseed(seed, n)
  arg = pick { nil, {}, { "width=3" }, { "sub=1", "=", "name=" }, { "nothing=1" }, { 7, {} } }
  if chance(0.5) then
    collectgarbage("incremental", 100, 400) else collectgarbage("incremental", 10, 1000, 1)
  end
  if chance(0.1) then collectgarbage("generational") end
end

function host.summary()
  local lines = {}
  for _, t in ipairs(targets) do
    lines[#lines + 1] = ("%-28s %7d calls, %7d returned"):format(t.name, t.reached, t.returned)
  end
  return table.concat(lines, "\n")
end
