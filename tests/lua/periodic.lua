-- SPDX-License-Identifier: MIT
-- Periodic faces: the same mesh on both, node for node, and what the files say about it.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }

local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end

-- The nodes of an ASCII MSH 2.2 file, its $Periodic: { slave = entity, master = entity, affine = 16 numbers,
-- { slave, master }, … } each, and its text.
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
      links[#links + 1] = { slave = numbers[2], master = numbers[3] }
    elseif #numbers == 16 then
      links[#links].affine = numbers
    elseif #numbers == 2 then
      table.insert(links[#links], numbers)
    end
  end
  return nodes, links, text
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

-- A unit cube, whose faces in `given` have kept quads: { across, up, bend = how far nodes inside are moved,
-- rim = how far those of the first row are }.
local cube_faces = {
  source = function(s, t) return { s, t, 0 } end, target = function(s, t) return { s, t, 1 } end,
  wall_1 = function(s, t) return { s, 0, t } end, wall_2 = function(s, t) return { 1, s, t } end,
  wall_3 = function(s, t) return { s, 1, t } end, wall_4 = function(s, t) return { 0, s, t } end }
local function given_quads(place, given)
  local across, up = given[1], given[2]
  local points, cells = {}, {}
  for j = 0, up do
    for i = 0, across do
      local s, t = i / across, j / up
      local bend = (given.bend or 0) * s * (1 - s) * t * (1 - t)
      local rim = (given.rim or 0) * s * (1 - s) * (1 - t)
      points[#points + 1] = place(s + bend * math.sin(7 * s + 3 * t) + rim, t + bend * math.cos(5 * s - t))
    end
  end
  for j = 0, up - 1 do
    for i = 1, across do
      local a = j * (across + 1) + i
      cells[#cells + 1] = { a, a + 1, a + across + 2, a + across + 1 }
    end
  end
  return points, cells
end
local function cube(given)
  local model = lacuna.model()
  for _, name in ipairs { "source", "target", "wall_1", "wall_2", "wall_3", "wall_4" } do
    local place = cube_faces[name]
    local points, cells = { place(0, 0), place(1, 0), place(1, 1), place(0, 1) }, { { 1, 2, 3 }, { 1, 3, 4 } }
    if given[name] then points, cells = given_quads(place, given[name]) end
    model:add_face { name = name, points = points, cells = cells, keep_mesh = given[name] ~= nil }
  end
  return model:open_volume { source = "source", target = "target", walls = "auto" }
end

-- A quad by its nodes, whichever is the first and whichever way round they go.
local function quad_key(a, b, c, d)
  local nodes = { a, b, c, d }
  table.sort(nodes)
  return table.concat(nodes, " ")
end
local function place_key(p) return ("%a,%a,%a"):format(p[1] + 0.0, p[2] + 0.0, p[3] + 0.0) end
local function quad_of(a, b, c, d)
  return quad_key(place_key(a), place_key(b), place_key(c), place_key(d))
end

-- Given quads of one face, or the same ones of both: they stay bit for bit, and the image has them too.
for _, ends in ipairs { { "source", "target", 4, 3 }, { "wall_1", "wall_3", 3, 4 },
  { "wall_1", "wall_2", 4, 3 } } do -- the last by a turn about their common edge
  for _, faces in ipairs { { 1 }, { 2 }, { 1, 2 } } do
    local given = {}
    for _, f in ipairs(faces) do given[ends[f]] = { ends[3], ends[4], bend = 0.8 } end
    -- Between walls that meet, the image of a bent grid runs the other way across: not the same quads.
    if not (ends[2] == "wall_2" and #faces == 2) then
      local name = ("given_%s_%s_%d"):format(ends[1], ends[2], #faces == 1 and faces[1] or 12)
      local mesh = cube(given):sweep { size = 0.5, layers = ends[1] == "source" and 3 or nil,
        periodic = { { ends[1], ends[2] } } }
      check.that(mesh:quality().certified)
      check.equal(check_pairs(mesh, name, 1, 3 ^ 0.5), (ends[3] + 1) * (ends[4] + 1), name)
      local nodes, links, text = periodic_of(mesh, name)
      local quads, places = {}, {}
      for entity, a, b, c, d in text:gmatch("\n%d+ 3 %d+ %d+ (%d+) (%d+) (%d+) (%d+) (%d+)") do
        a, b, c, d = tonumber(a), tonumber(b), tonumber(c), tonumber(d)
        entity = tonumber(entity)
        quads[entity] = quads[entity] or {}
        table.insert(quads[entity], { a, b, c, d })
        places[quad_of(nodes[a], nodes[b], nodes[c], nodes[d])] = true
      end
      local image, images = {}, {}
      for _, pair in ipairs(links[1]) do image[pair[2]] = pair[1] end
      for _, q in ipairs(quads[links[1].slave]) do images[quad_key(q[1], q[2], q[3], q[4])] = true end
      check.equal(#quads[links[1].slave], ends[3] * ends[4], name)
      check.equal(#quads[links[1].master], ends[3] * ends[4], name)
      for _, q in ipairs(quads[links[1].master]) do
        check.that(images[quad_key(image[q[1]], image[q[2]], image[q[3]], image[q[4]])], name)
      end
      for _, f in ipairs(faces) do
        local points, cells = given_quads(cube_faces[ends[f]], given[ends[f]])
        for _, c in ipairs(cells) do
          check.that(places[quad_of(points[c[1]], points[c[2]], points[c[3]], points[c[4]])],
            name .. ": a given quad is lost")
        end
      end
    end
  end
end

-- Given quads that differ inside, in number, or on the rim; quads of one face that the other cannot have.
do
  local function fails(given, pair, options, ...)
    options.periodic = { pair }
    local message = check.fails(function() cube(given):sweep(options) end, ...)
    check.that(not message:find("mixed", 1, true), "is refused with 'periodic': " .. message)
  end
  local ends, walls = { "source", "target" }, { "wall_1", "wall_3" }
  fails({ source = { 4, 4, bend = 0.8 }, target = { 4, 4, bend = 0.5 } }, ends, { size = 0.5, layers = 3 },
    '"source"', '"target"', "keep_mesh = false", "[sweep.periodic_given]")
  fails({ source = { 4, 4 }, target = { 5, 4 } }, ends, { size = 0.5, layers = 3 }, "5 given nodes",
    "6 others", "keep_mesh = false", "[sweep.periodic_given]")
  fails({ wall_1 = { 4, 3, bend = 0.8 }, wall_3 = { 4, 3 } }, walls, { size = 0.5 }, '"wall_1"', '"wall_3"',
    "[sweep.periodic_given]")
  fails({ wall_1 = { 4, 3 }, wall_3 = { 4, 4 } }, walls, { size = 0.5 }, "given nodes",
    "[sweep.periodic_given]")
  fails({ wall_1 = { 4, 3, rim = 0.2 }, wall_3 = { 4, 3 } }, walls, { size = 0.5 }, "given nodes",
    "[sweep.periodic_given]")
  fails({}, { "source", "wall_1" }, { size = 0.2, rows = 2, row_height = 0.05 }, '"source"', '"wall_1"',
    "[sweep.periodic_unlike]")
  fails({}, { "source", "wall_1" }, { quads = "paved", size = function(x, y) return 0.1 + 0.3 * (x + y) end },
    '"source"', '"wall_1"', 'quads = "mapped"', "[sweep.periodic_unlike]")
end

-- A sector in two members, whose cut sides are one of each: equal under the turn of the whole.
do
  local function sector(angle, centre)
    local model = lacuna.model()
    local function at(r, k, z)
      local turn = math.rad(k * angle / 2)
      return { centre[1] + r * math.cos(turn), centre[2] + r * math.sin(turn), z }
    end
    local function face(name, ...)
      model:add_face { name = name, points = { ... }, cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
    end
    for k = 0, 2 do face("cut_" .. k, at(1, k, 0), at(2.5, k, 0), at(2.2, k, 1), at(1.2, k, 1)) end
    for k = 0, 1 do
      local n = k + 1
      face("low_" .. n, at(1, k, 0), at(2.5, k, 0), at(2.5, n, 0), at(1, n, 0))
      face("high_" .. n, at(1.2, k, 1), at(2.2, k, 1), at(2.2, n, 1), at(1.2, n, 1))
      face("in_" .. n, at(1, k, 0), at(1, n, 0), at(1.2, n, 1), at(1.2, k, 1))
      face("out_" .. n, at(2.5, k, 0), at(2.5, n, 0), at(2.2, n, 1), at(2.2, k, 1))
    end
    local members = {}
    for n = 1, 2 do
      members[n] = model:open_volume { name = "part_" .. n, source = "low_" .. n, target = "high_" .. n,
        walls = { "cut_" .. n - 1, "cut_" .. n, "in_" .. n, "out_" .. n } }
    end
    return lacuna.assembly(members)
  end
  for _, angle in ipairs { 40, 51.7, 90 } do
    for _, centre in ipairs { { 0, 0 }, { 37, -12 } } do
      for order = 1, 2 do
        local turn = { { centre[1], centre[2], 0 }, { 0, 0, 1 }, angle }
        local pair = { "cut_0", "cut_2", rotate = order == 2 and turn or nil } -- found or given
        local mesh = sector(angle, centre):sweep { size = 0.3, order = order, periodic = { pair } }
        check.that(mesh:quality().certified)
        local low, high = { math.huge, math.huge, math.huge }, { -math.huge, -math.huge, -math.huge }
        local nodes, links = periodic_of(mesh, "sector")
        for _, p in pairs(nodes) do
          for i = 1, 3 do low[i], high[i] = math.min(low[i], p[i]), math.max(high[i], p[i]) end
        end
        local diagonal = ((high[1] - low[1]) ^ 2 + (high[2] - low[2]) ^ 2 + (high[3] - low[3]) ^ 2) ^ 0.5
        check.that(check_pairs(mesh, "sector", 1, diagonal) >= 20)
        -- Under the exact turn, from one cut side to the other.
        local c, s = math.cos(math.rad(angle)), math.sin(math.rad(angle))
        for _, link in ipairs(links[1]) do
          local from, to = nodes[link[2]], nodes[link[1]]
          local x, y = from[1] - centre[1], from[2] - centre[2]
          check.near(y, 0, 1e-12 * diagonal)
          check.near(to[1], centre[1] + c * x - s * y, 1e-12 * diagonal)
          check.near(to[2], centre[2] + s * x + c * y, 1e-12 * diagonal)
          check.near(to[3], from[3], 1e-12 * diagonal)
        end
      end
    end
  end
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

-- With a deck: pairs are of the deck's nodes, whatever its scale; beside it stand cells that have no pairs.
do
  local base = params.scratch .. "/gap"
  local prism = lacuna.synthetic.prism { sides = 4, height = 3 }
  local rest = prism:open_volume { source = "source", target = "target", walls = "auto" }
  local low, high = table.unpack(rest:cut { plane = { { 0, 0, 1 }, { 0, 0, 1 } } })
  local middle, top = table.unpack(high:cut { plane = { { 0, 0, 2 }, { 0, 0, 1 } } })
  local blocks = lacuna.assembly({ low, middle, top }):sweep { size = 0.5, layers = 2 }
  blocks:write(base .. ".inp")
  for _, scale in ipairs { 1, 1000 } do
    local deck = lacuna.load(base .. ".inp", { without = blocks.regions[2], scale = scale })
    local mesh = deck:open_volume { source = "cut_1", target = "cut_2", name = "filler" }
      :sweep { periodic = { { "cut_1", "cut_2" } } }
    mesh:write(base .. "_joined.inp", { with = deck })
    mesh:write(base .. "_joined.msh", { with = deck, version = 2.2, binary = false })
    check.that(read(base .. "_joined.msh"):find "%$Periodic\n[1-9]")
    local text, at = read(base .. "_joined.inp"), {}
    for node, x, y, z in text:match("%*NODE\n([^*]*)"):gmatch "(%d+), ([^,]+), ([^,]+), ([^,\n]+)\n" do
      at[node] = { tonumber(x), tonumber(y), tonumber(z) }
    end
    local sides = {}
    for k, side in ipairs { "a", "b" } do
      sides[k] = {}
      for node in text:match("NSET=periodic_1_" .. side .. "\n([^*]*)"):gmatch "%d+" do
        table.insert(sides[k], at[node])
      end
    end
    check.that(#sides[1] > 4 and #sides[1] == #sides[2])
    for k, p in ipairs(sides[1]) do
      local q = sides[2][k]
      for axis, by in ipairs { 0, 0, 1 } do check.near(q[axis] - p[axis], by, 1e-12) end
    end
    check.that(text:find "%*EQUATION\n3\n")
    local x, y, z = text:match "%*NODE, NSET=periodic_1\n%d+, (%S+), (%S+), (%S+)\n"
    check.near(math.abs(tonumber(x)) + math.abs(tonumber(y)) + math.abs(tonumber(z) - 1), 0, 1e-12)
  end
end

-- Directions of cells, in the files that have them.
do
  local part = lacuna.synthetic.prism { sides = 6, radius = 1, height = 1 }
  local mesh = part:open_volume { source = "source", target = "target", walls = "auto", name = "bar" }:sweep {
    layers = 2, size = 0.5 }
  local base = params.scratch .. "/bar"
  for ending, word in pairs { [".vtu"] = 'Name="column" NumberOfComponents="3"',
    [".vtk"] = "VECTORS column double",
    [".exo"] = "tangential_z", [".inp"] = "*ORIENTATION, NAME=bar_orientation", [".bdf"] = "MATCID,1,",
    [".feb"] = '<ElementData type="mat_axis" elem_set="bar">' } do
    mesh:write(base .. ending, { orientation = true })
    check.that(read(base .. ending):find(word, 1, true), ending)
  end
  local _, steps = read(base .. ".exo"):gsub("time_whole", "")
  check.equal(steps, 1)  -- names of arrays are unique
  for e, x, y, z in read(base ..
    ".inp"):gmatch("\n(%d+), ([^,\n]+), ([^,\n]+), ([^,\n]+), [^,\n]+, [^,\n]+, [^,\n]+\n") do
    check.near(tonumber(x), 0, 1e-12)
    check.near(tonumber(y), 0, 1e-12)
    check.near(math.abs(tonumber(z)), 1, 1e-12)
  end
  local number = 0 -- FEBio counts the elements of a part
  local row = '<elem lid="(%d+)"><a>[^,]+,[^,]+,([^<]+)</a><d>([^<]+)</d></elem>'
  for lid, z, x in read(base .. ".feb"):gmatch(row) do
    number = number + 1
    check.equal(tonumber(lid), number)
    check.near(math.abs(tonumber(z)), 1, 1e-12)
    check.near(tonumber(x:match "[^,]+$"), 0, 1e-12)
  end
  check.equal(number, mesh.hexes)
  check.fails(function() mesh:write(base .. ".msh", { orientation = true }) end, "orientation")
end

-- Directions of cells along helices about a slanted axis: those of the exact curves, and at right angles.
do
  local u, v, w = { 2 / 3, -2 / 3, 1 / 3 }, { 1 / 3, 2 / 3, 2 / 3 }, { -2 / 3, -1 / 3, 2 / 3 }
  local origin = { 5, -3, 2 }
  local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end
  local function cross(a, b)
    return { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] }
  end
  local function unit(a)
    local length = dot(a, a) ^ 0.5
    return { a[1] / length, a[2] / length, a[3] / length }, length
  end
  local function same(found, exact, tolerance)
    for i = 1, 3 do check.near(found[i], exact[i], tolerance) end
  end
  local function numbers(text)
    local found = {}
    for word in text:gmatch("%S+") do found[#found + 1] = tonumber(word) end
    return found
  end

  local function check_helix(radius, pitch, turns, layers)
    local model, points = lacuna.model(), {}
    for k = 1, 4 do
      local a = math.pi / 2 * k + 0.3
      local x, z = radius + 0.5 * math.cos(a), 0.5 * math.sin(a)
      points[k] = {}
      for i = 1, 3 do points[k][i] = origin[i] + x * u[i] + z * w[i] end
    end
    model:add_face { name = "source", points = points, cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
    local mesh = model:open_volume { source = "source",
      along = { helix = { origin, w, pitch, turns } } }:sweep { size = 0.3, layers = layers }
    local path = params.scratch .. "/helix.vtk"
    mesh:write(path, { orientation = true, binary = false })
    local text = read(path)
    local nodes = numbers(text:match("POINTS %d+ double\n(.-)\n%u"))
    local cells = numbers(text:match("\nCELLS %d+ %d+\n(.-)\n%u"))
    local fields = {}
    for _, name in ipairs { "column", "axis", "radial", "tangential" } do
      fields[name] = numbers(text:match("VECTORS " .. name .. " double\n([^%u]*)"))
    end
    local function from_axis(p) return { dot(p, u), dot(p, v), dot(p, w) } end
    local way = turns > 0 and 1 or -1
    local step = 2 * math.pi * turns / mesh.layers
    -- The tangent of the helix through a point, which turns one way and rises.
    local function tangent(p) return (unit { -way * p[2], way * p[1], pitch / (2 * math.pi) }) end
    local at, cell, checked = 1, 0, 0
    while at <= #cells do
      cell = cell + 1
      if cells[at] == 8 then
        checked = checked + 1
        local function direction(name)
          local f = fields[name]
          return from_axis { f[3 * cell - 2], f[3 * cell - 1], f[3 * cell] }
        end
        local low = { -dot(origin, u), -dot(origin, v), -dot(origin, w) }
        for k = 1, 4 do
          local n = 3 * cells[at + k]
          local p = from_axis { nodes[n + 1], nodes[n + 2], nodes[n + 3] }
          for i = 1, 3 do low[i] = low[i] + p[i] / 4 end
        end
        -- The section was in a half plane through the axis: its angle is that of each of its points.
        local angle = math.atan(low[2], low[1])
        local full = math.floor((2 * math.pi * low[3] / pitch * way - angle) / (2 * math.pi) + 0.5)
        local half = angle + step / 2
        local r = (low[1] ^ 2 + low[2] ^ 2) ^ 0.5
        local middle = { r * math.cos(half), r * math.sin(half),
          low[3] + math.abs(step) / 2 * pitch / (2 * math.pi) }
        local centre = { radius * math.cos(half), radius * math.sin(half),
          way * (half + 2 * math.pi * full) * pitch / (2 * math.pi) }
        local axis = tangent(centre)
        local arm = { middle[1] - centre[1], middle[2] - centre[2], middle[3] - centre[3] }
        local along = dot(arm, axis)
        for i = 1, 3 do arm[i] = arm[i] - along * axis[i] end
        local radial, length = unit(arm)
        same(direction "column", tangent(middle), 1e-12)
        same(direction "axis", axis, 1e-12)
        check.that(length > 0.05, "a cell at the centroid has any radial direction")
        same(direction "radial", radial, 1e-12)
        same(direction "tangential", cross(axis, radial), 1e-12)
        check.near(dot(direction "column", direction "column"), 1, 1e-12)
        local own = { direction "axis", direction "radial", direction "tangential" }
        for i = 1, 3 do
          for j = 1, 3 do check.near(dot(own[i], own[j]), i == j and 1 or 0, 1e-12) end
        end
      end
      at = at + cells[at] + 1
    end
    check.equal(checked, mesh.hexes)
  end
  check_helix(2, 3, 1.3, 40)
  check_helix(2, 3, 1.3, 13)
  check_helix(4, 1.6, 3.1)
  check_helix(3, 2, -0.7, 30) -- left-handed
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
  -- Faces that are nearly equal: the equations would hold between nodes that do not fit.
  for off, fits in pairs { [1e-9] = true, [1e-3] = false, [0.01] = false } do
    local corners = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, off, 1 },
      { 1, 1, 1 }, { 0, 1, 1 } }
    local cube = lacuna.model()
    for name, face in pairs { low = { 1, 4, 3, 2 }, top = { 5, 6, 7, 8 }, front = { 1, 2, 6, 5 },
      back = { 4, 8, 7, 3 }, left = { 1, 5, 8, 4 }, right = { 2, 3, 7, 6 } } do
      local points = {}
      for i, k in ipairs(face) do points[i] = corners[k] end
      cube:add_face { name = name, points = points, cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
    end
    local function run()
      return cube:open_volume { source = "low", target = "top", walls = "auto" }:sweep { size = 0.5,
        periodic = { { "left", "right" } } }
    end
    if fits then run() else check.fails(run, "not equal under a translation or rotation") end
  end
end

-- Ends of a CAD body, named by their roles.
do
  local path = params.scratch .. "/block.geo"
  check.write(path, 'SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 3, 2, 4};\n')
  local model = lacuna.load(path)
  local low, high = model:face { facing = { 0, 0, -1 } }, model:face { facing = { 0, 0, 1 } }
  local void = model:open_volume { source = low, target = high, walls = "auto" }
  local mesh = void:sweep { size = 1, periodic = { { "source", "target" } } }
  local _, links = periodic_of(mesh, "by_roles")
  check.equal(#links[1], 12)
end
check.done()
