-- SPDX-License-Identifier: MIT
-- Blocks with a bore from above and blind holes from the side: each direction needs a sweep of its own, and
-- the rims of the blind holes lie inside ends that are walls of another piece.
local lacuna = require "lacuna"
local folder = arg[0]:match("^(.*/)") or "./"
local check = dofile(folder .. "check.lua")
local params = lacuna.params { scratch = ".", first = 1, count = 12 }

--- A blind hole from the face x = a inward. Its middle is at (y, z).
--- @param first  number of its first solid.
--- @return  its text, the number of the solid that has its shape, and its volume
local function hole(kind, first, a, depth, y, z, r)
  local function rod(number, at)
    return ("Cylinder(%d) = {%.6f, %.6f, %.6f, %.6f, 0, 0, %.6f};\n")
        :format(number, a - depth, at, z, depth + 1, r)
  end
  local box = ("Box(%d) = {%.6f, %.6f, %.6f, %.6f, %.6f, %.6f};\n")
      :format(first, a - depth, y - r, z - r, depth + 1, 2 * r, 2 * r)
  if kind == "square" then return box, first, 4 * r * r * depth end
  if kind == "slot" then
    return box .. rod(first + 1, y - r) .. rod(first + 2, y + r) ..
        ("BooleanUnion(%d) = { Volume{%d}; Delete; }{ Volume{%d:%d}; Delete; };\n")
        :format(first + 3, first, first + 1, first + 2), first + 3, (4 + math.pi) * r * r * depth
  end
  return rod(first, y), first, math.pi * r * r * depth
end

for number = params.first, params.first + params.count - 1 do
  local between = check.random(number)
  local kind = ({ "round", "slot", "square", "pair" })[number % 4 + 1]
  local a, b, c = between(50, 80), between(38, 50), between(25, 40)
  local bore, depth, r = between(5, 8), between(0.15, 0.35) * a, between(0.14, 0.2) * c
  local texts, solids, volume = {}, { 2 }, a * b * c - math.pi * bore * bore * c
  local middles = { { b * between(0.4, 0.6), c * between(0.45, 0.55) } }
  if kind == "pair" then middles = { { b * 0.28, c * 0.5 }, { b * 0.72, c * 0.5 } } end
  for n, middle in ipairs(middles) do
    local text, solid, lost = hole(kind, 10 * n, a, depth * (n == 2 and 0.7 or 1), middle[1], middle[2], r)
    texts[n], solids[n + 1] = text, solid
    volume = volume - lost
  end
  local file = ("%s/%02d.geo"):format(params.scratch, number)
  check.write(file, ([[SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, %.6f, %.6f, %.6f};
Cylinder(2) = {%.6f, %.6f, -1, 0, 0, %.6f, %.6f};
%sBooleanDifference{ Volume{1}; Delete; }{ Volume{%s}; Delete; }
]]):format(a, b, c, a * 0.3, b / 2, c + 2, bore, table.concat(texts),
    table.concat(solids, ",")))
  local mesh = lacuna.load(file):open_volume {}:sweep {}
  local quality, what = mesh:quality(), ("member %d, %s"):format(number, kind)
  check.that(quality.certified, what .. ": cells are certified")
  check.that(quality.min_scaled_jacobian > 0.2, what .. ": least " .. quality.min_scaled_jacobian)
  check.that(math.abs(quality.volume / volume - 1) < 0.01, what .. ": volume " .. quality.volume / volume)
end
check.done()
