#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""What --size and --inner-vertices promise, measured on files that meshio and numpy have read."""
import json
import os
import sys
import tempfile
import unittest

from program import run, start

try:
    import meshio
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SPACING = ("--spacing", "0.5,0.5,1.25")
PAIRS = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]


class Mesh:
    def __init__(self, path):
        mesh = meshio.read(path)
        self.points = np.asarray(mesh.points, dtype=float)
        self.tets = mesh.cells_dict["tetra"].astype(np.int64)
        self.labels = np.asarray(mesh.cell_data["label"][0]).astype(np.int64).ravel()

    def longest(self, label):
        tets = self.tets[self.labels == label]
        edges = [self.points[tets[:, a]] - self.points[tets[:, b]] for a, b in PAIRS]
        return max(np.linalg.norm(e, axis=1).max() for e in edges)

    def lacking(self):
        """Which tets have all corners on interfaces or the box."""
        low = np.full(len(self.points), np.iinfo(np.int64).max)
        high = np.full(len(self.points), -1)
        for corner in self.tets.T:
            np.minimum.at(low, corner, self.labels)
            np.maximum.at(high, corner, self.labels)
        box = (self.points == self.points.min(0)) | (self.points == self.points.max(0))
        return ((low != high) | box.any(1))[self.tets].all(1)


class Sizes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        os.chdir(folder.name)
        run("synth", "voronoi", "--shape", "28,28,14", "--labels", "9", "--seed", "4", "-o", "v.npy")
        self.labels = sorted(np.unique(np.load("v.npy")).tolist())

    def mesh(self, name, *options):
        run("mesh", "v.npy", *SPACING, "-o", name, "--report", name + ".json", *options)
        verdict = run("verify", "v.npy", name, *SPACING, "--max-distance", "1.5", "--quality-floor",
                      "0.2", "--max-volume-error", "none")
        self.assertIn("all checks hold", verdict)
        with open(name + ".json", encoding="utf-8") as file:
            self.report = json.load(file)
        return Mesh(name)

    def test_edges_keep_to_the_sizes_of_both_sources(self):
        first, second, third = self.labels[1:4]
        with open("more.csv", "w", encoding="utf-8") as file:
            file.write(f"# two more\nlabel,size\n{second}, 2.5\n{third},1.5\n")
        limits = {first: 2.0, second: 2.5, third: 1.5}
        mesh = self.mesh("m.vtu", "--size", f"{first}=2,@more.csv")
        self.assertEqual(self.report["settings"]["size"], f"{first}=2,@more.csv")
        rows = {row["label"]: row for row in self.report["shape"]["per_label"]}
        for label, limit in limits.items():
            longest = mesh.longest(label)
            self.assertLessEqual(longest, limit * (1 + 1e-9))
            self.assertGreater(longest, 0.7 * limit)
            self.assertEqual(rows[label]["size"], limit)
            self.assertAlmostEqual(rows[label]["longest_edge"], longest, places=12)
        plain = self.mesh("p.vtu")
        self.assertTrue(all(plain.longest(label) > limit for label, limit in limits.items()))
        self.assertTrue(all("size" not in row for row in self.report["shape"]["per_label"]))

    def test_inner_vertices_are_added_where_asked(self):
        plain = self.mesh("p.vtu")
        every = self.mesh("i.vtu", "--inner-vertices")
        self.assertGreater(self.report["size"]["inner_vertices_added"], 20)
        self.assertLess(every.lacking().sum(), 0.5 * plain.lacking().sum())
        label = self.labels[2]
        one = self.mesh("o.vtu", "--inner-vertices", "--size", f"{label}=2.5")
        self.assertLess(one.lacking()[one.labels == label].mean(), 0.1)

    def test_threads_and_resume_change_nothing(self):
        options = ("--size", f"{self.labels[1]}=2", "--inner-vertices")
        self.mesh("a.vtu", *options, "--threads", "1")
        run("mesh", "v.npy", *SPACING, "-o", "b.vtu", *options, "--threads", "2", "--resume")
        self.assertEqual(run("digest", "a.vtu"), run("digest", "b.vtu"))

    def refused(self, code, piece, *options):
        done = start("mesh", "v.npy", "-o", "x.vtu", *options)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(piece, done.stderr)
        self.assertFalse(os.path.exists("x.vtu"))

    def test_errors_name_what_is_wrong(self):
        label = self.labels[1]
        self.refused(2, "no label 4711", "--size", "4711=3")
        self.refused(2, "can be kept", "--size", f"{label}=1.5")
        self.refused(2, "expected LABEL=H", "--size", f"{label}:3")
        self.refused(2, "must be positive", "--size", f"{label}=-3")
        self.refused(2, "two sizes", "--size", f"{label}=3,{label}=3")
        self.refused(2, "nothing to grade", "--gradation", "0.3")
        self.refused(2, "from 0 to 10", "--size", f"{label}=3", "--gradation", "11")
        self.refused(2, "--optimizer local", "--inner-vertices", "--optimizer", "tetgen")
        for text, piece in (("1,2,3\n", "line 1: has 3 values"), ("# nothing\n", "has no sizes"),
                            (f"{label},3\n2,x\n", "line 2: expected a finite number")):
            with open("bad.csv", "w", encoding="utf-8") as file:
                file.write(text)
            self.refused(3, "bad.csv: " + piece, "--size", "@bad.csv")
        self.refused(3, "none.csv", "--size", "@none.csv")
        with open("twice.csv", "w", encoding="utf-8") as file:
            file.write(f"{label},3\n")
        self.refused(2, "two sizes", "--size-file", "twice.csv", "--size", f"{label}=3")


if __name__ == "__main__":
    unittest.main()
