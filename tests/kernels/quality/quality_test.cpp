// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Radius ratio and Eq (3) against other formulas for the same, and known tets.
#include "kernels/quality/quality.h"
#include "kernels/quality/star_batch.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

using Corners = std::array<Vec3, 4>;

double real(std::mt19937& random) {
  return static_cast<double>(random()) / 2147483648.0 - 1.0;
}

Corners random_tet(std::mt19937& random) {
  Corners p;
  for (Vec3& v : p) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = real(random);
  }
  if ((p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0])) < 0) std::swap(p[2], p[3]);
  return p;
}

TetEdges edges(const Corners& p) {
  return {p[1] - p[0], p[2] - p[0], p[3] - p[0]};
}

double heron(double a, double b, double c) {
  const double s = (a + b + c) / 2;
  return std::sqrt(s * (s - a) * (s - b) * (s - c));
}

/// 3 r / R from edge lengths: r = 3 V / S with Heron's areas; 6 V R is the area of the triangle
/// whose sides are the products of opposite edges.
double ratio_from_lengths(const Corners& p) {
  const auto length = [&](std::size_t i, std::size_t j) { return (p[i] - p[j]).norm(); };
  const double volume = (p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0])) / 6;
  double surface = 0.0;
  for (std::size_t skip = 0; skip < 4; ++skip) {
    const std::size_t i = (skip + 1) % 4, j = (skip + 2) % 4, k = (skip + 3) % 4;
    surface += heron(length(i, j), length(j, k), length(k, i));
  }
  const double products =
      heron(length(0, 1) * length(2, 3), length(0, 2) * length(1, 3), length(0, 3) * length(1, 2));
  return 3.0 * (3.0 * volume / surface) / (products / (6.0 * volume));
}

double variance_from_moments(const Corners& p) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      sum += (p[i] - p[j]).norm();
      squares += (p[i] - p[j]).squaredNorm();
    }
  }
  return 6.0 * squares / (sum * sum) - 1.0;
}

/// Corners on a coarse lattice, so that many tets are flat or inverted.
std::array<Point, 4> coarse_tet(std::mt19937& random) {
  std::array<Point, 4> out;
  for (Point& p : out) {
    const auto place = [&] { return static_cast<std::int32_t>(random() % 9) * 511; };
    const std::int32_t x = place(), y = place();
    p = {x, y, place()};
  }
  return out;
}

/// Inverted and flat ones are among them.
TEST(RadiusRatio, OfSeveralTetsIsThatOfEach) {
  std::mt19937 random(705);
  const Metric metric({1.0, 1.3, 2.5});
  int positive = 0, other = 0;
  for (int i = 0; i < 2000; ++i) {
    TetLanes tets;
    std::array<double, kLanes> expected;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const std::array<Point, 4> p = coarse_tet(random);
      tets.set(k, p[0], p[1], p[2], p[3]);
      expected[k] = radius_ratio(tet_edges(metric, p[0], p[1], p[2], p[3]));
      (expected[k] > 0.0 ? positive : other) += 1;
    }
    EXPECT_EQ(radius_ratios(tets, metric), expected);
  }
  EXPECT_GT(positive, 1000);
  EXPECT_GT(other, 1000);
}

TEST(RadiusRatio, TetsBelowAFloorAreThoseThatDoNotReachIt) {
  std::mt19937 random(706);
  const Metric metric({1.0, 1.3, 2.5});
  int reached = 0, missed = 0;
  for (int i = 0; i < 4000; ++i) {
    TetLanes tets;
    std::array<TetEdges, kLanes> edges_of;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const std::array<Point, 4> p = coarse_tet(random);
      tets.set(k, p[0], p[1], p[2], p[3]);
      edges_of[k] = tet_edges(metric, p[0], p[1], p[2], p[3]);
    }
    for (const double floor :
         {0.0, 0.05, 0.2, 0.5, radius_ratio(edges_of[static_cast<std::size_t>(i) % kLanes])}) {
      const unsigned below = below_ratio(tets, metric, floor);
      for (std::size_t k = 0; k < kLanes; ++k) {
        const bool reaches = reaches_ratio(edges_of[k], floor);
        ASSERT_EQ((below >> k & 1U) == 0, reaches) << floor;
        (reaches ? reached : missed) += 1;
      }
    }
  }
  EXPECT_GT(reached, 5000);
  EXPECT_GT(missed, 5000);
}

