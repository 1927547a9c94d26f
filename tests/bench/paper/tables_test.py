# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The whole program on a small volume: runs mwmesh, and keeps what it found."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy

import vtu
from runs import Mode, Runner

PROGRAM = pathlib.Path(os.environ["MW_PROGRAM"])
TABLES = pathlib.Path(vtu.__file__).parent / "tables.py"


def call(*arguments):
    return subprocess.run(
        [str(argument) for argument in arguments], capture_output=True, text=True, check=True
    )


class WithVolume(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.volume = self.folder / "cells.npy"
        shape = ("--shape", "12,11,10", "--labels", "5", "--seed", "3")
        call(PROGRAM, "synth", "voronoi", *shape, "-o", self.volume)

    def runner(self):
        programs = {"mwmesh": PROGRAM, "cgal_mesh": self.folder / "missing"}
        return Runner(programs, self.folder / "runs")


class Meshes(WithVolume):
    def test_a_written_mesh_is_read_back(self):
        path = self.folder / "cells.vtu"
        call(PROGRAM, "mesh", self.volume, "-o", path)
        mesh = vtu.read(path)
        a, b, c, d = (mesh.points[mesh.tets[:, i]] for i in range(4))
        volumes = numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a) / 6
        self.assertGreater(volumes.min(), 0)
        self.assertAlmostEqual(volumes.sum(), 12 * 11 * 10, places=6)
        voxels = numpy.load(self.volume)
        self.assertEqual(set(mesh.labels.tolist()), set(numpy.unique(voxels).tolist()))


class Runs(WithVolume):
    def test_facts_agree_with_verify(self):
        facts = self.runner().measure(self.volume, Mode("default"))
        self.assertEqual(facts.failure, "")
        self.assertTrue(facts.check["passed"])
        bins = numpy.flatnonzero(facts.shape["dihedral_histogram"]) * 5
        self.assertEqual(bins[0], facts.check["quality"]["dihedral_min_deg"] // 5 * 5)
        self.assertEqual(bins[-1], facts.check["quality"]["dihedral_max_deg"] // 5 * 5)
        self.assertEqual(sum(facts.shape["dihedral_histogram"]), 6 * facts.run["output"]["tets"])

    def test_what_was_measured_is_not_measured_again(self):
        first = self.runner().measure(self.volume, Mode("default"))
        reports = list((self.folder / "runs").rglob("run-0.json"))
        marked = json.loads(reports[0].read_text()) | {"marked": True}
        reports[0].write_text(json.dumps(marked))
        again = self.runner().measure(self.volume, Mode("default"))
        self.assertEqual(again.run, first.run | {"marked": True})
        same = self.runner().measure(self.volume, Mode("said", ("--order", "colour")))
        self.assertIn("marked", same.run)
        other = self.runner().measure(self.volume, Mode("other", ("--window", "8")))
        self.assertNotIn("marked", other.run)

    def test_a_run_that_was_stopped_before_its_check_is_made_whole(self):
        whole = self.runner().measure(self.volume, Mode("default"))
        next((self.folder / "runs").rglob("check.json")).unlink()
        again = self.runner().measure(self.volume, Mode("default"))
        self.assertEqual(again.check["quality"], whole.check["quality"])
        self.assertEqual(list((self.folder / "runs").rglob("*.vtu")), [])

    def test_a_mesh_that_fails_its_check_is_not_a_failed_run(self):
        other = self.folder / "other.npy"
        voxels = numpy.load(self.volume)
        numpy.save(other, numpy.where(voxels == voxels.max(), voxels.min(), voxels))
        peer = self.folder / "peer"  # meshes another volume, whatever it is asked
        peer.write_text(f'#!/bin/sh\nshift\nexec "{PROGRAM}" mesh "{other}" "$@"\n')
        peer.chmod(0o755)
        runner = Runner({"mwmesh": PROGRAM, "cgal_mesh": peer}, self.folder / "runs")
        facts = runner.measure(self.volume, Mode("peer", tool="cgal_mesh"))
        self.assertEqual(facts.failure, "")
        self.assertFalse(facts.check["passed"])

    def test_a_refusal_is_a_fact(self):
        refused = self.runner().measure(self.volume, Mode("odd", ("--window", "7")))
        self.assertIn("window", refused.failure)
        missing = self.runner().measure(self.volume, Mode("peer", tool="cgal_mesh"))
        self.assertEqual(missing.failure, "cgal_mesh is not built")


class Program(WithVolume):
    def test_tables_of_a_volume(self):
        out = self.folder / "out"
        options = ("--program", PROGRAM, "--cgal", self.folder / "missing", "--tables", "2,6")
        call(sys.executable, TABLES, self.volume, "--out", out, *options)
        text = (out / "tables.md").read_text()
        self.assertIn("mwmesh mesh VOLUME --threads 1 --config configs/paper.toml", text)
        self.assertNotIn(str(self.folder), text)
        rows = (out / "table6.csv").read_text().splitlines()
        self.assertTrue(rows[1].startswith("cells.npy,default,"))
        self.assertTrue(rows[3].endswith(",cgal_mesh is not built"))


if __name__ == "__main__":
    unittest.main()
