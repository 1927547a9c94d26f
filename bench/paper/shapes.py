#!/usr/bin/python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Angles and components of a mesh, for Figs 11 and 12 and Table 6.

Usage: shapes.py MESH.vtu OUT.json.  A program of its own: Linux counts the memory of the process
that starts another into the peak of the one started, so tables.py must stay small.
"""

import json
import sys

import numpy

import vtu

DIHEDRAL_BINS = numpy.linspace(0, 180, 37)  # degrees
MIN_ANGLE_BINS = numpy.linspace(0, 60, 31)  # degrees; no triangle's least angle is above 60
OPPOSITE_FACES = ((1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2))
CHUNK = 1 << 18  # tets or triangles at a time


def dihedral_angles(points, tets):
    """(tets, 6) degrees: between the planes of any two faces of each tet."""
    corners = points[tets]
    normals = []
    for i, (a, b, c) in enumerate(OPPOSITE_FACES):
        normal = numpy.cross(corners[:, b] - corners[:, a], corners[:, c] - corners[:, a])
        away = numpy.einsum("ij,ij->i", normal, corners[:, i] - corners[:, a]) < 0
        normals.append(numpy.where(away[:, None], normal, -normal))
    pairs = [(i, j) for i in range(4) for j in range(i)]
    # The normals point outwards; between them are 180 degrees less the dihedral angle.
    return numpy.stack([180 - _angle(normals[i], normals[j]) for i, j in pairs], axis=1)


def min_angles(points, triangles):
    """(triangles,) degrees: the least of the three angles."""
    corners = points[triangles]
    angles = []
    for i in range(3):
        here = corners[:, i]
        angles.append(_angle(corners[:, (i + 1) % 3] - here, corners[:, (i + 2) % 3] - here))
    return numpy.min(angles, axis=0)


def _angle(a, b):
    """Degrees between rows; by atan2, which is accurate near 0 and 180."""
    across = numpy.linalg.norm(numpy.cross(a, b), axis=1)
    return numpy.degrees(numpy.arctan2(across, numpy.einsum("ij,ij->i", a, b)))


def faces(tets, labels):
    """Triangles where labels meet or the mesh ends, and pairs of tets of one label with a common
    triangle: (n, 3) rows of points, (m, 2) rows of tets."""
    triangles = numpy.sort(numpy.concatenate([tets[:, f] for f in OPPOSITE_FACES]), axis=1)
    owner = numpy.tile(numpy.arange(len(tets)), 4)
    order = numpy.lexsort(triangles.T)
    triangles, owner = triangles[order], owner[order]
    first = numpy.flatnonzero((triangles[1:] == triangles[:-1]).all(axis=1))
    same = labels[owner[first]] == labels[owner[first + 1]]
    inside = first[same]
    boundary = numpy.ones(len(triangles), dtype=bool)
    boundary[first + 1] = False  # the second of two
    boundary[inside] = False
    return triangles[boundary], numpy.stack([owner[inside], owner[inside + 1]], axis=1)


def component_count(count, pairs):
    """Of a graph with nodes 0..count-1."""
    root = numpy.arange(count)
    while True:
        a, b = root[pairs[:, 0]], root[pairs[:, 1]]
        differ = a != b
        if not differ.any():
            return len(numpy.unique(root))
        # A root gets one smaller root, so there is no circle; then all go up to their roots.
        root[numpy.maximum(a, b)[differ]] = numpy.minimum(a, b)[differ]
        while (root != root[root]).any():
            root = root[root]


def histogram(angles_of, rows, bins):
    """Counts of angles_of(rows), a chunk at a time."""
    counts = numpy.zeros(len(bins) - 1, dtype=int)
    for start in range(0, len(rows), CHUNK):
        angles = numpy.clip(angles_of(rows[start : start + CHUNK]), bins[0], bins[-1])
        counts += numpy.histogram(angles, bins)[0]
    return counts.tolist()


def facts(mesh):
    triangles, pairs = faces(mesh.tets, mesh.labels)
    return {
        "labels": len(numpy.unique(mesh.labels)),
        "components": component_count(len(mesh.tets), pairs),
        "dihedral_histogram": histogram(
            lambda rows: dihedral_angles(mesh.points, rows), mesh.tets, DIHEDRAL_BINS
        ),
        "min_angle_histogram": histogram(
            lambda rows: min_angles(mesh.points, rows), triangles, MIN_ANGLE_BINS
        ),
    }


if __name__ == "__main__":
    with open(sys.argv[2], "w", encoding="utf-8") as out:
        json.dump(facts(vtu.read(sys.argv[1])), out)
