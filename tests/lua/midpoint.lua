-- SPDX-License-Identifier: MIT
-- Volumes that are divided at their middle, because no single sweep fills them: one block for each vertex
-- with three edges, or for each corner of cones over the faces.
local lacuna = require "lacuna"
local folder = arg[0]:match("^(.*/)") or "./"
local check = dofile(folder .. "check.lua")
local params = lacuna.params { scratch = ".", shared = "" }
local whole = (os.getenv "LACUNA_WHOLE_FAMILIES" or "") ~= ""

local function path(name) return params.scratch .. "/" .. name end
local function sub(a, b) return { a[1] - b[1], a[2] - b[2], a[3] - b[3] } end
local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end
local function cross(a, b)
  return { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] }
end
local function unit(a)
  local length = math.sqrt(dot(a, a))
  return { a[1] / length, a[2] / length, a[3] / length }
end

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

--- The faces of a box from `low` to `high`.
local function box(low, high)
  local faces = {}
  for axis = 1, 3 do
    for side = 0, 1 do
      local corners = {}
      for k, at in ipairs { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } } do
        local corner = {}
        for i, own in pairs { [axis] = side, [axis % 3 + 1] = at[1], [(axis + 1) % 3 + 1] = at[2] } do
          corner[i] = own == 1 and high[i] or low[i]
        end
        corners[side == 1 and k or 5 - k] = corner
      end
      faces[#faces + 1] = corners
    end
  end
  return faces
end

--- The part of a convex body with normal · x <= height.
local function clip(faces, normal, height)
  local left, cap = {}, {}
  for _, face in ipairs(faces) do
    local own = {}
    for i, a in ipairs(face) do
      local b = face[i % #face + 1]
      local ha, hb = dot(normal, a) - height, dot(normal, b) - height
      if ha <= 0 then own[#own + 1] = a end
      if ha * hb < 0 then
        if ha > hb then a, b, ha, hb = b, a, hb, ha end -- the same point from both faces
        local t = ha / (ha - hb)
        local p = { a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]), a[3] + t * (b[3] - a[3]) }
        own[#own + 1] = p
        local key = ("%.12g %.12g %.12g"):format(p[1], p[2], p[3])
        if not cap[key] then
          cap[key] = true
          cap[#cap + 1] = p
        end
      end
    end
    if #own > 2 then left[#left + 1] = own end
  end
  if #cap > 2 then
    local middle = { 0, 0, 0 }
    for _, p in ipairs(cap) do
      for k = 1, 3 do middle[k] = middle[k] + p[k] / #cap end
    end
    local u = unit(sub(cap[1], middle))
    local v = cross(unit(normal), u)
    local function angle(p) return math.atan(dot(sub(p, middle), v), dot(sub(p, middle), u)) end
    table.sort(cap, function(a, b) return angle(a) < angle(b) end)
    left[#left + 1] = cap
  end
  return left
end

--- Volume, number of vertices, and the least volume that unit vectors along the edges of a vertex span: no
--- cell at that vertex is better.
local function facts(faces)
  local volume, at, corners = 0, {}, {}
  for _, face in ipairs(faces) do
    for k, p in ipairs(face) do
      if k > 1 and k < #face then volume = volume + dot(face[1], cross(p, face[k + 1])) / 6 end
      local key = ("%.9g %.9g %.9g"):format(p[1] + 0.0, p[2] + 0.0, p[3] + 0.0)
      if not at[key] then
        at[key] = { p = p }
        corners[#corners + 1] = at[key]
      end
      table.insert(at[key], unit(sub(face[k % #face + 1], p)))
    end
  end
  local least = 1
  for _, c in ipairs(corners) do
    check.equal(#c, 3, "edges at a vertex")
    least = math.min(least, math.abs(dot(c[1], cross(c[2], c[3]))))
  end
  return volume, #corners, least
end

local function check_mesh(mesh, volume)
  local quality = mesh:quality()
  check.equal(quality.certified, true)
  check.equal(mesh.tets, 0)
  check.equal(mesh.wedges, 0)
  check.near(quality.volume, volume, 1e-9 * volume)
  check.near(mesh.fidelity.volume, volume, 1e-9 * volume)
  check.that(quality.min_scaled_jacobian > 0.1, "least scaled Jacobian " .. quality.min_scaled_jacobian)
  return quality.min_scaled_jacobian
end

-- --- families ----------------------------------------------------------------------------------------------

local random = check.random(5)

--- A tetrahedron of random planes; a box less some corners; planes that touch a ball, those at more than 41°.
local shapes = {}
function shapes.tetrahedron()
  local faces = box({ -9, -9, -9 }, { 9, 9, 9 })
  for _, n in ipairs { { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 } } do
    for k = 1, 3 do n[k] = n[k] + random(-0.35, 0.35) end
    faces = clip(faces, unit(n), random(0.8, 1.2))
  end
  return faces
end
function shapes.box()
  local size = { random(1, 2), random(1, 2), random(1, 2) }
  local faces = box({ 0, 0, 0 }, size)
  for _ = 1, math.ceil(random(0, 3)) do
    local n, corner = {}, {}
    for k = 1, 3 do
      local side = random(0, 1) < 0.5 and -1 or 1
      n[k] = side / (size[k] * random(0.25, 0.6))
      corner[k] = side == 1 and size[k] or 0
    end
    faces = clip(faces, n, dot(n, corner) - 1)
  end
  return faces
end
function shapes.ball()
  local faces, normals, wanted = box({ -4, -4, -4 }, { 4, 4, 4 }), {}, math.ceil(random(5, 12))
  for _ = 1, 5000 do
    local n = { random(-1, 1), random(-1, 1), random(-1, 1) }
    local fits = dot(n, n) < 1 and dot(n, n) > 0.05 and #normals < wanted
    n = unit(n)
    for _, other in ipairs(normals) do fits = fits and dot(n, other) < 0.75 end
    if fits then
      normals[#normals + 1] = n
      faces = clip(faces, n, random(0.8, 1.2))
    end
  end
  return faces
end

local members, least = whole and 60 or 2, 1
for _, kind in ipairs { "tetrahedron", "box", "ball" } do
  local cut, refused = 0, 0
  for _ = 1, members do
    local faces = shapes[kind]()
    local volume, vertices, corner = facts(faces)
    local open = solid(faces):open_volume {}
    local fine, mesh = pcall(open.sweep, open)
    -- A corner below 0.1 is refused. Between that and 0.15 blocks may be worse than the corner.
    check.that(fine or corner < 0.15, ("%s: %s, corner %.3f"):format(kind, mesh, corner))
    if fine then
      least = math.min(least, check_mesh(mesh, volume))
      if tostring(mesh.report):find("cut into " .. vertices .. " pieces", 1, true) then cut = cut + 1 end
    else
      refused = refused + 1
    end
  end
  print(("%s: %d of %d divided, %d refused"):format(kind, cut, members, refused))
  check.that(kind ~= "tetrahedron" or cut == members, cut .. " tetrahedra divided")
end
print(("least scaled Jacobian %.3f"):format(least))

-- Polyhedra whose vertices have four and five edges are divided into cones: icosahedra, and cupolas with a
-- triangle above a hexagon.
for _ = 1, whole and 6 or 1 do
  local g, size, top = (1 + 5 ^ 0.5) / 2, random(0.8, 1.2), random(1, 1.4)
  local function faces_of(places, lists)
    local faces = {}
    for n, list in ipairs(lists) do
      faces[n] = {}
      for k, at in ipairs(list) do
        local p = places[at + 1]
        faces[n][k] = { size * p[1], p[2], p[3] }
      end
    end
    return faces
  end
  local places, round = {}, { { 5, 4, 3, 2, 1, 0 }, { 6, 7, 8 } }
  for k = 0, 5 do places[k + 1] = { 2 * math.cos(k * math.pi / 3), 2 * math.sin(k * math.pi / 3), 0 } end
  for k = 0, 2 do
    local at = math.pi * (1 / 6 + 2 * k / 3)
    places[k + 7] = { top * math.cos(at), top * math.sin(at), 1.5 }
    round[#round + 1] = { 2 * k, 2 * k + 1, 6 + k }
    round[#round + 1] = { 2 * k + 1, (2 * k + 2) % 6, 6 + (k + 1) % 3, 6 + k }
  end
  local shapes = { cupola = faces_of(places, round),
    icosahedron = faces_of({ { -1, g, 0 }, { 1, g, 0 }, { -1, -g, 0 }, { 1, -g, 0 }, { 0, -1, g },
      { 0, 1, g }, { 0, -1, -g }, { 0, 1, -g }, { g, 0, -1 }, { g, 0, 1 }, { -g, 0, -1 }, { -g, 0, 1 } },
    { { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 }, { 0, 10, 11 }, { 1, 5, 9 }, { 5, 11, 4 },
      { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 }, { 3, 4, 2 }, { 3, 2, 6 }, { 3, 6, 8 },
      { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 }, { 8, 6, 7 }, { 9, 8, 1 } }) }
  for _, faces in pairs(shapes) do
    local volume = 0
    for _, face in ipairs(faces) do
      for k = 2, #face - 1 do volume = volume + dot(face[1], cross(face[k], face[k + 1])) / 6 end
    end
    check_mesh(solid(faces):open_volume {}:sweep {}, volume)
  end
end

-- --- the blocks --------------------------------------------------------------------------------------------

local body = clip(box({ 0, 0, 0 }, { 2, 2, 2 }), { 1, 1, 1 }, 4.5)
do
  local volume, vertices = facts(body)
  local foam = solid(body):open_volume { name = "foam" }
  local blocks = foam:cut { auto = true }
  check.equal(#blocks, vertices)
  for _, block in ipairs(blocks) do
    check.equal(block:is_watertight(), true)
    check.equal(#block:model():faces(), 6)
  end
  check_mesh(lacuna.assembly(blocks):sweep { size = 0.4 }, volume)

  -- The mesh follows the size; its groups are those of the faces, without those between blocks.
  local mesh = foam:sweep { size = 0.2 }
  check_mesh(mesh, volume)
  check.that(mesh.hexes > 1000, mesh.hexes .. " hexahedra")
  local of = {}
  for _, group in ipairs(mesh:groups()) do of[group.name] = group.cells end
  check.equal(of.foam, mesh.hexes)
  for f = 1, #body do check.that((of["f" .. f] or 0) > 0, "no quads on f" .. f) end
  for name in pairs(of) do check.that(not name:find "void" and not name:find "cut_", name) end

  local bytes = {}
  for n, threads in ipairs { 1, 4 } do
    local file = path("threads_" .. threads .. ".msh")
    foam:sweep { size = 0.2, threads = threads }:write(file)
    local opened <close> = assert(io.open(file, "rb"))
    bytes[n] = opened:read("a")
  end
  check.that(bytes[1] == bytes[2], "other bytes with four threads")
  check.equal(foam:sweep { size = 0.5, order = 2 }:quality().certified, true)
  mesh:picture(path("body.png"), { cut = { point = { 1, 1, 1 }, normal = { 1, 0.4, 0.2 } } })
end

-- --- other vertices ----------------------------------------------------------------------------------------

--- A pyramid over a regular polygon; two of them at their bases.
local function pyramid(sides, height, below)
  local base, faces = {}, {}
  for k = 1, sides do
    local angle = 2 * math.pi * k / sides
    base[k] = { math.cos(angle), math.sin(angle), 0 }
  end
  for k = 1, sides do faces[k] = { base[k], base[k % sides + 1], { 0, 0, height } } end
  if below then
    for k = 1, sides do faces[sides + k] = { base[k % sides + 1], base[k], { 0, 0, -below } } end
  else
    faces[sides + 1] = {}
    for k = 1, sides do faces[sides + 1][k] = base[sides + 1 - k] end
  end
  return faces
end
for sides = 4, whole and 6 or 4 do
  local area = sides / 2 * math.sin(2 * math.pi / sides)
  for _, below in ipairs { false, 1.1 } do
    local open = solid(pyramid(sides, 1, below)):open_volume {}
    local mesh = open:sweep { size = 0.4 }
    check_mesh(mesh, area * (1 + (below or 0)) / 3)
    print(("pyramid of %d sides: %s"):format(sides, tostring(mesh.report):match "cut into %d+ pieces"))
  end
end

-- Houses: a prism with a pyramid as its roof. Vertices with four edges and more are cut through until all
-- have three.
for sides = 4, whole and 6 or 5 do
  for _, skew in ipairs { 0, 0.3 } do
    local faces = pyramid(sides, 1)
    for k = 1, sides do
      local base = faces[sides + 1]
      local a, b = base[k], base[k % sides + 1]
      faces[k][3] = { skew, 0, 1 }
      faces[sides + 1 + k] = { a, b, { b[1], b[2], -1.2 }, { a[1], a[2], -1.2 } }
    end
    for k, p in ipairs(faces[sides + 1]) do faces[sides + 1][k] = { p[1], p[2], -1.2 } end
    local mesh = solid(faces):open_volume {}:sweep { size = 0.4 }
    check_mesh(mesh, sides / 2 * math.sin(2 * math.pi / sides) * (1 / 3 + 1.2))
    print(("house of %d sides: %s"):format(sides, tostring(mesh.report):match "cut into %d+ pieces"))
  end
end

-- --- refused -----------------------------------------------------------------------------------------------

-- More than 128 pieces.
check.fails(function() solid(pyramid(17, 1)):open_volume {}:sweep {} end, "topology.no_roles")
-- A corner that is nearly flat.
do
  local faces = clip(box({ -9, -9, -9 }, { 9, 9, 9 }), { 0, 0, -1 }, 0)
  for k = 0, 2 do
    local angle = 2 * math.pi * k / 3
    faces = clip(faces, { math.cos(angle), math.sin(angle), 8 }, 1)
  end
  check.fails(function() solid(faces):open_volume {}:sweep {} end)
end
-- A face that came with a mesh.
do
  local model = lacuna.model()
  for number, corners in ipairs(body) do
    local cells = {}
    for k = 2, #corners - 1 do cells[k - 1] = { 1, k, k + 1 } end
    if #corners == 4 then cells = { { 1, 2, 3, 4 } } end
    model:add_face { name = "f" .. number, points = corners, cells = cells, keep_mesh = #corners == 4 }
  end
  check.fails(function() model:open_volume {}:sweep {} end)
end

-- --- real bodies -------------------------------------------------------------------------------------------

local bodies = { ["s14o_cube_corner_sub_sphere.stp"] = 1000 - 4 / 3 * math.pi * 4 ^ 3 / 8,
  ["s10o_cyl_cutsphere.stp"] = false } -- half of its ball is cut where an earlier cut ended
if whole then
  bodies["s04o_tetrahedron.geo"], bodies["s06o_dodecahedron.geo"] = false, false
  bodies["n08o_pentapyr.geo"], bodies["n14o_octahedron.geo"] = false, 4 / 3
  bodies["i06o_m6.step"] = false -- the pieces of its best cut cannot be meshed together, those of another can
end
for file, volume in pairs(bodies) do
  local name = params.shared .. "/data/bodies/" .. file
  local opened = params.shared ~= "" and io.open(name)
  if not opened then
    print("skipped: no " .. file)
  else
    opened:close()
    local mesh = lacuna.load(name):open_volume {}:sweep {}
    check.that(mesh:quality().min_scaled_jacobian > 0.25, file)
    check.equal(mesh.tets, 0)
    if volume then check.near(mesh.fidelity.volume, volume, 1e-3 * volume) end
  end
end

check.done()
