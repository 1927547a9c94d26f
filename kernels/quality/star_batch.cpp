// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Formulas of kernels/quality/quality.h on four tets at a time.
#include "kernels/quality/star_batch.h"

#include <algorithm>

namespace mw {
namespace {

using Group = StarBatch::Group;

/// What radius ratio and its bounds are made of; names as at radius_ratio().
struct Ratio {
  Lanes3 n1, n2, n3, n4;
  Lanes v6;
  Lanes3 w;
};

MW_LANES Ratio ratio_terms(const Group& g, const Lanes3& x) {
  const Lanes3 a = load(g.a) - x, b = load(g.b) - x, c = load(g.c) - x;
  const Lanes3 n1 = cross(b, c), n2 = cross(c, a), n3 = cross(a, b);
  return {n1, n2, n3, n1 + n2 + n3, dot(a, n1), dot(a, a) * n1 + dot(b, b) * n2 + dot(c, c) * n3};
}

/// 1 / radius ratio; infinite where the tet is not positive.
MW_LANES Lanes energy(const Group& g, const Lanes3& x) {
  const Ratio r = ratio_terms(g, x);
  const Lanes area =
      root(dot(r.n1, r.n1)) + root(dot(r.n2, r.n2)) + root(dot(r.n3, r.n3)) + root(dot(r.n4, r.n4));
  const Lanes e = area * root(dot(r.w, r.w)) / (6.0 * r.v6 * r.v6);
  return r.v6 > 0.0 ? e : lanes(std::numeric_limits<double>::infinity());
}

MW_WIDE void energies(const Group& g, const Vec3& x, Stored<double>& out) {
  const Lanes e = energy(g, lanes(x));
  std::memcpy(out.data(), &e, sizeof e);
}

/// Sums of StarTerms, lane by lane.
struct TermSums {
  Lanes value{}, gx{}, gy{}, gz{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
};

[[gnu::always_inline]] inline void add_terms(const Group& g, const Lanes3& x, const Lanes& weight,
                                             TermSums& sums) {
  const Lanes3 a = load(g.a) - x, b = load(g.b) - x, c = load(g.c) - x;
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

MW_WIDE void sum_terms(const Group* groups, std::size_t count, const Stored<double>& last,
                       const Vec3& x, StarTerms& out) {
  TermSums sums;
  const Lanes3 at = lanes(x);
  for (std::size_t i = 0; i < count; ++i) {
    add_terms(groups[i], at, i + 1 < count ? lanes(1.0) : load(last), sums);
  }
  out.value = sum(sums.value);
  out.gradient = {sum(sums.gx), sum(sums.gy), sum(sums.gz)};
  out.hessian << sum(sums.xx), sum(sums.xy), sum(sums.xz), sum(sums.xy), sum(sums.yy), sum(sums.yz),
      sum(sums.xz), sum(sums.yz), sum(sums.zz);
}

/// The sum A of the four |n| lies between the root of their sum of squares and twice that, which
/// decides most cases without a square root (reaches_ratio()).
MW_LANES StarVerdict judge(const Group& g, const Lanes3& x, std::int64_t without, double floor) {
  constexpr double kRounding = 1e-12;
  const LaneMask counts =
      (load(g.rows[0]) != without) & (load(g.rows[1]) != without) & (load(g.rows[2]) != without);
  const Ratio r = ratio_terms(g, x);
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

MW_WIDE StarVerdict judge_groups(const Group* groups, std::size_t count, const Vec3& x,
                                 std::int64_t without, double floor) {
  const Lanes3 at = lanes(x);
  for (std::size_t i = 0; i < count; ++i) {
    const StarVerdict verdict = judge(groups[i], at, without, floor);
    if (verdict != StarVerdict::kGood) return verdict;
  }
  return StarVerdict::kGood;
}

}  // namespace

void StarBatch::collect(const TetMesh& mesh, const Metric& metric, LocalVertex v) {
  size_ = 0;
  const Point origin = mesh.position(v);
  const auto star = mesh.star(v);
  groups_.resize((star.size() + kLanes - 1) / kLanes);
  const auto put = [&](std::size_t at, const LinkTriangle& t) {
    Group& g = groups_[at / kLanes];
    const std::size_t lane = at % kLanes;
    const auto corner = [&](LocalVertex w, Stored3& to, std::size_t i) {
      const Vec3 p = metric.vector(origin, mesh.position(w));
      to.x[lane] = p[0];
      to.y[lane] = p[1];
      to.z[lane] = p[2];
      g.rows[i][lane] = w;
    };
    corner(t.a, g.a, 0);
    corner(t.b, g.b, 1);
    corner(t.c, g.c, 2);
  };
  const LinkTriangle* last = nullptr;
  for (const LinkTriangle& t : star) {
    if (t.label == kExterior) continue;
    put(size_++, t);
    last = &t;
  }
  groups_.resize((size_ + kLanes - 1) / kLanes);
  for (std::size_t i = size_; i < groups_.size() * kLanes; ++i) put(i, *last);
}

StarShape StarBatch::shape_at(const Vec3& x) const {
  StarShape out;
  double worst = 1.0;
  Stored<double> e;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    energies(groups_[i], x, e);
    for (std::size_t k = 0; k < used_lanes(i); ++k) {
      worst = std::max(worst, e[k]);
      out.energy += e[k];
    }
  }
  out.worst = 1.0 / worst;
  return out;
}

double StarBatch::energy_at(const Vec3& x, double least, double enough) const {
  double sum = 0.0;
  const double most = 1.0 / least;
  Stored<double> e;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    energies(groups_[i], x, e);
    for (std::size_t k = 0; k < used_lanes(i); ++k) {
      if (e[k] > most) return std::numeric_limits<double>::infinity();
      sum += e[k];
    }
    if (sum > enough) break;
  }
  return sum;
}

StarTerms StarBatch::terms_at(const Vec3& x) const {
  StarTerms out;
  if (groups_.empty()) return out;
  Stored<double> last{1.0, 1.0, 1.0, 1.0};
  for (std::size_t k = used_lanes(groups_.size() - 1); k < kLanes; ++k) last[k] = 0.0;
  sum_terms(groups_.data(), groups_.size(), last, x, out);
  return out;
}

StarVerdict StarBatch::judge_at(const Vec3& x, LocalVertex without, double floor) const {
  return judge_groups(groups_.data(), groups_.size(), x, without, floor);
}

}  // namespace mw
