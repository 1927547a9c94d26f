// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Formulas of kernels/quality/quality.h on four tets at a time, with their sums in the order in
// which Eigen adds.
#include "kernels/quality/star_batch.h"

#include <limits>

namespace mw {
namespace {

using Group = StarBatch::Group;

LaneInts lanes_of(const Point& p) {
  using Words = std::uint64_t __attribute__((vector_size(2 * sizeof(std::uint64_t))));
  std::uint64_t first_two;
  std::memcpy(&first_two, &p, sizeof first_two);
  return std::bit_cast<LaneInts>(Words{first_two, static_cast<std::uint32_t>(p.z)});
}

LaneInts lanes_of(const LinkTriangle& t) {
  LaneInts out;
  static_assert(sizeof t == sizeof out);
  std::memcpy(&out, &t, sizeof out);
  return out;
}

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

/// What radius ratio and its bounds are made of; names as at radius_ratio().  It is made in place,
/// because the compiler takes copies of lanes through memory.
struct Ratio {
  [[gnu::always_inline]] explicit Ratio(const Corners& p)
      : n1(cross(p.b, p.c)),
        n2(cross(p.c, p.a)),
        n3(cross(p.a, p.b)),
        n4(n1 + n2 + n3),
        v6(dot(p.a, n1)),
        w(dot(p.a, p.a) * n1 + dot(p.b, p.b) * n2 + dot(p.c, p.c) * n3) {}

