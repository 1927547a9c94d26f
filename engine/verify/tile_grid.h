// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The tiles in which a mesh and a volume are looked at, and what belongs to each of them, in
// temporary files.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "io/file/scratch/packed_scratch.h"
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

/// Holds a list of records for each tile, in the order in which they were added.
/// Memory: `memory_bytes` or 32 records a tile, and 24 bytes each time that a tile's share fills
/// up.  Disk: a third of what the records take in memory, or half.
/// Thread safety: one thread adds, or several load and take.  ERRORS: see io::ScratchFile.
template <typename Record>
class TileBuckets {
 public:
  TileBuckets(const std::filesystem::path& folder, std::uint32_t tiles, std::uint64_t memory_bytes)
      : file_(folder),
        tiles_(tiles),
        max_(std::clamp<std::size_t>(memory_bytes / (sizeof(Record) * std::max(tiles, 1U)), kFewest,
                                     kMax)) {}

  void add(std::uint32_t tile, const Record& record) {
    Tile& t = tiles_[tile];
    t.waiting.push_back(record);
    if (t.waiting.size() < max_) return;
    t.chunks.push_back(file_.append(t.waiting));
    t.waiting.clear();
  }

  [[nodiscard]] std::uint64_t count(std::uint32_t tile) const {
    std::uint64_t sum = tiles_[tile].waiting.size();
    for (const io::PackedChunk& chunk : tiles_[tile].chunks) sum += chunk.records;
    return sum;
  }

  /// Adds the tile's records to a list.
  void load(std::uint32_t tile, std::vector<Record>& out) const {
    const Tile& t = tiles_[tile];
    out.reserve(out.size() + count(tile));
    for (const io::PackedChunk& chunk : t.chunks) file_.read(chunk, out);
    out.insert(out.end(), t.waiting.begin(), t.waiting.end());
  }

  /// Adds the tile's records to a list and lets go of them, on disk, too.
  void take(std::uint32_t tile, std::vector<Record>& out) {
    load(tile, out);
    for (const io::PackedChunk& chunk : tiles_[tile].chunks) file_.give_up(chunk);
    tiles_[tile] = {};
  }

 private:
  static constexpr std::size_t kFewest = 32;
  static constexpr std::size_t kMax = 4096;

  struct Tile {
    std::vector<Record> waiting;
    std::vector<io::PackedChunk> chunks;
  };

  io::PackedScratch<Record> file_;
  std::vector<Tile> tiles_;
  std::size_t max_;
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

  void add(std::uint32_t tile, const audit::InterfaceTriangle& triangle) {
    triangles_.add(tile, triangle);
    audit::add_estimates(triangle.corners, estimates_);
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
  struct PieceOfTile {
    std::uint32_t tile = 0;
    audit::InterfaceTriangle piece;
  };
  struct TilePieces {
    std::vector<PieceOfTile> pieces;
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
