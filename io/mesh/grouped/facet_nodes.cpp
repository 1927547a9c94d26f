// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/grouped/facet_nodes.h"

namespace mw::io {

std::vector<NamedFacets> named_facets(const GroupedMesh& mesh, const PlainNames& names) {
  std::vector<NamedFacets> out;
  for (const FacetGroup& group : mesh.facet_groups()) {
    const bool is_interface = group.side == Side::kInterface;
    // The groups of a side follow each other.
    if (!is_interface && !out.empty() && out.back().group.side == group.side) {
      out.back().group.facets.end = group.facets.end;
      continue;
    }
    out.push_back({group, names.facets(group), is_interface ? names.facets(group, true) : "",
                   is_interface && mesh.header().record.has_doubles});
  }
  return out;
}

}  // namespace mw::io
