-- SPDX-License-Identifier: MIT
-- Cups: a flat end whose fillet and cylinder it runs into smoothly, a ledge and a neck with a missing mouth.
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")

local R, around = 10, 48

--- Faces of a profile of { r, z } turned about the z axis.
local function turned(model, name, profile)
  local points, cells = {}, {}
  for _, p in ipairs(profile) do
    for k = 0, around - 1 do
      local a = 2 * math.pi * k / around
      points[#points + 1] = { p[1] * math.cos(a), p[1] * math.sin(a), p[2] }
    end
  end
  for i = 1, #profile - 1 do
    for k = 0, around - 1 do
      local a, b = (i - 1) * around + k + 1, (i - 1) * around + (k + 1) % around + 1
      cells[#cells + 1] = { a, b, b + around }
      cells[#cells + 1] = { a, b + around, a + around }
    end
  end
  model:add_face { name = name, points = points, cells = cells }
end

local function cup(fillet, length, ledge)
  local model = lacuna.model()
  local points, cells = { { 0, 0, 0 } }, {}
  for k = 0, around - 1 do
    local a = 2 * math.pi * k / around
    points[#points + 1] = { (R - fillet) * math.cos(a), (R - fillet) * math.sin(a), 0 }
    cells[k + 1] = { 1, (k + 1) % around + 2, k + 2 }
  end
  model:add_face { name = "floor", points = points, cells = cells }
  local arc = {}
  for i = 0, 8 do
    local t = math.pi / 2 * i / 8
    arc[i + 1] = { R - fillet + fillet * math.sin(t), fillet * (1 - math.cos(t)) }
  end
  turned(model, "fillet", arc)
  local walls, high = { "fillet" }, fillet + length
  if length > 0 then
    turned(model, "cylinder", { { R, fillet }, { R, fillet + length / 2 }, { R, high } })
    walls[2] = "cylinder"
  end
  if ledge > 0 then
    turned(model, "ledge", { { R, high }, { R - ledge, high } })
    turned(model, "neck", { { R - ledge, high }, { R - ledge, high + 4 } })
    walls[#walls + 1], walls[#walls + 2] = "ledge", "neck"
  end
  return model:open_volume { source = "floor", walls = walls }
end

local members, runs = 0, check.members_to_run(7) -- three of 20
for _, fillet in ipairs { 3, 4, 5, 6, 7 } do
  for _, length in ipairs { 0, 4 } do
    for _, ledge in ipairs { 0.7, 2 } do
      if not runs() then goto next end
      local volume = cup(fillet, length, ledge)
      assert(volume.class == "IV")
      local mesh = volume:sweep {}
      local quality = mesh:quality()
      local member = ("fillet %g, length %g, ledge %g: least scaled Jacobian %.3f"):format(fillet, length,
        ledge, quality.min_scaled_jacobian)
      assert(quality.certified and quality.min_scaled_jacobian > 0.25, member)
      assert(tostring(mesh.report):find("an end meets ", 1, true), member)
      members = members + 1
      ::next::
    end
  end
end
assert(members == (check.whole and 20 or 3))

-- A cup that is deeper than wide, and one whose walls go on smoothly up to the mouth, keep their roles.
for _, volume in ipairs { cup(5, 30, 2), cup(5, 8, 0) } do
  volume:close {}
  assert(tostring(volume:tree()):find('"fillet", wall', 1, true), "the fillet is a wall")
end
print(members .. " cups")

-- A dome is divided for the sweep, and is one face of the solid again, where there is CAD.
local has_cad, version = pcall(function() return lacuna.gmsh_version end)
if has_cad and version then
  local path = os.tmpname()
  local function made(script)
    local file <close> = assert(io.open(path .. ".geo", "w"))
    file:write('SetFactory("OpenCASCADE"); ', script)
    file:close()
    return lacuna.load(path .. ".geo")
  end
  local dome = made("Sphere(1) = { 0, 0, 0, 1, 0, Pi/2 }; Delete { Volume{1}; } Delete { Surface{2}; }")
    :open_volume()
  dome:close {}
  local written = dome:write_cad(path .. ".step")
  check.equal(written.faces, 2)
  check.near(written.volume, 2 / 3 * math.pi, 1e-6)

  -- Test tubes: cells where wall and bottom are tangent would be flat at small sizes, so pieces are swept.
  for _, length in ipairs { 20, 60 } do
    local tube = made(("Cylinder(1) = { 0, 0, 0, 0, 0, %g, 10 }; Sphere(2) = { 0, 0, 0, 10, -Pi/2, 0 };"
      .. "BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };"):format(length))
    local faces = {}
    for _, face in ipairs(tube:faces()) do
      if face.kind ~= "plane" then faces[#faces + 1] = face end
    end
    for _, size in ipairs { 4, 2 } do
      local mesh = tube:open_volume { faces = faces }:sweep { size = size }
      local quality = mesh:quality()
      check.that(quality.certified and quality.min_scaled_jacobian > 0.3, quality.min_scaled_jacobian)
      local exact = math.pi * 100 * (length + 20 / 3)
      check.near(quality.volume, exact, 0.02 * exact)
    end
  end

  -- With a limit that no mesh meets, all partitions are tried, and the refusal is about the limit.
  if check.whole then
    local tube = made("Cylinder(1) = { 0, 0, 0, 0, 0, 104.5, 10 }; Sphere(2) = { 0, 0, 0, 10, -Pi/2, 0 };"
      .. "BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };")
    local fine, why = pcall(function() tube:open_volume {}:sweep { size = 8, min_scaled_jacobian = 0.99 } end)
    check.that(not fine and why.code == "quality.below_limit", tostring(why))
  end

  -- A tube with a branch has no bottom that blends into its walls: an end there has a rim.
  local tee = made("Cylinder(1) = { -8, 0, 0, 16, 0, 0, 3 }; Cylinder(2) = { 0, 0, 0, 0, 0, 8, 2 };"
    .. "BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };")
  local round = {}
  for _, face in ipairs(tee:faces()) do
    if face.kind ~= "plane" then round[#round + 1] = face end
  end
  local volume = tee:open_volume { faces = round }
  check.equal(volume.class, "V")
  check.that(volume:sweep { size = 1 }:quality().min_scaled_jacobian > 0.3)
  -- Between two bent tubes, both ends are divided alike, at circles that seams connect to the rims.
  local tubes = ""
  for i, r in ipairs { 17, 25 } do
    tubes = tubes .. ("Circle(%d) = { 0, 0, -40, %g }; a[] = Extrude { 0, 0, 40 } { Curve{%d}; };"
      .. "b[] = Extrude { { 0, 1, 0 }, { 100, 0, 0 }, Pi/2 } { Curve{a[0]}; };"
      .. "c[] = Extrude { 40, 0, 0 } { Curve{b[0]}; };"):format(100 * i, r, 100 * i)
  end
  local jacket = made(tubes):open_volume { source = { 1, 2, 3 }, target = { 4, 5, 6 } }
  local quality = jacket:sweep { size = 6, layers = 3 }:quality()
  check.that(quality.min_scaled_jacobian > 0.5, "jacket: " .. quality.min_scaled_jacobian)
  local exact = math.pi * (25 ^ 2 - 17 ^ 2) * (80 + 50 * math.pi)
  check.that(math.abs(quality.volume / exact - 1) < 0.01, "jacket: " .. quality.volume)

  -- A domed shell is swept through its thickness between the ends that are named: its rim is a wall.
  for _, axes in ipairs { { 1, 1, 1 }, { 1, 1, 1.5 }, { 1, 1, 0.7 }, { 1.4, 1, 1 } } do
    local shell = ("Dilate { {0,0,0}, { %g, %g, %g } } { Volume{1}; }"):format(table.unpack(axes))
    local model = made("Sphere(1) = { 0, 0, 0, 20, 0, Pi/2 }; Sphere(2) = { 0, 0, 0, 15, 0, Pi/2 };"
      .. "BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }" .. shell)
    local by_area = model:faces()
    table.sort(by_area, function(a, b) return a.area > b.area end)
    local outer, inner, rim = table.unpack(by_area)
    local mesh = model:open_volume { source = outer, target = inner, walls = rim }:sweep { size = 3 }
    local found = mesh:quality()
    check.that(found.certified and found.min_scaled_jacobian > 0.5, found.min_scaled_jacobian)
    local whole = 2 / 3 * math.pi * (20 ^ 3 - 15 ^ 3) * axes[1] * axes[2] * axes[3]
    check.that(math.abs(found.volume / whole - 1) < 0.02, found.volume / whole)
  end

  for _, ending in ipairs { "", ".geo", ".step" } do os.remove(path .. ending) end
end
