// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One near voxel for all corners of a piece, or bisection.
#include "kernels/distance/label_reach.h"

#include <algorithm>
#include <cmath>

namespace mw {
namespace {

/// Against rounding in the last bits: proofs aim this much below the bound.
constexpr double kRoundingGuard = 1e-9;

/// Pieces with no edge longer than this share of the bound are not halved again.
constexpr double kSmallestPiece = 1.0 / 16.0;

double gap(double x, std::int64_t lo) {
  const auto low = static_cast<double>(lo);
  return std::max({low - x, x - (low + 1.0), 0.0});
}

/// As std::floor, which is a call on processors of the baseline.
std::int64_t floor_index(double x) {
  const auto towards_zero = static_cast<std::int64_t>(x);
  return towards_zero - (x < static_cast<double>(towards_zero) ? 1 : 0);
}

}  // namespace

LabelReach::LabelReach(const LabelBox& labels, double max_distance)
    : labels_(labels),
      max_distance_(max_distance - kRoundingGuard),
      squared_distance_(max_distance_ * max_distance_),
      squared_smallest_(kSmallestPiece * kSmallestPiece * max_distance * max_distance) {}

std::int64_t LabelReach::search_reach(double max_distance) {
  return static_cast<std::int64_t>(std::ceil(max_distance));
}

Box3 LabelReach::voxels_near(const Triangle& t) const {
  std::array<std::int64_t, 3> lo{}, hi{};
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const auto [least, most] = std::minmax({t[0][i], t[1][i], t[2][i]});
    lo[k] = floor_index(most - max_distance_);
    hi[k] = floor_index(least + max_distance_) + 1;
  }
  const Box3& box = labels_.box;
  return {{std::max(lo[0], box.lo.x), std::max(lo[1], box.lo.y), std::max(lo[2], box.lo.z)},
          {std::min(hi[0], box.hi.x), std::min(hi[1], box.hi.y), std::min(hi[2], box.hi.z)}};
}

bool LabelReach::is_near(const Triangle& t, Index3 voxel) const {
  return std::all_of(t.begin(), t.end(), [&](const Vec3& p) {
    const double x = gap(p[0], voxel.x), y = gap(p[1], voxel.y), z = gap(p[2], voxel.z);
    return x * x + y * y + z * z <= squared_distance_;
  });
}

LabelReach::Wanted LabelReach::unseen(const Triangle& t, Wanted wanted) const {
  const Box3 near = voxels_near(t);
  for (Index3 v = near.lo; v.z < near.hi.z; ++v.z) {
    for (v.y = near.lo.y; v.y < near.hi.y; ++v.y) {
      v.x = near.lo.x;
      if (v.x >= near.hi.x) return wanted;
      const Label* row = labels_.labels.data() + labels_.box.offset(v);
      for (; v.x < near.hi.x; ++v.x, ++row) {
        if (*row == kExterior || (*row != wanted.a && *row != wanted.b)) continue;
        if (!is_near(t, v)) continue;
        (*row == wanted.a ? wanted.a : wanted.b) = kExterior;
        if (wanted.nothing()) return wanted;
      }
    }
  }
  return wanted;
}

bool LabelReach::prove(const Triangle& t, Wanted wanted) const {
  wanted = unseen(t, wanted);
  if (wanted.nothing()) return true;
  const std::array<double, 3> edges{(t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm(),
                                    (t[1] - t[0]).squaredNorm()};
  const auto longest =
      static_cast<std::size_t>(std::max_element(edges.begin(), edges.end()) - edges.begin());
  if (edges[longest] <= squared_smallest_) return false;
  const Vec3 centroid = (t[0] + t[1] + t[2]) / 3.0;
  if (!unseen({centroid, centroid, centroid}, wanted).nothing()) return false;
  const Vec3 apex = t[longest], p = t[(longest + 1) % 3], q = t[(longest + 2) % 3];
  const Vec3 middle = 0.5 * (p + q);
  return prove({apex, p, middle}, wanted) && prove({apex, middle, q}, wanted);
}

bool LabelReach::within(const Triangle& t, Label a, Label b) const {
  return prove(t, {a, b});
}

}  // namespace mw
