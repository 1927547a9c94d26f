// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The facets of a shell, one after the other.
#pragma once

#include <utility>

#include "io/surface/shell_plan.h"
#include "io/surface/surface_sink.h"

namespace mw::io {

/// Temporary files and the mesh that they are about.
struct SurfaceSource {
  GroupedMesh& mesh;
  std::filesystem::path folder;  ///< of temporary files
};

/// The label that the normals of a part point out of.
[[nodiscard]] inline Label inside_of(const GroupedMesh& mesh, const ShellPart& part) {
  const FacetGroup& group = mesh.facet_groups()[part.group];
  return part.turned ? group.second : group.first;
}

/// Calls visit(rows of the mesh) on every facet, normals as planned.
template <class Visit>
void for_each_facet(GroupedMesh& mesh, const ShellPlan& plan, Visit visit) {
  for (const ShellPart& part : plan.parts) {
    const RowRange facets = mesh.facet_groups()[part.group].facets;
    for (std::uint64_t f = facets.begin; f < facets.end; ++f) {
      Triangle rows = mesh.facet(f).rows;
      if (part.turned) std::swap(rows[1], rows[2]);
      visit(rows);
    }
  }
}

}  // namespace mw::io
