-- SPDX-License-Identifier: MIT
-- Noisy scans: tubes, bones, bent tubes and square ducts of 14,400 facets, open at both ends, with noise of
-- 5 to 40 % of the sides. Each is read, sealed and swept without naming anything, and encloses what the clean
-- surface does.
-- usage: lacuna scans.lua lacuna=PROGRAM scratch=FOLDER
local lacuna = require "lacuna"
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local params = lacuna.params { lacuna = "", scratch = "." }

local around, up = 60, 120
local radius, half = around / (2 * math.pi), around / 8

--- Places on the surfaces; sides of facets are about 1 long.
local shapes = {
  tube = function(u, v)
    return radius * math.cos(2 * math.pi * u), radius * math.sin(2 * math.pi * u), v * up
  end,
  bone = function(u, v)
    local r = radius * (0.75 + 0.25 * math.cos(2 * math.pi * v))
    return 1.2 * r * math.cos(2 * math.pi * u), 0.85 * r * math.sin(2 * math.pi * u), v * up
  end,
  bent = function(u, v)
    local angle, bend = 1.4 * v, up / 1.4
    local out = bend + radius * math.cos(2 * math.pi * u)
    return out * math.cos(angle), radius * math.sin(2 * math.pi * u), out * math.sin(angle)
  end,
  duct = function(u, v)
    local side, share = math.floor(4 * u), 4 * u % 1
    local corners = { { -half, -half }, { half, -half }, { half, half }, { -half, half }, { -half, -half } }
    local a, b = corners[side + 1], corners[side + 2]
    return a[1] + (b[1] - a[1]) * share, a[2] + (b[2] - a[2]) * share, v * up
  end,
}

local function places(shape, noise, seed)
  local random = check.random(seed)
  local function off() -- normal, by Box and Muller
    return noise * math.sqrt(-2 * math.log(random(1e-9, 1))) * math.cos(2 * math.pi * random(0, 1))
  end
  local rows = {}
  for j = 0, up do
    rows[j] = {}
    for i = 0, around - 1 do
      local x, y, z = shape(i / around, j / up)
      rows[j][i] = noise > 0 and { x + off(), y + off(), z + off() } or { x, y, z }
    end
  end
  return rows
end

