# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The program under test, MW_PROGRAM, for the scripts of this folder."""
import os
import pathlib
import subprocess
import tempfile

PROGRAM = os.environ["MW_PROGRAM"]
# A sanitizer keeps what is freed and shadows what is not: no budget bounds that.
RESIDENT_MEMORY_IS_OURS = "MW_TEST_SANITIZED" not in os.environ


def start(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)


def run(*arguments, code=0):
    """What it prints; it has to end with that exit code."""
    done = start(*arguments)
    assert done.returncode == code, (arguments, done.returncode, done.stdout, done.stderr)
    return done.stdout


def refused(words, *arguments, code=3):
    """What it says, every word among that; it has to end with that exit code."""
    done = start(*arguments)
    assert done.returncode == code, (arguments, done.returncode, done.stdout, done.stderr)
    for word in words:
        assert word in done.stderr, (arguments, word, done.stderr)
    return done.stderr


def enter_folder(case):
    """An empty folder is the working directory until the test, or the class of tests, ends."""
    folder = tempfile.TemporaryDirectory()
    add_cleanup = case.addClassCleanup if isinstance(case, type) else case.addCleanup
    add_cleanup(folder.cleanup)
    add_cleanup(os.chdir, "/")
    os.chdir(folder.name)


def pull(mesh, more, poisson, side):
    """The force on X_MIN or X_MAX of MESH.inp when CalculiX moves the latter by 0.1."""
    pathlib.Path("job.inp").write_text(
        f"*INCLUDE, INPUT={mesh}.inp\n{more}*MATERIAL, NAME=M\n*ELASTIC\n1000, {poisson}\n"
        "*SOLID SECTION, ELSET=LABEL_1, MATERIAL=M\n*SOLID SECTION, ELSET=LABEL_2, MATERIAL=M\n"
        "*BOUNDARY\nX_MIN, 1, 3\n*STEP\n*STATIC\n*BOUNDARY\nX_MAX, 2, 3\nX_MAX, 1, 1, 0.1\n"
        f"*NODE PRINT, NSET={side}, TOTALS=ONLY\nRF\n*END STEP\n", encoding="utf-8")
    done = subprocess.run(["ccx", "job"], capture_output=True, text=True)
    assert done.returncode == 0 and "*ERROR" not in done.stdout, done.stdout
    return [float(x) for x in pathlib.Path("job.dat").read_text().split()[-3:]]
