// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Planes of the interface voxel faces at a corner, and its point term.
#include "kernels/lattice/corner_quadric.h"

namespace mw {
namespace {

/// The eight voxels around a corner, x fastest, from the lower to the higher side of each axis.
using Octant = std::array<Label, 8>;

Octant voxels_around(const LabelBox& labels, Index3 corner) {
  Octant out;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto bit = [i](unsigned axis) { return static_cast<std::int64_t>(i >> axis & 1U); };
    out[i] = labels.at(corner + Index3{bit(0) - 1, bit(1) - 1, bit(2) - 1});
  }
  return out;
}

}  // namespace

Quadric corner_quadric(const LabelBox& labels, Index3 corner, const QuadricWeights& weights) {
  const Octant around = voxels_around(labels, corner);
  Quadric q;
  bool inner = true;
  for (std::size_t i = 0; i < 8; ++i) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const std::size_t j = i | std::size_t{1} << axis;
      if (i == j || around[i] == around[j]) continue;
      inner = false;
      if (around[i] != kExterior && around[j] != kExterior) {
        q.add_axis_plane(static_cast<int>(axis), weights.plane);
      }
    }
  }
  q.add_point(inner ? weights.inner_point : weights.boundary_point);
  return q;
}

}  // namespace mw