local function facets(rows)
  local made = {}
  for j = 0, up - 1 do
    for i = 0, around - 1 do
      local a, b = rows[j][i], rows[j][(i + 1) % around]
      local c, d = rows[j + 1][(i + 1) % around], rows[j + 1][i]
      made[#made + 1] = { a, b, c }
      made[#made + 1] = { a, c, d }
    end
  end
  return made
end

--- A sawn tube: the outer skin, the bore and the flat cuts are one skin with sharp rims.
local function sawn(noise, seed)
  local random, made, rows = check.random(seed), {}, {}
  local function off() return noise * (random(-1, 1) + random(-1, 1) + random(-1, 1)) end
  local section = {} -- r and z along a closed line
  local function line(r1, z1, r2, z2, steps)
    for k = 0, steps - 1 do
      section[#section + 1] = { r1 + (r2 - r1) * k / steps, z1 + (z2 - z1) * k / steps }
    end
  end
  local inner = radius / 2
  line(radius, 0, radius, 30, 30)
  line(radius, 30, inner, 30, 5)
  line(inner, 30, inner, 0, 30)
  line(inner, 0, radius, 0, 5)
  for j, at in ipairs(section) do
    rows[j] = {}
    for i = 0, around - 1 do
      local t = 2 * math.pi * i / around
      rows[j][i] = { at[1] * math.cos(t) + off(), at[1] * math.sin(t) + off(), at[2] + off() }
    end
  end
  for j = 1, #rows do
    for i = 0, around - 1 do
      local next_row, k = rows[j % #rows + 1], (i + 1) % around
      made[#made + 1] = { rows[j][i], rows[j][k], next_row[k] }
      made[#made + 1] = { rows[j][i], next_row[k], next_row[i] }
    end
  end
  return made, around / 2 * math.sin(2 * math.pi / around) * inner ^ 2 * 30
end

--- What they enclose with a fan in each end.
local function enclosed(rows)
  local all, sum = facets(rows), 0
  for j = 0, up, up do
    local middle = { 0, 0, 0 }
    for i = 0, around - 1 do
      for k = 1, 3 do middle[k] = middle[k] + rows[j][i][k] / around end
    end
    for i = 0, around - 1 do
      local a, b = rows[j][i], rows[j][(i + 1) % around]
      all[#all + 1] = j == 0 and { b, a, middle } or { a, b, middle }
    end
  end
  for _, t in ipairs(all) do
    local a, b, c = t[1], t[2], t[3]
    sum = sum + a[1] * (b[2] * c[3] - b[3] * c[2]) + a[2] * (b[3] * c[1] - b[1] * c[3])
        + a[3] * (b[1] * c[2] - b[2] * c[1])
  end
  return math.abs(sum) / 6
end

local function write(path, rows, all)
  local file <close> = assert(io.open(path, "wb"))
  all = all or facets(rows)
  file:write(("\0"):rep(80), ("<I4"):pack(#all))
  for _, t in ipairs(all) do
    local a, b, c = t[1], t[2], t[3]
    file:write(("<ffffffffffff"):pack(0, 0, 0, a[1], a[2], a[3], b[1], b[2], b[3], c[1], c[2], c[3]), "\0\0")
  end
end

local path = params.scratch .. "/scan.stl"
local tried, swept = 0, 0
for _, name in ipairs { "tube", "bone", "bent", "duct" } do
  local volume = enclosed(places(shapes[name], 0, 1))
  for _, noise in ipairs(check.whole and { 0.05, 0.1, 0.2, 0.3, 0.4 } or { 0.2, 0.4 }) do
    for seed = 1, check.whole and 3 or 1 do
      write(path, places(shapes[name], noise, seed))
      local at = ("%s, noise %g, seed %d"):format(name, noise, seed)
      local model = lacuna.load(path)
      check.equal(#model:faces(), name == "duct" and 4 or 1, at)
      tried = tried + 1
      local fine, mesh = pcall(function() return model:open_volume():sweep { size = 3 } end)
      if fine then
        swept = swept + 1
        check.that(mesh:quality().certified and mesh:quality().min_scaled_jacobian >= 0.2, at)
        check.that(math.abs(mesh:quality().volume / volume - 1) < 0.02, at .. ": volume")
      end
    end
  end
end
check.that(swept >= 0.95 * tried, ("%d of %d swept"):format(swept, tried))

-- The note tells how far points moved; with keep_noise they stay where they are.
local function area(rows)
  local sum = 0
  for _, t in ipairs(facets(rows)) do
    local u, v = {}, {}
    for k = 1, 3 do u[k], v[k] = t[2][k] - t[1][k], t[3][k] - t[1][k] end
    local x, y, z = u[2] * v[3] - u[3] * v[2], u[3] * v[1] - u[1] * v[3], u[1] * v[2] - u[2] * v[1]
    sum = sum + math.sqrt(x * x + y * y + z * z) / 2
  end
  return sum
end
local rows = places(shapes.tube, 0.2, 1)
write(path, rows)
check.near(lacuna.load(path, { keep_noise = true }):face(1).area, area(rows), 1e-3)
check.that(lacuna.load(path):face(1).area < 0.95 * area(rows), "it is not smoothed")
local code, _, said = check.run(params.lacuna, params.scratch, { "-" }, "require 'lacuna'.load 'scan.stl'")
check.equal(code, 0)
check.that(said:find "note: .*noisy.*smoothed.*keep_noise", said)

-- Saw cuts stay flat and their rims sharp; no point moves by more than a few times the noise.
for _, noise in ipairs { 0.03, 0.06, 0.1, 0.15, 0.2 } do
  local skin, marrow = sawn(noise, 7)
  write(path, nil, skin)
  _, _, said = check.run(params.lacuna, params.scratch, { "-" }, "require 'lacuna'.load 'scan.stl'")
  local most = tonumber(said:match "and ([%d.e-]+) at most") or 0
  check.that(most <= 6 * noise, ("noise %g: %g"):format(noise, most))
  local model = lacuna.load(path)
  check.equal(#model:faces(), 4, "noise " .. noise)
  local mesh = model:open_volume({ walls = model:face { near = { radius / 2, 0, 15 } } }):sweep { size = 1.5 }
  check.that(mesh:quality().min_scaled_jacobian > 0.3)
  check.near(mesh:quality().volume, marrow, 0.03 * marrow)
end
os.remove(path)

--- Facets of a smooth junction of a tube of radius 1 along x with a branch, and one along y at x = `aside`,
--- open where they leave the box: the level 0 of a smooth minimum of distances, on tetrahedra.
local function junction(radius, slope, sway, aside)
  local function value(x, y, z)
    y = y - sway * x * x / 8
    local along = math.max(0, (x * slope + z) / (1 + slope * slope))
    local tube = math.sqrt(y * y + z * z) - 1
    local branch = math.sqrt((x - slope * along) ^ 2 + y * y + (z - along) ^ 2) - radius
    local other = aside and y > 0 and math.sqrt((x - aside) ^ 2 + z * z) - 0.5 or 1
    return -math.log(math.exp(-6 * tube) + math.exp(-6 * branch) + math.exp(-6 * other)) / 6
  end
  local step, facets, corners, values = 0.2, {}, {}, {}
  local low, count = { -3.97, -1.97 - 2 * sway, -1.57 }, { 40, 20 + math.ceil(20 * sway), 26 }
  local function corner(i, j, k)
    local key = (i * 100 + j) * 100 + k
    if not corners[key] then
      corners[key] = { low[1] + i * step, low[2] + j * step, low[3] + k * step }
      values[key] = value(table.unpack(corners[key]))
    end
    return key
  end
  local function cross(a, b)
    local f = values[a] / (values[a] - values[b])
    local p, q = corners[a], corners[b]
    return { p[1] + f * (q[1] - p[1]), p[2] + f * (q[2] - p[2]), p[3] + f * (q[3] - p[3]) }
  end
  local function add(a, b, c) facets[#facets + 1] = { a, b, c } end
  for i = 0, count[1] - 1 do
    for j = 0, count[2] - 1 do
      for k = 0, count[3] - 1 do
        local from, to = corner(i, j, k), corner(i + 1, j + 1, k + 1)
        local ring = { corner(i + 1, j, k), corner(i + 1, j + 1, k), corner(i, j + 1, k),
          corner(i, j + 1, k + 1), corner(i, j, k + 1), corner(i + 1, j, k + 1) }
        for side = 1, 6 do
          local inside, outside = {}, {}
          for _, p in ipairs { from, to, ring[side], ring[side % 6 + 1] } do
            local list = values[p] < 0 and inside or outside
            list[#list + 1] = p
          end
          if #inside == 1 or #inside == 3 then
            local one, others = inside, outside
            if #inside == 3 then one, others = outside, inside end
            add(cross(one[1], others[1]), cross(one[1], others[2]), cross(one[1], others[3]))
          elseif #inside == 2 then
            local a, b = cross(inside[1], outside[1]), cross(inside[1], outside[2])
            local c, d = cross(inside[2], outside[2]), cross(inside[2], outside[1])
            add(a, b, c)
            add(a, c, d)
          end
        end
      end
    end
  end
  local lines = { "solid junction" }
  for _, facet in ipairs(facets) do
    lines[#lines + 1] = "facet normal 0 0 0\nouter loop"
    for _, p in ipairs(facet) do lines[#lines + 1] = ("vertex %.9g %.9g %.9g"):format(p[1], p[2], p[3]) end
    lines[#lines + 1] = "endloop\nendfacet"
  end
  lines[#lines + 1] = "endsolid\n"
  check.write(params.scratch .. "/junction.stl", table.concat(lines, "\n"))
  return lacuna.load(params.scratch .. "/junction.stl")
end

-- Smooth junctions with three open ends, such as a scanned artery, and with four, to several sides: a tube
-- is a face of its own.
local members = { { 0.5, 0, 0 }, { 0.7, 0.5, 0 }, { 0.85, 0, 0.3 }, { 0.6, 0.4, 0.4 }, { 0.5, 0, 0, 0.5 },
  { 0.7, 0, 0, 1.8 } }
for _, member in ipairs(members) do
  local model = junction(table.unpack(member))
  check.equal(#model:faces(), member[4] and 5 or 4)
  local mesh = model:open_volume {}:sweep { size = 0.3 }
  local quality = mesh:quality()
  check.that(quality.certified and quality.min_scaled_jacobian > (member[4] and 0.15 or 0.25))
  check.that(math.abs(quality.volume / mesh.fidelity.sealed_volume - 1) < 0.02)
end

-- A bent tube of eight facets a turn is no scan: its points stay, and where its facets bend as much as at
-- edges, the refusal says what to load it with.
do
  local random, points, made = check.random(7), {}, { "solid" }
  local function facet(...)
    made[#made + 1] = "facet normal 0 0 0\nouter loop"
    for _, k in ipairs { ... } do
      made[#made + 1] = ("vertex %.9g %.9g %.9g"):format(table.unpack(points[k]))
    end
    made[#made + 1] = "endloop\nendfacet"
  end
  for j = 0, 20 do
    for i = 0, 7 do
      local a = math.pi / 4 * (i + j % 2 / 2 + random(-0.15, 0.15))
      local b = math.pi / 20 * (j + (j % 20 > 0 and random(-0.125, 0.125) or 0))
      local out = 9 + 3 * math.cos(a)
      points[#points + 1] = { out * math.cos(b), out * math.sin(b), 3 * math.sin(a) }
    end
  end
  for j = 0, 19 do
    for i = 0, 7 do
      local a, b = 8 * j + i + 1, 8 * j + (i + 1) % 8 + 1
      facet(a, b, j % 2 == 0 and a + 8 or b + 8)
      facet(j % 2 == 0 and b or a, b + 8, a + 8)
    end
  end
  made[#made + 1] = "endsolid\n"
  local path = params.scratch .. "/coarse.stl"
  check.write(path, table.concat(made, "\n"))
  local model = lacuna.load(path)
  check.that(#model:faces() > 1)
  check.fails(function() model:open_volume({ walls = model:faces() }):sweep {} end, "feature_angle")
  local whole = lacuna.load(path, { feature_angle = 70 })
  check.equal(#whole:faces(), 1)
  local mesh = whole:open_volume({ walls = whole:faces() }):sweep {}
  local volume = 9 * math.pi * 8 / 2 * 9 * math.sin(math.pi / 4)
  check.near(mesh:quality().volume, volume, 0.05 * volume)
end

check.done()
