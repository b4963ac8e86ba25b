-- SPDX-License-Identifier: MIT
-- Periodic faces: the same mesh on both, node for node, and what the files say about it.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }

local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end

-- The nodes of an ASCII MSH 2.2 file, and its $Periodic: { affine = 16 numbers, { slave, master }, … } each.
local function periodic_of(mesh, name)
  local path = params.scratch .. "/" .. name .. ".msh"
  mesh:write(path, { version = 2.2, binary = false })
  local text = read(path)
  local nodes, links = {}, {}
  for tag, x, y, z in text:match("%$Nodes\n%d+\n(.-)%$EndNodes"):gmatch("(%d+) (%S+) (%S+) (%S+)\n") do
    nodes[tonumber(tag)] = { tonumber(x), tonumber(y), tonumber(z) }
  end
  local section = text:match("%$Periodic\n%d+\n(.-)%$EndPeriodic")
  check.that(section, name .. " has no $Periodic")
  for line in section:gmatch("[^\n]+") do
    local numbers = {}
    for word in line:gmatch("%S+") do numbers[#numbers + 1] = tonumber(word) end
    if #numbers == 3 then
      links[#links + 1] = {}
    elseif #numbers == 16 then
      links[#links].affine = numbers
    elseif #numbers == 2 then
      table.insert(links[#links], numbers)
    end
  end
  return nodes, links
end

-- The image of a point under an affine map, and whether it is a translation.
local function moved(affine, p)
  local q = {}
  for i = 1, 3 do
    local row = 4 * (i - 1)
    q[i] = affine[row + 1] * p[1] + affine[row + 2] * p[2] + affine[row + 3] * p[3] + affine[row + 4]
  end
  return q
end

-- All pairs are equal: bit for bit after a translation, else up to rounding. @return  the number of pairs
local function check_pairs(mesh, name, links_expected, size)
  local nodes, links = periodic_of(mesh, name)
  check.equal(#links, links_expected, name)
  local count = 0
  for _, link in ipairs(links) do
    local a = link.affine
    local shifts = a[1] == 1 and a[6] == 1 and a[11] == 1
    local slaves = {}
    for _, pair in ipairs(link) do
      check.that(not slaves[pair[1]], "a node twice")
      slaves[pair[1]] = true
      count = count + 1
      local there, here = moved(a, nodes[pair[2]]), nodes[pair[1]]
      for i = 1, 3 do
        if shifts then check.equal(here[i], there[i], name)
        else check.near(here[i], there[i], 1e-12 * size) end
      end
    end
  end
  return count, links
end

-- Prisms over polygons, all pairs at once: walls that face each other, and the ends. No translation of a
-- hexagon
-- is along an axis, and corners have three images.
local runs = check.members_to_run(3)
for _, sides in ipairs { 4, 6 } do
  for _, holes in ipairs { 0, 1 } do
    for _, options in ipairs { { layers = 3 }, { size = 0.7 }, { size = 0.9, order = 2,
      serendipity = true } } do
      if sides == 4 and holes == 1 or runs() then
        local part = lacuna.synthetic.prism { sides = sides, radius = 2.1, height = 1.7, holes = holes }
        local void = part:open_volume { source = "source", target = "target", walls = "auto" }
        options.periodic = { { "source", "target" } }
        for w = 1, sides // 2 do
          table.insert(options.periodic, { "wall_" .. w, "wall_" .. w + sides // 2 })
        end
        local name = ("prism_%d_%d"):format(sides, holes)
        local mesh = void:sweep(options)
        check.that(mesh:quality().certified)
        check.that(check_pairs(mesh, name, 1 + sides // 2, 5) > 20, name)
        check.that(tostring(mesh.report):find("periodic: %d+ pairs of nodes"))
      end
    end
  end
end

-- A sector swept round an axis: the ends are equal under a rotation, which is found.
do
  local model = lacuna.model()
  model:add_face { name = "source", points = { { 1, 0, 0 }, { 2, 0, 0 }, { 2.3, 0, 0.7 }, { 1.1, 0, 1 } },
    cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
  for _, degrees in ipairs { 30, 51.7, 120 } do
    local void = model:open_volume { source = "source",
      along = { axis = { { 0, 0, 0 }, { 0, 0, 1 } }, angle = degrees } }
    local mesh = void:sweep { size = 0.3, periodic = { { "source", "target" } } }
    local _, links = check_pairs(mesh, "turned", 1, 4)
    local turn = links[1].affine
    check.near(turn[1], math.cos(math.rad(degrees)), 1e-9)
    check.near(math.abs(turn[5]), math.sin(math.rad(degrees)), 1e-9)
    check.near(turn[11], 1, 1e-9)
  end
end

-- Two boxes side by side: faces of two volumes, and pairs of several faces.
do
  local function box(model, name, x0, x1)
    local p = {}
    for k = 0, 7 do p[k] = { k % 2 == 0 and x0 or x1, k // 2 % 2, k // 4 } end
    local function face(tag, a, b, c, d)
      model:add_face { name = name .. tag, points = { p[a], p[b], p[c], p[d] }, cells = { { 1, 2, 3 }, { 1,
        3, 4 } } }
    end
    face("_z0", 0, 2, 3, 1) face("_z1", 4, 5, 7, 6) face("_y0", 0, 1, 5, 4) face("_y1", 2, 6, 7, 3)
    if name == "left" then face("_x0", 0, 4, 6, 2) face("_x1", 1, 3, 7, 5) else face("_x1", 1, 3, 7, 5) end
  end
  local model = lacuna.model()
  box(model, "left", 0, 1)
  box(model, "right", 1, 1.7)
  local function volume(name, source, target, walls)
    return model:open_volume { name = name, source = source, target = target, walls = walls }
  end
  -- The left box is swept along z, the right one along y, so that the mesh of a wall becomes that of a wall.
  local left = volume("left", "left_z0", "left_z1", { "left_y0", "left_y1", "left_x0", "left_x1" })
  local right = volume("right", "right_y0", "right_y1", { "right_z0", "right_z1", "right_x1", "left_x1" })
  local both = lacuna.assembly { left, right }
  local mesh = both:sweep { size = 0.22, periodic = { { "left_x0", "right_x1" },
    { { "left_y0", "right_y0" }, { "left_y1", "right_y1" } }, { { "left_z0", "right_z0" },
      { "left_z1", "right_z1" }, translate = { 0, 0, 1 } } } }
  check.that(mesh:quality().certified)
  check.that(check_pairs(mesh, "boxes", 5, 2) > 100)
end

-- What the other formats say: sets in the order of the pairs, equations, a cyclic symmetry.
do
  local part = lacuna.synthetic.prism { sides = 4, radius = 1, height = 1 }
  local void = part:open_volume { source = "source", target = "target", walls = "auto" }
  local mesh = void:sweep { layers = 2, size = 0.7, periodic = { { "wall_1", "wall_3" }, { "wall_2",
    "wall_4" },
    { "source", "target" } } }
  local base = params.scratch .. "/cell"
  for _, ending in ipairs { ".inp", ".bdf", ".unv", ".vtu", ".vtk", ".exo", ".msh" } do mesh:write(base ..
    ending) end
  local text = read(base .. ".inp")
  -- Each node depends at most once, and depends on no node that depends itself.
  local dependent, used = {}, {}
  for terms, line in text:gmatch("%*EQUATION\n(%d+)\n([^*]*)") do
    local t = 0
    for node, direction, factor in line:gmatch("(%d+), (%d), ([^,\n]+)") do
      t = t + 1
      local key = node .. "." .. direction
      check.that(tonumber(factor))
      if t == 1 then
        check.that(not dependent[key], key .. " depends twice")
        dependent[key] = true
      else
        used[key] = true
      end
    end
    check.equal(t, tonumber(terms))
  end
  for key in pairs(used) do check.that(not dependent[key], key .. " is used and depends") end
  for p = 1, 3 do
    check.that(text:find("*NODE, NSET=periodic_" .. p .. "\n", 1, true))
    check.that(text:find("*NSET, NSET=periodic_" .. p .. "_a\n", 1, true))
    check.that(read(base .. ".unv"):find("periodic_" .. p .. "_b", 1, true))
    check.that(read(base .. ".exo"):find("periodic_" .. p .. "_b", 1, true))
    check.that(read(base .. ".vtu"):find("nodes:periodic_" .. p .. "_b", 1, true))
  end
  check.that(read(base .. ".bdf"):find("\nMPC,1,%d+,1,1%.,%d+,1,%-1%."))
  check.that(read(base .. ".msh"):find("$Periodic", 1, true))
  lacuna.load(base .. ".msh") -- and it is read again
end

-- Directions of cells, in the files that have them.
do
  local part = lacuna.synthetic.prism { sides = 6, radius = 1, height = 1 }
  local mesh = part:open_volume { source = "source", target = "target", walls = "auto", name = "bar" }:sweep {
    layers = 2, size = 0.5 }
  local base = params.scratch .. "/bar"
  for ending, word in pairs { [".vtu"] = 'Name="column" NumberOfComponents="3"',
    [".vtk"] = "VECTORS column double",
    [".exo"] = "tangential_z", [".inp"] = "*ORIENTATION, NAME=bar_orientation", [".bdf"] = "MATCID,1," } do
    mesh:write(base .. ending, { orientation = true })
    check.that(read(base .. ending):find(word, 1, true), ending)
  end
  for e, x, y, z in read(base ..
    ".inp"):gmatch("\n(%d+), ([^,\n]+), ([^,\n]+), ([^,\n]+), [^,\n]+, [^,\n]+, [^,\n]+\n") do
    check.near(tonumber(x), 0, 1e-12)
    check.near(tonumber(y), 0, 1e-12)
    check.near(math.abs(tonumber(z)), 1, 1e-12)
  end
  check.fails(function() mesh:write(base .. ".msh", { orientation = true }) end, "orientation")
end

-- What is refused says why.
do
  local part = lacuna.synthetic.prism { sides = 4, radius = 1, height = 1, taper = 0.8 }
  local void = part:open_volume { source = "source", target = "target", walls = "auto" }
  local function fails(periodic, ...)
    check.fails(function() void:sweep { size = 0.5, periodic = periodic } end, ...)
  end
  fails({ { "source", "target" } }, "not equal under a translation or rotation")
  fails({ { "source", "wall_1" } }, "not equal under a translation or rotation")
  fails({ { "wall_1", "wall_3", translate = { 0, 0, 1 } } }, "not equal")
  fails({ { "source", "lid" } }, "periodic", "lid")
  fails({ { "source" } }, "{ face, face")
  fails({ { "wall_1", "wall_3", rotate = { 1 } } }, "{ face, face")
  fails({ { "wall_1", "wall_3", rotate = { { 0, 0, 0 }, { 0, 0, 0 }, 90 } } }, "direction")
  check.fails(function()
    void:sweep { size = 0.5, fallback = "mixed", periodic = { { "wall_1", "wall_3" } } }
  end, "mixed")
end

check.done()
