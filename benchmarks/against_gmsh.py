#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lacuna against Gmsh, in one run on one machine: time, peak memory and quality of the same meshes.

usage: against_gmsh.py LACUNA [--runs 5] [--quads 200] [--layers 25] [--only block|disc] [--recombination 3]

Every mesh is made and written (binary MSH 4.1) by a process of its own, `runs` times, the two programs in turn;
the median counts. Gmsh's time begins after its library is loaded and ends when its file is written; Lacuna's is
that of the whole process ("median_s") and, less the time an empty recipe takes to load and start, from the recipe's first
line to its file ("from_recipe_start_s"): that one is compared. Results go to benchmarks/results/, one file a run.

  block  Gmsh: a transfinite volume.                                          Lacuna: block.lua
  disc   Gmsh: an unstructured recombined disc, extruded in recombined layers. Lacuna: disc.lua

Gmsh recombines the disc by its algorithm 3 (Blossom, full quads), the faster of those that leave no triangle and
give good quads; its default, 1, takes minutes for 40,000 quads. `--recombination 1` measures that.
"""
import argparse
import datetime
import json
import math
import os
import pathlib
import platform
import statistics
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent


def gmsh_block(gmsh, quads, layers):
    made = [(3, gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1))]
    gmsh.model.occ.synchronize()
    for _, line in gmsh.model.getEntities(1):
        low, high = gmsh.model.getBoundingBox(1, line)[2::3]
        gmsh.model.mesh.setTransfiniteCurve(line, (layers if high - low > 0.5 else quads) + 1)
    for _, face in gmsh.model.getEntities(2):
        gmsh.model.mesh.setTransfiniteSurface(face)
        gmsh.model.mesh.setRecombine(2, face)
    gmsh.model.mesh.setTransfiniteVolume(made[0][1])
    return made


def gmsh_disc(gmsh, quads, layers):
    size = math.sqrt(math.pi / quads**2)
    centre = gmsh.model.geo.addPoint(0, 0, 0)
    rim = [gmsh.model.geo.addPoint(x, y, 0, size) for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    arcs = [gmsh.model.geo.addCircleArc(rim[i], centre, rim[(i + 1) % 4]) for i in range(4)]
    disc = gmsh.model.geo.addPlaneSurface([gmsh.model.geo.addCurveLoop(arcs)])
    gmsh.model.geo.mesh.setRecombine(2, disc)
    return gmsh.model.geo.extrude([(2, disc)], 0, 0, 1, numElements=[layers], recombine=True)


def run_gmsh(case, quads, layers, path, recombination):
    """In a process of its own: make, write, print the seconds."""
    import gmsh
    gmsh.initialize([], False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("Mesh.RecombinationAlgorithm", recombination)
    start = time.perf_counter()
    gmsh.model.add(case)
    made = {"block": gmsh_block, "disc": gmsh_disc}[case](gmsh, quads, layers)
    gmsh.model.geo.synchronize()
    gmsh.model.addPhysicalGroup(3, [tag for dimension, tag in made if dimension == 3], 1)
    surfaces = [tag for _, tag in gmsh.model.getEntities(2)]
    gmsh.model.addPhysicalGroup(2, surfaces, 2)
    gmsh.model.mesh.generate(3)
    gmsh.option.setNumber("Mesh.Binary", 1)
    gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
    gmsh.write(path)
    print(time.perf_counter() - start)


def timed(command):
    """Wall seconds, seconds the process printed last, its peak memory in MiB."""
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    printed = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    if os.waitstatus_to_exitcode(status) != 0:
        sys.exit(f"failed: {' '.join(command)}")
    return wall, printed.split(), usage.ru_maxrss / 1024


def print_quality(path):
    """Hexahedra, other cells, smallest and mean scaled Jacobian of a file, read by Gmsh and computed here.

    In a process of its own: memory that this one once held would count as its children's."""
    import gmsh
    import numpy as np
    gmsh.initialize([], False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(path)
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    points = np.zeros((int(max(tags)) + 1, 3))
    points[tags.astype(int)] = xyz.reshape(-1, 3)
    hexes, others = None, 0
    for kind, elements, nodes in zip(*gmsh.model.mesh.getElements(3)):
        if kind == 5:
            hexes = nodes.reshape(-1, 8).astype(int)
        else:
            others += len(elements)
    corners = points[hexes]
    neighbours = ((1, 3, 4), (2, 0, 5), (3, 1, 6), (0, 2, 7), (7, 5, 0), (4, 6, 1), (5, 7, 2), (6, 4, 3))
    least = np.full(len(hexes), 1.0)
    for corner, around in enumerate(neighbours):
        a, b, c = (corners[:, n] - corners[:, corner] for n in around)
        length = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1) * np.linalg.norm(c, axis=1)
        least = np.minimum(least, np.einsum("ij,ij->i", a, np.cross(b, c)) / length)
    gmsh.finalize()
    print(json.dumps({"hexes": len(hexes), "other_cells": others, "min_scaled_jacobian": round(float(least.min()), 4),
                      "mean_scaled_jacobian": round(float(least.mean()), 4)}))


