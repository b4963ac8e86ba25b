#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The bars of speed and memory that Lacuna holds itself to, in one run: each bar, the figure, met or not.

usage: bars.py LACUNA [--runs 5] [--scale 1] [--only gmsh,block,bare,residual,certificate,growth,facets,copies]
               [--folder /tmp] [--output BARS.jsonl]

Every figure is the median of `runs` processes, which run in turn with their peers; growth to the largest meshes is
one run a size. --scale makes every mesh smaller by that factor, to try the command: its figures then say nothing.
Peers and programs that are not here leave their bars unmeasured, which is told. The exit code is 1 where a bar is
missed, and 3 where none is missed but some are unmeasured. The largest file takes some 10 GB of --folder for a minute.

  gmsh         disc and plate with five holes of 1e6, whole processes, against Gmsh's best setting for quads alone
  block        block of 1e7 against Gmsh's transfinite block
  bare         block and disc of 1e7, and the block from its source alone, against the bare loop that fills and
               writes the same arrays
  residual     twisted by 90 degrees, 2e4 source quads: layers placed, proved and compared, a core; two threads against one
  certificate  cells that must be cut to be decided, a core; two threads against one over curved cells
  growth       block and disc of 1e5 to 1e8, swept and written at once: power of the time, with that of the bare
               loop beside it, which tells what of it is the system's writing; memory at 1e8
  facets       a million facets from roles to a sealed volume; power from 87,000 on
  copies       memory of 100 copies of 100,000 cells against 1.2 times that of one and 24 bytes a node
