#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Quads over plane outlines, a saddle and source faces of real cases: Lacuna's against Gmsh's, in one run, by
one measure.

usage: against_gmsh.py BENCH_PAVE [--data DIR] [--sizes 40,120,...] [--only disc,L] [--runs 3] [--pictures]
       against_gmsh.py BENCH_PAVE --held 40 [--seed 1]
       against_gmsh.py BENCH_PAVE --data DIR --whole

Each mesh is made in a process of its own (bench_pave beside this), the meshers in turn. Times are processor
seconds of the surface mesh alone, the best of the runs; one thread.

Ours twice: "source" goes the way of a user's source face, which chooses the numbers of sides on the edges;
"lacuna" is the paver on the outline with as many sides as Gmsh gets. Gmsh's three: gmsh-8-3 is
Mesh.Algorithm 8 with RecombinationAlgorithm 3, gmsh-6-3 is 6 with 3, gmsh-6-s is 6 with SubdivisionAlgorithm
1. With --data, plane source faces of the CAD files there are added, and the source faces of all real cases of
its cases.json: those in a plane beside Gmsh's, the others by themselves. The saddle is a B-spline surface:
laid flat, paved and lifted in our time, measured in space, drawn in plan. With --held, members of a family of
outlines that nothing was chosen on, and a summary. --whole is all of it in one table: every outline at all
sizes, the real cases, 30 of the held family, pictures; from 3,000 quads on each mesh is made once.

Bar by bar the report counts the pairs of an outline and a size that meet it, and names those that miss it.

The least number of irregular nodes is what the sum rule allows: over interior nodes the sum of 4 - quads, and
over boundary nodes that of 2 - quads, are 4 times the Euler number, and boundary nodes have the quads that
right angles fit in. Nodes of a symmetric outline are mapped by its symmetries: the error is their distance to
the nearest node over the size asked, at most.

The table goes to benchmarks/results/ as Markdown and JSON, after Ctrl-C what there is of it; pictures at 120
and 400 beside it (PNG, irregular points dotted: 3 quads blue, 5 red, others green; the redder a quad the
poorer).
"""
import argparse
import contextlib
import datetime
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
DOMAINS = ["disc", "plate", "gear", "L", "comb", "aerofoil", "saddle",
           "ring", "eccentric ring", "rounded rectangle", "slot", "U", "T", "cross", "flange"]
SIZES = "40,120,400,1000,3000,20000,100000"
PICTURED = (120, 400)
HELD = 30
LARGE = 3000  # one run is enough from here on
FACES = {"shaft end": "cad/Welle_stepped_shaft.step:10", "disc, 4 holes": "cad/holycyl.stp:11", "rod end": "cad/7pin.step:2",
         "sleeve end": "cad/7pin.step:45", "half ring": "cad/tuyau_bent_pipe.brep:3"}
OURS = ["source", "lacuna"]
GMSH = ["gmsh-8-3", "gmsh-6-3", "gmsh-6-s"]


def measure_once(bench, domain, quads, mesher, picture=None):
    """What bench_pave says of one mesh, or why there is none."""
    command = [bench, domain, str(quads), mesher] + ([picture] if picture else [])
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0 or not done.stdout:
        return {"mesher": mesher, "failed": done.stderr.strip().splitlines()[-1:] or ["crashed"]}
    found = json.loads(done.stdout.splitlines()[-1])
    share = found["irregular_share"]
    found["interior"] = round(found["irregular"] / share) if share else found["quads"]
    found["quads_per_second"] = round(found["quads"] / max(found["seconds"], 1e-6))
    found.pop("domain")
    return found


def best_of(runs):
    """The fastest of runs that are alike otherwise."""
    return min(runs, key=lambda r: r.get("seconds", math.inf))


def measure_in_turn(bench, domain, quads, meshers, runs, picture_of=lambda m: None):
    """The same of several meshers, each run of all of them before the next."""
    found = {m: [] for m in meshers}
    for _ in range(runs):
        for m in meshers:
            found[m].append(measure_once(bench, domain, quads, m, picture_of(m)))
    return {m: best_of(found[m]) for m in meshers}


def allowed_irregular(ours, theirs, asked):
    """The bar: near the least below 1,000 quads; above, half of Gmsh's best, if topology allows so few."""
    near = 1.5 * ours["least_irregular"] + 4
    if asked < 1000 or not theirs:
        return near
    return max(near, min(r["irregular"] * ours["interior"] / max(1, r["interior"]) for r in theirs) / 2)


