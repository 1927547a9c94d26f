#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""What --size and --inner-vertices promise, measured on files that meshio and numpy have read."""
import json
import os
import sys
import unittest

from program import enter_folder, refused, run, start

try:
    import numpy as np
    from tet_mesh import PAIRS, Mesh
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SPACING = ("--spacing", "0.5,0.5,1.25")


class Sizes(unittest.TestCase):
    def setUp(self):
        enter_folder(self)
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
            self.assertLessEqual(longest, 1.5 * limit * (1 + 1e-9))
            self.assertGreater(longest, 0.9 * limit)
            self.assertEqual(rows[label]["size"], limit)
            self.assertAlmostEqual(rows[label]["longest_edge"], longest, places=12)
        ratios = self.report["size"]["edges_over_size"]
        self.assertEqual(len(ratios["counts"]), len(ratios["bounds"]) + 1)
        tets = sum((mesh.labels == label).sum() for label in limits)
        self.assertEqual(sum(ratios["counts"]), 6 * tets)
        self.assertEqual(ratios["counts"][-1], 0)  # above 1.5
        with open("sheet.csv", "w", encoding="utf-8-sig") as file:  # as a spreadsheet writes it
            file.write(f"label;size\n{second};2.5\n{third};1.5\n")
        self.mesh("s.vtu", "--size", f"{first}=2,@sheet.csv")
        self.assertEqual(run("digest", "s.vtu"), run("digest", "m.vtu"))
        plain = self.mesh("p.vtu")
        self.assertTrue(all(plain.longest(label) > 1.5 * limit for label, limit in limits.items()))
        self.assertTrue(all("size" not in row for row in self.report["shape"]["per_label"]))

    def test_inner_vertices_are_added_where_asked(self):
        plain = self.mesh("p.vtu")
        every = self.mesh("i.vtu", "--inner-vertices")
        self.assertGreater(self.report["size"]["inner_vertices_added"], 20)
        self.assertLess(every.lacking().sum(), 0.5 * plain.lacking().sum())
        label = self.labels[2]
        one = self.mesh("o.vtu", "--inner-vertices", "--size", f"{label}=2.5")
        self.assertLess(one.lacking()[one.labels == label].mean(), 0.1)

    def test_one_size_and_a_star_are_for_all_labels(self):
        every = self.mesh("e.vtu", "--size", "2.5")
        self.assertTrue(all(every.longest(label) <= 3.75 + 1e-9 for label in self.labels))
        label = self.labels[2]
        mesh = self.mesh("s.vtu", "--size", f"{label}=1.5,*=3")
        self.assertLessEqual(mesh.longest(label), 2.25 + 1e-9)
        rows = {row["label"]: row["size"] for row in self.report["shape"]["per_label"]}
        self.assertEqual(rows, {other: 1.5 if other == label else 3 for other in self.labels})

    def edges_of_ball(self, radius, centre, size):
        """Lengths of the edges in a ball, and how many tets it has."""
        z, y, x = np.mgrid[:32, :32, :32] + 0.5
        ball = (x - centre) ** 2 + (y - centre) ** 2 + (z - 16) ** 2 < radius**2
        np.save("b.npy", np.where(ball, 2, 1).astype(np.uint8))
        run("mesh", "b.npy", "-o", "b.vtu", "--size", f"2={size}")
        mesh = Mesh("b.vtu")
        tets = mesh.tets[mesh.labels == 2]
        edges = np.unique(np.sort(np.concatenate([tets[:, p] for p in PAIRS])), axis=0)
        return np.linalg.norm(mesh.points[edges[:, 0]] - mesh.points[edges[:, 1]], axis=1), len(tets)

    def test_most_edges_have_the_size_that_was_asked(self):
        """Nine of ten on average; of a single ball it may be a few less."""
        balls, counts = ((10, 16), (10, 16.3), (9.5, 15.8), (11, 16.1)), []
        for size in (3, 4, 5, 6):
            found = [self.edges_of_ball(*ball, size) for ball in balls]
            shares = [((lengths > 0.6 * size) & (lengths < 1.5 * size)).mean() for lengths, _ in found]
            self.assertGreater(np.mean(shares), 0.9, size)
            self.assertGreater(min(shares), 0.85, size)
            counts.append(found[0][1])
        self.assertEqual(counts, sorted(counts, reverse=True))

    def test_vertices_of_a_ball_reach_its_surface(self):
        """No vertex is held by edges that are as long as contraction leaves them."""
        z, y, x = np.mgrid[:40, :40, :40] + 0.5
        ball = (x - 20) ** 2 + (y - 20) ** 2 + (z - 20) ** 2 < 14**2
        np.save("b.npy", ball.astype(np.uint8))
        run("mesh", "b.npy", "-o", "b.vtu", "--size", "1.6")
        off = np.linalg.norm(Mesh("b.vtu").interface() - 20, axis=1) - 14
        self.assertLess(off.std(), 0.055)

    def test_interfaces_become_smoother_where_tets_are_cut(self):
        """A fine mesh of a ball is no coarse one with more corners in its flat faces."""
        z, y, x = np.mgrid[:24, :24, :24] + 0.5
        distance = np.sqrt((x - 12.2) ** 2 + (y - 11.9) ** 2 + (z - 12.3) ** 2) - 6
        np.save("d.npy", distance.astype(np.float32))
        run("mesh", "d.npy", "-o", "d.vtu", "--values", "distances", "--size", "1.3")
        off = np.linalg.norm(Mesh("d.vtu").interface() - (12.2, 11.9, 12.3), axis=1) - 6
        self.assertLess(off.std(), 0.03)

    def test_sizes_below_a_voxel_cut_the_tets_of_the_marches(self):
        """Edges have the sizes that are asked, the mesh proves itself, and nothing but the volume and
        the settings decides its bytes."""
        label, first = self.labels[2], set()
        for size, times, ways in ((0.6, 1, (("--threads=1",), ("--threads=2", "--memory=300MiB"))),
                                  (0.3, 2, (("--threads=2",),))):
            for options in ways:
                done = run("mesh", "v.npy", *SPACING, "--force", "-o", "f.vtu", "--report", "f.json", "--certify=auto",
                           "--size", f"{label}={size},*=1.5", *options)
                self.assertIn("halved", done)
                first.add((size, run("digest", "f.vtu")))
            verdict = run("verify", "v.npy", "f.vtu", *SPACING)
            self.assertIn("all checks hold; recorded promise: radius ratio", verdict)
            with open("f.json", encoding="utf-8") as file:
                report = json.load(file)
            mesh = Mesh("f.vtu")
            self.assertEqual(report["size"]["halvings"], times)
            self.assertEqual(report["output"]["tets"], len(mesh.tets))
            self.assertEqual(report["output"]["vertices"], len(mesh.points))
            quality = report["quality"]
            self.assertGreaterEqual(quality["radius_ratio_min"], quality["radius_ratio_floor"])
            self.assertEqual(sum(quality["radius_ratio_histogram"]), len(mesh.tets))
            rows = {row["label"]: row for row in report["shape"]["per_label"]}
            self.assertAlmostEqual(rows[label]["longest_edge"], mesh.longest(label), places=12)
            self.assertEqual(rows[label]["size"], size)
            tets = mesh.tets[mesh.labels == label]
            edges = np.unique(np.sort(np.concatenate([tets[:, p] for p in PAIRS])), axis=0)
            lengths = np.linalg.norm(mesh.points[edges[:, 0]] - mesh.points[edges[:, 1]], axis=1)
            self.assertGreater(((lengths > 0.6 * size) & (lengths < 1.5 * size)).mean(), 0.9)
        self.assertEqual(len(first), 2)

    def test_interfaces_have_sizes_of_their_own(self):
        z, y, x = np.mgrid[:32, :32, :32]
        np.save("i.npy", np.where(x < 8, 1, np.where(x < 24, 2, 3)).astype(np.uint8))
        run("mesh", "i.npy", "-o", "i.vtu", "--size", "2|3=2.5", "--gradation", "1")
        mesh = Mesh("i.vtu")
        middles = mesh.points[mesh.tets].mean(1)[:, 0]
        self.assertGreater((abs(middles - 24) < 4).sum(), 5 * (abs(middles - 8) < 4).sum())

    def test_fine_makes_surfaces_finer_and_smoother(self):
        """A ball whose voxels are noisy, as those of segmentations are."""
        z, y, x = np.mgrid[:48, :48, :48] - 23.5
        noise = np.random.default_rng(6).normal(0, 0.3, x.shape)
        np.save("b.npy", (np.hypot(np.hypot(x, y), z) + noise < 17).astype(np.uint8))
        triangles, bends = {}, {}
        for preset in "default", "fine":
            run("mesh", "b.npy", "-o", "b.vtu", "--preset", preset)
            mesh = Mesh("b.vtu")
            triangles[preset], bends[preset] = len(mesh.surface(1)), mesh.mean_bend(1)
        self.assertGreater(triangles["fine"], triangles["default"])
        self.assertLess(bends["fine"], 0.8 * bends["default"])

    def test_voxels_are_a_unit_of_sizes(self):
        # The edge of a cube of a voxel's volume; thick slices are cut into two layers or more.
        for spacing, size in ("2,2,2", 7), ("1,1,8", 3.5):
            digests = set()
            for text in "3.5vox", str(size):
                run("mesh", "v.npy", "--spacing", spacing, "-o", "u.vtu", "--size", text)
                digests.add(run("digest", "u.vtu"))
            self.assertEqual(len(digests), 1, spacing)
        refused(["some sizes are in voxels and others are not"], "mesh", "v.npy", "-o", "u.vtu",
                "--size", f"{self.labels[0]}=2,*=3vox", code=2)

    def test_interfaces_that_are_not_there_are_told(self):
        z, y, x = np.mgrid[:16, :16, :24]
        np.save("i.npy", np.where(x < 8, 1, np.where(x < 16, 2, 3)).astype(np.uint8))
        for options, pairs in ((("--size", "3|1=2.5,1|2=3"), [[1, 3]]), (("--size", "2|3=2.5"), []),
                               (("--size", "1|3=2.5", "--background", "3"), [])):
            done = start("mesh", "i.npy", "-o", "i.vtu", "--force", "--report", "i.json", *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual("--size 1|3: these labels do not meet" in done.stderr, pairs != [],
                             done.stderr)
            with open("i.json", encoding="utf-8") as file:
                self.assertEqual(json.load(file)["size"]["labels_that_do_not_meet"], pairs)

    def test_an_image_has_the_size_at_each_voxel(self):
        z, y, x = np.mgrid[:32, :32, :32]
        np.save("l.npy", np.where(y < 16, 1, 2).astype(np.uint8))
        sizes = np.where(x < 16, 2.5, 12).astype(np.float32)
        sizes[z > 29] = np.nan
        np.save("h.npy", sizes)
        digests = set()
        for threads in "1", "2":
            run("mesh", "l.npy", "-o", "l.vtu", "--size", "h.npy", "--gradation", "1",
                "--threads", threads)
            digests.add(run("digest", "l.vtu"))
        self.assertEqual(len(digests), 1)
        mesh = Mesh("l.vtu")
        middles = mesh.points[mesh.tets].mean(1)[:, 0]
        self.assertGreater((middles < 16).sum(), 5 * (middles > 16).sum())
        sizes[3, 4, 5] = 0.9  # tets are cut; what an image asks for below that cannot be had
        np.save("h.npy", sizes)
        self.assertIn("halved      once", run("mesh", "l.npy", "-o", "l.vtu", "--size", "h.npy"))
        self.assertIn("all checks hold", run("verify", "l.npy", "l.vtu"))
        tiny = sizes.astype(np.float64)  # as a file that tells the wrong type would have it
        tiny[3, 4, 5] = 5e-324
        np.save("h.npy", tiny)
        tiny[3, 4, 6:8] = 0.1
        np.save("h.npy", tiny)
        done = start("mesh", "l.npy", "-o", "l.vtu", "--size", "h.npy", "--force", "--report",
                     "h.json")
        self.assertIn("h.npy: 3 voxels ask for less than 0.347, the least", done.stderr)
        with open("h.json", encoding="utf-8") as file:
            self.assertEqual(json.load(file)["size"]["image_voxels_raised"], 3)
        np.save("h.npy", sizes[:-1])
        refused(["h.npy: has 32 x 32 x 31 voxels"], "mesh", "l.npy", "-o", "l.vtu", "--size", "h.npy")

    def test_an_image_lies_where_the_labels_do(self):
        try:
            import nibabel
        except ImportError:
            self.skipTest("needs nibabel")
        affine = np.array([[-.5, 0, 0, 9], [0, .5, 0, 2], [0, 0, .5, 3], [0, 0, 0, 1]])
        z, y, x = np.mgrid[:16, :16, :16]
        nibabel.save(nibabel.Nifti1Image((1 + (y > 7)).astype(np.uint8), affine), "l.nii")
        sizes = np.where(x < 8, 1.5, 4).astype(np.float32)
        image = nibabel.Nifti1Image(sizes, affine)
        nibabel.save(image, "h.nii")
        run("mesh", "l.nii", "-o", "l.vtu", "--size", "h.nii")
        np.save("h.npy", sizes.T)
        run("mesh", "l.nii", "-o", "n.vtu", "--size", "h.npy")
        self.assertEqual(run("digest", "l.vtu"), run("digest", "n.vtu"))
        nibabel.save(nibabel.as_closest_canonical(image), "turned.nii")
        affine[0, 3] += 1
        nibabel.save(nibabel.Nifti1Image(sizes, affine), "moved.nii")
        for name in ("turned.nii", "moved.nii"):
            refused([f"{name}: lies elsewhere in the world"], "mesh", "l.nii", "-o", "x.vtu", "--size",
                    name)
        np.save("none.npy", -np.abs(sizes.T))
        refused(["none.npy: has no positive number"], "mesh", "l.nii", "-o", "x.vtu", "--size", "none.npy")

    def test_threads_and_resume_change_nothing(self):
        options = ("--size", f"{self.labels[1]}=2", "--inner-vertices")
        self.mesh("a.vtu", *options, "--threads", "1")
        run("mesh", "v.npy", *SPACING, "-o", "b.vtu", *options, "--threads", "2", "--resume")
        self.assertEqual(run("digest", "a.vtu"), run("digest", "b.vtu"))

    def refused(self, code, piece, *options):
        refused([piece], "mesh", "v.npy", "-o", "x.vtu", *options, code=code)
        self.assertFalse(os.path.exists("x.vtu"))

    def test_errors_name_what_is_wrong(self):
        label = self.labels[1]
        self.refused(2, "no label 4711", "--size", "4711=3")
        self.refused(2, "0.347 can be kept", "--size", f"{label}=0.34")
        self.refused(2, "expected H, LABEL=H", "--size", f"{label}:3")
        self.refused(2, "must be positive", "--size", f"{label}=-3")
        for text in ("nan", "inf", "abc", ""):
            self.refused(2, f"expected a finite number, got '{text}'", "--size", f"{label}={text}")
        self.refused(2, "two sizes", "--size", f"{label}=3,{label}=3")
        self.refused(2, "nothing to grade", "--gradation", "0.2")
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
