# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Builds library and program of the wheel with the CMake of the whole tree, and no other target."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

ROOT = pathlib.Path(__file__).resolve().parents[2]
#: Git ignores it.
BUILD = ROOT / "build" / "wheel"


def version():
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"^project\(mwmesh VERSION ([0-9.]+)", text, re.MULTILINE).group(1)


class CMakeBuild(build_py):
    def run(self):
        super().run()
        options = {
            "Python3_EXECUTABLE": sys.executable,
            "MW_BUILD_TESTS": "OFF",
            "MW_BUILD_BENCH": "OFF",
            "MW_WITH_TETGEN": "OFF",
        }
        subprocess.run(["cmake", "--preset", "release", "-B", BUILD,
                        *(f"-D{name}={value}" for name, value in options.items())],
                       cwd=ROOT, check=True)
        subprocess.run(["cmake", "--build", BUILD, "--target", "mwmesh", "mwmesh_python",
                        "--parallel", os.environ.get("JOBS", "2")], check=True)
        package = pathlib.Path(self.build_lib) / "mwmesh"
        made = BUILD / "python" / "mwmesh"
        (package / "bin").mkdir(exist_ok=True)
        for file in (made / "_version.py", made / "__init__.pyi", ROOT / "LICENSE", ROOT / "engine/install/THIRD_PARTY.md"):
            shutil.copy2(file, package)
        for file, place in ((made / "libmwmesh.so", package / "libmwmesh.so"),
                            (BUILD / "mwmesh", package / "bin" / "mwmesh")):
            subprocess.run(["strip", "--strip-unneeded", "-o", place, file], check=True)


class AnyPython(bdist_wheel):
    """A wheel of one platform, for every Python 3."""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


class WithLibrary(Distribution):
    def has_ext_modules(self):
        return True


BUILD.mkdir(parents=True, exist_ok=True)
setup(
    version=version(),
    distclass=WithLibrary,
    cmdclass={"build_py": CMakeBuild, "bdist_wheel": AnyPython},
    options={
        "build": {"build_base": str(BUILD / "setuptools")},
        "egg_info": {"egg_base": str(BUILD)},
    },
)
