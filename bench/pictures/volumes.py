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


def shell(radius, thickness):
    """Label 1: a ball's shell of `thickness` voxels inside of `radius`; label 2: what is in it."""
    half = int(radius) + MARGIN
    distance = numpy.sqrt(((numpy.indices((2 * half,) * 3) + 0.5 - half) ** 2).sum(axis=0))
    return (numpy.select([distance < radius - thickness, distance < radius], [2, 1])).astype(
        numpy.uint8
    )


def kidney():
    """Label 1: an ellipsoid with a hollow at one side and bumps of a few voxels."""
    z, y, x = (numpy.indices((88, 60, 56)) + 0.5).astype(float)
    x, y, z = x - 28, y - 30, z - 44
    bumps = 0.04 * numpy.sin(x / 4.7 + 1) * numpy.sin(y / 5.3) * numpy.sin(z / 6.1 + 2)
    body = numpy.sqrt((x / 19) ** 2 + ((y + 0.006 * z**2 - 4) / 19) ** 2 + (z / 37) ** 2) + bumps
    hollow = numpy.sqrt((x / 9) ** 2 + ((y - 24) / 13) ** 2 + (z / 12) ** 2)
    # The exponentials round the rim of the hollow.
    return (numpy.exp(12 * (body - 1)) + numpy.exp(6 * (1 - hollow)) < 1).astype(numpy.uint8)


def teeth():
    """Labels 2, 3 and 4: teeth a voxel or two apart; label 1: the bone around their roots."""
    z, y, x = (numpy.indices((52, 32, 60)) + 0.5).astype(float)
    out = (z < 21 + 2 * numpy.sin(x / 5.3)).astype(numpy.uint8)
    for label, (middle, tilt) in enumerate(((12.5, 0.04), (29.8, -0.03), (47.1, 0.06)), start=2):
        along, across = x - middle - tilt * (z - 26), y - 16 + 0.05 * (z - 26)
        wide = numpy.where(z < 24, 3.2 + 0.16 * z, 7.9 - 0.012 * (z - 32) ** 2)
        cusps = 44.5 + 1.4 * numpy.cos(along / 1.9) * numpy.cos(across / 1.9)
        out[((along**4 + across**4) ** 0.25 < wide) & (z > 5) & (z < cusps)] = label
    return out


def spine():
    """Labels 1 to 3: bodies of vertebrae; labels 4 and 5: the discs between them; tilted, in slices
    along z that are six times as thick as voxels are wide."""
    z, y, x = (numpy.indices((14, 112, 56)) + 0.5).astype(float)
    z, y, x = 6 * (z - 7), y - 56, x - 28
    up, side = 0.96 * y + 0.28 * z, 0.96 * z - 0.28 * y
    x = x - 0.004 * up**2 + 3
    out = numpy.zeros(z.shape, numpy.uint8)
    for label, height in enumerate((-34, 0, 34), start=1):
        waist = 17 + 0.011 * (up - height) ** 2
        out[(x**2 + side**2 < waist**2) & (abs(up - height) < 14)] = label
    for label, height in enumerate((-17, 17), start=4):
        out[(x**2 + side**2 < 19**2) & (abs(up - height) < 2.5)] = label
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
