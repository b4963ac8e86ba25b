-- SPDX-License-Identifier: MIT
-- A MED file for the fuzzer: lacuna med_sample.lua output=FILE
local lacuna = require "lacuna"
local params = lacuna.params { output = "sample.med" }
local void = lacuna.synthetic.prism { sides = 4 }:open_volume { name = "foam" }
void:sweep({ layers = 1, size = 1 }):write(params.output)
