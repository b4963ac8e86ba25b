-- SPDX-License-Identifier: MIT
-- Ducts of square section with bends, whose ends are missing: layers stay straight across the duct, although
-- the edges on the inside of a bend are shorter than those on the outside.
-- usage: lacuna ducts.lua scratch=FOLDER
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local params = lacuna.params { scratch = "." }
local path = params.scratch .. "/duct.geo"

--- The volume of a duct of 8 x 6 along the path, by its name. Each part of the path is a length or a bend in
--- degrees, whose middle radius is 12. The duct starts along z and bends about y.
local function duct(name, parts)
  local lines = { 'SetFactory("OpenCASCADE");', "Rectangle(1) = {-4, -3, 0, 8, 6};" }
  local x, z, turned, surface, volumes = 0, 0, 0, "1", {}
  for i, part in ipairs(parts) do
    local a = math.rad(turned)
    local along = { math.sin(a), math.cos(a) } -- x and z
    local move
    if part.length then
      move = ("{%.12g, 0, %.12g}"):format(part.length * along[1], part.length * along[2])
      x, z = x + part.length * along[1], z + part.length * along[2]
    else
      local side = part.bend > 0 and 1 or -1
      local cx, cz = x + 12 * side * along[2], z - 12 * side * along[1]
      local b = math.rad(part.bend)
      move = ("{ {0, 1, 0}, {%.12g, 0, %.12g}, %.12g }"):format(cx, cz, b)
      local dx, dz = x - cx, z - cz
      x, z = cx + dx * math.cos(b) + dz * math.sin(b), cz - dx * math.sin(b) + dz * math.cos(b)
      turned = turned + part.bend
    end
    lines[#lines + 1] = ("out%d[] = Extrude %s { Surface{%s}; };"):format(i, move, surface)
    surface, volumes[i] = ("out%d[0]"):format(i), ("out%d[1]"):format(i)
  end
  lines[#lines + 1] = ("BooleanUnion{ Volume{%s}; Delete; }{ Volume{%s}; Delete; }"):format(
    volumes[1], table.concat(volumes, ", ", 2))
  check.write(path, table.concat(lines, "\n") .. "\n")
  local model = lacuna.load(path)
  local walls = {}
  for _, face in ipairs(model:faces()) do
    local near = function(px, pz)
      return math.abs(face.centroid[1] - px) < 1e-6 and math.abs(face.centroid[3] - pz) < 1e-6
    end
    if not (face.kind == "plane" and math.abs(face.area - 48) < 1e-6 and (near(0, 0) or near(x, z))) then
      walls[#walls + 1] = face
    end
  end
  check.equal(#walls, #model:faces() - 2, name)
  return model:open_volume { walls = walls }
end

local ducts = {
  elbow = { { length = 10 }, { bend = 90 }, { length = 100 } },
  u = { { length = 60 }, { bend = 180 }, { length = 60 } },
  s = { { length = 40 }, { bend = 90 }, { length = 40 }, { bend = -90 }, { length = 40 } },
  crank = { { length = 20 }, { bend = 90 }, { length = 40 }, { bend = 90 }, { length = 5 }, { bend = -90 },
    { length = 70 } },
}
for name, parts in pairs(ducts) do
  local volume = 0
  for _, part in ipairs(parts) do
    volume = volume + 48 * (part.length or 12 * math.rad(math.abs(part.bend)))
  end
  for _, size in ipairs { 1.5, 3 } do
    local quality = duct(name, parts):sweep({ size = size }):quality()
    check.near(quality.volume, volume, 0.01 * volume)
    check.that(quality.min_scaled_jacobian > 0.8, ("%s at %g: %g"):format(name, size,
      quality.min_scaled_jacobian))
    check.that(quality.mean_scaled_jacobian > 0.95, name)
  end
end

--- The lines of a .geo file for a duct of a x b with a bend between two legs; `name` begins its names.
local function bent(name, rectangle, a, b)
  local lines = ("Rectangle(N) = {X, Y, 0, A, B}; la[] = Extrude {0, 0, 20} { Surface{N}; };"
    .. "lb[] = Extrude { {0, 1, 0}, {12, 0, 20}, Pi / 2 } { Surface{la[0]}; };"
    .. "lc[] = Extrude {60, 0, 0} { Surface{lb[0]}; };"
    .. "all[] = BooleanUnion{ Volume{la[1]}; Delete; }{ Volume{lb[1], lc[1]}; Delete; };\n")
  local values = { N = rectangle, X = -a / 2, Y = -b / 2, A = a, B = b }
  return (lines:gsub("%f[%w][NXYAB]%f[%W]", values):gsub("%f[%w](%l+)%[", name .. "%1["))
end

-- A closed duct is swept from side to side: the rows of its flat bent sides stay straight across the bend.
-- With its wall, it is swept along as well.
local inner, outer = bent("i", 101, 8, 6), bent("o", 102, 14, 12)
local kernel, whole = 'SetFactory("OpenCASCADE");\n', 80 + 6 * math.pi
check.write(path, kernel .. inner)
for _, size in ipairs { 1.5, 3 } do
  local quality = lacuna.load(path):open_volume():sweep({ size = size }):quality()
  check.near(quality.volume / (48 * whole), 1, 0.01)
  check.that(quality.min_scaled_jacobian > 0.95,
    ("across at %g: %g"):format(size, quality.min_scaled_jacobian))
end
check.write(path, kernel .. inner .. outer
  .. "BooleanFragments{ Volume{iall[]}; Delete; }{ Volume{oall[]}; Delete; }\n")
local both = lacuna.assembly(lacuna.load(path):bodies()):sweep({ size = 1.5 }):quality()
check.near(both.volume / (14 * 12 * whole), 1, 0.01)
check.that(both.min_scaled_jacobian > 0.6 and both.mean_scaled_jacobian > 0.95, both.min_scaled_jacobian)
check.done()
