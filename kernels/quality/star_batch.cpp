// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Formulas of kernels/quality/quality.h on four tets at a time, with their sums in the order in
// which Eigen adds.
#include "kernels/quality/star_batch.h"

#include <limits>

namespace mw {
namespace {

using Group = StarBatch::Group;

struct Corners {
  Lanes3 a, b, c;
};

/// Corner i (0 to 2) of the tets, seen from x.
MW_LANES Lanes3 corner(const Group& g, std::size_t i, const Vec3& unit, const Lanes3& x) {
  return {to_lanes(g.corners[3 * i]) * unit[0] - x.x,
          to_lanes(g.corners[3 * i + 1]) * unit[1] - x.y,
          to_lanes(g.corners[3 * i + 2]) * unit[2] - x.z};
}
MW_LANES Corners corners_from(const Group& g, const Vec3& unit, const Lanes3& x) {
  return {corner(g, 0, unit, x), corner(g, 1, unit, x), corner(g, 2, unit, x)};
}

/// What radius ratio and its bounds are made of; names as at radius_ratio().
struct Ratio {
  Lanes3 n1, n2, n3, n4;
  Lanes v6;
  Lanes3 w;
};

MW_LANES Ratio ratio_terms(const Group& g, const Vec3& unit, const Lanes3& x) {
  const auto [a, b, c] = corners_from(g, unit, x);
  const Lanes3 n1 = cross(b, c), n2 = cross(c, a), n3 = cross(a, b);
  return {n1, n2, n3, n1 + n2 + n3, dot(a, n1), dot(a, a) * n1 + dot(b, b) * n2 + dot(c, c) * n3};
}

/// 1 / radius ratio; infinite where the tet is not positive.
MW_LANES Lanes energy(const Group& g, const Vec3& unit, const Lanes3& x) {
  const Ratio r = ratio_terms(g, unit, x);
  const Lanes area =
      root(dot(r.n1, r.n1)) + root(dot(r.n2, r.n2)) + root(dot(r.n3, r.n3)) + root(dot(r.n4, r.n4));
  const Lanes e = area * root(dot(r.w, r.w)) / (6.0 * r.v6 * r.v6);
  return r.v6 > 0.0 ? e : lanes(std::numeric_limits<double>::infinity());
}

MW_WIDE void energies(const Group& g, const Vec3& unit, const Vec3& x,
                      std::array<double, kLanes>& out) {
  const Lanes e = energy(g, unit, lanes(x));
  std::memcpy(out.data(), &e, sizeof e);
}

/// Sums of StarTerms, lane by lane.
struct TermSums {
  Lanes value{}, gx{}, gy{}, gz{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
};

[[gnu::always_inline]] inline void add_terms(const Group& g, const Vec3& unit, const Lanes3& x,
                                             const Lanes& weight, TermSums& sums) {
  const auto [a, b, c] = corners_from(g, unit, x);
  const Lanes3 ab = b - a, ac = c - a, bc = c - b;
  const Lanes3 dv = cross(ac, ab);
  const Lanes3 ds = lanes(-2.0) * (a + b + c);
  const Lanes s = dot(a, a) + dot(b, b) + dot(c, c) + dot(ab, ab) + dot(ac, ac) + dot(bc, bc);
  const Lanes r = s / -dot(a, dv);
  const Lanes rr = weight * r * r;
  const Lanes3 u = r * (ds - r * dv);
  const Lanes3 slope = rr * (lanes(3.0) * ds - (2.0 * r) * dv);
  const Lanes outer = weight * (6.0 / s), diagonal = 18.0 * rr;
  sums.value += s * rr;
  sums.gx += slope.x;
  sums.gy += slope.y;
  sums.gz += slope.z;
  sums.xx += outer * u.x * u.x + diagonal;
  sums.xy += outer * u.x * u.y;
  sums.xz += outer * u.x * u.z;
  sums.yy += outer * u.y * u.y + diagonal;
  sums.yz += outer * u.y * u.z;
  sums.zz += outer * u.z * u.z + diagonal;
}

/// last is the number of tets of the last group that count.
MW_WIDE void sum_terms(const std::vector<Group>& groups, std::size_t last, const Vec3& unit,
                       const Vec3& x, StarTerms& out) {
  TermSums sums;
  const Lanes3 at = lanes(x);
  const auto n = static_cast<double>(last);
  const Lanes in_last = Lanes{0.0, 1.0, 2.0, 3.0} < n ? lanes(1.0) : lanes(0.0);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    add_terms(groups[i], unit, at, i + 1 < groups.size() ? lanes(1.0) : in_last, sums);
  }
  out.value = sum(sums.value);
  out.gradient = {sum(sums.gx), sum(sums.gy), sum(sums.gz)};
  out.hessian << sum(sums.xx), sum(sums.xy), sum(sums.xz), sum(sums.xy), sum(sums.yy), sum(sums.yz),
      sum(sums.xz), sum(sums.yz), sum(sums.zz);
}

/// Whether a corner of the tets is nearer than the root of `square`.
MW_WIDE bool has_near(const Group& g, const Vec3& unit, double square) {
  const auto [a, b, c] = corners_from(g, unit, lanes(Vec3(Vec3::Zero())));
  return any((dot(a, a) < square) | (dot(b, b) < square) | (dot(c, c) < square));
}

/// The sum A of the four |n| lies between the root of their sum of squares and twice that, which
/// decides most cases without a square root (reaches_ratio()).
MW_WIDE StarVerdict judge(const Group& g, const Vec3& unit, const Vec3& x, std::int32_t without,
                          double floor) {
  constexpr double kRounding = 1e-12;
  const LaneMask counts =
      differs(g.rows[0], without) & differs(g.rows[1], without) & differs(g.rows[2], without);
  const Ratio r = ratio_terms(g, unit, lanes(x));
  if (any(counts & (r.v6 <= 0.0))) return StarVerdict::kInverted;
  const Lanes q1 = dot(r.n1, r.n1), q2 = dot(r.n2, r.n2), q3 = dot(r.n3, r.n3),
              q4 = dot(r.n4, r.n4);
  const Lanes reached = 36.0 * r.v6 * r.v6 * r.v6 * r.v6;
  const Lanes wanted = floor * floor * (1.0 + kRounding) * dot(r.w, r.w);
  const Lanes squares = q1 + q2 + q3 + q4;
  if (any(counts & (reached < wanted * squares))) return StarVerdict::kLowQuality;
  if (!any(counts & (reached < 4.0 * wanted * squares))) return StarVerdict::kGood;
  const Lanes area = root(q1) + root(q2) + root(q3) + root(q4);
  const bool low = any(counts & (reached < wanted * area * area));
  return low ? StarVerdict::kLowQuality : StarVerdict::kGood;
}

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

void StarBatch::collect(const TetMesh& mesh, const Metric& metric, LocalVertex v) {
  mesh_ = &mesh;
  unit_ = metric.unit();
  vertex_ = v;
  next_ = 0;
  groups_.clear();
  size_ = 0;
  suspect_ = 0;
}

bool StarBatch::gather_group() {
  const auto star = mesh_->star(vertex_);
  const Point origin = mesh_->position(vertex_);
  std::size_t lane = 0;
  for (; lane < kLanes && next_ < star.size(); ++next_) {
    const LinkTriangle& t = star[next_];
    if (t.label == kExterior) continue;
    if (lane == 0) groups_.emplace_back();
    Group& g = groups_.back();
    std::size_t i = 0;
    for (LocalVertex w : {t.a, t.b, t.c}) {
      const Point p = mesh_->position(w);
      g.corners[3 * i][lane] = p.x - origin.x;
      g.corners[3 * i + 1][lane] = p.y - origin.y;
      g.corners[3 * i + 2][lane] = p.z - origin.z;
      g.rows[i++][lane] = static_cast<std::int32_t>(w);
    }
    ++lane;
  }
  if (lane == 0) return false;
  size_ += lane;
  Group& g = groups_.back();
  for (; lane < kLanes; ++lane) {
    for (StoredInts& c : g.corners) c[lane] = c[lane - 1];
    for (StoredInts& r : g.rows) r[lane] = r[lane - 1];
  }
  return true;
}

void StarBatch::gather_all() {
  while (gather_group()) {
  }
}

StarShape StarBatch::shape_at(const Vec3& x) {
  gather_all();
  StarShape out;
  double worst = 1.0;
  std::array<double, kLanes> e;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    energies(groups_[i], unit_, x, e);
    for (std::size_t k = 0; k < used_lanes(i); ++k) {
      worst = std::max(worst, e[k]);
      out.energy += e[k];
    }
  }
  out.worst = 1.0 / worst;
  return out;
}

double StarBatch::energy_at(const Vec3& x, double min, double enough) {
  gather_all();
  constexpr double kRounding = 1e-12;
  // No energy is below 1.
  double sum = 0.0, rest = static_cast<double>(size_) * (1.0 - kRounding);
  if (rest > enough) return rest;
  const double max = 1.0 / min;
  std::array<double, kLanes> e;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    energies(groups_[i], unit_, x, e);
    for (std::size_t k = 0; k < used_lanes(i); ++k) {
      if (e[k] > max) return std::numeric_limits<double>::infinity();
      sum += e[k];
    }
    rest -= static_cast<double>(used_lanes(i));
    if (sum + rest > enough) return sum + rest;
  }
  return sum;
}

