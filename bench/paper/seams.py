#!/usr/bin/python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Do block planes show?  Vertices per voxel near them, relative to the mean of the mesh.

The density is that of the four voxels around a plane, half of the outer ones' weight each: the start
mesh has its vertices at even positions, and any four voxels in a row hold as many even as odd ones.
"""

import argparse
import pathlib

import numpy
import vtu

# Vertices are free in fewer windows at the faces of the volume, too: those are left out.
MARGIN = 8


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("meshes", nargs="+", metavar="MESH.vtu", type=pathlib.Path)
    parser.add_argument("--spacing", type=float, nargs=3, default=[1, 1, 1], metavar=("X", "Y", "Z"))
    parser.add_argument("--window", type=int, default=32, help="of the first march")
    options = parser.parse_args()
    print("| mesh | planes of both marches | of the first only | between: least to most |")
    print("|---|---|---|---|")
    for path in options.meshes:
        corners = vtu.read(path).points / options.spacing
        density = by_position(corners - corners.min(axis=0), options.window)
        half = options.window // 2
        between = numpy.delete(density, [0, half])
        print(f"| {path.name} | {density[0]:.2f} | {density[half]:.2f} "
              f"| {between.min():.2f} to {between.max():.2f} |")


def by_position(corners, period):
    """Density around each position modulo `period`, over the three axes; mean 1."""
    size = corners.max(axis=0)
    inside = numpy.all((corners > MARGIN) & (corners < size - MARGIN), axis=1)
    found = numpy.zeros(period)
    positions = numpy.zeros(period)
    for axis in range(3):
        here = numpy.rint(corners[inside, axis]).astype(int)
        found += numpy.bincount(here % period, minlength=period)
        all_here = numpy.arange(MARGIN + 1, int(size[axis]) - MARGIN)
        positions += numpy.bincount(all_here % period, minlength=period)
    density = found / positions
    around = sum(numpy.roll(density, s) * (0.5 if abs(s) == 2 else 1) for s in range(-2, 3))
    return around / around.mean()


if __name__ == "__main__":
    main()
