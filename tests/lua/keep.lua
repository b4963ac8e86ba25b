-- SPDX-License-Identifier: MIT
-- Quads that came in stay as they are: every node bit for bit, every quad once, on the source's end of the
-- mesh.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"

local N = 5

-- A box whose source is N x N quads with nodes where no rule puts them, its rim included; the rest triangles.
local function box(options)
  local model = lacuna.model()
  local at = { 0, 0.13, 0.31, 0.57, 0.79, 1 }
  local function place(i, j)
    local x, y = at[i + 1], at[j + 1]
    if i > 0 and i < N and j > 0 and j < N then
      x, y = x + 0.05 * math.sin(7 * i + 3 * j), y + 0.05 * math.cos(5 * i - j)
    end
    return { x, y, 0 }
  end
  local points, cells = {}, {}
  for j = 0, N do for i = 0, N do points[#points + 1] = place(i, j) end end
  for j = 0, N - 1 do
    for i = 0, N - 1 do
      local a = j * (N + 1) + i + 1
      cells[#cells + 1] = { a, a + 1, a + N + 2, a + N + 1 }
    end
  end
  model:add_face { name = "source", points = points, cells = cells, keep_mesh = options.keep_mesh ~= false }
  local top = { { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } }
  model:add_face { name = "target", points = top, cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
  local rim = { {}, {}, {}, {} }
  for k = 0, N do
    rim[1][k + 1], rim[2][k + 1] = place(k, 0), place(N, k)
    rim[3][k + 1], rim[4][k + 1] = place(N - k, N), place(0, N - k)
  end
  for side = 1, 4 do
    local wall, triangles = {}, {}
    for k = 1, N + 1 do wall[k] = rim[side][k] end
    wall[N + 2], wall[N + 3] = top[side % 4 + 1], top[side]
    for k = 1, N do triangles[k] = { k, k + 1, N + 3 } end
    triangles[N + 1] = { N + 1, N + 2, N + 3 }
    model:add_face { name = "wall_" .. side, points = wall, cells = triangles }
  end
  return model, points
end

local function key(x, y, z) return string.format("%a %a %a", x, y, z) end

local function check_kept(mesh, points)
  check.equal(mesh.hexes, 3 * N * N)
  local found = {}
  for i = 1, mesh.nodes do
    local x, y, z = mesh:node(i)
    if z == 0 then found[key(x, y, z)] = (found[key(x, y, z)] or 0) + 1 end
  end
  for _, p in ipairs(points) do check.equal(found[key(p[1], p[2], p[3])], 1) end
end

for _, quads in ipairs { "auto", "keep" } do
  local model, points = box {}
  check.equal(model:face("source").has_mesh, true)
  local volume = model:open_volume { source = "source", target = "target", walls = "auto" }
  check_kept(volume:sweep { layers = 3, size = 0.5, quads = quads }, points)
end

-- Two sides missing: void walls take the given nodes too.
do
  local model, points = box {}
  local volume = model:open_volume { source = "source", target = "target", walls = { "wall_1", "wall_2" } }
  check_kept(volume:sweep { layers = 3, quads = "keep" }, points)
end

-- Not asked to keep, and not able to.
do
  local model = box { keep_mesh = false }
  local volume = model:open_volume { source = "source", target = "target", walls = "auto" }
  check.equal(volume:sweep({ layers = 3, size = 0.5 }).hexes, 3 * 2 * 2)
  local ok, message = pcall(function() return volume:sweep { layers = 3, quads = "keep" } end)
  check.equal(ok, false)
  assert(message:find("source", 1, true) and message:find("auto", 1, true), message)
end

-- A face of across x along quads; `place` takes shares of both ways. Gives its number of nodes.
local function grid_face(model, name, across, along, keep, place)
  local points, cells = {}, {}
  for j = 0, along do for i = 0, across do points[#points + 1] = place(i / across, j / along) end end
  for j = 0, along - 1 do
    for i = 1, across do
      local a = j * (across + 1) + i
      cells[#cells + 1] = { a, a + 1, a + across + 2, a + across + 1 }
    end
  end
  model:add_face { name = name, points = points, cells = cells, keep_mesh = keep }
  return #points
end

local function check_both_kept(model, count)
  local mesh = model:open_volume({ source = "source", target = "target" }):sweep { layers = 4 }
  local kept = 0
  for _, line in ipairs(mesh.report) do
    if line:find(("%d of %d nodes coincide"):format(count, count), 1, true) then kept = kept + 1 end
  end
  check.equal(kept, 2)
end

-- Both ends of a sector came with meshes, no walls: shapes leave open how it turns, the given sides do not.
for _, far in ipairs { 0.15, 0.3, 0.5, 0.7, 0.85 } do
  for _, grid in ipairs { { 2, 4 }, { 4, 2 }, { 1, 3 }, { 5, 4 } } do
    for _, degrees in ipairs { 20, 30, 45 } do
      local model, turn = lacuna.model(), math.rad(degrees)
      local function sector(radius)
        return function(u, v) return { 0.1 * u, radius * math.cos(turn * v), radius * math.sin(turn * v) } end
      end
      local count = grid_face(model, "source", grid[1], grid[2], true, sector(0.1))
      grid_face(model, "target", grid[1], grid[2], true, sector(far))
      check_both_kept(model, count)
    end
  end
end

-- A prism is not twisted by a quarter turn for the mesh of its target: it is what it is without one.
do
  local function volume(tilt, turn, grid, keep)
    local model = lacuna.model()
    grid_face(model, "source", grid[1], grid[2], keep, function(x, y) return { x - 0.5, y - 0.5, 0 } end)
    grid_face(model, "target", grid[3], grid[4], keep, function(x, y)
      x, y = x - 0.5, y - 0.5
      local u, v = x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)
      return { u * math.cos(tilt), v, 6 + u * math.sin(tilt) }
    end)
    local open = model:open_volume { source = "source", target = "target" }
    return open:sweep({ layers = 4, size = 0.2 }).fidelity.sealed_volume
  end
  for _, tilt in ipairs { 0, 0.3, 0.6, 1.2 } do
    for _, degrees in ipairs { 0, 10, 20, 30 } do
      for _, grid in ipairs { { 2, 5, 5, 2 }, { 4, 6, 6, 4 }, { 3, 3, 3, 3 } } do
        local turn = math.rad(degrees)
        local with, without = volume(tilt, turn, grid, true), volume(tilt, turn, grid, false)
        assert(math.abs(with / without - 1) < 0.01,
          ("tilt %g, turn %g: %g for %g"):format(tilt, degrees, with, without))
      end
    end
  end
end

-- Ends that came with as many sides, of other lengths and with more corners: nodes meet nodes.
for _, grading in ipairs { 1, 1.4, 2 } do
  for _, grid in ipairs { { 3, 6 }, { 4, 9 }, { 6, 12 } } do
    for _, bump in ipairs { 2, 4 } do
      for _, on_source in ipairs { false, true } do
        local model = lacuna.model()
        local function board(height, power, bumped)
          return function(u, v)
            local at_bump = bumped and u == 1 and math.floor(v * grid[2] + 0.5) == bump
            return { 3 * u + (at_bump and 1.2 or 0), 5 * v ^ power, height }
          end
        end
        local count = grid_face(model, "source", grid[1], grid[2], true, board(0, 1, on_source))
        grid_face(model, "target", grid[1], grid[2], true, board(2, grading, not on_source))
        check_both_kept(model, count)
      end
    end
  end
end

-- A size that changes: the rim's nodes stand as close as it asks at each place.
do
  local model = box { keep_mesh = false }
  local volume = model:open_volume { source = "source", target = "target", walls = "auto" }
  local mesh = volume:sweep { layers = 2, quads = "paved", size = function(x) return 0.02 + 0.1 * x end }
  local on_side = {}
  for i = 1, mesh.nodes do
    local x, y, z = mesh:node(i)
    if z == 0 and y == 0 then on_side[#on_side + 1] = x end
  end
  table.sort(on_side)
  for i = 2, #on_side do
    local asked = 0.02 + 0.1 * (on_side[i] + on_side[i - 1]) / 2
    local ratio = (on_side[i] - on_side[i - 1]) / asked
    assert(ratio > 0.8 and ratio < 1.25,
        string.format("side of %g of the size asked at %g", ratio, on_side[i]))
  end
  assert(#on_side > 15)
end
-- Triangles keep the nodes of their edges: where that is coarser than the size, a note says so.
do
  local corners = {}
  for k = 0, 7 do corners[k] = { 12 * (k & 1), 12 * (k >> 1 & 1), 12 * (k >> 2) } end
  for _, keep in ipairs { true, false } do
    local cube = lacuna.model()
    for name, face in pairs { low = { 0, 2, 3, 1 }, top = { 4, 5, 7, 6 }, front = { 0, 1, 5, 4 },
      back = { 2, 6, 7, 3 }, left = { 0, 4, 6, 2 }, right = { 1, 3, 7, 5 } } do
      local points = {}
      for i, k in ipairs(face) do points[i] = corners[k] end
      cube:add_face { name = name, points = points, cells = { { 1, 2, 3 }, { 1, 3, 4 } }, keep_mesh = keep }
    end
    for size, coarse in pairs { [1.5] = keep, [11] = false } do
      local mesh = cube:open_volume { source = "low", target = "top", walls = "auto" }:sweep { size = size }
      local noted = tostring(mesh.report):find("so the size does not apply there", 1, true) ~= nil
      check.equal(noted, coarse, "size " .. size)
      check.equal(mesh.hexes, (keep or size > 6) and 1 or 512)
    end
  end
end
-- Tunnels along two or three axes through a graded block: nodes on the edges where tunnels meet, which lie
-- inside the volume between the pieces that it is cut into, are kept as well.
do
  local function tunnels(axes, power, sides, arm)
    local model, points = lacuna.model(), {}
    local in_cube, in_arm = {}, {}
    for axis = 1, 3 do
      in_cube[axis], in_arm[axis] = {}, {}
      for k = 0, sides[axis] do in_cube[axis][k] = 10 * (k / sides[axis]) ^ power end
      for k = 0, arm do in_arm[axis][k] = 8 * k / arm end
    end
    local function face(name, axis, low, across, at)
      local along, width = in_arm[axis], in_cube[across]
      local own, cells = {}, {}
      for j = 0, arm do
        for i = 0, #width do
          local p = {}
          p[axis] = low and -along[j] or 10 + along[j]
          p[across], p[6 - axis - across] = width[i], at
          own[#own + 1] = p
          points[#points + 1] = p
        end
      end
      for j = 0, arm - 1 do
        for i = 1, #width do
          local a = j * (#width + 1) + i
          cells[#cells + 1] = { a, a + 1, a + #width + 2, a + #width + 1 }
        end
      end
      model:add_face { name = name, points = own, cells = cells, keep_mesh = true }
    end
    for _, axis in ipairs(axes) do
      for _, low in ipairs { true, false } do
        for across = 1, 3 do
          if across ~= axis then
            for _, at in ipairs { 0, 10 } do
              local name = ("tunnel_%d_%s_%d_%d"):format(axis, low and "low" or "high", across, at)
              face(name, axis, low, across, at)
            end
          end
        end
      end
    end
    if #axes == 2 then
      local u, v = axes[1], axes[2]
      for _, at in ipairs { 0, 10 } do
        local own, cells = {}, {}
        local n = #in_cube[u]
        for j = 0, #in_cube[v] do
          for i = 0, n do
            local p = {}
            p[u], p[v], p[6 - u - v] = in_cube[u][i], in_cube[v][j], at
            own[#own + 1] = p
            points[#points + 1] = p
          end
        end
        for j = 0, #in_cube[v] - 1 do
          for i = 1, n do
            local a = j * (n + 1) + i
            cells[#cells + 1] = { a, a + 1, a + n + 2, a + n + 1 }
          end
        end
        model:add_face { name = "floor_" .. at, points = own, cells = cells, keep_mesh = true }
      end
    end
    return model, points
  end
  for _, axes in ipairs { { 1, 2, 3 }, { 1, 2 } } do
    for _, power in ipairs { 1, 1.2, 1.6 } do
      for _, sides in ipairs { { 4, 4, 4 }, { 3, 4, 5 } } do
        local model, points = tunnels(axes, power, sides, 4)
        local mesh = model:open_volume { faces = model:faces() }:sweep {}
        local nodes = {}
        for i = 1, mesh.nodes do
          local x, y, z = mesh:node(i)
          nodes[("%.9g %.9g %.9g"):format(x + 0.0, y + 0.0, z + 0.0)] = true
        end
        local lost = 0
        for _, p in ipairs(points) do
          if not nodes[("%.9g %.9g %.9g"):format(p[1] + 0.0, p[2] + 0.0, p[3] + 0.0)] then lost = lost + 1 end
        end
        check.equal(lost, 0, ("%d axes, power %g, %d sides"):format(#axes, power, sides[1]))
        check.near(mesh:quality().volume, 1000 + 1600 * #axes, 1e-6)
      end
    end
  end
end

-- Quads of an .obj file are facets, not given cells: a size applies to them.
do
  local path = os.tmpname()
  for _, n in ipairs { 4, 12 } do
    local lines = {}
    for level = 0, 1 do
      for k = 0, n - 1 do
        local t = 2 * math.pi * k / n
        lines[#lines + 1] = ("v %.9f %.9f %d"):format(6 * math.cos(t), 6 * math.sin(t), 50 * level)
      end
    end
    for k = 1, n do
      lines[#lines + 1] = ("f %d %d %d %d"):format(k, k % n + 1, n + k % n + 1, n + k)
    end
    check.write(path .. ".obj", table.concat(lines, "\n") .. "\n")
    local duct = lacuna.load(path .. ".obj")
    check.equal(duct:face(1).has_mesh, false)
    local mesh = duct:open_volume():sweep { size = 5 }
    check.near(mesh:quality().volume, 25 * 36 * n * math.sin(2 * math.pi / n), 1)
    check.that(mesh.layers >= 10, n .. " sides")
    os.remove(path .. ".obj")
  end
  os.remove(path)
end
-- Tubes of quads round each other with the same rows, whose points are numbered from different places round
-- the axis: nodes correspond, so that both keep their quads and no column turns.
local round, rows, length = 48, 4, 60
local function tube(model, name, radius, first)
  local points, cells = {}, {}
  for k = 0, rows do
    for j = 0, round - 1 do
      local angle = 2 * math.pi * (j + first) / round
      points[#points + 1] = { radius * math.cos(angle), radius * math.sin(angle), length * k / rows }
    end
  end
  for k = 0, rows - 1 do
    for j = 0, round - 1 do
      local a, b = j + 1, (j + 1) % round + 1
      cells[#cells + 1] = { k * round + a, k * round + b, (k + 1) * round + b, (k + 1) * round + a }
    end
  end
  return model:add_face { name = name, points = points, cells = cells, keep_mesh = true }
end
for _, first in ipairs { 0, 1, 2, 7 } do
  local model = lacuna.model()
  local inner, outer = tube(model, "inner", 30, 0), tube(model, "outer", 34, first)
  local quality = model:open_volume({ source = inner, target = outer }):sweep({ layers = 4 }):quality()
  check.that(quality.min_scaled_jacobian > 0.99, first)
  local turn = 2 * math.pi / round
  local expected = length * round / 2 * math.sin(turn) * (34 ^ 2 - 30 ^ 2)
  check.near(quality.volume, expected, 1e-9 * expected)
end

check.done()
