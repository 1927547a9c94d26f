# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Builds the wheel's extension with the CMake of the whole tree, which makes only that target."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parents[2]
#: Git ignores it.
BUILD = ROOT / "build" / "wheel"


def version():
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"^project\(mwmesh VERSION ([0-9.]+)", text, re.MULTILINE).group(1)


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        options = {
            "Python3_EXECUTABLE": sys.executable,
            "MW_BUILD_TESTS": "OFF",
            "MW_BUILD_BENCH": "OFF",
            "MW_WITH_TETGEN": "OFF",
        }
        subprocess.run(["cmake", "--preset", "release", "-B", BUILD,
                        *(f"-D{name}={value}" for name, value in options.items())],
                       cwd=ROOT, check=True)
        jobs = str(self.parallel or os.environ.get("JOBS", 2))
        subprocess.run(["cmake", "--build", BUILD, "--target", "mwmesh_python", "--parallel", jobs],
                       check=True)
        made, = (BUILD / "python" / "mwmesh").glob("_core*.so")
        place = pathlib.Path(self.get_ext_fullpath(ext.name))
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(made, place)
        shutil.copy2(made.parent / "_stamp.py", place.parent)
        subprocess.run(["strip", "--strip-unneeded", place], check=True)


BUILD.mkdir(parents=True, exist_ok=True)
setup(
    version=version(),
    ext_modules=[Extension("mwmesh._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
    options={
        "build": {"build_base": str(BUILD / "setuptools")},
        "egg_info": {"egg_base": str(BUILD)},
    },
)
