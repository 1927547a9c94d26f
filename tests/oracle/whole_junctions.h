// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Junctions of a volume and of a mesh as one tile, held against each other in memory.
#pragma once

#include "kernels/audit/topology/junctions.h"

namespace mw::audit::test {

/// One junction; b0 is never 0.
struct JunctionBetti {
  JunctionLabels labels{};
  Betti betti;

  friend bool operator==(const JunctionBetti&, const JunctionBetti&) = default;
};

/// All junctions, ascending by labels.
struct Places {
  std::vector<JunctionBetti> interfaces;
  std::vector<JunctionBetti> meetings;
};

[[nodiscard]] Places junctions_of_volume(const VoxelLabels& volume, std::size_t label_count);
[[nodiscard]] Places junctions_of_mesh(const AuditMesh& mesh, std::size_t label_count);

[[nodiscard]] JunctionReport compare_junctions(const Places& before, const Places& after);

}  // namespace mw::audit::test
