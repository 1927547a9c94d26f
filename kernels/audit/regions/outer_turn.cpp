// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Turns around an edge in order of angle, and ways across the sphere of directions at a vertex.
#include "kernels/audit/regions/region_sets.h"

#include <algorithm>
#include <cmath>

#include "kernels/audit/partition/orientation.h"
#include "kernels/core/vector3.h"

namespace mw::audit {
namespace {

/// Orders wings by their angle from the first one: itself, then below, at and above half a turn.
class Turn {
 public:
  Turn(const Position& a, const Position& b, const BoundaryWing& first)
      : a_(a), b_(b), first_(first) {}

  [[nodiscard]] bool operator()(const BoundaryWing& m, const BoundaryWing& n) const {
    const int half_m = half(m), half_n = half(n);
    if (half_m != half_n) return half_m < half_n;
    return half_m % 2 == 1 && orientation(a_, b_, *m.p, *n.p) > 0;
  }

 private:
  [[nodiscard]] int half(const BoundaryWing& wing) const {
    if (wing.side == first_.side) return 0;
    const int sign = orientation(a_, b_, *first_.p, *wing.p);
    return sign > 0 ? 1 : sign == 0 ? 2 : 3;
  }

  const Position& a_;
  const Position& b_;
  BoundaryWing first_;
};

/// Where a way between two directions goes through the boundary.
struct Crossing {
  double at = 0;  ///< 0 to 1
  bool leaves = false;
  std::uint32_t side = 0;
};

/// The way from one direction to another on the sphere around v.
class Way {
 public:
  Way(const Position& v, const Position& from, const Position& to) : v_(v), from_(from), to_(to) {}

  /// Returns false when the way touches an edge or vertex, or does not leave and enter the region
  /// in turn: another way should be tried.
  [[nodiscard]] bool cross_all(std::span<const BoundaryWing> wings) {
    for (const BoundaryWing& wing : wings) {
      if (!cross(wing)) return false;
    }
    std::sort(crossings_.begin(), crossings_.end(),
              [](const Crossing& a, const Crossing& b) { return a.at < b.at; });
    for (std::size_t i = 0; i < crossings_.size(); ++i) {
      if (crossings_[i].leaves != (i % 2 == 0)) return false;
    }
    return crossings_.size() % 2 == 0;
  }
  [[nodiscard]] std::span<const Crossing> crossings() const { return crossings_; }

 private:
  [[nodiscard]] bool cross(const BoundaryWing& wing) {
    const int p = orientation(v_, from_, to_, *wing.p);
    const int q = orientation(v_, from_, to_, *wing.q);
    if (p * q == 0) return false;
    if (p == q) return true;
    const int start = orientation(v_, *wing.p, *wing.q, from_);
    const int end = orientation(v_, *wing.p, *wing.q, to_);
    if (start * end == 0) return false;
    // Great circles meet twice; the signs tell whether both arcs do so in the same point.
    if (start == end || p == start) return true;
    const double before = std::abs(volume6(v_, *wing.p, *wing.q, from_));
    const double behind = std::abs(volume6(v_, *wing.p, *wing.q, to_));
    const bool leaves = orientation(v_, *wing.p, *wing.q, *wing.apex) == start;
    crossings_.push_back({before / (before + behind), leaves, wing.side});
    return true;
  }

  const Position& v_;
  const Position& from_;
  const Position& to_;
  std::vector<Crossing> crossings_;
};

/// Returns a point inside of the tet, which is another one for each trial.
Position inside(const Position& v, const Cone& cone, std::uint32_t trial) {
  // Multiples of irrational numbers make no pattern that a lattice could share.
  constexpr std::array<double, 3> kSteps{0.41421356237309503, 0.7320508075688772,
                                         0.23606797749978969};
  std::array<double, 3> weights{};
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = (trial + 1) * kSteps[i];
    weights[i] = 0.2 + (x - std::floor(x));
    sum += weights[i];
  }
  Position out = v;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      out[k] += weights[i] / (2 * sum) * ((*cone[i])[k] - v[k]);
    }
  }
  return out;
}

}  // namespace

void unite_around_edge(const Position& a, const Position& b, std::vector<BoundaryWing>& wings,
                       const UniteSides& unite) {
  if (wings.size() == 2) return unite(wings[0].side, wings[1].side);
  std::sort(wings.begin(), wings.end(), Turn(a, b, wings.front()));
  for (std::size_t i = 0; i < wings.size(); ++i) {
    const BoundaryWing &here = wings[i], &next = wings[(i + 1) % wings.size()];
    const bool ends = orientation(a, b, *here.p, *here.apex) < 0;
    const bool begins = orientation(a, b, *next.p, *next.apex) > 0;
    if (ends && begins) unite(here.side, next.side);
  }
}

void unite_around_vertex(const Position& v, std::span<const BoundaryWing> wings,
                         std::span<const Cone> cones, const UniteSides& unite) {
  constexpr std::uint32_t kMaxTrials = 100;
  for (std::size_t i = 1; i < cones.size(); ++i) {
    for (std::uint32_t trial = 0; trial < kMaxTrials; ++trial) {
      const Position from = inside(v, cones[i], 2 * trial);
      const Position to = inside(v, cones[0], 2 * trial + 1);  // in another place than `from`
      Way way(v, from, to);
      if (!way.cross_all(wings)) continue;
      const std::span<const Crossing> crossings = way.crossings();
      for (std::size_t k = 0; k < crossings.size(); k += 2) {
        unite(crossings[k].side, crossings[k + 1].side);
      }
      break;
    }
  }
}

}  // namespace mw::audit
