-- SPDX-License-Identifier: MIT
-- The sandbox: what a recipe in it cannot do.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }
local folder = check.empty_folder(params.scratch)
check.empty_folder(folder .. "/out/deeper")
check.empty_folder(folder .. "/elsewhere")

local function run(recipe, ...)
  check.write(folder .. "/recipe.lua", recipe)
  local words = { "--sandbox", ... }
  words[#words + 1] = "recipe.lua"
  return check.run(params.lacuna, folder, words)
end

local function refused(recipe, words, ...)
  local code, out, err = run(recipe, ...)
  check.equal(code, 1, recipe .. "\n" .. out .. err)
  for _, word in ipairs(words) do
    check.that(err:find(word, 1, true), ("'%s' is not said: %s"):format(word, err))
  end
end

local function allowed(recipe, ...)
  local code, out, err = run(recipe, ...)
  check.equal(code, 0, recipe .. "\n" .. out .. err)
  return out
end

-- What is left of Lua works.
check.equal(allowed "print(load('return 1 + 1')(), require 'lacuna'.version, string.rep('a', 3), #arg)",
            "2\t" .. lacuna.version .. "\taaa\t0\n")

-- What is not there.
for _, call in ipairs { "os.execute('true')", "os.getenv('HOME')", "os.remove('x')", "io.open('x')",
                        "io.popen('true')", "io.write('x')", "debug.getregistry()",
                        "package.loadlib('x', 'y')", "dofile('x.lua')",
                        "loadfile('x.lua')" } do
  refused(call, { "the sandbox has no '" .. call:match("^%w+") .. "'" })
end
refused("require 'os'", { "'os'", "lacuna" })
refused("require '../x'", { "../x" })
refused("print(string.dump(print))", { "dump" })
local bytecode = string.dump(load "return 1")
refused(("local f, why = load(%q, 'x', 'b', {}) print(f) error(why)"):format(bytecode), { "binary" })
refused("error(select(2, load(function() return nil end, 'x', 'b')))", { "" })
check.write(folder .. "/bytecode.lua", bytecode)
local code, _, err = check.run(params.lacuna, folder, { "--sandbox", "bytecode.lua" })
check.equal(code, 1)
check.that(err:find("binary", 1, true), err)
refused("local mt = getmetatable(require 'lacuna'.model()) error(tostring(mt))", { "a class of lacuna" })

-- Limits.
refused("local t = {} for i = 1, 1e9 do t[i] = i .. 'x' end", { "not enough memory" }, "--memory", "50")
refused("string.rep('x', 1e9)", { "not enough memory" }, "--memory", "50")
refused("while true do pcall(function() while true do end end) end", { "time limit of 0.5 seconds" },
    "--seconds", "0.5")
allowed("for i = 1, 1e6 do end", "--seconds", "60", "--memory", "100")

-- Files.
local mesh = [[
local lacuna = require "lacuna"
local prism = lacuna.synthetic.prism { sides = 4, drop = "walls" }
local void = prism:open_volume { source = "source", target = "target" }
local mesh = void:sweep { layers = 1, size = 1 }
mesh:write(%q)
]]
refused(mesh:format "x.msh", { "recipe.lua:5:", "--output-dir" })
check.that(not check.exists(folder .. "/x.msh"))
for _, path in ipairs { "../x.msh", folder .. "/x.msh", "deeper/../../x.msh", "/tmp/lacuna_sandbox_x.msh",
    "link/x.msh" } do
  os.execute(("ln -sfn '%s/elsewhere' '%s/out/link'"):format(folder, folder))
  refused(mesh:format(path), { "is not below", path }, "--output-dir", "out")
end
check.that(not check.exists(folder .. "/x.msh") and not check.exists(folder .. "/elsewhere/x.msh"))
check.that(not check.exists("/tmp/lacuna_sandbox_x.msh"))
-- A file that is a link leads out as a folder does.
os.execute(("ln -sfn '%s/elsewhere/y.msh' '%s/out/y.msh'"):format(folder, folder))
refused(mesh:format "y.msh", { "y.msh", "not a plain file" }, "--output-dir", "out")
check.that(not check.exists(folder .. "/elsewhere/y.msh"))
os.execute(("rm '%s/out/y.msh'"):format(folder))
refused(mesh:format "x.msh", { "nowhere" }, "--output-dir", "nowhere")
allowed(mesh:format "x.msh", "--output-dir", "out")
allowed(mesh:format "deeper/y.msh", "--output-dir", "out")
allowed(mesh:format(folder .. "/out/z.msh"), "--output-dir", folder .. "/out")
for _, name in ipairs { "out/x.msh", "out/deeper/y.msh", "out/z.msh" } do
  check.that(check.exists(folder .. "/" .. name), name)
end

-- Scripts are not read, whatever lies beside a file is left alone, and an ending makes no script of a file.
check.write(folder .. "/script.geo", 'SystemCall "touch touched";\n')
refused("require 'lacuna'.load 'script.geo'", { "script.geo", "script" })
check.write(folder .. "/part.stl", "solid\nendsolid\n")
check.write(folder .. "/part.stl.opt", 'SystemCall "touch touched";\n')
refused("require 'lacuna'.load 'part.stl'", { "part.stl" })
for _, name in ipairs { "p.Stl", "p.StL", "p.Bdf", "p.Nas", "p.Mesh", "p.step", "p.IGS", "p.brep", "p.vtk",
    "p.unv" } do
  for _, text in ipairs { 'SystemCall "touch touched";\n',
      'MeshVersion = 1;\nSystemCall "touch touched";\n' } do
    check.write(folder .. "/" .. name, text)
    refused(("require 'lacuna'.load '%s'"):format(name), { name })
  end
end
check.that(not check.exists(folder .. "/touched"))

check.done()
