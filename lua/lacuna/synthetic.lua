-- SPDX-License-Identifier: MIT
-- lacuna.synthetic: open volumes of any class and size, for tests and benchmarks.
--
-- Each volume is a section (a list of closed loops in the plane, the outer one counter-clockwise, holes
-- clockwise) swept along an axis by a map (x, y, t) -> point with t in [0, 1]. Adjacent faces compute their
-- common points by the same call with the same numbers, so the points agree to the bit.
local lacuna, internal = ...
local synthetic = {}
lacuna.synthetic = synthetic

local pi, sin, cos = math.pi, math.sin, math.cos

-- --- options ---------------------------------------------------------------------------------------------

-- Kinds of option values: a test and its description.
local kinds = {
  number = { function(v) return v == v and v ~= math.huge and v ~= -math.huge end, "a number" },
  positive = { function(v) return v > 0 and v < math.huge end, "a positive number" },
  not_negative = { function(v) return v >= 0 and v < math.huge end, "a number of at least 0" },
  count = { function(v) return v >= 1 and math.tointeger(v) end, "a positive whole number" },
  whole = { function(v) return v >= 0 and math.tointeger(v) end, "a whole number of at least 0" },
  sides = { function(v) return v >= 3 and math.tointeger(v) end, "a whole number of at least 3" },
}

local function fail(call, ...)
  internal.fail("lua.bad_value", "synthetic." .. call .. ": " .. string.format(...))
end

-- Limit on the facets of a synthetic volume; more are a mistake, or belong in a file.
local most_facets = 2e7

-- Refuse a boundary that would exceed the limit by itself, before it is generated.
local function check_rim(call, points, options)
  if not (2 * points <= most_facets) then
    fail(call, "the walls would have %.3g facets, the limit is %.3g; reduce %s", 2 * points,
         most_facets, options)
  end
end

