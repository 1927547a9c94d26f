// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Jacobians of curved tets, in the kernel and in the audit, against what interpolation finds; swept
// volumes against the volumes of many small flat triangles.
#include "kernels/curve/quadratic.h"

#include <Eigen/Dense>

#include "kernels/audit/shape/curved.h"
#include "kernels/core/tet_nodes.h"
#include "tests/testing.h"

namespace mw::test {
namespace {

using Barycentric = std::array<double, 4>;

double number_of(std::mt19937& random) {
  return static_cast<double>(random()) / 2147483648.0 - 1.0;
}

/// A tet whose corners are off those of a regular one by up to 0.3, edges by up to `curve`.
QuadraticTet random_tet(std::mt19937& random, double curve) {
  QuadraticTet out;
  const auto off = [&](double size) {
    const double x = number_of(random), y = number_of(random), z = number_of(random);
    return Vec3(size * Vec3(x, y, z));
  };
  out[0] = Vec3(-1, -1, -1) + off(0.3);
  out[1] = Vec3(1, 1, -1) + off(0.3);
  out[2] = Vec3(-1, 1, 1) + off(0.3);
  out[3] = Vec3(1, -1, 1) + off(0.3);
  if ((out[1] - out[0]).cross(out[2] - out[0]).dot(out[3] - out[0]) < 0) std::swap(out[2], out[3]);
  for (std::size_t e = 0; e < 6; ++e) {
    out[4 + e] = 0.5 * (out[kTetEdges[e][0]] + out[kTetEdges[e][1]]) + off(curve);
  }
  return out;
}

Vec3 place_in(const QuadraticTet& t, const Barycentric& l) {
  Vec3 out = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) out += l[i] * (2 * l[i] - 1) * t[i];
  for (std::size_t e = 0; e < 6; ++e) out += 4 * l[kTetEdges[e][0]] * l[kTetEdges[e][1]] * t[4 + e];
  return out;
}

/// By central differences, which are exact for polynomials of degree 2 except for rounding.
double jacobian_at(const QuadraticTet& t, const Barycentric& l) {
  constexpr double kStep = 1e-2;
  Eigen::Matrix3d slopes;
  for (std::size_t k = 1; k < 4; ++k) {
    Barycentric ahead = l, behind = l;
    ahead[k] += kStep, ahead[0] -= kStep, behind[k] -= kStep, behind[0] += kStep;
    slopes.col(static_cast<int>(k) - 1) = (place_in(t, ahead) - place_in(t, behind)) / (2 * kStep);
  }
  return slopes.determinant();
}

/// The twenty points whose coordinates are thirds, with how often each third occurs.
std::vector<std::array<int, 4>> thirds() {
  std::vector<std::array<int, 4>> out;
  for (int a = 0; a <= 3; ++a) {
    for (int b = 0; a + b <= 3; ++b) {
      for (int c = 0; a + b + c <= 3; ++c) out.push_back({a, b, c, 3 - a - b - c});
    }
  }
  return out;
}

/// Bernstein coefficients from the values at twenty points.
Eigen::VectorXd coefficients(const QuadraticTet& t) {
  const auto points = thirds();
  Eigen::MatrixXd polynomials(20, 20);
  Eigen::VectorXd values(20);
  constexpr std::array<double, 4> kFactorials{1, 1, 2, 6};
  for (int row = 0; row < 20; ++row) {
    Barycentric l{};
    for (std::size_t i = 0; i < 4; ++i) l[i] = points[static_cast<std::size_t>(row)][i] / 3.0;
    values[row] = jacobian_at(t, l);
    for (int column = 0; column < 20; ++column) {
      double value = 6;
      for (std::size_t i = 0; i < 4; ++i) {
        const int power = points[static_cast<std::size_t>(column)][i];
        value *= std::pow(l[i], power) / kFactorials[static_cast<std::size_t>(power)];
      }
      polynomials(row, column) = value;
    }
  }
  return polynomials.fullPivLu().solve(values);
}

audit::TenNodes positions_of(const QuadraticTet& t) {
  audit::TenNodes out;
  for (std::size_t i = 0; i < t.size(); ++i) out[i] = {t[i][0], t[i][1], t[i][2]};
  return out;
}

TEST(QuadraticTet, LeastCoefficientOfTheJacobian) {
  std::mt19937 random(1);
  int turned = 0;
  for (int round = 0; round < 300; ++round) {
    const QuadraticTet tet = random_tet(random, 0.025 * (round % 25));
    const double expected = coefficients(tet).minCoeff();
    EXPECT_NEAR(least_jacobian(tet), expected, 1e-9);
    const double straight = (tet[1] - tet[0]).cross(tet[2] - tet[0]).dot(tet[3] - tet[0]);
    const double share = audit::jacobian_share(positions_of(tet));
    EXPECT_NEAR(share, expected / straight, 1e-9);
    EXPECT_LE(share, expected / straight + 1e-13);
    turned += expected <= 0 ? 1 : 0;
    for (int i = 0; i < 20; ++i) {
      Barycentric l{};
      double sum = 0;
      for (double& x : l) sum += x = number_of(random) + 1;
      for (double& x : l) x /= sum;
      EXPECT_GE(jacobian_at(tet, l), expected - 1e-9);
    }
  }
  EXPECT_GT(turned, 30);
  EXPECT_LT(turned, 270);
}

TEST(QuadraticTet, StraightOnesAreTheirVolume) {
  std::mt19937 random(2);
  for (int round = 0; round < 20; ++round) {
    const QuadraticTet tet = random_tet(random, 0);
    const double straight = (tet[1] - tet[0]).cross(tet[2] - tet[0]).dot(tet[3] - tet[0]);
    EXPECT_NEAR(least_jacobian(tet), straight, 1e-12);
    EXPECT_NEAR(least_part(tet), straight / 8, 1e-12);
    EXPECT_NEAR(audit::jacobian_share(positions_of(tet)), 1, 1e-10);
    EXPECT_NEAR(audit::volume_beyond_parts(positions_of(tet)), 0, 1e-12);
  }
}

TEST(QuadraticTet, VolumeIsTheMeanOfTheCoefficients) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    const QuadraticTet tet = random_tet(random, 0.2);
    double parts = 0;
    for (const auto& part : kTetParts) {
      const Vec3& at = tet[part[0]];
      parts += std::abs((tet[part[1]] - at).cross(tet[part[2]] - at).dot(tet[part[3]] - at)) / 6;
    }
    EXPECT_NEAR(audit::volume_beyond_parts(positions_of(tet)), coefficients(tet).mean() / 6 - parts,
                1e-9);
  }
}

