// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sets of nodes, for formats that have them: the nodes of facets, and the two ends at which the job
// of a deck holds a mesh and pulls it.
#pragma once

#include "io/file/scratch/external_sort.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/grouped/plain_names.h"

namespace mw::io {

/// Calls visit(row) once for each node of the facets, ascending; with of_second, the facets are
/// those of an interface as GroupedMesh::of_second() has them.  Memory: 8 MiB; what is more goes to
/// a temporary file.  ERRORS: see ScratchFile.
template <class Visit>
void for_each_facet_node(GroupedMesh& mesh, RowRange facets, Visit visit, bool of_second = false) {
  constexpr std::size_t kSortBytes = 8 << 20;
  ExternalSort<1> rows(mesh.folder(), kSortBytes);
  for (std::uint64_t f = facets.begin; f < facets.end; ++f) {
    const Facet facet = of_second ? mesh.of_second(mesh.facet(f)) : mesh.facet(f);
    for (const std::uint64_t row : mesh.facet_nodes(facet)) rows.add({row});
  }
  std::uint64_t last = mesh.node_count();
  rows.each([&](const std::array<std::uint64_t, 1>& row) {
    if (row[0] == last) return;
    last = row[0];
    visit(last);
  });
}

/// A set of facets as programs with plain names know it: an interface, or a whole side of the box.
struct NamedFacets {
  FacetGroup group;       ///< with all facets of the side, whatever their label
  std::string name;       ///< see PlainNames; for an interface, that on the side of its lower label
  std::string other;      ///< for an interface, that on the side of its higher label; else empty
  bool is_split = false;  ///< an interface whose two sides have nodes of their own
};

/// Calls visit(NamedFacets) on the sets in the order of their facets; each facet of the mesh is in
/// one set.
template <class Visit>
void for_each_named(const GroupedMesh& mesh, const PlainNames& names, Visit visit) {
  for_each_facet_run(mesh, [&](const FacetGroup& run) {
    const bool is_interface = run.side == Side::kInterface;
    visit(NamedFacets{run, names.facets(run), is_interface ? names.facets(run, true) : "",
                      is_interface && mesh.header().record.has_doubles});
  });
}

/// The sides z_min and z_max of the box, where the mesh reaches both; else what lies in the lowest
/// and in the highest twentieth of the mesh along the box's z.
class DeckEnds {
 public:
  /// Cost: a pass over the nodes.
  explicit DeckEnds(GroupedMesh& mesh);

  [[nodiscard]] bool are_sides() const { return are_sides_; }
  /// REQUIRES (both): !are_sides().
  [[nodiscard]] bool is_low(const Position& node) const { return along(node) <= low_; }
  [[nodiscard]] bool is_high(const Position& node) const { return along(node) >= high_; }
  /// How far the upper end is pulled: 1 % of the mesh's height along the box's z, in that
  /// direction.
  [[nodiscard]] const Position& shift() const { return shift_; }

 private:
  [[nodiscard]] double along(const Position& node) const;

  Position direction_{};  ///< a unit vector
  bool are_sides_ = false;
  double low_ = 0;
  double high_ = 0;
  Position shift_{};
};

}  // namespace mw::io
