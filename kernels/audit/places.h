// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Betti numbers of the places where labels meet, of a volume and of a mesh (P1 with interfaces).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kernels/audit/betti.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// Largest set of labels whose meeting is looked at.
inline constexpr std::size_t kMostLabelsOfPlace = 4;

/// Labels of a place, ascending; unused entries are kNoLabel.
using PlaceLabels = std::array<Label, kMostLabelsOfPlace>;
inline constexpr Label kNoLabel = 0xffffffffU;

/// One place; b0 is never 0.
struct PlaceBetti {
  PlaceLabels labels{};
  Betti betti;

  friend bool operator==(const PlaceBetti&, const PlaceBetti&) = default;
};

/// All places, ascending by labels.  Label label_count is the exterior, which is one more label as
/// in voxel_betti, and label_count + 1 stands for all labels that are not the volume's.
struct Places {
  /// Interfaces: of two labels, the closure of the faces between them.
  std::vector<PlaceBetti> interfaces;
  /// Meetings: of two to kMostLabelsOfPlace labels, the points that all their closed regions share;
  /// for two that is the interface and whatever edges and vertices they touch in besides.
  std::vector<PlaceBetti> meetings;
};

/// REQUIRES and errors: as voxel_betti; kResource also from 2^32 pairs of place and vertex on.
/// Cost: one pass over the voxels, then sorts of the vertices and edges on interfaces, 8 and 16
/// bytes each and place; cavities as in betti_of_parts.  Deterministic.
[[nodiscard]] Places voxel_places(const VoxelLabels& volume, std::size_t label_count);

/// The same of a mesh; see mesh_betti.
[[nodiscard]] Places mesh_places(const AuditMesh& mesh, std::size_t label_count);

/// A place that differs; all zeros where it is absent.
struct PlaceChange {
  PlaceLabels labels{};
  Betti before;
  Betti after;
};

/// Ascending.
[[nodiscard]] std::vector<PlaceChange> changes(const std::vector<PlaceBetti>& before,
                                               const std::vector<PlaceBetti>& after);

}  // namespace mw::audit
