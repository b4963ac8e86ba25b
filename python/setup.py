# SPDX-License-Identifier: MIT
"""A wheel of the package with the library and the program lacuna-cad of a build: that in build/release, or in
the folder that LACUNA_BUILD names. Nothing is compiled here, and one wheel serves every Python from 3.9."""
import atexit
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel  # from setuptools 70.1 on
except ImportError:
    from wheel.bdist_wheel import bdist_wheel

PROJECT = pathlib.Path(__file__).resolve().parent.parent
BUILD = pathlib.Path(os.environ.get("LACUNA_BUILD", PROJECT / "build" / "release"))


class BuildWithLibrary(build_py):
    def run(self):
        super().run()
        library = BUILD / "liblacuna.so"
        if not library.exists():
            raise SystemExit(f"{library} is not there; build it first (cmake --preset release && cmake "
                             "--build --preset release), or name the folder of a build in LACUNA_BUILD")
        parts = {library.resolve(): "liblacuna.so"}
        if (BUILD / "lacuna-cad").exists():
            parts[BUILD / "lacuna-cad"] = "lacuna-cad"
        needed = subprocess.run(["ldd", library], capture_output=True, text=True, check=True).stdout
        lua = re.search(r"(liblua\S+) => (\S+)", needed)
        if lua:
            parts[pathlib.Path(lua[2]).resolve()] = lua[1]
        folder = pathlib.Path(self.build_lib) / "lacuna" / "lib"
        folder.mkdir(parents=True, exist_ok=True)
        for source, name in parts.items():
            shutil.copy(source, folder / name)
            if shutil.which("strip"):
                subprocess.run(["strip", "--strip-unneeded", folder / name], check=True)


class Binary(Distribution):
    def has_ext_modules(self):  # it is not for every machine
        return True


class WheelOfAnyPython(bdist_wheel):
    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


work = tempfile.mkdtemp()  # nothing is written beside the sources
atexit.register(shutil.rmtree, work, ignore_errors=True)
setup(distclass=Binary, cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": WheelOfAnyPython},
      options={"build": {"build_base": work}, "egg_info": {"egg_base": work}})
