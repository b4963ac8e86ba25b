-- SPDX-License-Identifier: MIT
-- Branches of branches: random trees of round and square ducts, from CAD, cut into arms and meshed as one.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")
local params = lacuna.params { members = check.whole and 16 or 4, scratch = "." }

local random = check.random(99)

local axes = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }
local function along(p, d, t) return { p[1] + t * d[1], p[2] + t * d[2], p[3] + t * d[3] } end

--- A main body along z and one to four branches, each on any of those before it, to any side of it.
local function tree()
  local ducts = { { from = { 0, 0, 0 }, dir = axes[3], length = 3, radius = 1, square = random(0, 1) < 0.3 } }
  local wanted = math.floor(random(2, 5.999))
  for _ = 1, 20 do
    if #ducts == wanted then break end
    local place = math.floor(random(1, #ducts + 0.999))
    local host = ducts[place]
    local radius = host.radius * random(0.4, 0.8)
    if radius > 0.25 then
      local at = host.length - 3 * host.radius + radius + random(0.4, 0.7)
      local dir
      repeat
        local axis, sign = axes[math.floor(random(1, 3.999))], random(0, 1) < 0.5 and -1 or 1
        dir = { sign * axis[1], sign * axis[2], sign * axis[3] }
      until dir[1] * host.dir[1] + dir[2] * host.dir[2] + dir[3] * host.dir[3] == 0
      ducts[#ducts + 1] = { from = along(host.from, host.dir, at), dir = dir, length = host.radius + 2.2,
        radius = radius, square = host.square and random(0, 1) < 0.5, host = place }
      host.length = math.max(host.length, at + radius + 1.2 * host.radius, at + radius + 3 * host.radius)
      host.tail = math.max(at + radius + host.radius, place > 1 and ducts[host.host].radius + 1 or 0)
    end
  end
  return ducts
end

local function write(ducts, path)
  local lines = { 'SetFactory("OpenCASCADE");' }
  for i, duct in ipairs(ducts) do
    local length = duct.tail or duct.length
    local f, d, r = duct.from, duct.dir, duct.radius
    if duct.square then
      local low, size = {}, {}
      for k = 1, 3 do
        local wide = d[k] == 0 and r or 0
        low[k] = math.min(f[k], f[k] + length * d[k]) - wide
        size[k] = length * math.abs(d[k]) + 2 * wide
      end
      lines[#lines + 1] = ("Box(%d) = {%g, %g, %g, %g, %g, %g};"):format(i, low[1], low[2], low[3], size[1],
        size[2], size[3])
    else
      lines[#lines + 1] = ("Cylinder(%d) = {%g, %g, %g, %g, %g, %g, %g};"):format(i, f[1], f[2], f[3],
        length * d[1], length * d[2], length * d[3], r)
    end
  end
  local others = {}
  for i = 2, #ducts do others[#others + 1] = ("Volume{%d};"):format(i) end
  lines[#lines + 1] = "BooleanUnion(100) = {Volume{1}; Delete;}{" .. table.concat(others, " ") .. " Delete;};"
  check.write(path, table.concat(lines, "\n") .. "\n")
end

local meshed, arms, deep, deep_meshed, refused = 0, 0, 0, 0, {}
for _ = 1, params.members do
  local ducts = tree()
  local is_deep = false
  for _, duct in ipairs(ducts) do is_deep = is_deep or (duct.host or 1) > 1 end
  if is_deep then deep = deep + 1 end
  local path = params.scratch .. "/tree.geo"
  write(ducts, path)
  local fine, found = pcall(function() return lacuna.load(path):open_volume():sweep { size = 0.3 } end)
  if fine then
    meshed, arms = meshed + 1, arms + #found.regions
    if is_deep then deep_meshed = deep_meshed + 1 end
    check.equal(found:quality().certified, true)
    check.near(found.fidelity.volume / found.fidelity.sealed_volume, 1, 0.03)
  else
    local code = tostring(found):match "%[([%a_]+%.[%a_]+)%]"
    check.that(code, "refused by name: " .. tostring(found))
    refused[code] = (refused[code] or 0) + 1
  end
end
print(("%d of %d trees meshed in %d arms; %d of %d where a branch has branches"):format(meshed,
  params.members, arms, deep_meshed, deep))
for code, count in pairs(refused) do print("", code, count) end

-- Axes that do not meet: meshed as long as the branch is within the sides of its main body.
local tees = { { 0.1, 0.6 }, { 0.3, 0.6 }, { 0.4, 0.6 }, { 0.3, 0.7 }, { 0.3, 0.8 }, { 0.5, 0.6 } }
local runs = check.members_to_run(4) -- one within the sides, one beyond
for _, tee in ipairs(tees) do
  if not runs() then goto next end
  local offset, radius = tee[1], tee[2]
  local path = params.scratch .. "/offset.geo"
  check.write(path, ([[SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, -5, 0, 0, 10, 1};
Cylinder(2) = {0, %g, 0, 4, 0, 0, %g};
BooleanUnion(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};
]]):format(offset, radius))
  local function sweep() return lacuna.load(path):open_volume():sweep { size = 0.3 } end
  if offset + radius <= 1 then
    local mesh = sweep()
    check.equal(mesh:quality().certified, true)
    check.equal(#mesh.regions, 3)
  else
    check.fails(sweep, "closure.branches", "the branch of face", "beyond the side of the main body")
  end
  ::next::
end

-- Oblique branches, and branches that leave to sides oblique to each other: where cuts end at mouths, cells
-- are improved together with those of the neighbouring arms, and no node leaves the tubes. At order 2, sides
-- inside do not follow columns in zigzag. Order and size, and for each branch: its place on the axis, angle
-- to it, angle about it, radius.
local families = {
  { 1, 0.27, { 0, 45, 0, 0.4 } }, { 1, 0.27, { 0, 60, 0, 0.7 } },
  { 1, 0.27, { -2.7, 90, 0, 0.4 }, { 2.7, 90, 160, 0.4 } }, { 1, 0.27, { 0, 45, 0, 0.7 } },
  { 2, 0.15, { 0, 90, 0, 0.5 } }, { 1, 0.27, { -2.7, 90, 0, 0.4 }, { 2.7, 90, 110, 0.4 } },
  { 2, 0.19, { 0, 90, 0, 0.625 } },
}
local members = check.members_to_run(2)
for _, family in ipairs(families) do
  if not members() then goto next end
  local tubes = { { from = { 0, 0, -6 }, dir = axes[3], radius = 1, length = 12 } }
  for n = 3, #family do
    local at, lean, turn, radius = table.unpack(family[n])
    lean, turn = math.rad(lean), math.rad(turn)
    local dir = { math.sin(lean) * math.cos(turn), math.sin(lean) * math.sin(turn), math.cos(lean) }
    tubes[#tubes + 1] = { from = { 0, 0, at }, dir = dir, radius = radius,
      length = 1 / math.sin(lean) + radius / math.tan(lean) + 2 }
  end
  local path = params.scratch .. "/oblique.geo"
  write(tubes, path)
  local mesh = lacuna.load(path):open_volume():sweep { size = family[2], order = family[1] }
  local least = mesh:quality().min_scaled_jacobian
  check.that(least >= 0.3, tostring(least))
  check.near(mesh.fidelity.volume / mesh.fidelity.sealed_volume, 1, 0.01)
  for n = 1, mesh.nodes do
    local off, at = math.huge, { mesh:node(n) }
    for _, t in ipairs(tubes) do
      local out, along = 0, 0
      for k = 1, 3 do
        out, along = out + (at[k] - t.from[k]) ^ 2, along + (at[k] - t.from[k]) * t.dir[k]
      end
      off = math.min(off, math.sqrt(math.max(0, out - along ^ 2)) - t.radius)
    end
    check.that(off < 1e-4, tostring(off))
  end
  ::next::
end
check.that(meshed >= 0.55 * params.members and deep_meshed >= 0.4 * deep)
check.done()