StarTerms StarBatch::terms_at(const Vec3& x) {
  gather_all();
  StarTerms out;
  if (groups_.empty()) return out;
  sum_terms(groups_, used_lanes(groups_.size() - 1), unit_, x, out);
  return out;
}

void StarBatch::find_near(double radius, std::vector<Vec3>& out) {
  gather_all();
  out.clear();
  for (const Group& g : groups_) {
    if (!has_near(g, unit_, radius * radius)) continue;
    for (std::size_t i = 0; i < 3 * kLanes; ++i) {
      const std::size_t corner = i % 3 * 3, lane = i / 3;
      const Vec3 at = unit_.cwiseProduct(
          Vec3(g.corners[corner][lane], g.corners[corner + 1][lane], g.corners[corner + 2][lane]));
      if (at.squaredNorm() >= radius * radius) continue;
      if (std::find(out.begin(), out.end(), at) == out.end()) out.push_back(at);
    }
  }
}

StarVerdict StarBatch::judge_at(const Vec3& x, LocalVertex without, double floor) {
  const auto other = static_cast<std::int32_t>(without);
  const auto judge_group = [&](std::size_t i) {
    const StarVerdict verdict = judge(groups_[i], unit_, x, other, floor);
    if (verdict != StarVerdict::kGood) suspect_ = i;
    return verdict;
  };
  const std::size_t first = suspect_;
  const bool first_is_here = first < groups_.size();
  if (first_is_here) {
    const StarVerdict verdict = judge_group(first);
    if (verdict != StarVerdict::kGood) return verdict;
  }
  for (std::size_t i = 0; i < groups_.size() || gather_group(); ++i) {
    if (first_is_here && i == first) continue;
    const StarVerdict verdict = judge_group(i);
    if (verdict != StarVerdict::kGood) return verdict;
  }
  return StarVerdict::kGood;
}

StoredLanes radius_ratios(const TetLanes& tets, const Metric& metric) {
  StoredLanes out;
  find_ratios(tets, metric.unit(), out);
  return out;
}

}  // namespace mw
