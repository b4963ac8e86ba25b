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
  binary = true, parts = "", order = 1, quality = "" }
print "started"
local part = lacuna.synthetic.prism { sides = 6, twist = 20, drop = { "wall_1" } }
local void = part:open_volume {}
if p.fail == "before" then error "a recipe that ends" end
if p.whole then
  void:sweep { layers = p.layers, size = p.size }:write(p.output)
else
  local write = not p.output:find "vtu" and { binary = p.binary } or {}
  if p.parts ~= "" then
    write.partitions, write.ghosts = math.tointeger(tonumber(p.parts)) or p.parts, 1
  end
  if p.quality ~= "" then write.quality = p.quality end
  local report = void:sweep_to(p.output, { layers = p.layers, size = p.size, order = p.order, write = write,
    min_scaled_jacobian = p.fail == "proof" and 0.999 or nil, improve = p.fail ~= "proof" })
  assert(report.streamed)
  print(report.processes, report.hexes)
end
]])
end

-- Two volumes side by side; and where asked for, one of them held, since its cells are moved.
local assembly = path("assembly.recipe.lua")
do
  local file <close> = assert(io.open(assembly, "w"))
  file:write([[
local lacuna = require "lacuna"
local p = lacuna.params { output = "", layers = 12, size = 0.3, fail = "", held = false, binary = true }
local function open(name, shape)
  shape.sides, shape.height, shape.taper = 6, 2, 0.7
  if p.held then shape.twist = 15 end
  return lacuna.synthetic.prism(shape):open_volume { source = "source", target = "target", walls = "auto",
    name = name }
end
local core = open("core", {})
local ring = open("ring", { radius = 2, holes = 1, hole_radius = 1, drop = { "wall_2" } })
if p.held then p.layers, p.size = nil, 0.4 end
local report = lacuna.assembly { core, ring }:sweep_to(p.output, { layers = p.layers, size = p.size,
  write = not p.output:find "inp" and not p.output:find "vtu" and { binary = p.binary } or {},
  min_scaled_jacobian = p.fail == "proof" and 0.999 or nil, improve = p.fail ~= "proof" })
assert(report.streamed == not p.held)
print(report.processes, report.hexes)
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

-- Several volumes, and where one is held.
for _, name in ipairs { "assembly.msh", "assembly.vtu", "assembly.inp", "held.msh" } do
  for _, binary in ipairs { "true", "false" } do
    local held = name == "held.msh"
    local first
    for _, count in ipairs { 1, 2, 4 } do
      os.remove(path(name))
      local code, out, err = run(count, assembly, "output=" .. path(name), "binary=" .. binary,
        "held=" .. tostring(held))
      check.equal(code, 0, err)
      check.equal(tonumber(out:match("^(%d+)")), held and 1 or count)
      check.equal(err, "")
      first = first or bytes(name)
      check.that(#first > 1000 and bytes(name) == first, name .. " of " .. count)
    end
  end
  os.remove(path(name))
end

-- Layers in several parts, so that each has some: cells with a field, with one that compares each with the
-- mean of all processes' cells, and of order 2.
for _, own in ipairs { "size=0.02", "size=0.02 quality=relative_size_squared", "size=0.05 order=2" } do
  local one
  for _, count in ipairs { 1, 2, 4 } do
    local code, out, err = run(count, "--verbose", recipe, "output=" .. path("large.msh"), "layers=60", own)
    check.equal(code, 0, err)
    check.equal(tonumber(out:match("started%s+(%d+)")), count, own)
    one = one or bytes("large.msh")
    check.that(bytes("large.msh") == one, own .. ": large.msh of " .. count)
    if count > 1 then check.that(err:find("of " .. count .. " processes sent %d+ messages"), err) end
  end
  os.remove(path("large.msh"))
end

-- In parts: the same whoever makes them; as many as processes where that is asked for.
do
  local parts = { "parts.msh", "parts.pvtu", "parts_0.vtu", "parts_1.vtu", "parts_2.vtu", "parts_3.vtu" }
  local first = {}
  for _, count in ipairs { 1, 2, 4 } do
    for _, name in ipairs { "parts.msh", "parts.pvtu" } do
      local code, _, err = run(count, recipe, "output=" .. path(name), "parts=4")
      check.equal(code, 0, err)
    end
    for _, name in ipairs(parts) do
      first[name] = first[name] or bytes(name)
      check.that(first[name] and bytes(name) == first[name], name .. " of " .. count)
    end
    local code, _, err = run(count, recipe, "output=" .. path("own.pvtu"))
    check.equal(code, 0, err)
    check.equal(times(bytes("own.pvtu"), "<Piece "), count)
    code, _, err = run(count, recipe, "output=" .. path("own.msh"), "parts=processes")
    check.equal(code, 0, err)
    for p = 0, 3 do os.remove(path("own_" .. p .. ".vtu")) end
    for _, name in ipairs { "own.pvtu", "own.msh" } do os.remove(path(name)) end
  end
  for _, name in ipairs(parts) do os.remove(path(name)) end
end

-- What is sent, by layers and processes: the plan of the layers and the skin's, nothing for a cell.
do
  local sent = {}
  print "layers  processes  hexahedra  messages  bytes"
  for _, layers in ipairs { 40, 80 } do
    for _, size in ipairs { 0.08, 0.04 } do
      for _, count in ipairs { 2, 4 } do
        local code, out, err = run(count, "--verbose", recipe, "output=" .. path("large.vtk"),
          "layers=" .. layers, "size=" .. size)
        check.equal(code, 0, err)
        local hexes = tonumber(out:match("started%s+%d+%s+(%d+)"))
        local messages, all = err:match("processes sent (%d+) messages, (%d+) bytes")
        print(("%6d  %9d  %9d  %8s  %s"):format(layers, count, hexes, messages, all))
        sent[#sent + 1] = { layers = layers, size = size, count = count, hexes = hexes,
          bytes = tonumber(all) / (count - 1), messages = tonumber(messages) / (count - 1) }
      end
    end
  end
  -- Half the size has four times the cells and twice the rim: bytes a layer grow as the rim.
  local function a_layer(size, count)
    local low, high
    for _, row in ipairs(sent) do
      if row.size == size and row.count == count then low, high = high and low or row, row end
    end
    check.equal(low.messages, high.messages)
    return (high.bytes - low.bytes) / (high.layers - low.layers), high.hexes / high.layers
  end
  for _, count in ipairs { 2, 4 } do
    local coarse, few = a_layer(0.08, count)
    local fine, many = a_layer(0.04, count)
    check.that(many > 3.5 * few and fine < 2.3 * coarse, ("%g and %g bytes a layer"):format(coarse, fine))
  end
  os.remove(path("large.vtk"))
end

-- A process that is killed while files are written ends all, and nothing is left of any file.
do
  local killed = 0
  for _, name in ipairs { "killed.msh", "killed.vtk", "killed.pvtu" } do
    local command = ("%s --oversubscribe --allow-run-as-root -q -n 3 %s %s output=%s layers=400 size=0.01"
      .. " binary=false > %s 2>&1 & echo $!"):format(params.mpirun, params.lacuna, recipe, path(name),
      path("out.txt"))
    local started = io.popen(command)
    local mpirun = started:read "l"
    started:close()
    -- The last of its children is killed as soon as a file is open in the folder.
    local watch = ([[
folder=$(cd '%s' && pwd -P)
for i in $(seq 600); do
  for child in $(cat /proc/%s/task/%s/children 2>/dev/null); do
    if ls -l /proc/$child/fd 2>/dev/null | grep -q "$folder/.*deleted\|$folder/\.killed"; then
      for other in $(cat /proc/%s/task/%s/children); do last=$other; done
      sleep 0.3; kill -9 $last && echo killed; break 2
    fi
  done
  kill -0 %s 2>/dev/null || break
  sleep 0.02
done
while kill -0 %s 2>/dev/null; do sleep 0.05; done]]):format(params.scratch, mpirun, mpirun, mpirun, mpirun,
      mpirun, mpirun)
    local script <close> = assert(io.open(path("watch.txt"), "w"))
    script:write(watch)
    script:flush()
    local ran = io.popen("sh " .. path("watch.txt"))
    killed = killed + times(ran:read "a", "killed")
    ran:close()
    check.that(not bytes(name), name .. " is there")
  end
  check.equal(killed, 3, "nobody was killed while files were written")
end

-- A process that is killed, cancelled or runs out of room, whichever and whenever: nobody is left waiting,
-- nothing of a file, and what went wrong is told once, with the name of the file.
do
  local script = path("broken.txt")
  do
    local file <close> = assert(io.open(script, "w"))
    file:write([[
# usage: sh broken.txt SIGNAL RANK SECONDS COMMAND …: sends one of the processes a signal
signal=$1 rank=$2 seconds=$3; shift 3
"$@" & started=$!
sleep $seconds
child=$(cat /proc/$started/task/$started/children | cut -d ' ' -f $((rank + 1)))
test -n "$child" && kill -$signal $child && echo sent
wait $started; echo "code $?"]])
  end
  local start = ("%s --oversubscribe --allow-run-as-root -q -n 3 "):format(params.mpirun)
  local function broken(signal, rank, seconds)
    local name = path("broken.vtk")
    local command = ("timeout -k 5 120 sh %s %s %d %g %s %s %s output=%s layers=150 size=0.02 2> %s"):format(
      script, signal, rank, seconds, start, params.lacuna, assembly, name, path("err.txt"))
    local ran = io.popen(command)
    local said = ran:read "a"
    ran:close()
    local what = ("%s to %d after %g s: %s%s"):format(signal, rank, seconds, said, bytes("err.txt"))
    local code = tonumber(said:match "code (%d+)")
    if code == 0 then os.remove(name) return false end -- it was done before
    check.that(code, "it did not end; " .. what)
    check.that(not bytes("broken.vtk"), what)
    check.that(times(bytes("err.txt"), "lacuna:") <= 1, what)
    return said:find "sent" ~= nil
  end
  local met = 0
  for rank = 0, 2 do
    for _, seconds in ipairs { 0.2, 0.6, 1.2 } do met = met + (broken("KILL", rank, seconds) and 1 or 0) end
    met = met + (broken("INT", rank, 1) and 1 or 0)
  end
  check.that(met > 3, "nobody was met at work")

  -- One of them may write 10 MB to a file, the others more.
  local limited = path("limited.txt")
  do
    local file <close> = assert(io.open(limited, "w"))
    file:write 'rank=$1; shift\ntest "$OMPI_COMM_WORLD_RANK" = "$rank" && ulimit -f 20480\nexec "$@"\n'
  end
  for rank = 0, 2 do
    local command = ("timeout -k 5 120 %s sh %s %d %s %s output=%s layers=60 size=0.02 2> %s"):format(start,
      limited, rank, params.lacuna, assembly, path("full.vtk"), path("err.txt"))
    local _, _, code = os.execute(command)
    local said = bytes("err.txt")
    check.equal(code, 1, said)
    check.equal(times(said, "cannot write '" .. path("full.vtk"):gsub("%p", "%%%0") .. "'"), 1, said)
    check.equal(times(said, "io.write_failed"), 1, said)
    check.that(rank == 0 or said:find("process " .. rank + 1 .. " of 3", 1, true), said)
    check.that(not bytes("full.vtk"), said)
  end
end

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
check.equal(times(usage, "cannot be used with mpirun"), 1, usage)

-- Nothing is left beside the files but what they are.
local list = io.popen(("ls -A '%s'"):format(params.scratch))
for name in list:lines() do
  check.that(name:match("^mesh%.") or name:match("%.txt$") or name:match("%.lua$"), name .. " was left")
end
list:close()
check.done()
