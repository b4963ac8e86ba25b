-- SPDX-License-Identifier: MIT
-- A CAD part on a legacy deck shares the deck's nodes where the deck's face is named in place of its own.
-- A mesh that only lies on the deck is refused, for the deck would come apart there.
-- usage: lacuna deck_cad.lua scratch=FOLDER
local lacuna = require "lacuna"
local check = dofile((arg[0]:match "^(.*[/\\])" or "") .. "check.lua")
local params = lacuna.params { scratch = "." }

local height = 4
local shapes = {
  box = { base = "Box(1) = {0,0,0,6,5,4};", part = "Box(1) = {0,0,4,6,5,3};" },
  cylinder = { base = "Cylinder(1) = {0,0,0,0,0,4,3};", part = "Cylinder(1) = {0,0,4,0,0,3,3};" },
  cone = { base = "Cylinder(1) = {0,0,0,0,0,4,3};", part = "Cone(1) = {0,0,4,0,0,3,3,2};" },
}

local function file_of(name, text)
  local path = ("%s/%s.geo"):format(params.scratch, name)
  check.write(path, 'SetFactory("OpenCASCADE");\n' .. text .. "\n")
  return path
end

--- Number of lines of a deck's cards of nodes.
local function nodes_of(path)
  local count, in_nodes = 0, false
  for line in io.lines(path) do
    if line:find "^%*" then
      in_nodes = line:upper():find "^%*NODE%s*$" ~= nil or line:upper():find "^%*NODE," ~= nil
    elseif in_nodes then
      count = count + 1
    end
  end
  return count
end

for name, shape in pairs(shapes) do
  local deck = ("%s/%s.inp"):format(params.scratch, name)
  for _, size in ipairs { 1.2, 0.7 } do
    lacuna.load(file_of(name .. "_base", shape.base)):open_volume { name = "base" }
        :sweep { size = 1 }:write(deck)
    -- The deck's rim lies on the part's within the deck's sag.
    local both = lacuna.load({ deck, file_of(name .. "_part", shape.part) }, { tolerance = 0.1 })
    local at, own, faces = nil, nil, {}
    for _, face in ipairs(both:faces()) do
      local flat_there = face.kind == "plane" and math.abs(face.centroid[3] - height) < 1e-6
      if flat_there and face.has_mesh then at = face elseif flat_there then own = face
      elseif not face.has_mesh then faces[#faces + 1] = face end
    end
    check.that(at and (own or name ~= "box"), name .. ": a face of each at the contact")
    faces[#faces + 1] = at
    local joined = ("%s/%s_joined.inp"):format(params.scratch, name)
    local function joined_nodes()
      local mesh = both:open_volume { faces = faces, name = "part" }:sweep { size = size }
      mesh:write(joined, { with = both })
      local at_contact = 0
      for n = 1, mesh.nodes do
        local _, _, z = mesh:node(n)
        if math.abs(z - height) < 1e-6 then at_contact = at_contact + 1 end
      end
      return nodes_of(deck) + mesh.nodes - nodes_of(joined), at_contact
    end
    local shared, all = joined_nodes()
    check.equal(shared, all, name .. ": nodes at the contact that are the deck's")
    if own then -- Its rim has the deck's nodes; its quads may be those of the deck.
      faces[#faces] = own
      local done, common, nodes = pcall(joined_nodes)
      if done then
        check.equal(common, nodes, name)
      else
        check.that(tostring(common):find "lie on face", common)
      end
    end
  end
end

-- Nodes that coincide by accident, on an edge that is divided otherwise, do not join a part to a deck.
do
  local deck = params.scratch .. "/base.inp"
  lacuna.load(file_of("base", "Box(1) = {0,0,0,6,5,4};")):open_volume { name = "base" }
      :sweep { size = 1 }:write(deck)
  local both = lacuna.load { deck, file_of("beside", "Box(1) = {6,0,4,3,3,3};") }
  local faces = {}
  for _, face in ipairs(both:faces()) do if not face.has_mesh then faces[#faces + 1] = face end end
  local mesh = both:open_volume { faces = faces, name = "part" }:sweep { size = 0.7 }
  local joined = params.scratch .. "/lone.inp"
  check.fails(function() mesh:write(joined, { with = both }) end, "no sides of elements", "tie")
  check.that(not check.exists(joined))
end
check.done()
