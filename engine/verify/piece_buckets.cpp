// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Makes pieces of triangles, tile by tile.
#include "engine/verify/piece_buckets.h"

#include "kernels/core/index.h"

namespace mw::engine {

void PieceBuckets::make_pieces() {
  radius_ = audit::piece_radius(estimates_);
  const std::array<double, 3> layers{static_cast<double>(layers_.x), static_cast<double>(layers_.y),
                                     static_cast<double>(layers_.z)};
  std::vector<audit::InterfaceTriangle> triangles;
  for (std::uint32_t tile = 0; tile < grid_.size(); ++tile) {
    triangles.clear();
    triangles_.load(tile, triangles);
    for (const audit::InterfaceTriangle& t : triangles) {
      audit::for_each_piece(t.corners, radius_, [&](const audit::VoxelTriangle& piece) {
        audit::VoxelPoint middle = audit::centroid(piece);
        for (std::size_t k = 0; k < 3; ++k) middle[k] /= layers[k];
        pieces_.add(grid_.at(middle), {piece, t.labels});
      });
    }
  }
}

std::vector<audit::InterfaceTriangle> PieceBuckets::near(const Box3& voxels) const {
  std::vector<audit::InterfaceTriangle> out;
  for_each_index(grid_.meeting(voxels), [&](Index3 at) { pieces_.load(grid_.number(at), out); });
  return out;
}

}  // namespace mw::engine
