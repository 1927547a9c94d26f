// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Moves nodes as far as the tets at them allow.
#pragma once

#include "io/file/scratch/paged_array.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// Where a node is to go from its place in the straight mesh.
struct NodeMove {
  Position move{};
  bool has_own = false;       ///< the node is a middle that does not follow from its corners
  std::uint8_t shorter = 0;   ///< how far it goes: 0 all the way, 1 half, 2 a quarter, 3 nowhere
  bool is_held_back = false;  ///< it goes less far from the next round on
  bool was_changed = false;   ///< `shorter` was changed in the last round
};

/// Returns the places of all nodes.  While the moves would spoil tets, which then break what
/// curve_nodes() ensures, the node that goes farthest in each of these goes less far.
[[nodiscard]] PagedArray<Position> straightened(GroupedMesh& mesh, PagedArray<NodeMove> moves,
                                                const std::filesystem::path& folder,
                                                bool has_straight_parts);

}  // namespace mw::io