"""
import argparse
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

import compare

HERE = pathlib.Path(__file__).resolve().parent
GROUPS = ("gmsh", "block", "bare", "residual", "certificate", "growth", "facets", "copies")


class Bars:
    """The bars met and missed, told as they are found."""

    def __init__(self, output, head):
        self.file, self.missed, self.unmeasured = output.open("w"), 0, 0
        self.file.write(json.dumps(head) + "\n")

    def tell(self, bar, figure, limit, at_least, unit=""):
        met = figure is not None and (figure >= limit if at_least else figure <= limit)
        word = "met" if met else "unmeasured" if figure is None else "MISSED"
        self.missed += word == "MISSED"
        self.unmeasured += figure is None
        sign = ">=" if at_least else "<="
        found = "" if figure is None else f"{figure:.3g}{unit}"
        print(f"{word:10} {bar:66} {found:>14}   bar {sign} {limit:g}{unit}", flush=True)
        self.file.write(json.dumps({"bar": bar, "figure": figure, "limit": limit, "at_least": at_least, "met": met}) + "\n")
        self.file.flush()

    def note(self, what, figure):
        """A figure to compare with, which is no bar."""
        print(f"{'peer':10} {what:66} {figure:>14.3g}", flush=True)
        self.file.write(json.dumps({"peer": what, "figure": figure}) + "\n")
        self.file.flush()


def power(points):
    """The power by which seconds grow, by least squares of the logarithms."""
    xs, ys = zip(*((math.log(x), math.log(y)) for x, y in points))
    middle_x, middle_y = statistics.mean(xs), statistics.mean(ys)
    return (sum((x - middle_x) * (y - middle_y) for x, y in zip(xs, ys))
            / sum((x - middle_x) ** 2 for x in xs))


def against(case, hexes, peer, options, folder):
    """Lacuna and a peer on one case; None where the peer is not here."""
    if peer not in compare.installed([peer], options):
        return None
    settings = argparse.Namespace(lacuna=options.lacuna, bare=options.bare, runs=options.runs, hexes=hexes)
    found = compare.compare(case, [peer], settings, folder)
    ours, theirs = found["lacuna"], found.get(peer)
    return theirs and {"times": theirs["times_lacuna"]["wall"], "memory": 1 / theirs["memory_of_lacuna"]}


def peers(bars, options, folder, wanted):
    cases = []
    if "gmsh" in wanted:
        cases += [("disc", 1e6, "gmsh", 40, 0.25), ("plate", 1e6, "gmsh", 40, 0.25)]
    if "block" in wanted:
        cases += [("block", 1e7, "gmsh", 5, 0.2)]
    for case, hexes, peer, times, memory in cases:
        found = against(case, round(hexes * options.scale), peer, options, folder)
        bars.tell(f"{case} of {hexes:.0e}: times faster than Gmsh, whole process", found and found["times"], times, True)
        bars.tell(f"{case} of {hexes:.0e}: share of Gmsh's memory", found and found["memory"], memory, False)
    if "bare" in wanted:
        for case, times in (("block", 1.3), ("along", 1.3), ("disc", 2)):
            found = against(case, round(1e7 * options.scale), "bare", options, folder)
            bars.tell(f"{case} of 1e+07: times the time of the bare loop", found and 1 / found["times"], times, False)


def row(options, **words):
    command = [options.lacuna, str(HERE / "row.lua")] + [f"{key}={value}" for key, value in words.items()]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout) if done.returncode == 0 else None


def median_row(options, seconds, **words):
    rows = [row(options, **words) for _ in range(options.runs)]
    return None if None in rows else sorted(rows, key=seconds)[len(rows) // 2]


def residual(bars, options):
    def seconds(found):
        return sum(found["stage_seconds"].get(stage, 0)
                   for stage in ("layers", "proof of every cell", "shape of the skin"))
    rows = [median_row(options, seconds, shape="twisted", hexes=round(3.5e6 * options.scale), threads=threads)
            for threads in (1, 2)]
    fast = rows[0] and rows[0]["hexes"] / seconds(rows[0]) / 1e6
    bars.tell("twisted 90 degrees, 2e4 source quads: million hexes a second a core", fast, 5, True)
    bars.tell("the same: two threads against one", rows[0] and rows[1] and seconds(rows[0]) / seconds(rows[1]), 1.7, True)


def certificate(bars, options, folder):
    program = pathlib.Path(options.lacuna).parent / "benchmarks/bench_quality_io"
    lines = []
    if program.exists():
        side = max(10, round(200 * math.sqrt(options.scale)))
        done = subprocess.run([program, str(side), "25", folder], stdout=subprocess.PIPE, text=True)
        lines = [json.loads(line) for line in done.stdout.splitlines()]
    def found(name, threads):
        fitting = [line for line in lines if line["name"].startswith(name) and line["threads"] == threads]
        return fitting[0] if fitting else None
    hard = found("quality/measure_hard/", 1)
    cells = hard and int(hard["name"].split("hexes=")[1].split(",")[0])
    bars.tell("certificate, cells that need cutting: million a second a core", hard and cells / hard["median_s"] / 1e6, 8, True)
    one, two = found("quality/measure/", 1), found("quality/measure/", 2)
    bars.tell("certificate: two threads against one", one and two and one["median_s"] / two["median_s"], 1.7, True)


def bare_growth(rows, runs, options, path):
    """Processor seconds of the bare loop that fills and writes as many hexahedra, a layer at a time."""
    points = []
    for row, often in zip(rows, runs):
        across = math.isqrt(row["hexes"] // row["layers"])
        command = [options.bare, str(across), str(round(row["hexes"] / row["layers"] / across)), str(row["layers"]),
                   path, "stream"]
        seconds = []
        for _ in range(often):
            seconds.append(float(subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout.split()[1]))
            os.remove(path)
        points.append((row["hexes"], statistics.median(seconds)))
    return points


def growth(bars, options, folder):
    path = os.path.join(folder, "growth.msh")
    for shape in ("block", "disc"):
        points, last, made, often = [], None, [], []
        for hexes in (1e5, 1e6, 1e7, 1e8):
            size = round(hexes * options.scale)
            runs = options.runs if hexes < 5e7 else 1
            often.append(runs)
            rows = [row(options, shape=shape, hexes=size, stream="true", output=path) for _ in range(runs)]
            if os.path.exists(path):
                os.remove(path)
            if None in rows:
                points = []
                break
            last = sorted(rows, key=lambda r: r["processor_seconds"]["total"])[len(rows) // 2]
            points.append((last["hexes"], last["processor_seconds"]["total"]))
            made.append(last)
            bars.file.write(json.dumps(last) + "\n")
        bars.tell(f"{shape} from 1e+05 to 1e+08: power of the time", power(points) if points else None, 1.05, False)
        if points and pathlib.Path(options.bare).exists():
            bare = bare_growth(made, often, options, path)
            bars.note(f"{shape}: power of the time of the bare loop, written a layer at a time", power(bare))
            bars.note(f"{shape} of 1e+08: times the processor time of that loop", points[-1][1] / bare[-1][1])
        bars.tell(f"{shape} of 1e+08, written at once: memory", last["peak_mib"] * 2**20 / 1e6 if points else None, 300, False, " MB")


def facets(bars, options, folder):
    points, million = [], None
    for count in (87000, 346000, 1000000):
        command = [options.lacuna, str(HERE / "facets.lua"), f"facets={round(count * options.scale)}",
                   f"file={folder}/facets.stl"]
        lines = [json.loads(subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout)
                 for _ in range(options.runs)]
        def seconds(line):
            return sum(line["seconds"][stage] for stage in ("roles", "match", "close"))
        middle = sorted(lines, key=seconds)[len(lines) // 2]
        bars.file.write(json.dumps(middle) + "\n")
        points.append((middle["facets"], max(seconds(middle), 1e-3)))
        million = seconds(middle)
    bars.tell("a million facets: roles, match, close and seal", million, 3, False, " s")
    bars.tell("the same from 87,000 on: power of the time", power(points), 1.1, False)


def copies(bars, options):
    def run(count):
        command = [options.lacuna, str(HERE / "copies.lua"), f"copies={count}", f"hexes={round(1e5 * options.scale)}"]
        lines = [json.loads(subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout)
                 for _ in range(options.runs)]
        return sorted(lines, key=lambda line: line["peak_mib"])[len(lines) // 2]
    one, all_ = run(1), run(100)
    bars.file.write(json.dumps(all_) + "\n")
    allowed = 1.2 * one["peak_mib"] + 24 * all_["nodes"] / 2**20
    bars.tell("100 copies of 1e5: memory against 1.2 of one and 24 bytes a node", all_["peak_mib"] / allowed, 1, False)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lacuna", help="the program")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--scale", type=float, default=1)
    parser.add_argument("--only", default=",".join(GROUPS), help="with commas")
    parser.add_argument("--folder", default=tempfile.gettempdir(), help="where the meshes go")
    parser.add_argument("--bare", help="the program bare_loop; by default in benchmarks/ beside lacuna")
    parser.add_argument("--output")
    options = parser.parse_args()
    options.lacuna = str(pathlib.Path(options.lacuna).resolve())
    options.bare = str(pathlib.Path(options.bare or pathlib.Path(options.lacuna).parent / "benchmarks/bare_loop").resolve())
    wanted = options.only.split(",")
    if unknown := set(wanted) - set(GROUPS):
        parser.error(f"no group is called {', '.join(sorted(unknown))}; there are {', '.join(GROUPS)}")
    head = compare.head_of(options.lacuna, options.runs) | {"scale": options.scale}
    if options.scale != 1:
        print(f"meshes of {options.scale:g} of their size: the figures say nothing of the bars")
    output = pathlib.Path(options.output or HERE / "results" / f"bars_{head['date'].replace(':', '').replace('+0000', 'Z')}.jsonl")
    bars = Bars(output, head)
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        peers(bars, options, folder, wanted)
        if "residual" in wanted:
            residual(bars, options)
        if "certificate" in wanted:
            certificate(bars, options, folder)
        if "growth" in wanted:
            growth(bars, options, folder)
        if "facets" in wanted:
            facets(bars, options, folder)
        if "copies" in wanted:
            copies(bars, options)
    print(f"{bars.missed} bars missed, {bars.unmeasured} not measured; written to {output}")
    return 1 if bars.missed else 3 if bars.unmeasured else 0


if __name__ == "__main__":
    sys.exit(main())
