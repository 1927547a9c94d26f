# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Writes labels as stores of chunks, by the specifications of their formats.

Arrays are [z, y, x], of 64 unsigned bits.  Chunks that are 0 throughout are left out.
"""
import gzip
import itertools
import json
import os
import struct
import zlib

import numpy as np

CHUNK = 16


def _write(path, content):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(content if isinstance(content, bytes) else json.dumps(content).encode())


def _chunks(labels):
    """(z, y, x) of each chunk, and its voxels."""
    counts = [-(-extent // CHUNK) for extent in labels.shape]
    for index in itertools.product(*map(range, counts)):
        part = labels[tuple(slice(i * CHUNK, (i + 1) * CHUNK) for i in index)]
        if part.any():
            yield index, part


def _whole(part):
    """Chunks of Zarr are whole at the end of an array, too."""
    return np.pad(part, [(0, CHUNK - extent) for extent in part.shape])


def _info(labels, **more):
    scale = {"key": "4_4_4", "size": labels.shape[::-1], "resolution": [4, 4, 4],
             "chunk_sizes": [[CHUNK] * 3], "encoding": "raw", "voxel_offset": [0, 0, 0], **more}
    coarse = {**scale, "key": "8_8_8", "size": [(n + 1) // 2 for n in labels.shape[::-1]],
              "resolution": [8, 8, 8]}
    return {"@type": "neuroglancer_multiscale_volume", "type": "segmentation", "num_channels": 1,
            "data_type": "uint64", "scales": [scale, coarse]}


def precomputed(folder, labels, ending=""):
    _write(f"{folder}/info", _info(labels))
    os.makedirs(f"{folder}/8_8_8")
    for index, part in _chunks(labels):
        spans = [f"{i * CHUNK}-{i * CHUNK + n}" for i, n in zip(index[::-1], part.shape[::-1])]
        content = part.tobytes()
        _write(f"{folder}/4_4_4/" + "_".join(spans) + ending,
               gzip.compress(content) if ending else content)


def _morton(index, counts):
    code = place = 0
    for bit in range(8):
        for i, count in zip(index[::-1], counts[::-1]):
            if bit < (count - 1).bit_length():
                code |= (i >> bit & 1) << place
                place += 1
    return code


def sharded(folder, labels):
    """Two bits of preshift, one of minishards, one of shards; all packed by gzip."""
    _write(f"{folder}/info", _info(labels, sharding={
        "@type": "neuroglancer_uint64_sharded_v1", "preshift_bits": 2, "hash": "identity",
        "minishard_bits": 1, "shard_bits": 1, "minishard_index_encoding": "gzip",
        "data_encoding": "gzip"}))
    counts = [-(-extent // CHUNK) for extent in labels.shape]
    shards = {}
    for index, part in _chunks(labels):
        number = _morton(index, counts)
        minishards = shards.setdefault(number >> 3 & 1, ({}, {}))
        minishards[number >> 2 & 1][number] = gzip.compress(part.tobytes())
    for shard, minishards in shards.items():
        data, places = b"", []
        for chunks in minishards:
            rows, last_number, end = [[], [], []], 0, 0
            for number, content in sorted(chunks.items()):
                rows[0].append(number - last_number)
                rows[1].append(len(data) - end)
                rows[2].append(len(content))
                last_number, data = number, data + content
                end = len(data)
            index = gzip.compress(np.array(rows, "<u8").tobytes())
            places += [len(data), len(data) + len(index)]
            data += index
        _write(f"{folder}/4_4_4/{shard}.shard", struct.pack("<4Q", *places) + data)


def zarr2(folder, labels):
    _write(f"{folder}/.zarray", {
        "zarr_format": 2, "shape": labels.shape, "chunks": [CHUNK] * 3, "dtype": "<u8",
        "compressor": {"id": "zlib", "level": 1}, "fill_value": 0, "order": "C", "filters": None,
        "dimension_separator": "/"})
    for index, part in _chunks(labels):
        _write(f"{folder}/" + "/".join(map(str, index)), zlib.compress(_whole(part).tobytes()))


def zarr3(folder, labels):
    """Shards of 2 x 2 x 2 chunks, their index at the end."""
    little = {"name": "bytes", "configuration": {"endian": "little"}}
    _write(f"{folder}/zarr.json", {
        "zarr_format": 3, "node_type": "array", "shape": labels.shape, "data_type": "uint64",
        "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": [2 * CHUNK] * 3}},
        "chunk_key_encoding": {"name": "default", "configuration": {"separator": "/"}},
        "fill_value": 0, "codecs": [{"name": "sharding_indexed", "configuration": {
            "chunk_shape": [CHUNK] * 3, "index_location": "end", "index_codecs": [little],
            "codecs": [little, {"name": "gzip", "configuration": {"level": 1}}]}}]})
    shards = {}
    for index, part in _chunks(labels):
        chunks = shards.setdefault(tuple(i // 2 for i in index), {})
        chunks[tuple(i % 2 for i in index)] = gzip.compress(_whole(part).tobytes())
    for shard, chunks in shards.items():
        data, index = b"", np.full((2, 2, 2, 2), 2**64 - 1, "<u8")
        for place, content in chunks.items():
            index[place] = len(data), len(content)
            data += content
        _write(f"{folder}/c/" + "/".join(map(str, shard)), data + index.tobytes())


def n5(folder, labels):
    _write(f"{folder}/attributes.json", {
        "dimensions": labels.shape[::-1], "blockSize": [CHUNK] * 3, "dataType": "uint64",
        "compression": {"type": "gzip"}})
    for index, part in _chunks(labels):
        header = struct.pack(">HHIII", 0, 3, *part.shape[::-1])
        _write(f"{folder}/" + "/".join(map(str, index[::-1])),
               header + gzip.compress(part.astype(">u8").tobytes()))


#: By name, how each kind of store is written.
KINDS = {"precomputed": precomputed, "sharded": sharded, "zarr2": zarr2, "zarr3": zarr3, "n5": n5}
