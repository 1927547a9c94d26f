#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Writes HDF5 volumes by h5py in every layout, filter, type and convention, and has them read.

Usage: h5py_test.py TEST_IO, the program that has the test Hdf5FromH5py.
"""
import itertools
import json
import os
import subprocess
import sys
import tempfile

try:
    import h5py
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SHAPE = (13, 11, 17)
ONES = (1.0, 1.0, 1.0)
ZEROS = (0.0, 0.0, 0.0)


class Folder:
    """Files beside the arrays (.npy) and the places that they must be read as."""

    def __init__(self, path):
        self.path = path
        self.lines = []
        self.random = numpy.random.default_rng(5)

    def labels(self, dtype, shape=SHAPE):
        """Runs of random labels that use all bits of the type."""
        dtype = numpy.dtype(dtype)
        if dtype.kind == "b":
            return self.random.random(shape) < 0.3
        if dtype.kind == "f":
            return self.random.integers(-99, 99, shape).astype(dtype)
        limits = numpy.iinfo(dtype)
        values = self.random.integers(limits.min, limits.max, 7, dtype.newbyteorder("="), True)
        return values[self.random.integers(0, 7, shape)].astype(dtype)

    def file(self, **options):
        self.name = f"{len(self.lines):03}.h5"
        return h5py.File(os.path.join(self.path, self.name), "w", **options)

    def expect(self, array, dataset="-", spacing=ONES, origin=ZEROS, unit="-"):
        """What the file that was written last must be read as; array is [z, y, x]."""
        array = numpy.asarray(array)
        if array.dtype.kind == "b":
            array = array.astype("u1")
        if array.dtype.kind == "f":
            array = array.astype("i8")
        numpy.save(os.path.join(self.path, self.name + ".npy"), numpy.ascontiguousarray(array))
        numbers = " ".join(repr(float(x)) for x in (*spacing, *origin))
        self.lines.append(f"{self.name} {dataset} {numbers} {unit}\n")


def types(folder):
    for code, order in itertools.product(("u1", "u2", "u4", "u8", "i1", "i2", "i4", "i8", "b1",
                                          "f4", "f8"), "<>"):
        labels = folder.labels(order + code)
        for chunks in (None, (4, 5, 6)):
            with folder.file() as file:
                file.create_dataset("labels", data=labels, chunks=chunks)
            folder.expect(labels, dataset="labels")


def filters(folder):
    for shuffle, checked, libver in itertools.product((False, True), (False, True),
                                                      ("earliest", "latest")):
        for packing in (None, "lzf", "gzip", 9):
            labels = folder.labels("<u4")
            with folder.file(libver=libver) as file:
                file.create_dataset("labels", data=labels, chunks=(4, 5, 6), shuffle=shuffle,
                                    fletcher32=checked, compression=packing)
            folder.expect(labels)
    # Noise does not shrink, and LZF leaves such chunks as they are.
    noise = folder.random.integers(0, 2**63, SHAPE)
    with folder.file() as file:
        file.create_dataset("labels", data=noise, chunks=(4, 5, 6), compression="lzf")
    folder.expect(noise)


def blosc(folder):
    if not h5py.h5z.filter_avail(32001):
        print("no Blosc: its plugin is missing")
        return
    for codec, shuffle in itertools.product(range(6), range(3)):
        labels = folder.labels("<u8")
        try:
            with folder.file() as file:
                file.create_dataset("labels", data=labels, chunks=(8, 8, 8), compression=32001,
                                    compression_opts=(0, 0, 0, 0, 5, shuffle, codec))
        except (OSError, ValueError, RuntimeError):
            continue  # a codec that the plugin was built without
        folder.expect(labels)


def indices(folder):
    """The library indexes chunks by what can grow."""
    for libver in ("earliest", "latest"):
        for most in (None, (40, 40, 40), (None, 11, 17), (None, None, None)):
            for chunks in ((4, 5, 6), SHAPE):
                labels = folder.labels("<i2")
                with folder.file(libver=libver) as file:
                    file.create_dataset("labels", data=labels, chunks=chunks, maxshape=most)
                folder.expect(labels)


def sparse(folder):
    for libver in ("earliest", "latest"):
        labels = numpy.full(SHAPE, -7, "i4")
        labels[5:9, 3:7, 8:17] = 3
        with folder.file(libver=libver) as file:
            made = file.create_dataset("labels", SHAPE, "i4", chunks=(4, 5, 6), fillvalue=-7)
            made[5:9, 3:7, 8:17] = 3
        folder.expect(labels)


def resized(folder):
    """Chunks beyond an array that shrank are no longer there."""
    labels = folder.labels("<u2")
    with folder.file() as file:
        made = file.create_dataset("labels", data=labels, chunks=(4, 5, 6), maxshape=(None,) * 3,
                                   compression="gzip")
        made.resize((7, 11, 9))
    folder.expect(labels[:7, :, :9])


def compact(folder):
    labels = folder.labels("<u2", (3, 4, 5))
    with folder.file() as file:
        storage = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        storage.set_layout(h5py.h5d.COMPACT)
        made = h5py.h5d.create(file.id, b"labels", h5py.h5t.STD_U16LE,
                               h5py.h5s.create_simple(labels.shape), storage)
        made.write(h5py.h5s.ALL, h5py.h5s.ALL, labels)
    folder.expect(labels)


def conventions(folder):
    labels = folder.labels("<u8")
    image = folder.labels("u1", (5, 6, 7))
    with folder.file() as file:
        made = file.create_dataset("volumes/labels/neuron_ids", data=labels, compression="gzip")
        made.attrs["resolution"] = (40.0, 4.0, 8.0)
        made.attrs["offset"] = (1480, 3644, 36)
        file["volumes/raw"] = image
        file["volumes/labels/clefts"] = image
    folder.expect(labels, spacing=(8, 4, 40), origin=(36, 3644, 1480), unit="nm")
    with folder.file(track_order=True) as file:
        file["raw"] = image.astype("f4")
        file["label"] = labels
        file["label"].attrs["element_size_um"] = [0.25, 0.5, 0.75]
    folder.expect(labels, spacing=(0.75, 0.5, 0.25), unit="um")
    for keys, array in {"tzyxc": labels[None, ..., None], "xyzc": labels.T[..., None],
                        "zyx": labels}.items():
        with folder.file() as file:
            file["exported_data"] = array
            axes = [{"key": key, "typeFlags": 2, "resolution": 0, "description": ""}
                    for key in keys]
            file["exported_data"].attrs["axistags"] = json.dumps({"axes": axes})
        folder.expect(labels)


def dream3d(folder):
    ids = folder.labels("<i4")
    place = {"spacing": (0.25, 0.5, 0.75), "origin": (-29.0, 0.0, -47.0)}
    with folder.file() as file:
        file.attrs["FileVersion"] = numpy.bytes_("7.0")
        image = file.create_group("DataContainers/SyntheticVolume")
        made = image.create_dataset("CellData/FeatureIds", data=ids[..., None])
        made.attrs["TupleDimensions"] = numpy.array(SHAPE[::-1], "u8")
        image["CellData/Phases"] = ids[..., None]
        image["_SIMPL_GEOMETRY/DIMENSIONS"] = numpy.array(SHAPE[::-1], "i8")
        image["_SIMPL_GEOMETRY/SPACING"] = numpy.array(place["spacing"], "f4")
        image["_SIMPL_GEOMETRY/ORIGIN"] = numpy.array(place["origin"], "f4")
    folder.expect(ids, **place)
    with folder.file() as file:
        file.attrs["FileVersion"] = "8.0"
        image = file.create_group("DataStructure/Image Geometry")
        image.attrs["_DIMENSIONS"] = numpy.array(SHAPE[::-1], "u8")
        image.attrs["_SPACING"] = numpy.array(place["spacing"], "f4")
        image.attrs["_ORIGIN"] = numpy.array(place["origin"], "f4")
        image["Cell Data/FeatureIds"] = ids[..., None]
        image["Cell Data/Phases"] = ids[..., None]
    folder.expect(ids, **place)


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        for write in (types, filters, blosc, indices, sparse, resized, compact, conventions,
                      dream3d):
            write(folder)
        with open(os.path.join(path, "expected.txt"), "w", encoding="ascii") as file:
            file.writelines(folder.lines)
        print(len(folder.lines), "files")
        test = [sys.argv[1], "--gtest_filter=Hdf5FromH5py.*"]
        return subprocess.run(test, env={**os.environ, "MW_H5PY_FILES": path}).returncode


if __name__ == "__main__":
    sys.exit(main())
