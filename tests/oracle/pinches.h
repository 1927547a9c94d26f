// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where boundaries of labels are no surfaces, by the definition: maps of faces, edges and fans.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "kernels/audit/subject.h"

namespace mw::audit::test {

/// An edge by its ends, the smaller one first.
using EdgeKey = std::pair<std::uint64_t, std::uint64_t>;

/// Vertices and edges at which the boundary of a label is no surface: edges of more than two of its
/// faces, and vertices whose faces are not one fan that closes.
struct Pinched {
  std::set<std::uint64_t> vertices;
  std::set<EdgeKey> edges;

  friend bool operator==(const Pinched&, const Pinched&) = default;
};

using PinchedByLabel = std::map<Label, Pinched>;

/// Returns the pinches of all labels that occur.  Vertices of a volume are its voxel corners, x
/// fastest; those of a mesh are rows.
[[nodiscard]] PinchedByLabel pinches_of(const VoxelLabels& volume);
[[nodiscard]] PinchedByLabel pinches_of(const AuditMesh& mesh);

/// True if all that is pinched in `some` is pinched in `all`, label by label.
[[nodiscard]] bool is_part_of(const PinchedByLabel& some, const PinchedByLabel& all);

}  // namespace mw::audit::test