def judge(ours, theirs, asked):
    """Bar by bar: True where it is met. Rows and sizes count from 120 quads, speed at 100,000."""
    theirs = [r for r in theirs if "failed" not in r]
    bars = {"valid": ours["fault"] == "" and ours["triangles"] == 0}
    if asked >= 120:
        bars["row"] = ours["row_share"] >= 0.95
        # Sharp and blunt corners leave no quad a right one: how it stands beside what they allow.
        bars["row of possible"] = ours["row_share"] >= 0.95 * ours["possible_row_share"]
        bars["size"] = ours["size_share"] >= 0.95
    if ours["mesher"] == "source":
        bars["count"] = 0.75 * asked <= ours["quads"] <= 1.25 * asked
    if "off_surface" in ours:
        bars["on surface"] = ours["off_surface"] <= 1e-6  # the saddle is two across
    if asked < 1000:
        bars["min 0.6"] = ours["min_scaled_jacobian"] >= 0.6
    if ours.get("symmetries", 0) > 0:
        bars["symmetric"] = ours["symmetry_error"] <= 1e-6
    bars["irregular"] = ours["irregular"] <= allowed_irregular(ours, theirs, asked)
    if theirs:
        # Meshes that are perfect but for rounding are as good as each other.
        for bar, name in (("min", "min_scaled_jacobian"), ("mean", "mean_scaled_jacobian")):
            bars[bar] = ours[name] >= max(r[name] for r in theirs) - 5e-4
        if asked < 1000:
            bars["seconds"] = ours["seconds"] <= 2 * min(r["seconds"] for r in theirs)
        if asked >= 100000:
            quality = [r for r in theirs if r["mesher"] == "gmsh-8-3"]
            if quality:
                bars["10 x 8-3"] = ours["quads_per_second"] >= 10 * quality[0]["quads_per_second"]
            bars["fastest"] = ours["quads_per_second"] >= max(r["quads_per_second"] for r in theirs)
    if asked >= 100000:
        bars["150,000/s"] = ours["quads_per_second"] >= 150000
    return bars


HEAD = ["| domain | asked | mesher | quads | min | mean | irregular (least) | row | size | symmetry | seconds | quads/s |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|"]


def row(name, asked, r):
    if "failed" in r:
        return f"| {name} | {asked} | {r['mesher']} | failed: {r['failed'][0][:60]} | | | | | | | | |"
    symmetry = f"{r['symmetry_error']:.1g}" if "symmetry_error" in r else ""
    left = f" + {r['triangles']} triangles" if r["triangles"] else ""
    return (f"| {name} | {asked} | {r['mesher']} | {r['quads']}{left} | {r['min_scaled_jacobian']:.3f} | "
            f"{r['mean_scaled_jacobian']:.4f} | {r['irregular']} ({r['least_irregular']:.0f}) | "
            f"{100 * r['row_share']:.1f} % | {100 * r['size_share']:.1f} % | {symmetry} | "
            f"{r['seconds']:.4f} | {r['quads_per_second']} |")


def read(path):
    words = pathlib.Path(path).read_text().split()
    points, quads = int(words[0]), int(words[1])
    values = list(map(float, words[2:2 + 2 * points]))
    numbers = list(map(int, words[2 + 2 * points:2 + 2 * points + 4 * quads]))
    return (list(zip(values[0::2], values[1::2])), [numbers[4 * i:4 * i + 4] for i in range(quads)])


