-- SPDX-License-Identifier: MIT
-- Members of an assembly that share faces in part: pins in plates, bands on cylinders, boards on standoffs.
-- Each is a solid of its own, of CAD or of facets of its own fineness; what they share becomes faces of both.
-- usage: lacuna contact.lua scratch=FOLDER [first=N last=N]
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local params = lacuna.params { scratch = ".", first = 0, last = -1 }

-- --- solids -----------------------------------------------------------------------------------------------

-- A solid is a prism along z over an outline, less holes:
-- { low, high, outline, holes = { { outline, low } } }; a hole with `low` is open at the top alone.
-- An outline is { "round", x, y, radius } or { "square", x, y, half width, half depth }.

--- Area of an outline; of a circle as a polygon of `sides`.
local function area(outline, sides)
  if outline[1] == "round" then return sides / 2 * math.sin(2 * math.pi / sides) * outline[4] ^ 2 end
  return 4 * outline[4] * outline[5]
end

local function volume(solid, sides)
  local sum = area(solid.outline, sides) * (solid.high - solid.low)
  for _, hole in ipairs(solid.holes or {}) do
    sum = sum - area(hole[1], sides) * (solid.high - (hole[2] or solid.low))
  end
  return sum
end

local function numbers(...)
  local words = { ... }
  for i, number in ipairs(words) do words[i] = ("%.15g"):format(number) end
  return table.concat(words, ", ")
end

local function cad_prism(number, outline, low, high)
  local _, x, y, a, b = table.unpack(outline)
  if outline[1] == "round" then
    return ("Cylinder(%d) = {%s, %.15g, 2*Pi};"):format(number, numbers(x, y, low, 0, 0, high - low), a)
  end
  return ("Box(%d) = {%s};"):format(number, numbers(x - a, y - b, low, 2 * a, 2 * b, high - low))
end

