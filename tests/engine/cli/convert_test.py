#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""What convert makes of a mesh of yesterday is what mesh makes of its volume."""
import sys
import unittest

from program import enter_folder, refused, run

try:
    from reading_meshio import meshio
    import nibabel
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)


class Convert(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        x, y, z = np.ogrid[:20, :18, :16]
        labels = (x + y > 17).astype(np.uint8).T + 2 * (x - y + z > 9).T  # 0 to 3, [z, y, x]
        labels[2:5, 2:5, 2:5] = 9  # two parts of a label that is nowhere else
        labels[11:14, 11:14, 11:14] = 9
        affine = np.diag([1.0, 1.0, 1.0, 1.0])
        nibabel.save(nibabel.Nifti1Image(labels.T.astype(np.int16), affine), "v.nii")
        grey = np.random.default_rng(5).random((20, 18, 16)).astype(np.float32)
        nibabel.save(nibabel.Nifti1Image(grey, affine), "grey.nii")
        np.save("grey.npy", grey.T)
        run("mesh", "v.nii", "-o", "m.vtu")

    def expect_same(self, *options):
        run("convert", "m.vtu", "c.vtu", *options)
        run("mesh", "v.nii", "-o", "w.vtu", *options)
        self.assertEqual(run("digest", "c.vtu"), run("digest", "w.vtu"), options)
        run("verify", "v.nii", "c.vtu")
        return meshio.read("c.vtu"), meshio.read("w.vtu")

    def test_leaves_labels_out(self):
        whole = meshio.read("m.vtu")
        for options in (("--background", 1), ("--labels", "1,9"), ("--labels", "9")):
            made, _ = self.expect_same(*options)
            self.assertLess(len(made.cells[0].data), len(whole.cells[0].data))
        run("convert", "m.vtu", "two.vtu", "--background", 1)
        run("convert", "two.vtu", "c.vtu", "--background", 2)
        run("mesh", "v.nii", "-o", "w.vtu", "--labels", "0,3,9")
        self.assertEqual(run("digest", "c.vtu"), run("digest", "w.vtu"))
        refused(["no label 77"], "convert", "m.vtu", "c.vtu", "--background", 77, code=2)

    def test_leaves_parts_out_and_doubles_vertices(self):
        run("convert", "m.vtu", "nine.vtu", "--labels", 9)
        said = run("convert", "nine.vtu", "c.vtu", "--parts", "largest")
        run("mesh", "v.nii", "-o", "w.vtu", "--labels", 9, "--parts", "largest")
        self.assertEqual(run("digest", "c.vtu"), run("digest", "w.vtu"))
        self.assertIn("2", said)
        for options in (("--split", "1|3"), ("--split", "*"), ("--open-hinges",), ("--cohesive", "1|3")):
            made, _ = self.expect_same(*options)
            if "--cohesive" in options:
                self.assertIn("wedge", [block.type for block in made.cells])
        # What an earlier change has left stays known: wedges, doubled vertices.
        run("convert", "c.vtu", "d.vtu", "--parts", "largest")
        self.assertIn("wedge", [block.type for block in meshio.read("d.vtu").cells])
        refused(["no label 77"], "convert", "m.vtu", "c.vtu", "--split", "1|77", code=2)
        refused(["wedges"], "convert", "m.vtu", "c.mesh", "--cohesive", "1|3", code=2)

    def test_samples_images_that_tell_where_they_lie(self):
        made, meshed = self.expect_same("--sample", "grey=grey.nii", "--background", 1)
        np.testing.assert_array_equal(made.cell_data["grey"][0], meshed.cell_data["grey"][0])
        run("convert", "c.vtu", "d.vtu", "--sample", "most=grey.nii:max")
        both = meshio.read("d.vtu").cell_data
        np.testing.assert_array_equal(both["grey"][0], made.cell_data["grey"][0])
        self.assertTrue((both["most"][0] >= both["grey"][0] - 1e-12).all())
        refused(["has values of that name"], "convert", "c.vtu", "e.vtu", "--sample", "grey=grey.nii",
                code=2)
        refused(["does not say where it lies"], "convert", "m.vtu", "e.vtu", "--sample", "x=grey.npy",
                code=2)

    def test_gives_names(self):
        with open("names.csv", "w", encoding="utf-8") as file:
            file.write("id,name\n1,liver\n9,tumour\n")
        run("convert", "m.vtu", "n.vtu", "--names", "names.csv")
        run("convert", "n.vtu", "t.vtu", "--labels", "tumour")
        self.assertEqual(set(meshio.read("t.vtu").cell_data["label"][0]), {9})

    def test_curved_tets_are_not_cut_apart(self):
        run("mesh", "v.nii", "-o", "curved.vtu", "--element", "tet10-curved")
        for options in (("--split", "1|3"), ("--parts", "largest"), ("--sample", "x=grey.nii")):
            refused(["--element tet4"], "convert", "curved.vtu", "c.vtu", *options, code=2)
        run("convert", "curved.vtu", "c.vtu", "--background", 1)
        run("mesh", "v.nii", "-o", "w.vtu", "--element", "tet10-curved", "--background", 1)
        self.assertEqual(len(meshio.read("c.vtu").cells[0].data),
                         len(meshio.read("w.vtu").cells[0].data))


if __name__ == "__main__":
    unittest.main()
