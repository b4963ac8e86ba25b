-- SPDX-License-Identifier: MIT
-- What a call works on cannot be pulled from under it: not by its own callbacks, not by finalizers.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"

local function volume(drop)
  local model = lacuna.synthetic.prism { sides = 5, drop = drop or "walls" }
  return model:open_volume { source = "source", target = "target" }, model
end

-- The size function closes the volume it is asked for.
do
  local v = volume()
  local asked = 0
  local mesh = v:sweep { layers = 3, quads = "paved", size = function()
    asked = asked + 1
    if asked == 2 then local c <close> = v end
    return 0.3
  end }
  check.that(asked > 2 and mesh.hexes > 0)
  check.fails(function() return v:describe() end, "released")
end

-- A finalizer closes it, wherever Lua chooses to collect.
for step = 1, 200, 7 do
  local v = volume()
  setmetatable({}, { __gc = function() local c <close> = v end })
  collectgarbage("generational")
  local junk = {}
  for i = 1, step do junk[i] = { i } end
  local fine, mesh = pcall(v.sweep, v, { layers = 3, size = 0.5 })
  check.that(fine and mesh.hexes > 0 or tostring(mesh):find("released", 1, true), tostring(mesh))
  collectgarbage("incremental")
end

-- What changes the volume while it is swept is refused by name; what only looks is not.
do
  local v = volume()
  local refusals, looks = {}, 0
  local mesh = v:sweep { layers = 2, quads = "paved", size = function()
    for name, call in pairs {
      close = function() v:close() end,
      match = function() v:match() end,
      sweep = function() v:sweep { layers = 1, size = 1 } end,
      override_class = function() v:override_class "I" end,
    } do
      local fine, message = pcall(call)
      if not fine then refusals[name] = message end
    end
    assert(v.class == "I" and #v:tree() > 0 and #v:describe() > 0)
    looks = looks + 1
    return 0.5
  end }
  check.that(mesh.hexes > 0 and looks > 0)
  for _, name in ipairs { "close", "match", "sweep", "override_class" } do
    local message = refusals[name] or ""
    check.that(message:find("sweep()", 1, true) or message:find("sealed already", 1, true), name .. message)
  end
  check.equal(v:is_watertight(), true)
end

-- A callback may work on other things: make a model, seal and sweep another volume, collect.
do
  local v = volume()
  local inner
  local mesh = v:sweep { layers = 2, quads = "paved", size = function()
    if not inner then inner = volume():sweep { layers = 1, size = 0.5 } end
    collectgarbage()
    return 0.5
  end }
  check.that(mesh.hexes > 0 and inner.hexes > 0)
end

-- A callback that raises, in every way there is, leaves the volume usable.
for _, thrown in ipairs { "text", 7, { code = 1 }, setmetatable({}, { __tostring = error }) } do
  local v = volume()
  local fine, found = pcall(v.sweep, v,
      { layers = 2, quads = "paved", size = function() error(thrown, 0) end })
  check.that(not fine and (found == thrown or type(thrown) == "string"))
  check.that(v:sweep { layers = 2, size = 0.5 }.hexes > 0)
end
do
  local v = volume()
  local inside = coroutine.wrap(function()
    return pcall(v.sweep, v,
        { layers = 2, quads = "paved", size = function() coroutine.yield() return 1 end })
  end)
  local fine, message = inside()
  check.that(fine == false and message:find("yield", 1, true), tostring(message))
  check.that(v:sweep { layers = 2, size = 0.5 }.hexes > 0)
end
do -- the stack runs over
  local v = volume()
  local function deeper() return deeper() + 1 end
  check.fails(function() v:sweep { layers = 2, quads = "paved", size = deeper } end, "stack overflow")
  check.that(v:sweep { layers = 2, size = 0.5 }.hexes > 0)
end

-- A model that is closed while its faces are asked for, and faces that outlive their model.
do
  local _, model = volume()
  local face = model:face "source"
  do local c <close> = model end
  check.fails(function() return model:faces() end, "released")
  check.that(face.area > 0)
end

-- A report is a share of the mesh, and writing holds it.
do
  local v = volume()
  local mesh = v:sweep { layers = 2, size = 0.5 }
  local quality = mesh:quality()
  do local c <close> = mesh end
  check.that(#tostring(quality) > 0)
  check.fails(function() return mesh.nodes end, "released")
end

-- A shape that would never end is refused, by the option that makes it.
check.fails(function() lacuna.synthetic.prism { twist = 1e308 } end, "'twist'", "facets")
check.fails(function() lacuna.synthetic.elbow { facets = 1000000, angle = 359 } end, "facets")

-- Finalizers that change the volume or the model while a result is put together or arguments are read.
-- Collection is started right before, so that it falls somewhere in the call: `from` moves the place.
local function while_collecting(from, change, call)
  local before = collectgarbage("incremental", 10, 1000, 5)
  collectgarbage()
  setmetatable({}, { __gc = change })
  local junk = {}
  for i = 1, from do junk[i] = { i } end
  local results = table.pack(pcall(call))
  collectgarbage(before, 200, 100, 13)
  return table.unpack(results, 1, results.n)
end
local function same(a, b)
  if type(a) ~= "table" or type(b) ~= "table" then return a == b end
  for key in pairs(a) do if not same(a[key], b[key]) then return false end end
  for key in pairs(b) do if a[key] == nil then return false end end
  return true
end
local step = check.whole and 3 or 33
local wanted = volume():free_edges()
for from = 0, 600, step do
  local v = volume()
  local fine, edges = while_collecting(from, function() v:close() end, function() return v:free_edges() end)
  check.that(fine and (#edges == 0 or same(edges, wanted)), fine and "free_edges" or tostring(edges))
end
for from = 0, 600, step do
  local v = volume()
  local fine, found = while_collecting(from, function() v:match { method = "nearest" } end,
      function() return v:match() end)
  check.that(fine and #found.vertices == 5 and #found.loops == 1, fine and "match" or tostring(found))
end
-- A face that is added while the list it stands in is read.
for from = 0, 900, step do
  local model, list = lacuna.model(), { 1 }
  model:add_face { name = "a", points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, cells = { { 1, 2, 3 } } }
  local fine, message = while_collecting(from, function()
    list[1] = model:add_face { points = { { 5, 0, 0 }, { 6, 0, 0 }, { 5, 1, 0 } }, cells = { { 1, 2, 3 } } }
  end, function() return model:open_volume { faces = list } end)
  check.that(not fine, "open_volume")
  fine, message = while_collecting(from, function()
    list[1] = model:add_face { points = { { 9, 0, 0 }, { 8, 0, 0 }, { 9, 1, 0 } }, cells = { { 1, 2, 3 } } }
    list[2] = list[1]
  end, function() return model:face(list) end)
  check.that(fine or tostring(message):find("must select one face", 1, true), tostring(message))
end

check.done()
