// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Places of a volume and of a mesh as one tile, held against each other in memory.
#pragma once

#include "kernels/audit/places.h"

namespace mw::audit::test {

/// One place; b0 is never 0.
struct PlaceBetti {
  PlaceLabels labels{};
  Betti betti;

  friend bool operator==(const PlaceBetti&, const PlaceBetti&) = default;
};

/// All places, ascending by labels.
struct Places {
  std::vector<PlaceBetti> interfaces;
  std::vector<PlaceBetti> meetings;
};

[[nodiscard]] Places places_of_volume(const VoxelLabels& volume, std::size_t label_count);
[[nodiscard]] Places places_of_mesh(const AuditMesh& mesh, std::size_t label_count);

[[nodiscard]] PlacesReport compare_places(const Places& before, const Places& after);

}  // namespace mw::audit::test
