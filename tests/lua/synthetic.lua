-- SPDX-License-Identifier: MIT
-- lacuna.synthetic over a family of sizes: whole, each volume is closed and has the volume its formula says;
-- with faces left out, it is of the class it should be and can be sealed.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local s = lacuna.synthetic
local pi = math.pi

local function polygon_area(n, r) return n / 2 * r * r * math.sin(2 * pi / n) end

-- Roles by name: what is there plays its part.
local function open(model)
  local roles = { walls = {} }
  for _, face in ipairs(model:faces()) do
    if face.name:match("^wall_") then roles.walls[#roles.walls + 1] = face else roles[face.name] = face end
  end
  return model:open_volume(roles)
end

-- Volume inside the facets, by the divergence theorem over what describe() cannot hide: area, normal and
-- centroid are exact for plane faces.
local function plane_volume(model)
  local sum = 0
  for _, face in ipairs(model:faces()) do
    local n, c = face.normal, face.centroid
    sum = sum + face.area * (n[1] * c[1] + n[2] * c[2] + n[3] * c[3]) / 3
  end
  return sum
end

-- Whole volumes are closed: neighbours share their points to the bit.
local whole = {}
for sides = 3, 8 do whole[#whole + 1] = s.prism { sides = sides, radius = sides, height = 0.5 } end
for holes = 1, 5 do
  whole[#whole + 1] = s.prism { sides = 6, holes = holes, twist = 20 * holes, taper = 1 / holes }
end
for _, bend in ipairs { -90, 45, 120 } do
  whole[#whole + 1] = s.prism { sides = 4, height = 8, bend = bend, holes = 1 }
end
for _, facets in ipairs { 3, 12, 48 } do
  whole[#whole + 1] = s.annulus { facets = facets, inner = 0.9 }
  whole[#whole + 1] = s.elbow { facets = facets }
  whole[#whole + 1] = s.elbow { facets = facets, inner = 0.5, angle = 200 }
  whole[#whole + 1] = s.barrel { facets = facets, bulge = -0.4 }
end
for holes = 0, 10 do whole[#whole + 1] = s.plate { holes = holes, length = 6, width = 3 } end
for i, model in ipairs(whole) do
  local void = open(model)
  check.equal(void.class, "closed", "number " .. i)
  check.that(void:is_watertight(), "number " .. i .. " is watertight")
end

-- Plane prisms have the volume of their formula.
for sides = 3, 9 do
  for _, taper in ipairs { 0.5, 1, 2 } do
    local volume = plane_volume(s.prism { sides = sides, radius = 1.5, height = 3, taper = taper })
    check.near(volume, polygon_area(sides, 1.5) * (1 + taper + taper * taper), 1e-9)
  end
  local hollow = plane_volume(s.prism { sides = sides, radius = 1, height = 2, holes = 1,
      hole_radius = 0.25 })
  check.near(hollow, 2 * (polygon_area(sides, 1) - polygon_area(sides, 0.25)), 1e-9)
end

-- Names: source, target, then every wall.
for holes = 0, 3 do
  local names = {}
  for _, face in ipairs(s.prism({ sides = 5, holes = holes }):faces()) do names[#names + 1] = face.name end
  check.equal(#names, 2 + 5 * (1 + holes))
  check.equal(names[1], "source")
  check.equal(names[2], "target")
  for i = 3, #names do check.equal(names[i], "wall_" .. i - 2) end
end

-- Each class, at several sizes, open and then sealed.
local classes = {
  { "I", "walls" },
  { "II", { "wall_1", "wall_2" } },
  { "III", { "wall_1" } },
  { "III", { "wall_1", "wall_3" } },
  { "IV", "target" },
  { "IV", "source" },
  { "V", { "source", "target" } },
}
for _, sides in ipairs { 4, 6 } do
  for _, options in ipairs { {}, { taper = 0.5 }, { twist = 15 }, { holes = 1 } } do
    for _, entry in ipairs(classes) do
      local class, drop = table.unpack(entry)
      local void = open(s.prism { sides = sides, drop = drop, table.unpack {}, taper = options.taper,
          twist = options.twist,
                                  holes = options.holes })
      if not (class == "I" and options.holes) then check.equal(void.class, class) end
      check.equal(void:is_watertight(), false)
      check.that(void:close().watertight, class .. " is sealed")
      check.that(void:is_watertight())
    end
  end
end

-- Ends of tens of thousands of points, straight, round and with holes, have the area of their section.
do
  local function area(points, radius) return points / 2 * radius ^ 2 * math.sin(2 * math.pi / points) end
  for _, case in ipairs {
    { s.prism { facets = 5000, holes = 1, hole_radius = 0.4 }, area(6, 1) - area(6, 0.4) },
    { s.annulus { facets = 20000 }, area(20000, 1) - area(20000, 0.5) },
    { s.plate { holes = 9, hole_radius = 0.5, facets = 2000 }, 16 - 9 * area(2000, 0.5) },
  } do
    check.near(case[1]:face("source").area, case[2], 1e-9)
    check.near(case[1]:face("target").area, case[2], 1e-9)
  end
end

-- What a match was unsure of stands in the report of the mesh whose void edges were drawn by it.
do
  local void = s.elbow { angle = 120, drop = "wall_1" }:open_volume { source = "source", target = "target" }
  local notes = #void:match().notes
  check.that(notes > 0, "ends alone leave open how a bend of 120 degrees turns them")
  void:close { edge_shape = "smooth" }
  local told = 0
  for _, line in ipairs(void:sweep({ size = 0.5 }).report) do
    if line:find("^match: .*match{ vertices = ") then told = told + 1 end
  end
  check.equal(told, notes)
end

check.done()
