-- A round bar from its two ends alone, paved with about `quads` quads and swept.
-- usage: lacuna disc.lua [quads=40000] [layers=25] [sides=720] [output=disc.msh]
local lacuna = require "lacuna"

local params = lacuna.params { quads = 40000, layers = 25, sides = 720, output = "disc.msh" }

local model = lacuna.model()
local function disc(name, height)
    local points, cells = { { 0, 0, height } }, {}
    for i = 1, params.sides do
        local angle = 2 * math.pi * (i - 1) / params.sides
        points[i + 1] = { math.cos(angle), math.sin(angle), height }
        cells[i] = { 1, i + 1, i % params.sides + 2 }
    end
    return model:add_face { name = name, points = points, cells = cells }
end

local void = model:open_volume { source = disc("source", 0), target = disc("target", 1) }
local mesh = void:sweep { layers = params.layers, size = math.sqrt(math.pi / params.quads) }
mesh:write(params.output)
print(mesh.hexes)
