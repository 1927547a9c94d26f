#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Writes over a mesh that consists of several files, and looks at what is there after each event: what
a kill then leaves, and what the disk holds when its power is cut (disk.py).

Names hold files of the old mesh or of the new one, never of both, and where the file is that the mesh
is opened by, all are.  Writing again ends in the new files and no others.
"""
import random
import shutil
import sys
import tempfile
from pathlib import Path

import disk
import watched

CUTS = 4  # after each event
AGAIN = 3  # of the states of each kind of file: the program goes on from there
CONVERT = ["convert", "{mesh}.vtkhdf", "out/m.{kind}"]
RUNS = {
    "msh": CONVERT, "feb": CONVERT,
    "xdmf": [*CONVERT, "--element=tet10"],
}


class Broken(Exception):
    pass


def prepare(folder):
    """Two meshes that differ in all of their files."""
    for name, step in (("old", 4), ("new", 3)):
        labels = bytes((x // step + step * (y // 5)) for _ in range(7) for y in range(9)
                       for x in range(10))
        watched.write_npy(folder / f"{name}.npy", (10, 9, 7), labels)
        rows = [f"{i},{name} {i},{20 * i},{step},7" for i in set(labels)]
        (folder / f"{name}.csv").write_text("\n".join(["id,name,r,g,b", *rows]) + "\n")
        code, text = watched.run(["mesh", f"{name}.npy", "-o", f"{name}.vtkhdf", "--window=8",
                                  "--names", f"{name}.csv"], folder)
        assert code == 0, text


def arguments(kind, mesh):
    return [part.format(mesh=mesh, kind=kind) for part in RUNS[kind]]


def written(folder, kind, mesh, **how):
    code, text = watched.run(arguments(kind, mesh), folder, **how)
    if code != 0:
        raise Broken(f"exit code {code}\n{text}")
    return watched.files(folder / "out")


def lay_out(folder, files):
    shutil.rmtree(folder / "out", ignore_errors=True)
    (folder / "out").mkdir()
    for name, data in files.items():
        (folder / "out" / name).write_bytes(data)


class Sets:
    """The files of a mesh, old and new."""

    def __init__(self, folder, kind):
        self.folder, self.kind, self.main = folder, kind, f"m.{kind}"
        lay_out(folder, {})
        self.new = written(folder, kind, "new")
        lay_out(folder, {})
        self.old = written(folder, kind, "old")
        assert self.main in self.old and len(self.old) > 1 and self.old.keys() == self.new.keys()
        assert all(self.old[name] != self.new[name] for name in self.old), "they are alike"

    def check(self, files):
        named = {name: data for name, data in files.items() if ".partial-" not in name}
        for whole in (self.old, self.new):
            if all(whole.get(name) == data for name, data in named.items()):
                if self.main in named and len(named) < len(whole):
                    raise Broken(f"{self.main} stands with {sorted(named)} alone")
                return
        ages = [f"{name} is {self.age(name, data)}" for name, data in sorted(named.items())]
        raise Broken("files of both: " + ", ".join(ages))

    def age(self, name, data):
        if data == self.old.get(name):
            return "old"
        return "new" if data == self.new.get(name) else "broken"

    def check_again(self, files):
        """Leftovers of the killed run are those of another process here, as they are there."""
        lay_out(self.folder, files)
        if written(self.folder, self.kind, "new") != self.new:
            raise Broken(f"written again: {sorted(watched.files(self.folder / 'out'))}")


def states(folder, entries, old, draw):
    """(after which call, what a kill or a cut leaves), for each event."""
    out = disk.Disk(folder / "out", old)
    for call, event in watched.events(entries):
        out.apply(event)
        start = len(out.folder) + 1
        yield f"killed after {call}", {path[start:]: bytes(file.now)
                                       for path, file in out.names.items()}
        for _ in range(CUTS):
            yield f"cut after {call}", out.after_cut(draw)


def try_kind(folder, kind):
    sets = Sets(folder, kind)
    log = folder / "log"
    log.unlink(missing_ok=True)
    written(folder, kind, "new", watch=folder / "out", log=log)
    draw = random.Random(7)
    tried = list(states(folder, watched.read_log(log), sets.old, draw))
    assert tried[-CUTS - 1][1] == sets.new, "the record ends before the run"
    again = {draw.randrange(len(tried)) for _ in range(AGAIN)}
    failed = 0
    for i, (where, files) in enumerate(tried):
        try:
            sets.check(files)
            if i in again:
                sets.check_again(files)
        except (Broken, watched.Crash) as failure:
            failed += 1
            print(f"FAILED: {kind}, {where}: {failure}", flush=True)
    print(f"side_files: {kind}: {len(tried)} instants of {len(sets.new)} files, {failed} failed",
          flush=True)
    return failed


def main():
    watched.require_module()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        prepare(folder)
        return 1 if sum(try_kind(folder, kind) for kind in RUNS) else 0


if __name__ == "__main__":
    sys.exit(main())
