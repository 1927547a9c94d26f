#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Writes stores by zarr-python, each with its labels as N.npy (z, y, x).  Usage: SCRIPT FOLDER.

Exits with 77 when the modules are missing."""
import itertools
import sys

try:
    import numcodecs
    import numpy as np
    import zarr
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

CODECS = [
    None,
    numcodecs.Zlib(level=3),
    numcodecs.GZip(level=3),
    numcodecs.Zstd(level=3),
    numcodecs.LZ4(),
    numcodecs.BZ2(),
    numcodecs.LZMA(),
    numcodecs.Blosc(cname="lz4", shuffle=numcodecs.Blosc.SHUFFLE),
    numcodecs.Blosc(cname="zstd", shuffle=numcodecs.Blosc.BITSHUFFLE),
    numcodecs.Blosc(cname="zlib", shuffle=numcodecs.Blosc.NOSHUFFLE),
    numcodecs.Blosc(cname="blosclz", shuffle=numcodecs.Blosc.AUTOSHUFFLE),
    numcodecs.Blosc(cname="lz4hc", shuffle=numcodecs.Blosc.SHUFFLE),
    numcodecs.Blosc(cname="snappy", shuffle=numcodecs.Blosc.SHUFFLE),
]
TYPES = "|u1 <u2 >u2 <u4 >u4 <u8 >u8 |i1 <i2 >i2 <i4 >i4 <i8 >i8 <f4 >f8 |b1".split()


def labels(rng, shape, dtype):
    """Blocks of few labels, with a corner of nothing but zeros; in numpy's own type."""
    kind = np.dtype(dtype)
    if kind.kind == "f":
        colours = rng.integers(-(2**20), 2**20, 9).astype(kind)
    elif kind.kind == "b":
        colours = rng.integers(0, 2, 9).astype(kind)
    else:
        bounds = np.iinfo(kind)
        native = kind.newbyteorder("=")
        colours = rng.integers(bounds.min, bounds.max, 9, dtype=native, endpoint=True).astype(kind)
    cells = rng.integers(0, 9, [1 + n // 4 for n in shape])
    out = colours[np.kron(cells, np.ones((4, 4, 4), int))][tuple(slice(0, n) for n in shape)]
    out[: shape[0] // 2, : shape[1] // 2] = 0
    return out


def main(folder):
    rng = np.random.default_rng(1)
    for number, (codec, dtype) in enumerate(itertools.product(CODECS, TYPES)):
        shape = tuple(int(n) for n in rng.integers(1, 20, 3))
        chunks = tuple(int(n) for n in rng.integers(1, 12, 3))
        data = labels(rng, shape, dtype)
        path = f"{folder}/{number}.zarr"
        array = zarr.open_array(
            zarr.NestedDirectoryStore(path) if number % 2 else path,
            mode="w",
            shape=shape,
            chunks=chunks,
            dtype=dtype,
            order="CF"[number // 2 % 2],
            compressor=codec,
            fill_value=0 if number % 3 else None,
            write_empty_chunks=number % 5 == 0,
            dimension_separator="/" if number % 2 else ".",
        )
        array[...] = data
        kind = data.dtype.kind
        wide = data.astype("<u8" if kind in "ub" else "<i8")
        np.save(f"{folder}/{number}.npy", np.ascontiguousarray(wide))
    print(len(CODECS) * len(TYPES))


main(sys.argv[1])
