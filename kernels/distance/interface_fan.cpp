// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pairs up the two tets at each triangle of a star.
#include "kernels/distance/interface_fan.h"

#include <algorithm>
#include <bit>

namespace mw {

namespace {

constexpr std::size_t kFirstSides = 128;

}  // namespace

void InterfaceFan::collect(const TetMesh& mesh, LocalVertex v, std::vector<FanTriangle>& out) {
  out.clear();
  const auto star = mesh.star(v);
  make_room(3 * star.size());
  const std::uint64_t all = mesh.label_signature(v);
  const bool one_bit_each = std::popcount(all) == mesh.order(v);
  for (const LinkTriangle& t : star) {
    if (t.label == kExterior) continue;
    // Both labels of an interface triangle lie at each of its corners.
    const std::uint64_t others = one_bit_each ? all & ~TetMesh::label_bit(t.label) : all;
    const std::uint64_t at_a = others & mesh.label_signature(t.a),
                        at_b = others & mesh.label_signature(t.b),
                        at_c = others & mesh.label_signature(t.c);
    if ((at_a & at_b) != 0) add_side(t.a, t.b, t.label, out);
    if ((at_b & at_c) != 0) add_side(t.b, t.c, t.label, out);
    if ((at_c & at_a) != 0) add_side(t.c, t.a, t.label, out);
  }
  std::sort(out.begin(), out.end(), [](const FanTriangle& s, const FanTriangle& t) {
    return s.a != t.a ? s.a < t.a : s.b < t.b;
  });
}

/// For a new call; at most half of the table gets used.
void InterfaceFan::make_room(std::size_t sides) {
  const std::size_t wanted = std::bit_ceil(std::max(kFirstSides, 2 * sides));
  if (wanted > sides_.size() || ++stamp_ == 0) {
    sides_.assign(std::max(wanted, sides_.size()), {});
    stamp_ = 1;
  }
}

/// The first side of a triangle waits for the other.
void InterfaceFan::add_side(LocalVertex a, LocalVertex b, Label label,
                            std::vector<FanTriangle>& out) {
  constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15ULL;
  const auto [low, high] = std::minmax(a, b);
  const std::uint64_t edge = std::uint64_t{low} << 32 | high;
  const std::size_t mask = sides_.size() - 1;
  std::size_t at = static_cast<std::size_t>(edge * kOdd >> 32) & mask;
  while (sides_[at].stamp == stamp_ && sides_[at].edge != edge) at = (at + 1) & mask;
  const Side other = sides_[at];
  if (other.stamp != stamp_) {
    sides_[at] = {edge, stamp_, label, a < b};
  } else if (other.label < label) {
    out.push_back({low, high, other.label, label, a < b});
  } else if (label < other.label) {
    out.push_back({low, high, label, other.label, other.ascends});
  }
}

}  // namespace mw
