# SPDX-License-Identifier: MIT
"""test_pages.py PROJECT FOLDER PROGRAM: every block marked `python` of the manual runs as it stands.

A recipe of the cookbook writes the same files as that in Lua before it, byte for byte.
The cells of the notebook run one after the other, and what ends a cell is shown as a page and a picture. With
LACUNA_WHOLE_FAMILIES=1 Jupyter runs the notebook too, where it is installed.
"""
import ast
import contextlib
import io
import json
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
            modules = re.findall(r"^import (\w+)", text, re.M)
            if not all(has(module) for module in modules):
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
    if has("numpy"):
        assert run_notebook(project / "docs" / "first_void.ipynb") == 3
        if os.environ.get("LACUNA_WHOLE_FAMILIES") and has("nbconvert") and has("ipykernel"):
            run_in_jupyter(project / "docs" / "first_void.ipynb", folder / "run.ipynb")
    print(count, "blocks run,", beside, "of them as those in Lua do")
    return 0


def run_notebook(path):
    """@return how many cells showed a page"""
    names, pages = {}, 0
    for cell in json.loads(path.read_text())["cells"]:
        if cell["cell_type"] != "code":
            continue
        lines = ast.parse("".join(cell["source"]))
        last = lines.body.pop()
        with contextlib.redirect_stdout(io.StringIO()):
            exec(compile(lines, str(path), "exec"), names)
            shown = eval(compile(ast.Expression(last.value), str(path), "eval"), names)
        if hasattr(shown, "_repr_html_"):
            assert "<iframe" in shown._repr_html_() and shown._repr_png_().startswith(b"\x89PNG")
            pages += 1
    return pages


def run_in_jupyter(path, made):
    path = shutil.copy(path, made.parent)  # what it writes comes beside it
    subprocess.run([sys.executable, "-m", "nbconvert", "--log-level", "WARN", "--to", "notebook", "--execute",
                    "--output", made, path], check=True)
    outputs = [output for cell in json.loads(made.read_text())["cells"] for output in cell.get("outputs", ())]
    shown = [output for output in outputs if {"text/html", "image/png"} <= output.get("data", {}).keys()]
    assert len(shown) == 3, outputs


def has(module):
    try:
        __import__(module)
    except ImportError:
        return False
    return True


if __name__ == "__main__":
    sys.exit(main())
