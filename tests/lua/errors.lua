-- SPDX-License-Identifier: MIT
-- What pcall gets: a table with code, message, entities, file and line, that serves as its text too.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }

local function caught(call)
  local fine, found = pcall(call)
  check.that(not fine, "nothing failed")
  check.equal(type(found), "table")
  return found
end

local prism = lacuna.synthetic.prism { sides = 4, drop = "walls" }
local function void() return prism:open_volume { source = "source", target = "target" } end
local model = lacuna.model()
local corners = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }
model:add_face { name = "floor", points = corners, cells = { { 1, 2, 3, 4 } } }
model:add_face { name = "east", points = { { 5, 0, 0 }, { 6, 0, 0 }, { 6, 1, 0 } }, cells = { { 1, 2, 3 } } }

-- Calls that fail, by the code of what goes wrong, and what the message must name.
local failures = {
  { "lua.bad_value", function() void():sweep { layers = -3 } end, "layers", "-3" },
  { "lua.unknown_option", function() void():sweep { layres = 3 } end, "layres", "layers" },
  { "lua.unknown_field", function() return prism.fases end, "fases", "faces" },
  { "lua.unknown_field", function() prism:sweep {} end, "sweep", "It has: add_face, ", "open_volume" },
  { "lua.bad_value", function() prism:open_volume { source = "sorce" } end, '(did you mean "source"?)' },
  { "lua.bad_value", function() prism:open_volume { source = "zzzzzzzzzz" } end, "has that name; the model" },
  { "lua.bad_value", function() prism:open_volume("source") end, "a table", '"source"' },
  { "lua.bad_value", function() void():sweep { layers = "many" } end, "layers", "whole number", '"many"' },
  { "lua.bad_value", function() void():sweep { size = "0.5 mm" } end, "size", "number", "0.5 mm" },
  { "lua.bad_value", function() lacuna.load() end, "path", "nothing" },
  { "topology.no_faces", function() lacuna.model():open_volume() end, "add_face" },
  { "topology.face_in_two_roles",
    function() prism:open_volume { source = "source", target = "source" } end, "source", "target" },
  { "lua.unknown_ending", function() void():sweep({ layers = 1, size = 1 }):write("x.xyz") end, ".vtu" },
  { "io.no_folder", function() void():sweep({ layers = 1, size = 1 }):write("no/x.msh") end, "create it" },
  { "view.ending", function() prism:picture("x.jpg") end, ".png", "x.jpg" },
  { "lua.wrong_object", function() prism.faces {} end, "colon" },
  { "lua.parameter", function() lacuna.params(3) end, "table" },
  { "lua.bad_value", function() lacuna.synthetic.prism { sides = 1 } end, "sides" },
  { "lua.bad_value", function() lacuna.synthetic.prism { sides = 1e8 } end, "'sides'", "the limit" },
  { "lua.bad_value", function() lacuna.synthetic.barrel { facets = 1e9 } end, "'facets'" },
  { "lua.face_in_parts", function()
    local parts = lacuna.model()
    local apart = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 5, 0, 0 }, { 6, 0, 0 }, { 6, 1, 0 } }
    parts:add_face { points = apart,
      cells = { { 1, 2, 3 }, { 4, 5, 6 } } }
    parts:faces()
  end, "became 2" },
  { "io.no_file", function() lacuna.load "nowhere.stl" end, "nowhere.stl" },
}
for _, failure in ipairs(failures) do
  local found = caught(failure[2])
  check.equal(found.code, failure[1], tostring(found))
  local info = debug.getinfo(failure[2], "S")
  check.equal(found.file, info.short_src)
  check.that(found.line >= info.linedefined and found.line <= info.lastlinedefined, "the recipe's line")
  for i = 3, #failure do check.that(found.message:find(failure[i], 1, true), found.message) end
  for _, entity in ipairs(found.entities) do
    check.equal(type(entity.kind), "string")
    check.equal(math.type(entity.tag), "integer")
  end
end

-- Entities go by kind and tag.
local found = caught(function() prism:face(99) end)
check.that(#found.entities > 0, found.message)
found = caught(function() model:open_volume { source = "floor", target = "east", walls = "floor" } end)
check.equal(found.entities[1].kind, "face", found.message)
check.equal(found.entities[1].tag, 1)

-- An error lists why other sweeps of the volume failed too; its text ends with theirs.
check.equal(#found.attempts, 0)
local refused = caught(function()
  lacuna.synthetic.prism { sides = 5, twist = 40, taper = 0.6 }:open_volume()
    :sweep { layers = 2, size = 0.7, min_scaled_jacobian = 0.99 }
end)
check.that(#refused.attempts >= 2, refused.message)
for _, attempt in ipairs(refused.attempts) do
  check.equal(attempt.code, "quality.below_limit")
  check.that(refused.message:find(attempt.message, 1, true), attempt.message)
end
check.equal(refused.attempts[2].entities[1].kind, "cell")

-- Recipes that took the error for a string go on as they were.
local text = tostring(found)
check.equal(text, ("%s:%d: %s [%s]"):format(found.file, found.line, found.message, found.code))
check.equal("it said: " .. found, "it said: " .. text)
check.equal(found .. "!", text .. "!")
check.equal(#found, #text)
check.equal(found:match("^(.-):%d+: "), found.file)
check.equal(found:upper(), text:upper())
check.that(found:find(found.code, 1, true))
check.equal(("%s"):format(found), text)
check.equal(found.nothing, nil)

-- Thrown again it stays what it is; what a recipe makes of it does not crash.
check.that(rawequal(select(2, pcall(error, found)), found))
found.file, found.line, found.message, found.code = nil, nil, {}, nil
check.equal(type(tostring(found)), "string")
local meta = debug.getmetatable(found)
for _, wrong in ipairs { 1, "x", true, {} } do
  check.that(pcall(meta.__tostring, wrong) == (type(wrong) == "table"))
  check.that(pcall(meta.__concat, wrong, wrong))
end
check.that(not pcall(meta.__tostring))

-- The program: one line on standard error, exit code 1, a traceback only where it is asked for.
local folder = check.empty_folder(params.scratch)
check.write(folder .. "/fails.lua", [[
local lacuna = require "lacuna"
local prism = lacuna.synthetic.prism { sides = 4 }
prism:face(99)
]])
local code, out, err = check.run(params.lacuna, folder, { "fails.lua" })
check.equal(code, 1)
check.equal(out, "")
check.that(err:find("^lacuna: fails%.lua:3: .*99.*%[[%l_]+%.[%l_]+%]\n$"), err)
check.that(not err:find("traceback"), err)
code, out, err = check.run(params.lacuna, folder, { "--verbose", "fails.lua" })
check.that(code == 1 and not err:find("traceback"), err)
code, out, err = check.run(params.lacuna, folder, { "--traceback", "fails.lua" })
check.that(code == 1 and err:find("fails%.lua:3: .*traceback.*fails%.lua:3: in main chunk"), err)

check.done()
