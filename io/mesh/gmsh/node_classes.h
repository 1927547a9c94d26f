// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which surface or volume each node of a mesh lies on.
#pragma once

#include "io/file/scratch/external_sort.h"
#include "io/file/scratch/scratch_file.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// A box along the axes.
struct EntityBox {
  Position lo{};
  Position hi{};
};

/// Entities are the groups of facets by their number, behind them the labels by rank, and then the
/// groups of wedges.  Each node is on the first entity that has it.  A node in no tet is on the
/// first label's entity; where there is no label, and so no group, it is on an entity of its own.
/// Memory: 40 MiB; the rest waits in temporary files, some 16 bytes a node of a tet and 64 bytes an
/// entity.  ERRORS: see ScratchFile.
class NodeClasses {
 public:
  explicit NodeClasses(GroupedMesh& mesh);

  [[nodiscard]] std::size_t entities() const { return boxes_.size(); }
  /// Returns the box of all nodes of the entity, on it or on its edge; zeros when there are none.
  [[nodiscard]] EntityBox box(std::size_t entity) { return boxes_.get(entity); }
  /// Returns the indices for row() of the nodes on the entity.
  [[nodiscard]] RowRange nodes(std::size_t entity) { return nodes_.get(entity); }
  /// Returns a row from those of all nodes by entity, ascending in each.
  [[nodiscard]] std::uint64_t row(std::uint64_t index) { return rows_[index]; }

 private:
  using Pairs = ExternalSort<2>;

  void place_rows(GroupedMesh& mesh, Pairs& uses, Pairs& indices);

  PagedArray<EntityBox> boxes_;
  PagedArray<RowRange> nodes_;
  PagedFile<std::uint64_t> rows_;
};

}  // namespace mw::io
