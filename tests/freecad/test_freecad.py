# SPDX-License-Identifier: MIT
"""test_freecad.py PROJECT [FOLDER]: the workbench in FreeCAD without a window, see in_freecad.py; with FOLDER in
its window, see window.py, which puts pictures there. Exit code 77 where FreeCAD or what shows a window is
missing."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

CONFIGURATION = """<?xml version="1.0" encoding="UTF-8" standalone="no" ?>
<FCParameters><FCParamGroup Name="Root"><FCParamGroup Name="BaseApp"><FCParamGroup Name="Preferences">
<FCParamGroup Name="General"><FCText Name="AutoloadModule">PartWorkbench</FCText>
<FCBool Name="ShowSplasher" Value="0"/></FCParamGroup>
</FCParamGroup></FCParamGroup></FCParamGroup></FCParameters>
"""


def need(programs):
    missing = [program for program in programs if not shutil.which(program)]
    if missing:
        print("left out: not installed:", ", ".join(missing))
        sys.exit(77)


def main():
    project = pathlib.Path(sys.argv[1]).resolve()
    here = project / "tests" / "freecad"
    with_window = len(sys.argv) > 2
    need(["freecad", "ccx", "xvfb-run", "xdotool", "import"] if with_window else ["freecadcmd"])
    with tempfile.TemporaryDirectory() as home:
        # FreeCAD empties PYTHONPATH, so its jobs get what they need from a Python that sets it.
        python = pathlib.Path(home, "python")
        python.write_text(f"#!/bin/sh\nexport PYTHONPATH='{os.environ['PYTHONPATH']}'\n"
                          "exec /usr/bin/python3 \"$@\"\n")
        python.chmod(0o755)
        pathlib.Path(home, "user.cfg").write_text(CONFIGURATION)
        environment = {**os.environ, "FREECAD_USER_HOME": home, "QTWEBENGINE_DISABLE_SANDBOX": "1", "TMPDIR": home}
        subprocess.run([project / "hosts/freecad/install", "--python", python, pathlib.Path(home, "Mod")],
                       check=True)
        if not with_window:
            environment["PYTHONPATH"] = os.path.join(home, "Mod", "Lacuna")
            return subprocess.run(["freecadcmd", here / "in_freecad.py"], env=environment, timeout=300).returncode
        pictures = pathlib.Path(sys.argv[2]).resolve()
        pictures.mkdir(parents=True, exist_ok=True)
        verdict = pathlib.Path(home, "verdict")
        environment.update(LACUNA_PICTURES=str(pictures), LACUNA_VERDICT=str(verdict))
        housing = shutil.copy(project / "docs/tutorial/housing.step", home)
        subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 1280x900x24 -dpi 96", "freecad", housing, here / "window.py"],
                       env=environment, timeout=300, cwd=home)
        print(verdict.read_text() if verdict.exists() else "FreeCAD ended before it was done")
        return 0 if verdict.exists() and verdict.read_text().startswith("passed") else 1


if __name__ == "__main__":
    sys.exit(main())
