-- SPDX-License-Identifier: MIT
-- Ends of quads and triangles: an error that counts both, or wedges; written in every format, read by check.
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "." }

-- A box of N x N x 3 whose source is quads, but for two that are two triangles each; class IV.
local N <const>, HEIGHT <const> = 4, 3
local model = lacuna.model()
local points, cells = {}, {}
for j = 0, N do
  for i = 0, N do points[#points + 1] = { i, j, 0 } end
end
local function at(i, j) return j * (N + 1) + i + 1 end
for j = 0, N - 1 do
  for i = 0, N - 1 do
    local quad = { at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j) }
    if j == 1 and i < 2 then
      cells[#cells + 1] = { quad[1], quad[2], quad[3] }
      cells[#cells + 1] = { quad[1], quad[3], quad[4] }
    else
      cells[#cells + 1] = quad
    end
  end
end
model:add_face { name = "source", points = points, cells = cells, keep_mesh = true }
local corner = { { 0, 0 }, { N, 0 }, { N, N }, { 0, N } }
for side = 1, 4 do
  local a, b = corner[side], corner[side % 4 + 1]
  local wall, quads = {}, {}
  for k = 0, HEIGHT do
    for i = 0, N do
      local t = i / N
      wall[#wall + 1] = { a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]), k }
    end
  end
  for k = 0, HEIGHT - 1 do
    for i = 1, N do
      local low = k * (N + 1) + i
      quads[#quads + 1] = { low, low + 1, low + N + 2, low + N + 1 }
    end
  end
  model:add_face { name = "wall_" .. side, points = wall, cells = quads, keep_mesh = true }
end

local function void()
  return model:open_volume { source = "source", walls = { "wall_1", "wall_2", "wall_3", "wall_4" } }
end

local done, message = pcall(function() return void():sweep {} end)
assert(not done and tostring(message):find("14 quads and 4 triangles", 1, true), tostring(message))
assert(tostring(message):find("wedges = true", 1, true), tostring(message))

local fallen = void():sweep { fallback = "wedges" }
assert(fallen.wedges == 4 * HEIGHT and fallen:quality().certified and #fallen.left_out == 0)
assert(tostring(fallen.report):find("fallback: meshed with wedges, because", 1, true))
assert(not pcall(function() void():sweep { fallback = "leave_out" } end), "nothing would be left")

-- In an assembly the failing volume falls back, or is left out and named.
do
  local block = lacuna.model()
  local function quad(name, ...)
    block:add_face { name = name, points = { ... }, cells = { { 1, 2, 3, 4 } } }
  end
  local base = { { N, 0 }, { N + 2, 0 }, { N + 2, N }, { N, N } }
  for side = 1, 4 do
    local a, b = base[side], base[side % 4 + 1]
    quad("wall_" .. side, { a[1], a[2], 0 }, { b[1], b[2], 0 }, { b[1], b[2], HEIGHT },
      { a[1], a[2], HEIGHT })
  end
  quad("low", { N, 0, 0 }, { N + 2, 0, 0 }, { N + 2, N, 0 }, { N, N, 0 })
  local roles = { name = "beside", source = "low", walls = { "wall_1", "wall_2", "wall_3", "wall_4" } }
  local function sweep(fallback)
    return lacuna.assembly { void(), block:open_volume(roles) }:sweep { size = 1, fallback = fallback }
  end
  local done, message = pcall(sweep)
  assert(not done and tostring(message):find("volume_1", 1, true), tostring(message))
  local both = sweep "wedges"
  assert(#both.regions == 2 and both.wedges > 0 and both:quality().certified and #both.left_out == 0)
  assert(math.abs(both.fidelity.volume - N * (N + 2) * HEIGHT) < 1e-9)
  local one = sweep "leave_out"
  assert(table.concat(one.regions, " ") == "beside" and one:quality().certified)
  assert(math.abs(one.fidelity.volume - N * 2 * HEIGHT) < 1e-9)
  assert(#one.left_out == 1 and one.left_out[1].region == "volume_1")
  assert(one.left_out[1].code == "surface.given_triangles", one.left_out[1].code)
  assert(tostring(one.report):find("left out: volume_1: ", 1, true))
  one:write(params.scratch .. "/left_out.msh")
  assert(lacuna.check(params.scratch .. "/left_out.msh").hexes == one.hexes)
end

local mesh = void():sweep { wedges = true }
assert(mesh.hexes == 14 * HEIGHT and mesh.wedges == 4 * HEIGHT and mesh.layers == HEIGHT)
local quality = mesh:quality()
assert(quality.hexes == mesh.hexes and quality.wedges == mesh.wedges and quality.certified)
assert(math.abs(quality.volume - N * N * HEIGHT) < 1e-9)
assert(select("#", mesh:hex(mesh.hexes)) == 8 and select("#", mesh:wedge(mesh.wedges)) == 6)
assert(not pcall(mesh.wedge, mesh, mesh.wedges + 1) and not pcall(mesh.hex, mesh, mesh.hexes + 1))

for _, ending in ipairs { "msh", "vtk", "vtu", "inp", "bdf", "unv", "exo" } do
  local path = ("%s/wedges.%s"):format(params.scratch, ending)
  mesh:write(path)
  local read = lacuna.check(path)
  assert(read.hexes == mesh.hexes and read.wedges == mesh.wedges and read.certified, ending)
  assert(math.abs(read.volume - quality.volume) < 1e-6, ending)
end

-- A layer at a time the files are the same: numbers of cells that hexahedra and wedges take turns in.
local function bytes(name)
  local file <close> = assert(io.open(params.scratch .. "/" .. name, "rb"))
  return file:read "a"
end
for _, name in ipairs { "wedges.msh", "wedges.vtu", "wedges.inp", "wedges.exo", "wedges.pvtu" } do
  local options = name:find "pvtu" and { partitions = 2, ghosts = 1 } or nil
  local files = options and { name, "wedges_0.vtu", "wedges_1.vtu" } or { name }
  local held = {}
  mesh:write(params.scratch .. "/" .. name, options)
  for _, file in ipairs(files) do held[file] = bytes(file) end
  local report = void():sweep_to(params.scratch .. "/" .. name, { wedges = true, write = options })
  assert(report.streamed and report.wedges == mesh.wedges)
  for _, file in ipairs(files) do assert(bytes(file) == held[file], file) end
end

local anew = void():sweep { quads = "paved" }
assert(anew.wedges == 0 and anew:quality().certified)

-- CalculiX: an affine displacement of the skin is the same stress in every cell, hexahedra and wedges alike.
if os.execute("command -v ccx >/dev/null 2>&1") then
  local gradient = { { 0.01, 0.002, 0.003 }, { 0.001, -0.004, 0.002 }, { 0.005, 0.001, 0.006 } }
  local young, poisson = 1000, 0.3
  local base = params.scratch .. "/wedges_solved"
  mesh:write(base .. ".inp")
  local cards = { "*MATERIAL, NAME=steel", "*ELASTIC", young .. ", " .. poisson,
    "*SOLID SECTION, ELSET=volume, MATERIAL=steel", "*STEP", "*STATIC", "*BOUNDARY" }
  for n = 1, mesh.nodes do
    local p = { mesh:node(n) }
    local inside = p[1] > 0.1 and p[1] < N - 0.1 and p[2] > 0.1 and p[2] < N - 0.1
    if not (inside and p[3] > 0.1 and p[3] < HEIGHT - 0.1) then
      for d = 1, 3 do
        local g = gradient[d]
        local value = g[1] * p[1] + g[2] * p[2] + g[3] * p[3]
        cards[#cards + 1] = ("%d, %d, %d, %.12e"):format(n, d, d, value)
      end
    end
  end
  cards[#cards + 1] = "*EL PRINT, ELSET=volume\nS\n*END STEP\n"
  do
    local file <close> = assert(io.open(base .. ".inp", "a"))
    file:write(table.concat(cards, "\n"))
  end
  assert(os.execute(("cd '%s' && ccx wedges_solved > wedges_solved.log 2>&1"):format(params.scratch)))
  local lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
  local shear = young / (2 * (1 + poisson))
  local trace = gradient[1][1] + gradient[2][2] + gradient[3][3]
  local expected = {}
  for s, ij in ipairs { { 1, 1 }, { 2, 2 }, { 3, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 } } do
    local i, j = ij[1], ij[2]
    expected[s] = shear * (gradient[i][j] + gradient[j][i]) + (i == j and lame * trace or 0)
  end
  local points = 0
  for line in io.lines(base .. ".dat") do
    local numbers = {}
    for word in line:gmatch("%S+") do numbers[#numbers + 1] = tonumber(word) end
    if #numbers == 8 then
      points = points + 1
      for s = 1, 6 do assert(math.abs(numbers[s + 2] - expected[s]) < 1e-6 * expected[1], line) end
    end
  end
  assert(points == 8 * mesh.hexes + 2 * mesh.wedges, points)
else
  print("CalculiX (ccx) is not here: no deck is solved")
end