TEST(QuadraticTet, PartsShareTheirTrianglesWithNeighbours) {
  // Each triangle of the tet is cut into the triangle between its middles and three at its corners.
  std::map<std::set<std::size_t>, int> uses;
  for (const auto& part : kTetParts) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::set<std::size_t> triangle(part.begin(), part.end());
      triangle.erase(part[left_out]);
      ++uses[triangle];
    }
  }
  std::set<std::set<std::size_t>> outer;
  for (const auto& [triangle, count] : uses) {
    EXPECT_LE(count, 2);
    if (count == 1) outer.insert(triangle);
  }
  EXPECT_EQ(outer.size(), 16U);
  const auto middle = [](std::size_t a, std::size_t b) {
    for (std::size_t e = 0; e < 6; ++e) {
      if (std::set{kTetEdges[e][0], kTetEdges[e][1]} == std::set{a, b}) return 4 + e;
    }
    return std::size_t{0};
  };
  for (const std::array<std::size_t, 3>& c :
       {std::array<std::size_t, 3>{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}) {
    const std::size_t ab = middle(c[0], c[1]), bc = middle(c[1], c[2]), ca = middle(c[2], c[0]);
    for (const std::set<std::size_t>& triangle :
         {std::set{ab, bc, ca}, {c[0], ab, ca}, {c[1], ab, bc}, {c[2], bc, ca}}) {
      EXPECT_TRUE(outer.contains(triangle));
    }
  }
}

TEST(CurvedTets, AMirroredOneIsTheSame) {
  std::mt19937 random(4);
  for (int round = 0; round < 20; ++round) {
    const QuadraticTet tet = random_tet(random, 0.2);
    audit::TenNodes reflected = positions_of(tet);
    for (audit::Position& p : reflected) p[0] = -p[0];
    EXPECT_NEAR(audit::jacobian_share(audit::mirrored(reflected)),
                audit::jacobian_share(positions_of(tet)), 1e-12);
    EXPECT_LE(audit::jacobian_share(reflected), 0);
  }
}

TEST(CurvedTets, WhatIsTurnedOverIsNamed) {
  std::mt19937 random(5);
  audit::CurvedMeter meter;
  meter.add(7, positions_of(random_tet(random, 0)));
  EXPECT_TRUE(meter.jacobians().passed);
  QuadraticTet bad = random_tet(random, 0);
  bad[4] = bad[3];  // an edge that goes by the opposite corner
  meter.add(8, positions_of(bad));
  EXPECT_FALSE(meter.jacobians().passed);
  EXPECT_NE(meter.jacobians().detail.find("(8)"), std::string::npos) << meter.jacobians().detail;
}

double number(std::mt19937& random) {
  return static_cast<double>(random()) / 2147483648.0 - 1.0;
}

Vec3 point(std::mt19937& random, double size) {
  const double x = number(random), y = number(random), z = number(random);
  return size * Vec3(x, y, z);
}

