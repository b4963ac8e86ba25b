-- SPDX-License-Identifier: MIT
-- The module in a stock interpreter.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"

check.that(package.searchpath("lacuna", package.cpath), "it is the module that was loaded")
check.equal(require "lacuna", lacuna)
local void = lacuna.synthetic.prism({ sides = 4, drop = "walls" }):open_volume { source = "source",
    target = "target" }
check.equal(void.class, "I")
local mesh = void:sweep { layers = 2, size = 0.5 }
check.equal(mesh:quality().inverted, 0)

-- Errors print, with file and line, and leave the state whole.
local message = check.fails(function() void:sweep { layres = 2 } end, "'layers'", "module.lua:")
check.equal(type(message), "string")
check.equal(#lacuna.synthetic.barrel():faces(), 3)

-- Parameters come from the interpreter's own `arg`.
arg = { [0] = arg[0], "layers=20", "name=x" }
local params = lacuna.params { layers = 12, name = "y", size = 1.5 }
check.equal(params.layers, 20)
check.equal(params.name, "x")
check.equal(params.size, 1.5)

-- Many objects come and go without a leak that would stop the loop or a second release that would crash it.
for _ = 1, 200 do
  local early <close> = lacuna.synthetic.prism { sides = 3 }
  local faces = early:faces()
  faces[1] = nil
end
collectgarbage()
collectgarbage()

check.done()
