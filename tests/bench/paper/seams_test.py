# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Density at block planes of clouds whose density is known."""

import unittest

import numpy

import seams

SIZE, PERIOD = 80, 16
GRID = numpy.stack(numpy.meshgrid(*[numpy.arange(SIZE + 1.0)] * 3), axis=-1).reshape(-1, 3)


class Density(unittest.TestCase):
    def test_is_one_everywhere_for_a_lattice_and_for_its_even_points(self):
        even = GRID[numpy.all(GRID % 2 == 0, axis=1)]
        for corners in (GRID, even):
            numpy.testing.assert_allclose(seams.by_position(corners, PERIOD), 1, rtol=1e-12)

    def test_rises_within_two_voxels_of_planes_that_hold_twice_as_many(self):
        on_planes = GRID[numpy.any(GRID % PERIOD == 0, axis=1)]
        density = seams.by_position(numpy.concatenate([GRID, on_planes]), PERIOD)
        numpy.testing.assert_allclose(density[3:-2], density[PERIOD // 2], rtol=1e-12)
        for near in (0, 1, 2, PERIOD - 2, PERIOD - 1):
            self.assertGreater(density[near], 1.05 * density[PERIOD // 2])


if __name__ == "__main__":
    unittest.main()
