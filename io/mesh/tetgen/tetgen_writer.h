// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a mesh as TetGen's .node, .ele and .face files.
#pragma once

#include "io/file/atomic_file.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// Files of TetGen 1.5's manual, Sec 5.2, that lie beside each other; rows count from 1:
///   M.node   "nodes 3 0 0", then "row x y z", the fewest digits that give back the same double
///   M.ele    "tets 4 1" or "tets 10 1", then "row node.. attribute": the number of the label
///            (label_numbers.h); ten nodes in the order that TetGen -o2 writes
///   M.face   "facets 1", then "row three corners marker": the number of the group
///            (facet_numbers.h), as the boundary marker; of ten nodes the middles of edges 0 1, 1 2
///            and 2 0 are behind the corners, where TetGen looks for them
/// and the tables M.node.labels.csv and M.facets.csv.  M.node gets its name last.
class TetgenWriter : public GroupedWriter {
 public:
  /// path: that of M.node.
  explicit TetgenWriter(const std::filesystem::path& path);
  void write(GroupedMesh& mesh) override;

 private:
  void write_nodes(GroupedMesh& mesh);
  void write_tets(GroupedMesh& mesh);
  void write_facets(GroupedMesh& mesh);

  AtomicFile nodes_;
  AtomicFile tets_;
  AtomicFile facets_;
  AtomicFile label_table_;
  AtomicFile facet_table_;
};

/// The edges of a tet in the order of nodes 5 to 10 of TetGen's.
inline constexpr std::array<std::array<std::size_t, 2>, 6> kTetgenEdges{
    {{2, 3}, {0, 3}, {0, 1}, {1, 2}, {1, 3}, {0, 2}}};

/// M.ele of M.node, and M.face.
[[nodiscard]] std::filesystem::path tetgen_tets_path(const std::filesystem::path& nodes);
[[nodiscard]] std::filesystem::path tetgen_facets_path(const std::filesystem::path& nodes);

}  // namespace mw::io
