#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Meshing again after edits: the same bytes, what is read and skipped, kills in between, refusals."""
import itertools
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: no numpy")
    sys.exit(77)

PROGRAM = os.environ["MW_PROGRAM"]
SETTINGS = ("--window", "8")


def call(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)


def content_of(path):
    with open(path, "rb") as file:
        return file.read()


def tree_of(folder):
    return {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}


class Keep(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        os.chdir(folder.name)
        self.done("synth", "voronoi", "--shape", "30,26,22", "--labels", "20", "--seed", "1", "-o",
                  "v.npy")
        self.volume = np.load("v.npy").astype(np.uint16) * 10
        np.save("v.npy", self.volume)

    def done(self, *arguments):
        result = call(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def refused(self, code, said, *arguments):
        result = call(*arguments)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertIn(said, result.stderr)

    def mesh(self, *options):
        return self.done("mesh", "v.npy", "-o", "m.vtu", "--report", "r.json", *SETTINGS, *options)

    def save(self):
        np.save("v.npy", self.volume)

    def expect_fresh(self):
        """m.vtu is what a run that begins afresh writes."""
        self.done("mesh", "v.npy", "-o", "fresh.vtu", "--order", "colour", *SETTINGS)
        self.assertEqual(content_of("m.vtu"), content_of("fresh.vtu"))

    def remesh(self):
        with open("r.json", encoding="utf-8") as file:
            return json.load(file)["engine"]["remesh"]

    def visited(self):
        return sum(march["visited"] for march in self.remesh()["marches"])

    def test_chain_of_edits(self):
        self.mesh("--keep", "k")
        self.expect_fresh()
        everything = self.visited()
        rng = random.Random(5)
        for step in range(5):
            x, y, z = (rng.randrange(n - 3) for n in (30, 26, 22))
            label = (int(self.volume[z, y, x]) + 10) % 200 + step % 2  # every second one is new
            self.volume[z:z + 3, y:y + 3, x:x + 3] = label
            self.save()
            self.mesh("--from", "k", "--changed", f"{x},{y},{z},{x + 3},{y + 3},{z + 3}",
                      "--threads", str(1 + step % 3))
            self.expect_fresh()
            self.assertGreater(self.visited(), 0)
            self.assertLess(self.visited(), everything)
        self.mesh("--from", "k")
        self.assertEqual(self.visited(), 0)
        self.expect_fresh()

    def test_several_boxes_and_a_small_budget(self):
        self.mesh("--keep", "k")
        self.volume[2, 3, 4] = 7
        self.volume[20:, 20:, 20:] = 11
        self.save()
        self.mesh("--from", "k", "--changed", "4,3,2,5,4,3", "--changed", "20,20,20,30,26,22",
                  "--memory", "80MiB", "--threads", "4")
        self.expect_fresh()

    def test_a_folder_that_may_not_hold_all(self):
        self.mesh("--keep", "whole")
        self.mesh("--keep", "k", "--keep-bytes", "400KB", "--force")
        def taken(folder):
            return sum(file.stat().st_size for file in pathlib.Path(folder).iterdir())
        whole = taken("whole")
        self.assertLess(taken("k"), whole)
        self.volume[12:15, 3:6, 20:23] = 5
        self.save()
        self.mesh("--from", "k")
        self.expect_fresh()
        self.assertLess(taken("k"), whole)  # the limit of the first run holds
        told = self.done("mesh", "v.npy", "-o", "m.vtu", "--from", "k", "--keep-bytes", "1KB",
                         *SETTINGS)
        self.assertIn("have to stay", told.stderr)
        self.refused(2, "name it with --keep", "mesh", "v.npy", "-o", "m.vtu", "--keep-bytes", "1GB")

    def test_an_edit_that_is_not_told_is_refused(self):
        self.done("synth", "voronoi", "--shape", "72,72,72", "--labels", "20", "--seed", "1", "-o",
                  "v.npy", "--force")
        self.volume = np.load("v.npy")
        self.mesh("--keep", "k")
        self.volume[10:14, 10:14, 10:14] = 5  # in tiles of 80 x 16 x 16 voxels
        self.volume[70:, 70:, 70:] = 6
        self.save()
        before, mesh = tree_of("k"), content_of("m.vtu")
        self.refused(2, "those of the tile from 0,0,0 to 72,16,16 are not", "mesh", "v.npy", "-o",
                     "m.vtu", *SETTINGS, "--from", "k", "--changed", "70,70,70,72,72,72")
        self.assertEqual((tree_of("k"), content_of("m.vtu")), (before, mesh))
        # Counter-test: windows that are skipped wrongly give another mesh, which these tests see.
        with self.assertRaises(AssertionError):
            self.expect_fresh()
        said = self.mesh("--from", "k", "--changed", "70,70,70,72,72,72", "--changed",
                         "10,10,10,14,14,14").stdout
        self.assertIn("if nothing outside of --changed has changed", said)
        self.expect_fresh()
        self.volume[0, 0, 0] = 7
        self.save()
        self.assertNotIn("--changed", self.mesh("--from", "k").stdout)
        self.expect_fresh()

    def test_a_place_that_differs_by_rounding_is_the_one_that_was_kept(self):
        place = ("--spacing", "1.2,1.2,1.5", "--origin", "50.46883834,-3,7")
        near = ("--spacing", "1.1999999,1.2,1.5000001", "--origin", "50.4688383,-3,7")
        self.mesh("--keep", "k", *place)
        kept = content_of("m.vtu")
        self.mesh("--from", "k", *near)
        self.assertEqual(self.visited(), 0)
        self.assertEqual(content_of("m.vtu"), kept)
        self.volume[3:6, 3:6, 3:6] = 5
        self.save()
        self.mesh("--from", "k", *near)
        self.done("mesh", "v.npy", "-o", "fresh.vtu", "--order", "colour", *SETTINGS, *place)
        self.assertEqual(content_of("m.vtu"), content_of("fresh.vtu"))
        for far in (("--spacing", "1.2,1.20001,1.5", *place[2:]),
                    (*place[:2], "--origin", "50.46883834,-3,7.00001")):
            self.refused(2, "is of another run", "mesh", "v.npy", "-o", "m.vtu", *SETTINGS,
                         "--from", "k", *far)

    def test_a_folder_of_another_build_says_so(self):
        self.mesh("--keep", "k")
        path = pathlib.Path("k/settings.txt")
        path.write_text(re.sub("results = .*", "results = 0123456789abcdef", path.read_text()))
        self.refused(2, "another build of mwmesh", "mesh", "v.npy", "-o", "m.vtu", *SETTINGS,
                     "--from", "k")

    def test_files_of_others_stay(self):
        """The names of our files are everyday words."""
        for name in ("labels", "changing", "lock", "part-1", "part-00000", "part-x/thesis",
                     "part-1/labels", "data.partial-results.csv", ".x.partial-1"):
            with self.subTest(name), tempfile.TemporaryDirectory(dir=".") as folder:
                path = pathlib.Path(folder, name)
                path.parent.mkdir(exist_ok=True)
                path.write_text("precious")
                self.refused(2, "was not made by --keep", "mesh", "v.npy", "-o", "m.vtu", *SETTINGS,
                             "--keep", folder)
                self.assertEqual(path.read_text(), "precious")

    def test_boxes_without_a_voxel_are_refused(self):
        self.mesh("--keep", "k")
        for box, said in (("5,5,5,5,5,5", "has no voxel"), ("9,9,9,5,5,5", "has no voxel"),
                          ("30,0,0,40,26,22", "is outside"), ("-9,0,0,0,5,5", "is outside")):
            with self.subTest(box):
                self.refused(2, said, "mesh", "v.npy", "-o", "m.vtu", *SETTINGS, "--from", "k",
                             "--changed", box)
        crop = ("mesh", "v.npy", "-o", "c.vtu", *SETTINGS, "--crop", "0,0,0,12,12,12")
        self.done(*crop, "--keep", "c")  # an edit beside the crop changes nothing in it
        self.done(*crop, "--from", "c", "--force", "--changed", "20,20,20,22,22,22")

    def test_a_certificate_is_about_the_whole_input(self):
        self.mesh("--keep", "k")
        self.volume[4:8, 4:8, 4:8] = 10
        self.save()
        self.mesh("--from", "k", "--changed", "20,20,20,21,21,21", "--certify", "on")
        self.expect_fresh()

    def test_delta_has_the_size_of_the_mesh_that_is_written(self):
        self.mesh("--keep", "k")
        self.volume[2:4, 2:4, 2:4] = self.volume.max()
        self.save()
        self.mesh("--from", "k", "--split", "*", "--delta", "d.json")
        with open("d.json", encoding="utf-8") as delta, open("r.json", encoding="utf-8") as report:
            self.assertEqual(json.load(delta)["mesh"]["after"]["vertices"],
                             json.load(report)["output"]["vertices"])

    def test_a_crop_elsewhere_is_another_run(self):
        place = ("--origin", "0,0,0", "--crop")
        self.mesh("--keep", "k", *place, "0,0,0,15,26,22")
        self.refused(2, "first voxel was 0,0,0 and is 15,0,0", "mesh", "v.npy", "-o", "m.vtu", *SETTINGS, "--from", "k",
                     "--changed", "15,0,0,16,1,1", *place, "15,0,0,30,26,22")

    def test_an_object_that_reaches_elsewhere_is_in_another_box(self):
        self.volume = np.zeros((40, 40, 40), np.uint16)
        self.volume[10:20, 10:20, 10:20] = 5
        self.save()
        mesh = ("mesh", "v.npy", "-o", "m.vtu", *SETTINGS, "--object", "5")
        self.done(*mesh, "--keep", "k")
        at_zero = (*mesh, "--origin", "0,0,0")
        self.done(*at_zero, "--keep", "k0")
        self.volume[13:16, 13:16, 13:16] = 7
        self.save()
        self.done(*mesh, "--from", "k")  # the box is the same
        grown, moved = self.volume.copy(), np.roll(self.volume, 1, axis=0)
        grown[20:25, 12:15, 12:15] = 5
        for volume, said in ((grown, "(shape was 18,18,18 and is 18,18,23)"),
                             (moved, "(first voxel was 6,6,6 and is 6,6,7; origin was")):
            np.save("v.npy", volume)
            for more in ((), ("--delta", "d.json")):
                self.refused(2, "the one that --object finds is no longer the same " + said, *mesh,
                             "--from", "k", *more)
        self.refused(2, "no longer the same (first voxel was", *at_zero, "--from", "k0")
        self.save()
        self.done(*mesh, "--from", "k", "--delta", "d.json")

    def test_labels_below_zero_come_first_in_a_delta(self):
        self.volume = self.volume.astype(np.int16) - 100
        self.save()
        self.mesh("--keep", "k")
        self.volume[2:9, 2:9, 2:9] = 5
        self.save()
        self.mesh("--from", "k", "--delta", "d.json")
        with open("d.json", encoding="utf-8") as file:
            delta = json.load(file)
        labels = [row["label"] for row in delta["labels"]]
        self.assertEqual(labels, sorted(labels))
        self.assertTrue(labels[0] < 0 < labels[-1])
        pairs = [row["labels"] for row in delta["contacts"]]
        self.assertEqual(pairs, sorted(sorted(pair) for pair in pairs))

    def test_delta_of_other_merges(self):
        """What was meshed before was merged in its own way, whatever is merged now."""
        first, second, third = (int(label) for label in np.unique(self.volume)[:3])
        def edited():
            with open("d.json", encoding="utf-8") as file:
                delta = json.load(file)
            return delta["voxels_changed"], [row["label"] for row in delta["labels"]]
        voxels = int((self.volume == second).sum())
        self.mesh("--keep", "k", "--drop-specks", "3")
        self.mesh("--from", "k", "--merge", f"{second}={first}", "--delta", "d.json")
        merged, labels = edited()
        self.assertGreaterEqual(merged, voxels)  # and the specks
        self.assertTrue({first, second} <= set(labels))
        self.mesh("--from", "k", "--merge", f"{third},{second}={first}", "--delta", "d.json")
        self.assertEqual(edited(), (int((self.volume == third).sum()), [first, third]))
        self.mesh("--from", "k", "--delta", "d.json")
        self.assertEqual(edited()[1], [first, second, third])

    def test_delta(self):
        self.mesh("--keep", "k")
        old = self.volume.copy()
        self.volume[5:8, 6:9, 7:10] = 3
        self.save()
        self.mesh("--from", "k", "--delta", "d.json")
        with open("d.json", encoding="utf-8") as file:
            delta = json.load(file)
        changed = old != self.volume
        self.assertEqual(delta["voxels_changed"], int(changed.sum()))
        self.assertEqual(delta["box"], {"from": [7, 6, 5], "to": [10, 9, 8]})
        touched = sorted(set(old[changed]) | set(self.volume[changed]))
        self.assertEqual([row["label"] for row in delta["labels"]], touched)
        for row in delta["labels"]:
            for side, volume in (("before", old), ("after", self.volume)):
                voxels = int((volume == row["label"]).sum())
                self.assertEqual((row[side] or {"voxels": 0})["voxels"], voxels)
        new = delta["labels"][touched.index(3)]
        self.assertIsNone(new["before"])
        self.assertEqual(new["after"]["betti_closed"], [1, 0, 0])
        for row in delta["contacts"]:
            for side, volume in (("faces_before", old), ("faces_after", self.volume)):
                a, b = row["labels"]
                faces = []
                for axis in (2, 1, 0):
                    low = np.delete(volume, -1, axis)
                    high = np.delete(volume, 0, axis)
                    faces.append(int(((low == a) & (high == b) | (low == b) & (high == a)).sum()))
                self.assertEqual(row[side], faces)
        with open("r.json", encoding="utf-8") as file:
            mesh = json.load(file)["output"]
        self.assertEqual(delta["mesh"]["after"]["tets"], mesh["tets"])

    def test_an_interrupt_while_changes_are_told(self):
        self.mesh("--keep", "k")
        self.volume[5:8, 6:9, 7:10] = 3
        self.save()
        before = os.stat("m.vtu").st_ino
        # The mesh is renamed into its place, so the inode tells when it is complete.
        with subprocess.Popen([PROGRAM, "mesh", "v.npy", "-o", "m.vtu", *SETTINGS, "--from", "k",
                               "--delta", "d.json"], stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True) as run:
            while run.poll() is None and os.stat("m.vtu").st_ino == before:
                pass
            run.send_signal(signal.SIGINT)
            said = run.communicate()[1]
        if run.returncode == 0:
            return  # it was done before the signal came
        self.assertEqual(run.returncode, 75, said)
        self.assertIn("m.vtu is complete, d.json is not written", said)
        self.expect_fresh()
        self.mesh("--from", "k", "--delta", "d.json")
        with open("d.json", encoding="utf-8") as file:
            self.assertEqual(json.load(file)["box"], {"from": [7, 6, 5], "to": [10, 9, 8]})

    def test_kills_in_between(self):
        rng = random.Random(7)
        start = time.monotonic()
        self.mesh("--keep", "whole")
        seconds = time.monotonic() - start
        kept = ["--keep", "k", "--resume"]
        killed, untold = 0, []
        for step in range(8):
            x, y, z = (rng.randrange(n - 4) for n in (30, 26, 22))
            self.volume[z:z + 4, y:y + 4, x:x + 4] = 10 * rng.randrange(20) + rng.randrange(2)
            self.save()
            boxes = [*untold, "--changed", f"{x},{y},{z},{x + 4},{y + 4},{z + 4}"]
            with subprocess.Popen([PROGRAM, "mesh", "v.npy", "-o", "m.vtu", "--save-every", "0",
                                   *SETTINGS, *kept, *(boxes if step > 1 and
                                                       kept[0] == "--from" else [])],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as run:
                time.sleep(rng.random() * seconds * 1.1)
                run.send_signal(signal.SIGKILL)
            killed += run.returncode == -signal.SIGKILL
            # A run that was killed before it began leaves no boxes.
            untold = [] if os.path.exists("k/changing") else boxes
            if step % 2 == 0:
                self.mesh(*kept, *(boxes if kept[0] == "--from" else []))
                self.expect_fresh()
                untold = []
                kept = ["--from", "k"]
        self.assertGreater(killed, 2)

    def test_refusals(self):
        self.refused(2, "begin it by --keep", "mesh", "v.npy", "-o", "m.vtu", "--from", "k")
        self.refused(2, "needs --order colour", "mesh", "v.npy", "-o", "m.vtu", "--keep", "k",
                     "--order", "raster")
        self.refused(2, "an edit anywhere", "mesh", "v.npy", "-o", "m.vtu", "--keep", "k",
                     "--count", "1000")
        self.assertFalse(os.path.exists("k"))
        self.refused(2, "give --from", "mesh", "v.npy", "-o", "m.vtu", "--changed", "0,0,0,1,1,1")
        self.refused(2, "give one of the two", "mesh", "v.npy", "-o", "m.vtu", "--keep", "k",
                     "--from", "l")
        self.mesh("--keep", "k")
        self.refused(2, "go on with it by --from", "mesh", "v.npy", "-o", "m.vtu", *SETTINGS,
                     "--keep", "k")
        self.refused(2, "max-distance was 1.5 and is 2", "mesh", "v.npy", "-o", "m.vtu", *SETTINGS,
                     "--from", "k", "--max-distance", "2")
        np.save("v.npy", self.volume[1:])
        self.refused(2, "shape was 30,26,22 and is 30,26,21", "mesh", "v.npy", "-o", "m.vtu",
                     *SETTINGS, "--from", "k")

    def test_a_refused_run_leaves_nothing(self):
        rng = np.random.default_rng(1)
        np.save("n.npy", rng.integers(0, 200, (32, 32, 32)).astype(np.uint8))
        for code, *options in ((2, "--labels", "7777"), (2, "--size", "7777=3"),
                               (4, "--memory", "10MiB"), (4, "--memory", "50MiB")):
            self.refused(code, "", "mesh", "n.npy", "-o", "n.vtu", "--keep", "n", *options)
            self.assertFalse(os.path.exists("n"), options)
        self.mesh("--keep", "kept")
        for code, *options in ((2, "--max-distance", "1"), (2, "--labels", "7777"),
                               (4, "--memory", "10MiB")):
            self.refused(code, "", "mesh", "v.npy", "-o", "m.vtu", "--from", "kept", *SETTINGS,
                         *options)
            self.assertFalse(os.path.exists("kept/changing"), options)

    def test_damage_is_told(self):
        self.mesh("--keep", "k")
        with open("k/versions", "r+b") as file:
            content = file.read()
            file.seek(0)
            file.write(bytes(len(content)))
        self.volume[3, 3, 3] = 99
        self.save()
        self.refused(3, "delete that folder", "mesh", "v.npy", "-o", "m.vtu", *SETTINGS, "--from",
                     "k")

    def test_damage_of_kept_labels_is_told(self):
        for name in ("labels", "changing"):
            self.mesh("--keep", name)
            damaged = content_of("labels/labels")[:-40] + b"x" * 40
            with open(f"{name}/{name}", "wb") as file:
                file.write(damaged)
            with self.subTest(name):
                self.refused(3, f"or {name} is damaged: delete that folder", "mesh", "v.npy", "-o",
                             "m.vtu", *SETTINGS, "--from", name, "--changed", "0,0,0,1,1,1",
                             "--delta", "d.json")

    def test_files_of_two_folders_mixed(self):
        """What is of another volume is refused, or makes no difference."""
        self.mesh("--keep", "a")
        first = self.volume.copy()
        self.volume[10:14, 10:14, 10:14] = 5
        self.save()
        self.mesh("--keep", "b")
        self.volume = first
        self.volume[3, 3, 3] = 99
        self.save()
        names = ("number.txt", "windows", "labels", "versions")
        for chosen in itertools.product((False, True), repeat=len(names)):
            mixed = list(itertools.compress(names, chosen))
            with self.subTest(mixed):
                shutil.rmtree("k", ignore_errors=True)
                shutil.copytree("a", "k")
                for name in mixed:
                    shutil.copy(f"b/{name}", f"k/{name}")
                done = call("mesh", "v.npy", "-o", "m.vtu", *SETTINGS, "--from", "k", "--changed",
                            "3,3,3,4,4,4")
                if len(set(chosen[:3])) > 1:
                    self.assertEqual(done.returncode, 3, done.stderr)
                if done.returncode == 0:
                    self.expect_fresh()
                else:
                    self.assertEqual(done.returncode, 3, done.stderr)
                    self.assertIn("k is damaged: delete that folder", done.stderr)

    def save_mask(self, name, *boxes):
        """Writes a NRRD that is 1 in boxes (x0, y0, z0, x1, y1, z1)."""
        mask = np.zeros((22, 26, 30), np.uint8)
        for x0, y0, z0, x1, y1, z1 in boxes:
            mask[z0:z1, y0:y1, x0:x1] = 1
        os.makedirs("v.npy", exist_ok=True)  # what mesh() meshes is a folder
        header = ("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 30 26 22\nencoding: raw\n"
                  "endian: little\n\n")
        with open(f"v.npy/{name}.nrrd", "wb") as file:
            file.write(header.encode() + mask.tobytes())

    def test_masks_that_get_other_numbers(self):
        """All labels are read, whatever --changed says."""
        os.remove("v.npy")
        boxes = {"a": (2, 2, 2, 12, 12, 12), "b": (18, 14, 3, 28, 24, 12),
                 "c": (20, 10, 5, 26, 18, 20)}
        for name, box in boxes.items():
            self.save_mask(name, box)
        options = ("--overlap", "all", "--background", "0")
        self.mesh("--keep", "k", "--order", "colour", *options)
        edits = {"b": (boxes["b"], (4, 4, 4, 7, 7, 7)), "aa": ((26, 2, 18, 29, 6, 21),)}
        for name, edit in edits.items():  # "a + b" comes before "b + c", and "aa" before "b"
            self.save_mask(name, *edit)
            said = self.mesh("--from", "k", "--changed", ",".join(map(str, edit[-1])), "--delta",
                             "d.json", *options).stderr
            self.assertIn("labels have other numbers", said)
            self.done("mesh", "v.npy", "-o", "fresh.vtu", "--order", "colour", *SETTINGS, *options)
            self.assertEqual(content_of("m.vtu"), content_of("fresh.vtu"))
            with open("d.json", encoding="utf-8") as file:
                self.assertTrue(json.load(file)["renumbered"])
        self.save_mask("c", boxes["c"], (2, 20, 2, 6, 24, 6))
        said = self.mesh("--from", "k", "--changed", "2,20,2,6,24,6", "--delta", "d.json",
                         *options).stderr
        self.assertNotIn("other numbers", said)
        with open("d.json", encoding="utf-8") as file:
            self.assertFalse(json.load(file)["renumbered"])

    def test_boxes_of_a_crop_count_voxels_of_the_file(self):
        crop = ("--crop", "4,3,2,30,26,22")
        self.mesh("--keep", "k", *crop)
        self.volume[5:8, 6:9, 7:10] = 3
        self.save()
        self.mesh("--from", "k", "--changed", "7,6,5,10,9,8", "--delta", "d.json", *crop)
        with open("d.json", encoding="utf-8") as file:
            delta = json.load(file)
        self.assertEqual(delta["box"], {"from": [7, 6, 5], "to": [10, 9, 8]})
        self.assertEqual(delta["voxels_changed"], 27)

    def test_a_delta_that_is_not_written_is_told_again(self):
        self.mesh("--keep", "k")
        self.volume[5:8, 6:9, 7:10] = 3
        self.save()
        # The place of the delta is taken by a folder once the run has begun to mesh.
        with subprocess.Popen([PROGRAM, "mesh", "v.npy", "-o", "m.vtu", *SETTINGS, "--from", "k",
                               "--delta", "d.json"], stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True) as run:
            while run.poll() is None and not os.path.exists("k/changing"):
                pass
            try:
                os.makedirs("d.json/taken")
            except (FileExistsError, NotADirectoryError):
                return  # it was done before the folder came
            said = run.communicate()[1]
        self.assertNotEqual(run.returncode, 0, said)
        self.assertIn("still has the labels before", said)
        os.removedirs("d.json/taken")
        self.mesh("--from", "k", "--delta", "d.json")
        with open("d.json", encoding="utf-8") as file:
            self.assertEqual(json.load(file)["box"], {"from": [7, 6, 5], "to": [10, 9, 8]})


if __name__ == "__main__":
    unittest.main()
