#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""DICOM segmentations that pydicom writes, as masks and as label maps: the mesh is that of the bare
array of their labels, and lies where the attributes of the frames say."""
import json
import os
import random
import shutil
import subprocess
import sys
import unittest

from program import PROGRAM, RESIDENT_MEMORY_IS_OURS, enter_folder, refused, run, start

try:
    import numpy
    import pydicom
    from pydicom.dataset import Dataset, FileMetaDataset
    from pydicom.encaps import decode_data_sequence, encapsulate
    from pydicom.sequence import Sequence
    from pydicom.uid import (CTImageStorage, DeflatedExplicitVRLittleEndian, ExplicitVRBigEndian,
                             ExplicitVRLittleEndian, ImplicitVRLittleEndian, JPEG2000,
                             JPEG2000Lossless, JPEGLSLossless, RLELossless, SegmentationStorage,
                             generate_uid)
    from places_test import organs, read_medit, turn
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

# Tools of DCMTK that pack a file, with options: packings that keep voxels, and those that do not.
LOSSLESS = (("dcmcjpls",), ("dcmcjpeg", "+e1"), ("dcmcjpeg", "+el", "+sv", "6"))
LOSSY = (("dcmcjpls", "+en"), ("dcmcjpeg", "+eb"))
RLE = ("pydicom",)
HAVE_TOOLS = all(shutil.which(tool) for tool, *_ in LOSSLESS)
NEEDS_TOOLS = unittest.skipUnless(HAVE_TOOLS, "dcmcjpls and dcmcjpeg (package dcmtk) are missing")
PACKERS = (RLE, *LOSSLESS) if HAVE_TOOLS else (RLE,)
JPEG_END = b"\xff\xd9"

LABEL_MAP_CLASS = "1.2.840.10008.5.1.4.1.1.66.7"  # which pydicom 2.3 has no name for
ROW_SPACING, COLUMN_SPACING, STEP = 1.25, 1.5, 2.0
FIRST = numpy.array([-20.5, 7.25, 100.0])


def item(**values):
    out = Dataset()
    for name, value in values.items():
        setattr(out, name, value)
    return out


def sequence(**values):
    return Sequence([item(**values)])


def cut_at(end):
    """Leaves out as many bytes at the end; keeps as many at the beginning where negative."""
    return lambda data: data[:-end]


def change_frame(data, frame, change):
    """Changes the packed bytes of a frame, or leaves it out."""
    frames = list(decode_data_sequence(data.PixelData))
    frames[frame:frame + 1 or None] = [change(frames[frame])] if change else []
    data.PixelData = encapsulate(frames)
    data["PixelData"].is_undefined_length = True


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
        self.tool = None  # that packs pixels
        self.colours = {}  # by segment, in CIELab as the attribute has it

    def segments(self, numbers):
        out = Sequence([item(SegmentNumber=n, SegmentLabel=f"Gefäß {n}",
                             SegmentAlgorithmType="MANUAL") for n in numbers])
        for segment in out:
            if segment.SegmentNumber in self.colours:
                colour = self.colours[segment.SegmentNumber]
                segment.add_new("RecommendedDisplayCIELabValue", "US", colour)
        return out

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
        out.SegmentSequence = self.segments(self.masks)
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

    def packed(self, tool):
        """The dataset as a tool packs it."""
        data = self.dataset()
        if tool == RLE:
            data.compress(RLELossless)
            return data
        data.save_as("unpacked.dcm", write_like_original=False)
        subprocess.run([*tool, "unpacked.dcm", "packed.dcm"], check=True, capture_output=True)
        return pydicom.dcmread("packed.dcm")

    def save(self, path):
        data = self.packed(self.tool) if self.tool else self.dataset()
        data.save_as(path, write_like_original=False)


class LabelMap(Segmentation):
    """numbers: of segments, in (x, y, z)."""

    def __init__(self, numbers, bits=8, **others):
        super().__init__({0: numbers}, **others)
        self.bits = bits
        self.numbers = [int(n) for n in numpy.unique(numbers) if n != 0]
        self.padding = None
        self.is_palette = False

    def pixels(self, frames):
        order = ">" if self.syntax == ExplicitVRBigEndian else "<"
        voxels = numpy.concatenate([self.masks[s][:, :, z].T.ravel() for s, z in frames])
        return voxels.astype(f"{order}u{self.bits // 8}").tobytes()

    def dataset(self):
        out = super().dataset()
        out.file_meta.MediaStorageSOPClassUID = out.SOPClassUID = LABEL_MAP_CLASS
        out.SegmentationType = "LABELMAP"
        out.SegmentSequence = self.segments(self.numbers)
        out.BitsAllocated = out.BitsStored = self.bits
        out.HighBit = self.bits - 1
        out["PixelData"].VR = "OW" if self.bits == 16 else "OB"
        for frame in out.PerFrameFunctionalGroupsSequence:
            del frame.SegmentIdentificationSequence
        if self.padding is not None:
            out.add_new("PixelPaddingValue", "US", self.padding)
        if self.is_palette:
            self.add_palette(out)
        return out

    @staticmethod
    def add_palette(out):
        out.PhotometricInterpretation = "PALETTE COLOR"
        for colour in ("Red", "Green", "Blue"):
            out.add_new(f"{colour}PaletteColorLookupTableDescriptor", "US", [256, 0, 8])
            out.add_new(f"{colour}PaletteColorLookupTableData", "OW", bytes(range(256)))


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
        numpy.save("array.npy", labels.astype(numpy.uint16).transpose(2, 1, 0))
        run("mesh", "array.npy", "--spacing", ",".join(map(str, self.spacing)), "-o", "array.mesh",
            "--force")
        run("mesh", "s.dcm", "-o", "s.mesh", "--force", "--background", "none", *options)
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
        half = {s: 0.3 * ~mask + 0.7 * mask for s, mask in self.masks.items()}
        self.check(Segmentation(half, fractional=True))

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
        warning = start("info", "s.dcm").stderr
        self.assertIn(f"2 of {last - first + 1} slices have no frame", warning)
        every = Segmentation(gap)
        every.kept = lambda segment, z: segment == 1
        self.check(every, labels * (labels == 1))

    def test_a_frame_a_little_off_its_slice_adds_no_slice(self):
        segmentation = Segmentation(self.masks)
        exact = segmentation.place
        for off in (0.01, 0.05, 0.09):
            calls = []
            segmentation.place = lambda z: (calls.append(z) or [
                *exact(z)[:2], f"{float(exact(z)[2]) + (off if len(calls) == 4 else 0):.10g}"])
            self.check(segmentation)

    def test_slices_without_frames_take_no_memory(self):
        masks = {1: numpy.ones((8, 8, 2), bool)}
        segmentation = Segmentation(masks)
        data = segmentation.dataset()
        far = data.PerFrameFunctionalGroupsSequence[1].PlanePositionSequence[0]
        far.ImagePositionPatient = segmentation.place(100_000)
        data.SegmentSequence = segmentation.segments(range(1, 1001))
        data.save_as("far.dcm", write_like_original=False)
        with subprocess.Popen([PROGRAM, "info", "far.dcm", "--json"], stdout=subprocess.PIPE,
                              text=True) as child:
            found = json.load(child.stdout)
            _, status, used = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(child.returncode, 0)
        self.assertEqual(found["shape_xyz"], [8, 8, 100_001])
        counts = {row["label"]: row["voxels"] for row in found["labels"]["per_label"]}
        self.assertEqual(counts, {0: 64 * 99_999, 1: 128})
        if RESIDENT_MEMORY_IS_OURS:
            self.assertLess(used.ru_maxrss, 300 << 10)  # a number a slice and segment are 800 MB

    def test_overlap(self):
        masks = {1: self.masks[1], 2: self.masks[2] | numpy.roll(self.masks[1], 2, 0)}
        segmentation = Segmentation(masks)
        segmentation.kept = lambda segment, z: True
        segmentation.save("s.dcm")
        refused(["--overlap"], "mesh", "s.dcm", "-o", "o.mesh")
        last = numpy.where(masks[2], 2, masks[1])
        self.check(segmentation, last, "--overlap", "last")

    def test_label_map(self):
        numbers = organs()  # 0, 3 and 700
        for syntax in (ExplicitVRLittleEndian, ImplicitVRLittleEndian, ExplicitVRBigEndian,
                       DeflatedExplicitVRLittleEndian):
            with self.subTest(syntax.name):
                self.check(LabelMap(numbers, bits=16, syntax=syntax), numbers)
                rows = json.loads(run("info", "s.dcm", "--json"))["labels"]["per_label"]
                self.assertEqual([(row["label"], row.get("name")) for row in rows],
                                 [(0, None), (3, "Gefäß 3"), (700, "Gefäß 700")])
        odd = numbers[1:, 1:, 1:] % 251  # so is the number of bytes of a frame, and of all
        for syntax in (ExplicitVRLittleEndian, ExplicitVRBigEndian):
            with self.subTest(syntax.name):
                palette = LabelMap(odd, syntax=syntax)
                palette.is_palette = True
                self.check(palette, odd)

    def test_label_map_in_any_order_and_at_any_place(self):
        numbers = organs()
        for seed, axes in enumerate((numpy.eye(3), turn(0, 30) @ turn(2, 50), turn(1, 90))):
            label_map = LabelMap(numbers, bits=16, axes=axes)
            label_map.shuffled = seed
            label_map.slice_spacing = label_map.shares_grid = seed % 2 == 0
            self.check(label_map, numbers)

    def test_slices_that_a_label_map_lacks_are_background(self):
        for padding in (None, 0, 9, 65535):
            numbers = organs()
            numbers[numbers == 0] = padding or 0
            label_map = LabelMap(numbers.copy(), bits=16)
            label_map.padding = padding
            label_map.kept = lambda _, z: 1 <= z <= 10 and z not in (3, 4, 7)
            numbers[:, :, [3, 4, 7]] = padding or 0
            self.check(label_map, numbers)

    def test_labels_need_no_segment(self):
        numbers = organs()
        label_map = LabelMap(numbers, bits=16)
        label_map.numbers = [0, 12, 700, 65535]
        self.check(label_map, numbers)
        rows = json.loads(run("info", "s.dcm", "--json"))["labels"]["per_label"]
        self.assertEqual([(row["label"], row.get("name")) for row in rows],
                         [(0, "Gefäß 0"), (3, None), (700, "Gefäß 700")])

    def test_colours(self):
        white, red = [65535, 0x8080, 0x8080], [35578, 53664, 50858]  # L 54.29, a 80.81, b 69.89
        for syntax in (ExplicitVRLittleEndian, ImplicitVRLittleEndian, ExplicitVRBigEndian):
            for kind, numbers in ((Segmentation(self.masks, syntax=syntax), (1, 2)),
                                  (LabelMap(organs(), bits=16, syntax=syntax), (3, 700))):
                kind.colours = {numbers[0]: red}
                self.check_colours(kind, [None, [255, 0, 0, 255], None])
                kind.colours = dict(zip(numbers, ([0, 0x8080, 0x8080], white)))
                self.check_colours(kind, [None, [0, 0, 0, 255], [255, 255, 255, 255]])
                for damaged in (white[:2], [*white, 0], []):
                    kind.colours[numbers[0]] = damaged
                    self.check_colours(kind, [None, None, [255, 255, 255, 255]])

    def check_colours(self, segmentation, expected):
        segmentation.save("s.dcm")
        run("mesh", "s.dcm", "-o", "s.vtkhdf", "--force", "--background", "none")
        volume = json.loads(run("info", "s.dcm", "--json"))["labels"]["per_label"]
        mesh = json.loads(run("info", "s.vtkhdf", "--json"))["volume"]["per_label"]
        for rows in (volume, mesh):
            self.assertEqual([row.get("colour") for row in rows], expected)

    def refused(self, change, *words, segmentation=None):
        segmentation = segmentation or Segmentation(self.masks)
        data = segmentation.packed(segmentation.tool) if segmentation.tool else segmentation.dataset()
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
        self.refused(lambda d: move(d, (0, 0, 0.7)), "Image Position", "step", "frame 3 is off")
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

    def test_label_maps_that_cannot_be_read(self):
        def refused(change, *words, syntax=ExplicitVRLittleEndian):
            self.refused(change, *words, segmentation=LabelMap(organs(), bits=16, syntax=syntax))

        def shift(data):
            place = data.PerFrameFunctionalGroupsSequence[2].PlanePositionSequence[0]
            place.ImagePositionPatient[2] += 0.7

        def repeat(data):
            frames = data.PerFrameFunctionalGroupsSequence
            frames[1].PlanePositionSequence = frames[0].PlanePositionSequence

        def pack(data, syntax):
            data.file_meta.TransferSyntaxUID = syntax
            data.PixelData = encapsulate([b"\xff\xd8\xff\xd9"] * data.NumberOfFrames)
            data["PixelData"].is_undefined_length = True

        refused(lambda d: setattr(d, "BitsAllocated", 8), "Pixel Data", "bytes")
        refused(lambda d: setattr(d, "BitsAllocated", 32), "LABELMAP", "32 bits", "NIfTI")
        refused(lambda d: setattr(d, "SegmentationType", "BINARY"), "BINARY", "16 bits")
        refused(lambda d: setattr(d, "SamplesPerPixel", 3), "Samples per Pixel")
        refused(lambda d: setattr(d, "PixelRepresentation", 1), "Pixel Representation")
        refused(lambda d: d.add_new("PixelPaddingValue", "SS", -1), "Pixel Padding Value", "65535")
        refused(lambda d: setattr(d, "PixelData", d.PixelData[:-2]), "Pixel Data", "bytes")
        refused(lambda d: d.__delitem__("PixelData"), "Pixel Data")
        refused(lambda d: setattr(d, "Columns", 60000), "Pixel Data", "bytes")
        refused(lambda d: setattr(d, "Rows", 0), "Rows and Columns")
        refused(lambda d: setattr(d, "NumberOfFrames", 0), "Number of Frames")
        refused(lambda d: d.__delitem__("NumberOfFrames"), "Number of Frames")
        refused(lambda d: d.__delitem__("PerFrameFunctionalGroupsSequence"), "Per-Frame")
        refused(lambda d: d.__delitem__("SegmentSequence"), "Segment Sequence")
        refused(lambda d: d.SegmentSequence[1].__delitem__("SegmentNumber"), "Segment Number")
        refused(shift, "Image Position", "step")
        refused(repeat, "frames 1 and 2 are both at one place", "BINARY")
        refused(lambda d: pack(d, JPEG2000Lossless), "JPEG 2000", "are not unpacked", "gdcmconv")
        refused(lambda d: pack(d, JPEG2000), "JPEG 2000", "do not keep", "RLE")
        refused(lambda d: pack(d, JPEGLSLossless), "frame 1", "header")
        self.refused(lambda d: pack(d, RLELossless), "one bit", "RLE")

    def test_packings(self):
        odd = organs()[1:, 1:, 1:] % 251
        palette = LabelMap(odd)
        palette.is_palette = True
        masks = {s: 0.3 * ~mask + 0.7 * mask for s, mask in self.masks.items()}
        for tool in PACKERS:
            for kind, labels in ((LabelMap(organs(), bits=16), organs()), (palette, odd),
                                 (Segmentation(masks, fractional=True), None)):
                with self.subTest(tool=tool, kind=kind):
                    kind.tool = tool
                    self.check(kind, labels)

    @NEEDS_TOOLS
    def test_packings_with_a_loss(self):
        for tool in LOSSY:
            for kind in (LabelMap(organs() % 251), LabelMap(organs(), bits=16),
                         Segmentation(self.masks, fractional=True)):
                with self.subTest(tool=tool, kind=kind):
                    kind.tool = tool
                    self.refused(lambda d: None, "Transfer Syntax UID", "do not keep",
                                 segmentation=kind)

    @NEEDS_TOOLS
    def test_frames_in_several_fragments(self):
        numbers = numpy.random.default_rng(5).integers(0, 60000, (40, 30, 3))
        label_map = LabelMap(numbers, bits=16)
        label_map.save("plain.dcm")
        for tool in LOSSLESS:
            for has_table in (False, True):
                with self.subTest(tool=tool, has_table=has_table):
                    data = label_map.packed(tool)
                    data.PixelData = encapsulate(decode_data_sequence(data.PixelData), 2, has_table)
                    data.save_as("s.dcm", write_like_original=False)
                    voxels = [json.loads(run("info", file, "--json"))["labels"]
                              for file in ("plain.dcm", "s.dcm")]
                    self.assertEqual(voxels[0], voxels[1])

    def test_frames_cut_short(self):
        for tool in PACKERS:
            label_map = LabelMap(organs(), bits=16)
            label_map.tool = tool
            for frame in (0, 3, -1):
                for cut in (cut_at(5), cut_at(20), cut_at(-30), cut_at(-2)):
                    with self.subTest(tool=tool, frame=frame):
                        self.refused(lambda d: change_frame(d, frame, cut), "Pixel Data", "frame ",
                                     segmentation=label_map)
            if tool != RLE:
                self.refused(lambda d: change_frame(d, 3, lambda data: cut_at(12)(data) + JPEG_END),
                             "Pixel Data", "frame 4", segmentation=label_map)
            self.refused(lambda d: change_frame(d, 3, None), "Pixel Data", segmentation=label_map)

    def test_frames_of_another_size(self):
        for tool in PACKERS:
            label_map = LabelMap(organs(), bits=16)
            label_map.tool = tool
            for rows in (-1, 1):
                self.refused(lambda d: setattr(d, "Rows", d.Rows + rows), "frame 1",
                             segmentation=label_map)
            self.refused(lambda d: setattr(d, "BitsAllocated", 8), "frame 1",
                         segmentation=label_map)

    def test_damage_is_refused_or_read(self):
        self.check_damage(Segmentation(self.masks))
        self.check_damage(LabelMap(organs(), bits=16))
        for tool in PACKERS:
            packed = LabelMap(organs(), bits=16)
            packed.tool = tool
            self.check_damage(packed, rounds=60)

    def check_damage(self, segmentation, rounds=150):
        chance = random.Random(41)
        segmentation.save("good.dcm")
        with open("good.dcm", "rb") as file:
            good = file.read()
        refused = 0
        for i in range(rounds):
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
        self.assertGreater(refused, rounds // 4)


if __name__ == "__main__":
    unittest.main()
