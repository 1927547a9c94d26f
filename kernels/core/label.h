// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels (the paper's materials), as files hold them and as the kernels use them, one or a box.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/core/assert.h"
#include "kernels/core/index.h"

namespace mw {

/// A label as the input has it, 64 bits; signed types are sign-extended (two's complement).
using RawLabel = std::uint64_t;

/// Dense label: rank of a raw label among the labels of the volume.
using Label = std::uint32_t;

/// Everything outside the volume's box counts as one more label.
inline constexpr Label kExterior = 0xffffffffU;

/// Within a window, tets beyond a plane that its mesh goes through (TetMesh) bear their
/// label and a bit for each such plane, so that whatever keeps two labels apart keeps the plane.
/// Labels of volumes are below kFirstSide.
inline constexpr Label kFirstSide = Label{1} << 29U;

/// Returns the bit of tets beyond the plane across an axis: 0 for x, 1 for y, 2 for z.
[[nodiscard]] constexpr Label side_beyond(unsigned axis) {
  return kFirstSide << axis;
}

/// Returns the label that a tet's voxels have; kExterior becomes a label that no voxel has.
[[nodiscard]] constexpr Label without_side(Label label) {
  return label & (kFirstSide - 1);
}

/// Returns the side that a label is on: the bits of planes that it is beyond.
[[nodiscard]] constexpr Label side_of(Label sided) {
  return sided & ~(kFirstSide - 1);
}

/// Returns another label on the side that a label is on.
[[nodiscard]] constexpr Label on_side_of(Label sided, Label label) {
  return side_of(sided) | without_side(label);
}

/// Two labels that meet, low < high.
struct LabelPair {
  Label low = 0;
  Label high = 0;

  friend bool operator==(const LabelPair&, const LabelPair&) = default;
};

[[nodiscard]] constexpr LabelPair label_pair(Label a, Label b) {
  return a < b ? LabelPair{a, b} : LabelPair{b, a};
}

/// Labels of the voxels of `box`, x fastest.  The box may reach outside the volume; voxels there
/// are kExterior.
struct LabelBox {
  Box3 box;
  std::vector<Label> labels;

  /// REQUIRES: box.contains(voxel).
  [[nodiscard]] Label at(Index3 voxel) const {
    MW_ASSERT(box.contains(voxel));
    return labels[static_cast<std::size_t>(box.offset(voxel))];
  }
};

}  // namespace mw
