#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Decks as they are written: solved by CalculiX beside theory; FEBio's by their elements of XML."""
import csv
import os
import shutil
import subprocess
import sys
import unittest
from xml.etree import ElementTree

from program import enter_folder, refused, run

try:
    from reading_meshio import meshio
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

MODULUS, RATIO, STRAIN = 1000.0, 0.3, 0.01  # of the placeholders, and of the pull


def solve(job):
    """{"NODE": places, "DISP": ..., "STRESS": ...} by node, as CalculiX's .frd file has them."""
    done = subprocess.run(["ccx", job], capture_output=True, text=True)
    assert done.returncode == 0 and "*ERROR" not in done.stdout, done.stdout[-2000:]
    out, rows = {}, None
    with open(f"{job}.frd", encoding="ascii") as file:
        for line in file:
            if line.startswith("    2C"):
                rows = out.setdefault("NODE", {})
            elif line.startswith(" -4"):
                rows = out.setdefault(line.split()[1], {})
            elif line.startswith(" -1") and rows is not None:
                numbers = [float(line[i:i + 12]) for i in range(13, len(line.rstrip()), 12)]
                rows[int(line[3:13])] = numbers
            elif line.startswith(" -3"):
                rows = None
    nodes = sorted(out["NODE"])
    return {name: np.array([rows[n] for n in nodes]) for name, rows in out.items()
            if set(rows) >= set(nodes)}


