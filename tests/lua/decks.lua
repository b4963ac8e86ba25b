-- SPDX-License-Identifier: MIT
-- Faces of finite element decks, picked by selectors; quality of decks in every format.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = "" }

-- Two blocks of hexes on each other; in the upper one a hole through all layers.
local n, m = 4, 4
local function node(i, j, k) return 1 + i + (n + 1) * (j + (n + 1) * k) end
local function deck(format)
  local lines = {}
  local function add(...) lines[#lines + 1] = string.format(...) end
  add(format == "bdf" and "BEGIN BULK" or "*NODE")
  for k = 0, m do
    for j = 0, n do
      for i = 0, n do
        add(format == "bdf" and "GRID,%d,,%d.,%d.,%d." or "%d, %d., %d., %d.", node(i, j, k), i, j, k)
      end
    end
  end
  local tag = 0
  local cells = {}
  for k = 0, m - 1 do
    for j = 0, n - 1 do
      for i = 0, n - 1 do
        local part = k < 2 and 1 or 2
        local hole = part == 2 and i > 0 and i < n - 1 and j > 0 and j < n - 1
        if not hole then
          tag = tag + 1
          cells[#cells + 1] = { tag, part,
            node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
            node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1) }
        end
      end
    end
  end
  for part = 1, 2 do
    if format == "inp" then add("*ELEMENT, TYPE=C3D8, ELSET=part%d", part) end
    for _, c in ipairs(cells) do
      if c[2] == part then
        if format == "bdf" then
          add("CHEXA,%d,%d,%d,%d,%d,%d,%d,%d,\n,%d,%d", table.unpack(c))
        else
          add("%d, %d, %d, %d, %d, %d, %d, %d, %d", c[1], table.unpack(c, 3))
        end
      end
    end
  end
  return table.concat(lines, "\n") .. "\n"
end

-- Element sets without sections are the regions if each element is in one of them.
do
  local path = params.scratch .. "/sets.inp"
  local function cube(number, z)
    local nodes, tags = {}, {}
    for i, p in ipairs { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } } do
      for k = 0, 1 do
        local tag = 8 * number + 4 * k + i
        tags[4 * k + i] = tag
        nodes[#nodes + 1] = ("%d, %d, %d, %d"):format(tag, p[1], p[2], z + k)
      end
    end
    return table.concat(nodes, "\n") .. "\n", table.concat(tags, ", ") .. "\n"
  end
  local lower_nodes, lower = cube(0, 0)
  local upper_nodes, upper = cube(1, 3)
  local text = "*NODE\n" .. lower_nodes .. upper_nodes ..
    "*ELEMENT, TYPE=C3D8\n1, " .. lower .. "2, " .. upper
  check.write(path, text .. "*ELSET, ELSET=LOW\n1\n*ELSET, ELSET=UP\n2\n")
  check.equal(#lacuna.load(path):faces { region = "LOW" }, 6)
end

for _, format in ipairs { "bdf", "inp" } do
  local lower = format == "bdf" and "pid:1" or "part1"
  local upper = format == "bdf" and "pid:2" or "part2"
  local path = params.scratch .. "/blocks." .. format
  check.write(path, deck(format))
  local model = lacuna.load(path)
  check.equal(#model:faces { region = lower, free = true }, 6) -- the bottom of the hole is one
  check.equal(#model:faces { free = false }, 1)
  check.equal(#model:faces { region = upper }, 1 + 4 + 4 + 1)
  check.equal(#model:faces { name = upper, box = { { 1, 1, 2 }, { 3, 3, 4 } } }, 4)
  local bottom = model:face { region = lower, box = { { 1, 1, 2 }, { 3, 3, 2 } } }
  check.equal(#model:faces { touching = bottom, region = upper, free = true }, 4)
  check.equal(#model:faces { touching = bottom, free = false }, 1)
  check.equal(#model:faces { near = { 2, 2, 2 }, within = 0.9 }, 1)
  check.equal(#model:faces { near = { 2, 2, 2 }, within = 1.1 }, 6)
  check.equal(#model:faces { facing = { 1, 1, 0 }, normal_within = 46, region = upper, free = true }, 4)
  local sides = { name = upper, box = { { 1, 1, 2 }, { 3, 3, 4 } } }
  local void = model:open_volume { source = bottom, walls = sides }
  check.equal(void.class, "IV")
  check.fails(function() model:faces { within = 1 } end, "near")
  check.fails(function() model:faces { touching = 12345 } end, "touching")
  check.equal(lacuna.check(path).hexes, 16 * 2 + 12 * 2)
end

-- Faces grown from a facet: over the edges of a block, and no further than asked.
do
  local path = params.scratch .. "/blocks.bdf"
  local model = lacuna.load(path)
  local before = #model:faces()
  local top = model:face { near = { 0.5, 0.5, 4 }, region = "pid:2" }
  local side = model:face { name = "pid:1", facing = { 1, 0, 0 } }
  check.equal(model:face_from { near = { 0.5, 0.5, 4.1 }, region = "pid:2", free = true, angle = 5 }, top)
  check.equal(#model:faces(), before)
  local skin = model:face_from { near = { 5, 2, 1 }, region = "pid:1", free = true, angle = 95 }
  check.near(skin.area, 4 * 8 + 16, 1e-9) -- up to where the upper block stands
  check.that(skin ~= top and skin == model:face(skin.tag))
  check.fails(function() return side.area end, "face_from")
  check.fails(function() model:face { touching = side } end, "face_from")
  check.that(side ~= skin and top.area > 0)
  check.fails(function() model:face_from { angle = 3 } end, "near")
  check.fails(function() model:face_from { near = { 0, 0, 0 }, angle = 181 } end, "angle")
  check.fails(function() model:face_from { near = { 0, 0, 0 }, region = "none" } end, "fewer conditions")
  check.fails(function() model:face_from { near = { 0, 0, 0 }, regoin = "none" } end, "region")
  check.fails(function() lacuna.model():face_from { near = { 0, 0, 0 } } end, "loaded")
  -- The bottom of the hole and one wall as one, where a volume takes them like any other.
  local again = lacuna.load(path)
  local pit = again:face_from { near = { 2, 2, 2 }, region = "pid:1", free = true, angle = 30 }
  check.near(pit.area, 4, 1e-9)
  local walls = { name = "pid:2", box = { { 1, 1, 2 }, { 3, 3, 4 } } }
  local void = again:open_volume { source = pit, walls = walls }
  check.equal(void.class, "IV")
  check.equal(void:sweep { layers = 2 }.hexes, 8)
end

-- A tube of shells has a radius, a plate none.
local tube = lacuna.synthetic.prism { sides = 48, radius = 3, height = 5 }
check.equal(#tube:faces { radius = { 2.9, 3.1 } }, #tube:faces { radius = { 0, math.huge } })

check.done()
