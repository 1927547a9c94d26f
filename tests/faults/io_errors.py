#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Fails each system call of small runs in turn, with each error that the call may have; or from
there on all that take space (the disk is full), or all (it is gone).

A run ends with exit code 3 or 4 and a message, or does without the call and gives the right bytes;
no name holds half a file; nothing is left over; and the same command (with --resume for `mesh`)
gives the right bytes once the fault is gone.

    io_errors.py [--all]     default: for each kind of call and file some places and one error
"""
import errno
import itertools
import json
import shutil
import sys
import tempfile
from pathlib import Path

import watched

WRITE = [errno.ENOSPC, errno.EIO, errno.EDQUOT, errno.EINTR, "short", "full", "gone"]
MAKE = [errno.EMFILE, errno.ENOSPC, errno.EIO, "gone"]
ERRORS = {
    "open": MAKE, "mkostemp": MAKE, "fopen": [errno.EMFILE, errno.EIO],
    "read": [errno.EIO, "short"], "pread": [errno.EIO, errno.EINTR, "short", "gone"],
    "write": WRITE, "pwrite": WRITE,
    "fsync": [errno.EIO, errno.ENOSPC, errno.EDQUOT], "fdatasync": [errno.EIO, "gone"],
    "ftruncate": [errno.EIO, errno.ENOSPC], "fallocate": [errno.EINTR, "full", errno.EDQUOT],
    "mmap": [errno.ENOMEM, "gone"], "rename": [errno.EIO, errno.ENOSPC, "gone"],
    "mkdir": [errno.ENOSPC, errno.EIO], "unlink": [errno.EIO], "remove": [errno.EIO],
    "rmdir": [errno.EIO],
}
MESH = ["--threads=1", "--window=8", "--save-every=0"]
RUNS = {
    "mesh .vtu": ["mesh", "v.npy", "-o", "out/m.vtu", *MESH],
    "mesh .vtkhdf": ["mesh", "v.npy", "-o", "out/m.vtkhdf", "--report", "out/r.json", *MESH],
    "mesh .msh": ["mesh", "v.npy", "-o", "out/m.msh", *MESH],
    "convert .vtkhdf": ["convert", "in.vtu", "out/m.vtkhdf"],
    "convert .inp": ["convert", "in.vtkhdf", "out/m.inp"],
    "convert .k": ["convert", "in.vtkhdf", "out/m.k"],
    "convert .cdb": ["convert", "in.vtkhdf", "out/m.cdb"],
    "convert .xdmf": ["convert", "in.vtkhdf", "out/m.xdmf", "--element=tet10"],
    "convert --pieces": ["convert", "in.mesh", "out/m.pvtu", "--pieces=3"],
    "surface .stl": ["surface", "in.vtkhdf", "-o", "out/{label}.stl", "--each"],
    "surface .ply": ["surface", "in.vtu", "-o", "out/s.ply", "--manifold"],
    "surface .obj": ["surface", "in.vtu", "-o", "out/s.obj", "--labels=1"],
    "surface .vtp": ["surface", "in.vtu", "-o", "out/s.vtp"],
    "surface folder": ["surface", "in.vtkhdf", "-o", "out/p", "--format=precomputed"],
}
READS_ALL = "convert .xdmf"  # every read of its input fails once: nothing may get lost silently
REST_ALONE = "add --resume to write the rest without meshing again"
rests = []  # calls whose failure was told so
SAMPLES = 2  # calls of a kind on a file that are tried without --all


class Broken(Exception):
    pass


def prepare(folder):
    """Fresh inputs; nothing in out/."""
    labels = bytes((x // 4 + 2 * (y // 5)) * (z < 6) for z in range(8) for y in range(9)
                   for x in range(10))
    watched.write_npy(folder / "v.npy", (10, 9, 8), labels)
    for kind in ("vtu", "vtkhdf", "mesh"):
        done = watched.run(["mesh", "v.npy", "-o", f"in.{kind}", "--window=8"], folder)
        assert done[0] == 0, done


def clear(folder):
    shutil.rmtree(folder / "out", ignore_errors=True)
    (folder / "out").mkdir()


def contents(folder):
    """Without what differs from run to run: times in the report."""
    found = watched.files(folder / "out")
    return {name: b"" if name == "r.json" else data for name, data in found.items()}


def is_passing(name):
    """Of a partial or temporary file, or in the work folder."""
    return ".partial-" in name or ".mwmesh-" in name or ".work/" in name


def could_clear_away(call, how):
    return how != "gone" and call.name not in ("unlink", "remove", "rmdir")


def check_failed(folder, expected, clean, text):
    """What a run may leave that ends with 3 or 4."""
    if "mwmesh: error: " not in text:
        raise Broken(f"no message\n{text}")
    for name, data in contents(folder).items():
        if is_passing(name):
            if ".work/" not in name and clean:
                raise Broken(f"{name} is left over")
        elif expected.get(name) != data:
            raise Broken(f"{name} is not what it ought to be")


def check_done(folder, expected, clean):
    found = contents(folder)
    if not clean:
        found = {name: found[name] for name in found if not is_passing(name)}
    if found != expected:
        raise Broken(f"exit code 0 and {sorted(found)}, expected {sorted(expected)}, "
                     f"other bytes in {[n for n in found if found[n] != expected.get(n)]}")


def again(folder, arguments):
    """The fault is gone."""
    if arguments[0] == "mesh":
        arguments = [*arguments, "--resume"]
    code, text = watched.run(arguments, folder)
    if code != 0:
        raise Broken(f"once the fault is gone: exit code {code}\n{text}")


def check_not_meshed_again(folder):
    """The work of all windows was kept for what is written beside the mesh."""
    engine = json.loads((folder / "out" / "r.json").read_text())["engine"]
    if engine["windows"] != 0 or engine["windows_resumed"] == 0:
        raise Broken("meshed again")


def attempt(folder, arguments, expected, call, how):
    """REQUIRES: the calls up to this one are the same in every run, except those of a child that
    reads a file apart."""
    clear(folder)
    log = folder / "log"
    log.unlink(missing_ok=True)
    code, text = watched.run(arguments, folder, watch=folder, log=log, at=call.number, how=how)
    call = next(c for c in watched.read_calls(log) if c.number == call.number)
    clean = could_clear_away(call, how)
    if code == 0:
        return check_done(folder, expected, clean)
    if code not in (3, 4):
        raise Broken(f"exit code {code}\n{text}")
    check_failed(folder, expected, clean, text)
    again(folder, arguments)
    if REST_ALONE in text:
        check_not_meshed_again(folder)
        rests.append(call)
    return check_done(folder, expected, clean)


def sampled(calls):
    """For each kind of call on each kind of file the first, the last and some between."""
    kinds = {}
    for call in calls:
        name = Path(call.path).name
        kinds.setdefault((call.name, name.split("-")[0], name.count("deleted")), []).append(call)
    for some in kinds.values():
        places = range(len(some)) if len(some) <= SAMPLES else \
            [i * (len(some) - 1) // (SAMPLES - 1) for i in range(SAMPLES)]
        yield from (some[i] for i in places)


def cases(name, calls, everything):
    if everything:
        return [(call, how) for call in calls for how in ERRORS[call.name]]
    turns = {name: itertools.cycle(errors) for name, errors in ERRORS.items()}
    reads = [c for c in calls if c.name == "pread" and Path(c.path).name.startswith("in.")]
    return [(call, next(turns[call.name])) for call in sampled(calls)] + \
        [(call, errno.EIO) for call in reads if name == READS_ALL]


def try_run(name, folder, everything):
    arguments = RUNS[name]
    clear(folder)
    log = folder / "log"
    log.unlink(missing_ok=True)
    code, text = watched.run(arguments, folder, watch=folder, log=log)
    assert code == 0, text
    expected = contents(folder)
    calls = watched.read_calls(log)
    failed, tried = 0, cases(name, calls, everything)
    for call, how in tried:
        try:
            attempt(folder, arguments, expected, call, how)
        except (Broken, watched.Crash) as failure:
            failed += 1
            error = errno.errorcode.get(how, how)
            print(f"FAILED: {name}: {error} at call {call.number} ({call.name} of "
                  f"{Path(call.path).relative_to(folder)}): {failure}", flush=True)
    if "--report" in arguments and not rests:
        failed += 1
        print(f"FAILED: {name}: no error left the report alone to be written", flush=True)
    print(f"io_errors: {name}: {len(tried)} errors at {len(calls)} calls, {failed} failed",
          flush=True)
    return failed


def main():
    watched.require_module()
    everything = "--all" in sys.argv
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        prepare(folder)
        return 1 if sum(try_run(run, folder, everything) for run in RUNS) else 0


if __name__ == "__main__":
    sys.exit(main())
