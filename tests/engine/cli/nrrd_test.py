#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""NRRD in text and in many files, by the letter of its definition and, where it is installed, as
pynrrd writes it."""
import gzip
import itertools
import sys
import unittest

from program import refused
from stores import TYPES, Stores, distinct, name_of, numpy, pick_shape, write

NAMES = {"u1": "uchar", "u2": "ushort", "u4": "uint", "u8": "ulonglong", "i1": "int8",
         "i2": "short", "i4": "int", "i8": "longlong", "f4": "float", "f8": "double"}


def header(kind, shape, encoding, *fields):
    """Shape is that of the array, slowest first."""
    kind = numpy.dtype(kind)
    lines = ["NRRD0004", f"type: {NAMES[kind.str[1:]]}", f"dimension: {len(shape)}",
             "sizes: " + " ".join(map(str, shape[::-1])), f"encoding: {encoding}",
             f"endian: {'big' if kind.str[0] == '>' else 'little'}", *fields]
    return "\n".join(lines) + "\n"


def words(labels, separator=" "):
    return separator.join(map(str, labels.ravel().tolist()))


class Nrrd(Stores):
    def test_text_of_every_type(self):
        for kind, encoding in zip((*TYPES, "f4", "f8"), itertools.cycle(("text", "txt", "ascii"))):
            shape = pick_shape(self.random, 7)
            labels = (distinct(self.random, shape, kind) if kind[0] != "f"
                      else numpy.arange(numpy.prod(shape), dtype=kind).reshape(shape))
            head = header(kind, shape, encoding, "spacings: 2 1 0.5")
            for separator in (" ", "\n", ", ", "\r\n\t"):
                write("a.nrrd", head + "\n" + words(labels, separator) + "\n")
                self.check("a.nrrd", labels.astype(int) if kind[0] == "f" else labels,
                           type=name_of(labels.dtype), spacing=(2, 1, 0.5))
            write("v.txt", words(labels))
            write("a.nhdr", head + "data file: v.txt\n")
            self.check("a.nhdr", labels.astype(int) if kind[0] == "f" else labels)
            write("z.nrrd.gz", gzip.compress((head + "\n" + words(labels)).encode()))
            self.check("z.nrrd.gz", labels.astype(int) if kind[0] == "f" else labels)

    def pieces(self, labels, encoding, axes):
        """The bytes of each file, which has this number of axes."""
        for part in (labels.reshape(-1, *labels.shape[3 - axes:]) if axes < 3
                     else numpy.split(labels, 2)):
            yield {"raw": part.tobytes(), "gzip": gzip.compress(part.tobytes()),
                   "text": words(part).encode()}[encoding]

    def test_lists_and_patterns_of_files(self):
        cases = itertools.product(("raw", "gzip", "text"), ("<i2", ">u4", "u1"), (1, 2, 3))
        for encoding, kind, axes in cases:
            labels = distinct(self.random, (4, 3, 5), kind)
            files = [f"parts/p{i:03d}.bin" for i in range(4 * 3 if axes == 1 else [0, 0, 4, 2][axes])]
            for name, content in zip(files, self.pieces(labels, encoding, axes), strict=True):
                write(name, content)
            head, more = header(labels.dtype, labels.shape, encoding), "" if axes == 2 else f" {axes}"
            with self.subTest(encoding=encoding, kind=kind, axes=axes):
                write("l.nhdr", head + f"data file: LIST{more}\n" + "\r\n".join(files) + "\n\n")
                self.check("l.nhdr", labels, type=name_of(labels.dtype))
                write("p.nhdr", head + f"datafile: parts/p%03d.bin 0 {len(files) - 1} 1{more}\n\n")
                self.check("p.nhdr", labels)
                last = len(files) - 1
                write("b.nhdr", head + f"data file: parts/p%03d.bin {last} 0 -1{more}\n")
                if axes == 2:
                    self.check("b.nhdr", labels[::-1])

    def test_skips_and_bytes_behind(self):
        labels = distinct(self.random, (2, 3, 5), "u1")
        for encoding, skip in (("raw", 3), ("raw", -1), ("gzip", 3)):
            for name, part in zip("ab", labels):
                content = b"xyz" + part.tobytes() + (b"" if skip == -1 else b"behind")
                write(name, gzip.compress(content) if encoding == "gzip" else content)
            write("s.nhdr", header("u1", labels.shape, encoding, f"byte skip: {skip}")
                  + "data file: LIST\na\nb\n")
            self.check("s.nhdr", labels)

    def test_what_is_wrong_is_named(self):
        labels = distinct(self.random, (2, 3, 5), "u1")
        text, raw = (header("u1", labels.shape, e) for e in ("text", "raw"))
        for content, *said in (
                (text + "\n" + words(labels)[:-4], "voxel data", "29 numbers"),
                (text + "\n" + words(labels) + " 7", "more than the 30 numbers"),
                (text + "\n300 " + words(labels), "number 1: '300' is no u8"),
                (text + "\n-1", "is no u8"), (text + "\n1.0", "'1.0'"), (text + "\n", "0 numbers"),
                (raw + "data file: LIST\na\n", "data file", "1 files of 2 axes"),
                (raw + "data file: LIST 3\na\nb\nc\n", "3 files of 3 axes"),
                (raw + "data file: LIST 9\na\nb\n", "of 9 axes"),
                (raw + "data file: LIST x\na\nb\n", "'x' is no number"),
                (raw + "data file: LIST\na\ngone\n", "data file"),
                (raw + "data file: LIST\na\n../a\n", "leads out", "--trust-paths"),
                (raw + "data file: s%03d.raw 1\n", "first, the last and the step"),
                (raw + "data file: s%03d.raw 1 2 0\n", "first, the last and the step"),
                (raw + "data file: s%03d.raw 1 900000000 1\n", "first, the last and the step"),
                (raw + "data file: s%s.raw 1 2 1\n", "pattern with one %d"),
                (raw + "data file: s%d%d.raw 1 2 1\n", "pattern with one %d")):
            write("a", labels[0].tobytes())
            write("w.nhdr", content)
            self.refuse(said, "w.nhdr")
        write("b", labels[1].tobytes()[:-1])
        write("w.nhdr", raw + "data file: LIST\na\nb\n")
        refused(["b: voxel data", "15 bytes"], "info", "w.nhdr")

    def test_files_of_pynrrd(self):
        try:
            import nrrd
        except ImportError as missing:
            self.skipTest(str(missing))
        for encoding in ("text", "raw", "gzip"):
            labels = distinct(self.random, (4, 3, 5), "i2")
            nrrd.write("p.nrrd", labels.transpose(2, 1, 0), {"encoding": encoding})
            self.check("p.nrrd", labels)
            nrrd.write("p.nhdr", labels.transpose(2, 1, 0), {"encoding": encoding})
            self.check("p.nhdr", labels)


if __name__ == "__main__":
    unittest.main()
