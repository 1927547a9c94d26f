// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts of tets of every shape: what they fill, how they meet, and how bad the worst one is.
#include "kernels/quality/halved_tet.h"

#include "kernels/core/lattice.h"
#include "kernels/core/tet_nodes.h"
#include "kernels/quality/quality.h"
#include "tests/testing.h"

namespace mw {
namespace {

using Corners = std::array<Vec3, 4>;

double ratio_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return radius_ratio({b - a, c - a, d - a});
}

/// A positive tet, flat or thin at times.
Corners random_tet(std::mt19937& random) {
  std::normal_distribution<double> normal;
  for (;;) {
    const Vec3 scale(std::exp(normal(random)), std::exp(normal(random)), std::exp(normal(random)));
    Corners out;
    for (Vec3& corner : out) {
      for (int k = 0; k < 3; ++k) corner[k] = scale[k] * normal(random);
    }
    if (ratio_of(out[0], out[1], out[2], out[3]) > 0.01) return out;
  }
}

std::array<Vec3, 10> nodes_of(const Corners& corners) {
  std::array<Vec3, 10> out;
  std::copy(corners.begin(), corners.end(), out.begin());
  for (std::size_t e = 0; e < 6; ++e) {
    out[4 + e] = (corners[kTetEdges[e][0]] + corners[kTetEdges[e][1]]) / 2;
  }
  return out;
}

/// Nodes of the lattice with even coordinates, so that middles are of it, too.
std::array<Point, 10> lattice_nodes(std::mt19937& random) {
  std::uniform_int_distribution<std::int32_t> coordinate(-500, 500);
  std::array<Point, 10> out;
  do {
    for (std::size_t i = 0; i < 4; ++i) {
      out[i] = {2 * coordinate(random), 2 * coordinate(random), 2 * coordinate(random)};
    }
  } while (volume6(out[0], out[1], out[2], out[3]) <= 0);
  for (std::size_t e = 0; e < 6; ++e) {
    const Point &a = out[kTetEdges[e][0]], &b = out[kTetEdges[e][1]];
    out[4 + e] = {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
  }
  return out;
}

using Triangle = std::set<std::size_t>;

TEST(HalvedTet, PartsArePositiveFillTheTetAndFitFaceToFace) {
  std::mt19937 random(2411);
  std::set<std::set<std::size_t>> diagonals;
  for (int trial = 0; trial < 500; ++trial) {
    const std::array<Point, 10> nodes = lattice_nodes(random);
    std::array<Vec3, 10> places;
    for (std::size_t i = 0; i < 10; ++i) places[i] = Vec3(nodes[i].x, nodes[i].y, nodes[i].z);
    std::map<Triangle, int> uses;
    Int128 sum = 0;
    for (const auto& part : halved_tet(places)) {
      const Int128 volume = volume6(nodes[part[0]], nodes[part[1]], nodes[part[2]], nodes[part[3]]);
      EXPECT_GT(volume, 0);
      sum += volume;
      for (std::size_t i = 0; i < 4; ++i) {
        Triangle face(part.begin(), part.end());
        face.erase(part[i]);
        ++uses[face];
      }
    }
    EXPECT_EQ(sum, volume6(nodes[0], nodes[1], nodes[2], nodes[3]));
    // Each face of the tet is cut into the three at its corners and the one between its middles.
    std::set<Triangle> outer;
    for (const auto& [face, count] : uses) {
      EXPECT_LE(count, 2);
      if (count == 1) outer.insert(face);
    }
    std::set<Triangle> wanted;
    const auto middle = [](std::size_t a, std::size_t b) {
      for (std::size_t e = 0; e < 6; ++e) {
        if (kTetEdges[e] == std::array{a, b} || kTetEdges[e] == std::array{b, a}) return 4 + e;
      }
      return std::size_t{0};
    };
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      const std::size_t a = (opposite + 1) % 4, b = (opposite + 2) % 4, c = (opposite + 3) % 4;
      const std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      wanted.insert({{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    EXPECT_EQ(outer, wanted);
  }
}

TEST(HalvedTet, TheDiagonalIsTheBestOfThree) {
  // The rings around the diagonals from the middle of 0 a to that of b c.
  constexpr std::array<std::array<std::size_t, 3>, 3> kOthers{{{1, 2, 3}, {2, 3, 1}, {3, 1, 2}}};
  std::mt19937 random(2412);
  std::array<int, 3> chosen{};
  for (int trial = 0; trial < 2000; ++trial) {
    const Corners t = random_tet(random);
    const auto between = [&](std::size_t i, std::size_t j) -> Vec3 { return (t[i] + t[j]) / 2; };
    std::array<double, 3> worst{};
    for (std::size_t d = 0; d < 3; ++d) {
      const auto [a, b, c] = kOthers[d];
      const Vec3 from = between(0, a), to = between(b, c);
      const std::array<Vec3, 4> ring{between(0, b), between(a, b), between(a, c), between(0, c)};
      worst[d] = 1;
      for (std::size_t i = 0; i < 4; ++i) {
        const double ratio = ratio_of(from, to, ring[i], ring[(i + 1) % 4]);
        const double other = ratio_of(from, to, ring[(i + 1) % 4], ring[i]);
        worst[d] = std::min(worst[d], std::max(ratio, other));
      }
    }
    const std::array<Vec3, 10> nodes = nodes_of(t);
    double found = 1, corner = 1;
    for (const auto& p : halved_tet(nodes)) {
      const double ratio = ratio_of(nodes[p[0]], nodes[p[1]], nodes[p[2]], nodes[p[3]]);
      const bool has_corner = std::any_of(p.begin(), p.end(), [](std::size_t n) { return n < 4; });
      double& least = has_corner ? corner : found;
      least = std::min(least, ratio);
    }
    const auto best = std::max_element(worst.begin(), worst.end());
    EXPECT_NEAR(found, *best, 1e-9);
    EXPECT_NEAR(corner, ratio_of(t[0], t[1], t[2], t[3]), 1e-9);
    ++chosen[static_cast<std::size_t>(best - worst.begin())];
  }
  for (const int count : chosen) EXPECT_GT(count, 200);
}

/// The worst parts of tets that are no worse than a floor, by many small steps downhill.
double worst_part(double floor, std::mt19937& random) {
  const auto value = [&](const Corners& t) {
    if (ratio_of(t[0], t[1], t[2], t[3]) < floor) return 1.0;
    const std::array<Vec3, 10> nodes = nodes_of(t);
    double least = 1;
    for (const auto& p : halved_tet(nodes)) {
      least = std::min(least, ratio_of(nodes[p[0]], nodes[p[1]], nodes[p[2]], nodes[p[3]]));
    }
    return least;
  };
  std::normal_distribution<double> normal;
  double worst = 1;
  for (int start = 0; start < 6; ++start) {
    Corners best = random_tet(random);
    for (int trial = 0; trial < 2000; ++trial) {
      const Corners t = random_tet(random);
      if (value(t) < value(best)) best = t;
    }
    double size = 0.3, least = value(best);
    for (int step = 0; step < 4000; ++step) {
      if (step % 300 == 299) size *= 0.7;
      Corners t = best;
      for (Vec3& corner : t) {
        for (int k = 0; k < 3; ++k) corner[k] += size * (t[0] - t[1]).norm() * normal(random);
      }
      const double next = value(t);
      if (next >= least) continue;
      least = next;
      best = t;
    }
    worst = std::min(worst, least);
  }
  return worst;
}

TEST(HalvedTet, NoPartIsBelowTheFloorThatIsTold) {
  std::mt19937 random(2413);
  for (const double floor : {0.05, 0.2, 0.3, 0.4, 0.5}) {
    const double worst = worst_part(floor, random);
    EXPECT_GE(worst, halved_floor(floor)) << floor;
    EXPECT_LT(worst, 2.6 * floor * floor + 0.1) << floor;  // the search finds bad ones
  }
}

TEST(HalvedTet, TheFloorOfPartsFollowsThatOfTets) {
  EXPECT_EQ(halved_floor(0.0), 0.0);
  for (const double tiny : {1e-100, 1e-153, 1e-155, 1e-200, 5e-324}) {
    EXPECT_GE(halved_floor(tiny), 0.0) << tiny;
    EXPECT_LE(halved_floor(tiny), tiny) << tiny;
  }
  EXPECT_DOUBLE_EQ(halved_floor(0.2), 0.072);
  EXPECT_DOUBLE_EQ(halved_floor(0.2, 2), 0.00933);
  EXPECT_EQ(halved_floor(0.2, 0), 0.2);
  double last = 0;
  for (double floor = 0.01; floor < 0.6; floor += 0.01) {
    EXPECT_GE(halved_floor(floor), last);
    EXPECT_LE(halved_floor(floor), floor);
    last = halved_floor(floor);
  }
}

}  // namespace
}  // namespace mw
