-- SPDX-License-Identifier: MIT
-- Branches: ducts whose walls side ducts leave are cut into arms and meshed as one.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")
local params = lacuna.params { members = check.whole and 60 or 6, scratch = "." }

local sides = 24 -- corners of a round mouth

--- A duct along x with a square section of side 2, and branches { at =, side = 1 … 4, radius =, length =,
--- corners =, lean =, turn =, role =, fillet = radius at the mouth }. Faces: left, right, duct_1 … 4,
--- branch_n, top_n, fillet_n.
local function duct(length, branches)
  local model = lacuna.model()
  local function frame(side) -- a place along x, across the side's wall, and up from it
    local c, s = math.cos((side - 1) * math.pi / 2), math.sin((side - 1) * math.pi / 2)
    return function(x, across, up) return { x, across * c - (1 + up) * s, across * s + (1 + up) * c } end
  end
  for side = 1, 4 do
    local place, points, cells = frame(side), {}, {}
    local function add(x, y) points[#points + 1] = place(x, y, 0) return #points end
    local function flat(a, b)
      if b - a > 1e-9 then cells[#cells + 1] = { add(a, -1), add(b, -1), add(b, 1), add(a, 1) } end
    end
    local from = 0
    for n, branch in ipairs(branches) do
      if branch.side == side then
        local at, r = branch.at, branch.radius
        flat(from, at - 1)
        from = at + 1
        local count, fillet = branch.corners or sides, branch.fillet or 0
        local function ring(radius)
          local points = {}
          for i = 0, count - 1 do
            local t = 2 * math.pi * (i + (branch.turn or 0)) / count
            points[i + 1] = { at + radius * math.cos(t), radius * math.sin(t) }
          end
          return points
        end
        if fillet > 0 then
          local places, quads, steps = {}, {}, 6
          for k = 0, steps do
            local u = math.pi / 2 * k / steps
            for i, p in ipairs(ring(r + fillet * (1 - math.sin(u)))) do
              places[k * count + i] = place(p[1], p[2], fillet * (1 - math.cos(u)))
              local j = k * count + i % count + 1
              if k < steps then quads[#quads + 1] = { k * count + i, j, j + count, (k + 1) * count + i } end
            end
          end
          model:add_face { name = "fillet_" .. n, points = places, cells = quads }
        end
        local rim, neck = ring(r + fillet), ring(r)
        -- Between the mouth and the square round it: each side of the mouth sees a part of the square.
        local square = {}
        for i = 0, count - 1 do
          local t = 2 * math.pi * (i + (branch.turn or 0)) / count
          local far = 1 / math.max(math.abs(math.cos(t)), math.abs(math.sin(t)))
          square[#square + 1] = { t = t, rim = i + 1, x = at + far * math.cos(t), y = far * math.sin(t) }
        end
        for k = 0, 3 do
          local t = math.pi / 4 + k * math.pi / 2
          if t < square[1].t then t = t + 2 * math.pi end
          local exact
          for _, p in ipairs(square) do exact = exact or math.abs(p.t - t) < 1e-9 end
          if not exact then
            local x, y = math.cos(t) > 0 and 1 or -1, math.sin(t) > 0 and 1 or -1
            square[#square + 1] = { t = t, x = at + x, y = y }
          end
        end
        table.sort(square, function(a, b) return a.t < b.t end)
        local inner = {}
        for i, p in ipairs(rim) do inner[i] = add(p[1], p[2]) end
        for _, p in ipairs(square) do p.n = add(p.x, p.y) end
        local last = 1
        for i, p in ipairs(square) do
          local q = square[i % #square + 1]
          last = p.rim or last
          cells[#cells + 1] = { inner[last], p.n, q.n }
          if q.rim then cells[#cells + 1] = { inner[last], q.n, inner[q.rim] } end
        end
        local wall, walls, top = {}, {}, {}
        for i, p in ipairs(neck) do
          local lean = branch.lean or 0
          wall[i] = place(p[1], p[2], fillet)
          wall[count + i] = place(p[1] + lean, p[2], branch.length)
          top[i] = wall[count + i]
          local j = i % count + 1
          walls[i] = { i, j, count + j, count + i }
        end
        if branch.corners then
          for i, cell in ipairs(walls) do
            local own = {}
            for k = 1, 4 do own[k] = wall[cell[k]] end
            model:add_face { name = ("branch_%d_%d"):format(n, i), points = own, cells = { { 1, 2, 3, 4 } } }
          end
        else
          model:add_face { name = "branch_" .. n, points = wall, cells = walls }
        end
        local fan = {}
        for i = 2, count - 1 do fan[#fan + 1] = { 1, i, i + 1 } end
        if branch.role ~= "missing" then model:add_face { name = "top_" .. n, points = top, cells = fan } end
      end
    end
    flat(from, length)
    model:add_face { name = "duct_" .. side, points = points, cells = cells }
  end
  for name, x in pairs { left = 0, right = length } do
    local p = { { x, -1, -1 }, { x, 1, -1 }, { x, 1, 1 }, { x, -1, 1 } }
    model:add_face { name = name, points = p, cells = { { 1, 2, 3, 4 } } }
  end
  return model
end

local function volume(length, branches)
  local sum = 4 * length
  for _, b in ipairs(branches) do
    local n = b.corners or sides
    local share, fillet = n / 2 * math.sin(2 * math.pi / n), b.fillet or 0
    sum = sum + share * b.radius ^ 2 * b.length
    for k = 1, 100 do -- the ring that a fillet adds
      local aside = fillet * (1 - math.sin(math.acos(1 - (k - 0.5) / 100)))
      sum = sum + share * ((b.radius + aside) ^ 2 - b.radius ^ 2) * fillet / 100
    end
  end
  return sum
end

local function open(model, branches)
  local target, walls = { "right" }, {}
  for _, face in ipairs(model:faces()) do
    local n = tonumber(face.name:match "^top_(%d+)$")
    if n and branches[n].role == "target" then target[#target + 1] = face
    elseif face.name ~= "left" and face.name ~= "right" then walls[#walls + 1] = face end
  end
  return model:open_volume { source = "left", target = target, walls = walls }
end

-- A round branch in the middle of a wall: three arms, which are as large as the whole.
local one = { { at = 3, side = 1, radius = 0.5, length = 2, role = "target" } }
local pieces = open(duct(6, one), one):cut()
check.equal(#pieces, 3)
for _, piece in ipairs(pieces) do check.equal(piece.class, "closed") end
one[1].role = "missing"
local classes = {}
for _, piece in ipairs(open(duct(6, one), one):cut()) do classes[#classes + 1] = piece.class end
check.equal(table.concat(classes, " "), "closed closed IV", "the branch's end is missing and stays so")
one[1].role = "wall"
check.equal(open(duct(6, one), one):cut()[3].class, "closed", "its end is found among walls")

-- A fillet at the mouth belongs to the branch's wall, whether the branch has an end or not, and on two sides.
for _, role in ipairs { "wall", "target", "missing" } do
  for _, count in ipairs { 1, 2 } do
    local smooth = {}
    for n = 1, count do
      smooth[n] = { at = 3, side = 2 * n - 1, radius = 0.5, length = 2, fillet = 0.2, role = role }
    end
    local whole = open(duct(6, smooth), smooth)
    check.equal(#whole:cut(), 2 + count)
    local mesh = whole:sweep { size = 0.25 }
    check.equal(#mesh.regions, 2 + count)
    check.near(mesh.fidelity.volume, volume(6, smooth), 0.01 * volume(6, smooth))
    check.that(mesh:quality().min_scaled_jacobian > 0.3)
  end
end

-- A square one is cut along its sides, as a T all along its middle.
local square = { { at = 3, side = 1, radius = 0.5 * math.sqrt(2), length = 2, corners = 4, turn = 0.5,
  role = "missing" } }
local mesh = open(duct(6, square), square):sweep { size = 0.25 }
check.equal(#mesh.regions, 3)
check.near(mesh.fidelity.volume, 26, 1e-9)
check.that(mesh:quality().min_scaled_jacobian > 0.7)

-- Two at one place, to opposite sides: a cross of four arms.
for _, radius in ipairs(check.whole and { 0.3, 0.5, 0.7 } or { 0.5 }) do
  local cross = { { at = 2, side = 1, radius = radius, length = 2, role = "target" },
    { at = 2, side = 3, radius = radius, length = 1.5, role = "wall" } }
  mesh = open(duct(4, cross), cross):sweep { size = 0.3 }
  check.equal(#mesh.regions, 4)
  check.near(mesh.fidelity.volume, volume(4, cross), 0.02 * volume(4, cross))
end

-- Rows on all walls go on across the faces between arms, which have no rows of their own: every node beside
-- the duct's flat walls is a row's height or more away from them.
for n, radius in ipairs(check.whole and { 0.3, 0.4, 0.5, 0.6, 0.7 } or { 0.4, 0.6 }) do
  for _, arms in ipairs(check.whole and { 1, 2 } or { n }) do
    local branches, first = {}, 0.01 + 0.002 * n
    for a = 1, arms do
      branches[a] = { at = 3, side = 2 * a - 1, radius = radius, length = 1.5, role = "target",
        lean = arms == 1 and 0.3 or nil }
    end
    mesh = open(duct(6, branches), branches):sweep { size = 0.3,
      boundary_layers = { walls = "walls", first = first, growth = 1.3, count = 3 } }
    check.equal(#mesh.regions, 2 + arms)
    check.equal(mesh:quality().certified, true)
    check.near(mesh.fidelity.volume, volume(6, branches), 0.01 * volume(6, branches))
    local least = math.huge
    for i = 1, mesh.nodes do
      local x, y, z = mesh:node(i)
      local height = 1 - math.max(math.abs(y), math.abs(z))
      if x > 0.5 and x < 2 and height > 1e-6 then least = math.min(least, height) end
    end
    check.near(least, first, 0.02 * first)
  end
end

-- A dimple is a wall like any other.
local dimple = { { at = 3, side = 1, radius = 0.5, length = 0.1, role = "wall" } }
check.equal(#open(duct(6, dimple), dimple):cut(), 1)

-- Each kind of fallback, where what is asked cannot be had in one arm.
for _, kind in ipairs { "wedges", "leave_out" } do
  local tee = { { at = 3, side = 1, radius = 0.5, length = 2, role = "target" } }
  local rows = { walls = "branch_1", first = 0.45, count = 4 }
  local options = { size = 0.3, fallback = kind, boundary_layers = rows }
  if kind == "wedges" then
    check.fails(function() open(duct(6, tee), tee):sweep(options) end, "piece_3")
  else
    mesh = open(duct(6, tee), tee):sweep(options)
    check.equal(table.concat(mesh.regions, " "), "piece_1 piece_2")
    check.equal(mesh.left_out[1].region, "piece_3")
    check.near(mesh.fidelity.volume, 24, 0.9)
    check.equal(mesh:quality().certified, true)
  end
end

-- A family: up to three branches, each on any side, round or with corners, upright or leaning.
local random = check.random(20261122)
local meshed, arms, refused, turning, turned = 0, 0, 0, 0, 0
for member = 1, params.members do
  local branches, count = {}, math.floor(random(1, 3.999))
  for n = 1, count do
    local b = { at = 3 * n - 1, side = math.floor(random(1, 4.999)), radius = random(0.3, 0.75),
      length = random(1, 3), role = ({ "target", "wall", "missing" })[math.floor(random(1, 3.999))] }
    if random(0, 1) < 0.2 then b.corners, b.turn = math.floor(random(5, 9.999)), random(0, 1) end
    if random(0, 1) < 0.3 then b.lean = random(-0.5, 0.5) end
    branches[n] = b
  end
  local length = 3 * count + 1
  local whole = open(duct(length, branches), branches)
  local ok, found = pcall(whole.sweep, whole, { size = 0.3 })
  -- The middle one of three leaves to another side than both.
  local turns = count == 3 and branches[2].side ~= branches[1].side and branches[2].side ~= branches[3].side
  if turns then turning = turning + 1 end
  if ok then
    meshed, arms = meshed + 1, arms + #found.regions
    if turns then turned = turned + 1 end
    check.equal(#found.regions, 1 + 2 * count, "member " .. member)
    check.equal(found:quality().certified, true)
    local exact = volume(length, branches)
    check.that(math.abs(found.fidelity.volume - exact) < 0.02 * exact,
      ("member %d: volume %g for %g"):format(member, found.fidelity.volume, exact))
  else
    refused = refused + 1
    check.that(tostring(found):find "%[[%a_]+%.[%a_]+%]", "refused by name: " .. tostring(found))
  end
end
-- Who names a way of meshing gets it where no other arm has made the quads; faces between arms stay shared.
local runs = check.members_to_run(5) -- two of eight
for _, radius in ipairs { 0.4, 0.7 } do
  for _, size in ipairs { 0.4, 0.25 } do
    for _, corners in ipairs { 16, 24 } do
      if not runs() then goto next end
      local branches = { { at = 2, side = 2, radius = radius, length = 2, role = "target" } }
      branches[1].corners = corners
      local found = open(duct(4, branches), branches):sweep { size = size, quads = "paved" }
      local exact = volume(4, branches)
      check.equal(found:quality().certified, true)
      check.that(math.abs(found.fidelity.volume - exact) < 0.02 * exact, "paved: volume")
      ::next::
    end
  end
end

-- Plain tees and laterals, from CAD and as facets: the crease of a wide branch fades at its sides, and facets
-- at the ends of the junction have all corners on a rim.
for _, angle in ipairs { 90, 60, 45 } do
  for _, radius in ipairs { 12, 20, 24 } do
    local file = params.scratch .. "/tee"
    check.write(file .. ".geo", ([[SetFactory("OpenCASCADE");
Cylinder(1) = {-150, 0, 0, 300, 0, 0, 30};
Cylinder(2) = {0, 0, 0, %.15g, 0, %.15g, %g};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };]]):format(
      160 * math.cos(math.rad(angle)), 160 * math.sin(math.rad(angle)), radius))
    local model = lacuna.load(file .. ".geo")
    model:open_volume():write_facets(file .. ".stl")
    local volumes = {}
    for _, own in ipairs { model, lacuna.load(file .. ".stl") } do
      local quality = own:open_volume():sweep({ size = 7 }):quality()
      check.that(quality.certified and quality.min_scaled_jacobian > 0.1, quality.min_scaled_jacobian)
      volumes[#volumes + 1] = quality.volume
    end
    check.near(volumes[2], volumes[1], 0.01 * volumes[1])
  end
end

--- A body of Open CASCADE is meshed by hexahedra of its volume, none with a scaled Jacobian below `least`.
local function is_swept(geo, size, least, word)
  local file = params.scratch .. "/body.geo"
  check.write(file, 'SetFactory("OpenCASCADE");\n' .. geo .. "\n")
  local mesh = lacuna.load(file):open_volume():sweep { size = size }
  local quality = mesh:quality()
  check.that(quality.certified and mesh.tets == 0 and quality.min_scaled_jacobian > least,
    ("%s: %.3f"):format(word, quality.min_scaled_jacobian))
  check.near(quality.volume, mesh.fidelity.sealed_volume, 0.02 * quality.volume)
end

-- Reducing tees: the circle at the small end of the cone is no mouth, wherever the branch is.
for _, member in ipairs { { 40, 25, -60, 20 }, { 40, 30, -40, 15 }, { 25, 40, 85, 20 },
  { 40, 25, 100, 12 } } do
  local left, right, at, radius = table.unpack(member)
  is_swept(([[
Cylinder(1) = {-120, 0, 0, 120, 0, 0, %g}; Cone(2) = {0, 0, 0, 40, 0, 0, %g, %g};
Cylinder(3) = {40, 0, 0, 100, 0, 0, %g}; Cylinder(4) = {%g, 0, 0, 0, 0, 90, %g};
BooleanUnion(5) = { Volume{1}; Delete; }{ Volume{2:4}; Delete; };]]):format(
    left, left, right, right, at, radius), 8, 0.3, "reducing tee with a branch at " .. at)
end

-- Blind branches with a round bottom.
for _, radius in ipairs { 15, 24 } do
  is_swept(([[
Cylinder(1) = {-100, 0, 0, 200, 0, 0, 30}; Cylinder(2) = {0, 0, 0, 0, 0, 60, %g}; Sphere(3) = {0, 0, 60, %g};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2:3}; Delete; };]]):format(radius, radius), 6, 0.2,
    "blind branch of radius " .. radius)
end

-- Tubes lead from header to header: one, or several that close a ring, where a cut at one mouth divides
-- nothing.
for _, member in ipairs { { { -60, 60 }, { 120, 10 } }, { { -60, 60 }, { 60, 10 }, { 140, 14 } },
  { { -70, 0, 70 }, { 60, 9 }, { 120, 9 }, { 180, 9 } } } do
  local geo = {}
  for k, y in ipairs(member[1]) do geo[k] = ("Cylinder(%d) = {0, %g, 0, 240, 0, 0, 20};"):format(k, y) end
  for k = 2, #member do
    local x, radius = table.unpack(member[k])
    geo[#geo + 1] = ("Cylinder(%d) = {%g, %g, 0, 0, %g, 0, %g};"):format(
      #geo + 1, x, member[1][1], member[1][#member[1]] - member[1][1], radius)
  end
  local bodies = #geo
  geo[#geo + 1] = ("BooleanUnion(%d) = { Volume{1}; Delete; }{ Volume{2:%d}; Delete; };"):format(
    bodies + 1, bodies)
  is_swept(table.concat(geo, "\n"), 7, 0.3, #member[1] .. " headers")
end

-- The mouths of a pipe with a dead leg end different pieces, and each is a group of its own.
do
  local file = params.scratch .. "/dead_leg.geo"
  check.write(file, [[
SetFactory("OpenCASCADE");
Cylinder(1) = {-150, 0, 0, 300, 0, 0, 40}; Cylinder(2) = {0, 0, 0, 0, 0, 120, 25};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };]])
  local model = lacuna.load(file)
  local faces = {}
  for _, face in ipairs(model:info().faces) do
    if face.kind ~= "plane" or math.abs(face.centroid[1]) < 149 then faces[#faces + 1] = face.tag end
  end
  local mouths = {}
  for _, group in ipairs(model:open_volume({ faces = faces }):sweep({ size = 16 }):groups()) do
    if group.name:match "^void:%d+$" then mouths[#mouths + 1] = group.cells end
  end
  check.equal(#mouths, 2)
  check.equal(mouths[1], mouths[2])
end

-- Chambers with ports to several sides whose outer ends are missing: boxes, vessels with a ledge, and balls.
local chambers = {
  box = "Box(1) = {-50, -40, -30, 100, 80, 60};",
  vessel = "Cylinder(1) = {0, 0, -50, 0, 0, 100, 40};",
  disc = "Cylinder(1) = {0, 0, -20, 0, 0, 40, 35};",
  ball = "Sphere(1) = {0, 0, 0, 45};",
  capsule = "Cylinder(98) = {0, 0, -20, 0, 0, 40, 35}; Sphere(97) = {0, 0, -20, 35};\n" ..
    "Sphere(96) = {0, 0, 20, 35}; BooleanUnion(1) = { Volume{98}; Delete; }{ Volume{96:97}; Delete; };",
  rounded = "Box(98) = {-50, -40, -30, 100, 80, 60}; Fillet{98}{1:12}{10}",
  drilled = "Cylinder(98) = {0, 0, -40, 0, 0, 80, 30}; Cylinder(97) = {0, 0, -80, 0, 0, 40, 16};\n" ..
    "Cone(96) = {0, 0, -80, 0, 0, -9.2, 16, 0};\n" ..
    "BooleanUnion(1) = { Volume{98}; Delete; }{ Volume{96:97}; Delete; };",
  -- a globe valve: a lower chamber with a pipe, a seat, an upper chamber
  valve = "Cylinder(98) = {0, 0, -56, 0, 0, 30, 35}; Cylinder(97) = {0, 0, -26, 0, 0, 6, 18};\n" ..
    "Cylinder(96) = {0, 0, -20, 0, 0, 40, 35}; Cylinder(95) = {0, 0, -41, -100, 0, 0, 12};\n" ..
    "BooleanUnion(1) = { Volume{98}; Delete; }{ Volume{95:97}; Delete; };",
}
local ports = {
  x = { 100, 0, 0, 15 }, w = { -100, 0, 0, 15 }, y = { 0, 90, 0, 12 }, v = { 0, -90, 0, 10 },
  z = { 0, 0, 80, 12 }, d = { 0, 0, -80, 10 },
}
for _, member in ipairs { { "box", "xz" }, { "box", "xyz" }, { "box", "xwz" }, { "box", "xwyvz" },
  { "vessel", "xz" }, { "vessel", "xy" }, { "disc", "xz" }, { "disc", "xwz" }, { "ball", "xwz" },
  { "ball", "xwyz" }, { "drilled", "xz" }, { "valve", "xz" },
  { "rounded", "xz" }, { "capsule", "xzd" } } do
  local lines, open_at = { 'SetFactory("OpenCASCADE");', chambers[member[1]] }, {}
  for port in member[2]:gmatch "." do
    local x, y, z, radius = table.unpack(ports[port])
    lines[#lines + 1] = ("Cylinder(%d) = {0, 0, 0, %d, %d, %d, %d};"):format(#lines, x, y, z, radius)
    open_at[#open_at + 1] = { x, y, z }
  end
  lines[#lines + 1] = ("BooleanUnion(99) = { Volume{1}; Delete; }{ Volume{2:%d}; Delete; };"):format(
    #lines - 1)
  check.write(params.scratch .. "/chamber.geo", table.concat(lines, "\n") .. "\n")
  local model = lacuna.load(params.scratch .. "/chamber.geo")
  local faces = {}
  for _, face in ipairs(model:faces()) do
    local open = false
    for _, place in ipairs(open_at) do
      open = open or face.kind == "plane" and face == model:face { near = place, kind = "plane" }
    end
    if not open then faces[#faces + 1] = face end
  end
  check.equal(#faces + #open_at, #model:faces())
  local mesh = model:open_volume({ faces = faces }):sweep { size = 7 }
  local quality = mesh:quality()
  check.that(quality.certified and mesh.tets == 0 and quality.min_scaled_jacobian > 0.2,
    ("%s with ports %s: %.3f"):format(member[1], member[2], quality.min_scaled_jacobian))
  check.near(quality.volume, mesh.fidelity.sealed_volume, 0.05 * quality.volume)
end
print(("%d meshed in %d arms, %d refused; %d of %d that turn from branch to branch meshed"):format(meshed,
  arms, refused, turned, turning))
check.that(refused <= 0.1 * params.members)
check.done()
