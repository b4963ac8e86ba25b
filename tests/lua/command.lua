-- SPDX-License-Identifier: MIT
-- The command line: exit codes, what goes to which stream, parameters.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }
local folder = check.empty_folder(params.scratch)

local function run(words, input) return check.run(params.lacuna, folder, words, input) end

-- Expect an exit code, and words on the streams; an empty list means the stream is silent.
local function expect(words, code, out_words, err_words, input)
  local found, out, err = run(words, input)
  local told = ("lacuna %s\nstandard output: %s\nstandard error: %s"):format(table.concat(words, " "), out,
      err)
  check.equal(found, code, told)
  for _, pair in ipairs { { out_words, out }, { err_words or false, err } } do
    local wanted, text = table.unpack(pair)
    if wanted and #wanted == 0 then check.equal(text, "", told) end
    for _, word in ipairs(wanted or {}) do
      check.that(text:find(word, 1, true), ("'%s' is not said:\n%s"):format(word, told))
    end
  end
end

expect({ "--version" }, 0, { "lacuna " .. lacuna.version, "Lua 5.4", lacuna.gmsh_version }, {})
expect({ "--help" }, 0, { "usage: lacuna", "exit codes" }, {})
for _, command in ipairs { "info", "view", "picture", "check", "convert", "fill" } do
  for _, words in ipairs { { command, "--help" }, { "help", command }, { command, "x", "--help" } } do
    expect(words, 0, { "usage: lacuna " .. command }, {})
  end
  expect({ command, "--jsn", "x" }, 2, {}, { command, "--jsn", "--help" })
end
expect({ "help", "nothing" }, 2, {}, { "nothing" })
-- A command that is misspelt: letters that are missing, too many, wrong or changed places.
for wrong, meant in pairs { inf = "info", inof = "info", infos = "info", infp = "info", vew = "view",
  veiw = "view", chek = "check", chekc = "check", conv = "convert", convrt = "convert", hlep = "help" } do
  for _, words in ipairs { { wrong }, { wrong, "x.step" }, { wrong, "a.msh", "b.msh" }, { "help", wrong } } do
    expect(words, 2, {}, { "did you mean " .. meant .. "?" })
  end
end
expect({ "remesh", "x.step" }, 2, {},
  { "remesh", "the commands are info, view, picture, check, convert, fill, help" })
check.write(folder .. "/inf", "print 'a recipe'")
expect({ "inf" }, 0, { "a recipe" }, {}) -- a file of that name is a recipe
os.remove(folder .. "/inf")
check.write(folder .. "/gap.lua", "print 'a recipe'")
expect({ "gap" }, 2, {}, { "did you mean gap.lua?" })
expect({ "convert", "a.msh" }, 2, {}, { "IN OUT" })
expect({ "convert", "--json", "a.msh", "b.vtu" }, 2, {}, { "--json" })

