-- SPDX-License-Identifier: MIT
-- polyMesh folders: the rules of OpenFOAM's checkMesh, over generated meshes; which folders are replaced.
-- usage: lacuna openfoam.lua lacuna=PROGRAM scratch=FOLDER
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "lacuna", scratch = "." }
local case = params.scratch .. "/polyMesh"
os.execute(("rm -rf '%s' '%s/.polyMesh'*"):format(case, params.scratch))

local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end
local function exists(path)
  local file = io.open(path, "rb")
  if file then file:close() end
  return file ~= nil
end

-- The text of a file behind its header, which must be OpenFOAM's.
local function body(folder, object, class)
  local text = read(folder .. "/" .. object)
  local header, rest = text:match "^FoamFile\n(%b{})\n(.*)$"
  check.that(header, object .. ": no header")
  local fields = {}
  for key, value in header:gmatch "(%w+)%s+([^;]+);" do fields[key] = value end
  check.equal(fields.version, "2.0")
  check.equal(fields.format, "ascii")
  check.equal(fields.class, class)
  check.equal(fields.object, object)
  check.equal(fields.location, '"constant/polyMesh"')
  return rest, fields.note
end

-- The entries of a list, whose length stands before it.
local function list(folder, object, class, pattern)
  local text, note = body(folder, object, class)
  local count, inside = text:match "^%s*(%d+)%s*\n%((.*)%)%s*$"
  local entries = {}
  for entry in inside:gmatch(pattern) do entries[#entries + 1] = entry end
  check.equal(#entries, tonumber(count), object)
  return entries, note
end
local function numbers(text)
  local found = {}
  for word in text:gmatch "[^%s]+" do found[#found + 1] = assert(tonumber(word), word) end
  return found
end

local function keys_of(of)
  local keys = {}
  for key in pairs(of) do keys[#keys + 1] = key end
  return keys
end

local function sub(a, b) return { a[1] - b[1], a[2] - b[2], a[3] - b[3] } end
local function cross(a, b)
  return { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] }
end
local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end

-- Read a polyMesh and check the rules of checkMesh: { cells =, points =, patches = { name = faces }, zones =,
-- volume = }.
local function checked(folder, what)
  local points = list(folder, "points", "vectorField", "%(([^()]+)%)\n")
  for i, text in ipairs(points) do points[i] = numbers(text) end
  local faces = list(folder, "faces", "faceList", "%d%([^()]+%)\n")
  for i, text in ipairs(faces) do
    local count, inside = text:match "^(%d)%((.+)%)\n$"
    faces[i] = numbers(inside)
    check.equal(#faces[i], tonumber(count), what)
  end
  local owner, note = list(folder, "owner", "labelList", "%d+")
  local neighbour, same = list(folder, "neighbour", "labelList", "%d+")
  for _, of in ipairs { owner, neighbour } do
    for i, word in ipairs(of) do of[i] = tonumber(word) end
  end
  check.equal(#owner, #faces, what)
  local cells = 0
  for _, cell in ipairs(owner) do cells = math.max(cells, cell + 1) end
  local expected = ('"nPoints:%d nCells:%d nFaces:%d nInternalFaces:%d"'):format(#points, cells, #faces,
    #neighbour)
  check.equal(note, expected, what)
  check.equal(same, expected, what)

  -- Upper triangular: the owner is the lower cell, and faces go by owner and then by neighbour.
  for f = 1, #neighbour do
    check.that(owner[f] < neighbour[f], what .. ": owner < neighbour")
    if f > 1 then
      check.that(owner[f - 1] < owner[f] or owner[f - 1] == owner[f] and neighbour[f - 1] < neighbour[f],
        what .. ": upper-triangular order")
    end
  end

  -- No point is unused; no face is there twice.
  local used, known = {}, {}
  for _, face in ipairs(faces) do
    local key = { table.unpack(face) }
    for _, p in ipairs(face) do
      check.that(p >= 0 and p < #points, what)
      used[p] = true
    end
    table.sort(key)
    key = table.concat(key, " ")
    check.that(not known[key], what .. ": a face twice")
    known[key] = true
    for k = 2, #face do check.that(face[k] ~= face[k - 1], what) end
  end
  for p = 0, #points - 1 do check.that(used[p], what .. ": an unused point") end

  -- Areas and centres of faces; those of a cell add up to nothing, and its volume is positive.
  local sums, volumes, middles, counts = {}, {}, {}, {}
  for c = 0, cells - 1 do sums[c], volumes[c], middles[c], counts[c] = { 0, 0, 0 }, 0, { 0, 0, 0 }, 0 end
  local areas, centres = {}, {}
  for f, face in ipairs(faces) do
    local centre, area = { 0, 0, 0 }, { 0, 0, 0 }
    for _, p in ipairs(face) do
      for axis = 1, 3 do centre[axis] = centre[axis] + points[p + 1][axis] / #face end
    end
    for k, p in ipairs(face) do
      local next_point = points[face[k % #face + 1] + 1]
      local part = cross(sub(points[p + 1], centre), sub(next_point, centre))
      for axis = 1, 3 do area[axis] = area[axis] + part[axis] / 2 end
    end
    areas[f], centres[f] = area, centre
    for _, at in ipairs { { owner[f], 1 }, { neighbour[f], -1 } } do
      local c, sign = at[1], at[2]
      if c then
        for axis = 1, 3 do
          sums[c][axis] = sums[c][axis] + sign * area[axis]
          middles[c][axis] = middles[c][axis] + centre[axis]
        end
        volumes[c] = volumes[c] + sign * dot(area, centre) / 3
        counts[c] = counts[c] + 1
      end
    end
  end
  local volume = 0
  for c = 0, cells - 1 do
    check.that(counts[c] == 6 or counts[c] == 5, what .. ": faces of a cell")
    check.that(volumes[c] > 0, what .. ": a cell's volume")
    for axis = 1, 3 do
      check.near(sums[c][axis], 0, 1e-9 * volumes[c] ^ (2 / 3) + 1e-14)
      middles[c][axis] = middles[c][axis] / counts[c]
    end
    volume = volume + volumes[c]
  end
  -- Faces look out of their owner.
  for f = 1, #faces do
    check.that(dot(areas[f], sub(centres[f], middles[owner[f]])) > 0, what .. ": a face looks into its owner")
    if neighbour[f] then
      check.that(dot(areas[f], sub(middles[neighbour[f]], middles[owner[f]])) > 0, what)
    end
  end

  -- Patches follow each other and are all of the faces outside.
  local text = body(folder, "boundary", "polyBoundaryMesh")
  local count = tonumber(text:match "^%s*(%d+)")
  local patches, next_face, found = {}, #neighbour, 0
  for name, inside in text:gmatch "\n%s+(%S+)\n%s+(%b{})" do
    check.that(name:match "^%a[%w_.-]*$", "a word of OpenFOAM: " .. name)
    check.that(not patches[name], what .. ": a patch twice")
    check.equal(inside:match "type%s+(%w+);", "patch")
    check.equal(tonumber(inside:match "startFace%s+(%d+);"), next_face, what)
    patches[name] = tonumber(inside:match "nFaces%s+(%d+);")
    check.that(patches[name] > 0, what)
    next_face, found = next_face + patches[name], found + 1
  end
  check.equal(found, count, what)
  check.equal(next_face, #faces, what)

  local zones
  if exists(folder .. "/cellZones") then
    zones = {}
    local all, of = body(folder, "cellZones", "regIOobject"), {}
    for name, inside in all:gmatch "\n(%S+)\n(%b{})" do
      local size, cells_of = inside:match "List<label>\n(%d+)\n%((.*)%)\n;"
      local labels = numbers(cells_of)
      check.equal(#labels, tonumber(size), what)
      for _, c in ipairs(labels) do
        check.that(not of[c] and c < cells, what .. ": a cell in two zones")
        of[c] = name
      end
      zones[name] = #labels
    end
    check.equal(tonumber(all:match "^%s*(%d+)"), #keys_of(zones), what)
  end
  return { cells = cells, patches = patches, zones = zones, volume = volume, points = #points }
end

-- --- a family: every class, with holes, bends, tapers; each replaces the one before it

local function drop(...) return { sides = 6, twist = 20, drop = { ... } } end
local family = {
  { "prism", drop(), { layers = 4, size = 0.3 } },
  { "prism", drop "walls", { layers = 3, size = 0.3 } },
  { "prism", drop("wall_1", "wall_2", "wall_3"), { layers = 4, size = 0.3 } },
  { "prism", drop "wall_2", { layers = 5, size = 0.4 } },
  { "prism", drop "target", { layers = 1, size = 0.3 } },
  { "prism", drop("source", "target"), { layers = 2, size = 0.3 } },
  { "prism", { sides = 8, holes = 2 }, { layers = 3, size = 0.2 } },
  { "prism", { taper = 0.6, twist = 30 }, { layers = { 0.1, 0.3, 1 }, size = 0.3 } },
  { "prism", { sides = 4, height = 3, bend = 40 }, { layers = 12, size = 0.3 } },
  { "elbow", { angle = 90 }, { layers = 12, size = 0.3 } },
  { "plate", {}, { layers = 1, size = 0.3 } },
}
for sides = 3, 12 do family[#family + 1] = { "prism", { sides = sides }, { layers = 2, size = 0.4 } } end
for i, member in ipairs(family) do
  local what = ("%s %d"):format(member[1], i)
  local mesh = lacuna.synthetic[member[1]](member[2]):open_volume { name = "fluid" }:sweep(member[3])
  mesh:write(case)
  local found = checked(case, what)
  check.equal(found.cells, mesh.hexes, what)
  check.equal(found.points, mesh.nodes, what)
  check.near(found.volume, mesh.fidelity.volume, 1e-6 * mesh.fidelity.volume)
  check.that(found.patches.source and found.patches.target and not found.zones, what)
end

-- --- names of faces are patches, whatever they are called; two names stay two

do
  local model = lacuna.model()
  local corners = { { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 2 } }
  local names = { "inlet 1", "inlet_1", "3 walls; {all}", "outlet" }
  for side = 1, 4 do
    local a, b = corners[side], corners[side % 4 + 1]
    model:add_face { name = names[side], cells = { { 1, 2, 3, 4 } },
      points = { { a[1], a[2], 0 }, { b[1], b[2], 0 }, { b[1], b[2], 1 }, { a[1], a[2], 1 } } }
  end
  model:add_face { name = "low", cells = { { 1, 2, 3, 4 } },
    points = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 } } }
  local volume = model:open_volume { source = "low", walls = names }
  volume:sweep { layers = 2, size = 1 }:write(case)
  local patches = checked(case, "names").patches
  local list_of = keys_of(patches)
  table.sort(list_of)
  check.equal(#list_of, 6, table.concat(list_of, " "))
  for _, name in ipairs { "inlet_1", "inlet_1_2", "outlet" } do check.equal(patches[name], 4, name) end
end

-- --- wedges; several volumes are zones

local function block(name, x, triangles)
  local model = lacuna.model()
  local function quads(face, a, b, c, d)
    model:add_face { name = face, points = { a, b, c, d }, cells = { { 1, 2, 3, 4 } } }
  end
  local base = { { x, 0 }, { x + 2, 0 }, { x + 2, 2 }, { x, 2 } }
  for side = 1, 4 do
    local a, b = base[side], base[side % 4 + 1]
    quads("wall_" .. side, { a[1], a[2], 0 }, { b[1], b[2], 0 }, { b[1], b[2], 2 }, { a[1], a[2], 2 })
  end
  model:add_face { name = "low", keep_mesh = triangles, cells = triangles and { { 1, 3, 2 }, { 1, 4, 3 } }
    or { { 1, 2, 3, 4 } }, points = { { x, 0, 0 }, { x + 2, 0, 0 }, { x + 2, 2, 0 }, { x, 2, 0 } } }
  return model:open_volume { name = name, source = "low", walls = { "wall_1", "wall_2", "wall_3", "wall_4" } }
end
do
  local mesh = block("one", 0, true):sweep { wedges = true, layers = 3 }
  check.that(mesh.wedges > 0)
  mesh:write(case)
  check.equal(checked(case, "wedges").cells, mesh.hexes + mesh.wedges)
  local two = lacuna.assembly { block("core", 0), block("far core", 2) }:sweep { size = 0.5, layers = 4 }
  two:write(case)
  local found = checked(case, "two volumes")
  check.equal(found.cells, two.hexes)
  check.that(found.zones.core and found.zones.far_core)
  check.equal(found.zones.core + found.zones.far_core, two.hexes)
  check.near(found.volume, 16, 1e-9)
end

-- --- meshes in other files, by `lacuna convert`

do
  local mesh = lacuna.synthetic.prism(drop()):open_volume { name = "fluid" }:sweep { layers = 3, size = 0.4 }
  for _, ending in ipairs { "msh", "vtu", "exo" } do
    local file = params.scratch .. "/of." .. ending
    mesh:write(file)
    lacuna.convert(file, case)
    check.equal(checked(case, ending).cells, mesh.hexes)
  end
end

-- --- what is refused

do
  local volume = lacuna.synthetic.prism(drop()):open_volume {}
  local curved = volume:sweep { layers = 2, size = 0.5, order = 2 }
  check.fails(function() curved:write(case) end, "order = 1", "io.no_such_element")
  check.equal(checked(case, "the one before stays").zones, nil)
  local mesh = lacuna.synthetic.prism(drop()):open_volume {}:sweep { layers = 2, size = 0.5 }
  check.fails(function() mesh:write(case, { quality = true }) end, "quality", "lua.idle_option")
  -- The folders of a case are made.
  local deep = params.scratch .. "/case_made/constant/polyMesh"
  os.execute(("rm -rf '%s/case_made'"):format(params.scratch))
  mesh:write(deep)
  check.that(exists(deep .. "/owner"))
  check.write(params.scratch .. "/plain", "a file")
  check.fails(function() mesh:write(params.scratch .. "/plain/polyMesh") end, "there is no folder")
  check.fails(function() lacuna.synthetic.prism(drop()):open_volume {}:sweep_to(case, { layers = 2 }) end,
    "lua.not_layered")
  -- A folder that holds anything else is not replaced.
  check.write(case .. "/results.txt", "weeks of work")
  check.fails(function() mesh:write(case) end, "results.txt", "io.not_replaced")
  check.equal(read(case .. "/results.txt"), "weeks of work")
  os.remove(case .. "/results.txt")
  check.write(case .. "/points.gz", "of an older mesh")
  mesh:write(case)
  check.that(not exists(case .. "/points.gz"))
  checked(case, "replaced")
  os.execute(("rm -rf '%s'"):format(case))
  check.write(case, "a file")
  check.fails(function() mesh:write(case) end, "not a folder", "io.not_replaced")
  os.remove(case)
  mesh:write(case)
  checked(case, "new")
  local left = io.popen(("ls -A '%s' | grep unfinished"):format(params.scratch)):read("a")
  check.equal(left, "", "left behind")
end

-- The three mouths of a tee are three patches, although two of them are one end.
if lacuna.gmsh_version ~= "none" then
  local path = params.scratch .. "/tee.geo"
  local geo <close> = assert(io.open(path, "w"))
  geo:write [[
SetFactory("OpenCASCADE");
Cylinder(1) = {-60, 0, 0, 120, 0, 0, 20};
Cylinder(2) = {0, 0, 0, 0, 0, 60, 14};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
]]
  geo:close()
  local tee = lacuna.load(path)
  tee:open_volume({ faces = { kind = "cylinder" } }):sweep({ size = 6 }):write(case)
  local areas = {}
  for name in pairs(checked(case, "tee").patches) do
    if not name:find "^wall" then areas[#areas + 1] = name end
  end
  check.equal(#areas, 3, table.concat(areas, " "))
end

check.done()