TEST(Sec54Quality, RegularTetIsBest) {
  Corners p{Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 0, 1}, Vec3{0, 1, 1}};
  if (radius_ratio(edges(p)) < 0) std::swap(p[2], p[3]);
  EXPECT_NEAR(radius_ratio(edges(p)), 1.0, 1e-14);
  EXPECT_NEAR(edge_length_variance(edges(p)), 0.0, 1e-14);
}

TEST(Sec54Quality, LatticeCornerTetHasTheValuesOfEq3) {
  const Corners p{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  // Three edges of 1 and three of sqrt 2: variance (sqrt 2 - 1)^2 / 4 over mean (1 + sqrt 2)^2 / 4.
  EXPECT_NEAR(edge_length_variance(edges(p)), 0.0294, 5e-5);
  EXPECT_NEAR(radius_ratio(edges(p)), std::sqrt(3.0) - 1.0, 1e-14);
}

TEST(Sec54Quality, AgreesWithEdgeLengthFormulas) {
  std::mt19937 random(611);
  for (int i = 0; i < 5000; ++i) {
    const Corners p = random_tet(random);
    const double expected = ratio_from_lengths(p);
    if (expected < 1e-4) continue;  // Heron loses digits there
    ASSERT_NEAR(radius_ratio(edges(p)), expected, 1e-9);
    ASSERT_LE(radius_ratio(edges(p)), 1.0 + 1e-12);
    ASSERT_NEAR(edge_length_variance(edges(p)), variance_from_moments(p), 1e-12);
  }
}

TEST(Sec54Quality, DependsOnNeitherScaleNorNaming) {
  std::mt19937 random(612);
  for (int i = 0; i < 500; ++i) {
    const Corners p = random_tet(random);
    const double ratio = radius_ratio(edges(p)), variance = edge_length_variance(edges(p));
    for (double scale : {1e-3, 7.0, 1e6}) {
      const TetEdges e = edges(p);
      const TetEdges scaled{scale * e.a, scale * e.b, scale * e.c};
      ASSERT_NEAR(radius_ratio(scaled), ratio, 1e-12);
      ASSERT_NEAR(edge_length_variance(scaled), variance, 1e-12);
    }
    for (const Corners& even : {Corners{p[1], p[0], p[3], p[2]}, Corners{p[1], p[2], p[0], p[3]},
                                Corners{p[3], p[1], p[0], p[2]}}) {
      ASSERT_NEAR(radius_ratio(edges(even)), ratio, 1e-10);
      ASSERT_NEAR(edge_length_variance(edges(even)), variance, 1e-12);
    }
  }
}

TEST(Sec54Quality, IsNegativeForInvertedAndZeroForFlatTets) {
  std::mt19937 random(613);
  for (int i = 0; i < 500; ++i) {
    const Corners p = random_tet(random);
    EXPECT_GT(radius_ratio(edges(p)), 0.0);
    EXPECT_LT(radius_ratio(edges({p[0], p[2], p[1], p[3]})), 0.0);
  }
  EXPECT_EQ(radius_ratio({Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 0}}), 0.0);
}

/// Fat and flat, large and small.
Corners scaled_tet(std::mt19937& random, int i) {
  Corners p = random_tet(random);
  const double size = std::pow(10.0, i % 7 - 3), flat = std::pow(10.0, -(i % 5));
  for (Vec3& v : p) v = size * Vec3(v[0], v[1], flat * v[2]);
  return p;
}

TEST(Sec54Quality, ReachingARatioIsHavingIt) {
  std::mt19937 random(604);
  int above = 0, below = 0;
  for (int i = 0; i < 20000; ++i) {
    const TetEdges t = edges(scaled_tet(random, i));
    const double ratio = radius_ratio(t);
    for (const double factor : {0.3, 0.9, 1.0 - 1e-9, 1.0 + 1e-9, 1.1, 3.0}) {
      ASSERT_EQ(reaches_ratio(t, ratio * factor), factor < 1.0) << ratio << " * " << factor;
    }
    for (const double floor : {0.05, 0.1, 0.2, 0.3, 0.5}) {
      if (std::abs(ratio - floor) < 1e-9 * floor) continue;
      ASSERT_EQ(reaches_ratio(t, floor), ratio >= floor);
      (ratio >= floor ? above : below) += 1;
    }
  }
  EXPECT_GT(above, 5000);
  EXPECT_GT(below, 5000);
}

