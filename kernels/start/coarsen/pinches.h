// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where the boundary of a label of voxels is no surface, and whether a cube that changes adds to
// it.
#pragma once

#include <array>
#include <cstdint>

#include "kernels/core/label.h"

namespace mw {

/// Cells at a corner of voxels where a label is pinched: bit 0 is the corner, bit 1 + 2 a + s the
/// edge from there along axis a, towards lower (s = 0) or higher (s = 1) coordinates.
using Pinches = std::uint8_t;

/// The cells at a corner where the label of some of its eight voxels (bit dx + 2 dy + 4 dz) is
/// pinched: the corner, where these voxels or the others do not hang together by faces, and each
/// edge with two of them across from each other and the others between.
[[nodiscard]] Pinches pinches_at_corner(std::uint8_t voxels);

/// Labels of a cube of 2^3 voxels, and of the 4^3 voxels around it; x fastest.
using CubeLabels = std::array<Label, 8>;
using LabelsAroundCube = std::array<Label, 64>;

/// True if some label is pinched at a corner or edge of the cube where it was not `before`, when
/// the cube had those labels and all around it was the same.
/// REQUIRES: the cube has one label now.  Cost: some 50 look-ups for each label that it had.
[[nodiscard]] bool adds_pinch(const LabelsAroundCube& now, const CubeLabels& before);

}  // namespace mw
