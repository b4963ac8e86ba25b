-- SPDX-License-Identifier: MIT
-- Bad input, as people make it: each ends with exit code 1 and a message that names recipe, line, the entity
-- and what to try, and leaves no file behind.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }
local folder = params.scratch

-- Lines before the recipe's own, then lines after; the error is expected in between, on line 2.
local function expect(line, words, after)
  check.empty_folder(folder)
  check.write(folder .. "/recipe.lua",
      ('local lacuna = require "lacuna"; local s = lacuna.synthetic\n%s\n%s\n'):format(line, after or ""))
  check.write(folder .. "/empty.step", "")
  check.write(folder .. "/empty.stl", "")
  check.write(folder .. "/garbage.step", ("no step file at all\n"):rep(20))
  local before = table.concat(check.files(folder), " ")
  local code, out, err = check.run(params.lacuna, folder, { "recipe.lua" })
  local told = ("%s\nstandard output: %s\nstandard error: %s"):format(line, out, err)
  check.equal(code, 1, told)
  check.that(err:find("lacuna: recipe.lua:2: ", 1, true), told)
  for _, word in ipairs(words) do
    check.that(err:find(word, 1, true), ("'%s' is not said:\n%s"):format(word, told))
  end
  check.equal(table.concat(check.files(folder), " "), before, told)
end

-- Files.
expect('lacuna.load "nowhere.step"', { "nowhere.step" })
expect('lacuna.load "empty.step"', { "empty.step" })
expect('lacuna.load "empty.stl"', { "empty.stl" })
expect('lacuna.load "garbage.step"', { "garbage.step" })
expect('lacuna.load "recipe.lua"', { "recipe.lua" })
expect('lacuna.load "."', { "." })

-- Faces and roles.
expect("s.prism():open_volume { source = 99 }", { "'source'", "99", 'face 1 "source"' })
expect("s.prism():open_volume { source = 'sauce' }", { "'source'", '"sauce"', 'face 1 "source"' })
expect("s.prism():open_volume { source = 1, target = 2, walls = { 3, 1 } }",
    { 'face 1 "source"', "source", "wall" })
expect("s.prism():open_volume { source = 1, target = 1 }", { 'face 1 "source"', "source", "target" })
expect("s.prism():open_volume { faces = 1, source = 1 }", { "source", "'faces'" })
expect("s.prism():open_volume { faces = 'wall_1' }", { "face 3", "name the roles" })
expect("lacuna.model():open_volume()", { "face" })
expect("lacuna.model():open_volume { source = 1 }", { "1", "no faces" })

-- Options of the sweep.
local void = "s.prism({ sides = 4, drop = 'walls' }):open_volume { source = 1, target = 2 }"
for _, layers in ipairs { "0", "-3", "2.5", "0/0" } do
  expect(void .. ":sweep { size = 0.5, layers = " .. layers .. " }",
      { "sweep: option 'layers'", "positive whole number" })
end
for _, size in ipairs { "0", "-0.5", "0/0", "math.huge", "'fine'" } do
  expect(void .. ":sweep { layers = 2, size = " .. size .. " }",
      { "sweep: option 'size'", "positive number" })
end
expect(void .. ":sweep { size = 0.5, layers = 0 }", { "layers" })

-- Ends that cannot go together.
expect("lacuna.check 'nowhere.msh'", { "nowhere.msh" })
local function triangle(z, name)
  return ("m:add_face { name = '%s', points = { { 0, 0, %d }, { 1, 0, %d }, { 0, 1, %d } }, "
    .. "cells = { { 1, 2, 3 } } }")
    :format(name, z, z, z)
end
expect("local m = s.annulus { drop = { 'target', 'walls' } } " .. triangle(2, "disc")
         .. " m:open_volume({ source = 'source', target = 'disc' }):close()", { "2", "1", "loop" })
expect("local m = s.prism { sides = 4, drop = { 'wall_1' } } " .. triangle(50, "far")
         .. " m:open_volume({ source = 'source', target = 'target',"
         .. " walls = { 'wall_2', 'wall_3', 'wall_4', 'far' } }):close()",
       { '"far"' })

-- Places to write to.
local mesh = "local mesh = " .. void .. ":sweep { layers = 1, size = 1 } "
expect(mesh .. "mesh:write 'nowhere/x.msh'", { "nowhere" })
expect(mesh .. "mesh:write 'x.abc'", { "x.abc" })
expect(mesh .. "mesh:write('x.vtu', { binary = false })", { ".vtu", "'binary'" })
expect(mesh .. "mesh:write ''", { "path" })
expect(mesh .. "mesh:write('x.msh', { version = 3 })", { "'version'", "4.1 or 2.2" })
expect(mesh .. "mesh:write('x.msh', { binry = true })", { "'binary'" })

check.done()
