// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bisection of triangles with a Lipschitz bound on the distance to two labels.
#include "kernels/distance/label_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mw {
namespace {

/// Against rounding in the last bits: proofs aim this much below the bound.
constexpr double kRoundingGuard = 1e-9;

/// Pieces smaller than this share of the bound are not halved again.
constexpr double kSmallestPiece = 1.0 / 3.0;

double gap(double x, std::int64_t lo) {
  const auto low = static_cast<double>(lo);
  return std::max({low - x, x - (low + 1.0), 0.0});
}

}  // namespace

LabelReach::LabelReach(const LabelBox& labels, double max_distance)
    : labels_(labels),
      max_distance_(max_distance - kRoundingGuard),
      reach_(search_reach(max_distance)) {}

std::int64_t LabelReach::search_reach(double max_distance) {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(max_distance)) - 1);
}

double LabelReach::distance(const Vec3& x, Label a, Label b) const {
  const Index3 at{static_cast<std::int64_t>(std::floor(x[0])),
                  static_cast<std::int64_t>(std::floor(x[1])),
                  static_cast<std::int64_t>(std::floor(x[2]))};
  const Box3& box = labels_.box;
  const Index3 lo{std::max(at.x - reach_, box.lo.x), std::max(at.y - reach_, box.lo.y),
                  std::max(at.z - reach_, box.lo.z)};
  const Index3 hi{std::min(at.x + reach_ + 1, box.hi.x), std::min(at.y + reach_ + 1, box.hi.y),
                  std::min(at.z + reach_ + 1, box.hi.z)};
  // A voxel outside the cube looked at is at least `reach_` away, so a nearer one found is exact.
  const double unseen = std::numeric_limits<double>::infinity();
  double nearest_a = unseen, nearest_b = unseen;
  for (std::int64_t z = lo.z; z < hi.z; ++z) {
    const double dz = gap(x[2], z);
    for (std::int64_t y = lo.y; y < hi.y; ++y) {
      const double dy = gap(x[1], y);
      const double dyz = dy * dy + dz * dz;
      const Label* row = labels_.labels.data() + box.offset({lo.x, y, z});
      for (std::int64_t i = lo.x; i < hi.x; ++i, ++row) {
        if (*row != a && *row != b) continue;
        const double dx = gap(x[0], i);
        double& nearest = *row == a ? nearest_a : nearest_b;
        nearest = std::min(nearest, dyz + dx * dx);
      }
    }
  }
  return std::sqrt(std::max(nearest_a, nearest_b));
}

bool LabelReach::prove(const Vec3& p, const Vec3& q, const Vec3& r, Label a, Label b) const {
  const Vec3 centroid = (p + q + r) / 3.0;
  const double radius = std::sqrt(std::max(
      {(p - centroid).squaredNorm(), (q - centroid).squaredNorm(), (r - centroid).squaredNorm()}));
  const double here = distance(centroid, a, b);
  if (here + radius <= max_distance_) return true;
  if (here > max_distance_ || radius <= kSmallestPiece * max_distance_) return false;
  const double pq = (q - p).squaredNorm(), qr = (r - q).squaredNorm(), rp = (p - r).squaredNorm();
  if (qr >= pq && qr >= rp) {
    const Vec3 m = 0.5 * (q + r);
    return prove(p, q, m, a, b) && prove(p, m, r, a, b);
  }
  if (rp >= pq) {
    const Vec3 m = 0.5 * (r + p);
    return prove(q, r, m, a, b) && prove(q, m, p, a, b);
  }
  const Vec3 m = 0.5 * (p + q);
  return prove(r, p, m, a, b) && prove(r, m, q, a, b);
}

bool LabelReach::within(const std::array<Vec3, 3>& t, Label a, Label b) const {
  return prove(t[0], t[1], t[2], a, b);
}

}  // namespace mw
