# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Angles, boundaries and components of small meshes that are known by hand."""

import unittest

import numpy

import shapes

REGULAR = numpy.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
CORNER = numpy.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
ORDERS = [[0, 1, 2, 3], [1, 0, 2, 3], [3, 1, 0, 2]]  # both orientations


class Angles(unittest.TestCase):
    def test_dihedral_angles_of_the_regular_tet_are_all_acos_of_a_third(self):
        angles = shapes.dihedral_angles(REGULAR, numpy.array(ORDERS))
        numpy.testing.assert_allclose(angles, numpy.degrees(numpy.arccos(1 / 3)), rtol=1e-12)

    def test_dihedral_angles_of_a_cube_corner(self):
        known = [numpy.degrees(numpy.arccos(3**-0.5))] * 3 + [90] * 3
        for angles in shapes.dihedral_angles(CORNER, numpy.array(ORDERS)):
            numpy.testing.assert_allclose(sorted(angles), known, rtol=1e-12)

    def test_a_nearly_flat_tet_has_two_angles_near_180_and_four_near_0(self):
        points = numpy.array([[0.0, 0, 0], [1, 1, 0], [1, 0, 1e-6], [0, 1, 1e-6]])
        angles = sorted(shapes.dihedral_angles(points, numpy.array([[0, 1, 2, 3]]))[0])
        numpy.testing.assert_allclose(angles[:4], 0, atol=1e-3)
        numpy.testing.assert_allclose(angles[4:], 180, atol=1e-3)

    def test_least_angles_of_triangles(self):
        points = numpy.array([[0.0, 0, 0], [4, 0, 0], [0, 3, 0], [2, 12**0.5, 0], [0, 4, 0]])
        angles = shapes.min_angles(points, numpy.array([[0, 1, 2], [0, 1, 3], [4, 1, 0]]))
        numpy.testing.assert_allclose(
            angles, [numpy.degrees(numpy.arctan2(3, 4)), 60, 45], rtol=1e-12
        )

    def test_a_histogram_counts_every_angle_once_over_all_chunks(self):
        rows = numpy.arange(2 * shapes.CHUNK + 5)
        counts = shapes.histogram(lambda part: (part % 3) * 10.0, rows, numpy.array([0, 5, 15, 20]))
        self.assertEqual(counts, [(rows % 3 == i).sum() for i in range(3)])


class Faces(unittest.TestCase):
    # Two tets with the common triangle 0 1 2.
    TETS = numpy.array([[0, 1, 2, 3], [1, 0, 2, 4]])

    def test_between_tets_of_one_label_is_no_boundary(self):
        boundary, pairs = shapes.faces(self.TETS, numpy.array([7, 7]))
        self.assertEqual(len(boundary), 6)
        self.assertNotIn([0, 1, 2], boundary.tolist())
        self.assertEqual([sorted(pair) for pair in pairs.tolist()], [[0, 1]])

    def test_where_labels_meet_is_one_triangle(self):
        boundary, pairs = shapes.faces(self.TETS, numpy.array([7, 8]))
        self.assertEqual(len(boundary), 7)
        self.assertIn([0, 1, 2], boundary.tolist())
        self.assertEqual(len(pairs), 0)


class Components(unittest.TestCase):
    def test_of_random_graphs(self):
        random = numpy.random.default_rng(1)
        for edges in (0, 5, 20, 60):
            pairs = random.integers(0, 40, (edges, 2))
            self.assertEqual(shapes.component_count(40, pairs), self.by_flooding(40, pairs))

    def test_of_a_long_path_in_random_order(self):
        nodes = numpy.random.default_rng(2).permutation(5000)
        pairs = numpy.stack([nodes[1:], nodes[:-1]], axis=1)
        self.assertEqual(shapes.component_count(5001, pairs), 2)

    @staticmethod
    def by_flooding(count, pairs):
        left, found = set(range(count)), 0
        while left:
            found += 1
            todo = [left.pop()]
            while todo:
                node = todo.pop()
                near = {b for a, b in pairs if a == node} | {a for a, b in pairs if b == node}
                todo += near & left
                left -= near
        return found


if __name__ == "__main__":
    unittest.main()
