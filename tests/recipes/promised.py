#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""promised.py LACUNA RECIPES FOLDER: the recipes of the promised language, pasted as they stand, run.

RECIPES is the page that promises it. The part it names, bracket.step, is made here: its faces 12, 31 and 4 to 6 bound a
void of class II, a prism with six sides of which three are walls. Exit code 77: the page or Gmsh is not there.
"""
import math
import pathlib
import re
import subprocess
import sys

ROLES = {12: "source", 31: "target", 4: 0, 5: 1, 6: 2}  # walls by their side


def make_part(path):
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    occ = gmsh.model.occ

    def ring(z):
        return [occ.addPoint(10 * math.cos(k * math.pi / 3), 10 * math.sin(k * math.pi / 3), z) for k in range(6)]

    def joined(a, b):
        return [occ.addLine(p, q) for p, q in zip(a, b)]

    low, high = ring(0), ring(30)
    rim = {0: joined(low, low[1:] + low[:1]), 30: joined(high, high[1:] + high[:1])}
    upright = joined(low, high)
    for tag in range(1, max(ROLES) + 1):
        role = ROLES.get(tag)
        if role is None:  # some other face of the part, apart from the void
            occ.addRectangle(30 + 3 * tag, 0, 0, 2, 2, tag)
        elif role in ("source", "target"):
            occ.addPlaneSurface([occ.addCurveLoop(rim[0 if role == "source" else 30])], tag)
        else:
            sides = [rim[0][role], upright[role + 1], -rim[30][role], -upright[role]]
            occ.addPlaneSurface([occ.addCurveLoop(sides)], tag)
    occ.synchronize()
    gmsh.write(str(path))
    gmsh.finalize()


def main():
    lacuna, page, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    try:
        import gmsh  # noqa: F401
    except ImportError:
        print("left out: Gmsh's Python module is not there")
        return 77
    if not page.exists():
        print("left out:", page, "is not there")
        return 77
    folder.mkdir(parents=True, exist_ok=True)
    make_part(folder / "bracket.step")
    recipes = re.findall(r"^```lua\n(.*?)^```", page.read_text(), re.S | re.M)
    if not recipes:
        return "the page has no recipe"
    for number, recipe in enumerate(recipes):
        (folder / "bracket.lua").write_text(recipe)
        for words in [], ["layers=20"]:
            done = subprocess.run([lacuna, "bracket.lua", *words], cwd=folder, capture_output=True, text=True)
            if done.returncode != 0:
                return "recipe %d %s: %s" % (number + 1, words, done.stderr)
            for printed in re.findall(r"--> (.*)", recipe):
                if printed not in done.stdout.splitlines():
                    return "recipe %d does not print %s: %s" % (number + 1, printed, done.stdout)
            for name in re.findall(r'"(bracket\w*\.\w+)"', recipe):
                if not (folder / name).stat().st_size:
                    return "recipe %d: %s is empty" % (number + 1, name)
            check = subprocess.run([lacuna, "check", "bracket.msh"], cwd=folder, capture_output=True, text=True)
            if check.returncode != 0:
                return check.stderr
    print(len(recipes), "recipes run as they stand")
    return 0


sys.exit(main())
