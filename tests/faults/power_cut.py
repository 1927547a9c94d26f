#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Cuts the power of a disk (disk.py) at every event of small runs; `mesh --resume` must then end in
the bytes of an undisturbed run, and until then no name may hold another mesh.

    power_cut.py [MINUTES [SEED]]     default: one cut at each event of two short histories
"""
import random
import shutil
import sys
import tempfile
import time
from pathlib import Path

import disk
import watched


class Broken(Exception):
    pass


class Subject:
    """A volume, settings, and the mesh that must come out."""

    def __init__(self, draw, folder):
        self.draw, self.folder = draw, folder
        shape = [draw.randint(6, 11) for _ in range(3)]
        labels = bytes(draw.choice([0, 0, 0, 1, 2]) if draw.random() < 0.2 else
                       x // 4 + 2 * (y // 5) for _ in range(shape[2]) for y in range(shape[1])
                       for x in range(shape[0]))
        watched.write_npy(folder / "v.npy", shape, labels)
        self.name = draw.choice(["m.vtu", "m.vtkhdf"])
        self.settings = [f"--window={draw.choice([6, 8])}",
                         f"--order={draw.choice(['raster', 'colour'])}", "--save-every=0"]
        code, text = watched.run(self.arguments("whole", []), folder)
        assert code == 0, text
        self.expected = (folder / "whole" / self.name).read_bytes()

    def arguments(self, place, more):
        (self.folder / place).mkdir(exist_ok=True)
        return ["mesh", "v.npy", "-o", f"{place}/{self.name}", *self.settings, *more]

    def recorded(self, place, kill_at=0):
        """What a run did, until it was killed."""
        log = self.folder / "log"
        log.unlink(missing_ok=True)
        arguments = self.arguments(place, ["--threads=1", "--resume"])
        code, text = watched.run(arguments, self.folder, watch=self.folder / place, log=log,
                                 at=kill_at, how="kill")
        if code not in (0, -9):
            raise Broken(f"exit code {code}\n{text}")
        return watched.read_log(log)

    def check(self, files):
        """What the disk holds after a cut."""
        if files.get(self.name, self.expected) != self.expected:
            raise Broken(f"{self.name} is another mesh")
        self.lay_out("after", files)
        threads = f"--threads={self.draw.randint(1, 3)}"
        code, text = watched.run(self.arguments("after", ["--resume", threads]), self.folder)
        if code != 0:
            raise Broken(f"exit code {code}\n{text}")
        found = watched.files(self.folder / "after")
        if found != {self.name: self.expected}:
            raise Broken(f"other files than those of an undisturbed run: {sorted(found)}")

    def lay_out(self, place, files):
        shutil.rmtree(self.folder / place, ignore_errors=True)
        (self.folder / place).mkdir()
        for name, data in files.items():
            path = self.folder / place / name
            path.parent.mkdir(exist_ok=True)
            path.write_bytes(data)


class History:
    """Events one after the other, and the cuts that were tried among them."""

    def __init__(self, subject, seed):
        self.subject, self.seed = subject, seed
        self.cuts, self.failed = 0, 0

    def cut(self, state, where):
        self.cuts += 1
        files = state.after_cut(self.subject.draw)
        try:
            self.subject.check(files)
        except (Broken, watched.Crash) as failure:
            self.failed += 1
            sizes = {name: len(data) for name, data in files.items()}
            print(f"FAILED: seed {self.seed}, cut {where}: {failure}\n  disk: {sizes}", flush=True)

    def run(self, state, place, kill_at=0, each=True):
        """A run, cut after each event; the state is that of its end."""
        entries = self.subject.recorded(place, kill_at)
        for call, event in watched.events(entries):
            state.apply(event)
            if each:
                self.cut(state, f"after call {call}")
        return entries

    def undisturbed(self):
        """Cuts of a run that nothing else happens to."""
        self.subject.lay_out("out", {})
        return self.run(disk.Disk(self.subject.folder / "out"), "out")

    def instant(self, calls):
        """The number of a call at which to stop a run: at times what was written is not synced."""
        draw = self.subject.draw
        syncs = [c for c in calls if c.name == "fdatasync"]
        return draw.choice(syncs if draw.random() < 0.5 else calls[len(calls) // 4 :]).number

    def killed_before(self, calls):
        """Cuts of a run that goes on where another was killed, whose writes may still be on their
        way."""
        self.subject.lay_out("out", {})
        state = disk.Disk(self.subject.folder / "out")
        self.run(state, "out", self.instant(calls), each=False)
        self.run(state, "out")

    def cut_before(self, calls):
        """Cuts of a run that goes on after a cut."""
        draw = self.subject.draw
        self.subject.lay_out("out", {})
        state = disk.Disk(self.subject.folder / "out")
        self.run(state, "out", self.instant(calls), each=False)
        files = state.after_cut(draw)
        self.subject.lay_out("out", files)
        self.run(disk.Disk(self.subject.folder / "out", files), "out")


def histories(seed, ways):
    """All cuts of one subject: (number, failed)."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        history = History(Subject(random.Random(seed), folder), seed)
        calls = [e for e in history.undisturbed() if isinstance(e, watched.Call)]
        for way in ways:
            getattr(history, way)(calls)
        return history.cuts, history.failed


def main():
    watched.require_module()
    minutes = float(sys.argv[1]) if len(sys.argv) > 1 else 0
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    end = time.monotonic() + 60 * minutes
    ways = ["killed_before", "cut_before"] if minutes else ["killed_before"]
    cuts = failed = 0
    while True:
        more, broken = histories(seed, ways)
        cuts, failed, seed = cuts + more, failed + broken, seed + 1
        if time.monotonic() >= end:
            break
    print(f"power_cut: {cuts} cuts, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
