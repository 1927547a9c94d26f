# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Volumes with a label of its own in each voxel, and what the program tells of them: all voxels."""
import itertools
import json
import pathlib
import struct
import sys
import unittest

from program import enter_folder, refused, run

try:
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

TYPES = ("u1", "u2", "u4", "u8", "i1", "i2", "i4", "i8")


def name_of(kind):
    """What the program calls a type of voxels."""
    return f"{kind.kind}{8 * kind.itemsize}"


def distinct(random, shape, kind):
    """Labels from the least to the largest of the type, each of them once."""
    limits, count = numpy.iinfo(kind), int(numpy.prod(shape))
    least, span = int(limits.min), int(limits.max) - int(limits.min)
    labels = [least + i * span // max(count - 1, 1) for i in range(count)]
    return random.permutation(numpy.array(labels, kind)).reshape(shape)


def pick_shape(random, most, axes=3):
    return tuple(int(n) for n in random.integers(1, most + 1, axes))


def voxels(facts):
    """All labels, z, y, x, of a volume in which one label at most is there more than once."""
    rows = facts["labels"]["per_label"]
    assert sum(row["voxels"] > 1 for row in rows) <= 1, rows
    most = max(rows, key=lambda row: row["voxels"])["label"]
    out = numpy.full(facts["shape_xyz"][::-1], most, dtype=object)
    least = [min(row["lo"][axis] for row in rows) for axis in range(3)]
    for row in rows:
        if row["voxels"] == 1:
            x, y, z = (n - first for n, first in zip(row["lo"], least))
            out[z, y, x] = row["label"]
    return out.tolist()


def save_v2(folder, labels, chunks, write_empty_chunks=False, dimension_separator=".", compressor=None,
            **others):
    """An array of Zarr 2 by zarr 2 or 3, which have different words for the same."""
    import zarr
    others = {"store": folder, "shape": labels.shape, "chunks": chunks, "dtype": labels.dtype,
              "fill_value": 0, **others}
    if hasattr(zarr, "create_array"):
        array = zarr.create_array(
            zarr_format=2, compressors=compressor, config={"write_empty_chunks": write_empty_chunks},
            chunk_key_encoding={"name": "v2", "separator": dimension_separator}, **others)
    else:
        array = zarr.create(compressor=compressor, write_empty_chunks=write_empty_chunks,
                            dimension_separator=dimension_separator, **others)
    array[:] = labels


def write(path, content):
    """Makes the folders above, too; what is no text or bytes is written as JSON."""
    path = pathlib.Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    if not isinstance(content, (bytes, str)):
        content = json.dumps(content)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())


def cells(shape, chunk):
    """(number, where its voxels are) of each chunk."""
    for index in numpy.ndindex(*(-(-n // c) for n, c in zip(shape, chunk))):
        yield index, tuple(slice(i * c, (i + 1) * c) for i, c in zip(index, chunk))


def padded(array, chunk, filling):
    """The array in whole chunks."""
    out = numpy.full([-(-n // c) * c for n, c in zip(array.shape, chunk)], filling, array.dtype)
    out[tuple(map(slice, array.shape))] = array
    return out


def crc32c(data):
    crc = 0xffffffff
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0x82f63b78 & -(crc & 1))
    return struct.pack("<I", crc ^ 0xffffffff)


class Stores(unittest.TestCase):
    """Each test in an empty folder."""

    def setUp(self):
        enter_folder(self)
        self.random = numpy.random.default_rng(7)
        self.names = (f"a{i}" for i in itertools.count())

    def facts(self, path, *arguments):
        return json.loads(run("info", path, "--json", *arguments))

    def expect(self, facts, **values):
        """Facts have these values; spacing stands for spacing_xyz."""
        for name, value in values.items():
            got = facts[name if name in facts else name + "_xyz"]
            self.assertEqual(got, list(value) if isinstance(value, tuple) else value, name)

    def check(self, path, labels, *arguments, **values):
        """All voxels, those of a box, and facts."""
        facts = self.facts(path, *arguments)
        self.expect(facts, shape=labels.shape[::-1], **values)
        self.assertEqual(voxels(facts), labels.tolist(), path)
        lo = numpy.array(facts.get("boxes", {}).get("crop", {"lo": [0, 0, 0]})["lo"])
        first = [int(self.random.integers(n)) for n in labels.shape]
        last = [int(self.random.integers(f, n)) + 1 for f, n in zip(first, labels.shape)]
        crop = ",".join(map(str, [*lo + first[::-1], *lo + last[::-1]]))
        box = self.facts(path, "--crop=" + crop, *arguments)
        part = labels[tuple(map(slice, first, last))]
        self.assertEqual(voxels(box), part.tolist(), (path, crop))

    def refuse(self, words, path, *arguments, code=3):
        """A word, or all of several; the path is named, too."""
        words = [words] if isinstance(words, str) else words
        refused([*words, str(path)], "info", path, *arguments, code=code)