class Decks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        cls.shape = (40, 6, 5)
        labels = np.ones(cls.shape, np.uint8)
        labels[:17] = 2
        labels[10:14, 2:4, 2:4] = 3
        np.save("bar.npy", labels)
        np.save("ct.npy", np.broadcast_to(np.arange(40.0)[:, None, None], cls.shape).copy())

    @unittest.skipUnless(shutil.which("ccx"), "no CalculiX")
    def test_a_bar_of_one_stiffness_is_pulled_as_theory_says(self):
        """Between ends that are held the stress is E times strain, a little more since the ends
        cannot contract, and less than the modulus under no contraction at all; without contraction
        (Poisson's ratio 0) it is E times strain everywhere."""
        run("mesh", "bar.npy", "-o", "bar.inp", "--element", "tet10", "--deck", "static")
        found = solve("bar")
        z = found["NODE"][:, 2]
        self.assertEqual(abs(found["DISP"][z == 0, :3]).max(), 0)
        np.testing.assert_allclose(found["DISP"][z == 40, 2], STRAIN * 40, rtol=1e-6)
        self.assertEqual(abs(found["DISP"][z == 40, :2]).max(), 0)
        middle = (z > 14) & (z < 26)
        stress = found["STRESS"][middle, 2].mean()
        bound = MODULUS * (1 - RATIO) / (1 + RATIO) / (1 - 2 * RATIO)
        print(f"mean stress {stress:.4f}, uniaxial {MODULUS * STRAIN}, at most {bound * STRAIN:.4f}")
        self.assertGreater(stress, MODULUS * STRAIN * (1 - 1e-4))
        self.assertLess(stress, 1.03 * MODULUS * STRAIN)
        self.assertLess(abs(found["STRESS"][middle][:, [0, 1]]).max(), 0.02 * MODULUS * STRAIN)

        with open("bar.inp", encoding="ascii") as file:
            text = file.read()
        self.assertEqual(text.count("1000, 0.3\n"), 3)
        with open("flat.inp", "w", encoding="ascii") as file:
            file.write(text.replace("1000, 0.3\n", "1000, 0\n"))
        found = solve("flat")
        np.testing.assert_allclose(found["STRESS"][:, 2], MODULUS * STRAIN, rtol=1e-3)
        np.testing.assert_allclose(found["DISP"][:, 2], STRAIN * found["NODE"][:, 2], atol=1e-5)

    @unittest.skipUnless(shutil.which("ccx"), "no CalculiX")
    def test_each_material_has_a_section(self):
        image = np.load("ct.npy")
        image[:4] = np.nan
        np.save("part.npy", image)
        run("mesh", "bar.npy", "-o", "bins.inp", "--sample", "hu=part.npy", "--materials", "hu=9",
            "--deck", "static")
        with open("bins.inp.materials.csv", newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["set"]]
        with open("bins.inp", encoding="ascii") as file:
            lines = file.read().splitlines()
        sections = [line.split("ELSET=")[1].split(",")[0] for line in lines
                    if line.startswith("*SOLID SECTION")]
        self.assertEqual(sections, [row["set"] for row in rows] + ["hu_none"])
        self.assertIn(f"** hu_3: the mean of hu is {float(rows[2]['mean']):.3f}"[:31],
                      "\n".join(lines))
        found = solve("bins")
        np.testing.assert_allclose(found["DISP"][:, 2].max(), STRAIN * 40, rtol=1e-6)
        # Layers in series: moduli of 1000 below, 3000 above.
        half = len(rows) // 2
        text = "\n".join(lines).replace("1000, 0.3", "1000, 0")
        for row in rows[half:]:
            text = text.replace(f"*MATERIAL, NAME={row['set']}\n*ELASTIC\n1000,",
                                f"*MATERIAL, NAME={row['set']}\n*ELASTIC\n3000,")
        with open("series.inp", "w", encoding="ascii") as file:
            file.write(text + "\n")
        stress = solve("series")["STRESS"][:, 2].mean()
        stiff = sum(float(row["volume"]) for row in rows[half:]) / np.prod(self.shape)
        series = STRAIN / (stiff / 3000 + (1 - stiff) / 1000)
        print(f"stress {stress:.3f}, in series {series:.3f}")
        self.assertLess(abs(stress / series - 1), 0.05)

    @unittest.skipUnless(shutil.which("ccx"), "no CalculiX")
    def test_a_turned_part_that_reaches_no_side(self):
        """Its lowest and highest twentieths are the ends, along the box's own z."""
        nibabel = __import__("nibabel")
        labels = np.zeros((12, 12, 24), np.uint8)  # x, y, z
        labels[3:9, 3:9, 2:22] = 7
        turn = np.array([[1, 0, 0], [0, 0.6, -0.8], [0, 0.8, 0.6]])
        affine = np.eye(4)
        affine[:3, :3] = turn
        nibabel.save(nibabel.Nifti1Image(labels, affine), "turned.nii")
        run("mesh", "turned.nii", "-o", "turned.inp", "--background", "0", "--deck", "static")
        found = solve("turned")
        along = found["NODE"] @ turn[:, 2]
        lo, hi = along.min(), along.max()
        held = along <= lo + 0.05 * (hi - lo)
        self.assertEqual(abs(found["DISP"][held, :3]).max(), 0)
        pulled = along >= hi - 0.05 * (hi - lo)
        self.assertGreater(min(held.sum(), pulled.sum()), 3)
        wanted = np.tile(0.01 * (hi - lo) * turn[:, 2], (pulled.sum(), 1))
        np.testing.assert_allclose(found["DISP"][pulled, :3], wanted, rtol=1e-4, atol=1e-6)

    def test_febio(self):
        """Structure of febio_spec 4.0: sections in their order, names that are there."""
        for arguments, sides in (((), True), (("--background", "2"), False)):
            run("mesh", "bar.npy", "-o", "bar.feb", "--deck", "static", *arguments)
            model = ElementTree.parse("bar.feb").getroot()
            self.assertEqual([section.tag for section in model],
                             ["Module", "Material", "Mesh", "MeshDomains", "Boundary", "Step",
                              "LoadData", "Output"])
            names = {f"@surface:{s.get('name')}" for s in model.iterfind("Mesh/Surface")}
            names |= {s.get("name") for s in model.iterfind("Mesh/NodeSet")}
            (held,) = model.iterfind("Boundary/bc")
            self.assertEqual((held.get("type"), [dof.text for dof in held]),
                             ("zero displacement", ["1", "1", "1"]))
            (step,) = model.iterfind("Step/step")
            self.assertEqual([part.tag for part in step], ["Control", "Boundary"])
            self.assertEqual(step.find("Control/analysis").text, "STATIC")
            total = int(step.find("Control/time_steps").text) * float(
                step.find("Control/step_size").text)
            self.assertAlmostEqual(total, 1)
            pulled = step.findall("Boundary/bc")
            self.assertEqual([bc.find("dof").text for bc in pulled], list("xyz"))
            height = 40 if sides else 30  # label 3 begins at 10
            shift = [float(bc.find("value").text) for bc in pulled]
            np.testing.assert_allclose(shift, [0, 0, STRAIN * height], rtol=0.05)
            curves = {c.get("id") for c in model.iterfind("LoadData/load_controller")}
            for bc in pulled:
                self.assertEqual(bc.get("type"), "prescribed displacement")
                self.assertIn(bc.find("value").get("lc"), curves)
            for bc in [held, *pulled]:
                self.assertIn(bc.get("node_set"), names)
                self.assertEqual(bc.get("node_set").startswith("@surface:"), sides)
            points = np.array([[float(x) for x in node.text.split(",")]
                               for node in model.iterfind("Mesh/Nodes/node")])
            for nodes in model.iterfind("Mesh/NodeSet"):
                z = points[np.array([int(n) for n in nodes.text.split(",")]) - 1][:, 2]
                low = nodes.get("name") == "deck_low"
                self.assertTrue((z <= 12).all() if low else (z >= 38).all())
            curve = [pt.text for pt in model.iterfind("LoadData/load_controller/points/pt")]
            self.assertEqual(curve, ["0,0", "1,1"])

    def test_without_a_deck_nothing_is_added(self):
        run("mesh", "bar.npy", "-o", "bar.vtu")
        self.assertEqual(meshio.read("bar.vtu").cells[0].type, "tetra")
        for ending, words in (("inp", ("*STEP", "*MATERIAL")), ("feb", ("<Step>", "<Boundary>"))):
            run("convert", "bar.vtu", f"plain.{ending}")
            run("convert", "bar.vtu", f"deck.{ending}", "--deck", "static")
            with open(f"plain.{ending}", encoding="utf-8") as file:
                plain = file.read()
            with open(f"deck.{ending}", encoding="utf-8") as file:
                deck = file.read()
            for word in words:
                self.assertNotIn(word, plain)
                self.assertIn(word, deck)
        refused(["--deck is for .inp, .feb"], "mesh", "bar.npy", "-o", "bar.vtu", "--deck", "static",
                code=2)

    def test_a_mesh_alone_says_how_it_becomes_a_job(self):
        hint = "is a mesh alone: --deck static makes it a job"
        for name, options, says in (("a.inp", (), True), ("a.feb", (), True), ("a.vtu", (), False),
                                    ("b.inp", ("--deck", "static"), False)):
            with self.subTest(name=name):
                said = run("mesh", "bar.npy", "-o", name, *options)
                self.assertEqual(hint in said, says, said)

    def test_there_is_none_with_cohesive_wedges(self):
        run("mesh", "bar.npy", "-o", "wedges.vtu", "--cohesive", "1|2")
        for first in (("mesh", "bar.npy", "-o", "no.inp", "--cohesive", "1|2"),
                      ("convert", "wedges.vtu", "no.inp")):
            refused(["give --split"], *first, "--deck", "static", code=2)
            self.assertFalse(os.path.exists("no.inp"))


if __name__ == "__main__":
    unittest.main()
