// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The tiles in which a mesh and a volume are looked at, and pieces of interfaces in them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/verify/tile_buckets.h"
#include "kernels/audit/distance/mesh.h"
#include "kernels/audit/partition/centres.h"
#include "kernels/core/index.h"

namespace mw::engine {

/// Boxes of voxels that cover a volume, numbered x fastest.
class TileGrid {
 public:
  static constexpr std::int64_t kEdge = 64;
  static constexpr std::int64_t kMaxTiles = 1 << 14;

  /// Makes tiles of `edge` voxels of the lattice, and doubles the edge until they are few enough.
  TileGrid(Index3 shape, Index3 layers, std::int64_t edge = kEdge);

  [[nodiscard]] Index3 shape() const { return shape_; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(count_.product()); }
  [[nodiscard]] Box3 box(std::uint32_t tile) const;
  /// Returns the tile of the voxel at a point, in voxels from the first corner; points outside of
  /// the volume are taken to its nearest voxel.  REQUIRES: the point is finite.
  [[nodiscard]] std::uint32_t at(const std::array<double, 3>& point) const;
  /// Returns the positions in the grid of the tiles that meet a box of voxels.
  [[nodiscard]] Box3 meeting(const Box3& voxels) const;
  [[nodiscard]] std::uint32_t number(Index3 position) const {
    return static_cast<std::uint32_t>(Box3{{0, 0, 0}, count_}.offset(position));
  }

 private:
  Index3 shape_;
  Index3 edges_;
  Index3 count_;
};

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

  /// Adds triangles, with the sum of their estimates.
  void add(const TileShares<audit::InterfaceTriangle>& triangles,
           const audit::PieceEstimates& estimates) {
    triangles_.add(triangles);
    for (std::size_t i = 0; i < estimates.size(); ++i) estimates_[i] += estimates[i];
  }
  /// REQUIRES: called once, after the last triangle, which lets go of them.  Memory: a tile's
  /// triangles twice, and 6 MiB, for each thread.
  void make_pieces(int threads);

  /// Returns the radius that no piece exceeds.
  [[nodiscard]] double radius() const { return radius_; }
  /// Returns all pieces whose centroid lies in a tile that meets this box of voxels of the volume;
  /// centroids outside of the volume count for the nearest tile.  Thread-safe.
  [[nodiscard]] std::vector<audit::InterfaceTriangle> near(const Box3& voxels) const;

 private:
  struct TilePieces {
    TileShares<audit::InterfaceTriangle> pieces;
    std::vector<audit::InterfaceTriangle> whole;  ///< triangles that are still to be cut
  };

  template <class Visit>
  void cut(const audit::InterfaceTriangle& triangle, Visit visit) const;
  [[nodiscard]] TilePieces pieces_of(std::uint32_t tile);

  const TileGrid& grid_;
  Index3 layers_;
  TileBuckets<audit::InterfaceTriangle> triangles_;
  TileBuckets<audit::InterfaceTriangle> pieces_;
  audit::PieceEstimates estimates_{};
  double radius_ = audit::kPieceRadius;
};

/// Runs of centres with dense labels of the whole volume, by the tiles of their voxels.
using CentreBuckets = TileBuckets<audit::CentreRun>;

}  // namespace mw::engine
