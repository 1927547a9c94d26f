#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""N5 arrays after the format's description give back their labels and lie where their attributes
say; broken ones are refused by name."""
import bz2
import gzip
import json
import lzma
import os
import pathlib
import shutil
import struct
import sys
import unittest
import zlib

from stores import (TYPES, Stores, cells, distinct, name_of, numpy, padded, pick_shape, voxels,
                    write)

try:
    import numcodecs
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

PACKINGS = (({"type": "raw"}, bytes), ({"type": "gzip", "level": -1}, gzip.compress),
            ({"type": "gzip", "useZlib": True}, zlib.compress),
            ({"type": "bzip2", "blockSize": 9}, bz2.compress),
            ({"type": "xz", "preset": 0}, lzma.compress),
            ({"type": "lz4", "id": "lz4"}, numcodecs.LZ4().encode),
            ({"type": "zstd", "level": 3}, numcodecs.Zstd().encode),
            ({"type": "blosc", "cname": "zstd"}, numcodecs.Blosc("zstd").encode))


class Array:
    """Labels are z, y, x; others: extents of blocks along axes of one entry, put in behind the
    first `before` of x, y and z."""

    def __init__(self, labels, block=(4, 4, 4), packing=PACKINGS[0], others=(), before=3,
                 whole_blocks=False, counted=0, **attributes):
        self.labels, self.block, self.others, self.before = labels, block, others, before
        self.compression, self.pack = packing
        self.whole_blocks, self.counted, self.more = whole_blocks, counted, attributes

    def with_others(self, of_axes, others):
        out = list(of_axes)
        out[self.before:self.before] = others
        return out

    def attributes(self):
        ones = [1] * len(self.others)
        return {"dimensions": self.with_others(self.labels.shape[::-1], ones),
                "blockSize": self.with_others(self.block, self.others),
                "dataType": self.labels.dtype.newbyteorder("=").name,
                "compression": self.compression, **self.more}

    def save(self, folder):
        """Blocks whose labels are all 0 are not written; what is no voxel is anything."""
        write(f"{folder}/attributes.json", self.attributes())
        voxels_of = self.labels.T.reshape(self.attributes()["dimensions"])
        block = self.attributes()["blockSize"]
        whole = padded(voxels_of, block, 77)
        for number, where in cells(voxels_of.shape, block):
            if not voxels_of[where].any():
                continue
            part = whole[where]
            if not self.whole_blocks:
                held = voxels_of[where].shape
                is_other = self.with_others([False] * 3, [True] * len(self.others))
                part = part[tuple(slice(b if o else h)
                                  for h, b, o in zip(held, block, is_other))]
            head = struct.pack(">HH", self.counted, part.ndim)
            head += struct.pack(f">{part.ndim}I", *part.shape)
            head += struct.pack(">I", part.size) if self.counted else b""
            data = part.astype(part.dtype.newbyteorder(">")).tobytes(order="F")
            write(f"{folder}/{'/'.join(map(str, number))}", head + bytes(self.pack(data)))


def transform(scale, translate, axes="zyx", **others):
    return {"axes": list(axes), "scale": scale, "translate": translate, **others}


class N5(Stores):
    def setUp(self):
        super().setUp()
        self.labels = distinct(self.random, (5, 6, 7), "u4")

    def test_random_arrays(self):
        draw = self.random.integers
        for i in range(40):
            kind = self.random.choice(TYPES)
            labels = distinct(self.random, pick_shape(self.random, 6), kind)
            if draw(2):
                labels[labels == 0] = 1
                labels[:draw(len(labels) + 1)] = 0
            others = [int(draw(1, 4))] * draw(3) if min(labels.shape) > 1 else []
            name = next(self.names)
            Array(labels, tuple(int(n) for n in draw(2, 6, 3)), PACKINGS[i % len(PACKINGS)], others,
                  draw(4), bool(draw(2)), int(draw(4) == 0)).save(name)
            self.check(name, labels, format="n5", type=name_of(labels.dtype))

    def test_blocks_of_the_description(self):
        """1 x 2 x 3 values 1 to 6 in four packings, and as a stored block of lz4-java."""
        head = "00000003000000010000000200000003"
        for packing, data in (
                ("raw", "000100020003000400050006"),
                ("bzip2", "425a6839314159265359023e0dd200000040007f00200031"
                          "0c010d31a87394337c5dc914e1424008f83748"),
                ("gzip", "1f8b08000000000000006360646062606660616065600300aaea6dbf0c000000"),
                ("xz", "fd377a585a000004e6d6b4460200210116000000742fe5a301000b00010002000300040005"
                       "0006000d0309ca34ec15a70001240ca618d8d81fb6f37d010000000004595a"),
                ("lz4", "4c5a34426c6f636b160c0000000c00000090258b060001000200030004000500064c5a34"
                        "426c6f636b16000000000000000000000000")):
            write("a/attributes.json", {"dimensions": [1, 2, 3], "blockSize": [1, 2, 3],
                                        "dataType": "uint16", "compression": {"type": packing}})
            write("a/0/0/0", bytes.fromhex(head + data))
            self.assertEqual(numpy.ravel(voxels(self.facts("a"))).tolist(), [1, 2, 3, 4, 5, 6])

    def test_slices_and_old_attributes(self):
        write("a/attributes.json", {"dimensions": [3, 2], "blockSize": [2, 2], "dataType": "uint8",
                                    "compressionType": "raw"})
        write("a/0/0", bytes.fromhex("000000020000000200000002 01020405"))
        write("a/1/0", bytes.fromhex("000000020000000100000002 0306"))
        self.check("a", numpy.arange(1, 7).reshape(1, 2, 3))

    def told(self, *options, **attributes):
        write("a/attributes.json", Array(self.labels, **attributes).attributes())
        return self.facts("a", *options)

    def test_place_by_attributes(self):
        nm = ["nm"] * 3
        for attributes, spacing, origin, unit in (
                ({}, [1, 1, 1], [0, 0, 0], None),
                ({"pixelResolution": {"dimensions": [0.5, 0.25, 2], "unit": "micron"}},
                 [0.5, 0.25, 2], [0, 0, 0], "um"),
                ({"resolution": [4, 5, 40], "units": nm, "offset": [8, 0, -3]}, [4, 5, 40],
                 [8, 0, -3], "nm"),
                ({"resolution": [4, 5, 40], "unit": "pixel"}, [4, 5, 40], [0, 0, 0], None),
                # COSEM puts the centre of the first voxel.
                ({"transform": transform([40, 5, 4], [20, 102.5, 2], units=nm)}, [4, 5, 40],
                 [0, 100, 0], "nm")):
            self.expect(self.told(**attributes), spacing=spacing, origin=origin, unit=unit)

    def test_options_replace_what_is_not_looked_at(self):
        given = ("--spacing", "1,2,3", "--origin", "7,8,9")
        for attributes in ({"resolution": "?", "offset": []},
                           {"transform": {"axes": [], "scale": 3, "translate": {}}}):
            self.expect(self.told(*given, **attributes), spacing=[1, 2, 3], origin=[7, 8, 9])

    def test_offsets_of_whole_voxels_count(self):
        """An offset of whole voxels is a number of the first voxel, whatever options replace."""
        given = ["--spacing", "1,2,3", "--origin", "7,8,9"]
        for options, attributes, number in (
                (given, {}, None),
                (given, {"resolution": [4, 5, 40], "offset": [8, 0, -120]}, [2, 0, -3]),
                (given, {"resolution": [4, 5, 40], "offset": [8, 0, -100]}, None),
                (given, {"transform": transform([40, 5, 4], [80, 100, -4])}, [-1, 20, 2]),
                (given, {"transform": transform([40, 5, 4], [80, 102.5, -4])}, None),
                (given, {"resolution": "?", "offset": []}, None),
                ([], {"offset": [8, 0, -3]}, [8, 0, -3])):
            boxes = self.told(*options, **attributes).get("boxes")
            self.assertEqual(boxes and boxes["crop"]["lo"], number, attributes)

    def test_damaged_places_are_named(self):
        for attributes, *words in (
                ({"resolution": [4, 5]}, "resolution", "2 numbers"),
                ({"resolution": [4, 0, 5]}, "resolution", "spacing 0"),
                ({"resolution": [4, -1, 5]}, "resolution", "spacing -1"),
                ({"resolution": [4, float("nan"), 5]}, "JSON"),
                ({"resolution": [4, 4, 5], "units": ["nm", "um", "nm"]}, "units", "different"),
                ({"offset": [1, 2, "3"]}, "offset", '"3"'),
                ({"pixelResolution": {"unit": "nm"}}, "pixelResolution.dimensions", "missing"),
                ({"transform": transform([1, 1, 1], [0, 0, 0], "abc")}, "transform.axes"),
                ({"transform": transform([1, 1], [0, 0, 0])}, "transform.scale"),
                ({"transform": {"axes": ["z", "y", "x"]}}, "transform.scale", "missing")):
            write("a/attributes.json", Array(self.labels, **attributes).attributes())
            self.refuse([*words, "attributes.json"], "a")
        good = json.dumps(Array(self.labels, resolution=[4, 9, 5]).attributes())
        write("a/attributes.json", good.replace("9", "1e999"))
        self.refuse(["JSON", "attributes.json"], "a")

    def pyramid(self, group, fine, coarse):
        write("p/attributes.json", {"n5": "2.0.0", **group})
        for level, attributes in (("s0", fine), ("s1", coarse)):
            Array(self.labels, **attributes).save(f"p/{level}")

    def spacing(self, level):
        by_number = self.facts("p", "--scale", level)
        by_folder = self.facts(f"p/s{level}/")
        for key in ("spacing_xyz", "origin_xyz"):
            self.assertEqual(by_number[key], by_folder[key])
        return by_number["spacing_xyz"]

    def test_levels_of_pyramids(self):
        resolution, own = {"resolution": [4, 4, 40]}, {"resolution": [8, 8, 40]}
        factors = {"downsamplingFactors": [2, 2, 1]}
        table = {"downsamplingFactors": [[1, 1, 1], [2, 2, 1]]}
        viewer = {"scales": [[1, 1, 1], [2, 2, 1]]}
        for group, fine, coarse in (
                (resolution, {}, factors),  # BigDataViewer
                (resolution | table, {}, {}),  # Neuroglancer
                (resolution | viewer, {}, {}),  # n5-viewer
                ({}, resolution, factors),  # of the finest level
                ({}, resolution, resolution | factors),  # the same for all: that of the finest
                (resolution, {}, own | factors),  # of its own
                ({}, resolution, own)):
            self.pyramid(group, fine, coarse)
            self.assertEqual([self.spacing(0), self.spacing(1)], [[4, 4, 40], [8, 8, 40]],
                             (group, fine, coarse))
        self.pyramid(table, {}, {})
        self.assertEqual(self.spacing(1), [2, 2, 1])
        self.pyramid(resolution | {"offset": [1, 2, 3]}, {}, factors)
        self.expect(self.facts("p/s1"), origin=[1, 2, 3])
        self.pyramid(resolution, {}, {})
        self.refuse(["s1/attributes.json", "downsamplingFactors", "--spacing"], "p", "--scale", 1)

    def test_cosem_puts_transforms_into_the_group(self):
        nm = {"units": ["nm"] * 3}
        levels = [{"path": "s0", "transform": transform([40, 5, 4], [20, 102.5, 2], **nm)},
                  {"path": "s1", "transform": transform([80, 10, 8], [40, 105, 4], **nm)}]
        group = {"axes": ["z", "y", "x"], "multiscales": [{"name": "a", "datasets": levels}]}
        self.pyramid(group, {}, {"resolution": [1, 1, 1]})
        self.assertEqual([self.spacing(0), self.spacing(1)], [[4, 5, 40], [8, 10, 80]])
        for level in ("p/s0", "p/s1"):
            self.expect(self.facts(level), origin=[0, 100, 0], unit="nm")
        self.pyramid(group, {"transform": transform([1, 2, 3], [0, 0, 0], "xyz")}, {})
        self.assertEqual(self.spacing(0), [1, 2, 3])
        self.pyramid({"multiscales": [{"datasets": [{"path": "s0", "transform": 3}]}]}, {}, {})
        self.refuse("multiscales[0].datasets[0].transform", "p", "--scale", 0)

    def test_the_only_array_is_found(self):
        write("a/attributes.json", {"n5": "2.5.1"})
        self.refuse("no array", "a")
        Array(self.labels).save("a/volumes/labels/s0")
        self.check("a", self.labels)
        raw = distinct(self.random, (2, 2, 2), "u4")
        Array(raw).save("a/volumes/raw")
        self.refuse(["several arrays: volumes/labels, volumes/raw", "--dataset"], "a")
        for name in ("volumes/raw", "/volumes/raw", "volumes/raw/"):
            self.assertEqual(voxels(self.facts("a", "--dataset", name)), raw.tolist())
        for name, scale, *words in (
                ("volumes/nothing", 0, "volumes/labels, volumes/raw"),
                ("volumes/../volumes/raw", 0, "volumes/labels, volumes/raw"),
                ("../x", 0, "volumes/labels, volumes/raw"),
                ("volumes/labels", 3, "--scale 3", "1 levels"),
                ("volumes/raw", 3, "--scale 3", "one resolution")):
            options = ["--dataset", name, *(["--scale", scale] if scale else [])]
            self.refuse([*words, *([] if scale else [name])], "a", *options, code=2)

    def test_links_that_go_round_end(self):
        write("a/attributes.json", {})
        for name in "bcd":
            os.symlink(".", f"a/{name}")
        self.refuse([], "a")

    def test_wrong_attributes(self):
        for key, value, *words in (
                ("dimensions", [7, 6], "blockSize", "3 numbers", "2"),
                ("dimensions", [7], "dimensions", "1 axes"),
                ("dimensions", [7, 6, 5, 2], "dimensions", "4 axes", "pick one"),
                ("dimensions", [7, 0, 5], "dimensions (y)", "not positive"),
                ("dimensions", [7, 6, 1e9], "dimensions (z)", "1000000000"),
                ("dimensions", [7, 6, 1e300], "dimensions", "whole numbers"),
                ("blockSize", [4, -4, 4], "blockSize", "-4"),
                ("blockSize", [4096] * 3, "blockSize", "2 GiB"),
                ("blockSize", [1 << 32, 1 << 32, 4], "blockSize", "2 GiB"),
                ("blockSize", None, "blockSize", "missing"),
                ("dataType", "uint33", "dataType", "uint33"),
                ("compression", {"type": "jpeg"}, "compression.type", "jpeg"),
                ("compression", 7, "compression", "7"),
                ("isLabelMultiset", True, "isLabelMultiset")):
            attributes = {**Array(self.labels).attributes(), key: value}
            if value is None:
                del attributes[key]
            write("a/attributes.json", attributes)
            self.refuse([*words, "a/attributes.json"], "a")

    def test_wrong_blocks(self):
        pair = Array(numpy.array([[[1, 2]]], "u4"))
        pair.save("a")
        block = pathlib.Path("a/0/0/0")
        self.assertEqual(voxels(self.facts("a")), [[[1, 2]]])
        size, data = "000000020000000100000001", "0000000100000002"
        for content, *words in (
                ("", "truncated"), ("00000003" + size[:22], "truncated"),
                ("00020003" + size + data, "block header", "mode 2"),
                ("00000002" + size + data, "block header", "2 axes"),
                ("00010003" + size + "00000003" + data, "block header", "3 values for 2"),
                ("00000003000000010000000100000001" + data, "block header", "extent 1", "along x"),
                ("00000003000000020000000000000001" + data, "block header", "extent 0"),
                ("00000003000000020000000500000001" + data, "block header", "extent 5"),
                ("00000003ffffffffffffffffffffffff" + data, "block header", "extent 4294967295"),
                ("00000003" + size + data[2:], "7 bytes", "are 8"),
                ("00000003" + size + data + "00", "9 bytes", "are 8")):
            write(block, bytes.fromhex(content))
            self.refuse([*words, str(block)], "a")

    def test_files_that_are_far_too_large(self):
        """Files with a hole of 64 GiB: a reader that believes their size runs out of memory."""
        for name in ("attributes.json", "0/0/0"):
            Array(self.labels).save("a")
            os.truncate(f"a/{name}", 1 << 36)
            self.refuse([name, "68719476736 bytes"], "a")
            shutil.rmtree("a")


if __name__ == "__main__":
    unittest.main()
