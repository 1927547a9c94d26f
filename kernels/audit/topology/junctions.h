// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Junctions where labels meet, of a volume and of a mesh (P1 with interfaces), tile by tile.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/audit/mesh_stars.h"
#include "kernels/audit/subject.h"
#include "kernels/audit/topology/betti.h"

namespace mw::audit {

/// The most labels whose meeting is looked at.
inline constexpr std::size_t kMaxLabelsOfJunction = 4;

/// Labels of a junction, ascending; unused entries are kNoLabel.  Label label_count is the
/// exterior, which is one more label as in mesh_betti, and label_count + 1 stands for all labels
/// that are not the volume's.
using JunctionLabels = std::array<Label, kMaxLabelsOfJunction>;
inline constexpr Label kNoLabel = 0xffffffffU;

enum class JunctionKind : std::uint8_t {
  /// For two labels it is the closure of the faces between them.
  kInterface,
  /// For two to kMaxLabelsOfJunction labels, the points that all their closed regions share; for
  /// two that is the interface and whatever edges and vertices they touch in besides.
  kMeeting,
};

/// Cells and connected sets of a junction in one tile.
struct JunctionTally {
  JunctionLabels labels{};
  JunctionKind kind = JunctionKind::kInterface;
  std::int64_t components = 0;
  std::int64_t euler = 0;  ///< Euler number of the cells that the tile owns
};

/// What one tile tells, its open sets (those that go on in other tiles) numbered from 0.
struct JunctionsPiece {
  /// Sets with the same vertex in the same junction are one.
  struct Node {
    std::uint32_t tally = 0;
    std::uint64_t vertex = 0;  ///< id in the whole mesh, or in the volume's lattice
    std::uint32_t set = 0;
  };
  std::vector<JunctionTally> tallies;  ///< open sets are counted too
  std::uint32_t open_sets = 0;
  std::vector<Node> shared;
};

/// REQUIRES and errors: as voxel_parts; kResource also from 2^32 - 1 pairs of a junction
/// and a vertex on.
/// Cost: one pass over the voxels, then sorts of the vertices and edges on interfaces, 8 and 16
/// bytes each and junction.  Deterministic.
[[nodiscard]] JunctionsPiece voxel_junctions(const VoxelTile& tile, std::size_t label_count);

/// Counts the junctions of a mesh; see mesh_betti.
[[nodiscard]] JunctionsPiece mesh_junctions(const MeshStars& stars, std::size_t label_count);

/// A junction that differs; all zeros where it is absent.
struct JunctionChange {
  JunctionLabels labels{};
  Betti before;
  Betti after;

  friend bool operator==(const JunctionChange&, const JunctionChange&) = default;
};

/// A mesh's junctions held against its volume's.
struct JunctionReport {
  std::size_t interfaces = 0;  ///< how many the volume has
  std::size_t meetings = 0;
  std::vector<JunctionChange> interfaces_changed;  ///< ascending
  std::vector<JunctionChange> meetings_changed;
};

}  // namespace mw::audit
