-- SPDX-License-Identifier: MIT
-- Cutting in recipes: by planes and faces, what the pieces are, what one mesh of them is.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")
local params = lacuna.params { members = check.whole and 60 or 15 }

local function open(model)
  return model:open_volume { source = "source", target = "target", walls = "auto" }
end
local prism = lacuna.synthetic.prism { sides = 6, radius = 1, height = 3 }
local whole = 4.5 * math.sqrt(3)
local function joined(pieces, size)
  local mesh = lacuna.assembly(pieces):sweep { size = size or 0.4 }
  check.equal(mesh:quality().certified, true)
  check.equal(#mesh.regions, #pieces)
  return mesh
end

-- Across, aslant, along, through nodes: always the whole.
for _, plane in ipairs { { { 0, 0, 1 }, { 0, 0, 1 } }, { { 0, 0, 1.5 }, { 0.3, 0.2, 1 } },
  { { 0, 0, 1 }, { 0, 1, 0 } }, { { 0, 0, 1 }, { 1, 0, 0 } }, { { 0.2, 0.1, 1 }, { 1, 0.3, 0 } } } do
  local pieces = open(prism):cut { plane = plane }
  check.equal(#pieces, 2)
  check.near(joined(pieces).fidelity.volume, whole, 1e-9)
end

-- Pieces are cut again, and their faces known by name.
local first = open(prism):cut { plane = { { 0, 0, 1 }, { 0, 0, 1 } } }
check.equal(first[1]:model():face("cut_1").area, prism:face("source").area)
local second = first[2]:cut { plane = { { 0, 0, 2 }, { 0, 0, -1 } } }
check.near(joined({ first[1], second[1], second[2] }).fidelity.volume, whole, 1e-9)
check.that(first[2]:describe():find "source: void face 1", "the cut is the end that lacked")

-- Roles by hand, from the piece's own faces.
local by_hand = first[1]:model():open_volume { source = "cut_1", target = "source", walls = "auto" }
check.near(joined({ by_hand, first[2] }).fidelity.volume, whole, 1e-9)

-- All faces as walls: cuts show the ends.
local walls = prism:open_volume { walls = prism:faces() }:cut { plane = { { 0, 0, 1 }, { 0, 0, 1 } } }
for _, piece in ipairs(walls) do check.equal(piece.class, "closed") end
check.near(joined(walls).fidelity.volume, whole, 1e-9)

-- Missing walls are cut as they would be closed.
local open_prism = lacuna.synthetic.prism { sides = 6, radius = 1, height = 3, drop = { "wall_2", "wall_5" } }
local open_pieces = open(open_prism):cut { plane = { { 0, 0, 1 }, { 0, 0, 1 } } }
for _, piece in ipairs(open_pieces) do check.equal(piece.class, "closed") end
check.near(joined(open_pieces).fidelity.volume, whole, 1e-9)

-- By a face: a handle of any model, or one of its own by tag, name or selector.
local model = lacuna.model()
model:add_face { name = "knife", points = { { -2, -2, 1 }, { 2, -2, 1.4 }, { 2, 2, 1.4 }, { -2, 2, 1 } },
  cells = { { 1, 2, 3, 4 } } }
check.near(joined(open(prism):cut { face = model:face "knife" }).fidelity.volume, whole, 1e-9)
check.fails(function() open(prism):cut { face = "target" } end, "touches", 'face 2 "target"')

-- A tag names the given face, although a void face has the same.
local closed = open(open_prism)
closed:close()
check.fails(function() closed:cut { face = 1 } end, "touches", "face 1")

-- What is refused.
local v = open(prism)
check.fails(function() v:cut { plane = { { 0, 0, 4 }, { 0, 0, 1 } } } end, "misses", "from -4 to -1")
check.fails(function() v:cut { plane = { { 0, 0, 1 }, { 0, 0, 0 } } } end, "normal")
check.fails(function() v:cut { plane = { 1, 2, 3 } } end, "plane")
check.fails(function() v:cut { plane = { { 0, 0, 1 }, { 0, 0, 1 } }, face = 1 } end, "give one of")
check.fails(function() v:cut {} end, "give one of")
check.fails(function() v:cut { face = 77 } end, "face 77")
check.fails(function() v:cut { face = { kind = "plane" } } end, "several")
check.fails(function() v:cut { plan = 1 } end, "plan")

-- A plane's normal may be of any length that is a number.
for _, length in ipairs { 1e300, 1e-300 } do
  local volume = lacuna.synthetic.prism { sides = 4 }
    :open_volume { source = "source", target = "target", walls = "auto" }
  check.equal(#volume:cut { plane = { { 0, 0, 0.7 }, { 0, 0, length } } }, 2)
end

-- A family: planes of any direction through prisms. Pieces fill the whole, nearly all are swept by
-- themselves, and most as one mesh; what is not is refused by name.
local random = check.random(4711)
local count, swept, one, codes = 0, 0, 0, {}
local function code_of(failed)
  local code = tostring(failed):match "%[([%a_]+%.[%a_]+)%]"
  check.that(code and code ~= "surface.loop_counts", tostring(failed))
  codes[code] = (codes[code] or 0) + 1
end
for _ = 1, params.members do
  local height = random(1, 4)
  local sides = math.floor(random(3, 8.999))
  local oblique = open(lacuna.synthetic.prism { sides = sides, radius = 1, height = height })
  local pieces = oblique:cut { plane = { { random(-0.5, 0.5), random(-0.5, 0.5), random(0.1, height - 0.1) },
    { random(-1, 1), random(-1, 1), random(-1, 1) } } }
  oblique:close()
  local sum = 0
  for _, piece in ipairs(pieces) do
    count = count + 1
    local fine, found = pcall(piece.sweep, piece, { size = 0.4 })
    if fine then
      swept = swept + 1
      check.equal(found:quality().certified, true)
      check.near(found.fidelity.volume, found.fidelity.sealed_volume, 1e-9)
      sum = sum + found.fidelity.volume
    else
      sum = nil
      code_of(found)
      break
    end
  end
  local fine, found = pcall(function() return lacuna.assembly(pieces):sweep { size = 0.4 } end)
  if fine then
    one = one + 1
    check.equal(found:quality().certified, true)
    if sum then check.near(found.fidelity.volume, sum, 1e-9) end
  else
    code_of(found)
  end
end
print(("%d of %d pieces swept alone, %d of %d volumes as one mesh"):format(swept, count, one, params.members))
for code, times in pairs(codes) do print("", code, times) end
check.that(swept >= 0.9 * count and one >= 0.7 * params.members)

-- A corner of four faces has no two ends.
local corner = open(lacuna.synthetic.prism { sides = 4, radius = 1, height = 1 })
  :cut { plane = { { 0.8, 0, 0.9 }, { 1, 0, 1 } } }
local function joins(options) return lacuna.assembly(corner):sweep(options) end
check.fails(function() joins { size = 0.2 } end, "closure.no_ends", "volume_2 has ",
  'face 2 "target"', 'void face 1 "cut_1"', "cut the volume otherwise", "leave_out")
local left = joins { size = 0.2, fallback = "leave_out" }
check.equal(left.left_out[1].code, "closure.no_ends")
check.fails(function()
  local walls = { 2 }
  for side = 1, 6 do walls[side + 1] = "wall_" .. side end
  prism:open_volume { source = "source", walls = walls }:sweep { size = 0.4 }
end, "closure.no_ends", 'face 1 "source"', 'face 2 "target"', "name the target among them")
check.done()
