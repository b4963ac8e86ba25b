#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lacuna beside its peers, in one run on one machine: time, peak memory and quality of the same meshes.

usage: compare.py LACUNA [--runs 5] [--hexes 1000000] [--only block,disc,plate] [--peers gmsh,cgx,bare] [--bare BARE_LOOP]

Every mesh is made and written by a process of its own, `runs` times, all programs in turn; the median counts. Times
are of whole processes, wall and processor seconds; Lacuna's shapes are those of row.lua. Results go to
benchmarks/results/, one file a run. Peers that are not installed are left out with a word.

  gmsh   block: a transfinite volume; disc, plate: a recombined face extruded in recombined layers. Binary MSH 4.1.
         Algorithm 6 with recombination 3 (Blossom, full quads): its best of quads alone. Algorithm 8 of 4.8.4 ends
         in a segmentation fault on extruded faces; recombination 1, the default, takes minutes for 40,000 quads.
  cgx    CalculiX's own mesher on the block, written as its .inp. No quads without a mapping there.
  bare   a loop that fills and writes as many nodes and hexahedra as Lacuna's mesh has: what no mesher can beat
         (bare_loop beside the program, or --bare).
"""
import argparse
import datetime
import json
import math
import os
import pathlib
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent


CASES = ("block", "disc", "plate")
HEIGHT = {"block": 1.4, "disc": 2.0, "plate": 0.5}
# Centres and radius of the five holes of the plate, four wide: three and two in rows.
HOLES = [(-2 + (h % 3 + 0.5) * 4 / 3, -2 + (h // 3 + 0.5) * 2) for h in range(5)]
HOLE_RADIUS = 1 / 3


def gmsh_block(gmsh, quads, layers):
    side = math.sqrt(2)
    made = [(3, gmsh.model.occ.addBox(0, 0, 0, side, side, HEIGHT["block"]))]
    gmsh.model.occ.synchronize()
    for _, line in gmsh.model.getEntities(1):
        low, high = gmsh.model.getBoundingBox(1, line)[2::3]
        gmsh.model.mesh.setTransfiniteCurve(line, (layers if high - low > 0.5 else round(math.sqrt(quads))) + 1)
    for _, face in gmsh.model.getEntities(2):
        gmsh.model.mesh.setTransfiniteSurface(face)
        gmsh.model.mesh.setRecombine(2, face)
    gmsh.model.mesh.setTransfiniteVolume(made[0][1])
    return made


def circle(gmsh, x, y, radius, size):
    centre = gmsh.model.geo.addPoint(x, y, 0)
    rim = [gmsh.model.geo.addPoint(x + radius * i, y + radius * j, 0, size) for i, j in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    return gmsh.model.geo.addCurveLoop([gmsh.model.geo.addCircleArc(rim[i], centre, rim[(i + 1) % 4]) for i in range(4)])


def extrude(gmsh, case, loops, layers):
    face = gmsh.model.geo.addPlaneSurface(loops)
    gmsh.model.geo.mesh.setRecombine(2, face)
    return gmsh.model.geo.extrude([(2, face)], 0, 0, HEIGHT[case], numElements=[layers], recombine=True)


def gmsh_disc(gmsh, quads, layers):
    return extrude(gmsh, "disc", [circle(gmsh, 0, 0, 1, math.sqrt(math.pi / quads))], layers)


def gmsh_plate(gmsh, quads, layers):
    size = math.sqrt((16 - 5 * math.pi * HOLE_RADIUS**2) / quads)
    corners = [gmsh.model.geo.addPoint(x, y, 0, size) for x, y in ((-2, -2), (2, -2), (2, 2), (-2, 2))]
    outer = gmsh.model.geo.addCurveLoop([gmsh.model.geo.addLine(corners[i], corners[(i + 1) % 4]) for i in range(4)])
    return extrude(gmsh, "plate", [outer] + [circle(gmsh, x, y, HOLE_RADIUS, size) for x, y in HOLES], layers)


def run_gmsh(case, quads, layers, path):
    """In a process of its own: make and write."""
    import gmsh
    gmsh.initialize([], False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("Mesh.Algorithm", 6)
    gmsh.option.setNumber("Mesh.RecombinationAlgorithm", 3)
    gmsh.model.add(case)
    made = {"block": gmsh_block, "disc": gmsh_disc, "plate": gmsh_plate}[case](gmsh, quads, layers)
    gmsh.model.geo.synchronize()
    gmsh.model.addPhysicalGroup(3, [tag for dimension, tag in made if dimension == 3], 1)
    surfaces = [tag for _, tag in gmsh.model.getEntities(2)]
    gmsh.model.addPhysicalGroup(2, surfaces, 2)
    gmsh.model.mesh.generate(3)
    gmsh.option.setNumber("Mesh.Binary", 1)
    gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
    gmsh.write(path)


def cgx_block(quads, layers):
    """A recipe for cgx: a line swept to a face and the face to a body, linear bricks, sent as .inp."""
    across = round(math.sqrt(quads))
    side = math.sqrt(2)
    return (f"SETO all\nPNT p1 0 0 0\nSWEP all a tra {side} 0 0 {across}\nSWEP all b tra 0 {side} 0 {across}\n"
            f"SWEP all c tra 0 0 {HEIGHT['block']} {layers}\nSETC all\nELTY all HE8\nMESH all\nSEND all abq\nQUIT\n")


def timed(command, folder):
    """Wall and processor seconds of a process, its peak memory in MiB and what it printed."""
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, cwd=folder)
    printed = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    if os.waitstatus_to_exitcode(status) != 0:
        sys.exit(f"failed: {' '.join(command)}")
    return wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, printed


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


def python_has(*modules):
    """Whether this Python has modules; a process of its own looks, since what is imported stays in memory."""
    command = [sys.executable, "-c", "import " + ", ".join(modules)]
    return subprocess.run(command, capture_output=True).returncode == 0


def installed(peers, options):
    """The peers of the list that can be run here."""
    found = []
    for peer in peers:
        if peer == "gmsh":
            there = python_has("gmsh", "numpy")
        else:
            there = shutil.which("cgx") if peer == "cgx" else pathlib.Path(options.bare).exists()
        if there:
            found.append(peer)
        else:
            why = f": {sys.executable} needs python3-gmsh and python3-numpy" if peer == "gmsh" else ""
            print(f"{peer} is not here: left out{why}")
    return found


def command_of(peer, case, row, options, folder):
    """The command that makes the peer's mesh of a case, and the file it leaves; None where it cannot."""
    layers, quads = row["layers"], row["hexes"] / row["layers"]
    path = os.path.join(folder, f"{case}_{peer}.msh")
    if peer == "gmsh":
        return [sys.executable, __file__, "--one", case, "--quads", str(quads), "--layers", str(layers),
                "--output", path], path
    if peer == "bare":
        across = math.isqrt(round(quads))
        return [options.bare, str(across), str(max(1, round(quads / across))), str(layers), path], path
    if case != "block":
        return None
    recipe = pathlib.Path(folder, "block.fbd")
    recipe.write_text(cgx_block(quads, layers))
    return ["cgx", "-bg", str(recipe)], os.path.join(folder, "all.msh")