--- A file of the solid for Open CASCADE; the seam of a round one is at the angle `turn`.
local function cad(solid, turn, path)
  local lines = { 'SetFactory("OpenCASCADE");', cad_prism(1, solid.outline, solid.low, solid.high) }
  if solid.outline[1] == "round" then
    local place = numbers(solid.outline[2], solid.outline[3], 0)
    lines[1] = lines[1] .. "\n" .. table.remove(lines)
    lines[1] = lines[1] .. ("\nRotate { {0, 0, 1}, {%s}, %.15g } { Volume{1}; }"):format(place, turn)
  else
    lines[1] = lines[1] .. "\n" .. table.remove(lines)
  end
  for n, hole in ipairs(solid.holes or {}) do
    lines[#lines + 1] = cad_prism(n + 1, hole[1], hole[2] or solid.low - 1, solid.high + 1)
  end
  if #lines > 1 then
    lines[#lines + 1] = ("BooleanDifference{ Volume{1}; Delete; }{ Volume{2:%d}; Delete; }"):format(#lines)
  end
  check.write(path, table.concat(lines, "\n") .. "\n")
  return lacuna.load(path)
end

--- Corners of an outline; a circle has `sides`.
local function ring(outline, sides)
  local kind, x, y, a, b = table.unpack(outline)
  if kind == "square" then
    return { { x - a, y - b }, { x + a, y - b }, { x + a, y + b }, { x - a, y + b } }
  end
  local corners = {}
  for i = 1, sides do
    local t = 2 * math.pi * (i - 0.5) / sides
    corners[i] = { x + a * math.cos(t), y + a * math.sin(t) }
  end
  return corners
end

local function bridged(loops)
  -- One polygon of an outline and its holes, joined at the pair of corners that see each other.
  local polygon = table.move(loops[1], 1, #loops[1], 1, {})
  local function crosses(p, q, r, s)
    local function side(a, b, c) return (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]) end
    return side(p, q, r) * side(p, q, s) < 0 and side(r, s, p) * side(r, s, q) < 0
  end
  local order = {}
  for n = 2, #loops do order[#order + 1] = loops[n] end
  local function right(loop)
    local most = -math.huge
    for _, p in ipairs(loop) do most = math.max(most, p[1]) end
    return most
  end
  table.sort(order, function(a, b) return right(a) > right(b) end)
  for _, hole in ipairs(order) do
    local from = 1
    for i, p in ipairs(hole) do if p[1] > hole[from][1] then from = i end end
    local best, at = math.huge, nil
    for i, p in ipairs(polygon) do
      local free = p[1] > hole[from][1]
      for _, other in ipairs { polygon, table.unpack(order) } do
        for k = 1, #other do
          free = free and not crosses(p, hole[from], other[k], other[k % #other + 1])
        end
      end
      local far = (p[1] - hole[from][1]) ^ 2 + (p[2] - hole[from][2]) ^ 2
      if free and far < best then best, at = far, i end
    end
    local joined = {}
    for i = 1, at do joined[i] = polygon[i] end
    for k = 0, #hole do joined[#joined + 1] = hole[(from - 1 - k) % #hole + 1] end -- clockwise
    for i = at, #polygon do joined[#joined + 1] = polygon[i] end
    polygon = joined
  end
  return polygon
end

--- Triangles of a polygon by cutting off the ear with the largest least angle.
local function triangles(loops)
  local left, out = bridged(loops), {}
  local function side(a, b, c) return (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]) end
  local function same(a, b) return a[1] == b[1] and a[2] == b[2] end
  while #left > 2 do
    local best, at = -1, nil
    for i, b in ipairs(left) do
      local a, c = left[(i - 2) % #left + 1], left[i % #left + 1]
      local twice = side(a, b, c)
      local longest = math.max((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2, (c[1] - b[1]) ^ 2 + (c[2] - b[2]) ^ 2,
        (a[1] - c[1]) ^ 2 + (a[2] - c[2]) ^ 2)
      if twice > 1e-12 and twice / longest > best then
        local empty = true
        for _, p in ipairs(left) do
          if not (same(p, a) or same(p, b) or same(p, c)) and side(a, b, p) >= 0 and side(b, c, p) >= 0
            and side(c, a, p) >= 0 then
            empty = false
          end
        end
        if empty then best, at = twice / longest, i end
      end
    end
    assert(at, "no ear is left")
    out[#out + 1] = { left[(at - 2) % #left + 1], left[at], left[at % #left + 1] }
    table.remove(left, at)
  end
  return out
end

--- The solid as faces of facets { name, triangles of points }.
local function facet_faces(solid, sides)
  local faces = {}
  local function lid(name, loops, z, up)
    local cells = {}
    for _, t in ipairs(triangles(loops)) do
      local p = {}
      for k = 1, 3 do p[k] = { t[k][1], t[k][2], z } end
      cells[#cells + 1] = up and p or { p[3], p[2], p[1] }
    end
    faces[#faces + 1] = { name, cells }
  end
  local function wall(name, corners, low, high, outward)
    local cells = {}
    for i, p in ipairs(corners) do
      local q = corners[i % #corners + 1]
      local a, b, c, d = { p[1], p[2], low }, { q[1], q[2], low }, { q[1], q[2], high }, { p[1], p[2], high }
      if not outward then a, b, c, d = b, a, d, c end
      cells[#cells + 1], cells[#cells + 2] = { a, b, c }, { a, c, d }
      if #corners == 4 then
        faces[#faces + 1] = { name .. "_" .. i, cells }
        cells = {}
      end
    end
    if #corners > 4 then faces[#faces + 1] = { name, cells } end
  end
  local outline = ring(solid.outline, sides)
  local top, bottom = { outline }, { outline }
  for n, hole in ipairs(solid.holes or {}) do
    local corners = ring(hole[1], sides)
    top[#top + 1] = corners
    if hole[2] then
      lid("floor_" .. n, { corners }, hole[2], true)
    else
      bottom[#bottom + 1] = corners
    end
    wall("hole_" .. n, corners, hole[2] or solid.low, solid.high, false)
  end
  lid("top", top, solid.high, true)
  lid("bottom", bottom, solid.low, false)
  wall("side", outline, solid.low, solid.high, true)
  return faces
end

local function added(solid, sides)
  local model = lacuna.model()
  for _, face in ipairs(facet_faces(solid, sides)) do
    local points, cells = {}, {}
    for i, t in ipairs(face[2]) do
      for k = 1, 3 do points[#points + 1] = t[k] end
      cells[i] = { 3 * i - 2, 3 * i - 1, 3 * i }
    end
    model:add_face { name = face[1], points = points, cells = cells }
  end
  return model
end

local function stl(solid, sides, path)
  local lines = { "solid part" }
  for _, face in ipairs(facet_faces(solid, sides)) do
    for _, t in ipairs(face[2]) do
      lines[#lines + 1] = "facet normal 0 0 0\nouter loop"
      for k = 1, 3 do lines[#lines + 1] = "vertex " .. ("%.15g %.15g %.15g"):format(table.unpack(t[k])) end
      lines[#lines + 1] = "endloop\nendfacet"
    end
  end
  lines[#lines + 1] = "endsolid part"
  check.write(path, table.concat(lines, "\n") .. "\n")
  return lacuna.load(path)
end

-- --- the family -------------------------------------------------------------------------------------------

--- Ends of a pin in a plate from 0 to `thick`, by kind.
local kEnds = { "flush", "up", "down", "both", "inside", "into" }
local function ends(kind, thick, random)
  local out, within = random(0.3, 1.5) * thick, random(0.25, 0.4) * thick
  local low = ({ flush = 0, up = 0, down = -out, both = -out, inside = within, into = within })[kind]
  local high = ({ flush = thick, up = thick + out, down = thick, both = thick + random(0.3, 1.5) * thick,
    inside = thick - random(0.25, 0.35) * thick, into = thick + out })[kind]
  return low, high
end

local function outline(random, x, y, most)
  local half = random(0.45, 0.9) * most
  if random(0, 1) < 0.7 then return { "round", x, y, half } end
  return { "square", x, y, half, random(0.6, 1) * half }
end

local kinds = {}

function kinds.pin(random)
  local thick, r = random(4, 14), random(5, 10)
  local kind = kEnds[math.ceil(random(0, #kEnds))]
  local low, high = ends(kind, thick, random)
  local pin = outline(random, random(-8, 8), random(-4, 4), r)
  local plate = { low = 0, high = thick, outline = { "square", 0, 0, 28, 20 }, holes = { { pin } } }
  return { plate, { low = low, high = high, outline = pin } }, kind .. " " .. pin[1]
end

function kinds.plates(random)
  local first, second = random(4, 10), random(4, 10)
  local gap = random(0, 1) < 0.5 and 0 or random(3, 8)
  local pin, plate = outline(random, 0, 0, 9), { "square", 0, 0, 25, 20 }
  local low, high = random(0, 1) < 0.5 and 0 or -random(2, 6), first + gap + second
  if random(0, 1) < 0.5 then high = high + random(2, 6) end
  return {
    { low = 0, high = first, outline = plate, holes = { { pin } } },
    { low = first + gap, high = first + gap + second, outline = plate, holes = { { pin } } },
    { low = low, high = high, outline = pin },
  }, ("%s gap %.3g"):format(pin[1], gap)
end

function kinds.two(random)
  local thick = random(5, 10)
  local solids = { { low = 0, high = thick, outline = { "square", 0, 0, 32, 18 }, holes = {} } }
  local words = {}
  for n = 1, 2 do
    local pin = outline(random, n == 1 and -14 or 14, random(-3, 3), 8)
    local kind = kEnds[math.ceil(random(0, #kEnds))]
    local low, high = ends(kind, thick, random)
    solids[1].holes[n] = { pin }
    solids[n + 1] = { low = low, high = high, outline = pin }
    words[n] = kind .. " " .. pin[1]
  end
  return solids, table.concat(words, ", ")
end

function kinds.blind(random)
  local thick = random(8, 14)
  local floor = random(0.3, 0.6) * thick
  local pin = outline(random, random(-5, 5), random(-4, 4), 9)
  local high = random(0, 1) < 0.3 and thick or thick + random(3, 10)
  return {
    { low = 0, high = thick, outline = { "square", 0, 0, 25, 20 }, holes = { { pin, floor } } },
    { low = floor, high = high, outline = pin },
  }, pin[1] .. (high == thick and " flush" or " up")
end

function kinds.band(random)
  local radius, height, width = random(5, 9), random(20, 40), random(5, 10)
  local core = { "round", 0, 0, radius }
  local number, solids = random(0, 1) < 0.6 and 1 or 2, { { low = 0, high = height, outline = core } }
  local tube, square = random(0, 1) < 0.3, random(0, 1) < 0.3
  if tube then solids[1].holes = { { { "round", 0, 0, radius * random(0.4, 0.7) } } } end
  for n = 1, number do
    local low, half = (n - 0.5) / number * height - width / 2, radius * random(1.3, 2)
    solids[n + 1] = { low = low, high = low + math.min(width, height / 3), holes = { { core } },
      outline = square and { "square", 0, 0, half, half * random(1, 1.3) } or { "round", 0, 0, half } }
  end
  return solids, number .. " bands" .. (tube and " on a tube" or "") .. (square and ", square" or "")
end

function kinds.rack(random)
  local first, second, gap = random(4, 8), random(4, 8), random(5, 12)
  local far = random(0, 1) < 0.5 and 0 or random(2, 5)
  local plates = {
    { low = 0, high = first, outline = { "square", 0, 0, 30, 18 }, holes = {} },
    { low = first + gap, high = first + gap + second, outline = { "square", 0, 0, 30, 18 }, holes = {} },
  }
  local solids, number = { plates[1], plates[2] }, math.ceil(random(1, 4))
  local places = { { -19, -9 }, { 19, 9 }, { 19, -9 }, { -19, 9 } }
  for n = 1, number do
    local pin = outline(random, places[n][1], places[n][2], 6)
    plates[1].holes[n], plates[2].holes[n] = { pin }, { pin }
    solids[n + 2] = { low = -far, high = first + gap + second + far, outline = pin }
  end
  return solids, number .. " pins" .. (far > 0 and ", out" or "")
end

function kinds.board(random)
  local high, thick = random(4, 10), random(2, 4)
  local number = math.ceil(random(1, 4))
  local solids = { { low = high, high = high + thick, outline = { "square", 0, 0, 30, 20 } } }
  local places = { { -20, -11 }, { 20, 11 }, { 20, -11 }, { -20, 11 } }
  for n = 1, number do
    solids[n + 1] = { low = 0, high = high, outline = outline(random, places[n][1], places[n][2], 6) }
  end
  -- One in the corner of the board.
  local flush = random(0, 1) < 0.2
  if flush then solids[2].outline = { "square", -25, -16, 5, 4 } end
  local base = random(0, 1) < 0.4
  if base then solids[#solids + 1] = { low = -thick, high = 0, outline = { "square", 0, 0, 33, 22 } } end
  return solids, number .. " standoffs" .. (flush and ", one flush" or "") .. (base and " on a base" or "")
end

local kOrder = { "pin", "board", "pin", "band", "two", "pin", "plates", "blind", "rack", "board" }

--- Member `number` of the family becomes one mesh of all its volumes.
local function meshes(number)
  local random = check.random(7919 * number + 17)
  for _ = 1, 5 do random(0, 1) end
  local kind = kOrder[number % #kOrder + 1]
  local solids, words = kinds[kind](random)
  local form = ({ "cad", "cad", "added", "stl" })[math.ceil(random(0, 4))]
  local size = random(0, 1) < 0.7 and random(2.5, 4) or nil
  local asked = size and ("%.3g"):format(size) or "default"
  local at = ("%d %s %s, %s, size %s"):format(number, kind, words, form, asked)
  local volumes, whole, turn = {}, 0, random(0, 1) < 0.5 and 0 or random(0, 6)
  for n, solid in ipairs(solids) do
    local path = ("%s/%03d_%d"):format(params.scratch, number, n)
    local sides = math.floor(random(20, 40)) -- each member its own
    local model = form == "cad" and cad(solid, n * turn, path .. ".geo")
      or form == "stl" and stl(solid, sides, path .. ".stl") or added(solid, sides)
    -- All faces: of facets alone, a bore is taken for the space otherwise.
    volumes[n] = model:open_volume { name = "member_" .. n, faces = model:faces() }
    whole = whole + volume(solid, form == "cad" and 1e4 or sides)
  end
  local fine, mesh = pcall(function() return lacuna.assembly(volumes):sweep { size = size } end)
  check.that(fine, at .. ": " .. tostring(mesh))
  local quality = mesh:quality()
  check.that(quality.certified, at)
  -- Sizes that are asked for decide how well chords follow circles.
  local share, least = quality.volume / whole, quality.min_scaled_jacobian
  check.that(math.abs(share - 1) < (size and 0.02 or 0.01), at .. ": volume " .. share)
  check.that(least >= 0.3, ("%s: least scaled Jacobian %.3g"):format(at, least))
  return at, quality
end

check.family(params, function(number)
  local at, quality = meshes(number)
  return ("%s: %.2f %.4f"):format(at, quality.min_scaled_jacobian, quality.volume)
end)

-- Boards with components, fragmented by the CAD system: every face that two solids share is a whole face of
-- both. The board is swept through its thickness, because no layers follow the rims of components on its top.
for number = 1, 6 do
  local random = check.random(number)
  local solids = { { 0, 0, 60, 40, 0, 2 } } -- middle, width, depth, low, high; of cylinders the radius alone
  local places = { { -18, -8 }, { 16, 9 }, { 17, -10 }, { -14, 10 } }
  for n = 1, 1 + number % 4 do
    local x, y = table.unpack(places[n])
    local below = number > 4 and n == 2
    local low, high = 2, 2 + random(3, 9)
    if below then low, high = -random(3, 9), 0 end
    local square = random(0, 1) < 0.5
    solids[n + 1] = { x, y, square and random(5, 10) or random(3, 5), square and random(5, 10), low, high }
  end
  local lines, whole = { 'SetFactory("OpenCASCADE");' }, 0
  for n, solid in ipairs(solids) do
    local x, y, a, b, low, high = table.unpack(solid)
    local deep = high - low
    lines[n + 1] = b
      and ("Box(%d) = {%g,%g,%g, %g,%g,%g};"):format(n, x - a / 2, y - b / 2, low, a, b, deep)
      or ("Cylinder(%d) = {%g,%g,%g, 0,0,%g, %g};"):format(n, x, y, low, deep, a)
    whole = whole + (b and a * b or math.pi * a ^ 2) * deep
  end
  local path = params.scratch .. "/board.geo"
  check.write(path, table.concat(lines, "\n") .. "\nCoherence;\n")
  local model, volumes = lacuna.load(path), {}
  for n, solid in ipairs(solids) do
    local x, y, a, b, low, high = table.unpack(solid)
    local u, v = b and a / 2 or a, b and b / 2 or a
    local box = { { x - u - 0.01, y - v - 0.01, low - 0.01 }, { x + u + 0.01, y + v + 0.01, high + 0.01 } }
    volumes[n] = model:open_volume { faces = { box = box }, name = n == 1 and "board" or "part_" .. n }
  end
  for _, fallback in ipairs { "none", "mixed" } do
    local quality = lacuna.assembly(volumes):sweep({ size = 2.5, fallback = fallback }):quality()
    check.equal(quality.tets, 0, number .. " " .. fallback)
    check.near(quality.volume, whole, 0.01 * whole)
    check.that(quality.min_scaled_jacobian >= 0.5, number .. ": " .. quality.min_scaled_jacobian)
  end
end

-- Members that no single sweep fills are cut as they are alone: an angle with bores in both legs on its
-- plate, and the resin around a floating board with components, which is swept too.
local function fragmented(solids, boxes, size, whole)
  local path, volumes = params.scratch .. "/cut.geo", {}
  check.write(path, 'SetFactory("OpenCASCADE");\n' .. solids .. "\nCoherence;\n")
  local model = lacuna.load(path)
  for n, box in ipairs(boxes) do
    local faces = box.all and model:faces() or { box = box }
    volumes[n] = model:open_volume { faces = faces, name = "member_" .. n }
  end
  for _, fallback in ipairs { "none", "mixed" } do
    local quality = lacuna.assembly(volumes):sweep({ size = size, fallback = fallback }):quality()
    check.equal(quality.tets, 0, fallback)
    check.near(quality.volume, whole, 0.01 * whole)
    check.that(quality.min_scaled_jacobian >= 0.5, "least " .. quality.min_scaled_jacobian)
  end
end

for thick = 4, 8, 2 do
  local bores = 2 * math.pi * 16 * thick
  fragmented(([[
Box(1) = {0,0,0, 40,30,%d}; Box(2) = {0,0,%d, %d,30,30};
Cylinder(3) = {28,15,-1, 0,0,20, 4}; Cylinder(4) = {-1,15,22, 20,0,0, 4};
BooleanUnion(10) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
BooleanDifference(11) = { Volume{10}; Delete; }{ Volume{3,4}; Delete; };
Box(20) = {-10,-10,-5, 60,50,5};]]):format(thick, thick, thick), {
    { { -0.1, -0.1, -0.1 }, { 40.1, 30.1, 30.1 + thick } },
    { { -10.1, -10.1, -5.1 }, { 50.1, 40.1, 0.1 } },
  }, 3, 40 * 30 * thick + thick * 30 * 30 - bores + 60 * 50 * 5)
end
fragmented([[
Box(1) = {-28,-18,0, 56,36,20}; Box(2) = {-25,-16,4, 50,32,1.6}; Box(3) = {-18,-5,5.6, 12,10,6};
Cylinder(4) = {10,0,5.6, 0,0,10, 4};]], {
  { { -25.1, -16.1, 3.9 }, { 25.1, 16.1, 5.7 } }, { { -18.1, -5.1, 5.5 }, { -5.9, 5.1, 11.7 } },
  { { 5.9, -4.1, 5.5 }, { 14.1, 4.1, 15.7 } }, { all = true },
}, 2.5, 56 * 36 * 20)

-- Boxes of three heights side by side: those between unlike neighbours would have both ends divided, unlike.
do
  local lines, volumes, whole = { 'SetFactory("OpenCASCADE");' }, {}, 0
  for n = 0, 35 do
    local high = 1 + n // 6 % 3 / 2
    lines[n + 2] = ("Box(%d) = {%d,%d,0, 1,1,%g};"):format(n + 1, n // 6, n % 6, high)
    whole = whole + high
  end
  local path = params.scratch .. "/heights.geo"
  check.write(path, table.concat(lines, "\n"))
  local model = lacuna.load(path)
  for n = 0, 35 do
    local faces = {}
    for k = 1, 6 do faces[k] = 6 * n + k end
    volumes[n + 1] = model:open_volume { faces = faces }
  end
  local quality = lacuna.assembly(volumes):sweep({ size = 0.5 }):quality()
  check.near(quality.volume, whole, 1e-9)
  check.that(quality.min_scaled_jacobian > 0.5, "boxes: " .. quality.min_scaled_jacobian)
end

-- A boss that overhangs the edge of its plate: the plate's edge crosses the exact circle, not its chords.
for _, x in ipairs { 55, 58 } do
  local plate, boss = params.scratch .. "/plate.geo", params.scratch .. "/boss.geo"
  check.write(plate, 'SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 60, 40, 6};\n')
  check.write(boss, ('SetFactory("OpenCASCADE");\nCylinder(9) = {%g, 20, 6, 0, 0, 20, 8};\n'):format(x))
  local model = lacuna.load { plate, boss }
  local mesh = lacuna.assembly {
    model:open_volume { faces = { 1, 2, 3, 4, 5, 6 }, name = "plate" },
    model:open_volume { faces = { 7, 8, 9 }, name = "boss" },
  }:sweep { size = 3 }
  check.near(mesh:quality().volume, 60 * 40 * 6 + math.pi * 64 * 20, 60)
  check.that(mesh.report.near_misses[1] == nil, "shares its part of the plate")
end

-- A band on a core, each of facets of its own fineness. The facets beside the cut along the first rim of the
-- band are bent, and the cut along the second one crosses them.
for _, sides in ipairs { { 22, 30 }, { 26, 30 }, { 34, 30 } } do
  local round, members = { "round", 0, 0, 7 }, {}
  local solids = { { low = 0, high = 30, outline = round },
    { low = 10, high = 16, outline = { "square", 0, 0, 12, 13 }, holes = { { round } } } }
  local whole = 0
  for n, solid in ipairs(solids) do
    local model = added(solid, sides[n])
    members[n] = model:open_volume { name = "member_" .. n, faces = model:faces() }
    whole = whole + volume(solid, sides[n])
  end
  local quality = lacuna.assembly(members):sweep({ size = 4 }):quality()
  check.near(quality.volume, whole, 0.02 * whole)
  check.that(quality.min_scaled_jacobian >= 0.3, table.concat(sides, " "))
end

-- Default sizes: a post does not make its plate fine.
local posts = { ["Box(7) = {10, 10, 6, 3, 3, 8};"] = 2, ["Cylinder(7) = {10, 10, 6, 0, 0, 8, 2};"] = 6 }
for post, most in pairs(posts) do
  local plate, path = params.scratch .. "/plate.geo", params.scratch .. "/post.geo"
  check.write(plate, 'SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 60, 40, 6};\n')
  check.write(path, 'SetFactory("OpenCASCADE");\n' .. post .. "\n")
  local wide = lacuna.load(plate):open_volume()
  local alone = wide:sweep():quality().hexes
  local mesh = lacuna.assembly { wide, lacuna.load(path):open_volume() }:sweep()
  local hexes = mesh:quality().hexes
  check.that(hexes <= most * alone, ("%s: %d hexahedra, its plate %d"):format(post, hexes, alone))
  check.that(mesh:quality().min_scaled_jacobian >= 0.3, post)
end
