// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where a fixed vertex may be inner or not, the worse case is assumed.
#include "kernels/inner/inner_demand.h"

#include <algorithm>

namespace mw {

/// Tets lose an inner vertex only where it is contracted into one on a boundary.
bool InnerFilter::keeps_inner(LocalVertex keep, LocalVertex drop) const {
  if (!is_surely_inner(mesh_, drop) || is_surely_inner(mesh_, keep)) return true;
  for (const LinkTriangle& t : mesh_.star(drop)) {
    if (!demand_->wants(t.label) || t.has(keep)) continue;
    const bool has_other =
        is_surely_inner(mesh_, t.a) || is_surely_inner(mesh_, t.b) || is_surely_inner(mesh_, t.c);
    if (!has_other) return false;
  }
  return true;
}

bool InnerFilter::lacks_no_more(std::span<const LocalTet> old_tets,
                                std::span<const LocalTet> new_tets) const {
  const auto count = [&](std::span<const LocalTet> tets, auto is_on_boundary) {
    return std::count_if(tets.begin(), tets.end(), [&](const LocalTet& t) {
      return demand_->wants(t.label) &&
             std::all_of(t.vertices.begin(), t.vertices.end(), is_on_boundary);
    });
  };
  const auto surely = [&](LocalVertex v) { return is_surely_on_boundary(mesh_, v); };
  const auto perhaps = [&](LocalVertex v) { return !is_surely_inner(mesh_, v); };
  return count(new_tets, perhaps) <= count(old_tets, surely);
}

}  // namespace mw
