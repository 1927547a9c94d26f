# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The volumes that are drawn: (z, y, x) arrays of labels, voxels of 1 x 1 x 1."""

import gzip
import pathlib
import subprocess

import numpy

MARGIN = 4  # voxels of background around what is drawn


def ball(radius):
    """Label 1: voxels whose centre is nearer than `radius` to the middle."""
    half = radius + MARGIN
    offsets = numpy.indices((2 * half,) * 3) + 0.5 - half
    return ((offsets**2).sum(axis=0) < radius**2).astype(numpy.uint8)


def plate(edge):
    """Label 1: a square of one voxel's thickness."""
    out = numpy.zeros((2 * MARGIN + 1, edge + 2 * MARGIN, edge + 2 * MARGIN), numpy.uint8)
    out[MARGIN, MARGIN:-MARGIN, MARGIN:-MARGIN] = 1
    return out


def grains(edge, count):
    """Labels from 1 on: which of some random points is nearest; the first one is in the middle."""
    points = numpy.random.default_rng(3).uniform(0, edge, (count, 3))
    points[0] = edge / 2
    centres = numpy.moveaxis(numpy.indices((edge,) * 3) + 0.5, 0, -1)
    distances = [((centres - point) ** 2).sum(axis=-1) for point in points]
    return (numpy.argmin(distances, axis=0) + 1).astype(numpy.uint8)


def cell(edge, count):
    """Labels from 1 on: which of some random points, or of their copies, is nearest on a torus."""
    points = numpy.random.default_rng(5).uniform(0, edge, (count, 3))
    centres = numpy.moveaxis(numpy.indices((edge,) * 3) + 0.5, 0, -1)
    distances = []
    for point in points:
        apart = abs(centres - point)
        distances.append((numpy.minimum(apart, edge - apart) ** 2).sum(axis=-1))
    return (numpy.argmin(distances, axis=0) + 1).astype(numpy.uint8)


def atlas():
    """The AAL brain atlas of Debian's mricron-data: 8 bits and voxels of 1 mm."""
    listed = subprocess.run(["dpkg", "-L", "mricron-data"], capture_output=True, text=True)
    files = [line for line in listed.stdout.split() if line.endswith("/aal.nii.gz")]
    if not files:
        raise SystemExit("pictures: apt-get install mricron-data (the AAL atlas)")
    data = gzip.decompress(pathlib.Path(files[0]).read_bytes())
    x, y, z = numpy.frombuffer(data, "<i2", 3, 42)
    first = int(numpy.frombuffer(data, "<f4", 1, 108)[0])
    return numpy.frombuffer(data, numpy.uint8, offset=first).reshape(z, y, x)


def only(volume, labels):
    """`labels` with a margin; all others are background."""
    kept = numpy.where(numpy.isin(volume, labels), volume, 0)
    box = []
    for axis in range(3):
        used = numpy.flatnonzero(kept.any(axis=tuple({0, 1, 2} - {axis})))
        box.append(slice(used[0], used[-1] + 1))
    return numpy.pad(kept[tuple(box)], MARGIN)


def crop(volume, corner, shape):
    """Corner and shape in x, y, z."""
    return volume[tuple(slice(a, a + n) for a, n in zip(corner[::-1], shape[::-1]))]
