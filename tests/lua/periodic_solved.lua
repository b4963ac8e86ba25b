-- SPDX-License-Identifier: MIT
-- CalculiX on periodic cells, a cyclic sector and written orientations; left out where CalculiX is not here.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }

if not os.execute("command -v ccx >/dev/null 2>&1") then
  print("CalculiX (ccx) is not here: no deck is solved")
  check.done()
  return
end

local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end

-- Solve a deck. @return  its printed tables: for each heading a list of rows of numbers
local function solve(name, text)
  local base = params.scratch .. "/" .. name
  check.write(base .. ".inp", text)
  os.remove(base .. ".dat")
  os.execute(("cd '%s' && OMP_NUM_THREADS=1 ccx %s > %s.log 2>&1"):format(params.scratch, name, name))
  local log = read(base .. ".log")
  check.that(not log:find "%*ERROR" and io.open(base .. ".dat"), name .. ": " .. log:sub(-400))
  local tables, rows = {}, nil
  for line in read(base .. ".dat"):gmatch("[^\n]+") do
    local numbers = {}
    for word in line:gmatch("%S+") do numbers[#numbers + 1] = tonumber(word) end
    local heading = line:match("^%s*(%a+)")
    if heading then
      rows = {}
      tables[heading] = tables[heading] or rows
    elseif rows and #numbers > 0 then
      rows[#rows + 1] = numbers
    end
  end
  return tables
end

-- Nodes and elements of a deck of bricks of order 1, and the rest of its text.
local function parse(text)
  local nodes, cells, into = {}, {}, nil
  for line in text:gmatch("[^\n]+") do
    if line:sub(1, 1) == "*" then
      into = line:find "^%*NODE\n?$" and nodes or line:find "^%*ELEMENT" and cells or nil
    elseif into then
      local numbers = {}
      for word in line:gmatch("[^,%s]+") do numbers[#numbers + 1] = tonumber(word) end
      into[numbers[1]] = { table.unpack(numbers, 2) }
    end
  end
  return nodes, cells
end

local function set(text, name)
  local found = {}
  for number in text:match("%*NSET, NSET=" .. name .. "\n([^*]*)"):gmatch "%d+" do
    found[#found + 1] = tonumber(number)
  end
  return found
end

-- The mean stress over all integration points of equal cells, or weighted by volumes of cells.
local function mean_stress(rows, volumes)
  local sum, all, of_cell = { 0, 0, 0, 0, 0, 0 }, 0, {}
  for _, row in ipairs(rows) do of_cell[row[1]] = (of_cell[row[1]] or 0) + 1 end
  for _, row in ipairs(rows) do
    local weight = volumes[row[1]] / of_cell[row[1]]
    all = all + weight
    for s = 1, 6 do sum[s] = sum[s] + weight * row[s + 2] end
  end
  for s = 1, 6 do sum[s] = sum[s] / all end
  return sum
end

-- Volumes of bricks by CalculiX itself.
local function volumes_of(rows)
  local found = {}
  for _, row in ipairs(rows) do found[row[1]] = row[2] end
  return found
end

-- --- a cell with a fibre
-- -------------------------------------------------------------------------------------

-- A fibre of square section turned by 45 degrees in a cube, both swept along z.
local function fibre_cell()
  local model = lacuna.model()
  local outer = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }
  local inner = { { 0.5, 0.2 }, { 0.8, 0.5 }, { 0.5, 0.8 }, { 0.2, 0.5 } }
  local function at(p, z) return { p[1], p[2], z } end
  for z = 0, 1 do
    local points, ring, plug = {}, {}, { { 5, 6, 7 }, { 5, 7, 8 } }
    for k = 1, 4 do points[k], points[k + 4] = at(outer[k], z), at(inner[k], z) end
    for k = 1, 4 do
      local n = k % 4 + 1
      ring[#ring + 1], ring[#ring + 2] = { k, n, k + 4 }, { n, n + 4, k + 4 }
    end
    for _, cells in ipairs { ring, plug } do
      for _, c in ipairs(cells) do if z == 0 then c[1], c[2] = c[2], c[1] end end
    end
    model:add_face { name = "matrix_" .. z, points = points, cells = ring }
    model:add_face { name = "fibre_" .. z, points = points, cells = plug }
  end
  for k = 1, 4 do
    local n = k % 4 + 1
    for name, rim in pairs { side = outer, skin = inner } do
      model:add_face { name = name .. k, points = { at(rim[k], 0), at(rim[n], 0), at(rim[n], 1), at(rim[k],
        1) },
        cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
    end
  end
  local skins, all = {}, {}
  for k = 1, 4 do skins[k], all[k], all[k + 4] = "skin" .. k, "skin" .. k, "side" .. k end
  return lacuna.assembly {
    model:open_volume { name = "matrix", source = "matrix_0", target = "matrix_1", walls = all },
    model:open_volume { name = "fibre", source = "fibre_0", target = "fibre_1", walls = skins } }
end

local cell = fibre_cell():sweep { layers = 2, size = 0.3, periodic = { { "side4", "side2" }, { "side1",
  "side3" },
  { { "matrix_0", "fibre_0" }, { "matrix_1", "fibre_1" } } } }
local path = params.scratch .. "/cell.inp"
cell:write(path)
local text = read(path)
local nodes, cells = parse(text)

local function deck(text, fibre, strain, nodes, nodes_fixed, extra)
  local lines = { text, "*MATERIAL, NAME=soft\n*ELASTIC\n3., 0.35\n*EXPANSION\n1.e-2",
    "*MATERIAL, NAME=hard\n*ELASTIC\n" .. fibre .. "\n*EXPANSION\n1.e-2",
    "*SOLID SECTION, ELSET=matrix, MATERIAL=soft\n*SOLID SECTION, ELSET=fibre, MATERIAL=hard",
    "*NSET, NSET=all, GENERATE\n1, " .. #nodes, "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nall, 0.",
    "*STEP\n*STATIC\n*BOUNDARY" }
  for _, n in ipairs(nodes_fixed) do lines[#lines + 1] = n .. ", 1, 3" end
  for k = 1, 3 do
    for i = 1, 3 do lines[#lines + 1] = ("periodic_%d, %d, %d, %.12e"):format(k, i, i, strain[i][k]) end
  end
  lines[#lines + 1] = extra or ""
  lines[#lines + 1] = "*EL PRINT, ELSET=matrix\nS\n*EL PRINT, ELSET=fibre\nS\n" ..
    "*EL PRINT, ELSET=matrix\nEVOL\n" ..
    "*EL PRINT, ELSET=fibre\nEVOL\n*NODE PRINT, NSET=all\nU\n*END STEP\n"
  return table.concat(lines, "\n")
end
-- All tables of one heading follow each other in the file.
local function solve_cell(name, ...)
  local source = deck(...)
  local base = params.scratch .. "/" .. name
  solve(name, source)
  local found, into = { stresses = {}, volumes = {}, displacements = {} }, nil
  for line in read(base .. ".dat"):gmatch("[^\n]+") do
    local heading = line:match("^%s*(%a+)")
    if heading then
      into = heading == "stresses" and found.stresses or heading == "displacements" and found.displacements or
        line:find "volume" and found.volumes or nil
    else
      local numbers = {}
      for word in line:gmatch("%S+") do numbers[#numbers + 1] = tonumber(word) end
      if into and #numbers > 0 then into[#into + 1] = numbers end
    end
  end
  return found
end

local strain = { { 0.5, 0.125, 0 }, { 0.125, -0.25, 0.0625 }, { 0, 0.0625, 1 } }
local none = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } }
do
  -- Of one material, the displacement is that of the mean strain. A temperature without a mean strain shows
  -- fluctuations as numbers of their own, so that all digits printed count: they are below 1e-9.
  local warm = solve_cell("cell_warm", text, "3., 0.35", none, nodes, { 1 }, "*TEMPERATURE\nall, 1.")
  check.equal(#warm.displacements, #nodes)
  for _, row in ipairs(warm.displacements) do
    for i = 2, 4 do check.near(row[i], 0, 1e-9 * 1e-2) end
  end
  local stress = -3 * 1e-2 / (1 - 2 * 0.35)
  for _, row in ipairs(warm.stresses) do
    for s = 3, 5 do check.near(row[s], stress, 1e-6 * math.abs(stress)) end -- the digits that are printed
    for s = 6, 8 do check.near(row[s], 0, 1e-9 * math.abs(stress)) end
  end
  local pulled = solve_cell("cell_pulled", text, "3., 0.35", strain, nodes, { 1 })
  local mean = mean_stress(pulled.stresses, volumes_of(pulled.volumes))
  local lambda, mu = 3 * 0.35 / (1.35 * 0.3), 3 / 2.7
  local trace = lambda * (0.5 - 0.25 + 1)
  for s, exact in ipairs { trace + mu, trace - mu / 2, trace + 2 * mu, 2 * mu * 0.125, 0, 2 * mu * 0.0625 } do
    check.near(mean[s], exact, 1e-6 * trace)
  end
end

-- Eight copies, of which the outside is periodic: the moduli are those of one.
do
  local one = solve_cell("cell_fibre", text, "70., 0.2", strain, nodes, { 1 })
  local sides = {}
  for k = 1, 3 do sides[k] = { set(text, "periodic_" .. k .. "_a"), set(text, "periodic_" .. k .. "_b") } end
  local number, places, of_copy = {}, {}, {}
  for c = 0, 7 do
    local shift = { c % 2, c // 2 % 2, c // 4 }
    of_copy[c] = {}
    for tag, p in ipairs(nodes) do
      local at = { p[1] + shift[1], p[2] + shift[2], p[3] + shift[3] }
      local key = ("%.17g %.17g %.17g"):format(at[1], at[2], at[3])
      if not number[key] then
        places[#places + 1] = at
        number[key] = #places
      end
      of_copy[c][tag] = number[key]
    end
  end
  -- Pairs are equal bit for bit, so that copies have common nodes: as many as a periodic mesh has.
  local lines = { "*NODE" }
  for tag, p in ipairs(places) do lines[#lines + 1] = ("%d, %.12e, %.12e, %.12e"):format(tag, p[1], p[2],
    p[3]) end
  local tag = 0
  for _, region in ipairs { "matrix", "fibre" } do
    lines[#lines + 1] = "*ELEMENT, TYPE=C3D8, ELSET=" .. region
    local own = {}
    for block in text:gmatch("%*ELEMENT, TYPE=C3D8, ELSET=" .. region .. "\n([^*]*)") do
      for number_of in block:gmatch("(%d+),[^\n]*") do own[#own + 1] = tonumber(number_of) end
    end
    for c = 0, 7 do
      for _, e in ipairs(own) do
        tag = tag + 1
        local corners = {}
        for k, n in ipairs(cells[e]) do corners[k] = of_copy[c][n] end
        lines[#lines + 1] = tag .. ", " .. table.concat(corners, ", ")
      end
    end
  end
  local links = {}
  for k = 1, 3 do
    for c = 0, 7 do
      if (c >> (k - 1)) % 2 == 0 then
        for i, a in ipairs(sides[k][1]) do
          local n, m = of_copy[c][a], of_copy[c + (1 << (k - 1))][sides[k][2][i]]
          links[n], links[m] = links[n] or {}, links[m] or {}
          table.insert(links[n], { m, k, 1 })
          table.insert(links[m], { n, k, -1 })
        end
      end
    end
    lines[#lines + 1] = ("*NODE, NSET=periodic_%d\n%d, 0., 0., 0."):format(k, #places + k)
  end
  local known = {}
  for n = 1, #places do
    if links[n] and not known[n] then
      known[n] = { 0, 0, 0 }
      local left = { n }
      while #left > 0 do
        local from = table.remove(left)
        for _, link in ipairs(links[from]) do
          if not known[link[1]] then
            local times = { table.unpack(known[from]) }
            times[link[2]] = times[link[2]] + link[3]
            known[link[1]] = times
            left[#left + 1] = link[1]
            for i = 1, 3 do
              local terms = { ("%d, %d, 1., %d, %d, -1."):format(link[1], i, n, i) }
              local count = 2
              for k = 1, 3 do
                if times[k] ~= 0 then
                  count = count + 1
                  terms[#terms + 1] = ("%d, %d, %d."):format(#places + k, i, -times[k])
                end
              end
              local row = table.concat(terms, ", ")
              if count == 5 then row = row:gsub("^(.-, .-, .-, .-, .-, .-, .-, .-, .-, .-, .-, .-), ",
                "%1\n") end
              lines[#lines + 1] = "*EQUATION\n" .. count .. "\n" .. row
            end
          end
        end
      end
    end
  end
  local twice = {}
  for i = 1, 3 do
    twice[i] = {}
    for k = 1, 3 do twice[i][k] = 2 * strain[i][k] end
  end
  local eight = solve_cell("cell_eight", table.concat(lines, "\n"), "70., 0.2", twice, places, { 1 })
  local mean = mean_stress(one.stresses, volumes_of(one.volumes))
  local mean_of_eight = mean_stress(eight.stresses, volumes_of(eight.volumes))
  for s = 1, 6 do
    if s ~= 5 then check.near(mean_of_eight[s], mean[s], 0.01 * math.abs(mean[s])) end
  end
  print(("a cell with a fibre: mean stress %.6g along it, of eight copies %.6g"):format(mean[3],
    mean_of_eight[3]))
end

-- --- a sector of a disc
-- --------------------------------------------------------------------------------------

do
  local model = lacuna.model()
  model:add_face { name = "source", points = { { 1, 0, 0 }, { 2, 0, 0 }, { 2, 0, 0.4 }, { 1, 0, 0.4 } },
    cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
  local void = model:open_volume { source = "source", name = "disc",
    along = { axis = { { 0, 0, 0 }, { 0, 0, 1 } }, angle = 60 } }
  local mesh = void:sweep { size = 0.25, layers = 5, periodic = { { "source", "target" } } }
  mesh:write(params.scratch .. "/sector.inp")
  local sector = read(params.scratch .. "/sector.inp")
  check.that(sector:find("*CYCLIC SYMMETRY MODEL, N=6", 1, true))
  check.that(sector:find("*TIE, CYCLIC SYMMETRY", 1, true))
  local own, cells_of = parse(sector)
  local slave = {} -- whose displacement follows from the other end
  for _, n in ipairs(set(sector, "periodic_1_b")) do slave[n] = true end
  local function load(places)
    local held = {}
    for tag, p in ipairs(places) do
      if math.sqrt(p[1] ^ 2 + p[2] ^ 2) < 1 + 1e-6 and not (places == own and slave[tag]) then
        held[#held + 1] = tag .. ", 1, 3" end
    end
    return "*MATERIAL, NAME=steel\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.8e-9\n*SOLID SECTION, ELSET=disc, " ..
      "MATERIAL=steel\n*NSET, NSET=every, GENERATE\n1, " .. #places .. "\n*STEP\n*STATIC\n*BOUNDARY\n" ..
      table.concat(held, "\n") .. "\n*DLOAD\ndisc, CENTRIF, 1.e8, 0., 0., 0., 0., 0., 1.\n" ..
      "*NODE PRINT, NSET=every\nU\n*END STEP\n"
  end
  local part = solve("sector_solved", sector .. load(own)).displacements
  local lines, places, number = { "*NODE" }, {}, {}
  local in_copy = {}
  for c = 0, 5 do
    local cos, sin = math.cos(math.pi / 3 * c), math.sin(math.pi / 3 * c)
    in_copy[c] = {}
    for tag, p in ipairs(own) do
      local at = { cos * p[1] - sin * p[2], sin * p[1] + cos * p[2], p[3] }
      local key = ("%.6f %.6f %.6f"):format(at[1] + 1e-7, at[2] + 1e-7, at[3] + 1e-7)
      if not number[key] then
        places[#places + 1] = at
        number[key] = #places
        lines[#lines + 1] = ("%d, %.12e, %.12e, %.12e"):format(#places, at[1], at[2], at[3])
      end
      in_copy[c][tag] = number[key]
    end
  end
  lines[#lines + 1] = "*ELEMENT, TYPE=C3D8, ELSET=disc"
  local tag = 0
  for c = 0, 5 do
    for _, corners in pairs(cells_of) do
      tag = tag + 1
      local of = {}
      for k, n in ipairs(corners) do of[k] = in_copy[c][n] end
      lines[#lines + 1] = tag .. ", " .. table.concat(of, ", ")
    end
  end
  local whole = solve("disc_solved", table.concat(lines, "\n") .. "\n" .. load(places)).displacements
  local most = 0
  for _, row in ipairs(whole) do most = math.max(most, math.abs(row[2]), math.abs(row[3])) end
  check.that(most > 0 and #whole == #places)
  check.equal(#places, 6 * (#own - #own // 6))
  for n = 1, #own do
    for i = 2, 4 do check.near(part[n][i], whole[in_copy[0][n]][i], 1e-6 * most) end
  end
  print(("a sector of a disc: %d nodes, %d of the disc, displacements up to %.6g"):format(#own, #places,
    most))
end

-- --- an orthotropic bend
-- -------------------------------------------------------------------------------------

do
  local model = lacuna.model()
  model:add_face { name = "source", points = { { 2, 0, 0 }, { 3, 0, 0 }, { 3, 0, 0.5 }, { 2, 0, 0.5 } },
    cells = { { 1, 2, 3 }, { 1, 3, 4 } } }
  local void = model:open_volume { source = "source", name = "bend",
    along = { axis = { { 0, 0, 0 }, { 0, 0, 1 } }, angle = 90 } }
  local mesh = void:sweep { size = 0.3, layers = 8 }
  mesh:write(params.scratch .. "/bend.inp", { orientation = true })
  local bend = read(params.scratch .. "/bend.inp")
  local own = parse(bend)
  local held, pulled = {}, {}
  for n, p in ipairs(own) do
    if math.abs(p[2]) < 1e-9 then held[#held + 1] = n .. ", 1, 3" end
    if math.abs(p[1]) < 1e-9 then pulled[#pulled + 1] = n .. ", 1, 1." end
  end
  local function rest(orientation)
    return "*MATERIAL, NAME=ply\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n" ..
      "140., 10., 9., 0.3, 0.25, 0.4, 5., 4.,\n3.\n" ..
      "*SOLID SECTION, ELSET=bend, MATERIAL=ply" .. (orientation and ", ORIENTATION=" .. orientation or "") ..
      "\n*NSET, NSET=every, GENERATE\n1, " .. #own .. "\n*STEP\n*STATIC\n*BOUNDARY\n" .. table.concat(held,
        "\n") ..
      "\n*CLOAD\n" .. table.concat(pulled, "\n") .. "\n*NODE PRINT, NSET=every\nU\n*END STEP\n"
  end
  local written = solve("bend_written", bend .. rest "bend_orientation").displacements
  -- By hand: for each cell the tangent of its arc, and the direction from the middle of the section.
  local _, cells_of = parse(bend)
  local tags = {}
  local hand = { "*DISTRIBUTION, NAME=hand, LOCATION=ELEMENT, TABLE=axes\n, 1., 0., 0., 0., 1., 0." }
  for e in pairs(cells_of) do tags[#tags + 1] = e end
  table.sort(tags)
  for _, e in ipairs(tags) do
    local x, y, z, r = 0, 0, 0, 0
    for _, n in ipairs(cells_of[e]) do
      local p = own[n]
      x, y, z, r = x + p[1] / 8, y + p[2] / 8, z + p[3] / 8, r + math.sqrt(p[1] ^ 2 + p[2] ^ 2) / 8
    end
    local cos, sin = x / math.sqrt(x * x + y * y), y / math.sqrt(x * x + y * y)
    local out, up = r - 2.5, z - 0.25
    local length = math.sqrt(out * out + up * up)
    hand[#hand + 1] = ("%d, %.12e, %.12e, 0., %.12e, %.12e, %.12e"):format(e, -sin, cos, out / length * cos,
      out / length * sin, up / length)
  end
  hand[#hand + 1] = "*ORIENTATION, NAME=by_hand, SYSTEM=RECTANGULAR\nhand\n"
  -- The directions 1 of the file are the tangents, exact up to the digits of the file.
  local angle = math.pi / 2 / 8
  local rows = bend:match("%*DISTRIBUTION, NAME=bend_orientation_of[^\n]*\n[^\n]*\n([^*]*)")
  for line in rows:gmatch("[^\n]+") do
    local v = {}
    for word in line:gmatch("[^,%s]+") do v[#v + 1] = tonumber(word) end
    local x, y = 0, 0
    for _, n in ipairs(cells_of[v[1]]) do x, y = x + own[n][1], y + own[n][2] end
    local layer = math.floor(math.atan(y, x) / angle) + 0.5
    check.near(v[2], -math.sin(layer * angle), 1e-12)
    check.near(v[3], math.cos(layer * angle), 1e-12)
    check.near(v[4], 0, 1e-12)
  end
  local rotated = solve("bend_by_hand", bend .. table.concat(hand, "\n") .. rest "by_hand").displacements
  check.equal(#rotated, #written)
  local most, isotropic = 0, solve("bend_plain", bend .. rest(nil)).displacements
  for _, row in ipairs(written) do most = math.max(most, math.abs(row[2]), math.abs(row[3])) end
  local turned = 0
  for n, row in ipairs(written) do
    for i = 2, 4 do
      check.near(row[i], rotated[n][i], 1e-6 * most)
      turned = math.max(turned, math.abs(row[i] - isotropic[n][i]))
    end
  end
  check.that(turned > 0.1 * most) -- without an orientation it moves otherwise
end
check.done()
