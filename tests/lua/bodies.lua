-- SPDX-License-Identifier: MIT
-- A file of solids that touch is meshed as it is: a volume for each solid, swept its own way, with common
-- nodes where solids touch. The solids share faces, or each has its own.
-- usage: lacuna bodies.lua scratch=FOLDER lacuna=PROGRAM
local lacuna = require "lacuna"
local check = dofile((arg[0]:match "^(.*[/\\])" or "") .. "check.lua")
local params = lacuna.params { scratch = ".", lacuna = "lacuna", shared = "" }
local pi = math.pi

-- Solids as { volume, text of Gmsh with the tag left open }.
local function box(x, y, z, u, v, w)
  return { u * v * w, ("Box(%%d) = {%g,%g,%g,%g,%g,%g};"):format(x, y, z, u, v, w) }
end
local function rod(x, y, z, u, v, w, r)
  return { pi * r * r * (u * u + v * v + w * w) ^ 0.5,
    ("Cylinder(%%d) = {%g,%g,%g,%g,%g,%g,%g};"):format(x, y, z, u, v, w, r) }
end
local function without(of, ...)
  for _, part in ipairs { ... } do of[1] = of[1] - part[1] end
  return of
end

local families = {}
-- Fibres in a matrix.
for _, count in ipairs { 1, 2, 4, 9 } do
  local side, fibres = math.ceil(count ^ 0.5), {}
  for n = 0, count - 1 do fibres[n + 1] = rod(n % side + 0.5, n // side + 0.5, 0, 0, 0, 3, 0.35) end
  families["fibres " .. count] = { without(box(0, 0, 0, side, side, 3), table.unpack(fibres)),
    table.unpack(fibres) }
end
-- Two plies of fibres with different directions.
do
  local plies = { {}, {} }
  for n = 0, 1 do
    plies[1][n + 1] = rod(0, n + 0.5, 0.5, 2, 0, 0, 0.3)
    plies[2][n + 1] = rod(n + 0.5, 0, 1.5, 0, 2, 0, 0.3)
  end
  families["plies"] = { without(box(0, 0, 0, 2, 2, 1), table.unpack(plies[1])),
    without(box(0, 0, 1, 2, 2, 1), table.unpack(plies[2])),
    plies[1][1], plies[1][2], plies[2][1], plies[2][2] }
end
-- A pin in a plate: flush with both sides, with one end in the plate.
families["pin"] = { without(box(-3, -2, 0, 6, 4, 1), rod(0, 0, 0, 0, 0, 1, 0.8)), rod(0, 0, 0, 0, 0, 1, 0.8) }
families["blind pin"] = { without(box(-3, -2, 0, 6, 4, 1), rod(0, 0, 0.4, 0, 0, 0.6, 0.8)),
  rod(0, 0, 0.4, 0, 0, 0.6, 0.8) }
-- A core in a casting: through it, and all round in it.
for name, core in pairs { core = rod(-3, 0, 0, 6, 0, 0, 1), ["inner core"] = rod(-1, 0, 0, 2, 0, 0, 1) } do
  families[name] = { without(box(-3, -2, -2, 6, 4, 4), core), core }
end
-- A board on standoffs on a base.
families["board"] = { box(0, 0, 0, 8, 5, 0.8), box(0.5, 0.5, 1.8, 7, 4, 0.4) }
for n = 0, 3 do
  table.insert(families["board"], rod(1.5 + 5 * (n % 2), 1.5 + 2 * (n // 2), 0.8, 0, 0, 1, 0.4))
end
-- A gasket between plates.
local ring = [[
Cylinder(1000) = {0,0,1,0,0,0.3,2.2}; Cylinder(1001) = {0,0,1,0,0,0.3,1.6};
BooleanDifference(%d) = { Volume{1000}; Delete; }{ Volume{1001}; Delete; };]]
families["gasket"] = { box(-3, -3, 0, 6, 6, 1), box(-3, -3, 1.3, 6, 6, 1),
  { 0.3 * pi * (2.2 ^ 2 - 1.6 ^ 2), ring } }
-- Cells side by side and on each other.
families["cells"] = {}
for n = 0, 7 do families["cells"][n + 1] = box(n % 2, n // 2 % 2, n // 4, 1, 1, 1) end
-- Solids that do not touch.
families["apart"] = { box(0, 0, 0, 1, 1, 1), rod(3, 0, 0, 0, 0, 2, 0.5), box(5, 0, 0, 1, 2, 1) }

local cuts = { fibres = 1, plies = 2, pin = 1, blind = 1, core = 1, inner = 1 } -- solids that hold others

--- The path of a member of a family.
--- @param form  "shared": solids share faces; "own": each solid has its own.
local function file_of(name, solids, form)
  local lines = { 'SetFactory("OpenCASCADE");' }
  for n, solid in ipairs(solids) do lines[#lines + 1] = solid[2]:format(n) end
  if form == "shared" then
    lines[#lines + 1] = ("BooleanFragments{ Volume{1:%d}; Delete; }{}"):format(#solids)
  else
    local holders = cuts[name:match "^%a+"] or 0
    for n = 1, holders do
      lines[#lines + 1] = ("BooleanDifference{ Volume{%d}; Delete; }{ Volume{%d:%d}; }")
          :format(n, holders + 1, #solids)
    end
  end
  local path = ("%s/%s_%s.geo"):format(params.scratch, (name:gsub(" ", "_")), form)
  check.write(path, table.concat(lines, "\n") .. "\n")
  return path
end

--- The area of the sides of cells that one cell has alone. Nodes of cells are not at the same place.
local function skin_of(mesh)
  local place, seen, uses = {}, {}, {}
  for n = 1, mesh.nodes do
    local x, y, z = mesh:node(n)
    place[n] = { x, y, z }
    local key = ("%d %d %d"):format(x * 1e6 // 1, y * 1e6 // 1, z * 1e6 // 1)
    check.that(not seen[key], "two nodes at " .. key)
    seen[key] = true
  end
  local sides = { { 1, 2, 3, 4 }, { 5, 6, 7, 8 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 4, 8, 7 },
    { 4, 1, 5, 8 } }
  for h = 1, mesh.hexes do
    local cell = { mesh:hex(h) }
    for _, side in ipairs(sides) do
      local own = { cell[side[1]], cell[side[2]], cell[side[3]], cell[side[4]] }
      local sorted = { table.unpack(own) }
      table.sort(sorted)
      local key = table.concat(sorted, " ")
      uses[key] = uses[key] == nil and own or false
    end
  end
  local area = 0
  for _, quad in pairs(uses) do
    if quad then
      local a, b, c, d = place[quad[1]], place[quad[2]], place[quad[3]], place[quad[4]]
      local p, q = { c[1] - a[1], c[2] - a[2], c[3] - a[3] }, { d[1] - b[1], d[2] - b[2], d[3] - b[3] }
      area = area + ((p[2] * q[3] - p[3] * q[2]) ^ 2 + (p[3] * q[1] - p[1] * q[3]) ^ 2
        + (p[1] * q[2] - p[2] * q[1]) ^ 2) ^ 0.5 / 2
    end
  end
  return area
end

--- The volumes of the bodies of a mesh, each by its name; a body may be swept in pieces.
local function volumes_of(mesh, regions)
  local volumes = {}
  for _, name in ipairs(regions) do
    volumes[name] = 0
    for region, of in pairs(mesh.fidelity.regions) do
      local own = region == name or region:find("^" .. name .. "_%d+$")
      volumes[name] = volumes[name] + (own and of.volume or 0)
    end
  end
  return volumes
end

local function check_volumes(mesh, regions, solids, what)
  local volumes, found, expected = volumes_of(mesh, regions), {}, {}
  for n, name in ipairs(regions) do found[n] = volumes[name] end
  for n, solid in ipairs(solids) do expected[n] = solid[1] end
  table.sort(found)
  table.sort(expected)
  check.equal(#found, #expected, what)
  for n, volume in ipairs(expected) do check.near(found[n] / volume, 1, 0.02) end
end

local names = {}
for name in pairs(families) do names[#names + 1] = name end
table.sort(names)
for _, name in ipairs(names) do
  local solids, skin = families[name], 0
  for _, form in ipairs { "shared", "own" } do
    local what = name .. ", " .. form
    local model = lacuna.load(file_of(name, solids, form))
    check.equal(#model.regions, #solids, what)
    local mesh = lacuna.assembly(model:bodies()):sweep { size = 0.5 }
    local quality = mesh:quality()
    check.that(quality.certified and quality.min_scaled_jacobian > 0.2, what .. ": quality")
    check.equal(mesh.hexes, quality.hexes, what)
    check_volumes(mesh, model.regions, solids, what)
    if form == "shared" then
      for _, face in ipairs(model:faces { free = true }) do skin = skin + face.area end
    end
    check.near(skin_of(mesh) / skin, 1, 0.02)
    -- The mesh is a deck of as many bodies.
    if form == "shared" and name ~= "inner core" then
      mesh:write(params.scratch .. "/deck.inp")
      local deck = lacuna.load(params.scratch .. "/deck.inp", { keep_mesh = false })
      check.equal(#deck.regions, #solids, what)
      check_volumes(lacuna.assembly(deck:bodies()):sweep { size = 0.5 }, deck.regions, solids, what)
    end
  end
end

-- Walls are searched on the solid that the ends bound, however many solids are beside it.
do
  local plate = lacuna.load(file_of("pin", families["pin"], "own"))
  for _, place in ipairs { { 0, 0 }, { 2.5, 1.5 } } do
    local x, y = table.unpack(place)
    local pin = x == 0
    local volume = plate:open_volume { source = { near = { x, y, 0 } }, target = { near = { x, y, 1 } },
      walls = "auto" }
    check.near(volume:sweep({ size = 0.4 }).fidelity.volume / families["pin"][pin and 2 or 1][1], 1, 0.02)
  end
  -- A face between two solids does not say which; the remedies work.
  local cells = lacuna.load(file_of("cells", families["cells"], "shared"))
  local between = cells:face { near = { 1, 0.5, 0.5 } }
  local fine, refused = pcall(cells.open_volume, cells, { source = between, walls = "auto" })
  check.that(not fine and refused.code == "topology.walls_ambiguous")
  local region = refused.remedy:match 'region = "([^"]*)"'
  local one = cells:open_volume { faces = { region = region } }
  check.near(one:sweep({ size = 0.5 }).fidelity.volume, 1, 1e-9)
  local named = cells:open_volume { source = between, target = { near = { 0, 0.5, 0.5 } }, walls = "auto" }
  check.near(named:sweep({ size = 0.5 }).fidelity.volume, 1, 1e-9)
end

-- Solids have the names of their physical volumes; solids of one name are told apart, and selected together.
do
  local path = params.scratch .. "/named.geo"
  check.write(path, [[SetFactory("OpenCASCADE");
Box(1) = {0,0,0,1,1,1}; Box(2) = {1,0,0,1,1,1}; Box(3) = {2,0,0,1,1,1}; Box(4) = {3,0,0,1,1,1};
Physical Volume("cell") = {1,3}; Physical Volume("foil") = {2};
]])
  local model = lacuna.load(path)
  check.equal(table.concat(model.regions, " "), "cell_1 foil cell_3 body_4")
  check.equal(#model:faces { region = "cell" }, 12)
  check.equal(#model:faces { region = "cell_3" }, 6)
  check.equal(#lacuna.assembly(model:bodies()):sweep({ size = 1 }).regions, 4)
  -- The command does the same; of one body it fills the void that roles name, as ever.
  local out = params.scratch .. "/named.msh"
  local function run(words)
    return os.execute(("'%s' --quiet fill '%s' '%s' size=1 %s >/dev/null")
        :format(params.lacuna, path, out, words))
  end
  check.that(run "")
  check.equal(table.concat(lacuna.load(out).regions, " "), "cell_1 foil cell_3 body_4")
  check.that(run "source=1 target=2 walls=auto")
  check.equal(#lacuna.load(out).regions, 1)
end

-- Of a body that is cut, the first pieces that can be meshed are taken: cuts cross the kept mesh of a deck.
do
  local path = params.shared .. "/data/fem/nested_cubes.msh"
  if check.exists(path) then
    local model = lacuna.load(path)
    check.equal(#model.regions, 2)
    local mesh = lacuna.assembly(model:bodies()):sweep()
    check.that(mesh:quality().certified)
    check.near(mesh.fidelity.volume / mesh.fidelity.sealed_volume, 1, 1e-9)
  end
end

-- A solid in another one is refused as a body of its own; the space between is filled as before.
do
  local path = params.scratch .. "/overlap.geo"
  check.write(path, 'SetFactory("OpenCASCADE"); Box(1) = {0,0,0,6,6,4}; Box(2) = {2,2,0,2,2,1};\n')
  local model = lacuna.load(path)
  check.fails(function() model:bodies() end, "body_2", "body_1", "topology.bodies_overlap")
  check.near(model:open_volume():sweep({ size = 1 }).fidelity.volume, 140, 1e-9)
  local out = params.scratch .. "/overlap.msh"
  check.that(os.execute(("'%s' --quiet fill '%s' '%s' size=1 >/dev/null"):format(params.lacuna, path, out)))
  check.near(lacuna.check(out).volume, 140, 1e-9)
end

-- Facets: parts that close, a void within one of them; open faces are no body.
do
  local model = lacuna.model()
  local function box(low, high, missing)
    local at = { [0] = low, high }
    local function p(x, y, z) return { at[x], at[y], at[z] } end
    for k, side in ipairs {
      { p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0) }, { p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1) },
      { p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1) }, { p(0, 1, 0), p(0, 1, 1), p(1, 1, 1), p(1, 1, 0) },
      { p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0) }, { p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1) },
    } do
      if k ~= missing then model:add_face { points = side, cells = { { 1, 2, 3, 4 } } } end
    end
  end
  box(0, 3)
  box(1, 2)
  box(5, 6)
  box(8, 9, 1)
  check.equal(table.concat(model.regions, " "), "body_1 body_2")
  local mesh = lacuna.assembly(model:bodies()):sweep { size = 0.5 }
  check.near(mesh.fidelity.volume, 26 + 1, 1e-9)
  check.equal(#lacuna.model().regions, 0)
end

check.done()
