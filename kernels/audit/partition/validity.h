// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Is a mesh a conforming partition of the box into labelled tets (promise P2)?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/audit/check.h"
#include "kernels/audit/compensated_sum.h"
#include "kernels/audit/mesh_stars.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// What judge_validity() found.
struct ValidityReport {
  std::vector<Check> checks;
  double volume = 0;  ///< sum over all tets, cubic physical units
  double box_volume = 0;

  [[nodiscard]] bool passed() const;
};

/// What one tile finds, or all tiles together.  Labels are those of the tile.
struct ValidityTally {
  Offenders turned{"tets that are flat or turned over"};
  Offenders unused{"vertices in no tet"};
  Offenders same{"vertices where another one is"};
  Offenders twice{"tets that are there twice"};
  Offenders open{"triangles of one tet that are not on the box"};
  Offenders crowded{"triangles of three or more tets"};
  Offenders folded{"triangles with both tets on one side"};
  Offenders outside{"vertices outside the box"};
  std::array<bool, 8> corners{};  ///< whether a vertex is at each corner of the box
  std::uint64_t positive_tets = 0;
  std::uint64_t negative_tets = 0;
  std::uint64_t flat_tets = 0;
  std::uint64_t faces = 0;
  std::uint64_t box_faces = 0;
  CompensatedSum volume;
  Offenders strange{"tets whose label is not wanted"};
  /// By label, then for all unknown ones: whether some tet has it.
  std::vector<bool> in_mesh;

  /// Adds another tally, whose label l is labels[l] here; unknown ones are the last of both.
  void add(const ValidityTally& other, std::span<const Label> labels);
};

/// What is asked of a mesh.
struct ValidityTask {
  Frame frame;
  Index3 shape;
  /// By label: whether tets may have the label and some must.
  std::vector<bool> wanted;
  bool has_gaps = false;  ///< labels were left out
  LabelText label_text = {};
};

/// Checks the vertices, triangles and tets that a tile owns.  REQUIRES: finite vertices; `wanted`
/// is by the tile's labels.  Memory: 17 bytes a tet, 50 a vertex.  Deterministic.
[[nodiscard]] ValidityTally tally_validity(const MeshStars& stars, const ValidityTask& task);

/// Returns the check "P2 input".
[[nodiscard]] Check input_check(std::uint64_t vertices, std::uint64_t tets,
                                const Offenders& endless);

/// Judges all tiles.  The checks, in order: "P2 orientation" (all strictly positive, exactly), "P2
/// vertices" (no two at one position, each in a tet), "P2 tets" (none twice), "P2 faces" (two tets
/// on opposite sides, or one and on a plane of the box), "P2 box" (all vertices inside, all corners
/// there), "P2 volume" (sum equals the box's to 1e-9, and the rounding of coordinates), "P2 labels"
/// (the mesh's are the volume's).  Together they prove a partition: faces that pair up on opposite
/// sides cover the inside of the box equally often everywhere, and the volume says once.
/// In a mesh from which labels were left out, triangles of one tet may be anywhere, corners may be
/// missing, the volume is at most the box's, and the labels are those that are kept.  What the
/// volume proves is then sampled: "P2 overlap" (OverlapCheck).
/// Planes and corners are those of the frame in double, to 1e-9 of the box's extent, since other
/// tools round (box_planes.h).
/// The caller puts "P2 input" before these checks and "P2 overlap" after them.
[[nodiscard]] ValidityReport judge_validity(const ValidityTally& tally, const ValidityTask& task);

}  // namespace mw::audit