TEST(Sec54Quality, InvertedAndFlatTetsReachNoRatio) {
  std::mt19937 random(605);
  for (int i = 0; i < 1000; ++i) {
    Corners p = scaled_tet(random, i);
    std::swap(p[0], p[1]);
    for (const double floor : {0.0, 0.1}) EXPECT_FALSE(reaches_ratio(edges(p), floor));
  }
  const TetEdges flat{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)};
  EXPECT_FALSE(reaches_ratio(flat, 0.0));
}

// Stars at once against tet by tet, and derivatives against differences.

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A vertex of a disturbed mesh, and a position for it that may invert tets.
struct Trial {
  const TetMesh& mesh;
  Metric metric;
  LocalVertex vertex = 0;
  Vec3 offset;

  /// The tet over a link triangle, seen from the position.
  [[nodiscard]] TetEdges edges(const LinkTriangle& t) const {
    const Point v = mesh.position(vertex);
    const auto corner = [&](LocalVertex w) -> Vec3 {
      return metric.vector(v, mesh.position(w)) - offset;
    };
    return {corner(t.a), corner(t.b), corner(t.c)};
  }
};

template <typename Visit>
void each_trial(unsigned seed, Visit visit) {
  std::mt19937 random(seed);
  for (int i = 0; i < 40 && !::testing::Test::HasFailure(); ++i) {
    TetMesh mesh = dense_mesh(random_volume(random));
    disturb(mesh, random);
    const Metric metric = i % 2 == 0 ? Metric() : Metric({1.0, 2.0, 4.5});
    for (int k = 0; k < 60; ++k) {
      const LocalVertex v = below(random, mesh.vertex_count());
      const double reach = k % 3 == 0 ? 0.0 : 0.1 * k / 6.0;
      Vec3 offset;
      for (double& x : offset) x = reach * (static_cast<double>(below(random, 2001)) / 1000 - 1);
      visit(Trial{mesh, metric, v, offset}, random);
    }
  }
}

double energy(double ratio) {
  return ratio > 0.0 ? 1.0 / ratio : kInfinite;
}

TEST(StarBatch, SumsEnergiesOfAllTets) {
  int inverted = 0, sound = 0;
  each_trial(611, [&](const Trial& trial, std::mt19937&) {
    StarBatch star;
    star.collect(trial.mesh, trial.metric, trial.vertex);
    double sum = 0.0, worst = 1.0;
    for (const LinkTriangle& t : trial.mesh.star(trial.vertex)) {
      if (t.label == kExterior) continue;
      const double ratio = std::max(radius_ratio(trial.edges(t)), 0.0);
      sum += energy(ratio);
      worst = std::min(worst, ratio);
    }
    const StarShape shape = star.shape_at(trial.offset);
    EXPECT_NEAR(shape.worst, worst, 1e-12);
    if (worst == 0.0) {
      ++inverted;
      EXPECT_EQ(shape.energy, kInfinite);
      EXPECT_EQ(star.energy_at(trial.offset, 0.01, kInfinite), kInfinite);
      return;
    }
    ++sound;
    EXPECT_NEAR(shape.energy, sum, 1e-9 * sum);
    EXPECT_NEAR(star.energy_at(trial.offset, 0.9 * worst, kInfinite), sum, 1e-9 * sum);
    EXPECT_EQ(star.energy_at(trial.offset, 1.1 * worst, kInfinite), kInfinite);
    for (const double share : {0.01, 0.5, 0.99, 1.01}) {
      const double enough = share * sum, told = star.energy_at(trial.offset, 0.9 * worst, enough);
      EXPECT_EQ(told > enough, share < 1.0);
      EXPECT_LE(told, sum * (1.0 + 1e-9));
    }
  });
  EXPECT_GT(inverted, 100);
  EXPECT_GT(sound, 500);
}

