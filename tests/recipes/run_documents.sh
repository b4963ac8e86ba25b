#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run_documents.sh PROGRAM FOLDER DOCUMENT ...: runs every block marked `lua` of the documents, each in a
# folder of its own below FOLDER. It must end well and write one mesh, and every cell of that must be valid.
set -euo pipefail
program=$1 folder=$2
shift 2

rm -rf "$folder"
for document in "$@"; do
    name=$(basename "$document" .md)
    mkdir -p "$folder/$name"
    awk -v out="$folder/$name/" '/^```/ { inside = !inside && $0 == "```lua"; number += inside; next }
                                 inside { print > (out number ".lua") }' "$document"
    compgen -G "$folder/$name/*.lua" >/dev/null || { echo "$document has no block marked lua"; exit 1; }
    for recipe in "$folder/$name"/*.lua; do
        work=${recipe%.lua}
        mkdir "$work"
        (cd "$work" && "$program" "$recipe" >printed.txt) || { echo "$recipe of $document failed"; exit 1; }
        meshes=("$work"/*.msh)
        [[ ${#meshes[@]} == 1 && -f ${meshes[0]} ]] \
            || { echo "$recipe wrote ${meshes[*]}, not one mesh"; exit 1; }
        "$program" check "${meshes[0]}" >/dev/null
    done
done
