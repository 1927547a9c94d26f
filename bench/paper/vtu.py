# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""A .vtu file as mwmesh and cgal_mesh write it (io/mesh/vtu/vtu.h), as numpy arrays."""

import dataclasses
import xml.etree.ElementTree

import numpy

TYPES = {"Float64": "<f8", "Int64": "<i8", "UInt64": "<u8", "UInt8": "<u1"}
START = b'<AppendedData encoding="raw">'


@dataclasses.dataclass
class Mesh:
    points: numpy.ndarray  # (vertices, 3) float, physical units
    tets: numpy.ndarray  # (tets, 4) rows of points
    labels: numpy.ndarray  # (tets,) 64 bits, as the volume has them


def read(path):
    """ValueError when the file is not laid out as ours are."""
    data = numpy.memmap(path, dtype=numpy.uint8, mode="r")
    head, start = _head(data, path)
    arrays = {}
    for node in head.iter("DataArray"):
        if node.get("format") != "appended":
            continue  # field data
        arrays[node.get("Name")] = _array(data, start + int(node.get("offset")), node.get("type"))
    return Mesh(
        points=arrays["Points"].reshape(-1, 3),
        tets=arrays["connectivity"].reshape(-1, 4),
        labels=arrays["label"],
    )


def _head(data, path):
    """The XML before the appended data, and where that begins."""
    text = bytes(data[: 1 << 16])
    tag = text.find(START)
    mark = text.find(b"_", tag + len(START))
    if tag < 0 or mark < 0:
        raise ValueError(f"{path}: no raw appended data")
    return xml.etree.ElementTree.fromstring(text[:tag] + b"</VTKFile>"), mark + 1


def _array(data, start, kind):
    """A byte count of 64 bits, then the numbers."""
    length = int(data[start : start + 8].view("<u8")[0])
    return numpy.array(data[start + 8 : start + 8 + length]).view(TYPES[kind])
