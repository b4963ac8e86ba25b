-- SPDX-License-Identifier: MIT
-- A block of about 100,000 cells and copies of it as one mesh: a line of JSON with peak memory and seconds.
-- usage: lacuna copies.lua [copies=100] [hexes=100000] [output=]
local lacuna = require "lacuna"

local params = lacuna.params { copies = 100, hexes = 100000, output = "" }
local side = math.floor((params.hexes / 40) ^ 0.5 + 0.5)
local block = lacuna.synthetic.prism { sides = 4, height = 1 }:open_volume {
  source = "source", target = "target", walls = "auto",
}:sweep { layers = 40, size = 2 ^ 0.5 / side, quads = "mapped" }
local start = os.clock()
local mesh = params.copies > 1 and block:pattern { translate = { 0, 0, 1 }, count = params.copies } or block
local made = os.clock() - start
if params.output ~= "" then mesh:write(params.output) end

local file <close> = io.open("/proc/self/status")
local kib = file and file:read("a"):match("VmHWM:%s*(%d+)") or 0
print(('{"copies": %d, "hexes": %d, "nodes": %d, "seconds": %.4g, "peak_mib": %.4g}'):format(params.copies,
  mesh.hexes, mesh.nodes, made, kib / 1024))
