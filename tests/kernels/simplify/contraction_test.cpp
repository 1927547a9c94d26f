// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sec 5.3.3: survivor, position and cost of planned contractions, and what their shape filter says.
#include "kernels/simplify/contraction.h"

#include <array>
#include <set>

#include "kernels/quality/quality.h"
#include "kernels/simplify/contraction_filters.h"
#include "kernels/topology/link_condition.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

/// Start meshes and simplified ones, disturbed.
TetMesh random_mesh(std::mt19937& random, const Metric& metric) {
  TetMesh mesh = dense_mesh(random_volume(random));
  disturb(mesh, random);
  if (below(random, 2) == 0) simplify(mesh, metric, {.quality_floor = 0.2});
  return mesh;
}

Metric random_metric(std::mt19937& random) {
  return below(random, 2) == 0 ? Metric() : Metric({1.0, 2.0, 1.5});
}

/// Calls visit(mesh, metric, p, q) for a few thousand edges.
template <typename Visit>
void each_random_edge(unsigned seed, Visit visit) {
  std::mt19937 random(seed);
  for (int i = 0; i < 200 && !::testing::Test::HasFailure(); ++i) {
    const Metric metric = random_metric(random);
    const TetMesh mesh = random_mesh(random, metric);
    for (int k = 0; k < 100; ++k) {
      const auto [p, q] = random_edge(mesh, random);
      if (p != q) visit(mesh, metric, p, q);
    }
  }
}

bool is_inner(const TetMesh& mesh, LocalVertex v) {
  const auto star = mesh.star(v);
  return std::all_of(star.begin(), star.end(), [&](const LinkTriangle& t) {
    return t.label == star[0].label && t.label != kExterior;
  });
}

bool includes(unsigned planes, unsigned others) {
  return (planes & others) == others;
}

/// Q_p + Q_q at a lattice point.
double joint_error(const TetMesh& mesh, const Metric& metric, LocalVertex p, LocalVertex q,
                   Point x) {
  return mesh.quadric(p).value(metric.vector(mesh.position(p), x)) +
         mesh.quadric(q).value(metric.vector(mesh.position(q), x));
}

TEST(Sec533Contraction, IsPlannedAlikeFromBothEnds) {
  int planned = 0;
  each_random_edge(711, [&](const TetMesh& mesh, const Metric& metric, auto p, auto q) {
    const auto a = plan_contraction(mesh, metric, p, q), b = plan_contraction(mesh, metric, q, p);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) return;
    EXPECT_EQ(std::tie(a->keep, a->drop, a->cost, a->moves),
              std::tie(b->keep, b->drop, b->cost, b->moves));
    EXPECT_EQ(a->position, b->position);
    EXPECT_EQ(std::minmax(a->keep, a->drop), std::minmax(p, q));
    ++planned;
  });
  EXPECT_GT(planned, 1000);
}

/// Cost and place of a contraction to the optimum, within the planes of its ends.
void expect_optimum(const TetMesh& mesh, const Metric& metric, const Contraction& c) {
  EXPECT_LT(c.keep, c.drop);
  EXPECT_TRUE(c.moves);
  const auto error = [&](Point x) { return joint_error(mesh, metric, c.keep, c.drop, x); };
  const double rounding = 1e-9 * (1.0 + c.cost);
  EXPECT_GE(error(c.position), c.cost - rounding);
  EXPECT_LE(error(c.position), c.cost + 1e-4);
  const unsigned fixed = fixed_axes(mesh.planes(c.keep));
  for (std::int32_t step : {-40, -4, 4, 40}) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      Point x = c.position;
      std::int32_t& moved = axis == 0 ? x.x : axis == 1 ? x.y : x.z;
      if ((fixed >> axis & 1U) == 0) {
        moved += step;
        EXPECT_GE(error(x), error(c.position) - rounding);
      } else {
        const Point old = mesh.position(c.keep);
        EXPECT_EQ(moved, axis == 0 ? old.x : axis == 1 ? old.y : old.z);
      }
    }
  }
}

TEST(Sec533Case1, InnerVerticesMeetAtTheOptimumUnderTheSmallerId) {
  int seen = 0;
  each_random_edge(712, [&](const TetMesh& mesh, const Metric& metric, auto p, auto q) {
    if (!is_inner(mesh, p) || !is_inner(mesh, q)) return;
    const auto c = plan_contraction(mesh, metric, p, q);
    ASSERT_TRUE(c.has_value());
    expect_optimum(mesh, metric, *c);
    ++seen;
  });
  EXPECT_GT(seen, 100);
}

