// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Betti numbers from the parts that tiles see, each for itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/audit/mesh_stars.h"
#include "kernels/audit/topology/betti.h"
#include "kernels/audit/topology/part_graph.h"
#include "kernels/audit/topology/pinches.h"
#include "kernels/core/disjoint_sets.h"

namespace mw::audit {

/// The parts of a tile of a mesh.
struct MeshParts {
  PartsPiece piece;
  std::vector<std::uint32_t> part_of_tet;  ///< by row, and one more for the exterior
};

/// Finds the parts of a tile, their pairs, and its cells.  If two tiles have a tet, its part in
/// one tile and its part in the other are one.
/// REQUIRES, errors and cost: as mesh_betti.
[[nodiscard]] MeshParts mesh_parts(const MeshStars& stars, std::size_t label_count);

/// Voxels along x that several tiles have loaded, in one part.
struct SharedRun {
  std::uint64_t first = 0;  ///< its first voxel, x fastest in the whole volume
  std::uint32_t count = 0;
  std::uint32_t part = 0;
};

/// The parts of a tile of a volume.  shared has all voxels that another tile loads, at least.
struct VoxelParts {
  PartsPiece piece;
  std::vector<SharedRun> shared;
  std::vector<VoxelPinches> pinches;  ///< by label, of corners and edges that the tile owns
};

/// Finds the parts of a tile, their pairs, its cells, and where labels are pinched.
/// REQUIRES: a shape of at least 1 x 1 x 1, as many labels as voxels, labels < label_count.
/// Errors: kInput when these fail, kResource from 2^32 - 1 runs of equal labels on.
/// Cost: one pass over the voxels; 8 bytes a run along x, and some 16 a pair.  Deterministic.
[[nodiscard]] VoxelParts voxel_parts(const VoxelTile& tile, std::size_t label_count);

/// Joins the pieces of all tiles of a volume, or of a mesh.
class PartsUnion {
 public:
  explicit PartsUnion(std::size_t label_count) : label_count_(label_count) {}

  /// Returns the number of its part 0; the others follow.  Labels are those of the whole.
  std::uint32_t add(PartsPiece piece);
  /// Makes two parts, numbered through all pieces, one.  REQUIRES: all pieces were added.
  void unite(std::uint32_t a, std::uint32_t b);

  /// Returns label_count + 1 rows; the last is the exterior.  Nothing may be united afterwards.
  [[nodiscard]] std::vector<RegionBetti> betti_of_volume();
  [[nodiscard]] std::vector<RegionBetti> betti_of_mesh();
  /// Returns the cavities of all interfaces.  Nothing may be united afterwards.
  [[nodiscard]] Cavities cavities();

 private:
  /// Gives parts that were united one number.
  void join();
  /// The exterior is one cell that no tile has counted.
  [[nodiscard]] std::vector<RegionBetti> betti(const EulerSums& euler);
  [[nodiscard]] EulerSums sums() const;
  DisjointSets& sets();

  std::size_t label_count_;
  std::vector<Label> part_class_;
  std::vector<PartPair> face_pairs_;
  std::vector<PartPair> vertex_pairs_;
  std::vector<ClassCells> cells_;
  std::int64_t total_ = 0;
  std::optional<DisjointSets> sets_;
  bool is_joined_ = false;
};

}  // namespace mw::audit
