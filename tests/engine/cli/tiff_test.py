#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""TIFF stacks that tifffile writes, in every layout, and with tags that were changed then; PNG
pictures by the specification; folders of both."""
import itertools
import os
import pathlib
import struct
import sys
import unittest
import zlib

from program import run, start
from stores import TYPES, Stores, distinct, name_of, numpy, voxels, write

try:
    from tifffile import TiffFile, TiffWriter, imwrite
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SHAPE = (3, 4, 5)


def save(path, labels, **options):
    imwrite(path, labels, **{"photometric": "minisblack", "metadata": None, "rowsperstrip": 2,
                             **options})


def lzw(plain):
    """All bytes literal, in codes of 9 bits: the table is cleared before they get longer."""
    codes = [c for i, byte in enumerate(plain) for c in ([256, byte] if i % 200 == 0 else [byte])]
    bits = "".join(f"{code:09b}" for code in [*codes, 257])
    bits += "0" * (-len(bits) % 8)
    return int(bits, 2).to_bytes(len(bits) // 8, "big")


def bilevel(strips, width, height, photometric, order, packing):
    """A page of one strip for each of these, with all tags by hand."""
    content, links = bytearray(b"II*\0" + bytes(4)), 4
    for strip in strips:
        at = len(content)
        content += strip + bytes(len(strip) % 2)
        content[links:links + 4] = struct.pack("<I", len(content))
        tags = ((256, width), (257, height), (258, 1), (259, packing), (262, photometric),
                (266, order), (273, at), (277, 1), (278, height), (279, len(strip)))
        content += struct.pack("<H", len(tags))
        for tag, value in tags:
            content += struct.pack("<HHII", tag, 4, 1, value)
        links = len(content)
        content += bytes(4)
    return bytes(content)


def ome(pixels, more=""):
    return ('<?xml version="1.0"?><OME xmlns="http://www.openmicroscopy.org/Schemas/OME/2016-06">'
            '<Image ID="Image:0"><Pixels DimensionOrder="XYZCT" Type="uint8" SizeX="5" SizeY="4" '
            f"{pixels}>{more}</Pixels></Image></OME>")


class Tiff(Stores):
    def setUp(self):
        super().setUp()
        self.labels = distinct(self.random, SHAPE, "u1")

    def test_every_type_byte_order_and_size_of_offsets(self):
        for kind, byteorder, big in itertools.product(TYPES, "<>", (False, True)):
            labels = distinct(self.random, SHAPE, kind)
            save("a.tif", labels, byteorder=byteorder, bigtiff=big)
            facts = self.facts("a.tif")
            self.expect(facts, format="tiff", type=name_of(labels.dtype), origin=[0, 0, 0])
            self.assertEqual(voxels(facts), labels.tolist(), (kind, byteorder, big))

    def test_strips_and_tiles(self):
        draw = self.random.integers
        for i in range(18):
            labels = distinct(self.random, (draw(1, 4), draw(1, 50), draw(1, 50)), "u2")
            options = {"tile": (16 * int(draw(1, 4)), 16 * int(draw(1, 3)))} if i % 3 == 0 else {
                "rowsperstrip": int(draw(1, 30))}
            save("a.tif", labels, compression=[None, "zlib", "lzma"][i // 3 % 3],
                 byteorder="<>"[i % 2], **options)
            self.check("a.tif", labels)

    def test_lzw(self):
        labels = distinct(self.random, (2, 30, 40), "u2")
        strips = (lzw(page[y:y + 7].tobytes()) for page in labels for y in range(0, 30, 7))
        imwrite("a.tif", strips, shape=labels.shape, dtype="u2", photometric="minisblack",
                metadata=None, rowsperstrip=7, compression="zlib")
        for page in range(2):
            with TiffFile("a.tif", mode="r+b") as file:
                file.pages[page].tags["Compression"].overwrite(5)
        self.check("a.tif", labels)

    def test_bits_are_1_where_they_are_white(self):
        for i, width in enumerate((2, 7, 8, 9, 30)):
            white = self.random.random((3, 11, width)) < 0.4
            for photometric, bits in (("minisblack", white), ("miniswhite", ~white)):
                for options in ({"rowsperstrip": 4}, {"rowsperstrip": 11}, {"tile": (16, 16)}):
                    save("b.tif", bits, photometric=photometric, byteorder="<>"[i % 2],
                         bigtiff=i > 2, **options)
                    self.check_bits("b.tif", white)
        # A strip that is left out is label 0, also where bits of 0 are white.
        with TiffFile("b.tif", mode="r+b") as file:
            for tag in ("TileOffsets", "TileByteCounts"):
                file.pages[1].tags[tag].overwrite((0,) * len(file.pages[1].tags[tag].value))
        white[1] = False
        self.check_bits("b.tif", white)

    def test_packed_bits_and_bits_in_the_other_order(self):
        white = self.random.random((2, 6, 19)) < 0.4
        rows = numpy.packbits(white, axis=-1)
        for order, photometric in itertools.product((1, 2), (0, 1)):
            stored = rows if photometric == 1 else ~rows
            if order == 2:
                stored = numpy.packbits(numpy.unpackbits(stored, axis=-1, bitorder="little"),
                                        axis=-1).reshape(stored.shape)
            packing, before = (32773, b"\x02") if order == 1 else (1, b"")
            write("p.tif", bilevel([b"".join(before + row.tobytes() for row in page)
                                    for page in stored], 19, 6, photometric, order, packing))
            self.check_bits("p.tif", white)

    def check_bits(self, path, white):
        facts = self.facts(path)
        self.expect(facts, shape=white.shape[::-1], type="u8", format="tiff")
        rows = {row["label"]: row["voxels"] for row in facts["labels"]["per_label"]}
        self.assertEqual(rows.get(1, 0), white.sum())
        self.assertEqual(sum(rows.values()), white.size)
        for _ in range(3):
            z, y, x = (int(self.random.integers(n)) for n in white.shape)
            voxel = self.facts(path, "--crop", f"{x},{y},{z},{x + 1},{y + 1},{z + 1}")
            self.assertEqual(voxels(voxel), [[[int(white[z, y, x])]]])

    def test_floats_hold_whole_numbers(self):
        save("a.tif", numpy.array([[[3, 1.5]]], "f4"))
        self.assertEqual(voxels(self.facts("a.tif", "--crop", "0,0,0,1,1,1")), [[[3]]])
        self.refuse(["voxel (1, 0, 0)", "1.5"], "a.tif")

    def test_smaller_copies_are_no_slices(self):
        for at in range(3):
            with TiffWriter("a.tif") as writer:
                for z, page in enumerate(self.labels):
                    if z == at:
                        writer.write(page[:2, :1], subfiletype=1, metadata=None, contiguous=False)
                    writer.write(page, metadata=None, contiguous=False)
            self.check("a.tif", self.labels)

    def test_palettes_give_indices_and_missing_strips_zero(self):
        colours = numpy.zeros((3, 256), "u2")
        save("a.tif", self.labels, photometric="palette", colormap=colours)
        self.check("a.tif", self.labels)
        save("s.tif", self.labels + 1)
        for page, tag in itertools.product(range(3), ("StripOffsets", "StripByteCounts")):
            with TiffFile("s.tif", mode="r+b") as file:
                found = file.pages[page].tags[tag]
                found.overwrite((found.value[0], 0))
        expected = self.labels + 1
        expected[:, 2:] = 0
        self.check("s.tif", expected)

    def stack(self, lines="", resolution=(125, 125), unit=None, labels=None):
        """ImageJ's description; sizes are 0.008 of the unit."""
        save("j.tif", self.labels if labels is None else labels, resolution=resolution,
             resolutionunit=unit, description="ImageJ=1.53t\nimages=3\nslices=3\n" + lines)
        return "j.tif"

    def test_spacing_and_unit_of_imagej(self):
        path = self.stack("unit=micron\nspacing=2.5\n", (4, 2.5))
        self.expect(self.facts(path), spacing=[0.25, 0.4, 2.5], unit="um")
        self.refuse(["ImageJ channels", "2"], self.stack("channels=2\n"))
        for lines, spacing, unit in (
                ("unit=micron\nspacing=40\nzunit=nm\n", [0.008, 0.008, 0.04], "um"),
                ("unit=nm\nspacing=0.04\nzunit=micron\n", [0.008, 0.008, 40], "nm"),
                ("unit=mm\nspacing=2\nyunit=mm\nzunit=cm\n", [0.008, 0.008, 20], "mm"),
                ("unit=mm\nspacing=2\nyunit=cm\n", [0.008, 0.08, 2], "mm"),
                ("unit=\\u00B5m\nspacing=2\nyunit=\\u00B5m\nzunit=inch\n",
                 [0.008, 0.008, 50800], "um")):
            facts = self.facts(self.stack(lines))
            self.expect(facts, unit=unit)
            numpy.testing.assert_allclose(facts["spacing_xyz"], spacing, rtol=1e-15)
        # What cannot be turned is refused, unless the caller gives all three in one unit.
        self.refuse(["(z)", "--spacing"], self.stack("unit=pixel\nspacing=2\nzunit=nm\n"))
        path = self.stack("unit=mm\nspacing=2\nyunit=furlong\n")
        self.refuse(["(y)", "--spacing"], path)
        self.expect(self.facts(path, "--spacing", "3,2,1"), spacing=[3, 2, 1])

    def test_resolutions_of_others_are_no_sizes(self):
        """Those in centimetres are told."""
        for unit, word in ((None, ""), (3, "2000 x 2500 pixels a centimetre")):
            save("a.tif", self.labels, description="a scan", resolution=(2000, 2500),
                 resolutionunit=unit)
            self.expect(self.facts("a.tif"), spacing=[1, 1, 1])
            done = start("info", "a.tif")
            self.assertIn(word, done.stderr)
            self.assertEqual("0.005 mm in x" in done.stderr, bool(word))
            self.assertIn("does not say how large voxels are",
                          run("mesh", "a.tif", "-o", "a.vtu"))
        self.assertEqual(start("info", "a.tif", "--spacing", "1").stderr, "")
        # ImageJ means it, and says the step in z.
        path = self.stack("spacing=0.001\n", (2000, 2500), 3)
        self.expect(self.facts(path), spacing=[0.0005, 0.0004, 0.001], unit="cm")
        self.assertEqual(start("info", path).stderr, "")

    def test_imagej_stacks_of_one_directory(self):
        """ImageJ's way above 4 GiB: all slices behind each other."""
        labels = distinct(self.random, (6, 4, 5), "u2")
        for byteorder in "<>":
            imwrite("a.tif", labels, imagej=True, truncate=True, byteorder=byteorder,
                    metadata={"axes": "ZYX"})
            self.check("a.tif", labels)
            content = pathlib.Path("a.tif").read_bytes()
            many = content.replace(b"images=6", b"images=9").replace(b"slices=6", b"slices=9")
            self.assertNotEqual(many, content)
            write("b.tif", many)
            self.refuse("360 bytes", "b.tif")

    def test_sizes_and_units_of_ome(self):
        sizes = 'SizeZ="3" SizeC="1" SizeT="1" '
        half_micron = ('PhysicalSizeX="500" PhysicalSizeXUnit="nm" PhysicalSizeY="500" '
                       'PhysicalSizeYUnit="nm" PhysicalSizeZ="2"')
        data = '<TiffData IFD="0" FirstZ="0"/><TiffData IFD="2" FirstZ="2"/>'
        for pixels, more, spacing, unit in (
                ('PhysicalSizeX="0.5" PhysicalSizeY="0.25" PhysicalSizeZ="2"', data, [0.5, 0.25, 2],
                 "um"),
                (half_micron, "", [500, 500, 2000], "nm"), ("", "", [1, 1, 1], None),
                ('PhysicalSizeX="0.5"', "", [0.5, 0.5, 0.5], "um")):
            save("a.ome.tif", self.labels, description=ome(sizes + pixels, more), ome=False)
            facts = self.facts("a.ome.tif")
            self.expect(facts, unit=unit)
            numpy.testing.assert_allclose(facts["spacing_xyz"], spacing, rtol=1e-12)
        for pixels, more, *words in (
                (sizes + 'PhysicalSizeX="1" PhysicalSizeY="1"', "", "(z)", "--spacing"),
                ('SizeZ="4"', "", "4 slices", "3 pages"), ('SizeZ="3" SizeC="2"', "", "SizeC", "2"),
                ('SizeZ="3" SizeT="2"', "", "SizeT", "2"),
                ('SizeZ="3" oops', "", "OME-XML at offset"),
                (sizes, '<TiffData IFD="0" FirstZ="2"/>', "TiffData", "slice 2 is page 0")):
            save("a.ome.tif", self.labels, description=ome(pixels, more), ome=False)
            self.refuse(words, "a.ome.tif")

    def test_what_is_wrong_is_named(self):
        for content in (b"II*", b"plain text"):
            write("a.tif", content)
            self.refuse("TIFF header", "a.tif")
        save("a.tif", numpy.zeros((3, 4, 5, 3), "u1"), photometric="rgb", planarconfig="contig")
        self.refuse(["page 1", "3 samples", "one channel"], "a.tif")
        for page, tag, value, *words in (
                (2, "BitsPerSample", 16, "page 3", "u16", "the first slice is 5 x 4 pixels of u8"),
                (2, "BitsPerSample", 12, "page 3", "12 bits"),
                (0, "Compression", 34892, "page 1", "compression 34892"),
                (0, "ImageWidth", 1000000, "page")):
            save("a.tif", self.labels)
            with TiffFile("a.tif", mode="r+b") as file:
                file.pages[page].tags[tag].overwrite(value)
                if tag == "ImageWidth":
                    file.pages[page].tags["ImageLength"].overwrite(value)
            self.refuse(words, "a.tif")
        with TiffWriter("a.tif") as writer:
            for page in self.labels:
                writer.write(page, metadata=None, contiguous=False)
        with TiffFile("a.tif") as file:
            last = file.pages[2].offset
        os.truncate("a.tif", last + 20)
        self.refuse("page 3", "a.tif")


