-- SPDX-License-Identifier: MIT
-- mpirun -n P lacuna: the bytes of one process, one voice, one message where something fails, and no file
-- then.
-- usage: lacuna several.lua lacuna=PROGRAM mpirun=MPIRUN scratch=FOLDER
local check = dofile(arg[0]:match("^(.*/)") .. "../lua/check.lua")
local lacuna = require "lacuna"

local params = lacuna.params { lacuna = "lacuna", mpirun = "mpirun", scratch = "." }
local function path(name) return params.scratch .. "/" .. name end

local function bytes(name)
  local file <close> = io.open(path(name), "rb")
  return file and file:read("a")
end

local recipe = path("several.recipe.lua")
do
  local file <close> = assert(io.open(recipe, "w"))
  file:write([[
local lacuna = require "lacuna"
local p = lacuna.params { output = "", layers = 12, size = 0.15, fail = "", whole = false,
  binary = true }
print "started"
local part = lacuna.synthetic.prism { sides = 6, twist = 20, drop = { "wall_1" } }
local void = part:open_volume {}
if p.fail == "before" then error "a recipe that ends" end
if p.whole then
  void:sweep { layers = p.layers, size = p.size }:write(p.output)
else
  local write = not p.output:find "vtu" and { binary = p.binary } or nil
  local report = void:sweep_to(p.output, { layers = p.layers, size = p.size, write = write,
    min_scaled_jacobian = p.fail == "proof" and 0.999 or nil, improve = p.fail ~= "proof" })
  assert(report.streamed)
  print(report.processes, report.hexes)
end
]])
end

-- Exit code, standard output and standard error of so many processes.
local function run(count, ...)
  local start = count > 1
      and ("%s --oversubscribe --allow-run-as-root -q -n %d "):format(params.mpirun, count) or ""
  local command = ("%s%s %s"):format(start, params.lacuna, table.concat({ ... }, " "))
  local _, _, code = os.execute(("%s > %s 2> %s"):format(command, path("out.txt"), path("err.txt")))
  return code, bytes("out.txt"), bytes("err.txt")
end
local function times(text, what) return select(2, text:gsub(what, "")) end

for _, name in ipairs { "mesh.msh", "mesh.vtu", "mesh.vtk" } do
  for _, binary in ipairs { "true", "false" } do
    local first
    for _, count in ipairs { 1, 2, 4 } do
      os.remove(path(name))
      local code, out, err = run(count, recipe, "output=" .. path(name), "binary=" .. binary)
      check.equal(code, 0, err)
      check.equal(times(out, "started"), 1, "who prints")
      check.equal(tonumber(out:match("started%s+(%d+)")), count)
      check.equal(err, "")
      first = first or bytes(name)
      check.that(#first > 1000 and bytes(name) == first, name .. " of " .. count)
    end
  end
end

-- Layers in several parts, so that each has some.
local one
for _, count in ipairs { 1, 2, 4 } do
  local code, _, err = run(count, "--verbose", recipe, "output=" .. path("large.msh"), "layers=60",
    "size=0.02")
  check.equal(code, 0, err)
  one = one or bytes("large.msh")
  check.that(bytes("large.msh") == one, "large.msh of " .. count)
  if count > 1 then check.that(err:find("of " .. count .. " processes sent %d+ messages"), err) end
end
os.remove(path("large.msh"))

-- Nothing to share: the first does it, and says so.
local code, out, err = run(3, recipe, "output=" .. path("mesh.msh"), "whole=true")
check.equal(code, 0, err)
check.equal(times(out, "started"), 1)
check.equal(times(err, "the first of the 3 processes did all"), 1, err)

-- What fails fails once, whoever it is, and leaves no file and no process.
local function fails(what, ...)
  os.remove(path("no.msh"))
  local failed, _, said = run(3, recipe, "output=" .. path("no.msh"), ...)
  check.that(failed ~= 0, "it did not fail")
  check.equal(times(said, what), 1, said)
  check.that(not bytes("no.msh"))
end
fails("a recipe that ends", "fail=before")
fails("quality.below_limit", "fail=proof")
fails("/nowhere/", "output=/nowhere/no.msh")
local bad, _, usage = run(3, "--nonsense")
check.that(bad ~= 0)
check.equal(times(usage, "unknown option"), 1, usage)
bad, _, usage = run(2, "-j", "2", recipe)
check.that(bad ~= 0)
check.equal(times(usage, "goes without mpirun"), 1, usage)

-- Nothing is left beside the files but what they are.
local list = io.popen(("ls -A '%s'"):format(params.scratch))
for name in list:lines() do
  check.that(name:match("^mesh%.") or name:match("%.txt$") or name:match("%.lua$"), name .. " was left")
end
list:close()
check.done()
