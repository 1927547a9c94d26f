#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Volumes of FreeSurfer that nibabel writes: types, names of labels, frames, and what is wrong."""
import gzip
import itertools
import pathlib
import sys
import unittest

from program import run, start
from stores import Stores, distinct, name_of, numpy, write

try:
    import nibabel
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SHAPE = (4, 5, 6)  # x, y, z
TABLE = "#No. Label Name: R G B A\n0 Unknown 0 0 0 0\n2 Left-Cerebral-White-Matter 245 245 245 0\n"


def save(path, labels, affine=None):
    nibabel.save(nibabel.MGHImage(labels, numpy.eye(4) if affine is None else affine), path)


class FreeSurfer(Stores):
    def test_every_type_plain_and_packed(self):
        for kind, ending in itertools.product(("u1", "i2", "i4"), (".mgh", ".mgz")):
            labels = distinct(self.random, SHAPE, kind)
            save("a" + ending, labels)
            self.check("a" + ending, labels.transpose(2, 1, 0), format="mgh",
                       type=name_of(labels.dtype), unit="mm", frame="ras")
        whole = numpy.arange(120, dtype="f4").reshape(SHAPE)
        save("a.mgz", whole)
        self.check("a.mgz", whole.transpose(2, 1, 0).astype(int), type="f32")
        # The format has unsigned shorts, which nibabel does not write.
        labels = distinct(self.random, SHAPE, "u2")
        save("s.mgh", labels.astype("i4"))
        header = bytearray(pathlib.Path("s.mgh").read_bytes()[:284])
        header[20:24] = (10).to_bytes(4, "big")
        write("u.mgh", bytes(header) + labels.astype(">u2").tobytes(order="F"))
        self.check("u.mgh", labels.transpose(2, 1, 0), type="u16")

    def test_names_of_the_table_beside(self):
        pathlib.Path("mri").mkdir()
        labels = numpy.zeros(SHAPE, "i4")
        labels[1:3, 1:3, 1:3] = 2
        save("mri/aseg.mgz", labels)
        names = lambda: [row.get("name") for row in self.facts("mri/aseg.mgz")["labels"]["per_label"]]
        self.assertEqual(names(), [None, None])
        write("mri/FreeSurferColorLUT.txt", TABLE)
        self.assertEqual(names(), ["Unknown", "Left-Cerebral-White-Matter"])
        write("mri/FreeSurferColorLUT.txt", TABLE + "2 Again 1 2 3 0\n")
        told = start("info", "mri/aseg.mgz")
        self.assertEqual(told.returncode, 0)
        for words in ("FreeSurferColorLUT.txt", "line 4", "aseg.mgz have no names"):
            self.assertIn(words, told.stderr)
        self.assertEqual(names(), [None, None])

    def test_frames_are_masks(self):
        masks = numpy.zeros((*SHAPE, 2), "u1")
        masks[:2, :, :, 0] = 1
        masks[2:, 1:, :, 1] = 9
        save("m.mgz", masks)
        labels = masks[..., 0] + 2 * (masks[..., 1] > 0)
        run("mesh", "m.mgz", "-o", "m.vtu")
        save("l.mgz", labels.astype("u1"))
        run("mesh", "l.mgz", "-o", "l.vtu")
        self.assertEqual(run("digest", "m.vtu"), run("digest", "l.vtu"))
        masks[0, 0, 0, 1] = 9
        save("m.mgz", masks)
        self.refuse(["overlap", "volume 1"], "m.mgz")
        shares = numpy.stack([labels == n for n in (0, 1, 2)], axis=-1).astype("f4")
        save("p.mgz", shares)
        run("mesh", "p.mgz", "--values", "probabilities", "-o", "p.vtu")

    def test_without_a_place_it_is_coronal(self):
        save("a.mgh", distinct(self.random, SHAPE, "u1"))
        content = bytearray(pathlib.Path("a.mgh").read_bytes())
        content[28:30] = bytes(2)
        write("a.mgh", bytes(content))
        told = start("info", "a.mgh")
        self.assertIn("coronal", told.stderr)
        self.assertEqual(start("info", "a.mgh", "--frame", "voxel").stderr, "")
        # Voxel 2, 2.5, 3 is at 0: x goes to the left, y down and z to the front.
        self.expect(self.facts("a.mgh"), origin=(2.5, -3.5, 3.0), spacing=(1, 1, 1))

    def test_what_is_wrong_is_named(self):
        save("a.mgh", distinct(self.random, SHAPE, "u1"))
        content = pathlib.Path("a.mgh").read_bytes()
        for at, value, *words in ((0, 2, "version", "2 is not 1"), (20, 9, "type 9", "mri_convert"),
                                  (16, 0, "nframes", "0 is not 1"), (4, -1, "width", "(x)", "-1")):
            changed = bytearray(content)
            changed[at:at + 4] = value.to_bytes(4, "big", signed=True)
            write("b.mgh", bytes(changed))
            self.refuse(words, "b.mgh")
        for cut in (3, 89, 90, 283, 284, 403):
            write("c.mgh", content[:cut])
            self.refuse("c.mgh", "c.mgh")
            write("c.mgz", gzip.compress(content[:cut]))
            self.refuse("c.mgz", "c.mgz")
        write("s.mgh", content[:42] + numpy.array([1, 0, 0, .6, .8, 0, 0, 0, 1], ">f4").tobytes()
              + content[78:])
        self.refuse(["Mdc", "right angles"], "s.mgh")


if __name__ == "__main__":
    unittest.main()
