#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run_recipe.sh PROGRAM RECIPE FOLDER JUDGE GROUPS: runs the recipe in FOLDER, twice, and has its mesh judged:
# by the program itself, and by JUDGE, which shares no code with it, where that and the Python module of Gmsh
# are there.
set -euo pipefail
program=$1 recipe=$2 folder=$3 judge=$4 groups=$5

rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
"$program" "$recipe"

shopt -s nullglob
meshes=(*.msh)
((${#meshes[@]} == 1)) || { echo "expected one mesh, found: ${meshes[*]}"; exit 1; }
mesh=${meshes[0]}

"$program" check "$mesh"

"$program" "$recipe" output=again.msh >/dev/null
cmp "$mesh" again.msh || { echo "a second run wrote another mesh"; exit 1; }

if [[ ! -f $judge ]]; then
    echo "skipped: the independent judge is not there"
elif ! /usr/bin/python3 -c 'import gmsh, numpy' 2>/dev/null; then
    echo "skipped: the independent judge needs python3-gmsh and python3-numpy"
else
    /usr/bin/python3 "$judge" "$mesh" --groups "$groups"
fi
