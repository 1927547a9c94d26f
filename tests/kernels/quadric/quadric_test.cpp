// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Eq (1) and (2): quadrics against explicit sums of squared distances.
#include "kernels/quadric/quadric.h"
#include "tests/testing.h"

namespace mw::test {
namespace {

/// In [-1, 1), the same with every standard library.
double real(std::mt19937& random) {
  return static_cast<double>(random()) / 2147483648.0 - 1.0;
}

Vec3 vector(std::mt19937& random) {
  const double x = real(random), y = real(random), z = real(random);
  return {x, y, z};
}

/// A squared distance to a point, or to the plane through it across an axis.
struct Term {
  Vec3 at;
  int axis = -1;  ///< -1: point
  double weight = 1.0;

  [[nodiscard]] double value(const Vec3& x) const {
    return weight * (axis < 0 ? (x - at).squaredNorm() : std::pow(x[axis] - at[axis], 2));
  }
};

/// A quadric of an owner at some place, and the terms that it stands for.
struct Sum {
  Vec3 owner;
  Quadric quadric;
  std::vector<Term> terms;

  [[nodiscard]] double expected(const Vec3& x) const {
    double sum = 0.0;
    for (const Term& t : terms) sum += t.value(x);
    return sum;
  }
};

Sum at_vertex(std::mt19937& random) {
  Sum out{4.0 * vector(random), {}, {}};
  for (auto planes = random() % 5; planes > 0; --planes) {
    const int axis = static_cast<int>(random() % 3);
    const double weight = 1.0 + real(random);
    out.quadric.add_axis_plane(axis, weight);
    out.terms.push_back({out.owner, axis, weight});
  }
  const double weight = 1.25 + real(random);
  out.quadric.add_point(weight);
  out.terms.push_back({out.owner, -1, weight});
  return out;
}

/// What becomes of two vertices that are contracted to a third place.
Sum merged(const Sum& p, const Sum& q, const Vec3& position) {
  Sum out{position, p.quadric.shifted(position - p.owner) + q.quadric.shifted(position - q.owner),
          p.terms};
  out.terms.insert(out.terms.end(), q.terms.begin(), q.terms.end());
  return out;
}

Sum random_sum(std::mt19937& random) {
  Sum sum = at_vertex(random);
  for (auto merges = random() % 12; merges > 0; --merges) {
    const Sum other = at_vertex(random);
    sum = merged(sum, other, 4.0 * vector(random));
  }
  return sum;
}

TEST(Sec52Quadrics, EqualSumsOfSquaredDistancesThroughAllMerges) {
  std::mt19937 random(601);
  for (int i = 0; i < 500; ++i) {
    const Sum sum = random_sum(random);
    for (int k = 0; k < 10; ++k) {
      const Vec3 x = 5.0 * vector(random);
      const double expected = sum.expected(x);
      ASSERT_NEAR(sum.quadric.value(x - sum.owner), expected, 1e-11 * (1.0 + expected));
    }
    EXPECT_NEAR(sum.quadric.c, sum.expected(sum.owner), 1e-10 * (1.0 + sum.quadric.c));
  }
}

TEST(Sec52Quadrics, TraceCountsPlanesOnceAndPointsThrice) {
  std::mt19937 random(602);
  for (int i = 0; i < 100; ++i) {
    const Sum sum = random_sum(random);
    double expected = 0.0;
    for (const Term& t : sum.terms) expected += (t.axis < 0 ? 3.0 : 1.0) * t.weight;
    EXPECT_NEAR(sum.quadric.trace(), expected, 1e-12 * expected);
  }
}

TEST(Sec52Quadrics, MinimumBeatsEveryPerturbationOfTheFreeAxes) {
  std::mt19937 random(603);
  for (int i = 0; i < 500; ++i) {
    const Sum sum = random_sum(random);
    const unsigned fixed = static_cast<unsigned>(random() % 8);
    const QuadricMinimum best = minimum(sum.quadric, fixed);
    const double expected = sum.expected(sum.owner + best.offset);
    ASSERT_NEAR(best.value, expected, 1e-10 * (1.0 + expected));
    for (int k = 0; k < 20; ++k) {
      Vec3 step = vector(random) * (k % 2 == 0 ? 1.0 : 1e-3);
      for (int axis = 0; axis < 3; ++axis) {
        if ((fixed >> axis & 1U) == 0) continue;
        ASSERT_EQ(best.offset[axis], 0.0);
        step[axis] = 0.0;
      }
      ASSERT_GE(sum.expected(sum.owner + best.offset + step), expected - 1e-10 * (1.0 + expected));
    }
  }
}

}  // namespace
}  // namespace mw::test
