#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Parts and hinges that are told, left out and opened; a split interface that CalculiX pulls open."""
import json
import pathlib
import shutil
import subprocess
import sys
import unittest

from program import PROGRAM, enter_folder, pull, run

try:
    from reading_meshio import meshio
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)


def fails(*arguments):
    """Returns the exit code and what was said."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def report(path):
    return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))


class Parts(unittest.TestCase):
    """A block of labels 1 and 2, a block that hangs on its edge, one on a corner, two free ones."""

    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        v = np.zeros((22, 22, 22), np.uint8)  # [z, y, x]
        v[2:10, 2:10, 2:10] = 1
        v[2:10, 2:10, 6:10] = 2
        v[2:10, 10:14, 10:14] = 1  # an edge of the block
        v[10:14, 10:14, 2:6] = 3   # another edge, of the corner block's
        v[16:20, 2:6, 2:6] = 2
        v[16:20, 16:20, 16:20] = 4
        np.save("v.npy", v)
        run("mesh", "v.npy", "-o", "m.vtu", "--background", 0, "--report", "m.json",
            "--surface", "voxel", "--certify", "on", "--memory", "1GiB")

    def test_are_told(self):
        out = run("mesh", "v.npy", "-o", "again.vtu", "--background", 0, "--surface", "voxel")
        self.assertIn("\nnote        2 of 5 parts hang on the others by a vertex or an edge alone", out)
        told = report("m.json")["parts"]
        self.assertEqual((told["found"], told["written"], told["hanging"], told["free"]), (5, 5, 2, 2))
        self.assertGreater(told["hinge_edges"], 0)
        self.assertEqual(len(told["others"]), 4)
        free = {part["label"]: part["place"] for part in told["others"] if part["free"]}
        self.assertEqual(set(free), {2, 4})
        self.assertTrue(all(15.5 < x < 20.5 for x in free[4]), free)
        for hinge in told["hinges"]:
            self.assertTrue(set(hinge["labels"]) <= {1, 2, 3})
        info = json.loads(run("info", "m.vtu", "--json"))["parts"]
        self.assertEqual(info, {k: v for k, v in told.items() if k not in ("found", "doubled")})

    def test_one_part_is_not_told(self):
        self.assertNotIn(" hang", run("mesh", "v.npy", "-o", "all.vtu", "--surface", "voxel"))

    def test_volumes_say_that_parts_are_left_out(self):
        v = np.zeros((24, 14, 14), np.uint8)
        v[2:12, 2:12, 2:12] = v[14:22, 2:10, 2:10] = 1
        np.save("two.npy", v)
        for rule, is_told in (("all", False), ("largest", True)):
            said = run("mesh", "two.npy", "-o", "two.vtu", "--force", "--background", 0, "--parts", rule,
                       "--html", "two.html")
            line = next(x for x in said.splitlines() if x.startswith("volumes "))
            self.assertEqual("without the parts that are left out" in line, is_told, line)
            page = pathlib.Path("two.html").read_text(encoding="utf-8")
            self.assertEqual("without the parts that are left out" in page, is_told)

    def test_those_that_are_asked_for_are_kept(self):
        for rule, parts, labels in (("largest", 1, {1, 2}), (1, 5, {1, 2, 3, 4})):
            for name in ("p.vtu", "p.vtkhdf", "p.mesh"):
                said = run("mesh", "v.npy", "-o", name, "--background", 0, "--parts", rule,
                           "--report", "p.json", "--surface", "voxel", "--certify", "on",
                           "--memory", "1GiB")
                line = next((x for x in said.splitlines() if x.startswith("parts ")), "")
                told = report("p.json")
                self.assertEqual(told["parts"]["written"], parts)
                info = json.loads(run("info", name, "--json"))
                self.assertEqual(info["parts"]["written"], parts)
                self.assertEqual((info["tets"], info["vertices"], info["digest"]),
                                 (told["output"]["tets"], told["output"]["vertices"],
                                  told["digest"]))
                self.assertEqual({row["label"] for row in info["volume"]["per_label"]}, labels)
                out = run("verify", "v.npy", name)
                kept = "1 of 5 that faces join are written" in line
                self.assertEqual(kept, parts == 1, line)
                self.assertEqual("without parts of label 1, 2, 3, 4" in out, parts == 1, out)
        self.assertEqual(report("p.json")["parts"]["doubled"]["copies"], 0)

    def test_verify_knows_what_was_left_out(self):
        """Of a label that is there in part nothing may be added; others are judged in full."""
        run("mesh", "v.npy", "-o", "p.vtu", "--background", 0, "--parts", "largest")
        v = np.load("v.npy")
        cavity = v.copy()
        cavity[5, 5, 4] = 2
        np.save("cavity.npy", cavity)
        run("mesh", "cavity.npy", "-o", "cavity.vtu", "--background", 0, "--parts", "largest")
        code, out = fails("verify", "v.npy", "cavity.vtu")
        self.assertEqual(code, 5, out)
        self.assertIn("FAIL  P1 topology", out)
        two = v.copy()
        two[v == 1] = 2
        two[2:4, 2:4, 2:4] = 5  # in the largest part, and all of it
        np.save("two.npy", two)
        run("mesh", "two.npy", "-o", "two.vtu", "--background", 0, "--parts", "largest")
        run("verify", "two.npy", "two.vtu")
        other = two.copy()
        other[2:4, 2:4, 2:4] = 2
        other[20, 20, 20] = 5
        np.save("other.npy", other)
        code, out = fails("verify", "other.npy", "two.vtu")
        self.assertEqual(code, 5, out)

    def test_hinges_are_opened(self):
        run("mesh", "v.npy", "-o", "o.vtu", "--background", 0, "--open-hinges", "--report", "o.json",
            "--surface", "voxel")
        told, info = report("o.json")["parts"], json.loads(run("info", "o.vtu", "--json"))
        self.assertGreater(told["doubled"]["copies"], 0)
        self.assertEqual(told["hanging"], 2)  # before
        self.assertEqual((info["parts"]["hanging"], info["parts"]["free"]), (0, 4))
        self.assertEqual(info["doubled_vertices"], told["doubled"]["copies"])
        self.assertEqual((info["parts"]["hinge_vertices"], info["parts"]["hinge_edges"]), (0, 0))
        self.assertIn("doubled vertices are merged", run("verify", "v.npy", "o.vtu"))

    def test_rules_that_make_no_sense_are_refused(self):
        for option, value, what in (("parts", "most", "largest"), ("parts", 0, "largest"),
                                    ("parts", 10**9, "the largest has"),
                                    ("split", "1|77", "no label 77"), ("split", "1", "pairs")):
            code, out = fails("mesh", "v.npy", "-o", "no.vtu", f"--{option}", value)
            self.assertEqual(code, 2, out)
            self.assertIn(what, out)
            self.assertFalse(pathlib.Path("no.vtu").exists())

    def test_labels_that_do_not_meet_are_told(self):
        code, out = fails("mesh", "v.npy", "-o", "apart.vtu", "--background", 0, "--split", "1|2,3|4",
                          "--cohesive", "4|2", "--report", "apart.json")
        self.assertEqual(code, 0, out)
        self.assertIn("2|4, 3|4: these labels share no face", out)
        self.assertEqual(report("apart.json")["parts"]["doubled"]["labels_that_do_not_meet"],
                         [[2, 4], [3, 4]])
        code, out = fails("mesh", "v.npy", "-o", "twice.vtu", "--split", "1|2,2|1", "--cohesive",
                          "1|2")
        self.assertEqual(code, 0, out)
        self.assertNotIn("share no face", out)

    def test_facets_that_cannot_open_are_told(self):
        """Labels 1 and 2 meet at one face of a voxel, amid label 3; 4 and 5 at a large interface."""
        v = np.ones((9, 9, 24), np.uint8)  # [z, y, x]
        v[:, :, 6:12] = 2
        v[:, :, 4:8] = 3
        v[4, 4, 4:6], v[4, 4, 6:8] = 1, 2
        v[:, :, 12:] = 4
        v[4:, :, 12:] = 5
        np.save("held.npy", v)
        run("mesh", "held.npy", "-o", "held.vtu")
        whole = run("digest", "held.vtu")
        for options, held, said in ((("--split", "1|2"), True, "of --split cannot open"),
                                    (("--cohesive", "1|2"), True, "0 cohesive wedges, none on"),
                                    (("--split", "1|2,4|5"), False, "of --split cannot open"),
                                    (("--split", "1|2", "--cohesive", "4|5"), False,
                                     "of --split cannot open"),
                                    (("--split", "4|5"), False, "")):
            code, out = fails("mesh", "held.npy", "-o", "held.vtu", "--force", "--report",
                              "held.json", *options)
            self.assertEqual(code, 0, out)
            self.assertIn(said, out)
            self.assertEqual("nothing opens" in out, held, out)
            self.assertEqual("cannot open" in out, said != "", out)
            self.assertEqual(run("digest", "held.vtu") == whole, held)
            told = report("held.json")["parts"]["doubled"]
            self.assertEqual(told["facets_that_cannot_open"] > 0, said != "")
            self.assertEqual(told["facets_that_cannot_open"] == told["facets"], held)
            self.assertEqual(told["facets_without_wedge"] > 0, options[0] == "--cohesive")
        run("mesh", "held.npy", "-o", "held.vtu", "--force", "--report", "held.json", "--split",
            "1|2", "--size", "1|2=0.5")
        told = report("held.json")["parts"]["doubled"]
        self.assertLess(told["facets_that_cannot_open"], told["facets"])

    def test_the_same_bytes_for_any_threads(self):
        for threads in (1, 3):
            run("mesh", "v.npy", "-o", f"t{threads}.vtu", "--background", 0, "--parts", 30, "--split",
                "*", "--open-hinges", "--threads", threads)
        self.assertEqual(pathlib.Path("t1.vtu").read_bytes(), pathlib.Path("t3.vtu").read_bytes())


class Split(unittest.TestCase):
    """Three grains: 1 | 2 is split, 3 lies across both."""

    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        v = np.ones((8, 8, 12), np.uint8)
        v[:, :, 6:] = 2
        v[5:, :, :] = 3
        np.save("three.npy", v)
        run("mesh", "three.npy", "-o", "three.vtu", "--names", cls.names(), "--split", "left|2",
            "--report", "three.json", "--spacing", "1,2,1", "--origin", "5,0,-3")
        np.save("two.npy", v[:5])

    @staticmethod
    def names():
        pathlib.Path("names.csv").write_text("id,name\n1,left\n", encoding="utf-8")
        return "names.csv"

    def test_only_the_chosen_interface_comes_apart(self):
        told = report("three.json")["parts"]
        mesh = meshio.read("three.vtu")
        labels = mesh.cell_data_dict["label"]["tetra"].ravel()
        tets = mesh.cells_dict["tetra"]
        rows = {label: set(tets[labels == label].ravel()) for label in (1, 2, 3)}
        for a, b, joined in ((1, 3, True), (2, 3, True)):
            self.assertEqual(bool(rows[a] & rows[b]), joined)
        shared = rows[1] & rows[2]
        self.assertTrue(shared <= rows[3])  # the end of the crack
        places = {label: {tuple(mesh.points[r]) for r in rows[label]} for label in (1, 2)}
        both = places[1] & places[2]
        self.assertEqual(len(both) - len(shared), told["doubled"]["copies"])
        self.assertGreater(len(shared), 0)
        self.assertEqual(told["doubled"]["parts_after"], 1)
        self.assertIn("all checks hold", run("verify", "three.npy", "three.vtu", "--spacing", "1,2,1",
                                             "--origin", "5,0,-3"))

    def test_contacts_and_volumes_stay(self):
        run("mesh", "three.npy", "-o", "whole.vtu", "--spacing", "1,2,1", "--origin", "5,0,-3")
        one, other = (json.loads(run("info", name, "--json", "--contacts"))
                      for name in ("three.vtu", "whole.vtu"))
        self.assertEqual(one["contacts"], other["contacts"])
        self.assertEqual(one["shape"], other["shape"])
        self.assertEqual(one["volume"]["total"], other["volume"]["total"])

    def test_every_format_has_both_sides(self):
        for name in ("t.inp", "t.msh", "t.exo", "t.bdf", "t.feb", "t.vtkhdf", "t.mesh", "t.xdmf"):
            run("convert", "three.vtu", name)
        for name in ("t.vtkhdf", "t.mesh", "t.msh"):
            self.assertEqual(run("digest", name), run("digest", "three.vtu"))
        sets = meshio.read("t.inp").point_sets
        one, other = sets["FACE_left_2"], sets["FACE_2_left"]
        points = meshio.read("t.inp").points
        self.assertEqual(len(one), len(other))
        self.assertFalse(set(one) == set(other))
        np.testing.assert_array_equal(np.unique(points[one], axis=0),
                                      np.unique(points[other], axis=0))

    @unittest.skipUnless(shutil.which("ccx"), "no CalculiX")
    def test_calculix_pulls_two_grains_apart(self):
        """With nothing between them both move as they are held and no force is needed; tied again
        node by node they are as stiff as the mesh that was not split."""
        for element in ("tet4", "tet10"):
            run("mesh", "two.npy", "-o", "s.inp", "--split", "1|2", "--element", element)
            run("mesh", "two.npy", "-o", "w.inp", "--element", element)
            split = meshio.read("s.inp")
            one, other = (np.asarray(split.point_sets[name]) for name in ("FACE_1_2", "FACE_2_1"))
            self.assertEqual(len(one), len(other))
            self.assertFalse(set(one) & set(other))
            order = [np.lexsort(split.points[rows].T) for rows in (one, other)]
            pairs = list(zip(one[order[0]], other[order[1]]))
            for a, b in pairs:
                np.testing.assert_array_equal(split.points[a], split.points[b])
            open_force = pull("s", "", 0.3, "X_MIN")
            ties = "".join(f"*EQUATION\n2\n{a + 1}, {k}, 1., {b + 1}, {k}, -1.\n"
                           for a, b in pairs for k in (1, 2, 3))
            tied, whole = pull("s", ties, 0.3, "X_MIN"), pull("w", "", 0.3, "X_MIN")
            self.assertGreater(abs(whole[0]), 10)
            np.testing.assert_allclose(open_force, 0, atol=1e-6 * abs(whole[0]))
            np.testing.assert_allclose(tied, whole, rtol=1e-4, atol=1e-4 * abs(whole[0]))


if __name__ == "__main__":
    unittest.main(verbosity=2)