def compare(case, peers, options, folder):
    """All programs in turn, so that what the machine does besides meets them alike."""
    ours = os.path.join(folder, f"{case}_lacuna.msh")
    lacuna = [options.lacuna, str(HERE / "row.lua"), f"shape={case}", f"hexes={options.hexes}", f"output={ours}"]
    row = json.loads(timed(lacuna, folder)[3])
    jobs = {"lacuna": (lacuna, ours)}
    for peer in peers:
        job = command_of(peer, case, row, options, folder)
        if job:
            jobs[peer] = job
    runs = {name: [] for name in jobs}
    for _ in range(options.runs):
        for name, (command, path) in jobs.items():
            if os.path.exists(path):
                os.remove(path)
            runs[name].append(timed(command, folder)[:3])
    result, reads = {}, python_has("gmsh", "numpy")
    for name, (_, path) in jobs.items():
        wall, processor, peak = (statistics.median(column) for column in zip(*runs[name]))
        result[name] = {"wall_s": round(wall, 4), "processor_s": round(processor, 4), "peak_mib": round(peak, 1),
                        "file_mib": round(os.path.getsize(path) / 2**20, 1)}
        # Gmsh reads what cgx and the loop write, too, but there is nothing to learn from it. Without Gmsh the
        # row tells of Lacuna's mesh.
        if name == "gmsh" or (name == "lacuna" and reads):
            result[name] |= quality(path)
        else:
            result[name] |= {"hexes": row["hexes"]}
        os.remove(path)
    for name, found in result.items():
        ratio = row["hexes"] / found["hexes"]  # a hexahedron against a hexahedron
        found["times_lacuna"] = {key: round(found[f"{key}_s"] * ratio / result["lacuna"][f"{key}_s"], 3)
                                 for key in ("wall", "processor")}
        found["memory_of_lacuna"] = round(found["peak_mib"] * ratio / result["lacuna"]["peak_mib"], 3)
    return result


