// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pairs up the two tets at each triangle of a star.
#include "kernels/distance/interface_fan.h"

#include <algorithm>
#include <utility>

namespace mw {

void InterfaceFan::collect(const TetMesh& mesh, LocalVertex v, std::vector<FanTriangle>& out) {
  sides_.clear();
  out.clear();
  // A fixed vertex may have labels that are not loaded, the exterior among them.
  const auto may_be_on_interface = [&](LocalVertex w) {
    return !mesh.is_free(w) || mesh.on_interface(w);
  };
  for (const LinkTriangle& t : mesh.star(v)) {
    if (t.label == kExterior) continue;
    for (const auto& [a, b] :
         {std::minmax(t.a, t.b), std::minmax(t.b, t.c), std::minmax(t.c, t.a)}) {
      if (!may_be_on_interface(a) || !may_be_on_interface(b)) continue;
      sides_.push_back({a, b, t.label});
    }
  }
  std::sort(sides_.begin(), sides_.end());
  for (std::size_t i = 0; i + 1 < sides_.size(); ++i) {
    const Side& s = sides_[i];
    const Side& t = sides_[i + 1];
    if (s.a == t.a && s.b == t.b && s.label != t.label) {
      out.push_back({s.a, s.b, s.label, t.label});
    }
  }
}

}  // namespace mw