# First column and row of each of the passes of Adam7, and its steps.
PASSES = ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2),
          (0, 1, 1, 2))


def png(values, depth=8, kind=0, interlaced=0):
    """kind: 0, grey; 3, palette."""
    rows = b""
    for x, y, dx, dy in PASSES if interlaced else ((0, 0, 1, 1),):
        for row in values[y::dy, x::dx]:
            if row.size:
                bits = numpy.unpackbits(row.astype(">u2").view("u1").reshape(-1, 2), axis=1)
                rows += b"\0" + numpy.packbits(bits[:, -depth:]).tobytes()
    head = struct.pack(">IIBBBBB", *values.shape[::-1], depth, kind, 0, 0, interlaced)
    parts = [(b"IHDR", head),
             *([(b"PLTE", b"p" * (3 << depth))] if kind == 3 else []),
             (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        for name, data in parts)


class Slices(Stores):
    def below(self, bits, shape=(4, 5)):
        return self.random.integers(0, 1 << bits, shape)

    def test_every_depth_kind_and_interlace_of_png(self):
        """Each value but 0 is there once."""
        depths = ((0, 1), (0, 2), (0, 4), (0, 8), (0, 16), (3, 1), (3, 2), (3, 4), (3, 8))
        for (kind, depth), width, interlaced in itertools.product(depths, (1, 3, 13), (0, 1)):
            values = numpy.zeros((11, width), int)
            some = min(values.size, (1 << depth) - 1)
            values.flat[self.random.permutation(values.size)[:some]] = range(1, some + 1)
            write("a.png", png(values, depth, kind, interlaced))
            facts = self.facts("a.png")
            self.expect(facts, format="png", type="u16" if depth == 16 else "u8")
            self.assertEqual(voxels(facts), [values.tolist()], (kind, depth, width, interlaced))

    def test_png_and_tiff_in_natural_order(self):
        labels = distinct(self.random, (12, 4, 5), "u1")
        for ending in ("png", "tif"):
            write(f"{ending}/notes.txt", "no slice")
            write(f"{ending}/.hidden.tif", "no slice")
            os.makedirs(f"{ending}/sub.tif")
            for z, page in enumerate(labels):
                name = f"{ending}/s{z + 1}."
                if ending == "png":
                    write(name + "PNG", png(page))
                else:
                    save(name + ["tif", "tiff"][z % 2], page, byteorder="<>"[z % 3 == 0],
                         rowsperstrip=1 + z % 4, compression=[None, "zlib"][z % 2])
            self.check(ending, labels, format="png" if ending == "png" else "tiff")

    def test_what_is_wrong_with_a_png_is_named(self):
        good = png(self.below(8))
        for content, *words in (
                (good[:20], "PNG header"), (good[:60], "PNG data", "truncated"),
                (good[:25] + b"\2" + good[26:], "colours", "palette"),
                (good[:16] + struct.pack(">II", 1 << 19, 1 << 19) + good[24:],
                 "524288 x 524288", "the file has"),
                (good[:50] + bytes([good[50] ^ 4]) + good[51:], "PNG data")):
            write("a.png", content)
            self.refuse(words, "a.png")

    def test_what_is_wrong_with_a_folder_is_named(self):
        good, one = png(self.below(8)), self.below(8).astype("u1")
        os.makedirs("a")
        self.refuse("folder", "a")
        for name in ("s1", "s2", "s4"):
            write(f"a/{name}.png", good)
        self.refuse(["s4.png", "s2.png", "missing"], "a")
        for content, *words in (
                (png(self.below(8, (5, 4))), "s3.png", "4 x 5 pixels", "the first slice is 5 x 4"),
                (png(self.below(16), 16), "s3.png", "u16", "u8"), (b"", "s3.png")):
            write("a/s3.png", content)
            self.refuse(words, "a")
        write("a/s3.png", good)
        write("a/s5.tif", "")
        self.refuse(["s5.tif", "s1.png", "TIFF and PNG"], "a")
        for name in ("s1", "s2", "s3", "s4"):
            os.remove(f"a/{name}.png")
        self.refuse(["s5.tif", "empty"], "a")
        save("a/s5.tif", self.below(8, SHAPE).astype("u1"))
        self.refuse(["s5.tif", "several"], "a")
        save("a/s5.tif", one)
        save("a/s6.tif", one.astype("i1"))
        self.refuse(["s6.tif", "i8", "u8"], "a")
        save("a/s6.tif", one)
        self.expect(self.facts("a"), shape=[5, 4, 2])


if __name__ == "__main__":
    unittest.main()
