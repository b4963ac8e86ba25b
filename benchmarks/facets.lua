-- From a binary STL file to a sealed volume: a JSON line with the seconds of the processor by stage.
-- usage: lacuna facets.lua [facets=87000] [shape=prism|twist|disc] [roles=found|given] [file=facets.stl]
--
-- A tube between a square and a circle, one outer wall missing, straight or twisted by 90 degrees, or its two
-- ends alone. A row of sizes: for n in 22000 87000 346000 1400000; do lacuna facets.lua facets=$n; done
local lacuna = require "lacuna"

local params = lacuna.params { facets = 87000, shape = "prism", roles = "found", file = "facets.stl" }

local twist = params.shape == "twist" and math.pi / 2 or 0
local disc = params.shape == "disc"
local n = math.max(2, math.floor(math.sqrt(params.facets / (disc and 16 or 30)) / 2 + 0.5) * 2)

local function at(around, out, up)
    local turn = 2 * math.pi * around / (4 * n)
    local x, y = 0.5 * math.cos(turn), 0.5 * math.sin(turn)
    local scale = (1 - out) + out / math.max(math.abs(x), math.abs(y))
    local c, s = math.cos(twist * up), math.sin(twist * up)
    return scale * (c * x - s * y), scale * (s * x + c * y), 2 * up
end

local chunks, facets = {}, 0
local function facet(ax, ay, az, bx, by, bz, cx, cy, cz)
    chunks[#chunks + 1] = string.pack("<ffffffffffffI2", 0, 0, 0, ax, ay, az, bx, by, bz, cx, cy, cz, 0)
    facets = facets + 1
end
local function grid(from, to, place)
    for i = from, to - 1 do
        for k = 0, n - 1 do
            local ax, ay, az = place(i, k / n)
            local bx, by, bz = place(i + 1, k / n)
            local cx, cy, cz = place(i + 1, (k + 1) / n)
            local dx, dy, dz = place(i, (k + 1) / n)
            facet(ax, ay, az, bx, by, bz, cx, cy, cz)
            facet(ax, ay, az, cx, cy, cz, dx, dy, dz)
        end
    end
end
grid(0, 4 * n, function(i, t) return at(i % (4 * n), t, 0) end)
grid(0, 4 * n, function(i, t) return at(i % (4 * n), t, 1) end)
if not disc then
    grid(0, 4 * n, function(i, t) return at(i % (4 * n), 0, t) end)
    for side = 1, 3 do -- corners of the square are odd multiples of an eighth of the turn
        local first = side * n + n // 2
        grid(first, first + n, function(i, t) return at(i % (4 * n), 1, t) end)
    end
end
local file = assert(io.open(params.file, "wb"))
file:write(string.rep("\0", 80), string.pack("<I4", facets), table.concat(chunks))
file:close()
chunks = nil

local seconds, last = {}, os.clock()
local function lap(stage)
    local now = os.clock()
    seconds[#seconds + 1] = string.format('"%s": %.3f', stage, now - last)
    last = now
end
local model = lacuna.load(params.file)
lap "load"
local volume
if params.roles == "found" then
    volume = model:open_volume {}
else
    -- The end that looks down or up is the one whose facets lie at the bottom or the top.
    local function faces_between(low, high)
        return model:faces { box = { { -9, -9, low }, { 9, 9, high } } }
    end
    volume = model:open_volume {
        source = faces_between(-0.001, 0.001), target = faces_between(1.999, 2.001),
        walls = not disc and "auto" or nil,
    }
end
lap "roles"
volume:match()
lap "match"
volume:close()
lap "close"
print(string.format('{"bench": "facets/%s/roles=%s", "facets": %d, "class": "%s", "seconds": {%s}}',
                    params.shape, params.roles, facets, volume.class, table.concat(seconds, ", ")))
