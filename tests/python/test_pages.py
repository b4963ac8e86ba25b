# SPDX-License-Identifier: MIT
"""test_pages.py PROJECT FOLDER PROGRAM: every block marked `python` of the manual runs as it stands.

A recipe of the cookbook writes the same files as that in Lua before it, byte for byte.
"""
import contextlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys

import lacuna

PAGES = "docs/python.md", "docs/cookbook.md"


def files_of(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def main():
    project, folder, program = map(pathlib.Path, sys.argv[1:])
    shutil.rmtree(folder, ignore_errors=True)
    count = beside = 0
    for page in PAGES:
        blocks = re.findall(r"^```(\w+)\n(.*?)^```", (project / page).read_text(), re.S | re.M)
        for number, (language, text) in enumerate(blocks):
            if language != "python":
                continue
            modules = set(re.findall(r"^import (\w+)", text, re.M))
            if "meshio" in modules and not has("meshio") or "numpy" in modules and not has("numpy"):
                print("left out:", page, "block", number)
                continue
            work = folder / f"{pathlib.Path(page).stem}_{number}"
            work.mkdir(parents=True)
            os.chdir(work)
            with contextlib.redirect_stdout(io.StringIO()) as printed:
                exec(compile(text, f"{page}, block {number}", "exec"), {"__name__": "__main__"})
            count += 1
            if page != "docs/cookbook.md":
                continue
            language, recipe = blocks[number - 1]
            assert language == "lua", f"{page}: block {number} has none in Lua before it"
            (work / "lua").mkdir()
            subprocess.run([program, "--quiet", "-"], input=recipe, text=True, cwd=work / "lua", check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            by_lua = files_of(work / "lua")
            shutil.rmtree(work / "lua")
            by_python = files_of(work)
            assert by_lua.keys() == by_python.keys(), (page, number, by_lua.keys(), by_python.keys())
            for name in by_lua:
                assert name.endswith(".geo") or by_lua[name] == by_python[name], (page, number, name)
            beside += 1
    assert beside >= 10
    print(count, "blocks run,", beside, "of them as those in Lua do")
    return 0


def has(module):
    try:
        __import__(module)
    except ImportError:
        return False
    return True


if __name__ == "__main__":
    sys.exit(main())
