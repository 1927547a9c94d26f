// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Nodes of a cell that repeats itself, and the nodes that they are images of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// A node on the high face of some axes, and the one at the same place on their low faces.
struct PeriodicPair {
  std::uint64_t node = 0;      ///< row
  std::uint64_t image_of = 0;  ///< row of a node that lies on no high face itself
  unsigned axes = 0;           ///< along which they are apart: bit 0 = x
};

struct PeriodicPairs {
  std::vector<PeriodicPair> pairs;  ///< ascending by node
  std::uint64_t alone = 0;          ///< nodes on a high face that have no partner
  std::uint64_t unlike = 0;         ///< triangles on one face of an axis that the other lacks
};

/// Finds the pairs of all nodes, also middles of edges, on the faces of the periodic axes.
/// Memory: some 100 bytes for each of these nodes.
[[nodiscard]] PeriodicPairs periodic_pairs(GroupedMesh& mesh, unsigned axes);

/// Opens a file for the pairs of a mesh, and returns what writes them.  A .csv has the columns
/// node, image_of, x, y, z; the last three say by how many periods the node is apart.  A .inp has
/// for each axis a reference node in a set of its own, and equations: the displacement of a node is
/// the sum of those of its partner and of the reference nodes of the axes along which they are
/// apart.  A node is the first of at most three equations, which name no other first node.  Nodes
/// have the numbers of files for solvers, from 1 on. ERRORS: mw::Error(kUsage) for another ending;
/// what is returned throws it for a mesh whose record has no periodic axes or doubled vertices, and
/// kInternal when faces are unlike though no label was left out.
[[nodiscard]] WriteGrouped open_pairs(const std::filesystem::path& path);

}  // namespace mw::io
