// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Nodes go as far as the tets at them allow.
#pragma once

#include "io/file/scratch/paged_array.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// Where a node is to go from its place in the straight mesh.
struct NodeMove {
  Position move{};
  bool has_own = false;       ///< a middle that does not follow from its corners
  std::uint8_t shorter = 0;   ///< 0 all of the way, 1 half of it, 2 a quarter, 3 nothing
  bool is_held_back = false;  ///< goes less far from the next round on
  bool was_changed = false;   ///< in the last round
};

/// Returns the places of all nodes.  While there is a tet that the moves would spoil
/// (curve_nodes()) all its nodes go less far, all such tets at once.
[[nodiscard]] PagedArray<Position> straightened(GroupedMesh& mesh, PagedArray<NodeMove> moves,
                                                const std::filesystem::path& folder);

}  // namespace mw::io
