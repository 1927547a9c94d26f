// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Nodes of a cell that repeats itself, and the nodes that they are images of.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/file/sink/atomic_file.h"
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

/// Finds the pairs of a mesh that was made with --periodic.  `name` is that of the file that is
/// written.  ERRORS: mw::Error(kUsage) for a mesh whose record has no periodic axes or doubled
/// vertices; kInternal when faces are unlike though no label was left out.
[[nodiscard]] PeriodicPairs recorded_pairs(GroupedMesh& mesh, const std::string& name);

/// Returns the axes that a mesh was made with; 0 for one that was not, or does not tell.
[[nodiscard]] unsigned recorded_axes(const GroupedMesh& mesh);

/// Writes for each axis a reference node in a set of its own, at the end of the axis's edge of the
/// box, and behind them, for each pair and degree of freedom, an equation: the value at the node is
/// the sum of that at its partner and those at the reference nodes of the axes along which they are
/// apart.  Returns the numbers of the reference nodes; they follow those of the mesh's nodes.
std::array<std::uint64_t, 3> write_equations(AtomicFile& file, GroupedMesh& mesh,
                                             const PeriodicPairs& found,
                                             std::span<const int> freedoms);

/// Opens a file for the pairs of a mesh, and returns what writes them.  A .csv has the columns
/// node, image_of, x, y, z; the last three say by how many periods the node is apart.  A .inp has
/// what write_equations() writes for displacements.  A node is the first of at most three
/// equations, which name no other first node.  Nodes have the numbers of files for solvers, from 1
/// on.  ERRORS: mw::Error(kUsage) for another ending; what is returned throws the errors of
/// recorded_pairs().
[[nodiscard]] WriteGrouped open_pairs(const std::filesystem::path& path);

}  // namespace mw::io
