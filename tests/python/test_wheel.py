# SPDX-License-Identifier: MIT
"""test_wheel.py PROJECT BUILD FOLDER: a wheel made offline, in a fresh virtual environment, gives hexahedra.

Exit code 77 where pip, setuptools, wheel or venv is not installed.
"""
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import zipfile

FIVE_LINES = """
import lacuna
part = lacuna.load("tube.stl")
void = part.open_volume(source=dict(facing=(0, 0, -1)), target=dict(facing=(0, 0, 1)), walls="auto")
mesh = void.sweep(layers=4, size=0.5)
mesh.write("tube.msh")
"""
CAD = """
import lacuna
print(lacuna.gmsh_version)
part = lacuna.load("box.geo")
print(len(part.faces()), "faces of CAD")
"""


def main():
    project, build, folder = map(pathlib.Path, sys.argv[1:])
    lacking = [name for name in ("pip", "setuptools", "wheel", "venv")
               if importlib.util.find_spec(name) is None]
    if lacking:
        print("left out:", ", ".join(lacking), "not installed")
        return 77
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    environment = {name: value for name, value in os.environ.items()
                   if name not in ("PYTHONPATH", "LACUNA_LIBRARY", "LACUNA_CAD")}
    environment.update(LACUNA_BUILD=str(build), PIP_DISABLE_PIP_VERSION_CHECK="1")

    def run(*command, fails=False, **more):
        done = subprocess.run([str(word) for word in command], cwd=folder, env={**environment, **more},
                              capture_output=True, text=True)
        if (done.returncode != 0) != fails:
            raise SystemExit(f"{command}: exit code {done.returncode}\n{done.stdout}\n{done.stderr}")
        return done.stdout + done.stderr

    before = sorted(project.glob("python/**/*"))
    run(sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--no-index",
        "--wheel-dir", folder, project / "python")
    assert sorted(project.glob("python/**/*")) == before, "something was written beside the sources"
    wheel, = folder.glob("lacuna-*-py3-none-linux_*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    for end in ("lacuna/lib/liblacuna.so", "lacuna/lib/lacuna-cad", "/LICENSE",
                "/LICENSE-GPL-2.0-or-later.txt", "lacuna/_api.pyi", "lacuna/py.typed", "lacuna/bridge.lua"):
        assert any(name.endswith(end) for name in names), end
    print(wheel.name, wheel.stat().st_size / 1e6, "MB")

    run(sys.executable, "-m", "venv", "--without-pip", "fresh")
    python = folder / "fresh" / "bin" / "python"
    run(sys.executable, "-m", "pip", "--python", python, "install", "--no-index", "--no-deps", wheel)
    run(python, "-c", "import lacuna\ntube = lacuna.synthetic.prism(sides=8, drop='target')\n"
        "void = tube.open_volume(source='source', walls='auto')\nvoid.close()\nvoid.write_facets('tube.stl')")
    run(python, "-c", FIVE_LINES)
    assert "certified" in run(python, "-c", "import lacuna; print(lacuna.check('tube.msh'), 'certified')")
    (folder / "box.geo").write_text('SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 3, 2, 1};')
    assert "6 faces of CAD" in run(python, "-c", CAD)

    # Without Gmsh's library: the loader does not find it under another name.
    program = (build / "lacuna-cad").read_bytes()
    assert b"libgmsh.so" in program
    (folder / "lacuna-cad").write_bytes(program.replace(b"libgmsh.so", b"libnone.so"))
    (folder / "lacuna-cad").chmod(0o755)
    lacks = {"LACUNA_CAD": str(folder / "lacuna-cad")}
    run(python, "-c", FIVE_LINES, **lacks)
    said = run(python, "-c", CAD.replace("print(lacuna.gmsh_version)\n", ""), fails=True, **lacks)
    print(said.splitlines()[-1])
    assert "libnone.so" in said and "cad.no_worker" in said, said
    assert run(python, "-c", "import lacuna; print(lacuna.gmsh_version)", **lacks).strip() == "none"
    return 0


if __name__ == "__main__":
    sys.exit(main())
