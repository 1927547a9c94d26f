#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""NIfTI volumes in two files that nibabel writes, named by either; Analyze, which is refused."""
import itertools
import os
import pathlib
import sys
import unittest

from program import refused, run
from stores import TYPES, Stores, distinct, name_of, numpy, write

try:
    import nibabel
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SHAPE = (4, 5, 6)  # x, y, z
PAIRS = (nibabel.Nifti1Pair, nibabel.Nifti2Pair)
AFFINE = numpy.array([[0, -1.25, 0, 3], [2, 0, 0, -7], [0, 0, 1.5, 20], [0, 0, 0, 1.0]])


class Pairs(Stores):
    def test_every_type_by_either_name(self):
        kinds = itertools.cycle(TYPES)
        for pair, ending in itertools.product(PAIRS, ("", ".gz")):
            for _ in range(2):
                labels = distinct(self.random, SHAPE, next(kinds))
                nibabel.save(pair(labels, AFFINE, dtype=labels.dtype), "a.img" + ending)
                for name in ("a.hdr" + ending, "a.img" + ending):
                    self.check(name, labels.transpose(2, 1, 0), format="nifti", frame="ras",
                               type=name_of(labels.dtype))
                os.remove("a.hdr" + ending)
                os.remove("a.img" + ending)

    def test_it_is_the_mesh_of_one_file(self):
        labels = numpy.zeros((12, 11, 10), "u1")
        labels[3:9, 3:8, 2:7] = 5
        nibabel.save(nibabel.Nifti1Image(labels, AFFINE), "one.nii")
        run("mesh", "one.nii", "-o", "one.vtu")
        for pair in PAIRS:
            nibabel.save(pair(labels, AFFINE), "two.img")
            run("mesh", "two.img", "-o", "two.vtu")
            self.assertEqual(run("digest", "two.vtu"), run("digest", "one.vtu"))
        # Only one of the two is packed, and both are in capitals.
        os.system("gzip two.img")
        run("mesh", "two.hdr", "-o", "two.vtu")
        self.assertEqual(run("digest", "two.vtu"), run("digest", "one.vtu"))
        nibabel.save(PAIRS[0](labels, AFFINE), "big.img")
        os.rename("big.img", "BIG.IMG")
        os.rename("big.hdr", "BIG.HDR")
        for name in ("BIG.IMG", "BIG.HDR"):
            run("mesh", name, "-o", "two.vtu")
            self.assertEqual(run("digest", "two.vtu"), run("digest", "one.vtu"))

    def test_masks_and_forms(self):
        masks = numpy.zeros((*SHAPE, 2), "u1")
        masks[:2, :, :, 0] = masks[2:, :, :, 1] = 1
        nibabel.save(PAIRS[0](masks, AFFINE), "m.img")
        run("mesh", "m.img", "-o", "m.vtu", "--overlap", "first")
        run("mesh", "m.hdr", "-o", "m.vtu", "--use-form", "sform")

    def test_what_is_missing_is_named(self):
        labels = distinct(self.random, SHAPE, "u1")
        nibabel.save(PAIRS[0](labels, AFFINE), "a.img")
        content = pathlib.Path("a.img").read_bytes()
        os.remove("a.img")
        self.refuse(["a.hdr", "no .img of the same name"], "a.hdr")
        write("a.img", content[:-1])
        refused(["a.img: voxel data", "120 bytes"], "info", "a.hdr")
        write("b.img", content)
        self.refuse(["no header beside it", "--shape"], "b.img")
        write("b.hdr", "ENVI\nsamples = 4\n")
        refused(["b.hdr: sizeof_hdr"], "info", "b.img")

    def test_analyze_is_refused_with_a_way_to_go_on(self):
        labels = distinct(self.random, SHAPE, "i2")
        for kind in (nibabel.AnalyzeImage, nibabel.Spm99AnalyzeImage):
            nibabel.save(kind(labels, numpy.diag([2, 1, 1, 1.0])), "a.img")
            for name in ("a.hdr", "a.img"):
                refused(["a.hdr: magic", "Analyze 7.5", "left and right", "convert",
                         "--shape 4,5,6 --dtype i16 "], "info", name)
            self.check("a.img", labels.transpose(2, 1, 0), "--shape", "4,5,6", "--dtype", "i16")


if __name__ == "__main__":
    unittest.main()
