// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Compares the places of a volume with those of a mesh.
#include "kernels/audit/places.h"

namespace mw::audit {

std::vector<PlaceChange> changes(const std::vector<PlaceBetti>& before,
                                 const std::vector<PlaceBetti>& after) {
  std::vector<PlaceChange> out;
  auto b = before.begin();
  auto a = after.begin();
  while (b != before.end() || a != after.end()) {
    const bool lost = a == after.end() || (b != before.end() && b->labels < a->labels);
    const bool made = b == before.end() || (a != after.end() && a->labels < b->labels);
    PlaceChange change{lost ? b->labels : a->labels, {}, {}};
    if (!made) change.before = (b++)->betti;
    if (!lost) change.after = (a++)->betti;
    if (change.before != change.after) out.push_back(change);
  }
  return out;
}

}  // namespace mw::audit