def draw(path, title, width=1000):
    from PIL import Image, ImageDraw
    points, quads = read(path)
    low = [min(p[k] for p in points) for k in (0, 1)]
    high = [max(p[k] for p in points) for k in (0, 1)]
    scale = (width - 20) / max(high[0] - low[0], high[1] - low[1])
    image = Image.new("RGB", (int((high[0] - low[0]) * scale) + 20, int((high[1] - low[1]) * scale) + 40), "white")
    pen = ImageDraw.Draw(image)
    pen.text((10, 4), title, fill="black")
    place = [(10 + (x - low[0]) * scale, 28 + (high[1] - y) * scale) for x, y in points]
    valence = [0] * len(points)
    sides = {}
    for quad in quads:
        least = 1.0
        for k in range(4):
            here, after, before = quad[k], quad[(k + 1) % 4], quad[k - 1]
            valence[here] += 1
            side = (min(here, after), max(here, after))
            sides[side] = sides.get(side, 0) + 1
            u = [points[after][i] - points[here][i] for i in (0, 1)]
            v = [points[before][i] - points[here][i] for i in (0, 1)]
            length = math.hypot(*u) * math.hypot(*v)
            least = min(least, (u[0] * v[1] - u[1] * v[0]) / length if length > 0 else 0)
        good = max(0.0, min(1.0, (least - 0.5) / 0.5))
        pen.polygon([place[p] for p in quad], fill=(255, int(110 + 145 * good), int(110 + 145 * good)), outline=(110, 110, 110))
    rim = {p for side, count in sides.items() if count == 1 for p in side}
    for p, (x, y) in enumerate(place):
        if p in rim or valence[p] in (0, 4):
            continue
        pen.ellipse([x - 3, y - 3, x + 3, y + 3], fill={3: (0, 0, 255), 5: (220, 0, 0)}.get(valence[p], (0, 140, 0)))
    return image


def montage(images, path):
    from PIL import Image
    whole = Image.new("RGB", (sum(i.width for i in images), max(i.height for i in images)), "white")
    at = 0
    for image in images:
        whole.paste(image, (at, 0))
        at += image.width
    # As few colours as show all shades: a third of the bytes.
    whole.quantize(colors=64).save(path, optimize=True)


def growth(results, name):
    """Exponent of the time over the quads, from the smallest mesh of more than 10,000 quads to the largest."""
    ours = [r["lacuna"] for r in results if r["domain"] == name and "lacuna" in r]
    ours = [r for r in ours if "failed" not in r and r["quads"] > 10000]
    if len(ours) < 2:
        return None
    return math.log(ours[-1]["seconds"] / ours[0]["seconds"]) / math.log(ours[-1]["quads"] / ours[0]["quads"])


def real_cases(data):
    """The source faces of the real cases: what bench_pave calls them, and their plane CAD faces for Gmsh."""
    cases = {}
    for case in json.loads((pathlib.Path(data) / "cases.json").read_text())["cad"]:
        if case.get("refuse"):
            continue
        file = str(pathlib.Path(data) / case["file"])
        tags = ["|".join(",".join(map(str, case[role])) for role in ("source", "target", "walls"))]
        plane = [f"{file}:{t}" for t in case["source"] if case["kept"][str(t)]["type"] == "Plane"]
        name = f"{pathlib.Path(file).stem} {case['case']}"
        cases[name] = ("case:" + "|".join([file] + tags), plane if len(plane) == len(case["source"]) else [])
    return cases


def add_up(parts):
    """Gmsh's meshes of several faces as one."""
    failed = [p for p in parts if "failed" in p]
    if failed or len(parts) == 1:
        return (failed or parts)[0]
    whole = dict(parts[0])
    for name in ("quads", "triangles", "seconds", "irregular", "least_irregular", "interior"):
        whole[name] = sum(p[name] for p in parts)
    whole["min_scaled_jacobian"] = min(p["min_scaled_jacobian"] for p in parts)
    for name in ("mean_scaled_jacobian", "row_share", "size_share"):
        whole[name] = sum(p[name] * p["quads"] for p in parts) / max(1, whole["quads"])
    whole["quads_per_second"] = round(whole["quads"] / max(whole["seconds"], 1e-6))
    return whole


