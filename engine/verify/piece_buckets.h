// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The mesh's interface in small pieces, by the tile that each lies in.
#pragma once

#include "engine/verify/tile_buckets.h"
#include "engine/verify/tile_grid.h"
#include "kernels/audit/distance/mesh.h"

namespace mw::engine {

/// Triangles are added first, with dense labels of the whole volume, in voxels of the lattice; then
/// pieces are made of all of them.
class PieceBuckets {
 public:
  PieceBuckets(const std::filesystem::path& folder, const TileGrid& grid, Index3 layers,
               std::uint64_t memory_bytes)
      : grid_(grid),
        layers_(layers),
        triangles_(folder, grid.size(), memory_bytes / 2),
        pieces_(folder, grid.size(), memory_bytes / 2) {}

  void add(std::uint32_t tile, const audit::InterfaceTriangle& triangle) {
    triangles_.add(tile, triangle);
    audit::add_estimates(triangle.corners, estimates_);
  }
  /// REQUIRES: called once, after the last triangle.
  void make_pieces();

  /// Returns the radius that no piece exceeds.
  [[nodiscard]] double radius() const { return radius_; }
  /// Returns all pieces whose centroid lies in a tile that meets this box of voxels of the volume;
  /// centroids outside of the volume count for the nearest tile.  Thread-safe.
  [[nodiscard]] std::vector<audit::InterfaceTriangle> near(const Box3& voxels) const;

 private:
  const TileGrid& grid_;
  Index3 layers_;
  TileBuckets<audit::InterfaceTriangle> triangles_;
  TileBuckets<audit::InterfaceTriangle> pieces_;
  audit::PieceEstimates estimates_{};
  double radius_ = audit::kPieceRadius;
};

}  // namespace mw::engine
