// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The formula of radius_ratio(), with its sums in the order in which Eigen adds.
#include "kernels/quality/ratio_lanes.h"

namespace mw {
namespace {

MW_LANES Lanes3 edge(const TetLanes& tets, std::size_t i, const Vec3& unit) {
  return {to_lanes(tets.edges[3 * i]) * unit[0], to_lanes(tets.edges[3 * i + 1]) * unit[1],
          to_lanes(tets.edges[3 * i + 2]) * unit[2]};
}

MW_LANES Lanes norm(const Lanes3& v) {
  return root(eigen_dot(v, v));
}

MW_WIDE void find_ratios(const TetLanes& tets, const Vec3& unit, StoredLanes& out) {
  const Lanes3 a = edge(tets, 0, unit), b = edge(tets, 1, unit), c = edge(tets, 2, unit);
  const Lanes3 n1 = cross(b, c), n2 = cross(c, a), n3 = cross(a, b);
  const Lanes v6 = eigen_dot(a, n1);
  const Lanes area = norm(n1) + norm(n2) + norm(n3) + norm(n1 + n2 + n3);
  const Lanes3 w = eigen_dot(a, a) * n1 + eigen_dot(b, b) * n2 + eigen_dot(c, c) * n3;
  const Lanes ratio = 6.0 * v6 * v6 / (area * norm(w));
  const Lanes not_positive = v6 < 0.0 ? lanes(-1.0) : lanes(0.0);
  store(v6 > 0.0 ? ratio : not_positive, out);
}

}  // namespace

StoredLanes radius_ratios(const TetLanes& tets, const Metric& metric) {
  StoredLanes out;
  find_ratios(tets, metric.unit(), out);
  return out;
}

}  // namespace mw