class Report:
    """Lines of the tables and what they are of."""

    def __init__(self):
        self.rows, self.bars, self.results = [], [], []

    def add(self, name, asked, found, ours=OURS):
        theirs = [r for m, r in found.items() if m in GMSH]
        bars = {}
        for mesher, r in found.items():
            self.rows.append(row(name, asked, r))
            print(self.rows[-1], flush=True)
        for mesher in ours:
            if mesher not in found:
                continue
            r = found[mesher]
            bars[mesher] = {"mesh": False} if "failed" in r else judge(r, theirs, asked)
            missed = [bar for bar, met in bars[mesher].items() if not met]
            self.bars.append(f"| {name} | {asked} | {mesher} | {sum(bars[mesher].values())} of "
                             f"{len(bars[mesher])} | {', '.join(missed) or '-'} |")
            print(self.bars[-1], flush=True)
        self.results.append({"domain": name, "asked": asked, **found, "bars": bars})

    def summary(self):
        """How often each bar is met, by our way in and by size."""
        counts = {}
        for result in self.results:
            for mesher, bars in result["bars"].items():
                for bar, met in bars.items():
                    all_sizes = counts.setdefault((mesher, bar), {})
                    sums = all_sizes.setdefault(result["asked"], [0, 0])
                    sums[0] += met
                    sums[1] += 1
        sizes = sorted({r["asked"] for r in self.results})
        lines = ["| mesher | bar | " + " | ".join(map(str, sizes)) + " | all |",
                 "|---|---|" + "---|" * (len(sizes) + 1)]
        for (mesher, bar), by_size in counts.items():
            cells = [f"{by_size[s][0]} of {by_size[s][1]}" if s in by_size else "" for s in sizes]
            cells.append(f"{sum(c[0] for c in by_size.values())} of {sum(c[1] for c in by_size.values())}")
            lines.append(f"| {mesher} | {bar} | " + " | ".join(cells) + " |")
        return lines

    def misses(self):
        """The pairs of an outline and a size that miss a bar, by our way in and bar."""
        missed = {}
        for result in self.results:
            for mesher, bars in result["bars"].items():
                for bar, met in bars.items():
                    if not met:
                        missed.setdefault((mesher, bar), {}).setdefault(result["domain"], []).append(result["asked"])
        return [f"- {mesher}, {bar}: " + "; ".join(f"{name} at {', '.join(map(str, sizes))}"
                                                   for name, sizes in by_name.items())
                for (mesher, bar), by_name in missed.items()]


