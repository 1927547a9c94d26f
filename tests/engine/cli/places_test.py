#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes of NIfTI volumes, and of FreeSurfer's, lie where nibabel says: all axis orders and flips,
rotations, both forms.

Every mesh is, vertex by vertex, the mesh of the bare array moved by nibabel's affine; its tets are
positive in the world; and verify accepts it there and nowhere else.
"""
import itertools
import sys
import unittest

from program import enter_folder, run, start

try:
    import nibabel
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SPACING = numpy.array([1.25, 1.0, 1.5])


def read_medit(path):
    with open(path) as file:
        words = file.read().split()
    at = words.index("Vertices")
    count = int(words[at + 1])
    vertices = numpy.array(words[at + 2 : at + 2 + 4 * count], float).reshape(count, 4)[:, :3]
    at = words.index("Tetrahedra")
    count = int(words[at + 1])
    tets = numpy.array(words[at + 2 : at + 2 + 5 * count], numpy.int64).reshape(count, 5)
    return vertices, tets[:, :4] - 1, tets[:, 4]


def organs():
    """A volume in (x, y, z) that looks different from every side."""
    x, y, z = numpy.indices((14, 16, 12))
    labels = numpy.zeros(x.shape, numpy.uint16)
    labels[(x - 5) ** 2 + (y - 6) ** 2 + (z - 6) ** 2 < 17] = 3
    labels[(x > 8) & (y > 9) & (z < 5)] = 700
    return labels


def turn(axis, degrees):
    angle = numpy.deg2rad(degrees)
    matrix = numpy.eye(3)
    i, j = [k for k in range(3) if k != axis]
    matrix[i, i] = matrix[j, j] = numpy.cos(angle)
    matrix[i, j] = -numpy.sin(angle)
    matrix[j, i] = numpy.sin(angle)
    return matrix


def affine(rotation):
    out = numpy.eye(4)
    out[:3, :3] = rotation * SPACING
    out[:3, 3] = [-20.5, 7.25, 100]
    return out


class Places(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        cls.labels = organs()
        numpy.save("array.npy", cls.labels.transpose(2, 1, 0))
        run("mesh", "array.npy", "--spacing", ",".join(map(str, SPACING)), "-o", "array.mesh")
        cls.vertices, cls.tets, cls.tet_labels = read_medit("array.mesh")

    def check(self, image, verified=True, name="turned.nii"):
        nibabel.save(image, name)
        matrix = nibabel.load(name).affine
        run("mesh", name, "-o", "turned.mesh")
        vertices, tets, labels = read_medit("turned.mesh")
        centres = self.vertices / SPACING - 0.5
        expected = centres @ matrix[:3, :3].T + matrix[:3, 3]
        self.assertLess(abs(vertices - expected).max(), 2e-5)
        numpy.testing.assert_array_equal(numpy.sort(tets), numpy.sort(self.tets))
        numpy.testing.assert_array_equal(labels, self.tet_labels)
        corners = vertices[tets]
        edges = corners[:, 1:] - corners[:, :1]
        self.assertGreater(numpy.linalg.det(edges).min(), 0)
        if verified:
            run("verify", name, "turned.mesh", "--max-distance", "1.5", "--quality-floor", "0.2")
        return matrix

    def test_all_orders_and_flips(self):
        seen = set()
        for order in itertools.permutations(range(3)):
            for signs in itertools.product((1, -1), repeat=3):
                rotation = numpy.zeros((3, 3))
                rotation[list(order), range(3)] = signs
                matrix = self.check(nibabel.Nifti1Image(self.labels, affine(rotation)))
                seen.add("".join(nibabel.aff2axcodes(matrix)))
        self.assertEqual(len(seen), 48)

    def test_rotations(self):
        for degrees in ((23, 0, 0), (0, 23, 0), (0, 0, 23), (10, -40, 77), (180, 3, 0)):
            rotation = turn(0, degrees[0]) @ turn(1, degrees[1]) @ turn(2, degrees[2])
            self.check(nibabel.Nifti1Image(self.labels, affine(rotation)))
            self.check(nibabel.Nifti2Image(self.labels, affine(-rotation)))

    def test_freesurfer(self):
        """The directions and the centre of the volume, also of one that turns and is mirrored."""
        labels = self.labels.astype(numpy.int32)
        for order in itertools.permutations(range(3)):
            rotation = numpy.zeros((3, 3))
            rotation[list(order), range(3)] = (-1, 1, -1)
            self.check(nibabel.MGHImage(labels, affine(rotation)), name="turned.mgz")
        for degrees in (23, -50, 180):
            rotation = turn(0, degrees) @ turn(2, 40)
            self.check(nibabel.MGHImage(labels, affine(rotation)), name="turned.mgh")
            self.check(nibabel.MGHImage(labels, affine(-rotation)), name="turned.mgz")

    def test_pairs(self):
        for pair in (nibabel.Nifti1Pair, nibabel.Nifti2Pair):
            rotation = turn(0, 23) @ turn(1, 140)
            self.check(pair(self.labels, affine(rotation)), name="turned.img")
            self.check(pair(self.labels, affine(-rotation)), name="turned.img")

    def test_qform_alone(self):
        for rotation in (turn(2, 23) @ turn(0, 50), -turn(1, 180), numpy.diag([-1, 1, 1])):
            image = nibabel.Nifti1Image(self.labels, affine(rotation))
            image.set_qform(affine(rotation), code=1)
            image.set_sform(None, code=0)
            self.check(image)

    def test_two_forms(self):
        scanner, shear = affine(turn(2, 23)), numpy.eye(4)
        shear[0, 1] = 0.06
        moved = scanner + [[0, 0, 0, 12], [0] * 4, [0] * 4, [0] * 4]
        for name, sform in (("moved", moved), ("sheared", shear @ scanner)):
            image = nibabel.Nifti1Image(self.labels, None)
            image.header.set_qform(scanner, 1)
            image.header.set_sform(sform, 4)
            nibabel.save(nibabel.Nifti1Image(self.labels, None, image.header), f"{name}.nii")
            run("mesh", f"{name}.nii", "-o", f"{name}.mesh", "--use-form", "qform")
        image = nibabel.Nifti1Image(self.labels, None)
        image.header.set_qform(scanner, 1)
        nibabel.save(nibabel.Nifti1Image(self.labels, None, image.header), "scanner.nii")
        run("mesh", "scanner.nii", "-o", "scanner.mesh")
        for name in ("moved", "sheared"):
            self.assertEqual(run("digest", f"{name}.mesh"), run("digest", "scanner.mesh"))
        told = start("mesh", "moved.nii", "-o", "sform.mesh")
        self.assertEqual(told.returncode, 0)
        self.assertIn("sform and qform differ by up to 12 voxels: the centre of voxel 0,0,0 is at", told.stderr)
        self.assertNotEqual(run("digest", "sform.mesh"), run("digest", "scanner.mesh"))
        told = start("mesh", "sheared.nii", "-o", "a.mesh")
        self.assertEqual(told.returncode, 3)
        self.assertIn("--use-form qform", told.stderr)
        # The voxel that is named is one whose places differ.
        image.header.set_sform(numpy.diag([-1.0, 1, 1, 1]), 4)
        image.header.set_qform(numpy.eye(4), 1)
        nibabel.save(nibabel.Nifti1Image(self.labels, None, image.header), "flipped.nii")
        last = self.labels.shape[0] - 1
        self.assertIn(f"voxel {last},0,0 is at -{last},0,0 by the sform, which is taken, and at {last},0,0",
                      start("info", "flipped.nii").stderr)
        # An image beside the labels lies by the same form.
        run("mesh", "sheared.nii", "-o", "s.vtu", "--use-form", "qform", "--sample",
            "own=sheared.nii:mode")
        run("mesh", "sheared.nii", "-o", "s.vtu", "--force", "--use-form", "qform", "--sample",
            "own=scanner.nii:mode")
        told = start("mesh", "scanner.nii", "-o", "t.vtu", "--sample", "own=sheared.nii:mode")
        self.assertEqual(told.returncode, 3)

    def test_another_place_is_told(self):
        nibabel.save(nibabel.Nifti1Image(self.labels, affine(turn(2, 23))), "a.nii")
        nibabel.save(nibabel.Nifti1Image(self.labels, affine(turn(2, 24))), "b.nii")
        run("mesh", "a.nii", "-o", "a.vtu")
        run("verify", "a.nii", "a.vtu")
        run("verify", "b.nii", "a.vtu", code=5)

    def test_labels_in_floats(self):
        image = nibabel.Nifti1Image(self.labels.astype(numpy.float32), affine(numpy.eye(3)))
        self.check(image)
        scaled = nibabel.Nifti1Image(self.labels, affine(numpy.eye(3)))
        scaled.header.set_slope_inter(1, 0)
        self.check(scaled)


if __name__ == "__main__":
    unittest.main()
