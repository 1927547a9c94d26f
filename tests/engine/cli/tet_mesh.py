# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The mesh in a file, as meshio reads it, and what scripts of this folder measure of it."""
from reading_meshio import meshio
import numpy as np

PAIRS = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]


class Mesh:
    def __init__(self, path):
        mesh = meshio.read(path)
        self.points = np.asarray(mesh.points, dtype=float)
        self.tets = mesh.cells_dict["tetra"].astype(np.int64)
        self.labels = np.asarray(mesh.cell_data["label"][0]).astype(np.int64).ravel()

    def longest(self, label):
        tets = self.tets[self.labels == label]
        edges = [self.points[tets[:, a]] - self.points[tets[:, b]] for a, b in PAIRS]
        return max(np.linalg.norm(e, axis=1).max() for e in edges)

    def volume(self, label):
        a, b, c, d = (self.points[self.tets[self.labels == label][:, i]] for i in range(4))
        return np.abs(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)).sum() / 6

    def on_interface(self):
        """Which points two labels meet at."""
        low = np.full(len(self.points), np.iinfo(np.int64).max)
        high = np.full(len(self.points), -1)
        for corner in self.tets.T:
            np.minimum.at(low, corner, self.labels)
            np.maximum.at(high, corner, self.labels)
        return low != high

    def interface(self):
        """Points at which two labels meet."""
        return self.points[self.on_interface()]

    def surface(self, label):
        """The triangles around a label that does not touch the box, all seen from its side."""
        tets = self.tets[self.labels == label]
        corners = self.points[tets]
        edges = corners[:, 1:] - corners[:, :1]
        inverted = np.linalg.det(edges) < 0
        tets[inverted] = tets[inverted][:, [0, 1, 3, 2]]
        faces = np.concatenate([tets[:, f] for f in ([1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1])])
        _, first, count = np.unique(np.sort(faces), axis=0, return_index=True, return_counts=True)
        return faces[first[count == 1]]

    def mean_bend(self, label):
        """The angle between triangles around a label, in degrees, by the length of their edges."""
        faces = self.surface(label)
        a, b, c = (self.points[faces[:, i]] for i in range(3))
        normals = np.cross(b - a, c - a)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        edges = np.sort(np.concatenate([faces[:, [i, (i + 1) % 3]] for i in range(3)]))
        order = np.lexsort(edges.T)
        pairs, sides = edges[order].reshape(-1, 2, 2), order.reshape(-1, 2) % len(faces)
        assert (pairs[:, 0] == pairs[:, 1]).all(), "an edge has not two triangles"
        cosines = np.einsum("ij,ij->i", normals[sides[:, 0]], normals[sides[:, 1]])
        ends = self.points[pairs[:, 0]]
        return np.average(np.degrees(np.arccos(np.clip(cosines, -1, 1))),
                          weights=np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))

    def lacking(self):
        """Which tets have all corners on interfaces or the box."""
        box = (self.points == self.points.min(0)) | (self.points == self.points.max(0))
        return (self.on_interface() | box.any(1))[self.tets].all(1)