def held_summary(results):
    """Means and worst figures over the held family, by mesher and size."""
    lines = ["| asked | mesher | outlines | quads | irregular | least | least of min | mean of min | mean | "
             "row | size | seconds |", "|---|---|---|---|---|---|---|---|---|---|---|---|"]
    for asked in sorted({r["asked"] for r in results}):
        for mesher in OURS + GMSH:
            of = [r[mesher] for r in results if r["asked"] == asked and "failed" not in r.get(mesher, {"failed": 1})]
            if not of:
                continue
            mean = {k: sum(r[k] for r in of) / len(of) for k in ("quads", "irregular", "least_irregular", "seconds",
                    "min_scaled_jacobian", "mean_scaled_jacobian", "row_share", "size_share")}
            lines.append(f"| {asked} | {mesher} | {len(of)} | {mean['quads']:.0f} | {mean['irregular']:.2f} | "
                         f"{mean['least_irregular']:.2f} | {min(r['min_scaled_jacobian'] for r in of):.3f} | "
                         f"{mean['min_scaled_jacobian']:.4f} | {mean['mean_scaled_jacobian']:.4f} | "
                         f"{100 * mean['row_share']:.1f} % | {100 * mean['size_share']:.1f} % | {mean['seconds']:.4f} |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bench", help="the program bench_pave")
    parser.add_argument("--data", help="folder with the CAD files of the real cases")
    parser.add_argument("--sizes", default=SIZES)
    parser.add_argument("--case-sizes", default="120,400", help="of the real cases' source faces")
    parser.add_argument("--only", help="names of domains, with commas; cases: all real cases")
    parser.add_argument("--meshers", default=",".join(OURS + GMSH))
    parser.add_argument("--runs", type=int, default=1)
    parser.add_argument("--held", type=int, default=0, help="members of the held family, at 120 and 400 quads")
    parser.add_argument("--seed", type=int, default=1, help="of the held family")
    parser.add_argument("--whole", action="store_true", help="the outlines, cases and 30 of the held family")
    parser.add_argument("--pictures", action="store_true", help="at 120 and 400 quads, else of the smallest size")
    parser.add_argument("--output", default=str(HERE.parent / "results"))
    options = parser.parse_args()
    bench = str(pathlib.Path(options.bench).resolve())
    # The CAD process is where it was built.
    worker = pathlib.Path(bench).parent.parent / "lacuna-cad"
    if worker.exists():
        os.environ.setdefault("LACUNA_CAD", str(worker))
    names = {name: name for name in DOMAINS}
    cases = {}
    if options.data:
        for name, face in FACES.items():
            if (pathlib.Path(options.data) / face.rsplit(":", 1)[0]).exists():
                names[name] = str(pathlib.Path(options.data) / face)
        cases = real_cases(options.data)
    if options.only:
        wanted = options.only.split(",")
        cases = cases if "cases" in wanted else {}
        names = {name: names[name] for name in wanted if name != "cases"}
    sizes = [int(s) for s in options.sizes.split(",")]
    meshers = options.meshers.split(",")
    if options.whole:
        options.held, options.pictures = options.held or HELD, True
    held = {f"held {options.seed}:{i}": f"held:{options.seed}:{i}" for i in range(options.held)}
    if options.held and not options.whole:
        names, cases = {}, {}
    outlines = [(name, domain, quads) for name, domain in names.items() for quads in sizes]
    outlines += [(name, domain, quads) for name, domain in held.items() for quads in (120, 400)]
    date = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H%M%SZ")
    folder = pathlib.Path(options.output)
    folder.mkdir(exist_ok=True)
    report = Report()
    pictured_sizes = [s for s in sizes if s in PICTURED] or sizes[:1]
    measured = contextlib.suppress(KeyboardInterrupt)  # then the report has what there is
    with measured, tempfile.TemporaryDirectory() as scratch:
        for name, domain, quads in outlines:
            pictured = options.pictures and name in names and quads in pictured_sizes
            own = [m for m in meshers if not (name == "saddle" and m == "source")]
            found = measure_in_turn(bench, domain, quads, own, options.runs if quads < LARGE else 1,
                                    lambda m: f"{scratch}/{m}.txt" if pictured else None)
            report.add(name, quads, found)
            if not pictured:
                continue
            images = [draw(f"{scratch}/{m}.txt",
                           f"{name}, {m}: {found[m]['quads']} quads, scaled Jacobian "
                           f"{found[m]['min_scaled_jacobian']:.3f} least, "
                           f"{found[m]['mean_scaled_jacobian']:.4f} mean, {found[m]['irregular']} irregular")
                      for m in ("source", "lacuna", "gmsh-8-3") if "failed" not in found.get(m, {"failed": 1})]
            if images:
                plain = name.replace(" ", "_").replace(",", "").replace(":", "_")
                montage(images, folder / f"pave_{plain}_{quads}.png")
        for name, (spec, faces) in cases.items():
            for quads in map(int, options.case_sizes.split(",")):
                found = {"source": measure_in_turn(bench, spec, quads, ["source"], options.runs)["source"]}
                parts = [measure_in_turn(bench, face, quads / len(faces), GMSH, options.runs) for face in faces]
                for mesher in GMSH if faces else []:
                    found[mesher] = add_up([part[mesher] for part in parts])
                report.add(name, quads, found)
    if options.held and not options.whole:
        stem, title = f"pave_held_{date}", f"# A held family of outlines, seed {options.seed}, {date}"
    else:
        stem, title = f"pave_{date}", f"# Quads over plane outlines, a saddle and real source faces, {date}"
    text = [title, "",
            "Ours and Gmsh's, measured alike; one thread, processor time of the surface mesh.",
            f"Best of {options.runs} runs. What each bar is: benchmarks/pave/against_gmsh.py.", "",
            *report.summary(), "", "What misses a bar:", "", *report.misses(), ""]
    of_held = [r for r in report.results if r["domain"] in held]
    if of_held:
        text += ["The held family:", "", *held_summary(of_held), ""]
    text += ["| domain | asked | mesher | bars met | missed |", "|---|---|---|---|---|", *report.bars, ""]
    exponents = {name: growth(report.results, name) for name in names}
    for name, exponent in exponents.items():
        if exponent is not None:
            text.append(f"- time of {name} grows with the quads to the power {exponent:.2f} "
                        f"({'met' if exponent <= 1.1 else 'missed'}: 1.1)")
    for r in report.results:
        off = [f"{m} {r[m]['off_surface']:.1g}" for m in meshers if "off_surface" in r.get(m, {})]
        if off:
            text.append(f"- {r['domain']}, {r['asked']}: farthest inner node off the exact surface: {', '.join(off)}")
    text += ["", *HEAD, *report.rows, ""]
    (folder / f"{stem}.md").write_text("\n".join(text))
    (folder / f"{stem}.json").write_text(
        json.dumps({"date": date, "growth": exponents, "results": report.results}, indent=1) + "\n")
    print("\n".join(report.summary() + report.misses() + (held_summary(of_held) if of_held else [])))
    print(f"written to {folder}/{stem}.md")


if __name__ == "__main__":
    sys.exit(main())
