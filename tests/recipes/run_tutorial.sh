#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run_tutorial.sh PROGRAM FOLDER DOCUMENT FILE ...: types what a document says, in its order, in one folder
# that has the files. A block marked `lua` is saved under the name in its first line, a comment. A block
# marked `sh` is run, `lacuna` being the program; it must end well. The lines of a block marked `text` must
# be printed by the block before.
set -euo pipefail
program=$1 folder=$2 document=$3
shift 3

rm -rf "$folder"
mkdir -p "$folder/blocks" "$folder/bin" "$folder/work"
ln -s "$program" "$folder/bin/lacuna"
cp "$@" "$folder/work"
export PATH="$folder/bin:$PATH"

awk -v out="$folder/blocks/" '/^```/ { inside = !inside; kind = substr($0, 4)
                                       if (inside) file = sprintf("%s%02d.%s", out, ++number, kind); next }
                              inside { print > file }' "$document"
cd "$folder/work"
typed=0
for block in "$folder"/blocks/*; do
    case $block in
    *.lua)
        name=$(sed -n '1s/^-- \([A-Za-z0-9_]*\.lua\)$/\1/p' "$block")
        [[ -n $name ]] || { echo "$block does not begin with the name it is saved under"; exit 1; }
        cp "$block" "$name"
        ;;
    *.sh)
        bash -e "$block" >"$folder/printed.txt" || { echo "$block failed"; cat "$block"; exit 1; }
        typed=$((typed + 1))
        ;;
    *.text)
        while IFS= read -r line; do
            grep -qxF -- "$line" "$folder/printed.txt" || { echo "not printed: $line"; exit 1; }
        done <"$block"
        ;;
    *)
        echo "$block is marked neither lua nor sh nor text"
        exit 1
        ;;
    esac
done
((typed > 0)) || { echo "$document has no commands"; exit 1; }
