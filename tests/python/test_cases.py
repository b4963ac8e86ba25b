# SPDX-License-Identifier: MIT
"""test_cases.py PROGRAM DATA: the shared CAD cases write the same bytes through Python as through Lua.

DATA is the folder of cases.json; exit code 77 where it is absent. Runs every eighth case by default, and all
with LACUNA_WHOLE_FAMILIES=1 in the environment. It prints what Python adds to the time of the recipe in Lua: that
of its calls outside the library's. On a busy machine it is larger.
"""
import json
import math
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import lacuna
from lacuna import _library

RECIPE = """local lacuna = require "lacuna"
local part = lacuna.load "{file}"
local void = part:open_volume {{ {roles} }}
void:close()
local mesh = void:sweep {{ layers = 8, size = {size!r} }}
mesh:quality()
mesh:write "{out}"
"""


def size_of(case):
    """As the tool that runs the cases through Lua has it."""
    areas = [case["kept"][str(tag)]["area"] for tag in case["source"]]
    volume = case.get("reference_volume") or case.get("solid_volume")
    if areas:
        return math.sqrt(sum(areas)) / 8
    if volume:
        return abs(volume) ** (1 / 3) / 8
    boxes = [face["bbox"] for face in case["kept"].values()]
    return sorted(max(box[i + 3] for box in boxes) - min(box[i] for box in boxes) for i in range(3))[1] / 10


def seconds():
    """Processor time of this process and of those that have ended."""
    return sum(usage.ru_utime + usage.ru_stime for usage in map(resource.getrusage, (
        resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))


class Library:
    """The library, with the time that its calls take."""

    def __init__(self, library):
        self._library = library
        self.seconds = 0.0

    def __getattr__(self, name):
        return getattr(self._library, name)

    def lacuna_run_string(self, *arguments):
        begin = time.perf_counter()
        try:
            return self._library.lacuna_run_string(*arguments)
        finally:
            self.seconds += time.perf_counter() - begin


def by_lua(program, file, roles, size, out):
    words = ", ".join(f"{role} = {{ {', '.join(map(str, tags))} }}" for role, tags in roles.items())
    recipe = out.with_suffix(".lua")
    recipe.write_text(RECIPE.format(file=file, roles=words, size=size, out=out))
    done = subprocess.run([program, "--quiet", recipe], capture_output=True, text=True)
    return None if done.returncode == 0 else done.stderr.strip().splitlines()[-1]


def by_python(file, roles, size, out):
    try:
        part = lacuna.load(file)
        void = part.open_volume(**roles)
        void.close()
        mesh = void.sweep(layers=8, size=size)
        mesh.quality()
        mesh.write(out)
    except lacuna.Error as error:
        return str(error)
    return None


def main():
    program, data = sys.argv[1], pathlib.Path(sys.argv[2])
    if not (data / "cases.json").exists():
        print("left out:", data, "is not there")
        return 77
    cases = json.loads((data / "cases.json").read_text())["cad"]
    if not os.environ.get("LACUNA_WHOLE_FAMILIES"):
        cases = cases[::8]
    same, wrong, in_lua, added = 0, [], 0.0, 0.0
    library = _library._library = Library(_library._library)
    lacuna.synthetic.prism()  # the interpreter is there
    with tempfile.TemporaryDirectory() as folder:
        for number, case in enumerate(cases):
            name = f"{pathlib.Path(case['file']).stem} {case['case']}"
            roles = {role: case[role] for role in ("source", "target", "walls") if case[role]}
            outs = [pathlib.Path(folder) / f"{way}_{number}.msh" for way in ("lua", "python")]
            taken = [time.perf_counter()]
            failed = by_lua(program, data / case["file"], roles, size_of(case), outs[0])
            taken.append(time.perf_counter())
            library.seconds = 0.0
            raised = by_python(data / case["file"], roles, size_of(case), outs[1])
            taken.append(time.perf_counter())
            in_lua += taken[1] - taken[0]
            added += taken[2] - taken[1] - library.seconds
            if failed is None and raised is None:
                alike = outs[0].read_bytes() == outs[1].read_bytes()
            else:
                alike = failed is not None and raised is not None and failed.endswith(raised)
            same += alike
            print(f"{'ok  ' if alike else 'FAIL'} {name:48} Lua {taken[1] - taken[0]:6.2f} s, "
                  f"Python {taken[2] - taken[1]:6.2f} s{'; ' + raised if raised else ''}", flush=True)
            if not alike:
                wrong.append((name, failed, raised))
    print(f"{same} of {len(cases)} cases are the same; {seconds():.1f} s of processor time; Python adds "
          f"{added / in_lua:.2%} to the time in Lua")
    for case in wrong:
        print(*case, sep="\n  ")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
