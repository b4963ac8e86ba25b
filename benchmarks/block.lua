-- A unit cube from its bottom and top alone: quads × quads × layers hexahedra, its four walls found by
-- Lacuna. usage: lacuna block.lua [quads=200] [layers=25] [output=block.msh]
local lacuna = require "lacuna"

local params = lacuna.params { quads = 200, layers = 25, output = "block.msh" }

local model = lacuna.model()
local function square(name, height)
    return model:add_face {
        name = name,
        points = { { 0, 0, height }, { 1, 0, height }, { 1, 1, height }, { 0, 1, height } },
        cells = { { 1, 2, 3, 4 } },
    }
end

local void = model:open_volume { source = square("source", 0), target = square("target", 1) }
local mesh = void:sweep { layers = params.layers, size = 1 / params.quads, quads = "mapped" }
mesh:write(params.output)
print(mesh.hexes)
