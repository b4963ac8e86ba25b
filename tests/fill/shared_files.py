#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Real CAD files filled by recipes and by fill(): the same meshes. One case of each file, or every sixth
body; all with LACUNA_WHOLE_FAMILIES.

usage: shared_files.py FILL_PARITY DATA cases|auto|bodies
"""
import json, math, os, pathlib, subprocess, sys

program, data, what = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
index = data / ("bodies/bodies.json" if what == "bodies" else "cases.json")
if not index.exists():
    print(f"skipped: there is no {index}")
    sys.exit(77)


def tags(values):
    return ",".join(map(str, values))


def words_of(case):
    """As the runner of these cases asks for them."""
    kept = case["kept"]
    source = [kept[str(tag)]["area"] for tag in case["source"]]
    volume = case.get("reference_volume") or case.get("solid_volume")
    if source:
        size = math.sqrt(sum(source)) / 8
    elif volume:
        size = abs(volume) ** (1 / 3) / 8
    else:
        boxes = [kept[key]["bbox"] for key in kept]
        size = sorted(max(b[i + 3] for b in boxes) - min(b[i] for b in boxes) for i in range(3))[1] / 10
    words = ["layers=8", f"size={size:.6g}"]
    if what == "auto":
        return words + ["faces=" + tags(sorted(map(int, kept)))]
    return words + [f"{role}={tags(case[role])}" for role in ("source", "target", "walls") if case[role]]


if what == "bodies":
    jobs = [(data / "bodies" / pathlib.Path(body["file"]).name, []) for body in json.load(open(index))]
else:
    jobs = [(data / case["file"], words_of(case)) for case in json.load(open(index))["cad"]]
if not os.environ.get("LACUNA_WHOLE_FAMILIES"):
    jobs = jobs[::6] if what == "bodies" else list({path: (path, words) for path, words in jobs}.values())
wrong = 0
for path, words in jobs:
    done = subprocess.run([program, str(path), *words], capture_output=True, text=True)
    wrong += done.returncode != 0
    print(path.name, *words[2:], done.stdout.strip(), done.stderr.strip().splitlines()[-1:], flush=True)
print(f"{len(jobs) - wrong} of {len(jobs)} alike")
sys.exit(wrong != 0)