-- Options merged with their defaults. spec: key -> { default, kind }.
local function read_options(call, spec, given)
  if given == nil then given = {} end
  if type(given) ~= "table" then
    fail(call, "the options must be a table { key = value, ... }, found %s", internal.found(given))
  end
  local keys = { "drop", "facets" }
  for key in pairs(spec) do keys[#keys + 1] = key end
  table.sort(keys)
  local known = {}
  for _, key in ipairs(keys) do known[key] = true end
  for key, value in pairs(given) do
    if type(key) ~= "string" then
      fail(call, "%s is an option without a name; write key = value", internal.found(value))
    elseif not known[key] then
      fail(call, "unknown option '%s'; the nearest is '%s'. The keys are: %s", key,
          internal.nearest(key, keys),
           table.concat(keys, ", "))
    end
  end
  local read = {}
  spec.facets = spec.facets or { false, "count" }
  for key, rule in pairs(spec) do
    local value = given[key]
    if value == nil then
      value = rule[1]
    else
      local test, expected = table.unpack(kinds[rule[2]])
      if type(value) ~= "number" or not test(value) then
        fail(call, "option '%s' must be %s, found %s", key, expected, internal.found(value))
      end
      value = math.tointeger(value) or value
    end
    if key == "facets" and value then check_rim(call, value, "'facets'") end
    read[key] = value
  end
  return read, given.drop
end

-- The set of faces to leave out; "walls" means every wall.
local function read_drop(call, drop, names)
  local left_out = {}
  if drop == nil then return left_out end
  if type(drop) == "string" then drop = { drop } end
  if type(drop) ~= "table" then
    fail(call, "option 'drop' must be an array of names of faces, found %s", internal.found(drop))
  end
  local known = { walls = true }
  for _, name in ipairs(names) do known[name] = true end
  for i, name in ipairs(drop) do
    if type(name) ~= "string" then
      fail(call, "option 'drop[%d]' must be the name of a face, found %s", i, internal.found(name))
    end
    if not known[name] then
      fail(call, "option 'drop' names \"%s\", which is not a face of this volume; the nearest is \"%s\". "
          .. "The faces are: %s",
           name, internal.nearest(name, names), table.concat(names, ", "))
    end
    left_out[name] = true
  end
  if left_out.walls then
    for _, name in ipairs(names) do
      if name:match("^wall_") then left_out[name] = true end
    end
  end
  return left_out
end

-- --- sections --------------------------------------------------------------------------------------------

-- A loop: points {x, y}, and the indices of its corners; there is one wall between consecutive corners. A
-- loop without corners is one closed wall.
local function reversed(loop)
  local points, corners, n = {}, {}, #loop.points
  for i = 1, n do points[i] = loop.points[(n + 1 - i) % n + 1] end  -- starts at the same point
  for i = #loop.corners, 1, -1 do
    corners[#corners + 1] = (n + 1 - loop.corners[i]) % n + 1
  end
  table.sort(corners)
  return { points = points, corners = corners }
end

-- A regular polygon, or a polygon through `corners`, with each side divided into `cuts`.
local function polygon(corners, cuts)
  local loop = { points = {}, corners = {} }
  for i, a in ipairs(corners) do
    local b = corners[i % #corners + 1]
    loop.corners[i] = #loop.points + 1
    for k = 0, cuts - 1 do
      local s = k / cuts
      loop.points[#loop.points + 1] = { a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2]) }
    end
  end
  return loop
end

local function regular(sides, radius, x, y, cuts)
  local corners = {}
  for i = 1, sides do
    local angle = 2 * pi * (i - 1) / sides
    corners[i] = { x + radius * cos(angle), y + radius * sin(angle) }
  end
  return polygon(corners, cuts)
end

local function circle(radius, x, y, facets)
  local loop = regular(facets, radius, x, y, 1)
  loop.corners = {}
  return loop
end

-- --- sweeping a section ----------------------------------------------------------------------------------

-- Source and target: the section at t = 0 seen from below, and at t = 1 seen from above.
local function end_face(section, map, t)
  local flat, loops = {}, {}
  for l, loop in ipairs(section) do
    loops[l] = {}
    for i, p in ipairs(loop.points) do
      flat[#flat + 1] = p
      loops[l][i] = #flat
    end
  end
  local points = {}
  for i, p in ipairs(flat) do points[i] = { map(p[1], p[2], t) } end
  local cells = internal.triangles(flat, loops)
  if t == 0 then
    for _, cell in ipairs(cells) do cell[2], cell[3] = cell[3], cell[2] end
  end
  return points, cells
end

-- The wall over points `from`..`to` of a loop (`to` may exceed the last point; the whole loop gives a closed
-- wall).
local function wall_face(loop, from, to, map, levels)
  local points, cells, n = {}, {}, #loop.points
  local closed = to - from == n
  local columns = closed and n or to - from + 1
  for level = 0, levels do
    for i = 0, columns - 1 do
      local p = loop.points[(from - 1 + i) % n + 1]
      points[#points + 1] = { map(p[1], p[2], level / levels) }
    end
  end
  for level = 0, levels - 1 do
    for i = 0, to - from - 1 do
      local a = level * columns + i + 1
      local b = level * columns + (i + 1) % columns + 1
      cells[#cells + 1] = { a, b, b + columns }
      cells[#cells + 1] = { a, b + columns, a + columns }
    end
  end
  return points, cells
end

-- The walls of a section: { loop, from, to }, those of the outer loop first.
local function walls_of(section)
  local walls = {}
  for _, loop in ipairs(section) do
    if #loop.corners == 0 then walls[#walls + 1] = { loop, 1, #loop.points + 1 } end
    for i, corner in ipairs(loop.corners) do
      local last = loop.corners[i + 1] or loop.corners[1] + #loop.points
      walls[#walls + 1] = { loop, corner, last }
    end
  end
  return walls
end

local function build(call, section, map, levels, drop)
  local around = 0
  for _, loop in ipairs(section) do around = around + #loop.points end
  if not (2 * around * levels <= most_facets) then
    fail(call, "the walls would have %.3g facets, the limit is %.3g; "
        .. "reduce 'twist', 'bend', 'angle' or 'facets'",
         2 * around * levels, most_facets)
  end
  local walls = walls_of(section)
  local names = { "source", "target" }
  for i = 1, #walls do names[#names + 1] = "wall_" .. i end
  local left_out = read_drop(call, drop, names)
  local model = lacuna.model()
  local function add(name, points, cells) model:add_face { name = name, points = points, cells = cells } end
  if not left_out.source then add("source", end_face(section, map, 0)) end
  if not left_out.target then add("target", end_face(section, map, 1)) end
  for i, wall in ipairs(walls) do
    local name = "wall_" .. i
    if not left_out[name] then add(name, wall_face(wall[1], wall[2], wall[3], map, levels)) end
  end
  return model
end

-- A straight axis along z, or one of the same length that bends towards +x by `bend` degrees.
local function axis(height, bend)
  local angle = math.rad(bend)
  if angle == 0 then return function(x, y, t) return x, y, height * t end end
  local r = height / angle
  return function(x, y, t)
    return r - (r - x) * cos(angle * t), y, (r - x) * sin(angle * t)
  end
end

-- Number of rows of facets along a curved axis. Each row is as long as the facets of the section, and turns
-- by at most five degrees.
local function levels_for(length, segment, turn)
  return math.max(1, math.ceil(length / segment), math.ceil(math.abs(turn) / 5))
end

-- --- the volumes -----------------------------------------------------------------------------------------

-- Regular polygonal holes in a regular prism: one in the centre, or several on a circle.
local function prism_holes(call, o, cuts)
  local holes = {}
  if o.holes == 0 then return holes end
  local inner = o.radius * cos(pi / o.sides)  -- radius of the inscribed circle
  local centre = o.holes == 1 and 0 or 0.55 * inner
  local room = o.holes == 1 and inner or math.min(centre * sin(pi / o.holes), inner - centre)
  local radius = o.hole_radius or 0.6 * room
  if radius >= room then
    fail(call, "option 'hole_radius' must be below %.6g for %d holes to fit, found %.6g", room, o.holes,
        radius)
  end
  for h = 1, o.holes do
    local angle = 2 * pi * (h - 1) / o.holes
    holes[h] = reversed(regular(o.sides, radius, centre * cos(angle), centre * sin(angle), cuts))
  end
  return holes
end

--- prism { sides, radius, height, holes, hole_radius, twist, taper, bend [degrees], facets, drop }
function synthetic.prism(given)
  local o, drop = read_options("prism", {
    sides = { 6, "sides" }, radius = { 1, "positive" }, height = { 2, "positive" }, holes = { 0, "whole" },
    hole_radius = { false, "positive" }, twist = { 0, "number" }, taper = { 1, "positive" },
        bend = { 0, "number" },
  }, given)
  if o.bend ~= 0 and math.abs(o.height / math.rad(o.bend)) <= o.radius * math.max(1, o.taper) then
    fail("prism", "option 'bend' of %.6g degrees over height %.6g folds a prism of radius %.6g; "
        .. "reduce 'bend' or increase 'height'",
         o.bend, o.height, o.radius * math.max(1, o.taper))
  end
  local side = 2 * o.radius * sin(pi / o.sides)
  local cuts = o.facets or (o.twist ~= 0 and 6 or 2)
  check_rim("prism", o.sides * cuts * (1 + o.holes), "'sides', 'holes' or 'facets'")
  local section = { regular(o.sides, o.radius, 0, 0, cuts), table.unpack(prism_holes("prism", o, cuts)) }
  local straight, twist = axis(o.height, o.bend), math.rad(o.twist)
  local function map(x, y, t)
    local scale, c, s = 1 + (o.taper - 1) * t, cos(twist * t), sin(twist * t)
    return straight(scale * (c * x - s * y), scale * (s * x + c * y), t)
  end
  local curved = o.twist ~= 0 or o.bend ~= 0
  local levels = curved and levels_for(o.height, side / cuts, math.abs(o.twist) + math.abs(o.bend)) or 1
  return build("prism", section, map, levels, drop)
end

--- annulus { inner, outer, height, facets, drop }: wall_1 is the outer cylinder, wall_2 the inner one
function synthetic.annulus(given)
  local o, drop = read_options("annulus", {
    inner = { 0.5, "positive" }, outer = { 1, "positive" }, height = { 1, "positive" },
  }, given)
  if o.inner >= o.outer then
    fail("annulus", "option 'inner' must be below 'outer', found %.6g and %.6g", o.inner, o.outer)
  end
  local facets = math.max(3, o.facets or 48)
  local section = { circle(o.outer, 0, 0, facets), reversed(circle(o.inner, 0, 0, facets)) }
  return build("annulus", section, axis(o.height, 0), 1, drop)
end

--- elbow { radius, inner, bend_radius, angle [degrees], facets, drop }: a bent pipe; wall_2 is the bore, if
--- `inner` > 0
function synthetic.elbow(given)
  local o, drop = read_options("elbow", {
    radius = { 1, "positive" }, inner = { 0, "not_negative" }, bend_radius = { 3, "positive" },
        angle = { 90, "positive" },
  }, given)
  if o.bend_radius <= o.radius then
    fail("elbow", "option 'bend_radius' must be above 'radius', found %.6g and %.6g", o.bend_radius, o.radius)
  end
  if o.inner >= o.radius then
    fail("elbow", "option 'inner' must be below 'radius', found %.6g and %.6g", o.inner, o.radius)
  end
  if o.angle >= 360 then fail("elbow", "option 'angle' must be below 360 degrees, found %.6g", o.angle) end
  local facets = math.max(3, o.facets or 32)
  local section = { circle(o.radius, 0, 0, facets) }
  if o.inner > 0 then section[2] = reversed(circle(o.inner, 0, 0, facets)) end
  local length = o.bend_radius * math.rad(o.angle)
  local levels = levels_for(length, 2 * pi * o.radius / facets, o.angle)
  return build("elbow", section, axis(length, o.angle), levels, drop)
end

--- barrel { radius, height, bulge, facets, drop }: radius (1 + bulge) half way up
function synthetic.barrel(given)
  local o, drop = read_options("barrel", {
    radius = { 1, "positive" }, height = { 2, "positive" }, bulge = { 0.3, "number" },
  }, given)
  if o.bulge <= -1 then fail("barrel", "option 'bulge' must be above -1, found %.6g", o.bulge) end
  local facets = math.max(3, o.facets or 48)
  local function map(x, y, t)
    local scale = 1 + o.bulge * 4 * t * (1 - t)
    return scale * x, scale * y, o.height * t
  end
  local levels = math.max(12, levels_for(o.height, 2 * pi * o.radius / facets, 0))
  return build("barrel", { circle(o.radius, 0, 0, facets) }, map, levels, drop)
end

--- plate { length, width, height, holes, hole_radius, facets, drop }: round holes in rows; walls 1 to 4 are
--- the sides
function synthetic.plate(given)
  local o, drop = read_options("plate", {
    length = { 4, "positive" }, width = { 4, "positive" }, height = { 0.5, "positive" },
        holes = { 4, "whole" },
    hole_radius = { false, "positive" },
  }, given)
  local x, y = o.length / 2, o.width / 2
  local section = { polygon({ { -x, -y }, { x, -y }, { x, y }, { -x, y } }, 4) }
  local columns = math.max(1, math.ceil(math.sqrt(o.holes * o.length / o.width)))
  local rows = math.max(1, math.ceil(o.holes / columns))
  local dx, dy = o.length / columns, o.width / rows
  local room = math.min(dx, dy) / 2
  local radius = o.hole_radius or 0.5 * room
  if o.holes > 0 and radius >= room then
    fail("plate", "option 'hole_radius' must be below %.6g for %d holes to fit, found %.6g", room, o.holes,
        radius)
  end
  for h = 0, o.holes - 1 do
    local cx, cy = -x + (h % columns + 0.5) * dx, -y + (h // columns + 0.5) * dy
    section[#section + 1] = reversed(circle(radius, cx, cy, math.max(3, o.facets or 24)))
  end
  return build("plate", section, axis(o.height, 0), 1, drop)
end
