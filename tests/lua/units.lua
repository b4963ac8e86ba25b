-- SPDX-License-Identifier: MIT
-- Declared units: what files say of them, conversion of STEP, and refusal of decks in different units.
-- usage: lacuna units.lua scratch=FOLDER
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { scratch = ".", lacuna = "", cad = true }
local function at(name) return params.scratch .. "/" .. name end
local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end

lacuna.synthetic.prism { sides = 4 }:open_volume():sweep { layers = 2, size = 0.5 }:write(at "block.exo")
local metres = { um = 1e-6, mm = 1e-3, cm = 1e-2, m = 1, ["in"] = 0.0254, ft = 0.3048 }
local says = { inp = "** lengths are in %s\n", bdf = "$ lengths are in %s\n", k = "$ lengths are in %s\n",
  feb = "<!-- lengths are in %s -->", vtu = "<!-- lengths are in %s -->", vtk = ", lengths are in %s\n",
  msh = "$Comments\nlengths are in %s\n$EndComments\n" }
for unit, length in pairs(metres) do
  local model = lacuna.load(at "block.exo", { unit = unit })
  local void = model:open_volume { along = { vector = { 0, 0, 1 } },
    source = model:face { facing = { 0, 0, 1 } } }
  local mesh = void:sweep { layers = 2 }
  for ending, line in pairs(says) do
    local path = at("u." .. ending)
    mesh:write(path)
    check.that(read(path):find(line:format(unit), 1, true), unit .. " in ." .. ending)
    if ending ~= "feb" then lacuna.check(path) end -- a comment of the format, which is read back
  end
  mesh:write(at "u.unv")
  local factor = read(at "u.unv"):match "\n   164\n[^\n]*\n%s*(%S+)"
  check.near(tonumber((factor:gsub("D", "e"))) * length, 1, 1e-15)
  lacuna.check(at "u.unv")
  -- Exodus declares it, and is read so; lengths are not converted.
  mesh:write(at "u.exo")
  local again = lacuna.load(at "u.exo")
  check.equal(again:info().bounds and again:info().bounds[1][1] or -1, model:info().bounds and
    model:info().bounds[1][1] or -1)
  again:open_volume { source = again:face { facing = { 0, 0, 1 } }, along = { vector = { 0, 0, 1 } } }
    :sweep { layers = 1 }:write(at "v.inp", { with = again })
  check.equal(select(2, read(at "v.inp"):gsub("%*%* lengths are in " .. unit .. "\n", "")), 1, unit)
  -- A deck that is read and written again says it once.
  lacuna.convert(at "v.inp", at "w.inp")
  check.equal(select(2, read(at "w.inp"):gsub("lengths are in", "")), 1, unit)
  -- Streamed files say it too.
  void:sweep_to(at "s.inp", { layers = 2 })
  check.that(read(at "s.inp"):find(says.inp:format(unit), 1, true), "streamed")
  local other = unit == "m" and "mm" or "m"
  check.fails(function() lacuna.load(at "u.exo", { unit = other }) end, "is in " .. unit)
end

-- Different units are not joined; a deck without one takes the other's.
local function beside(unit, name, way)
  local model = lacuna.load(at "block.exo", { unit = unit })
  return model, model:open_volume { source = model:face { facing = { 0, 0, way } }, name = name,
    along = { vector = { 0, 0, way } } }
end
local in_mm, mm = beside("mm", "a", 1)
local in_m, m = beside("m", "b", -1)
local plain = lacuna.load(at "block.exo")
local mesh = mm:sweep { layers = 1 }
check.fails(function() mesh:write(at "x.inp", { with = { in_mm, in_m }, renumber = true }) end,
  "is in mm", "is in m", "declare the same unit")
check.fails(function() mesh:write(at "x.inp", { with = in_m }) end, "is in m")
check.fails(function() lacuna.assembly { mm, m }:sweep { layers = 1 } end, "is in mm", "is in m")
mesh:write(at "x.inp", { with = plain })
check.that(read(at "x.inp"):find("** lengths are in mm\n", 1, true), "the mesh's unit")
check.fails(function() lacuna.load(at "block.exo", { unit = "furlong" }) end, "furlong",
  "um, mm, cm, m, in, ft")

-- STEP states the unit of the model; what is read of it is converted to the unit that is asked for.
if params.cad then
  for unit, length in pairs(metres) do
    local void = lacuna.load(at "block.exo", { unit = unit, scale = 2, keep_mesh = false }):open_volume()
    local path = at("solid_" .. unit .. ".step")
    local written = void:write_cad(path)
    local volume = written.volume
    check.that(volume > 0)
    local function volume_in(other, scale)
      local model = lacuna.load(path, { unit = other, scale = scale })
      return model:open_volume():write_cad(at "again.brep").volume
    end
    check.near(volume_in(unit) / volume, 1, 1e-6)
    check.near(volume_in(nil) * 1e-9 / (volume * length ^ 3), 1, 1e-6) -- Open CASCADE's millimetres
    if unit == "in" then check.near(volume_in("m", 3) / (27 * volume * length ^ 3), 1, 1e-6) end
  end
  lacuna.load(at "solid_in.step"):open_volume():write_cad(at "other.brep")
  check.fails(function() lacuna.load({ at "solid_in.step", at "other.brep" }, { unit = "in" }) end,
    "other.brep states no unit")
end
check.done()