def quality(path):
    command = [sys.executable, __file__, "--quality", path]
    return json.loads(subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()[-1])


def compare(case, options, folder):
    """Both programs in turn, so that what the machine does besides meets both alike."""
    paths = {name: os.path.join(folder, f"{case}_{name}.msh") for name in ("gmsh", "lacuna")}
    quads = options.quads if case == "block" else options.quads**2
    commands = {
        "gmsh": [sys.executable, __file__, "--one", case, "--quads", str(options.quads), "--layers", str(options.layers),
                 "--recombination", str(options.recombination), "--output", paths["gmsh"]],
        "lacuna": [options.lacuna, str(HERE / f"{case}.lua"), f"quads={quads}", f"layers={options.layers}",
                   f"output={paths['lacuna']}"]}
    seconds = {name: [] for name in commands}
    memory = {name: 0 for name in commands}
    for _ in range(options.runs):
        for name, command in commands.items():
            if os.path.exists(paths[name]):
                os.remove(paths[name])
            wall, printed, peak = timed(command)
            seconds[name].append(float(printed[-1]) if name == "gmsh" else wall)
            memory[name] = max(memory[name], peak)
    empty = os.path.join(folder, "empty.lua")
    pathlib.Path(empty).write_text('local lacuna = require "lacuna"\n')
    start = statistics.median(timed([options.lacuna, empty])[0] for _ in range(options.runs))
    result = {}
    for name in commands:
        result[name] = {"median_s": round(statistics.median(seconds[name]), 4), "best_s": round(min(seconds[name]), 4),
                        "peak_mib": round(memory[name]), "file_mib": round(os.path.getsize(paths[name]) / 2**20, 1),
                        **quality(paths[name])}
        result[name]["from_recipe_start_s"] = round(result[name]["median_s"] - (start if name == "lacuna" else 0), 4)
        result[name]["s_per_million_hexes"] = round(result[name]["from_recipe_start_s"] / result[name]["hexes"] * 1e6, 4)
    result["times_faster"] = round(result["gmsh"]["s_per_million_hexes"] / result["lacuna"]["s_per_million_hexes"], 2)
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lacuna", nargs="?", help="the program")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--quads", type=int, default=200, help="along a side of the block; its square on the disc")
    parser.add_argument("--layers", type=int, default=25)
    parser.add_argument("--only", choices=("block", "disc"))
    parser.add_argument("--one", choices=("block", "disc"), help=argparse.SUPPRESS)
    parser.add_argument("--recombination", type=int, choices=range(4), default=3, help="Gmsh's algorithm on the disc")
    parser.add_argument("--quality", help=argparse.SUPPRESS)
    parser.add_argument("--output", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.one:
        return run_gmsh(options.one, options.quads, options.layers, options.output, options.recombination)
    if options.quality:
        return print_quality(options.quality)
    if not options.lacuna:
        parser.error("the lacuna program is missing")
    options.lacuna = str(pathlib.Path(options.lacuna).resolve())

    version = subprocess.run([sys.executable, "-c", "import gmsh; gmsh.initialize([], False); print(gmsh.option.getString("
                              "'General.Version'))"], stdout=subprocess.PIPE, text=True, check=True).stdout.split()[-1]
    results = {"date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
               "gmsh": version, "recombination": options.recombination, "machine": platform.machine(), "cores": os.cpu_count(), "runs": options.runs,
               "cases": {}}
    with tempfile.TemporaryDirectory() as folder:
        for case in [options.only] if options.only else ["block", "disc"]:
            found = compare(case, options, folder)
            results["cases"][case] = found
            for name in ("gmsh", "lacuna"):
                r = found[name]
                print(f"{case:6} {name:7} {r['from_recipe_start_s']:8.3f} s ({r['median_s']:.3f} s the process)  {r['hexes']:8} hexes  {r['peak_mib']:5} MiB  "
                      f"scaled Jacobian {r['min_scaled_jacobian']:.3f} least, {r['mean_scaled_jacobian']:.3f} mean")
            print(f"{case:6} a hexahedron takes Gmsh {found['times_faster']} times as long")
    if len(results["cases"]) == 2:
        block, disc = results["cases"]["block"], results["cases"]["disc"]
        ratio = disc["gmsh"]["s_per_million_hexes"] / block["lacuna"]["s_per_million_hexes"]
        results["lacuna_block_times_faster_than_gmsh_disc"] = round(ratio, 2)
        print(f"Lacuna's block is {ratio:.1f} times as fast as Gmsh's disc, a hexahedron")
    target = HERE / "results"
    target.mkdir(exist_ok=True)
    name = f"against_gmsh_{results['date'].replace(':', '').replace('+0000', 'Z')}.json"
    (target / name).write_text(json.dumps(results, indent=2) + "\n")
    print(f"written to {target / name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