/// An octahedron whose nodes are off by up to `noise`, edges by as much more.
std::vector<QuadraticTriangle> octahedron(std::mt19937& random, double noise) {
  std::array<Vec3, 6> corners;  // along -x, x, -y, y, -z, z
  for (int i = 0; i < 6; ++i) {
    corners[static_cast<std::size_t>(i)] = Vec3::Unit(i / 2) * (i % 2 == 0 ? -1.0 : 1.0);
  }
  for (Vec3& corner : corners) corner += point(random, noise);
  std::map<std::set<std::size_t>, Vec3> middles;
  const auto middle = [&](std::size_t a, std::size_t b) {
    const auto [at, is_new] = middles.try_emplace({a, b}, 0.5 * (corners[a] + corners[b]));
    if (is_new) at->second += point(random, noise);
    return at->second;
  };
  std::vector<QuadraticTriangle> out;
  for (std::size_t octant = 0; octant < 8; ++octant) {
    std::array<std::size_t, 3> c{octant & 1, 2 + (octant >> 1 & 1), 4 + (octant >> 2 & 1)};
    if (std::popcount(octant) % 2 == 0) std::swap(c[1], c[2]);  // outwards
    out.push_back({corners[c[0]], corners[c[1]], corners[c[2]], middle(c[0], c[1]),
                   middle(c[1], c[2]), middle(c[2], c[0])});
  }
  return out;
}

Vec3 on(const QuadraticTriangle& t, double u, double v) {
  const double w = 1 - u - v;
  return w * (2 * w - 1) * t[0] + u * (2 * u - 1) * t[1] + v * (2 * v - 1) * t[2] +
         4 * w * u * t[3] + 4 * u * v * t[4] + 4 * v * w * t[5];
}

/// The volume inside, by `steps` flat triangles along each edge.
double volume(const std::vector<QuadraticTriangle>& surface, int steps) {
  double sum = 0;
  for (const QuadraticTriangle& t : surface) {
    const auto at = [&](int i, int j) {
      return on(t, static_cast<double>(i) / steps, static_cast<double>(j) / steps);
    };
    for (int i = 0; i < steps; ++i) {
      for (int j = 0; i + j < steps; ++j) {
        sum += at(i, j).dot(at(i + 1, j).cross(at(i, j + 1))) / 6;
        if (i + j + 1 == steps) continue;
        sum += at(i + 1, j).dot(at(i + 1, j + 1).cross(at(i, j + 1))) / 6;
      }
    }
  }
  return sum;
}

using Surface = std::vector<QuadraticTriangle>;

double sum_swept(const Surface& from, const Surface& to, decltype(swept_volumes) swept) {
  double sum = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    for (const double part : swept(from[i], to[i])) sum += part;
  }
  return sum;
}

TEST(SweptVolumes, OfAClosedSurfaceAreTheDifferenceOfVolumes) {
  std::mt19937 random(1);
  for (int round = 0; round < 30; ++round) {
    const auto from = octahedron(random, 0.1), to = octahedron(random, 0.3);
    // The error of flat triangles falls with the square of the steps.
    const auto limit = [](const auto& surface) {
      return (4 * volume(surface, 32) - volume(surface, 16)) / 3;
    };
    EXPECT_NEAR(sum_swept(from, to, swept_volumes), limit(to) - limit(from), 1e-5) << round;
  }
}

TEST(SweptVolumes, OfStraightPartsAreTheDifferenceOfVolumes) {
  std::mt19937 random(2);
  for (int round = 0; round < 30; ++round) {
    const auto from = octahedron(random, 0.1), to = octahedron(random, 0.3);
    // Two steps along each edge give the straight parts.
    EXPECT_NEAR(sum_swept(from, to, swept_part_volumes), volume(to, 2) - volume(from, 2), 1e-12)
        << round;
  }
}

TEST(SweptVolumes, AreWeightedByHats) {
  const QuadraticTriangle flat{Vec3(0, 0, 0), Vec3(2, 0, 0),   Vec3(0, 3, 0),
                               Vec3(1, 0, 0), Vec3(1, 1.5, 0), Vec3(0, 1.5, 0)};
  QuadraticTriangle lifted = flat;
  for (Vec3& node : lifted) node[2] = 0.5;
  for (const double part : swept_volumes(flat, lifted)) EXPECT_NEAR(part, 3 * 0.5 / 3, 1e-14);
  // The middle of edge 0 1 alone: the integrals of 4 l0 l1 times each hat are 2/15 and 1/15 areas.
  QuadraticTriangle bulged = flat;
  bulged[3][2] = -1;
  const auto parts = swept_volumes(flat, bulged);
  EXPECT_NEAR(parts[0], -3 * 2.0 / 15, 1e-14);
  EXPECT_NEAR(parts[1], -3 * 2.0 / 15, 1e-14);
  EXPECT_NEAR(parts[2], -3 * 1.0 / 15, 1e-14);
  // Three straight parts of four are at that middle, which lies between the corners 0 and 1; each
  // has a third of a quarter of the area there.
  const auto straight = swept_part_volumes(flat, bulged);
  EXPECT_NEAR(straight[0] + straight[1] + straight[2], -3 * 0.25, 1e-14);
  EXPECT_NEAR(straight[0], straight[1], 1e-14);
  EXPECT_LT(std::abs(straight[2]), std::abs(straight[0]));
}

}  // namespace
}  // namespace mw::test
