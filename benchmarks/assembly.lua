-- SPDX-License-Identifier: MIT
-- An assembly of n × n × m blocks against the same blocks swept one by one: CPU seconds of each, and their
-- ratio. usage: lacuna assembly.lua [across=5] [up=4] [quads=46] [layers=46] [style=mapped]
-- The peak of memory is the process's: run it with only = "assembly" or "parts" under /usr/bin/time -v.
local lacuna = require "lacuna"

local params = lacuna.params { across = 5, up = 4, quads = 46, layers = 46, only = "", style = "mapped",
  threads = 1 }

--- A block between two corners, its bottom and top the ends; its sides given or left for Lacuna to find.
local function block(name, x, y, z)
  local model = lacuna.model()
  local function quad(face, a, b, c, d)
    return model:add_face { name = face, points = { a, b, c, d }, cells = { { 1, 2, 3, 4 } } }
  end
  local function corner(i, j, k) return { x + i, y + j, z + k } end
  quad("bottom", corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0))
  quad("top", corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1))
  quad("front", corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1))
  quad("back", corner(0, 1, 0), corner(1, 1, 0), corner(1, 1, 1), corner(0, 1, 1))
  return model:open_volume { source = "bottom", target = "top", walls = { "front", "back" }, name = name }
end

local options = { layers = params.layers, size = 1 / params.quads, quads = params.style,
  threads = params.threads }
local function blocks()
  local list = {}
  for k = 1, params.up do
    for j = 1, params.across do
      for i = 1, params.across do
        list[#list + 1] = block(("block_%d"):format(#list + 1), i, j, k)
      end
    end
  end
  return list
end

local parts, whole
if params.only ~= "assembly" then
  local start, hexes, held = os.clock(), 0, {} -- all at once, as the assembly holds its parts
  for i, volume in ipairs(blocks()) do
    held[i] = volume:sweep(options)
    hexes = hexes + held[i].hexes
  end
  parts = os.clock() - start
  print(("%d hexes in %d parts: %.2f s"):format(hexes, params.across ^ 2 * params.up, parts))
end
if params.only ~= "parts" then
  local start = os.clock()
  local mesh = lacuna.assembly(blocks()):sweep(options)
  whole = os.clock() - start
  print(("%d hexes in one assembly: %.2f s"):format(mesh.hexes, whole))
end
if parts and whole then print(("ratio %.2f"):format(whole / parts)) end