def commit_here():
    """The commit that lies here; empty where git is not installed or this is no clone."""
    if not shutil.which("git"):
        return ""
    told = subprocess.run(["git", "-C", str(HERE), "rev-parse", "--short", "HEAD"], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True)
    return told.stdout.strip()


def head_of(lacuna, runs):
    """What was measured, when and on what."""
    version = subprocess.run([lacuna, "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()
    return {"date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"), "lacuna": version,
            "commit": commit_here(), "machine": platform.machine(), "cores": os.cpu_count(), "runs": runs,
            "load": round(os.getloadavg()[0], 1)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lacuna", nargs="?", help="the program")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--hexes", type=int, default=1000000)
    parser.add_argument("--only", default=",".join(CASES), help="cases, with commas")
    parser.add_argument("--peers", default="gmsh,cgx,bare", help="with commas")
    parser.add_argument("--bare", help="the program bare_loop; by default in benchmarks/ beside lacuna")
    parser.add_argument("--one", choices=CASES, help=argparse.SUPPRESS)
    parser.add_argument("--quads", type=float, help=argparse.SUPPRESS)
    parser.add_argument("--layers", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--quality", help=argparse.SUPPRESS)
    parser.add_argument("--output", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.one:
        return run_gmsh(options.one, options.quads, options.layers, options.output)
    if options.quality:
        return print_quality(options.quality)
    if not options.lacuna:
        parser.error("the lacuna program is missing")
    options.lacuna = str(pathlib.Path(options.lacuna).resolve())
    options.bare = str(pathlib.Path(options.bare or pathlib.Path(options.lacuna).parent / "benchmarks/bare_loop").resolve())

    peers = installed(options.peers.split(","), options)
    results = head_of(options.lacuna, options.runs) | {"cases": {}}
    with tempfile.TemporaryDirectory() as folder:
        for case in options.only.split(","):
            found = compare(case, peers, options, folder)
            results["cases"][case] = found
            for name, r in found.items():
                print(f"{case:6} {name:7} {r['wall_s']:9.3f} s wall, {r['processor_s']:9.3f} s processor, {r['peak_mib']:7.0f} MiB, "
                      f"{r['hexes']:9} hexes: {r['times_lacuna']['processor']:7.2f} x the time of Lacuna, "
                      f"{r['memory_of_lacuna']:5.2f} x its memory"
                      + (f"; scaled Jacobian {r['min_scaled_jacobian']:.3f} least, {r['mean_scaled_jacobian']:.3f} mean"
                         if "min_scaled_jacobian" in r else ""))
    target = HERE / "results"
    target.mkdir(exist_ok=True)
    name = f"compare_{results['date'].replace(':', '').replace('+0000', 'Z')}.json"
    (target / name).write_text(json.dumps(results, indent=2) + "\n")
    print(f"written to {target / name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
