#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Zarr stores in ZIP archives, as zarr's ZipStore and Python's zipfile write them; archives that are
damaged or hold something else."""
import itertools
import json
import os
import pathlib
import struct
import sys
import unittest
import warnings
import zipfile

from program import run
from stores import Stores, distinct, numpy, save_v2, write

try:
    import zarr  # which save_v2() writes with
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SHAPE = (5, 7, 9)


def pack(archive, folder, inside="", compression=zipfile.ZIP_DEFLATED):
    """A ZIP archive of a folder."""
    with zipfile.ZipFile(archive, "w", compression) as file:
        for path in sorted(pathlib.Path(folder).rglob("*")):
            if path.is_file():
                file.write(path, os.path.join(inside, path.relative_to(folder)))


class ZarrZip(Stores):
    def setUp(self):
        super().setUp()
        self.labels = distinct(self.random, SHAPE, "u2")
        save_v2("a.zarr", self.labels, (2, 3, 4))

    def test_archives_of_zarr_itself(self):
        if not hasattr(zarr, "ZipStore"):
            self.skipTest("zarr 3 has another ZipStore")
        for i, packing in enumerate((zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)):
            store = zarr.ZipStore(f"{i}.zarr.zip", compression=packing, mode="w")
            array = zarr.create(SHAPE, chunks=(2, 3, 4), dtype="u2", store=store, fill_value=0)
            array[:] = self.labels
            store.close()
            self.check(f"{i}.zarr.zip", self.labels, format="zarr")

    def test_archives_of_folders(self):
        for packing, inside in itertools.product((zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED),
                                                 ("", "deep.zarr")):
            pack("a.zip", "a.zarr", inside, packing)
            self.check("a.zip", self.labels)
            # What the file is called does not matter.
            os.rename("a.zip", "a.whatever")
            self.check("a.whatever", self.labels)

    def test_groups_scales_and_data_sets(self):
        coarse = self.labels[::2, ::2, ::2]
        zarr.open_group("g.zarr", mode="w", zarr_version=2)
        write("g.zarr/image/.zgroup", {"zarr_format": 2})
        for name, labels in (("0", self.labels), ("1", coarse)):
            save_v2(f"g.zarr/image/{name}", labels, (4, 4, 4), dimension_separator="/")
        scale = lambda x: [{"type": "scale", "scale": [x, x, x]}]
        write("g.zarr/image/.zattrs", {"multiscales": [{
            "version": "0.4", "axes": [{"name": n, "type": "space"} for n in "zyx"],
            "datasets": [{"path": "0", "coordinateTransformations": scale(1.5)},
                         {"path": "1", "coordinateTransformations": scale(3)}]}]})
        pack("g.zip", "g.zarr")
        self.check("g.zip", self.labels, spacing=(1.5, 1.5, 1.5))
        self.check("g.zip", coarse, "--scale", "1", spacing=(3, 3, 3))
        self.check("g.zip", coarse, "--dataset", "image/1")
        self.refuse("has 2 scales", "g.zip", "--scale", "2", code=2)
        self.assertEqual(len(json.loads(run("info", "g.zip", "--json"))["scales"]), 2)
        label = int(self.labels[3, 3, 3])
        run("mesh", "g.zip", "--object", label, "-o", "o.vtu")
        save_v2("g.zarr/other", self.labels, (4, 4, 4))
        pack("g.zip", "g.zarr")
        self.refuse(["several volumes", "image, other"], "g.zip")

    def test_shards_are_read_in_parts(self):
        """One of version 3, whose chunks are not packed, in a stored and in a deflated archive."""
        shard = b"".join(self.labels[z:z + 1].astype("<u2").tobytes() for z in range(4))
        step = 2 * 7 * 9
        index = b"".join(struct.pack("<QQ", i * step, step) for i in range(4))
        none = struct.pack("<QQ", 2**64 - 1, 2**64 - 1)
        last = self.labels[4:].astype("<u2").tobytes()
        plain = {"name": "bytes", "configuration": {"endian": "little"}}
        write("s.zarr/c/0/0/0", shard + index)
        write("s.zarr/c/1/0/0", last + struct.pack("<QQ", 0, step) + none * 3)
        write("s.zarr/zarr.json", {
            "zarr_format": 3, "node_type": "array", "shape": SHAPE, "data_type": "uint16",
            "fill_value": 0, "attributes": {},
            "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": [4, 7, 9]}},
            "chunk_key_encoding": {"name": "default"},
            "codecs": [{"name": "sharding_indexed", "configuration": {
                "chunk_shape": [1, 7, 9], "codecs": [plain], "index_codecs": [plain]}}]})
        self.check("s.zarr", self.labels)
        for packing in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            pack("s.zip", "s.zarr", compression=packing)
            self.check("s.zip", self.labels)

    def test_large_archives(self):
        """Numbers of 64 bits, more than 65,535 files, a comment, and a name that is there twice."""
        with warnings.catch_warnings(), zipfile.ZipFile("l.zip", "w") as file:
            warnings.simplefilter("ignore")  # that there are two
            file.writestr("0.0.0", b"old")
            for i in range(66000):
                file.writestr(f"more/{i}", b"")
            for path in pathlib.Path("a.zarr").iterdir():
                with file.open(path.name, "w", force_zip64=True) as member:
                    member.write(path.read_bytes())
            file.comment = b"PK\5\6 " * 100
        self.check("l.zip", self.labels)

    def test_what_is_wrong_is_named(self):
        pack("a.zip", "a.zarr", compression=zipfile.ZIP_BZIP2)
        self.refuse(["a.zip/.zarray", "method 12"], "a.zip")
        pack("a.zip", "a.zarr")
        content = pathlib.Path("a.zip").read_bytes()
        for cut in (4, 100, len(content) - 40, len(content) - 1):
            write("b.zip", content[:cut])
            self.refuse(["b.zip", "ZIP directory"], "b.zip")
        at = content.index(b"0.0.0") + 5
        write("b.zip", content[:at + 8] + bytes([content[at + 8] ^ 16]) + content[at + 9:])
        self.refuse("b.zip/0.0.0", "b.zip")
        at = content.index(b"PK\1\2") + 8
        write("b.zip", content[:at] + b"\1" + content[at + 1:])
        self.refuse("is encrypted", "b.zip")
        os.makedirs("two")
        for name in "xy":
            os.system(f"cp -r a.zarr two/{name}.zarr")
        pack("two.zip", "two")
        self.refuse("several Zarr stores", "two.zip")
        numpy.savez("array.npz", labels=self.labels)
        self.refuse("holds no Zarr", "array.npz")


if __name__ == "__main__":
    unittest.main()
