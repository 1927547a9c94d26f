# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the program with its system calls counted, failed or recorded (fault_plan.h)."""
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

PROGRAM = os.environ["MW_PROGRAM"]
MODULE = os.environ["MW_TEST_FAULTS"]  # the program leaves variables MW_TEST_... alone
TIMEOUT = 120  # s


@dataclass
class Call:
    number: int
    name: str
    path: str


@dataclass
class Event:
    """What a call has done; `data` of a write, `other` the new name of a rename."""

    name: str
    path: str
    offset: int
    size: int
    other: str
    data: bytes = b""


class Crash(Exception):
    """Ended by a signal, or not at all."""


def require_module():
    """Sanitizers put themselves before the same functions, and want to be first."""
    done = subprocess.run([PROGRAM, "--version"], env=dict(os.environ, LD_PRELOAD=MODULE),
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        print(f"skipped: {MODULE} does not go with this program: {done.stderr}")
        sys.exit(77)


def run(arguments, folder, watch=None, log=None, at=0, how=""):
    """Exit code and messages.  watch: the folder whose calls are counted."""
    environment = dict(os.environ)
    if watch:
        environment.update(LD_PRELOAD=MODULE, FAULT_FOLDER=str(watch), FAULT_AT=str(at),
                           FAULT_HOW=str(how), FAULT_LOG=str(log or ""))
    try:
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=folder, env=environment,
                              capture_output=True, timeout=TIMEOUT, check=False)
    except subprocess.TimeoutExpired:
        raise Crash(f"still running after {TIMEOUT} s") from None
    text = (done.stdout + done.stderr).decode(errors="replace")
    if done.returncode < 0 and how != "kill":
        raise Crash(f"ended by signal {-done.returncode}\n{text}")
    return done.returncode, text


def read_log(path):
    """Calls and events in the order in which they happened."""
    out = []
    with open(path, "rb") as file:
        while line := file.readline():
            fields = line.decode().rstrip("\n").split("\t")
            if fields[0] == "call":
                out.append(Call(int(fields[1]), *fields[2:]))
                continue
            event = Event(fields[0], fields[1], int(fields[2]), int(fields[3]), fields[4])
            if event.name == "write":
                event.data = file.read(event.size)
                file.read(1)
            out.append(event)
    return out


def read_calls(path):
    return [entry for entry in read_log(path) if isinstance(entry, Call)]


def events(entries):
    """(the call before it, event), for each event."""
    call = "the start"
    for entry in entries:
        if isinstance(entry, Call):
            call = f"{entry.number} {entry.name} {Path(entry.path).name}"
        else:
            yield call, entry


def files(folder):
    """Relative path -> bytes."""
    folder = Path(folder)
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def write_npy(path, shape, labels):
    """labels: bytes, x fastest; shape: x, y, z."""
    text = f"{{'descr': '|u1', 'fortran_order': False, 'shape': {tuple(reversed(shape))}, }}"
    text += " " * (63 - (10 + len(text)) % 64) + "\n"
    header = b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text.encode()
    Path(path).write_bytes(header + labels)
