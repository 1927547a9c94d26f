// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pairs up the two tets at each triangle of a star.
#include "kernels/distance/interface_fan.h"

#include <algorithm>
#include <bit>

namespace mw {
namespace {

constexpr std::size_t kFirstSides = 128;

std::uint64_t edge_of(LocalVertex a, LocalVertex b) {
  const auto [low, high] = std::minmax(a, b);
  return std::uint64_t{low} << 32 | high;
}

}  // namespace

void InterfaceFan::collect(const TetMesh& mesh, LocalVertex v, std::vector<FanTriangle>& out) {
  out.clear();
  make_room(3 * mesh.star(v).size());
  if (mesh.is_free(v) && mesh.planes(v) == 0 && mesh.order(v) == 2) {
    collect_of_two(mesh, v, out);
  } else {
    collect_of_any(mesh, v, out);
  }
  std::sort(out.begin(), out.end(), [](const FanTriangle& s, const FanTriangle& t) {
    return s.a != t.a ? s.a < t.a : s.b < t.b;
  });
}

void InterfaceFan::collect_of_any(const TetMesh& mesh, LocalVertex v,
                                  std::vector<FanTriangle>& out) {
  const std::uint64_t all = mesh.label_signature(v);
  const bool one_bit_each = std::popcount(all) == mesh.order(v);
  for (const LinkTriangle& t : mesh.star(v)) {
    if (t.label == kExterior) continue;
    // Both labels of an interface triangle lie at each of its corners.
    const std::uint64_t others = one_bit_each ? all & ~mesh.label_bit(t.label) : all;
    const std::uint64_t at_a = others & mesh.label_signature(t.a),
                        at_b = others & mesh.label_signature(t.b),
                        at_c = others & mesh.label_signature(t.c);
    if ((at_a & at_b) != 0) pair_sides(t.a, t.b, t.label, out);
    if ((at_b & at_c) != 0) pair_sides(t.b, t.c, t.label, out);
    if ((at_c & at_a) != 0) pair_sides(t.c, t.a, t.label, out);
  }
}

/// In a closed star of two labels, a triangle that only one tet of a label has is an interface
/// triangle.  So it is enough to look at the tets of the label that has fewer.
void InterfaceFan::collect_of_two(const TetMesh& mesh, LocalVertex v,
                                  std::vector<FanTriangle>& out) {
  const auto star = mesh.star(v);
  const Label first = star.front().label;
  const auto is_first = [first](const LinkTriangle& t) { return t.label == first; };
  const Label second = std::find_if_not(star.begin(), star.end(), is_first)->label;
  const auto of_first = static_cast<std::size_t>(std::count_if(star.begin(), star.end(), is_first));
  const bool takes_first = 2 * of_first <= star.size();
  const Label label = takes_first ? first : second, other = takes_first ? second : first;
  const std::uint64_t bit = mesh.label_bit(other);
  opened_.clear();
  for (const LinkTriangle& t : star) {
    if (t.label != label) continue;
    const bool at_a = (mesh.label_signature(t.a) & bit) != 0,
               at_b = (mesh.label_signature(t.b) & bit) != 0,
               at_c = (mesh.label_signature(t.c) & bit) != 0;
    if (at_a && at_b) open_or_close(t.a, t.b);
    if (at_b && at_c) open_or_close(t.b, t.c);
    if (at_c && at_a) open_or_close(t.c, t.a);
  }
  const auto [low, high] = std::minmax({without_side(label), without_side(other)});
  for (const std::size_t at : opened_) {
    const Side& s = sides_[at];
    if (!s.is_open) continue;
    out.push_back({static_cast<LocalVertex>(s.edge >> 32), static_cast<LocalVertex>(s.edge), low,
                   high, s.ascends == (without_side(label) == high), side_of(label)});
  }
}

/// Empties the table for a new call and makes it so large that at most half of it gets used.
void InterfaceFan::make_room(std::size_t sides) {
  const std::size_t wanted = std::bit_ceil(std::max(kFirstSides, 2 * sides));
  if (wanted > sides_.size() || ++stamp_ == 0) {
    sides_.assign(std::max(wanted, sides_.size()), {});
    stamp_ = 1;
  }
}

/// Returns where the edge is in the table, or would be.
std::size_t InterfaceFan::place_of(std::uint64_t edge) const {
  constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15ULL;
  const std::size_t mask = sides_.size() - 1;
  std::size_t at = static_cast<std::size_t>(edge * kOdd >> 32) & mask;
  while (sides_[at].stamp == stamp_ && sides_[at].edge != edge) at = (at + 1) & mask;
  return at;
}

/// The first side of a triangle waits for the other.
void InterfaceFan::pair_sides(LocalVertex a, LocalVertex b, Label sided,
                              std::vector<FanTriangle>& out) {
  const std::uint64_t edge = edge_of(a, b);
  Side& side = sides_[place_of(edge)];
  const auto [low, high] = std::minmax(a, b);
  if (side.stamp != stamp_) {
    side = {edge, stamp_, sided, a < b, true};
    return;
  }
  const Label one = without_side(side.label), other = without_side(sided);
  const bool in_plane = side_of(side.label) != side_of(sided);
  if (one < other) {
    out.push_back({low, high, one, other, a < b, side_of(sided), in_plane});
  } else if (other < one) {
    out.push_back({low, high, other, one, side.ascends, side_of(sided), in_plane});
  }
}

void InterfaceFan::open_or_close(LocalVertex a, LocalVertex b) {
  const std::uint64_t edge = edge_of(a, b);
  const std::size_t at = place_of(edge);
  Side& side = sides_[at];
  if (side.stamp == stamp_) {
    side.is_open = false;
    return;
  }
  side = {edge, stamp_, 0, a < b, true};
  opened_.push_back(at);
}

}  // namespace mw
