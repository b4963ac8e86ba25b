// SPDX-License-Identifier: MIT
#pragma once

namespace lacuna::test {

/// Functions of recipes that make models.
///
/// `skin(cells, map)`: the faces of unit cubes { x, y, z } moved by a map, each named by its axis, its place
/// along it and the way it looks: "z2+". `all_but(part, names)`: the names of the other faces.
/// `ring(turns)`: a square section round the z axis in four walls.
inline constexpr const char* kShapes = R"lua(
function skin(cells, map, drop)
  map = map or function(x, y, z) return { x, y, z } end
  local full, faces, order, model = {}, {}, {}, lacuna.model()
  local function key(c) return c[1] .. "," .. c[2] .. "," .. c[3] end
  for _, c in ipairs(cells) do full[key(c)] = true end
  for _, c in ipairs(cells) do
    for axis = 1, 3 do
      for way = 0, 1 do
        local beside = { c[1], c[2], c[3] }
        beside[axis] = beside[axis] + 2 * way - 1
        if not full[key(beside)] then
          local name = ("xyz"):sub(axis, axis) .. c[axis] + way .. (way == 1 and "+" or "-")
          local face = faces[name]
          if not face then
            face = { name = name, points = {}, cells = {}, number = {} }
            faces[name], order[#order + 1] = face, face
          end
          local cell, u, v = {}, axis % 3 + 1, (axis + 1) % 3 + 1
          for _, d in ipairs { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } } do
            local p = { c[1], c[2], c[3] }
            p[axis], p[u], p[v] = c[axis] + way, c[u] + d[1], c[v] + d[2]
            local k = key(p)
            if not face.number[k] then
              face.points[#face.points + 1] = map(p[1], p[2], p[3])
              face.number[k] = #face.points
            end
            table.insert(cell, way == 1 and #cell + 1 or 1, face.number[k])
          end
          -- Two triangles: quads would be a mesh to keep.
          table.insert(face.cells, { cell[1], cell[2], cell[3] })
          table.insert(face.cells, { cell[1], cell[3], cell[4] })
        end
      end
    end
  end
  for _, face in ipairs(order) do
    if not (drop and drop[face.name]) then
      model:add_face { name = face.name, points = face.points, cells = face.cells }
    end
  end
  return model
end

function box(x, y, z)
  local cells = {}
  for i = 0, x - 1 do for j = 0, y - 1 do for k = 0, z - 1 do cells[#cells + 1] = { i, j, k } end end end
  return cells
end

function ring(turns)
  local model, section = lacuna.model(), { { 2, 0 }, { 3, 0 }, { 3, 1 }, { 2, 1 } }
  local function at(k, i)
    local a, point = 2 * math.pi * (i % turns) / turns, section[k % 4 + 1]
    return { point[1] * math.cos(a), point[1] * math.sin(a), point[2] }
  end
  for w = 0, 3 do
    local points, cells = {}, {}
    for i = 0, turns - 1 do
      points[#points + 1] = at(w, i)
      points[#points + 1] = at(w + 1, i)
    end
    local function id(k, i) return (i % turns) * 2 + k + 1 end
    for i = 0, turns - 1 do
      cells[#cells + 1] = { id(0, i), id(1, i), id(1, i + 1) }
      cells[#cells + 1] = { id(0, i), id(1, i + 1), id(0, i + 1) }
    end
    model:add_face { name = "wall_" .. w, points = points, cells = cells }
  end
  return model
end
)lua";

} // namespace lacuna::test
