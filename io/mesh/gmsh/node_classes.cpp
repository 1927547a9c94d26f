// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which surface or volume each node of a mesh lies on.
#include "io/mesh/gmsh/node_classes.h"

#include <algorithm>

namespace mw::io {
namespace {

constexpr std::size_t kSortBytes = 8 << 20;

/// Sorts pairs of a node's row and an entity that has it, or of an entity and a row on it.
using Pairs = ExternalSort<2>;

void add_uses(std::span<const std::uint64_t> rows, std::uint64_t entity, Pairs& uses) {
  for (const std::uint64_t row : rows) uses.add({row, entity});
}

void add_facet_uses(GroupedMesh& mesh, Pairs& uses) {
  for (std::uint64_t group = 0; group < mesh.facet_groups().size(); ++group) {
    const RowRange facets = mesh.facet_groups()[group].facets;
    for (std::uint64_t f = facets.begin; f < facets.end; ++f) {
      add_uses(mesh.facet_nodes(mesh.facet(f)), group, uses);
    }
  }
}

void add_tet_uses(GroupedMesh& mesh, Pairs& uses) {
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    const std::uint64_t entity = mesh.facet_groups().size() + rank;
    for (std::uint64_t t = mesh.label_tets()[rank].begin; t < mesh.label_tets()[rank].end; ++t) {
      add_uses(mesh.tet_nodes(t), entity, uses);
    }
  }
}

/// Adds the nodes of wedges, which give their entities a box; no node is placed on these.
void add_wedge_uses(GroupedMesh& mesh, Pairs& uses) {
  std::uint64_t entity = mesh.facet_groups().size() + mesh.table().size();
  for (const WedgeGroup& group : mesh.wedge_groups()) {
    for (std::uint64_t w = group.wedges.begin; w < group.wedges.end; ++w) {
      add_uses(mesh.wedge_nodes(mesh.wedge(w)), entity, uses);
    }
    ++entity;
  }
}

std::size_t entity_count(const GroupedMesh& mesh) {
  return mesh.facet_groups().size() + std::max<std::size_t>(mesh.table().size(), 1) +
         mesh.wedge_groups().size();
}

/// Extends a box by a point, which is its first one when `first`.
void extend(EntityBox& box, const Position& p, bool first) {
  if (first) box = {p, p};
  for (std::size_t k = 0; k < 3; ++k) {
    box.lo[k] = std::min(box.lo[k], p[k]);
    box.hi[k] = std::max(box.hi[k], p[k]);
  }
}

}  // namespace

NodeClasses::NodeClasses(GroupedMesh& mesh)
    : boxes_(mesh.folder(), entity_count(mesh)),
      nodes_(mesh.folder(), boxes_.size()),
      rows_(mesh.folder()) {
  Pairs indices(mesh.folder(), kSortBytes);  // entity, row
  {
    Pairs uses(mesh.folder(), kSortBytes);
    add_facet_uses(mesh, uses);
    add_tet_uses(mesh, uses);
    add_wedge_uses(mesh, uses);
    place_rows(mesh, uses, indices);
  }
  indices.each([&](const std::array<std::uint64_t, 2>& index) {
    nodes_.change(index[0], [&](RowRange& range) {
      if (range.size() == 0) range = {rows_.size(), rows_.size()};
      ++range.end;
    });
    rows_.append(index[1]);
  });
}

/// Places each row on the entity of its first use: uses come by row, and those of a row by entity.
void NodeClasses::place_rows(GroupedMesh& mesh, Pairs& uses, Pairs& indices) {
  const std::uint64_t unused = mesh.facet_groups().size();
  std::vector<bool> has_box(boxes_.size());
  std::array<std::uint64_t, 2> last{mesh.node_count(), 0};
  std::uint64_t next = 0;  // the first row without a place
  uses.each([&](const std::array<std::uint64_t, 2>& use) {
    if (use == last) return;
    last = use;
    const std::uint64_t row = use[0], entity = use[1];
    boxes_.change(entity, [&](EntityBox& box) { extend(box, mesh.node(row), !has_box[entity]); });
    has_box[entity] = true;
    for (; next < row; ++next) indices.add({unused, next});
    if (next == row) indices.add({entity, next++});
  });
  for (; next < mesh.node_count(); ++next) indices.add({unused, next});
}

}  // namespace mw::io