-- Recipes side by side: each with its own words, what they print in order, and one that fails or is ended
-- changes nothing for the others.
check.write(folder .. "/job.lua", [[
local lacuna = require "lacuna"
local params = lacuna.params { n = 1, how = "" }
if params.n == 1 then
  local until_then = os.clock() + 0.3
  while os.clock() < until_then do end
end
print("job", params.n)
io.stderr:write("note ", params.n, "\n")
if params.how == "fails" then error("asked for") end
if params.how == "killed" then os.execute("kill -9 $PPID") end
if params.how == "hangs" then while true do end end
]])
local jobs = folder .. "/job.lua"
for _, at_once in ipairs { "1", "2", "9", "joined" } do
  local words = at_once == "joined" and { "--threads=1", "-j2" } or { "-j", at_once }
  local expected = ""
  for n = 1, 5 do
    words[#words + 1], words[#words + 2] = jobs, "n=" .. n
    expected = expected .. "job\t" .. n .. "\n"
  end
  local code, out, err = run(words)
  check.equal(code, 0, err)
  check.equal(out, expected)
  check.equal(err, (expected:gsub("job\t", "note ")))
end
expect({ "-j", "2", jobs, "n=1", "how=fails", jobs, "n=2" }, 1, { "job\t1\njob\t2\n" },
  { "asked for", "job.lua failed, exit code 1" })
expect({ "-j", "2", jobs, "n=2", "how=killed", jobs, "n=3" }, 1, { "job\t3\n" }, { "ended by signal 9" })
expect({ "--sandbox", "--seconds", "1", "-j", "2", jobs, jobs }, 1, {}, { "job.lua failed" })
expect({ "-j", "2", folder .. "/no_such.lua", jobs }, 1, { "job\t1\n" }, { "no_such.lua" })
for _, words in ipairs { { "-j" }, { "-j", "2" }, { "-j", "x", jobs }, { "-j", "1.5", jobs },
  { "-j", "0", jobs }, { "-j0", jobs }, { "-jx", jobs }, { "-j", "2", "n=1", jobs }, { "-j", "2", "-" },
  { "--threads", "1e9", jobs } } do
  expect(words, 2, {}, { "lacuna: " })
end
do
  local command = ("cd '%s' && timeout -s INT 1 '%s' -j 2 job.lua how=hangs job.lua how=hangs"):format(folder,
    params.lacuna) .. " >/dev/null 2>&1"
  local _, how, code = os.execute(command .. "; [ $? -eq 124 ]") -- timeout's own: it had to interrupt
  check.that(how == "exit" and code == 0, "interrupted jobs end")
  local left <close> = assert(io.popen("pgrep -f '[j]ob.lua how=hangs'"))
  check.equal(left:read("a"), "", "no job outlives an interrupt")
end

-- Manual page and completions name every option and command that the help names.
local _, help = run { "--help" }
local program = arg[0]:match("^(.*/)") .. "../../lua/program/"
for _, path in ipairs { "lacuna.1", "completion/lacuna.bash", "completion/_lacuna",
  "completion/lacuna.fish" } do
  local file <close> = assert(io.open(program .. path))
  local text = file:read("a"):gsub("\\%-", "-")
  for option in (help .. "--json"):gmatch("%-%-([%l-]+)") do
    local there = text:find("--" .. option, 1, true) or text:find("-l " .. option, 1, true)
    check.that(there, path .. ": --" .. option)
  end
  for command in help:gmatch("\n  (%l+) [%u ]+ %l") do
    check.that(text:find("%f[%w]" .. command .. "%f[%W]"), path .. ": " .. command)
  end
end

-- Bad usage is 2.
expect({}, 2, {}, { "lacuna: ", "--help" })
expect({ "--sandbocks", "x.lua" }, 2, {}, { "--sandbocks", "--sandbox" })
expect({ "x.lua", "layers" }, 2, {}, { "layers", "key=value" })
expect({ "x.lua", "2layers=1" }, 2, {}, { "key=value" })
expect({ "x.lua", "--layers=3" }, 2, {}, { "key=value", "write layers=3" })
expect({ "x.lua", "--quiet" }, 2, {}, { "options go before the recipe" })
expect({ "info" }, 2, {}, { "info", "file" })
expect({ "check", "a.msh", "b.msh" }, 2, {}, { "b.msh" })
expect({ "--memory", "100", "x.lua" }, 2, {}, { "--sandbox" })
expect({ "--sandbox", "--seconds", "-1", "x.lua" }, 2, {}, { "--seconds", "-1" })
expect({ "--sandbox", "--output-dir" }, 2, {}, { "--output-dir" })

-- A recipe that fails is 1, and says file and line.
expect({ "nowhere.lua" }, 1, {}, { "lacuna: ", "nowhere.lua" })
check.write(folder .. "/syntax.lua", "local x = = 1\n")
expect({ "syntax.lua" }, 1, {}, { "lacuna: syntax.lua:1:" })
check.write(folder .. "/fails.lua", "print 'before'\nlocal x = nil\nprint(x.y)\n")
expect({ "fails.lua" }, 1, { "before" }, { "lacuna: fails.lua:3:" })
check.write(folder .. "/object.lua",
    "error(setmetatable({}, { __tostring = function() return 'told by an object' end }))\n")
expect({ "object.lua" }, 1, {}, { "lacuna: told by an object" })
check.write(folder .. "/object.lua", "error(setmetatable({}, { __tostring = function() end }))\n")
expect({ "object.lua" }, 1, {}, { "lacuna: (error object is a table value)" })
expect({ "--traceback", "fails.lua" }, 1, { "before" }, { "traceback" })

-- Parameters.
check.write(folder .. "/params.lua", [[
local lacuna = require "lacuna"
local p = lacuna.params { layers = 12, size = 2.0, name = "a", fast = false, list = { 1 } }
print(p.layers, math.type(p.layers), p.size, p.name, p.fast)
print(arg[0], #arg, select("#", ...))
]])
-- --help lists them, wherever it stands, and nothing behind their declaration is done.
for _, words in ipairs { { "params.lua", "--help" }, { "params.lua", "layers=3", "-h" },
  { "help", "params.lua" }, { "--sandbox", "params.lua", "--help" } } do
  local code, out, err = run(words)
  check.equal(code .. err, "0", err)
  check.equal(out, [[
usage: lacuna params.lua [key=value ...]

parameters and their defaults:
  fast=false  boolean
  layers=12   number
  list=...    table, cannot be set on the command line
  name=a      string
  size=2.0    number
]])
end
for name, lines in pairs {
  late = "local lacuna = require 'lacuna'\nlocal part = lacuna.load 'nowhere.step'\nlacuna.params { a = 1 }",
  none = "local x = 1",
  caught = "pcall(require('lacuna').params, { a = 1 })\nassert(io.open('ran', 'w')):close()",
  made = "local part = require('lacuna').synthetic.prism {}\nassert(io.open('ran', 'w')):close()\n" ..
    "require('lacuna').params { a = 1 }",
  wrong = "require('lacuna').params(3)",
  plain = "assert(io.open('ran', 'w')):close()\nprint 'it runs'",
  without = "-- no params\nlocal part = require('lacuna').load 'nowhere.step'",
} do
  check.write(folder .. "/" .. name .. ".lua", lines)
  local none = "has no parameters"
  local told = { caught = "a=1", none = none, late = "before lacuna.params", plain = none, without = none,
    made = "lacuna.synthetic.prism before" }
  expect({ name .. ".lua", "--help" }, told[name] and 0 or 1, { told[name] },
      told[name] and {} or { "params: needs a table" })
  check.that(not check.exists(folder .. "/ran"), name .. ": the rest of a recipe is not run")
end
expect({ "params.lua" }, 0, { "12\tinteger\t2.0\ta\tfalse", "params.lua\t0\t0" }, {})
expect({ "params.lua", "layers=20", "size=1.5", "name=b c=d", "fast=true" }, 0,
    { "20\tinteger\t1.5\tb c=d\ttrue" }, {})
expect({ "params.lua", "layres=20" }, 1, {}, { "params.lua:2:", "'layres'", "the nearest is 'layers'" })
expect({ "params.lua", "layers=many" }, 1, {}, { "'layers'", "number", '"many"' })
expect({ "params.lua", "fast=1" }, 1, {}, { "'fast'", "boolean" })
expect({ "params.lua", "list=1" }, 1, {}, { "'list'", "table" })
check.write(folder .. "/plain.lua", "print 'no parameters'\n")
expect({ "plain.lua", "layers=2" }, 0, { "no parameters" }, { "layers=2", "does not call lacuna.params" })

-- Standard input.
expect({ "-", "a=1" }, 0, { "1" }, {}, "print(require 'lacuna'.params { a = 0 }.a)")
expect({ "-" }, 1, {}, { "lacuna: stdin:2:" }, "\nerror 'here'")

-- The prompt, fed by a pipe: values are printed, statements may span lines, errors do not end it.
expect({ "-i" }, 0, { "3\n", "yes", lacuna.version }, { "prompt:1:" },
       "1 + 2\ndo\nprint 'yes'\nend\nerror 'no'\nlacuna.version\n")

-- exit and quit leave it, unless a variable is called so.
for _, word in ipairs { "exit", "quit", "exit()", " quit ", "quit();" } do
  local code, out, err = run({ "-i" }, "print 'before'\n" .. word .. "\nprint 'after'\n")
  check.equal(code .. out .. err, "0before\n", word)
end
expect({ "-i" }, 0, { "3\n", "after" }, {}, "quit = 3\nquit\nprint 'after'\n")

-- A file that is no recipe; CAD that has no mesh.
for _, ending in ipairs { "step", "stp", "STEP", "iges", "igs", "brep" } do
  local path = "part." .. ending
  check.write(folder .. "/" .. path, "ISO-10303-21;\nHEADER;\n")
  expect({ path }, 1, {}, { path .. ":1:", "`lacuna info " .. path .. "`" })
  for _, words in ipairs { { "check", path }, { "check", "--json", path }, { "convert", path, "x.msh" } } do
    expect(words, 1, {}, { path .. " is a CAD file, which has no mesh", "`lacuna info`", "io.no_mesh" })
    for i, word in ipairs(words) do words[i] = word:gsub("part%.", "nosuch.") end
    expect(words, 1, {}, { "there is no file nosuch." .. ending, "io.no_file" })
  end
end

-- info and check.
check.write(folder .. "/make.lua", [[
local lacuna = require "lacuna"
local p = lacuna.params { output = "" }
local prism = lacuna.synthetic.prism { sides = 4, drop = "walls" }
local void = prism:open_volume { source = "source", target = "target" }
void:sweep({ layers = 2, size = 0.5 }):write(p.output)
]])
expect({ "make.lua", "output=good.msh" }, 0, {}, {})
expect({ "check", "good.msh" }, 0, { "caled" }, {})
check.that(check.files(folder)[2] ~= nil)
expect({ "check", "nowhere.msh" }, 1, {}, { "lacuna: ", "nowhere.msh" })
check.write(folder .. "/empty.msh", "")
expect({ "check", "empty.msh" }, 1, {}, { "empty.msh" })
check.write(folder .. "/inverted.msh", [[
$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
8
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 -1
6 1 0 -1
7 1 1 -1
8 0 1 -1
$EndNodes
$Elements
1
1 5 2 1 1 1 2 3 4 5 6 7 8
$EndElements
]])
expect({ "check", "inverted.msh" }, 1, { "caled" }, { "inverted.msh", "1 of 1 cells" })

-- Every format that is written is checked and converted, and the numbers of cells and the volume stay.
local function json_of(words)
  local code, out, err = run(words)
  check.equal(code, 0, err)
  return out
end
local function field(text, name) return tonumber(text:match('"' .. name .. '": ([%d.e+-]+)')) end
local good = json_of { "check", "--json", "good.msh" }
check.that(good:find("^{.*}\n$"), good)
check.that(field(good, "hexes") > 0 and good:find('"certified": true', 1, true), good)
check.that(good:find('"scaled_jacobian": {', 1, true), good)
for _, ending in ipairs { "msh", "vtu", "vtk", "inp", "bdf", "nas", "dat", "unv", "exo", "e" } do
  local path = "other." .. ending
  expect({ "convert", "good.msh", path }, 0, { path, "elements" }, nil)
  if not ending:match("^e") then  -- Exodus files are written and not read
    local found = json_of { "check", path, "--json" }
    check.equal(field(found, "hexes"), field(good, "hexes"), path)
    check.near(field(found, "volume"), field(good, "volume"), 1e-5 * field(good, "volume"))
    local said = ending:match("^vt") and { "note: ", "groups of VTK files are not read" } or {}
    expect({ "check", path }, 0, { "caled" }, said)
  end
  -- Solids are shown as they are in every format; faces on demand.
  for option, shown in pairs { ["--quiet"] = true, ["--faces"] = false } do
    local code, out, err = run { "view", option, path }
    check.equal(code, 0, err)
    check.equal(out:find("it shows cells", 1, true) ~= nil, shown, path .. " " .. option)
    local file <close> = assert(io.open(folder .. "/" .. path .. ".view.html"))
    check.equal(file:read("a"):find('"kind":%s*"cells"') ~= nil, shown, path .. " " .. option)
    local show = shown and "cells" or "faces"
    expect({ "picture", path, "drawn.png", "show=" .. show, "width=64" }, 0, { "the " .. show }, nil)
  end
end
check.that(check.exists(folder .. "/drawn.png"))
expect({ "picture", "good.msh" }, 2, {}, { "FILE OUT" })
expect({ "picture", "good.msh", "x.png", "y.png" }, 1, {}, { "y.png" })
expect({ "picture", "good.msh", "x.html" }, 1, {}, { ".png" })
expect({ "picture", "good.msh", "x.png", "colur=layer" }, 1, {}, { "colour" })
expect({ "picture", "good.msh", "x.png", "facets=true" }, 1, {}, { "facets", "show" })
expect({ "picture", "good.msh", "x.png", "show=faces", "colour=groups" }, 1, {}, { "colour" })
check.that(not check.exists(folder .. "/x.png"))
expect({ "convert", "good.msh", "x.xyz" }, 1, {}, { "x.xyz", ".vtu" })
expect({ "convert", "nowhere.msh", "x.vtu" }, 1, {}, { "nowhere.msh" })
check.that(not check.exists(folder .. "/x.vtu"))
-- A void is filled without a recipe, with numbers, tables and names as values; folders are made for OpenFOAM.
expect({ "fill", "good.msh", "again.vtu", "size=0.5", "keep_mesh=false", "layers={count=3,bias=2}",
  "name=water" }, 0, { "hexahedra" }, nil)
expect({ "fill", "good.msh", "case/constant/polyMesh", "size=0.5", "keep_mesh=false" }, 0, { "hexa" }, nil)
check.that(check.exists(folder .. "/case/constant/polyMesh/owner"))
expect({ "fill", "good.msh", "again.vtu", "siez=0.5" }, 1, {}, { "siez", "size" })
expect({ "fill", "good.msh", "again.vtu", "layers={3" }, 1, {}, { "layers={3" })
expect({ "fill", "good.msh" }, 2, {}, { "IN... OUT" })
-- Several files bound one void: a tube inside another one.
for name, radius in pairs { inner = 1, outer = 2 } do
  local tube = lacuna.synthetic.prism { sides = 32, radius = radius, height = 4 }
  tube:open_volume():write_facets(folder .. "/" .. name .. ".stl")
end
expect({ "fill", "inner.stl", "outer.stl", "gap.vtu", "size=0.5" }, 0, { "hexahedra" }, nil)
-- Every option of the calls behind `fill` goes to its call, which is the one that refuses a bad value.
local here = arg[0]:match("^(.*/)")
local api = assert(io.open(here .. "../../lua/lacuna.d.lua")):read "a"
local source = assert(io.open(here .. "../../lua/program/commands.lua")):read "a"
for call, class in pairs { load = "LoadOptions", open_volume = "Roles", write = "WriteOptions" } do
  local keys = source:match("\n  " .. call .. " = words[ (%[\"]*([^\"%]]*)")
  local listed = {}
  for key in keys:gmatch "[%w_]+" do listed[key] = true end
  local fields = api:match("%-%-%-@class lacuna%." .. class .. "\n(.-)\n\n")
  for key in fields:gmatch "@field ([%w_]+)" do
    -- `without` of load and of write are the same word; write has it.
    check.that(listed[key] or (call == "load" and key == "without"), call .. " " .. key)
  end
end
local faces = json_of { "info", "--json", "good.msh" }
check.that(faces:find('"faces": [{', 1, true) and faces:find('"area": ', 1, true), faces)

-- Nothing is written outside: neither to the home folder nor where there is none.
local home = check.empty_folder(folder .. "/home")
for _, words in ipairs { "--version", "info good.msh", "check good.msh", "make.lua output=again.msh" } do
  local done = os.execute(("cd '%s' && HOME='%s' '%s' %s >/dev/null 2>&1"):format(folder, home,
      params.lacuna, words))
  check.that(done, words)
end
local pipe = assert(io.popen(("printf '1\\nlacuna.version\\n' | HOME='%s' '%s' -i"):format(home,
    params.lacuna)))
check.that(pipe:read("a"):find(lacuna.version, 1, true))
pipe:close()
check.equal(#check.files(home), 0, "files in the home folder")

-- The prompt's help and what it shows.
expect({ "-i" }, 0, { "lacuna.load", 'help "sweep"' }, {}, "help\n")
expect({ "-i" }, 0, { "Volume:sweep", "layers", "min_scaled_jacobian" }, {}, 'help "sweep"\n')
expect({ "-i" }, 0, { "coordinates" }, {}, 'help "Mesh"\n')
expect({ "-i" }, 0, { "feature_angle", "lacuna.load" }, {}, 'help(lacuna.load)\n')
expect({ "-i" }, 0, { "Volume:sweep(options): layers", "about as high" }, {}, 'help "layers"\n')
expect({ "-i" }, 0, { "sweep" }, {}, 'help "sweeep"\n')
expect({ "-i" }, 0, { "{ 1, 2, x = { y = \"z\" } }", "text", "... 5 more" }, {},
       "{ 1, 2, x = { y = 'z' } }\n'text'\nt = {} for i = 1, 25 do t[i] = i end\nt\n")
expect({ "-i" }, 0, { "after" }, { "prompt:1:" }, "x = = 1\nprint 'after'\n")

if lacuna.gmsh_version ~= "none" then
  check.write(folder .. "/square.geo", 'SetFactory("OpenCASCADE"); Rectangle(7) = {0, 0, 0, 3, 2};\n')
  expect({ "info", "square.geo" }, 0, { "face 7: plane, area 6", "free edges: 4" }, {})
  expect({ "info", "nowhere.step" }, 1, {}, { "nowhere.step" })

  -- A box whose wall 6 has a hole that crosses its border: what is found does not go over the place.
  check.write(folder .. "/holed.geo", [[SetFactory("OpenCASCADE");
Point(1) = {0, 0, 0}; Point(2) = {4, 0, 0}; Point(3) = {4, 4, 0}; Point(4) = {0, 4, 0};
Point(5) = {0, 0, 6}; Point(6) = {4, 0, 6}; Point(7) = {4, 4, 6}; Point(8) = {0, 4, 6};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Line(9) = {1, 5}; Line(10) = {2, 6}; Line(11) = {3, 7}; Line(12) = {4, 8};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8}; Plane Surface(2) = {2};
Curve Loop(3) = {1, 10, -5, -9}; Plane Surface(3) = {3};
Curve Loop(4) = {2, 11, -6, -10}; Plane Surface(4) = {4};
Curve Loop(5) = {4, 9, -8, -12}; Plane Surface(5) = {5};
Curve Loop(6) = {3, 12, -7, -11};
Point(20) = {1, 4, 4}; Point(21) = {3, 4, 4}; Point(22) = {3, 4, 8}; Point(23) = {1, 4, 8};
Line(20) = {20, 21}; Line(21) = {21, 22}; Line(22) = {22, 23}; Line(23) = {23, 20};
Curve Loop(7) = {20, 21, 22, 23};
Plane Surface(6) = {6, 7};
]])
  local function sweep_holed(roles)
    check.write(folder .. "/holed.lua", ([[local lacuna = require "lacuna"
local void = lacuna.load "holed.geo":open_volume { %s }
local mesh = void:sweep { size = 2, layers = 3 }
print(mesh.report)
print(void:describe())
]]):format(roles))
    return { "holed.lua" }
  end
  local told = "lacuna: note: face 6 could not be triangulated"
  for _, roles in ipairs { "", "faces = { 1, 2, 3, 4, 5 }", "source = 1, target = 2, walls = 'auto'",
                           "source = 1, walls = 'auto'" } do
    expect(sweep_holed(roles), 1, {}, { told, "cad.face_left_out", "face 6 of holed.geo", "repair it" })
  end
  expect(sweep_holed "faces = { 2, 6 }", 1, {}, { told, "names face 6, which was not read" })
  expect(sweep_holed "source = 1, target = 2, walls = { 3, 4, 5 }", 0,
    { "closed: face 6 of holed.geo was left out", "\nface 6 of holed.geo was left out",
      "its place is taken by void face 1" }, { told })
end

-- Ctrl-C: loops, coroutines and pcall cannot hold it up; nor can the kernel.
local endless = {
  "while true do end",
  "while true do pcall(function() while true do end end) end",
  "local f = coroutine.wrap(function() while true do coroutine.yield() end end) while true do f() end",
  "while true do pcall(error) end",
  [[local lacuna = require 'lacuna'
    local p = lacuna.synthetic.plate { drop = 'walls' }
    while true do
      pcall(function()
        p:open_volume({ source = 'source', target = 'target' }):sweep { layers = 40, size = 0.02 }
      end)
    end]],
}
for i, source in ipairs(endless) do
  -- The signal is sent once the recipe has said that it runs, and a moment later.
  local recipe, started = ("%s/endless_%d.lua"):format(folder, i), ("%s/started_%d"):format(folder, i)
  check.write(recipe, ("assert(io.open(%q, 'w')):close()\n%s\n"):format(started, source))
  local pipe = assert(io.popen(([[
'%s' '%s' 2>&1 & pid=$!
until [ -e '%s' ]; do sleep 0.05; done
sleep 0.3; kill -INT $pid; wait $pid; echo "exit code $?"]]):format(params.lacuna, recipe, started)))
  local told = pipe:read("a")
  pipe:close()
  check.that(told:find("lacuna: interrupted", 1, true) and told:find("exit code 130", 1, true),
      recipe .. ": " .. told)
end

-- An interrupt that comes while a file is written: the recipe ends at once, and no unfinished file stays.
for _, ending in ipairs { "msh", "inp" } do
  local place = check.empty_folder(folder .. "/interrupted_" .. ending)
  local recipe = folder .. "/writes_" .. ending .. ".lua"
  check.write(recipe, ([[
local lacuna = require "lacuna"
local void = lacuna.synthetic.prism { sides = 4, height = 1.4, drop = "walls" }:open_volume {}
local mesh = void:sweep { layers = 60, size = 0.02, quads = "mapped" }
for n = 1, math.huge do
  mesh:write(%q .. n .. ".%s")
  if n == 1 then assert(io.open(%q, "w")):close() end
  os.remove(%q .. (n - 1) .. ".%s")
end
]]):format(place .. "/", ending, place .. "/started", place .. "/", ending))
  -- Both streams in one; then the processor's ticks at the signal, and what all took in the end.
  local pipe = assert(io.popen(([[
'%s' --quiet '%s' 2>&1 & pid=$!
until [ -e '%s/started' ]; do sleep 0.02; done
sleep 0.1; read -r _ _ _ _ _ _ _ _ _ _ _ _ _ user system _ < /proc/$pid/stat; kill -INT $pid; wait $pid
echo "exit code $?"; echo "at $((user + system)) of $(getconf CLK_TCK)"; times]]):format(params.lacuna,
    recipe, place)))
  local told = pipe:read("a")
  pipe:close()
  check.that(told:find("lacuna: interrupted", 1, true) and told:find("exit code 130", 1, true), told)
  local ticks, a_second = told:match("at (%d+) of (%d+)")
  local seconds = 0 -- of the last line: the children's, as minutes and seconds
  for minutes, part in told:match("([^\n]+)\n*$"):gmatch("(%d+)m([%d.]+)s") do
    seconds = seconds + 60 * minutes + part
  end
  -- 0.2 s is what it is to be; the rest is for builds that check themselves, and the clock's ticks.
  check.that(seconds - ticks / a_second < 0.5, told)
  local left <close> = assert(io.popen(("ls -A '%s'"):format(place)))
  local names = {}
  for name in left:lines() do
    if name ~= "started" then names[#names + 1] = name end
  end
  check.that(#names <= 2, table.concat(names, " "))
  for _, name in ipairs(names) do check.that(name:find("^%d+%." .. ending .. "$"), name) end
end

-- How many cells are expected is said before each sweep, and is right to a factor of four.
check.write(folder .. "/expected.lua", ("local step = %d"):format(check.whole and 1 or 3) .. [[

local lacuna = require "lacuna"
local shapes, synthetic = {}, lacuna.synthetic
for sides = 3, 8, step do
  shapes[#shapes + 1] = synthetic.prism { sides = sides, holes = sides % 2, twist = 10 * sides, taper = 0.8 }
end
for _, name in ipairs { "annulus", "elbow", "barrel", "plate" } do shapes[#shapes + 1] = synthetic[name]() end
for _, shape in ipairs(shapes) do
  for _, options in ipairs { {}, { size = 0.2 }, { size = 0.15, layers = 7 } } do
    local void = shape:open_volume { source = "source", target = "target", walls = "auto" }
    print(void:sweep(options).hexes)
    io.stderr:write("made\n")
  end
end
]])
do
  local code, out, err = run { "--verbose", "expected.lua" }
  check.equal(code, 0, err)
  local made, count = out:gmatch("%d+"), 0
  for log in err:gmatch("(.-)\nmade") do
    local hexes = tonumber(made())
    local expected = tonumber(log:match("lacuna: estimate: about (%d+) cells"))
    check.that(expected and expected < 4 * hexes and hexes < 4 * expected,
        ("%d hexes, and expected were %s"):format(hexes, expected))
    count = count + 1
  end
  check.equal(count, check.whole and 30 or 18)
end

-- --timing: seconds by stage, which add up, of what fails too; those of the processor too.
check.write(folder .. "/timed.lua", [[
local lacuna = require "lacuna"
local params = lacuna.params { fails = false }
local void = lacuna.synthetic.prism { sides = 6, drop = { "wall_1" } }:open_volume {}
void:sweep({ layers = 4, size = 0.3 }):write "timed.msh"
local until_then = os.clock() + 0.05
while os.clock() < until_then do end
if params.fails then error "asked for" end
]])
for _, fails in ipairs { "false", "true" } do
  local name = "timing_" .. fails .. ".json"
  local code, _, err = run { "--timing", name, folder .. "/timed.lua", "fails=" .. fails }
  check.equal(code, fails == "true" and 1 or 0, err)
  local file <close> = assert(io.open(folder .. "/" .. name))
  local line = file:read("a")
  local stages, times = {}, '"seconds": ([%d.]+), "processor_seconds": ([%d.]+)'
  local all, all_busy = line:match(times)
  local sum, busy = 0, 0
  for stage, seconds, processor_seconds in line:gmatch('"stage": "([^"]*)", ' .. times) do
    sum, busy = sum + tonumber(seconds), busy + tonumber(processor_seconds)
    stages[stage] = tonumber(seconds)
  end
  check.that(math.abs(sum - all) < 1e-3 and math.abs(busy - all_busy) < 1e-3, line)
  check.that(stages["roles"] and stages["closing"] and stages["layers"] and stages["writing timed.msh"], line)
  check.that(stages["recipe"] >= 0.04, "a pause of the recipe is no stage of the kernel: " .. line)
end
expect({ "--timing", "-", folder .. "/timed.lua" }, 0, {}, { '{"recipe": "', '"stages": [' })
expect({ "--timing", "/nowhere/t.json", folder .. "/timed.lua" }, 1, {}, { "--timing", "/nowhere/t.json" })
expect({ "--timing", "-", "-j", "2", jobs }, 2, {}, { "--timing", "without -j" })
-- A recipe in the place of the file is not written over.
for _, flag in ipairs { "--timing", "--history" } do
  expect({ flag, folder .. "/timed.lua", "fails=no" }, 2, {}, { flag, "found the recipe", "timed.lua" })
end
expect({ "--timing", "-", folder .. "/timed.lua" }, 0, {}, { '"stages": [' })

check.done()