  Lanes3 n1, n2, n3, n4;
  Lanes v6;
  Lanes3 w;
};

/// 1 / radius ratio; infinite where the tet is not positive.
MW_LANES Lanes energy(const Group& g, const Vec3& unit, const Lanes3& x) {
  const Ratio r(corners_from(g, unit, x));
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

/// Marks the tets without a vertex.
MW_LANES LaneMask are_without(const Group& g, std::int32_t vertex) {
  return to_mask((load(g.rows[0]) != vertex) & (load(g.rows[1]) != vertex) &
                 (load(g.rows[2]) != vertex));
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
  const LaneMask counts = are_without(g, without);
  const Ratio r(corners_from(g, unit, lanes(x)));
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

/// Determinants of corners that are nearer than this to a point, in units along each axis, fit into
/// a double.
constexpr std::int32_t kExactExtent = 1 << 16;

MW_LANES LaneInts3 corner_units(const Group& g, std::size_t i, Point x) {
  return {load(g.corners[3 * i]) - x.x, load(g.corners[3 * i + 1]) - x.y,
          load(g.corners[3 * i + 2]) - x.z};
}
/// A number with bits above those of 2 * kExactExtent where one of three is not within it.
MW_LANES LaneInts beyond_extent(const LaneInts3& v) {
  return (v.x + kExactExtent) | (v.y + kExactExtent) | (v.z + kExactExtent);
}
MW_LANES Lanes3 as_doubles(const LaneInts3& v) {
  return {to_lanes(v.x), to_lanes(v.y), to_lanes(v.z)};
}

/// Judges by determinants, which are exact for corners within kExactExtent.
MW_WIDE ExactSigns find_signs(const Group& g, Point x, std::int32_t without) {
  const LaneInts3 a = corner_units(g, 0, x), b = corner_units(g, 1, x), c = corner_units(g, 2, x);
  const LaneInts beyond = beyond_extent(a) | beyond_extent(b) | beyond_extent(c);
  if (lane_bits((beyond & -(2 * kExactExtent)) != 0) != 0) return ExactSigns::kUnknown;
  const LaneMask counts = are_without(g, without);
  const Lanes v6 = dot(as_doubles(a), cross(as_doubles(b), as_doubles(c)));
  return any(counts & (v6 <= 0.0)) ? ExactSigns::kNotPositive : ExactSigns::kPositive;
}

MW_LANES Lanes3 edge(const TetLanes& tets, std::size_t i, const Vec3& unit) {
  return {to_lanes(tets.edges[3 * i]) * unit[0], to_lanes(tets.edges[3 * i + 1]) * unit[1],
          to_lanes(tets.edges[3 * i + 2]) * unit[2]};
}

MW_LANES Lanes norm(const Lanes3& v) {
  return root(eigen_dot(v, v));
}

/// See reaches_ratio() (kernels/quality/quality.h), whose verdict this is to the last bit.
MW_WIDE unsigned find_below(const TetLanes& tets, const Vec3& unit, double floor) {
  constexpr double kRounding = 1e-12;
  const Lanes3 a = edge(tets, 0, unit), b = edge(tets, 1, unit), c = edge(tets, 2, unit);
  const Lanes3 n1 = cross(b, c), n2 = cross(c, a), n3 = cross(a, b), n4 = n1 + n2 + n3;
  const Lanes v6 = eigen_dot(a, n1);
  const Lanes q1 = eigen_dot(n1, n1), q2 = eigen_dot(n2, n2), q3 = eigen_dot(n3, n3),
              q4 = eigen_dot(n4, n4);
  const Lanes3 w = eigen_dot(a, a) * n1 + eigen_dot(b, b) * n2 + eigen_dot(c, c) * n3;
  const Lanes reached = 36.0 * v6 * v6 * v6 * v6;
  const Lanes wanted = floor * floor * eigen_dot(w, w) * (1.0 + kRounding);
  const Lanes squares = q1 + q2 + q3 + q4;
  const LaneMask is_positive = v6 > 0.0;
  LaneMask reaches = is_positive & (reached >= wanted * 4.0 * squares);
  const LaneMask is_open = is_positive & ~reaches & ~(reached < wanted * squares);
  if (any(is_open)) {
    const Lanes area = root(q1) + root(q2) + root(q3) + root(q4);
    reaches |= is_open & (reached >= wanted * area * area);
  }
  return lane_bits(__builtin_convertvector(~reaches, LaneInts));
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
  std::array<const LinkTriangle*, kLanes> tets;
  std::size_t found = 0;
  for (; found < kLanes && next_ < star.size(); ++next_) {
    if (star[next_].label != kExterior) tets[found++] = &star[next_];
  }
  if (found == 0) return false;
  size_ += found;
  for (std::size_t lane = found; lane < kLanes; ++lane) tets[lane] = tets[found - 1];
  Group& g = groups_.emplace_back();
  const LaneInts origin = lanes_of(mesh_->position(vertex_));
  const auto gather = [&](std::size_t corner, LocalVertex LinkTriangle::*row) {
    const auto from_origin = [&](std::size_t lane) {
      return lanes_of(mesh_->position(tets[lane]->*row)) - origin;
    };
    const auto [x, y, z] =
        transposed(from_origin(0), from_origin(1), from_origin(2), from_origin(3));
    store(x, g.corners[3 * corner]);
    store(y, g.corners[3 * corner + 1]);
    store(z, g.corners[3 * corner + 2]);
  };
  gather(0, &LinkTriangle::a);
  gather(1, &LinkTriangle::b);
  gather(2, &LinkTriangle::c);
  const auto [a, b, c] =
      transposed(lanes_of(*tets[0]), lanes_of(*tets[1]), lanes_of(*tets[2]), lanes_of(*tets[3]));
  store(a, g.rows[0]);
  store(b, g.rows[1]);
  store(c, g.rows[2]);
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

ExactSigns StarBatch::signs_at(Point x, LocalVertex without) {
  gather_all();
  for (const Group& g : groups_) {
    const ExactSigns signs = find_signs(g, x, static_cast<std::int32_t>(without));
    if (signs != ExactSigns::kPositive) return signs;
  }
  return ExactSigns::kPositive;
}

unsigned below_ratio(const TetLanes& tets, const Metric& metric, double floor) {
  return find_below(tets, metric.unit(), floor);
}

StoredLanes radius_ratios(const TetLanes& tets, const Metric& metric) {
  StoredLanes out;
  find_ratios(tets, metric.unit(), out);
  return out;
}

}  // namespace mw
