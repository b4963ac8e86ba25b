-- SPDX-License-Identifier: MIT
-- Volumes that no single sweep fills: cut into pieces that are swept, or filled with tetrahedra.
local lacuna = require "lacuna"
local folder = arg[0]:match("^(.*/)") or "./"
local check = dofile(folder .. "check.lua")
local params = lacuna.params { scratch = ".", lacuna = "lacuna" }

local function path(name) return params.scratch .. "/" .. name end

--- A model of flat faces, each an array of corners.
local function solid(faces)
  local model = lacuna.model()
  for number, corners in ipairs(faces) do
    local cells = {}
    for k = 2, #corners - 1 do cells[k - 1] = { 1, k, k + 1 } end
    model:add_face { name = "f" .. number, points = corners, cells = cells }
  end
  return model
end

--- The faces of a union of unit cubes at whole places, without those between two of them.
local function cubes(places)
  local has, faces = {}, {}
  local function key(p) return table.concat(p, " ") end
  for _, p in ipairs(places) do has[key(p)] = true end
  for _, p in ipairs(places) do
    for axis = 1, 3 do
      for side = 0, 1 do
        local beside = { p[1], p[2], p[3] }
        beside[axis] = beside[axis] + 2 * side - 1
        if not has[key(beside)] then
          local corners = {}
          for k, at in ipairs { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } } do
            local corner = { p[1], p[2], p[3] }
            corner[axis] = corner[axis] + side
            corner[axis % 3 + 1] = corner[axis % 3 + 1] + at[1]
            corner[(axis + 1) % 3 + 1] = corner[(axis + 1) % 3 + 1] + at[2]
            corners[side == 1 and k or 5 - k] = corner
          end
          faces[#faces + 1] = corners
        end
      end
    end
  end
  return faces
end

local function near(found, wanted, what)
  check.that(math.abs(found - wanted) <= 1e-9 * math.abs(wanted),
    ("%s: %.15g, not %.15g"):format(what, found, wanted))
end

--- Whether a mesh is proved, and has the volume.
local function check_mesh(mesh, volume)
  local quality = mesh:quality()
  check.equal(quality.certified, true)
  check.equal(quality.tets, mesh.tets)
  check.equal(quality.pyramids, mesh.pyramids)
  check.equal(quality.hexes, mesh.hexes)
  near(quality.volume, volume, "volume of the cells")
  near(mesh.fidelity.volume, volume, "volume of the mesh")
  near(mesh.fidelity.sealed_volume, volume, "sealed volume")
end

-- --- pieces that are swept ---------------------------------------------------------------------------------

-- Arms to six sides: no sweep has two ends, and seven cubes are its pieces.
local star = { { 0, 0, 0 } }
for axis = 1, 3 do
  for side = -1, 1, 2 do
    local arm = { 0, 0, 0 }
    arm[axis] = side
    star[#star + 1] = arm
  end
end
do
  local volume = solid(cubes(star)):open_volume {}
  check.equal(volume:is_watertight(), true)
  local mesh = volume:sweep { size = 0.5 }
  check_mesh(mesh, 7)
  check.equal(mesh.tets, 0)
  check.that(mesh.hexes >= 7 * 8, mesh.hexes .. " hexahedra")
  local pieces = volume:cut { auto = true }
  check.that(#pieces > 1, #pieces .. " pieces")
  check_mesh(lacuna.assembly(pieces):sweep { size = 0.5 }, 7)
  check.fails(function() volume:cut { auto = true, plane = { { 0, 0, 0 }, { 0, 0, 1 } } } end)
end

-- Missing flat faces are sealed first: ends of the arms, two to six of them. No void face joins them.
for some = 7, 63, 7 do
  local faces, arm = {}, 0
  for _, face in ipairs(cubes(star)) do
    local is_end = false
    for axis = 1, 3 do
      local at = face[1][axis]
      local flat = at == face[2][axis] and at == face[3][axis]
      is_end = is_end or (flat and (at == -1 or at == 2))
    end
    if is_end then arm = arm + 1 end
    if not is_end or some & (1 << (arm - 1)) == 0 then faces[#faces + 1] = face end
  end
  check.equal(arm, 6)
  check_mesh(solid(faces):open_volume {}:sweep { size = 1 }, 7)
end

-- Cubes that grow at random: whatever their arms, they are meshed, and nearly all of them by hexahedra alone.
do
  local random = check.random(11)
  local function grown(count)
    local places, has = { { 0, 0, 0 } }, { ["0 0 0"] = true }
    local function is(p, dx, dy, dz) return has[("%d %d %d"):format(p[1] + dx, p[2] + dy, p[3] + dz)] end
    --- Whether a cube touches others along edges or at corners alone, where the skin would be no surface.
    local function pinches(p)
      for dx = -1, 1 do
        for dy = -1, 1 do
          for dz = -1, 1 do
            local steps = math.abs(dx) + math.abs(dy) + math.abs(dz)
            local joined = (dx ~= 0 and is(p, dx, 0, 0)) or (dy ~= 0 and is(p, 0, dy, 0)) or
              (dz ~= 0 and is(p, 0, 0, dz))
            if steps > 1 and not joined and is(p, dx, dy, dz) then return true end
          end
        end
      end
    end
    while #places < count do
      local from = places[math.ceil(random(0, #places))]
      local axis, side = math.ceil(random(0, 3)), random(0, 1) < 0.5 and -1 or 1
      local next = { from[1], from[2], from[3] }
      next[axis] = next[axis] + side
      if not has[table.concat(next, " ")] and not pinches(next) then
        places[#places + 1] = next
        has[table.concat(next, " ")] = true
      end
    end
    return places
  end
  local members, hexahedra = 24, 0
  for _ = 1, members do
    local count = math.ceil(random(4, 12))
    local mesh = solid(cubes(grown(count))):open_volume {}:sweep { size = 0.5, fallback = "mixed" }
    near(mesh:quality().volume, count, "volume of the cells")
    check.equal(mesh:quality().certified, true)
    if mesh.tets == 0 then hexahedra = hexahedra + 1 end
  end
  print(("%d of %d by hexahedra alone"):format(hexahedra, members))
  check.that(hexahedra >= 0.8 * members, hexahedra .. " by hexahedra alone")
end

-- --- tetrahedra -------------------------------------------------------------------------------------------

-- Forty faces that meet in a tip: no sweep, no cut, and a division at the middle makes too many pieces.
local o, x, y, z = { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }
local corner = { { o, y, x }, { o, x, z }, { x, y, z }, { y, o, z } }
local pyramid, base = {}, {}
for k = 1, 40 do
  local angle = 2 * math.pi * k / 40
  base[k] = { math.cos(angle), math.sin(angle), 0 }
end
for k = 1, 40 do pyramid[k] = { base[k], base[k % 40 + 1], { 0, 0, 1 } } end
pyramid[41] = {}
for k = 1, 40 do pyramid[41][k] = base[41 - k] end
do
  local volume = solid(pyramid):open_volume {}
  local remedy = 'or sweep with fallback = "mixed" [topology.no_roles]'
  check.fails(function() volume:sweep {} end, remedy)
  check.fails(function() volume:sweep { fallback = "wedges" } end, remedy)
  check.fails(function() lacuna.assembly { volume }:sweep {} end, remedy)
  check.fails(function() volume:sweep_to(path("a.msh"), {}) end, 'or sweep with fallback = "mixed"')
  local roles = { source = "f1", target = "f2", walls = { "f3", "f4" } }
  check.fails(function() solid(corner):open_volume(roles) end, "topology.ends_share_edge", "mixed")
  for _, object in ipairs { volume, lacuna.assembly { volume } } do
    check.fails(function() object:sweep_to(path("a.msh"), { fallback = "mixed" }) end, "use sweep and write")
  end
  local mesh = volume:sweep { fallback = "mixed", size = 0.2 }
  check_mesh(mesh, 20 / 3 * math.sin(2 * math.pi / 40))
  check.equal(mesh.hexes, 0)
  check.equal(mesh.pyramids, 0)
  check.that(mesh.tets > 50, mesh.tets .. " tetrahedra")
  check.equal(#{ mesh:tet(1) }, 4)
  check.equal(mesh.order, 1)
  check.equal(#mesh.regions, 1)
  check.equal(mesh:groups()[#mesh:groups()].cells, mesh.tets)
  for order = 1, 2 do
    local bytes = {}
    for n, threads in ipairs { 1, 4 } do
      local file = path("threads_" .. threads .. ".msh")
      volume:sweep { fallback = "mixed", size = 0.2, threads = threads, order = order }:write(file)
      local opened <close> = assert(io.open(file, "rb"))
      bytes[n] = opened:read("a")
    end
    check.that(bytes[1] == bytes[2], "other bytes with four threads")
  end
  -- A tetrahedron of order 2 has ten nodes; no side is numbered twice.
  local second = volume:sweep { fallback = "mixed", size = 0.2, order = 2 }
  check_mesh(second, 20 / 3 * math.sin(2 * math.pi / 40))
  check.equal(second.order, 2)
  check.equal(second.tets, mesh.tets)
  local sides, count = {}, 0
  for i = 1, mesh.tets do
    local corners = { mesh:tet(i) }
    for a = 1, 3 do
      for b = a + 1, 4 do
        local key = math.min(corners[a], corners[b]) .. " " .. math.max(corners[a], corners[b])
        if not sides[key] then count = count + 1 end
        sides[key] = true
      end
    end
  end
  check.equal(second.nodes, mesh.nodes + count)
  near(second:quality().min_scaled_jacobian, mesh:quality().min_scaled_jacobian, "least scaled Jacobian")
end

-- Of order 2 the skin follows round faces, here of the body that two crossing cylinders share.
do
  local file = path("shared.geo")
  check.write(file, 'SetFactory("OpenCASCADE");\nCylinder(1) = {-1, 0, 0, 2, 0, 0, 0.5};\n' ..
    'Cylinder(2) = {0, -1, 0, 0, 2, 0, 0.5};\n' ..
    'BooleanIntersection{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n')
  local exact, body = 2 / 3, lacuna.load(file):open_volume {}
  local off, distance = {}, {}
  for order = 1, 2 do
    local mesh = body:sweep { size = 0.4, fallback = "mixed", order = order }
    local quality = mesh:quality()
    check.equal(quality.certified, true)
    check.that(mesh.tets > 0, "no tetrahedra")
    check.that(quality.min_scaled_jacobian > 0.05, "least " .. quality.min_scaled_jacobian)
    off[order] = math.abs(quality.volume / exact - 1)
    distance[order] = mesh.fidelity.max_distance
    near(mesh.fidelity.volume, quality.volume, "volume of the mesh")
  end
  check.that(off[2] < off[1] / 10, ("volume off by %g, and by %g of order 2"):format(off[1], off[2]))
  check.that(distance[2] < distance[1] / 3, ("skin off by %g, and by %g"):format(distance[1], distance[2]))
end

-- Two solids in one volume are refused, with what to do.
do
  local faces = cubes { { 0, 0, 0 } }
  local function away(p) return { p[1] + 5, p[2], p[3] } end
  for _, face in ipairs(corner) do
    faces[#faces + 1] = { away(face[1]), away(face[2]), away(face[3]) }
  end
  check.fails(function() solid(faces):open_volume {}:sweep { fallback = "mixed" } end, "cad.skin_open",
    "open separate parts one by one, with open_volume{ faces = … }")
end

--- Add a tetrahedral hole with three legs at right angles: a volume with such a hole cannot be cut.
local function add_hole(faces, corner, leg)
  local points = { corner }
  for axis = 1, 3 do
    points[axis + 1] = { table.unpack(corner) }
    points[axis + 1][axis] = corner[axis] + leg
  end
  for _, face in ipairs { { 1, 2, 3 }, { 1, 4, 2 }, { 2, 4, 3 }, { 3, 4, 1 } } do
    faces[#faces + 1] = { points[face[1]], points[face[2]], points[face[3]] }
  end
  return leg ^ 3 / 6
end

-- A hole inside a cube: the skin has two parts. A hole whose faces are parallel to the cube's is read as a
-- step, although not all pieces can be swept. The body that fills a tilted hole shares its nodes; it has a
-- hole too, of another shape.
do
  local options = { size = 0.2, fallback = "mixed" }
  local inner
  local function with_hole(b, c, d)
    local a, faces = { 0.3, 0.3, 0.3 }, cubes { { 0, 0, 0 } }
    inner = { { a, c, b }, { a, b, d }, { b, c, d }, { c, a, d } }
    for _, face in ipairs(inner) do faces[#faces + 1] = face end
    return solid(faces):open_volume { name = "hollow" }
  end
  local stepped = with_hole({ 0.6, 0.3, 0.3 }, { 0.3, 0.6, 0.3 }, { 0.3, 0.3, 0.6 })
  check_mesh(stepped:sweep(options), 1 - 0.027 / 6)
  check_mesh(lacuna.assembly { stepped }:sweep(options), 1 - 0.027 / 6)
  local hollow = with_hole({ 0.6, 0.33, 0.36 }, { 0.36, 0.6, 0.33 }, { 0.33, 0.36, 0.6 })
  local filling = { table.unpack(inner) }
  for _, face in ipairs(cubes { { 0, 0, 0 } }) do
    local inward = {}
    for k, p in ipairs(face) do inward[5 - k] = { 0.34 + p[1] / 20, 0.34 + p[2] / 20, 0.34 + p[3] / 20 } end
    filling[#filling + 1] = inward
  end
  local body = solid(filling):open_volume { name = "body" }
  local both = lacuna.assembly { hollow, body }:sweep(options)
  check_mesh(both, 1 - 1 / 20 ^ 3)
  -- The parts share nodes: a split between tetrahedra of order 2 makes wedges of no thickness, with the nodes
  -- of the sides of both.
  options.order = 2
  local second = lacuna.assembly { hollow, body }:sweep(options)
  local split = lacuna.split_interface(second, { faces = "all" })
  check.equal(split.tets, second.tets)
  check.that(split.interface_cells > 0)
  split:write(path("split.vtk"), { binary = false })
  local file <close> = assert(io.open(path("split.vtk")))
  local wedges = 0
  for kind in file:read("a"):match("CELL_TYPES %d+\n([%d%s]*)"):gmatch "%d+" do
    wedges = wedges + (kind == "26" and 1 or 0)
  end
  check.equal(wedges, split.interface_cells)
  -- A closed surface of n triangles has n / 2 + 2 corners, each a node between two, and 2 n + 2 nodes in all.
  check.equal(split.nodes - second.nodes, split.interface_cells * 5 / 2 + 4)
end

-- A cube below a roof with a hole inside: the cube is swept, the roof is filled from the quads between them.
do
  local base = solid(cubes { { 0, 0, 0 } }):open_volume { name = "base" }
  local low, top = { { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } }, { 0.5, 0.5, 1.8 }
  local faces = { { low[4], low[3], low[2], low[1] } }
  for k = 1, 4 do faces[k + 1] = { low[k], low[k % 4 + 1], top } end
  local volume = 1 + 0.8 / 3 - add_hole(faces, { 0.45, 0.45, 1.2 }, 0.1)
  local roof = solid(faces):open_volume { name = "roof" }
  local assembly = lacuna.assembly { base, roof }
  check.fails(function() assembly:sweep { size = 0.25 } end, 'sweep with fallback = "mixed"')
  local mesh = assembly:sweep { size = 0.25, fallback = "mixed" }
  check_mesh(mesh, volume)
  check.equal(mesh.hexes, 64)
  check.equal(mesh.pyramids, 16)
  check.equal(#{ mesh:pyramid(1) }, 5)
  for kind, cells in pairs { hex = 64, wedge = 0, pyramid = 16, tet = mesh.tets } do
    local buffer, values, low = mesh:cells(kind), mesh:field(nil, kind), math.huge
    check.equal(buffer.rows, cells)
    check.equal(values.rows, cells)
    for _, value in values:each() do low = math.min(low, value) end
    if cells > 0 then
      local names = { hex = "hexes", pyramid = "pyramids", tet = "tets" }
      check.near(low, mesh:quality().least[names[kind]], 1e-6)
    end
    for i, first, second, third, fourth in buffer:each() do
      local own = { mesh[kind](mesh, i) }
      check.equal(buffer.columns, #own)
      local same = first == own[1] and second == own[2] and third == own[3] and fourth == own[4]
      check.that(same, kind .. " " .. i)
    end
  end
  local regions = table.concat(mesh.regions, " ")
  check.equal(regions, "base roof")
  for _, ending in ipairs { "msh", "vtk", "vtu", "inp", "bdf", "unv", "exo" } do
    local file = path("roof." .. ending)
    mesh:write(file)
    local quality = lacuna.check(file)
    check.equal(quality.certified, true)
    check.equal(quality.hexes, 64)
    check.equal(quality.pyramids, 16)
    check.equal(quality.tets, mesh.tets)
    check.that(math.abs(quality.volume - volume) < 1e-6, ending .. ": volume " .. quality.volume)
    -- A region of several shapes is one region: its cells have no faces between them.
    local has_regions = ending ~= "vtk" and ending ~= "vtu"
    check.equal(#lacuna.load(file):faces(), has_regions and 14 or 9, ending)
  end
  -- Of order 2 likewise, with hexahedra of 27 nodes beside pyramids of 14, or of 20 beside 13.
  for _, serendipity in ipairs { false, true } do
    local second = assembly:sweep { size = 0.25, fallback = "mixed", order = 2, serendipity = serendipity }
    check_mesh(second, volume)
    check.equal(second.pyramids, 16)
    local formats = serendipity and { "msh", "vtk", "vtu", "inp", "bdf", "unv", "exo" } or
      { "msh", "vtk", "vtu", "exo" }
    for _, ending in ipairs(formats) do
      local file = path("second." .. ending)
      second:write(file)
      local quality = lacuna.check(file)
      check.equal(quality.certified, true)
      check.equal(quality.hexes, 64)
      check.equal(quality.pyramids, 16)
      check.equal(quality.tets, second.tets)
      check.that(math.abs(quality.volume - volume) < 1e-6, ending .. ": volume " .. quality.volume)
      local copy = path("copy.vtu")
      check.that(os.execute(("'%s' convert '%s' '%s'"):format(params.lacuna, file, copy)), ending)
      check.equal(lacuna.check(copy).pyramids, 16)
    end
    if not serendipity then
      check.fails(function() second:write(path("second.inp")) end, "io.no_such_element", "serendipity")
    end
    second:picture(path("second.png"), { cut = { point = { 0.5, 0.5, 0.5 }, normal = { 0, 1, 0 } } })
    second:view(path("second.html"))
  end
  check.fails(function() mesh:write(path("parts.msh"), { partitions = 2 }) end, "lua.mixed_write")
  check.fails(function() mesh:write(path("parts.msh"), { partitions = 1 }) end, "lua.mixed_write")
  check.fails(function() mesh:write(path("parts.pvtu")) end, "lua.mixed_write")
  check.fails(function() lacuna.assembly { mesh, base }:sweep {} end, "fill.mixed_member", "mixed")
  mesh:picture(path("roof.png"), { cut = { point = { 0.5, 0.5, 0.5 }, normal = { 0, 1, 0 } } })
  mesh:view(path("roof.html"))
end

check.done()

-- --- pieces side by side -----------------------------------------------------------------------------------

-- An edge of a skin that is not swept ends within a side of a swept box, along the sweep or on its rim: the
-- box has a node there.
for _, sweep in ipairs { { "f5", "f6" }, { "f1", "f2" } } do
  for _, height in ipairs { 0.15, 0.37, 0.5, 0.81 } do
    local box = solid(cubes { { 0, 0, 0 } }):open_volume { source = sweep[1], target = sweep[2] }
    local base = { { 1, 0, 0 }, { 1, 1, 0 }, { 1, 1, 1 }, { 1, 0, 1 }, { 1, 0, height } }
    local apex, faces = { 2, 0.5, 0.5 }, { { base[5], base[4], base[3], base[2], base[1] } }
    for k = 1, 5 do faces[k + 1] = { base[k], base[k % 5 + 1], apex } end
    local volume = 1 + 1 / 3 - add_hole(faces, { 1.2, 0.45, 0.45 }, 0.1)
    local cone = solid(faces):open_volume {}
    local parts = lacuna.assembly { box, cone }
    local mesh = parts:sweep { size = 0.4, fallback = "mixed" }
    check_mesh(mesh, volume)
    check.that(mesh.hexes >= 8 and mesh.tets > 0, mesh.hexes .. " hexahedra, " .. mesh.tets .. " tetrahedra")
  end
end

--- A prism over a polygon, whose last `arc` sides are one round wall.
local function prism(outline, arc, low, high)
  local model, count = lacuna.model(), #outline
  local function end_face(name, z, turned)
    local points, cells = {}, {}
    for k, p in ipairs(outline) do points[k] = { p[1], p[2], z } end
    for k = 2, count - 1 do cells[k - 1] = turned and { 1, k + 1, k } or { 1, k, k + 1 } end
    model:add_face { name = name, points = points, cells = cells }
  end
  local function wall(name, first, last)
    local points, cells = {}, {}
    for k = first, last + 1 do
      local p = outline[(k - 1) % count + 1]
      points[#points + 1] = { p[1], p[2], low }
      points[#points + 1] = { p[1], p[2], high }
    end
    for k = 1, #points - 3, 2 do
      cells[#cells + 1] = { k, k + 2, k + 3 }
      cells[#cells + 1] = { k, k + 3, k + 1 }
    end
    model:add_face { name = name, points = points, cells = cells }
  end
  end_face("low", low, true)
  end_face("high", high, false)
  for k = 1, count - arc do wall("w" .. k, k, k) end
  wall("round", count - arc + 1, count)
  return model:open_volume { source = "low", target = "high" }
end

--- A half disc of radius 1 to the left of x = 0, and a rectangle to the right of it as far as `x`.
local function half_disc(x, chords)
  local outline = { { 0, -1 }, { x, -1 }, { x, 1 }, { 0, 1 } }
  if x == 0 then outline = { { 0, -1 }, { 0, 1 } } end
  for k = 1, chords - 1 do
    local turn = math.pi * (0.5 + k / chords)
    outline[#outline + 1] = { math.cos(turn), math.sin(turn) }
  end
  return outline
end

-- Rims that run along each other by the same chords get no vertex at each of them.
do
  local counts = {}
  for _, chords in ipairs { 12, 96 } do
    local below, above = prism(half_disc(2, chords), chords, 0, 1), prism(half_disc(0, chords), chords, 1, 2)
    local mesh = lacuna.assembly { below, above }:sweep { size = 0.4 }
    check.equal(mesh:quality().certified, true)
    counts[#counts + 1] = mesh.hexes
  end
  check.that(counts[2] < 2 * counts[1], counts[1] .. " hexahedra, and " .. counts[2])
end

-- Pieces that are cut across a curved rim on one side of a face alone: where they join the other side, the
-- rim gets a vertex on its curve, not on its chords.
do
  local name = path "round.geo"
  local file <close> = assert(io.open(name, "w"))
  file:write 'SetFactory("OpenCASCADE");\nCylinder(1) = {0, 0, 0, 0, 0, 2, 1, 2*Pi};\n'
  file:close()
  local halves = lacuna.load(name):open_volume {}:cut { plane = { { 0, 0, 1 }, { 0, 0, 1 } } }
  for at = -0.85, 0.9, 0.43 do
    local pieces = { halves[1] }
    for _, piece in ipairs(halves[2]:cut { plane = { { at, 0, 0 }, { 1, 0.1, 0 } } }) do
      pieces[#pieces + 1] = piece
    end
    local mesh = lacuna.assembly(pieces):sweep { size = 0.3 }
    check.equal(mesh:quality().certified, true)
    check.that(mesh:quality().min_scaled_jacobian > 0.05, ("cut at %g"):format(at))
  end
end

-- An arc that touches the rim of an end leaves a cusp there, whose cells are not flat.
for _, size in ipairs { 0.1, 0.2 } do
  local block = prism({ { -2, -1 }, { 2, -1 }, { 2, 1 }, { -2, 1 } }, 1, 0, 0.5)
  local mesh = lacuna.assembly { block, prism(half_disc(2, 96), 96, 0.5, 1) }:sweep { size = size }
  local quality = mesh:quality()
  check.equal(quality.certified, true)
  check.that(quality.min_scaled_jacobian > 0.1, ("size %g: least scaled Jacobian %g"):format(size,
    quality.min_scaled_jacobian))
end
