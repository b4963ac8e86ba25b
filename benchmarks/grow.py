#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every synthetic shape swept at every size, each in a process of its own: a line of JSON a row.

usage: grow.py LACUNA [--sizes 1e4,1e5,1e6] [--shapes disc,plate] [--runs 1] [--write] [--output ROWS.jsonl]

The rows are those of row.lua, of the run that took the median processor time. With --write each mesh is written
(binary MSH) and removed again. plot.py draws them. By default the rows go to benchmarks/results/.
"""
import argparse
import datetime
import json
import pathlib
import subprocess
import sys
import tempfile

import compare

HERE = pathlib.Path(__file__).resolve().parent
SHAPES = "block,disc,plate,slot,ring,pipe,barrel,frame,twisted"


def measure(lacuna, shape, hexes, runs, write, commit):
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        command = [lacuna, str(HERE / "row.lua"), f"shape={shape}", f"hexes={hexes}", f"commit={commit}"]
        if write:
            command.append(f"output={folder}/mesh.msh")
        for _ in range(runs):
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode != 0:
                return {"shape": shape, "asked": hexes, "failed": done.stderr.strip().splitlines()[-1:]}
            rows.append(json.loads(done.stdout))
    return sorted(rows, key=lambda row: row["processor_seconds"]["total"])[len(rows) // 2]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lacuna")
    parser.add_argument("--sizes", default="1e4,1e5,1e6", help="hexahedra, with commas")
    parser.add_argument("--shapes", default=SHAPES, help="with commas")
    parser.add_argument("--runs", type=int, default=1)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--output")
    options = parser.parse_args()
    lacuna = str(pathlib.Path(options.lacuna).resolve())
    day = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H%M%SZ")
    output = pathlib.Path(options.output or HERE / "results" / f"grow_{day}.jsonl")
    commit = compare.commit_here()
    failed = 0
    with output.open("w") as file:
        for shape in options.shapes.split(","):
            for size in options.sizes.split(","):
                row = measure(lacuna, shape, round(float(size)), options.runs, options.write, commit)
                file.write(json.dumps(row) + "\n")
                file.flush()
                if "failed" in row:
                    failed += 1
                    print(f"{shape:8} {float(size):9.0f} failed: {row['failed']}")
                else:
                    print(f"{shape:8} {row['hexes']:10} hexes, {row['processor_seconds']['total']:8.3f} s, "
                          f"{row['hexes_per_second'] / 1e6:7.2f} million a second, {row['peak_mib']:7.0f} MiB, "
                          f"scaled Jacobian {row['min_scaled_jacobian']:.3f} least")
    print(f"written to {output}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
