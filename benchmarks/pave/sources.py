#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Sources of several faces and curved ones: figures of their quads as one mesh in space.

    sources.py BENCH_SOURCES [--data FOLDER] [--sizes 40,120,400,1000] [--output FILE.json] [--before FILE.json]
    sources.py BENCH_SOURCES --random 30 [--seed 1]

Runs bench_sources over its family and over the source faces of the real cases, and prints a table and how
often each bar is met; with --random instead over so many members of a family that nothing was chosen on.
With --before it says what became better or worse than in that file. What is measured: the quads of all
source faces as one mesh, so that a node on an edge that two of them share is inside it.

Bars: quads within a quarter of those asked (from 120 on); irregular nodes at most 1.5 times the least and 4;
95 % of the rim's rows and of edges as asked, from 120 on; 85 % of the rows along shared edges; the least
scaled Jacobian 0.6 or more.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys

from against_gmsh import real_cases


def run(bench, quads, spec=None, picture=None):
    words = [bench, str(quads)] + ([spec] if spec else []) + ([picture] if picture else [])
    done = subprocess.run(words, capture_output=True, text=True)
    lines = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    return lines or [{"case": spec, "asked": quads, "failed": done.stderr.strip()[-200:]}]


def bars(r):
    met = {"valid": "failed" not in r and r["min"] > 0 and r["triangles"] == 0}
    if "failed" in r:
        return met
    met["irregular"] = r["irregular"] <= 1.5 * r["least_irregular"] + 4
    met["min 0.6"] = r["min"] >= 0.6
    if r["asked"] >= 120:
        met["count"] = 0.75 * r["asked"] <= r["quads"] <= 1.25 * r["asked"]
        met["row"] = r["row"] >= 0.95
        met["shared row"] = r["shared_row"] >= 0.85
        met["size"] = r["size"] >= 0.95
    return met


def line(r):
    if "failed" in r:
        return f"| {r['case']} | {r['asked']} | failed: {r['failed'][:70]} | | | | | | | |"
    missed = ", ".join(bar for bar, met in bars(r).items() if not met) or "-"
    return (f"| {r['case']} | {r['asked']:.0f} | {r['quads']} | {r['min']:.3f} | {r['mean']:.4f} | "
            f"{r['irregular']} ({r['least_irregular']}), {r['irregular_shared']} shared | {100 * r['row']:.0f} % | "
            f"{100 * r['shared_row']:.0f} % | {100 * r['size']:.0f} % | {r['seconds']:.4f} | {missed} |")


HEAD = ["| source | asked | quads | min | mean | irregular (least) | row | shared row | size | seconds | misses |",
        "|---|---|---|---|---|---|---|---|---|---|---|"]


def sums(results):
    counts = {}
    for r in results:
        for bar, met in bars(r).items():
            counts.setdefault(bar, [0, 0])
            counts[bar][0] += met
            counts[bar][1] += 1
    good = [r for r in results if "failed" not in r]
    lines = ["- " + ", ".join(f"{bar} {met} of {of}" for bar, (met, of) in counts.items())]
    for name in ("min", "mean", "irregular", "row", "shared_row", "size", "seconds"):
        lines.append(f"- mean of {name}: {sum(r[name] for r in good) / max(1, len(good)):.4f}")
    off = [abs(r["quads"] / r["asked"] - 1) for r in good]
    lines.append(f"- mean share by which quads are off those asked: {sum(off) / max(1, len(off)):.4f}")
    return lines


def changes(results, before):
    old = {(r["case"], r["asked"]): r for r in before if "failed" not in r}
    lines = []
    for r in results:
        o = old.get((r["case"], r["asked"]))
        if o is None or "failed" in r:
            lines += [f"- {r['case']}, {r['asked']}: " + ("fails now" if "failed" in r else "is new")] * (o is not None)
            continue
        words = []
        for name, more in (("min", 0.005), ("mean", 0.002), ("row", 0.02), ("shared_row", 0.02), ("size", 0.02)):
            if abs(r[name] - o[name]) > more:
                words.append(f"{name} {o[name]:.3f} → {r[name]:.3f}" + (" WORSE" if r[name] < o[name] else ""))
        if r["irregular"] != o["irregular"]:
            words.append(f"irregular {o['irregular']} → {r['irregular']}" +
                         (" WORSE" if r["irregular"] > o["irregular"] else ""))
        if r["quads"] != o["quads"]:
            words.append(f"quads {o['quads']} → {r['quads']}")
        if words:
            lines.append(f"- {r['case']}, {r['asked']:.0f}: " + ", ".join(words))
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bench", help="the program bench_sources")
    parser.add_argument("--data", help="folder with the CAD files of the real cases")
    parser.add_argument("--sizes", default="40,120,400,1000")
    parser.add_argument("--random", type=int, default=0, help="members of the random family, and nothing else")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--output", help="file for the figures")
    parser.add_argument("--before", help="file of figures to compare with")
    options = parser.parse_args()
    bench = str(pathlib.Path(options.bench).resolve())
    worker = pathlib.Path(bench).parent.parent / "lacuna-cad"
    if worker.exists():
        os.environ.setdefault("LACUNA_CAD", str(worker))
    results = []
    for quads in map(int, options.sizes.split(",")):
        for number in range(options.random):
            results += run(bench, quads, f"random:{options.seed}:{number}")
        if options.random:
            continue
        results += run(bench, quads)
        for name, (spec, _) in (real_cases(options.data) if options.data else {}).items():
            results += [{**r, "case": name} for r in run(bench, quads, spec)]
    text = HEAD + [line(r) for r in results] + [""] + sums(results)
    if options.before:
        text += ["", "What changed:", ""] + changes(results, json.loads(pathlib.Path(options.before).read_text()))
    print("\n".join(text))
    if options.output:
        pathlib.Path(options.output).write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    sys.exit(main())