/// Each call to one that was just collected, because a star is gathered no further than needed.
TEST(StarBatch, JudgesLikeEachTetByItself) {
  std::map<StarVerdict, int> seen;
  each_trial(612, [&](const Trial& trial, std::mt19937& random) {
    const auto entries = trial.mesh.star(trial.vertex);
    const LocalVertex without =
        entries[below(random, static_cast<std::uint32_t>(entries.size()))].b;
    const double floor = 0.1 + 0.1 * below(random, 5);
    bool good = true, positive = true, near_floor = false;
    for (const LinkTriangle& t : entries) {
      if (t.label == kExterior || t.has(without)) continue;
      const double ratio = radius_ratio(trial.edges(t));
      good = good && ratio >= floor;
      positive = positive && ratio > 0.0;
      near_floor = near_floor || std::abs(ratio - floor) < 1e-9 || std::abs(ratio) < 1e-9;
    }
    if (near_floor) return;
    StarBatch fresh, gathered;
    fresh.collect(trial.mesh, trial.metric, trial.vertex);
    gathered.collect(trial.mesh, trial.metric, trial.vertex);
    (void)gathered.shape_at(Vec3::Zero());
    const StarVerdict verdict = fresh.judge_at(trial.offset, without, floor);
    EXPECT_EQ(verdict == StarVerdict::kGood, good);
    EXPECT_FALSE(positive && verdict == StarVerdict::kInverted);
    EXPECT_EQ(gathered.judge_at(trial.offset, without, floor), verdict);
    EXPECT_EQ(fresh.judge_at(trial.offset, without, floor), verdict);
    // Whatever it was asked before, and however much of it is gathered.
    (void)fresh.judge_at(Vec3::Zero(), without, 0.01 * below(random, 100));
    (void)fresh.judge_at(-trial.offset, without, floor);
    EXPECT_EQ(fresh.judge_at(trial.offset, without, floor) == StarVerdict::kGood, good);
    ++seen[verdict];
  });
  EXPECT_GT(seen[StarVerdict::kGood], 100);
  EXPECT_GT(seen[StarVerdict::kInverted], 50);
  EXPECT_GT(seen[StarVerdict::kLowQuality], 100);
}

TEST(StarBatch, SignsAreThoseOfWholeNumbers) {
  std::map<ExactSigns, int> seen;
  each_trial(613, [&](const Trial& trial, std::mt19937& random) {
    const auto entries = trial.mesh.star(trial.vertex);
    const auto any = [&]() -> const LinkTriangle& {
      return entries[below(random, static_cast<std::uint32_t>(entries.size()))];
    };
    const LocalVertex without = any().b, other = any().a;
    const Point at = trial.mesh.position(trial.vertex);
    const auto step = [&] { return static_cast<std::int32_t>(below(random, 1201)) - 600; };
    Point place{at.x + step(), at.y + step(), at.z + step()};
    // At a neighbour, tets with it are flat.
    if (below(random, 4) == 0 && other != trial.mesh.infinity()) {
      place = trial.mesh.position(other);
    }
    const bool is_far = below(random, 8) == 0;
    if (is_far) place.y += 1 << 17;
    bool is_positive = true;
    for (const LinkTriangle& t : entries) {
      if (t.label == kExterior || t.has(without)) continue;
      is_positive = is_positive && volume6(place, trial.mesh.position(t.a),
                                           trial.mesh.position(t.b), trial.mesh.position(t.c)) > 0;
    }
    StarBatch star;
    star.collect(trial.mesh, trial.metric, trial.vertex);
    const ExactSigns signs =
        star.signs_at({place.x - at.x, place.y - at.y, place.z - at.z}, without);
    ++seen[signs];
    EXPECT_EQ(signs == ExactSigns::kUnknown, is_far);
    if (is_far) return;
    EXPECT_EQ(signs == ExactSigns::kPositive, is_positive);
  });
  EXPECT_GT(seen[ExactSigns::kPositive], 200);
  EXPECT_GT(seen[ExactSigns::kNotPositive], 200);
  EXPECT_GT(seen[ExactSigns::kUnknown], 100);
}