TEST(Sec533Contraction, OtherPlacesLieAlongTheEdgeAndHaveTheirOwnCosts) {
  int seen = 0;
  each_random_edge(717, [&](const TetMesh& mesh, const Metric& metric, auto p, auto q) {
    const auto c = plan_contraction(mesh, metric, p, q);
    if (!c || !c->moves) return;
    const Point keep = mesh.position(c->keep), drop = mesh.position(c->drop);
    const auto positions = other_positions(mesh, metric, *c);
    const auto middle_of = [](Point a, Point b) {
      return Point{(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
    };
    const Point middle = middle_of(keep, drop);
    const std::array<Point, 4> expected{middle_of(middle, c->position), middle, keep, drop};
    for (std::size_t i = 0; i < positions.size(); ++i) {
      EXPECT_EQ(positions[i].position, expected[i]);
      EXPECT_EQ(positions[i].keep, c->keep);
      EXPECT_EQ(positions[i].drop, c->drop);
      EXPECT_EQ(positions[i].moves, positions[i].position != keep);
      const double error = joint_error(mesh, metric, p, q, positions[i].position);
      EXPECT_NEAR(positions[i].cost, error, 1e-9 * (1.0 + error));
      EXPECT_GE(positions[i].cost, c->cost - 1e-4) << "cheaper than the optimum";
    }
    ++seen;
  });
  EXPECT_GT(seen, 500);
}

/// How many labels there are around a vertex, the exterior not among them.
std::size_t labels_around(const TetMesh& mesh, LocalVertex v) {
  std::set<Label> labels;
  for (const LinkTriangle& t : mesh.star(v)) labels.insert(t.label);
  labels.erase(kExterior);
  return labels.size();
}

TEST(Sec533Case3, TheHigherOrderMayAlsoGoTowardsTheOptimum) {
  int seen = 0, others = 0;
  each_random_edge(718, [&](const TetMesh& mesh, const Metric& metric, auto p, auto q) {
    const auto c = plan_contraction(mesh, metric, p, q);
    if (!c || c->moves) return;
    const bool on_interface = labels_around(mesh, c->drop) > 1;
    ASSERT_EQ(c->has_others, on_interface && mesh.planes(p) == mesh.planes(q));
    ++others;
    if (!c->has_others) return;
    const auto places = other_positions(mesh, metric, *c);
    const Contraction& best = places.front();
    for (const Contraction& other : places) {
      EXPECT_EQ(other.keep, c->keep);
      EXPECT_EQ(other.drop, c->drop);
      EXPECT_EQ(other.moves, other.position != mesh.position(c->keep));
      const double error = joint_error(mesh, metric, p, q, other.position);
      EXPECT_NEAR(other.cost, error, 1e-9 * (1.0 + error));
      EXPECT_GE(error, best.cost - 1e-3 * (1.0 + best.cost)) << "cheaper than the optimum";
    }
    EXPECT_LE(best.cost, c->cost + 1e-3 * (1.0 + c->cost));
    ++seen;
  });
  EXPECT_GT(seen, 200);
  EXPECT_GT(others, seen);
}

TEST(Sec533Contraction, PlacesAroundAreOnTheSamePlanesAndTheCheapestIsFirst) {
  int seen = 0, on_box = 0;
  each_random_edge(719, [&](const TetMesh& mesh, const Metric& metric, auto p, auto q) {
    const auto c = plan_contraction(mesh, metric, p, q);
    if (!c || !c->has_others) return;
    const Point keep = mesh.position(c->keep);
    const unsigned fixed = fixed_axes(mesh.planes(c->keep));
    double last = 0.0;
    std::set<std::array<std::int32_t, 3>> places;
    for (const Contraction& other : positions_around(mesh, metric, *c)) {
      EXPECT_EQ(other.keep, c->keep);
      EXPECT_EQ(other.drop, c->drop);
      EXPECT_EQ(other.moves, other.position != keep);
      for (unsigned axis = 0; axis < 3; ++axis) {
        if ((fixed >> axis & 1U) == 0) continue;
        EXPECT_EQ(along(other.position, axis), along(keep, axis));
      }
      const double error = joint_error(mesh, metric, p, q, other.position);
      EXPECT_NEAR(other.cost, error, 1e-9 * (1.0 + error));
      EXPECT_GE(other.cost, last);
      last = other.cost;
      places.insert({other.position.x, other.position.y, other.position.z});
    }
    EXPECT_GE(places.size(), fixed == 0 ? 125U : 1U);
    ++(fixed == 0 ? seen : on_box);
  });
  EXPECT_GT(seen, 100);
  EXPECT_GT(on_box, 10);
}

TEST(Sec533Case2, TheBoundaryVertexStaysWhereItIs) {
  int seen = 0;
  each_random_edge(713, [&](const TetMesh& mesh, const Metric& metric, auto p, auto q) {
    if (is_inner(mesh, p) == is_inner(mesh, q)) return;
    const LocalVertex boundary = is_inner(mesh, p) ? q : p;
    const auto c = plan_contraction(mesh, metric, p, q);
    ASSERT_TRUE(c.has_value());
    EXPECT_EQ(c->keep, boundary);
    EXPECT_FALSE(c->moves);
    EXPECT_EQ(c->position, mesh.position(boundary));
    const Vec3 way = metric.vector(mesh.position(c->drop), c->position);
    EXPECT_NEAR(c->cost, 4.0 * mesh.quadric(c->drop).value(way), 1e-9 * (1.0 + c->cost));
    EXPECT_EQ(contracted_quadric(mesh, metric, *c), mesh.quadric(boundary));
    ++seen;
  });
  EXPECT_GT(seen, 100);
}

TEST(Sec533Case3, TheHigherOrderStaysAndEqualsMeetAtTheOptimum) {
  int unequal = 0, equal = 0;
  each_random_edge(714, [&](const TetMesh& mesh, const Metric& metric, auto p, auto q) {
    if (is_inner(mesh, p) || is_inner(mesh, q) || mesh.planes(p) != mesh.planes(q)) return;
    const auto c = plan_contraction(mesh, metric, p, q);
    ASSERT_TRUE(c.has_value());
    if (mesh.order(p) == mesh.order(q)) {
      expect_optimum(mesh, metric, *c);
      ++equal;
      return;
    }
    EXPECT_EQ(c->keep, mesh.order(p) > mesh.order(q) ? p : q);
    EXPECT_FALSE(c->moves);
    EXPECT_EQ(c->position, mesh.position(c->keep));
    EXPECT_NEAR(c->cost, joint_error(mesh, metric, p, q, c->position), 1e-9 * (1.0 + c->cost));
    ++unequal;
  });
  EXPECT_GT(equal, 100);
  EXPECT_GT(unequal, 100);
}

TEST(Sec533Box, VerticesKeepToTheirPlanes) {
  int refused = 0, allowed = 0;
  each_random_edge(715, [&](const TetMesh& mesh, const Metric& metric, auto p, auto q) {
    const unsigned planes_p = mesh.planes(p), planes_q = mesh.planes(q);
    if (planes_p == planes_q) return;
    const auto c = plan_contraction(mesh, metric, p, q);
    const bool comparable = includes(planes_p, planes_q) || includes(planes_q, planes_p);
    const LocalVertex on_more = includes(planes_p, planes_q) ? p : q;
    const LocalVertex on_less = on_more == p ? q : p;
    // The end on more planes must survive; it cannot when the other one is of higher order.
    const bool expected = comparable && mesh.order(on_more) >= mesh.order(on_less);
    ASSERT_EQ(c.has_value(), expected);
    (expected ? allowed : refused) += 1;
    if (!c) return;
    EXPECT_EQ(c->keep, on_more);
    EXPECT_FALSE(c->moves);
    EXPECT_EQ(c->position, mesh.position(on_more));
  });
  EXPECT_GT(refused, 100);
  EXPECT_GT(allowed, 100);
}

TEST(Sec52Quadrics, OfTheSurvivorAreTheSumOfBothButForCase2) {
  std::mt19937 random(716);
  each_random_edge(717, [&](const TetMesh& mesh, const Metric& metric, auto p, auto q) {
    const auto c = plan_contraction(mesh, metric, p, q);
    if (!c || is_inner(mesh, p) != is_inner(mesh, q)) return;
    const Quadric sum = contracted_quadric(mesh, metric, *c);
    Point x = c->position;
    x.x += static_cast<std::int32_t>(below(random, 2000));
    x.z -= static_cast<std::int32_t>(below(random, 2000));
    const double expected = joint_error(mesh, metric, p, q, x);
    EXPECT_NEAR(sum.value(metric.vector(c->position, x)), expected, 1e-9 * (1.0 + expected));
  });
}

double ratio(const TetMesh& mesh, const Metric& metric, const LocalTet& t) {
  return radius_ratio(mesh, metric, t);
}

/// By the list of tets: what changes, judged as the header says.
struct ExpectedShape {
  bool inverted = false;
  bool good = false;       ///< whether all filters pass, inversion aside
  bool too_close = false;  ///< to tell: ratios of one tet differ in the last bits with its order
};

ExpectedShape expected_shape(const TetMesh& mesh, const Metric& metric, const Contraction& c,
                             const SimplifyOptions& options) {
  ExpectedShape out;
  double present = 1.0, worst = 1.0, variance = 0.0;
  for (const LocalTet& t : mesh.tets()) {
    if (!has(t, c.keep) && !has(t, c.drop)) continue;
    present = std::min(present, ratio(mesh, metric, t));
    if (has(t, c.keep) && (has(t, c.drop) || !c.moves)) continue;
    std::array<Point, 4> x;
    for (std::size_t i = 0; i < 4; ++i) {
      const LocalVertex v = t.vertices[i];
      x[i] = v == c.keep || v == c.drop ? c.position : mesh.position(v);
    }
    out.inverted |= volume6(x[0], x[1], x[2], x[3]) <= 0;
    const TetEdges edges = tet_edges(metric, x[0], x[1], x[2], x[3]);
    worst = std::min(worst, radius_ratio(edges));
    variance = std::max(variance, edge_length_variance(edges));
  }
  const bool inner = mesh.order(c.keep) == 1 || mesh.order(c.drop) == 1;
  const double asked =
      inner ? std::max(options.quality_floor, options.inner_quality) : options.quality_floor;
  const double floor = present < options.quality_floor ? present : asked;
  out.too_close =
      std::abs(worst - floor) < 1e-9 || std::abs(present - options.quality_floor) < 1e-9;
  out.good = worst >= floor && (!options.edge_variance || variance < *options.edge_variance);
  return out;
}

TEST(Sec54Filters, JudgeTheTetsThatChange) {
  std::map<StarVerdict, int> seen;
  std::mt19937 random(718);
  each_random_edge(719, [&](const TetMesh& mesh, const Metric& metric, auto p, auto q) {
    const auto c = plan_contraction(mesh, metric, p, q);
    if (!c) return;
    SimplifyOptions options{.quality_floor = 0.1 * below(random, 5),
                            .inner_quality = 0.1 * below(random, 5)};
    if (below(random, 2) == 0) options.edge_variance = 0.1;
    const StarVerdict verdict = ShapeFilter(mesh, metric, options).judge(*c);
    const ExpectedShape expected = expected_shape(mesh, metric, *c, options);
    // What is inverted may be found badly shaped first.
    if (expected.inverted) {
      ASSERT_NE(verdict, StarVerdict::kGood);
    } else if (!expected.too_close) {
      ASSERT_EQ(verdict, expected.good ? StarVerdict::kGood : StarVerdict::kLowQuality);
    }
    ++seen[verdict];
  });
  EXPECT_GT(seen[StarVerdict::kGood], 200);
  EXPECT_GT(seen[StarVerdict::kInverted], 200);
  EXPECT_GT(seen[StarVerdict::kLowQuality], 200);
}

/// The filter remembers where bad tets were; after any contractions it accepts what a new one
/// accepts.  (Of several faults it may name another.)
TEST(Sec54Filters, JudgeAlikeAfterContractions) {
  std::mt19937 random(720);
  int contracted = 0, below_floor = 0;
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const Metric metric = i % 2 == 0 ? Metric({1.0, 1.0, 5.0}) : Metric();
    TetMesh mesh = dense_mesh(random_volume(random));
    disturb(mesh, random);
    const SimplifyOptions options{.quality_floor = 0.3, .inner_quality = 0.4};
    ShapeFilter filter(mesh, metric, options);
    LinkCondition topology(mesh);
    StarBatch star;
    for (int k = 0; k < 100; ++k) {
      const auto [p, q] = random_edge(mesh, random);
      if (p == q) continue;
      const auto c = plan_contraction(mesh, metric, p, q);
      if (!c) continue;
      const StarVerdict verdict = filter.judge(*c);
      const StarVerdict fresh = ShapeFilter(mesh, metric, options).judge(*c);
      ASSERT_EQ(verdict == StarVerdict::kGood, fresh == StarVerdict::kGood);
      if (verdict != StarVerdict::kGood || !topology.keeps_topology(mesh, c->keep, c->drop))
        continue;
      star.collect(mesh, metric, c->drop);
      below_floor += star.shape_at(Vec3::Zero()).worst < options.quality_floor ? 1 : 0;
      mesh.contract(c->keep, c->drop, c->position, contracted_quadric(mesh, metric, *c));
      ++contracted;
    }
  }
  EXPECT_GT(contracted, 200);
  EXPECT_GT(below_floor, 50);
}

}  // namespace
}  // namespace mw::test
