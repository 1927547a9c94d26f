#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Zarr 2 as zarr writes it and Zarr 3 by the letter of its specification: arrays give back their
labels; what is damaged or unsupported is named."""
import copy
import gzip
import json
import os
import pathlib
import shutil
import struct
import sys
import unittest

from stores import (TYPES, Stores, cells, crc32c, distinct, name_of, numpy, padded, pick_shape,
                    save_v2, voxels, write)

try:
    import numcodecs
    import zarr  # which save_v2() writes with
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

PACKERS = {"gzip": gzip.compress, "zstd": numcodecs.Zstd().encode,
           "blosc": numcodecs.Blosc("lz4").encode, "crc32c": lambda data: data + crc32c(data)}


class Array:
    """An array of version 3; names are those of the specification or speak for themselves."""

    def __init__(self, labels, chunk, **others):
        self.labels, self.chunk = labels, chunk
        self.fill, self.big, self.transposes, self.packing = 0, False, (), ()
        self.inner, self.shard_transpose = None, None
        self.index_at_end, self.index_checksum, self.leave_out_fill = True, True, True
        self.v2_keys, self.separator = False, "/"
        self.__dict__.update(others)

    def codecs(self):
        out = [{"name": "transpose", "configuration": {"order": list(order)}}
               for order in self.transposes]
        out.append({"name": "bytes", "configuration": {"endian": "big" if self.big else "little"}})
        level = {"configuration": {"level": 5}}
        out += [{"name": name, **(level if name != "crc32c" else {})} for name in self.packing]
        return out

    def metadata(self):
        codecs = self.codecs()
        if self.inner:
            order = self.shard_transpose or range(len(self.inner))
            inner = [self.inner[axis] for axis in order]
            index = [{"name": "bytes", "configuration": {"endian": "little"}}]
            index += [{"name": "crc32c"}] if self.index_checksum else []
            sharding = {"chunk_shape": inner, "codecs": codecs, "index_codecs": index}
            if not self.index_at_end:
                sharding["index_location"] = "start"
            codecs = [{"name": "sharding_indexed", "configuration": sharding}]
            if self.shard_transpose:
                codecs.insert(0, {"name": "transpose", "configuration": {"order": order}})
        return {"zarr_format": 3, "node_type": "array", "shape": list(self.labels.shape),
                "data_type": self.labels.dtype.newbyteorder("=").name, "fill_value": self.fill,
                "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": self.chunk}},
                "chunk_key_encoding": {"name": "v2" if self.v2_keys else "default",
                                       "configuration": {"separator": self.separator}},
                "codecs": codecs, "attributes": {}}

    def packed(self, part):
        for order in self.transposes:
            part = part.transpose(order)
        data = part.astype(part.dtype.newbyteorder(">" if self.big else "<")).tobytes()
        for name in self.packing:
            data = bytes(PACKERS[name](data))
        return data

    def shard(self, part, is_fill):
        order = self.shard_transpose or range(part.ndim)
        part, is_fill = part.transpose(order), is_fill.transpose(order)
        places = list(cells(part.shape, [self.inner[axis] for axis in order]))
        index, body = b"", b""
        size = 16 * len(places) + 4 * self.index_checksum
        for _, where in places:
            if self.leave_out_fill and is_fill[where].all():
                index += b"\xff" * 16
                continue
            data = self.packed(part[where])
            index += struct.pack("<QQ", len(body) + (0 if self.index_at_end else size), len(data))
            body += data
        index += crc32c(index) if self.index_checksum else b""
        return body + index if self.index_at_end else index + body

    def save(self, folder):
        """What is behind the end of the volume in a chunk is anything but the fill value."""
        write(f"{folder}/zarr.json", self.metadata())
        kind = self.labels.dtype.type
        other = kind(self.fill) ^ kind(1)
        whole = padded(self.labels, self.chunk, other)
        is_fill = padded(self.labels == self.fill, self.chunk, True)
        for number, where in cells(self.labels.shape, self.chunk):
            if self.leave_out_fill and is_fill[where].all():
                continue
            key = self.separator.join(map(str, number))
            key = key if self.v2_keys else f"c{self.separator}{key}"
            write(f"{folder}/{key}", self.shard(whole[where], is_fill[where]) if self.inner
                  else self.packed(whole[where]))


def set_at(place, value):
    """A change: the value at the place, as codecs/0/name; `...` takes away what is there."""
    def change(data):
        *parents, last = (int(k) if k.isdigit() else k for k in place.split("/"))
        for key in parents:
            data = data[key]
        if value is ...:
            del data[last]
        else:
            data[last] = value
    return change


class Arrays(Stores):
    def sample(self):
        """Labels with a corner of the fill value, further axes of one entry, and chunks."""
        labels = distinct(self.random, pick_shape(self.random, 6), self.random.choice(TYPES))
        fill = self.random.choice(labels.ravel())
        labels[tuple(map(slice, pick_shape(self.random, 6)))] = fill
        leading = int(self.random.integers(3))
        chunk = [*map(int, self.random.integers(1, 3, leading)), *pick_shape(self.random, 5)]
        return labels, labels.reshape(*[1] * leading, *labels.shape), chunk, int(fill)

    def test_version_2(self):
        packers = (None, numcodecs.Zlib(), numcodecs.GZip(), numcodecs.Zstd(), numcodecs.LZ4(),
                   numcodecs.Blosc("lz4"), numcodecs.BZ2(), numcodecs.LZMA())
        for i in range(16):
            labels, array, chunk, fill = self.sample()
            name, order = next(self.names), self.random.choice(["<", ">"])
            save_v2(name, array.astype(array.dtype.newbyteorder(order)), chunk, fill_value=fill,
                    compressor=packers[i % len(packers)], order="CF"[self.random.integers(2)],
                    write_empty_chunks=i % 5 == 0, dimension_separator="./"[i // 4 % 2])
            self.check(name, labels, format="zarr", type=name_of(labels.dtype))

    def test_version_3(self):
        chains = ((), ("gzip",), ("zstd",), ("zstd", "crc32c"), ("blosc",), ("crc32c",),
                  ("crc32c", "gzip"), ("blosc", "gzip", "crc32c"))
        draw = self.random.integers
        for i in range(24):
            labels, array, chunk, fill = self.sample()
            orders = [self.random.permutation(array.ndim).tolist() for _ in range(4)]
            sample = Array(array, chunk, fill=fill, big=bool(draw(2)), v2_keys=draw(4) == 0,
                           packing=chains[i % len(chains)], transposes=orders[:draw(3)],
                           separator="./"[draw(2)], leave_out_fill=draw(4) != 0)
            if i % 3 > 0:
                sample.inner = chunk
                sample.chunk = [int(n * draw(1, 4)) for n in chunk]
                sample.index_at_end, sample.index_checksum = draw(2) == 0, bool(draw(4))
                sample.shard_transpose = orders[3] if draw(3) == 0 else None
            name = next(self.names)
            sample.save(name)
            self.check(name, labels, format="zarr", type=name_of(labels.dtype))

    def test_slices_and_further_axes(self):
        straight, crossed = [1, 2, 3, 4, 5, 6], [1, 4, 2, 5, 3, 6]
        for shape, names, told, labels in (
                ((2, 3), None, [3, 2, 1], straight), ((2, 3), ["x", "y"], [2, 3, 1], crossed),
                ((1, 2, 3), None, [3, 2, 1], straight), ((1, 1, 2, 3), None, [3, 2, 1], straight),
                ((1, 1, 1, 2, 3), None, [3, 2, 1], straight),
                ((2, 1, 3, 1), None, [1, 3, 2], straight),
                ((1, 1, 1, 6), None, [6, 1, 1], straight),
                ((2, 1, 3, 1), ["x", "y", "z", None], [2, 1, 3], crossed),
                ((2, 1, 3, 1), ["rows", "t", "cols", "c"], [1, 3, 2], straight),
                ((2, 3), ["z", "x"], [3, 2, 1], straight)):
            array = Array(numpy.arange(1, 7, dtype="u1").reshape(shape), list(shape))
            array.save("a")
            if names:
                write("a/zarr.json", {**array.metadata(), "dimension_names": names})
            facts = self.facts("a")
            self.expect(facts, shape=told)
            self.assertEqual(numpy.ravel(voxels(facts)).tolist(), labels, (shape, names))
            shutil.rmtree("a")

    def test_fill_values_are_exact(self):
        one = Array(numpy.zeros((1, 1, 1), "u1"), [1, 1, 1])
        for kind, fill, label in (
                ("uint64", 2**64 - 1, 2**64 - 1), ("uint64", 2**53 + 1, 2**53 + 1),
                ("int64", -2**63, -2**63), ("int64", 2**53 + 1, 2**53 + 1), ("int8", -128, -128),
                ("uint8", 255, 255), ("uint32", 7.0, 7), ("int16", -7.0, -7), ("bool", True, 1),
                ("bool", False, 0), ("float32", 3.0, 3), ("float32", 0, 0), ("float64", -2, -2),
                ("float32", "0x40a00000", 5), ("float64", "0x4014000000000000", 5)):
            write("a/zarr.json", {**one.metadata(), "data_type": kind, "fill_value": fill})
            self.assertEqual(voxels(self.facts("a")), [[[label]]], (kind, fill))
        os.remove("a/zarr.json")
        save_v2("b", numpy.zeros((1, 1, 1), "u8"), (1, 1, 1))
        for fill, label in ((None, 0), (2**64 - 2, 2**64 - 2)):
            metadata = json.loads(pathlib.Path("b/.zarray").read_text(encoding="utf-8"))
            write("a/.zarray", {**metadata, "fill_value": fill})
            self.assertEqual(voxels(self.facts("a")), [[[label]]], fill)

    def test_fill_values_that_are_no_labels_matter_only_where_they_are_read(self):
        array = Array(numpy.zeros((1, 1, 2), "f4"), [1, 1, 1], separator=".")
        write("a/c.0.0.0", struct.pack("<f", 3))
        for fill in ("NaN", "-Infinity", 0.5, 1e300, "0x7fc00000"):
            write("a/zarr.json", {**array.metadata(), "fill_value": fill})
            self.assertEqual(voxels(self.facts("a", "--crop", "0,0,0,1,1,1")), [[[3]]])
            self.refuse(["fill value", "no label"], "a", "--crop", "1,0,0,2,1,1")
            self.refuse(["c.0.0.1"], "a")

    def test_separator_that_is_not_said(self):
        for separator in "./":
            labels, name = distinct(self.random, (5, 6, 7), "u2"), next(self.names)
            save_v2(name, labels, (4, 3, 2), dimension_separator=separator)
            metadata = json.loads(pathlib.Path(name, ".zarray").read_text(encoding="utf-8"))
            metadata.pop("dimension_separator", None)
            write(f"{name}/.zarray", metadata)
            self.check(name, labels)

    def test_other_types_and_files_beside(self):
        for array, labels in ((numpy.array([[[True, False]]]), [1, 0]),
                              (numpy.array([[[3, -2]]], ">f4"), [3, -2])):
            save_v2("a", array, (1, 1, 2), overwrite=True)
            write("a/.zmetadata", "{ not read")
            write("a/.zattrs", '{"_FillValue": NaN}')
            self.assertEqual(voxels(self.facts("a")), [[labels]])
        save_v2("a", numpy.array([[[3, 0.5]]], "f4"), (1, 1, 2), overwrite=True)
        self.refuse(["voxel (1, 0, 0)", "0.5"], "a")


class Damage(Stores):
    """Changes of a good array and the words that name them."""

    def setUp(self):
        super().setUp()
        self.labels = distinct(self.random, (4, 5, 6), "u2")
        save_v2("v2", self.labels, (2, 3, 4))
        self.v2 = json.loads(pathlib.Path("v2/.zarray").read_text(encoding="utf-8"))
        self.array = Array(self.labels, [2, 3, 4], inner=[1, 3, 2], separator=".")
        self.array.save("v3")

    def refuse_v2(self, place, value, *words):
        data = copy.deepcopy(self.v2)
        set_at(place, value)(data)
        write("v2/.zarray", data)
        self.refuse([*words, "v2/.zarray"], "v2")

    def refuse_v3(self, place, value, *words):
        data = self.array.metadata()
        set_at(place, value)(data)
        write("v3/zarr.json", data)
        self.refuse([*words, "v3/zarr.json"], "v3")

    def test_metadata_of_version_2(self):
        refuse = self.refuse_v2
        refuse("zarr_format", 1, "zarr_format")
        refuse("shape", ..., "shape", "missing")
        refuse("shape", [4, 5, 0], "shape (x)", "not positive")
        refuse("shape", [-4, 5, 6], "shape (z)", "not positive")
        refuse("shape", [4, 5, 1 << 21], "shape (x)", "1048576")
        refuse("shape", [4, 5], "chunks", "3 extents", "2 axes")
        refuse("shape", [1] * 40, "shape", "40 axes")
        refuse("chunks", [2, 0, 4], "chunks", "not positive")
        refuse("chunks", [2048, 1024, 1024], "chunks", "2 GiB")
        refuse("chunks", [2**63 - 1] * 3, "chunks", "2 GiB")
        refuse("chunks", "4", "chunks", "array")
        for kind in ("<f2", "<c8", "|V4", "<U2", "|O", "<u3", "|u2", "u2", "", "<M8[ns]"):
            refuse("dtype", kind, "dtype", kind)
        refuse("dtype", [["a", "<u2"]], "dtype")
        refuse("order", "A", "order", "'A'")
        refuse("dimension_separator", "-", "dimension_separator")
        refuse("filters", [{"id": "delta"}], "filters[0].id", "delta")
        refuse("compressor", {"id": "zfpy"}, "compressor.id", "zfpy")
        refuse("compressor", {"id": "lzma", "format": 3}, "compressor.format", "lzma")
        refuse("compressor", "zlib", "compressor")
        for fill in (-1, 65536, 0.5, "x", 1e300, [], -2**63):
            refuse("fill_value", fill, "fill_value", "u16")
        self.v2["chunks"] = [4]
        refuse("shape", [4], "shape", "1 axes")
        self.v2["chunks"] = [2, 3, 4, 5]
        refuse("shape", [2, 3, 4, 5], "2 x 3 x 4 x 5", "4 axes")

    def test_metadata_of_version_3(self):
        refuse = self.refuse_v3
        for key in ("data_type", "chunk_grid", "chunk_key_encoding", "codecs", "fill_value",
                    "shape", "node_type", "zarr_format"):
            refuse(key, ..., key, "missing")
        refuse("node_type", "heap", "node_type", "heap")
        refuse("zarr_format", 4, "zarr_format")
        for kind in ("float16", "complex64", "string", "r16"):
            refuse("data_type", kind, "data_type", kind)
        refuse("data_type", {"name": "numpy.datetime64"}, "numpy.datetime64")
        refuse("chunk_grid/name", "rectilinear", "rectilinear")
        grid = "chunk_grid/configuration/chunk_shape"
        refuse(grid, [2, 3], "chunk_shape", "2 extents", "3 axes")
        refuse(grid, [2, 3, -4], "chunk_shape", "not positive")
        self.array.inner = [1, 1, 1]
        refuse(grid, [1 << 20] * 3, "chunk_shape", "4194304")
        refuse("chunk_key_encoding/name", "x", "chunk_key_encoding", "'x'")
        refuse("chunk_key_encoding/configuration/separator", "..", "separator", "'..'")
        refuse("storage_transformers", [{"name": "x"}], "storage_transformers")
        refuse("crystal", {"name": "x"}, "crystal", "extension")
        refuse("dimension_names", ["x"], "dimension_names")
        refuse("fill_value", 70000, "fill_value", "u16")

    def test_codecs(self):
        big = {"name": "bytes", "configuration": {"endian": "big"}}
        transpose = {"name": "transpose", "configuration": {"order": [3, 2, 1, 0]}}
        for codecs, *words in (
                ([], "codecs", "no codec makes bytes"), ({}, "codecs", "array"), ([7], "codecs[0]"),
                (["bytes"], "codecs[0].configuration.endian", "missing"),
                ([{"name": "bytes", "configuration": {"endian": "middle"}}], "endian", "middle"),
                ([{"name": "packbits"}], "codec packbits", "not known"),
                ([big, {"name": "numcodecs.zlib"}], "codec numcodecs.zlib"),
                ([big, big], "codec bytes", "behind"), (["gzip", big], "codec gzip", "before"),
                *(([{"name": "transpose", "configuration": {"order": order}}, big],
                   "codec transpose", "permutation")
                  for order in ([0, 1], [0, 1, 1], [0, 1, 3], [0, 1, -1], [0, 1, 2, 2]))):
            self.refuse_v3("codecs", codecs, *words)
        sharding, *_ = self.array.metadata()["codecs"]
        index = sharding["configuration"]["index_codecs"]
        within = "codecs/0/configuration/"
        for place, value, *words in (
                ("codecs", [sharding, "gzip"], "codec gzip", "whole shards"),
                (within + "chunk_shape", [1, 2, 2], "chunk_shape", "divide"),
                (within + "chunk_shape", [1, 3], "chunk_shape"),
                (within + "index_location", "middle", "index_location"),
                (within + "index_codecs", [*index, "gzip"], "index_codecs"),
                (within + "index_codecs", [transpose, index[0]], "index_codecs",
                 "other codecs than bytes and crc32c"),
                (within + "index_codecs", ..., "index_codecs", "missing"),
                (within + "codecs", ..., "codecs", "missing"),
                (within + "codecs", [sharding], "codec sharding_indexed", "within shards")):
            self.refuse_v3(place, value, *words)
        self.array.inner = None  # chunks must fit into memory then
        grid = "chunk_grid/configuration/chunk_shape"
        self.refuse_v3(grid, [1 << 20] * 3, "chunk_shape", "2 GiB")

    def test_extensions_that_may_be_passed_over(self):
        write("v3/zarr.json", {
            **self.array.metadata(), "storage_transformers": [], "dimension_names": [None] * 3,
            "consolidated_metadata": {"must_understand": False, "kind": "inline"}})
        self.check("v3", self.labels)

    def test_damaged_chunks_are_named(self):
        sound = ["--crop", "0,0,0,1,1,1"]
        for packer in (None, numcodecs.Zlib(), numcodecs.Blosc()):
            save_v2("v2", self.labels, (2, 3, 4), compressor=packer, overwrite=True)
            chunk = pathlib.Path("v2/1.0.1")
            whole = chunk.read_bytes()
            for data in (b"", whole[1:], whole[:10]):
                write(chunk, data)
                self.assertEqual(voxels(self.facts("v2", *sound)), [[[self.labels[0, 0, 0]]]])
                self.refuse([str(chunk), "whole copy"], "v2")
            write(chunk, bytes(1 << 20))
            self.refuse([str(chunk), "1048576 bytes"], "v2")
            chunk.unlink()
            chunk.mkdir()
            self.refuse(str(chunk), "v2")
            chunk.rmdir()

    def test_shard_indices_are_checked(self):
        self.array.index_checksum = self.array.leave_out_fill = False
        shard = pathlib.Path("v3/c.1.0.0")
        for at_end in (True, False):
            self.array.index_at_end = at_end
            self.array.save("v3")
            whole = shard.read_bytes()
            index = len(whole) - 64 if at_end else 0
            for offset, count, word in (
                    (len(whole), 12, "places it at"), (0, len(whole) + 1, "places it at"),
                    (2**64 - 1, 12, "places it at"), (2**64 - 4, 12, "places it at"),
                    (12, 2**64 - 1, "places it at"), (0, 11, "needs 12")):
                entry = struct.pack("<QQ", offset, count)
                write(shard, whole[:index + 16] + entry + whole[index + 32:])
                self.refuse([str(shard), "chunk (1, 0, 0) of the shard", word], "v3")
            write(shard, whole[:63])
            self.refuse([str(shard), "shard index", "truncated"], "v3")
            write(shard, whole)

    def test_all_bytes_of_shards_are_under_a_checksum(self):
        self.array.packing = ("zstd", "crc32c")
        self.array.save("v3")
        shard = pathlib.Path("v3/c.0.0.0")
        whole = shard.read_bytes()
        for at in range(0, len(whole), 7):
            write(shard, whole[:at] + bytes([whole[at] ^ 1 << at % 8]) + whole[at + 1:])
            self.refuse(str(shard), "v3")


if __name__ == "__main__":
    unittest.main()
