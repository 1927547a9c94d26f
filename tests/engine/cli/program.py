# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The program under test, MW_PROGRAM, for the scripts of this folder."""
import os
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


def enter_folder(case):
    """An empty folder is the working directory until the test, or the class of tests, ends."""
    folder = tempfile.TemporaryDirectory()
    add_cleanup = case.addClassCleanup if isinstance(case, type) else case.addCleanup
    add_cleanup(folder.cleanup)
    add_cleanup(os.chdir, "/")
    os.chdir(folder.name)
