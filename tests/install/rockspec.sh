#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# rockspec.sh TREE: makes the rock into the folder TREE and uses the module from a plain Lua.
#
# Takes luarocks, lua5.4 and the time of a build: not one of ctest's tests.
set -euo pipefail
tree=$(realpath -m "$1")
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.."
luarocks --lua-version 5.4 make --tree="$tree" lua/lacuna-scm-1.rockspec
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
LUA_CPATH="$tree/lib/lua/5.4/?.so" lua5.4 - <<'RECIPE'
local lacuna = require "lacuna"
local open = lacuna.synthetic.prism { sides = 4, drop = "target" }
local void = open:open_volume { source = "source", walls = "auto" }
local mesh = void:sweep { layers = 4, size = 0.25 }
mesh:write "prism.vtu"
print(mesh, lacuna.check("prism.vtu").certified)
RECIPE
[[ $(find "$tree/lib/lua" -type f) == "$tree/lib/lua/5.4/lacuna.so" ]] ||
  { echo "more than the module was installed"; exit 1; }
luarocks --lua-version 5.4 remove --tree="$tree" lacuna
echo "all of it works"
