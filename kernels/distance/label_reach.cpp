// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One near voxel for all corners of a piece, or bisection.
#include "kernels/distance/label_reach.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/lanes.h"

namespace mw {
namespace {

/// Pieces with no edge longer than this share of the bound are not halved again.
constexpr double kSmallestPiece = 1.0 / 16.0;

/// The k-th index of [lo, hi) from the middle outwards; voxels near all corners are in the middle.
std::int64_t from_middle(std::int64_t lo, std::int64_t hi, std::int64_t k) {
  const std::int64_t middle = lo + (hi - lo - 1) / 2;
  return k % 2 == 0 ? middle - k / 2 : middle + (k + 1) / 2;
}

/// One coordinate of the three corners, the last twice.
MW_LANES Lanes along(const LabelReach::Triangle& t, int axis) {
  return Lanes{t[0][axis], t[1][axis], t[2][axis], t[2][axis]};
}

/// Squared distance along an axis to the voxel that begins at lo.
MW_LANES Lanes squared_gap(const Lanes& x, std::int64_t lo) {
  const Lanes low = lanes(static_cast<double>(lo));
  const Lanes below = low - x, above = x - (low + 1.0), zero = lanes(0.0);
  const Lanes away = below > above ? below : above;
  const Lanes gap = away > zero ? away : zero;
  return gap * gap;
}

/// Sets bit i where a voxel of `near` that is near all corners has label wanted[i].  Stops when all
/// bits of `missing` are found.
// More than five parameters: an innermost loop, which is compiled for several processors.
MW_WIDE unsigned find_labels(const LabelReach::Triangle& t, const LabelBox& labels,
                             const Box3& near, double squared_distance,
                             const std::array<Label, 2>& wanted, unsigned missing) {
  const Lanes px = along(t, 0), py = along(t, 1), pz = along(t, 2);
  unsigned found = 0;
  for (std::int64_t k = 0; k < near.hi.z - near.lo.z; ++k) {
    const std::int64_t z = from_middle(near.lo.z, near.hi.z, k);
    const Lanes of_z = squared_gap(pz, z);
    for (std::int64_t i = 0; i < near.hi.y - near.lo.y; ++i) {
      const std::int64_t y = from_middle(near.lo.y, near.hi.y, i);
      const Lanes left = squared_distance - (of_z + squared_gap(py, y));
      if (any(left < 0.0)) continue;
      const Label* label = labels.labels.data() + labels.box.offset({near.lo.x, y, z});
      for (std::int64_t x = near.lo.x; x < near.hi.x; ++x, ++label) {
        const unsigned bit = (*label == wanted[0] ? 1U : 0U) | (*label == wanted[1] ? 2U : 0U);
        if ((bit & missing & ~found) == 0 || any(squared_gap(px, x) > left)) continue;
        found |= bit;
        if ((missing & ~found) == 0) return found;
      }
    }
  }
  return found;
}

/// Replaces std::floor, which is a call on processors of the baseline.
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
    // Written without branches, as which corner is the least cannot be foretold.
    const double min = std::min(std::min(t[0][i], t[1][i]), t[2][i]);
    const double max = std::max(std::max(t[0][i], t[1][i]), t[2][i]);
    lo[k] = floor_index(max - max_distance_);
    hi[k] = floor_index(min + max_distance_) + 1;
  }
  const Box3& box = labels_.box;
  return {{std::max(lo[0], box.lo.x), std::max(lo[1], box.lo.y), std::max(lo[2], box.lo.z)},
          {std::min(hi[0], box.hi.x), std::min(hi[1], box.hi.y), std::min(hi[2], box.hi.z)}};
}

LabelReach::Wanted LabelReach::unseen(const Triangle& t, Wanted wanted) const {
  const Box3 near = voxels_near(t);
  if (near.lo.x >= near.hi.x) return wanted;
  const unsigned missing = (wanted.a != kExterior ? 1U : 0U) | (wanted.b != kExterior ? 2U : 0U);
  const unsigned found =
      find_labels(t, labels_, near, squared_distance_, {wanted.a, wanted.b}, missing);
  return {(found & 1U) != 0 ? kExterior : wanted.a, (found & 2U) != 0 ? kExterior : wanted.b};
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
  const Vec3 &apex = t[longest], &p = t[(longest + 1) % 3], &q = t[(longest + 2) % 3];
  const Vec3 middle = 0.5 * (p + q);
  return prove({apex, p, middle}, wanted) && prove({apex, middle, q}, wanted);
}

bool LabelReach::within(const Triangle& t, Label a, Label b) const {
  return prove(t, {a, b});
}

}  // namespace mw
