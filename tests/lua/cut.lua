-- SPDX-License-Identifier: MIT
-- Cutting in recipes: by planes and faces, what the pieces are, what one mesh of them is.
local lacuna = require "lacuna"
local folder = arg[0]:match "^(.*[/\\])" or ""
local check = dofile(folder .. "check.lua")

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

-- What is refused.
local v = open(prism)
check.fails(function() v:cut { plane = { { 0, 0, 4 }, { 0, 0, 1 } } } end, "misses", "from -4 to -1")
check.fails(function() v:cut { plane = { { 0, 0, 1 }, { 0, 0, 0 } } } end, "normal")
check.fails(function() v:cut { plane = { 1, 2, 3 } } end, "plane")
check.fails(function() v:cut { plane = { { 0, 0, 1 }, { 0, 0, 1 } }, face = 1 } end, "either")
check.fails(function() v:cut {} end, "either")
check.fails(function() v:cut { face = 77 } end, "face 77")
check.fails(function() v:cut { face = { kind = "plane" } } end, "several")
check.fails(function() v:cut { plan = 1 } end, "plan")

-- A plane's normal may be of any length that is a number.
for _, length in ipairs { 1e300, 1e-300 } do
  local volume = lacuna.synthetic.prism { sides = 4 }
    :open_volume { source = "source", target = "target", walls = "auto" }
  check.equal(#volume:cut { plane = { { 0, 0, 0.7 }, { 0, 0, length } } }, 2)
end
check.done()
