#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""DICOM segmentations that pydicom writes: the mesh is that of the bare array of their labels, and
lies where the attributes of the frames say."""
import json
import random
import sys
import unittest

from program import enter_folder, run, start

try:
    import numpy
    import pydicom
    from pydicom.dataset import Dataset, FileMetaDataset
    from pydicom.sequence import Sequence
    from pydicom.uid import (CTImageStorage, DeflatedExplicitVRLittleEndian, ExplicitVRBigEndian,
                             ExplicitVRLittleEndian, ImplicitVRLittleEndian, RLELossless,
                             SegmentationStorage, generate_uid)
    from places_test import organs, read_medit, turn
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

ROW_SPACING, COLUMN_SPACING, STEP = 1.25, 1.5, 2.0
FIRST = numpy.array([-20.5, 7.25, 100.0])


def item(**values):
    out = Dataset()
    for name, value in values.items():
        setattr(out, name, value)
    return out


def sequence(**values):
    return Sequence([item(**values)])


class Segmentation:
    """masks: by segment, in (x, y, z); axes: directions of columns, rows and slices as columns."""

    def __init__(self, masks, axes=numpy.eye(3), fractional=False, syntax=ExplicitVRLittleEndian):
        self.masks = masks
        self.axes = axes
        self.fractional = fractional
        self.syntax = syntax
        self.most = 255
        self.kept = lambda segment, z: self.masks[segment][:, :, z].any()
        self.shuffled = None
        self.slice_spacing = True
        self.shares_grid = True

    def place(self, z):
        return [f"{x:.10g}" for x in FIRST + self.axes[:, 2] * STEP * z]

    def grid(self, shared):
        if shared is not None:
            shared.PlaneOrientationSequence = sequence(
                ImageOrientationPatient=[f"{x:.10g}" for x in self.axes[:, :2].T.ravel()])
            shared.PixelMeasuresSequence = sequence(
                PixelSpacing=[ROW_SPACING, COLUMN_SPACING], SliceThickness=STEP)
            if self.slice_spacing:
                shared.PixelMeasuresSequence[0].SpacingBetweenSlices = STEP

    def frames(self):
        shape = next(iter(self.masks.values())).shape
        out = [(segment, z) for segment in self.masks for z in range(shape[2])
               if self.kept(segment, z)]
        if self.shuffled is not None:
            random.Random(self.shuffled).shuffle(out)
        return out

    def pixels(self, frames):
        voxels = numpy.concatenate([self.masks[s][:, :, z].T.ravel() for s, z in frames])
        if self.fractional:
            return (voxels * self.most).astype(numpy.uint8).tobytes()
        return numpy.packbits(voxels.astype(numpy.uint8), bitorder="little").tobytes()

    def dataset(self):
        out = Dataset()
        out.file_meta = FileMetaDataset()
        out.file_meta.TransferSyntaxUID = self.syntax
        out.file_meta.MediaStorageSOPClassUID = out.SOPClassUID = SegmentationStorage
        out.file_meta.MediaStorageSOPInstanceUID = out.SOPInstanceUID = generate_uid()
        out.is_little_endian = self.syntax != ExplicitVRBigEndian
        out.is_implicit_VR = self.syntax == ImplicitVRLittleEndian
        out.SpecificCharacterSet = "ISO_IR 100"
        out.Modality = "SEG"
        out.SegmentationType = "FRACTIONAL" if self.fractional else "BINARY"
        if self.fractional:
            out.SegmentationFractionalType = "OCCUPANCY"
            out.MaximumFractionalValue = self.most
        out.SegmentSequence = Sequence(
            [item(SegmentNumber=s, SegmentLabel=f"Gefäß {s}", SegmentAlgorithmType="MANUAL")
             for s in self.masks])
        shape = next(iter(self.masks.values())).shape
        out.Columns, out.Rows = shape[:2]
        out.SamplesPerPixel, out.PhotometricInterpretation = 1, "MONOCHROME2"
        out.PixelRepresentation = 0
        out.BitsAllocated = out.BitsStored = 8 if self.fractional else 1
        out.HighBit = out.BitsStored - 1
        frames = self.frames()
        out.NumberOfFrames = len(frames)
        shared = Dataset()
        self.grid(shared if self.shares_grid else None)
        out.SharedFunctionalGroupsSequence = Sequence([shared])
        out.PerFrameFunctionalGroupsSequence = Sequence()
        for segment, z in frames:
            frame = item(
                SegmentIdentificationSequence=sequence(ReferencedSegmentNumber=segment),
                PlanePositionSequence=sequence(ImagePositionPatient=self.place(z)))
            if not self.shares_grid:
                self.grid(frame)
            out.PerFrameFunctionalGroupsSequence.append(frame)
        out.PixelData = self.pixels(frames)
        out["PixelData"].VR = "OB"
        return out

    def save(self, path):
        data = self.dataset()
        if self.syntax == RLELossless:
            data.file_meta.TransferSyntaxUID = ExplicitVRLittleEndian
            data.compress(RLELossless)
        data.save_as(path, write_like_original=False)


class Dicom(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        labels = organs()
        cls.masks = {1: labels == 3, 2: labels == 700}
        cls.labels = cls.masks[1] + 2 * cls.masks[2]
        cls.spacing = numpy.array([COLUMN_SPACING, ROW_SPACING, STEP])

    def check(self, segmentation, labels=None, *options):
        """The mesh of the file is that of the array, moved to where the frames are."""
        segmentation.save("s.dcm")
        labels = self.labels if labels is None else labels
        slices = [z for _, z in segmentation.frames()]
        labels = labels[:, :, min(slices):max(slices) + 1]  # there are no others for the file
        numpy.save("array.npy", labels.astype(numpy.uint8).transpose(2, 1, 0))
        run("mesh", "array.npy", "--spacing", ",".join(map(str, self.spacing)), "-o", "array.mesh",
            "--force")
        run("mesh", "s.dcm", "-o", "s.mesh", "--force", *options)
        vertices, tets, tet_labels = read_medit("array.mesh")
        found, found_tets, found_labels = read_medit("s.mesh")
        first = FIRST + segmentation.axes[:, 2] * STEP * min(slices)
        expected = (vertices - 0.5 * self.spacing) @ segmentation.axes.T + first
        self.assertLess(abs(found - expected).max(), 2e-5)
        numpy.testing.assert_array_equal(numpy.sort(found_tets), numpy.sort(tets))
        numpy.testing.assert_array_equal(found_labels, tet_labels)

    def test_binary(self):
        for syntax in (ExplicitVRLittleEndian, ImplicitVRLittleEndian, ExplicitVRBigEndian,
                       DeflatedExplicitVRLittleEndian):
            with self.subTest(syntax.name):
                self.check(Segmentation(self.masks, syntax=syntax))
        rows = json.loads(run("info", "s.dcm", "--json"))["labels"]["per_label"]
        self.assertEqual([row.get("name") for row in rows], [None, "Gefäß 1", "Gefäß 2"])

    def test_fractional(self):
        for syntax in (ExplicitVRLittleEndian, RLELossless):
            with self.subTest(syntax.name):
                half = {s: 0.3 * ~mask + 0.7 * mask for s, mask in self.masks.items()}
                self.check(Segmentation(half, fractional=True, syntax=syntax))

    def test_frames_in_any_order_and_at_any_place(self):
        flip = numpy.diag([1.0, -1.0, -1.0])
        for seed, axes in enumerate((flip, turn(0, 30) @ turn(2, 50), turn(1, 90))):
            segmentation = Segmentation(self.masks, axes)
            segmentation.shuffled = seed
            segmentation.slice_spacing = segmentation.shares_grid = seed % 2 == 0
            self.check(segmentation)

    def test_missing_frames_are_empty(self):
        self.assertFalse(self.masks[2][:, :, 8].any())
        gap = {s: mask.copy() for s, mask in self.masks.items()}
        for mask in gap.values():
            mask[:, :, 3:5] = False
        labels = gap[1] + 2 * gap[2]
        segmentation = Segmentation(gap)
        first = min(z for _, z in segmentation.frames())
        last = max(z for _, z in segmentation.frames())
        segmentation.save("s.dcm")
        shape = json.loads(run("info", "s.dcm", "--json"))["shape_xyz"]
        self.assertEqual(shape, [*labels.shape[:2], last - first + 1])
        every = Segmentation(gap)
        every.kept = lambda segment, z: segment == 1
        self.check(every, labels * (labels == 1))

    def test_overlap(self):
        masks = {1: self.masks[1], 2: self.masks[2] | numpy.roll(self.masks[1], 2, 0)}
        segmentation = Segmentation(masks)
        segmentation.kept = lambda segment, z: True
        segmentation.save("s.dcm")
        done = start("mesh", "s.dcm", "-o", "o.mesh")
        self.assertEqual(done.returncode, 3)
        self.assertIn("--overlap", done.stderr)
        last = numpy.where(masks[2], 2, masks[1])
        self.check(segmentation, last, "--overlap", "last")

    def refused(self, change, *words):
        data = Segmentation(self.masks).dataset()
        change(data)
        data.save_as("bad.dcm", write_like_original=False)
        done = start("mesh", "bad.dcm", "-o", "bad.mesh")
        self.assertEqual(done.returncode, 3, done.stderr)
        for word in ("bad.dcm", *words):
            self.assertIn(word, done.stderr)

    def test_what_cannot_be_read(self):
        def set_image(data):
            data.SOPClassUID = data.file_meta.MediaStorageSOPClassUID = CTImageStorage

        def move(data, by):
            place = data.PerFrameFunctionalGroupsSequence[2].PlanePositionSequence[0]
            place.ImagePositionPatient = [float(x) + d for x, d in
                                          zip(place.ImagePositionPatient, by)]

        def repeat(data):
            frames = data.PerFrameFunctionalGroupsSequence
            frames[1].PlanePositionSequence = frames[0].PlanePositionSequence

        self.refused(set_image, "no segmentation", "3D Slicer")
        self.refused(lambda d: move(d, (0, 0, 0.7)), "Image Position", "step")
        self.refused(lambda d: move(d, (1, 0, 0)), "Image Position", "behind each other")
        self.refused(repeat, "frames 1 and 2 are both of segment 1")
        self.refused(lambda d: setattr(d, "NumberOfFrames", 3), "frames")
        self.refused(lambda d: setattr(d, "Rows", 60000), "Pixel Data")
        self.refused(lambda d: setattr(d, "SegmentationType", "LABELMAP"), "LABELMAP", "BINARY")
        self.refused(lambda d: d.__delitem__("SegmentSequence"), "Segment Sequence")
        self.refused(lambda d: d.__delitem__("PixelData"), "Pixel Data")
        self.refused(lambda d: d.__delitem__("PerFrameFunctionalGroupsSequence"), "Per-Frame")
        self.refused(lambda d: d.SharedFunctionalGroupsSequence[0].__delitem__(
            "PlaneOrientationSequence"), "Orientation")
        self.refused(lambda d: setattr(d.SegmentSequence[1], "SegmentNumber", 7), "segment 2")

    def test_damage_is_refused_or_read(self):
        chance = random.Random(41)
        Segmentation(self.masks).save("good.dcm")
        with open("good.dcm", "rb") as file:
            good = file.read()
        refused = 0
        for i in range(150):
            bad = bytearray(good)
            at = chance.randrange(len(bad))
            if i % 3 == 0:
                bad = bad[:at]
            elif i % 3 == 1:
                bad[at] ^= 1 << chance.randrange(8)
            else:
                bad[at:at + 4] = b"\xff\xff\xff\xff"
            with open("bad.dcm", "wb") as file:
                file.write(bad)
            done = start("info", "bad.dcm")
            self.assertIn(done.returncode, (0, 3), done.stderr)
            refused += done.returncode == 3
        self.assertGreater(refused, 40)


if __name__ == "__main__":
    unittest.main()