/// Places far away in the plane of a triangle, or a unit beside it: products have all their digits.
TEST(StarBatch, SignsAreExactUpToTheLargestTets) {
  std::map<ExactSigns, int> seen;
  each_trial(614, [&](const Trial& trial, std::mt19937& random) {
    const auto entries = trial.mesh.star(trial.vertex);
    const auto within = [&](std::int32_t most) {
      return static_cast<std::int32_t>(below(random, static_cast<std::uint32_t>(2 * most + 1))) -
             most;
    };
    const LinkTriangle& t = entries[below(random, static_cast<std::uint32_t>(entries.size()))];
    if (t.label == kExterior) return;
    const Point a = trial.mesh.position(t.a), b = trial.mesh.position(t.b),
                c = trial.mesh.position(t.c), at = trial.mesh.position(trial.vertex);
    const std::int32_t most = 1 << below(random, 8), k = within(most), l = within(most);
    const Point place{a.x + k * (b.x - a.x) + l * (c.x - a.x) + within(1),
                      a.y + k * (b.y - a.y) + l * (c.y - a.y) + within(1),
                      a.z + k * (b.z - a.z) + l * (c.z - a.z) + within(1)};
    bool is_positive = true, is_small = true;
    for (const LinkTriangle& e : entries) {
      if (e.label == kExterior) continue;
      for (const LocalVertex v : {e.a, e.b, e.c}) {
        const Point p = trial.mesh.position(v);
        for (const std::int64_t x : {p.x - place.x, p.y - place.y, p.z - place.z}) {
          is_small = is_small && -(1 << 16) <= x && x < 1 << 16;
        }
      }
      is_positive = is_positive && volume6(place, trial.mesh.position(e.a),
                                           trial.mesh.position(e.b), trial.mesh.position(e.c)) > 0;
    }
    StarBatch star;
    star.collect(trial.mesh, trial.metric, trial.vertex);
    const ExactSigns signs =
        star.signs_at({place.x - at.x, place.y - at.y, place.z - at.z}, trial.mesh.infinity());
    ++seen[signs];
    if (is_small) {
      EXPECT_EQ(signs, is_positive ? ExactSigns::kPositive : ExactSigns::kNotPositive);
    } else {
      EXPECT_TRUE(signs == ExactSigns::kUnknown ||
                  (signs == ExactSigns::kNotPositive && !is_positive));
    }
  });
  EXPECT_GT(seen[ExactSigns::kPositive], 10);
  EXPECT_GT(seen[ExactSigns::kNotPositive], 200);
  EXPECT_GT(seen[ExactSigns::kUnknown], 100);
}

/// The sum of s^3 / v^2, and none when a tet is nearly flat or inverted.
std::optional<double> term_sum(const Trial& trial, const Vec3& step) {
  Trial at = trial;
  at.offset += step;
  double sum = 0.0;
  for (const LinkTriangle& t : trial.mesh.star(trial.vertex)) {
    if (t.label == kExterior) continue;
    const TetEdges e = at.edges(t);
    const double s = e.a.squaredNorm() + e.b.squaredNorm() + e.c.squaredNorm() +
                     (e.b - e.a).squaredNorm() + (e.c - e.b).squaredNorm() +
                     (e.a - e.c).squaredNorm();
    const double v = e.a.dot(e.b.cross(e.c));
    if (v * v < 3e-5 * s * s * s || v <= 0.0) return std::nullopt;
    sum += s * s * s / (v * v);
  }
  return sum;
}

TEST(StarBatch, DerivesTheNewtonEnergy) {
  int compared = 0;
  each_trial(613, [&](const Trial& trial, std::mt19937&) {
    constexpr double kStep = 1e-4;
    const auto value = term_sum(trial, Vec3::Zero());
    if (!value) return;
    StarBatch star;
    star.collect(trial.mesh, trial.metric, trial.vertex);
    const StarTerms terms = star.terms_at(trial.offset);
    EXPECT_NEAR(terms.value, *value, 1e-9 * *value);
    for (int i = 0; i < 3; ++i) {
      const Vec3 step = kStep * Vec3::Unit(i);
      const auto low = term_sum(trial, -step), high = term_sum(trial, step);
      if (!low || !high) return;
      EXPECT_NEAR(terms.gradient[i], (*high - *low) / (2 * kStep),
                  1e-4 * (*value + terms.gradient.norm()));
      const double second = (*high - 2 * *value + *low) / (kStep * kStep);
      EXPECT_NEAR(terms.hessian(i, i), second, 1e-2 * second);
    }
    EXPECT_TRUE(terms.hessian.isApprox(terms.hessian.transpose()));
    ++compared;
  });
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace mw::test
