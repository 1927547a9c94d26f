// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pairs up the two tets at each triangle of a star.
#include "kernels/distance/interface_fan.h"

#include <algorithm>
#include <bit>

namespace mw {

void InterfaceFan::collect(const TetMesh& mesh, LocalVertex v, std::vector<FanTriangle>& out) {
  sides_.clear();
  out.clear();
  const std::uint64_t all = mesh.label_signature(v);
  const bool one_bit_each = std::popcount(all) == mesh.order(v);
  for (const LinkTriangle& t : mesh.star(v)) {
    if (t.label == kExterior) continue;
    // Both labels of an interface triangle lie at each of its corners.
    const std::uint64_t others = one_bit_each ? all & ~TetMesh::label_bit(t.label) : all;
    const std::uint64_t at_a = others & mesh.label_signature(t.a),
                        at_b = others & mesh.label_signature(t.b),
                        at_c = others & mesh.label_signature(t.c);
    const auto add = [&](LocalVertex a, LocalVertex b, std::uint64_t shared) {
      if (shared == 0) return;
      sides_.push_back({std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), t.label, a < b});
    };
    add(t.a, t.b, at_a & at_b);
    add(t.b, t.c, at_b & at_c);
    add(t.c, t.a, at_c & at_a);
  }
  std::sort(sides_.begin(), sides_.end());
  for (std::size_t i = 0; i + 1 < sides_.size(); ++i) {
    const Side& s = sides_[i];
    const Side& t = sides_[i + 1];
    if (s.edge == t.edge && s.label != t.label) {
      out.push_back({static_cast<LocalVertex>(s.edge >> 32), static_cast<LocalVertex>(s.edge),
                     s.label, t.label, t.ascends});
    }
  }
}

}  // namespace mw
