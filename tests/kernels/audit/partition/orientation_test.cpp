// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Exact orientation on nearly flat tets, against rational arithmetic.
#include <boost/multiprecision/cpp_int.hpp>

#include "kernels/audit/partition/orientation.h"
#include "tests/kernels/audit/topology/mesh_parts_by_owner.h"
#include "tests/oracle/small_volumes.h"
#include "tests/testing.h"

namespace mw::audit {
namespace {

using boost::multiprecision::cpp_rational;
using namespace test;

int rational_orientation(const std::array<Position, 4>& p) {
  std::array<std::array<cpp_rational, 3>, 3> r;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) r[i][k] = cpp_rational(p[i + 1][k]) - cpp_rational(p[0][k]);
  }
  const cpp_rational det = r[0][0] * r[1][1] * r[2][2] + r[0][1] * r[1][2] * r[2][0] +
                           r[0][2] * r[1][0] * r[2][1] - r[0][2] * r[1][1] * r[2][0] -
                           r[0][0] * r[1][2] * r[2][1] - r[0][1] * r[1][0] * r[2][2];
  return det.sign();
}

void expect_exact(const std::array<Position, 4>& p) {
  const int expected = rational_orientation(p);
  EXPECT_EQ(orientation(p[0], p[1], p[2], p[3]), expected);
  EXPECT_EQ(exact_orientation(p[0], p[1], p[2], p[3]), expected);
  EXPECT_EQ(filtered_orientation(p[0], p[1], p[2], p[3]).value_or(expected), expected);
  EXPECT_EQ(orientation(p[1], p[0], p[2], p[3]), -expected);
}

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Four points of one plane up to rounding, the last one moved by a few units in the last place.
std::array<Position, 4> nearly_flat(std::mt19937_64& random) {
  std::array<Position, 4> p{};
  const double shift = std::ldexp(1, static_cast<int>(random() % 30)) - 1;
  for (std::size_t i = 0; i < 3; ++i) {
    for (double& x : p[i]) x = uniform(random) + shift;
  }
  const double s = uniform(random), t = uniform(random);
  for (std::size_t k = 0; k < 3; ++k) {
    p[3][k] = p[0][k] + s * (p[1][k] - p[0][k]) + t * (p[2][k] - p[0][k]);
    const double towards = random() % 2 == 0 ? 1e9 : -1e9;
    for (auto steps = random() % 3; steps > 0; --steps) p[3][k] = std::nextafter(p[3][k], towards);
  }
  return p;
}

TEST(Orientation, IsExactOnNearlyFlatTets) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 20000; ++trial) expect_exact(nearly_flat(random));
}

TEST(Orientation, IsExactOnFlatLatticeTets) {
  std::mt19937_64 random(6);
  int flat = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::array<Position, 4> p{};
    for (Position& point : p) {
      for (double& x : point) x = 0.703125 * static_cast<double>(random() % 4);
    }
    expect_exact(p);
    flat += rational_orientation(p) == 0 ? 1 : 0;
  }
  EXPECT_GT(flat, 1000);
}

TEST(Orientation, IsExactAtTheEndsOfTheRangeOfDouble) {
  std::mt19937_64 random(7);
  const std::array<double, 8> scales{1e-308, 5e-324, 1e-200, 1e-120, 1, 1e90, 1e150, 1e300};
  for (int trial = 0; trial < 5000; ++trial) {
    std::array<Position, 4> p{};
    for (Position& point : p) {
      for (double& x : point) x = (uniform(random) - 0.5) * scales[random() % scales.size()];
    }
    expect_exact(p);
  }
}

TEST(Orientation, PositiveIsVtkPositive) {
  EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orientation({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}), -1);
  EXPECT_EQ(exact_orientation({0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}), 0);
}

using namespace test;

std::int64_t determinant(const std::vector<Position>& at, const TetRow& t) {
  std::array<std::array<std::int64_t, 3>, 3> r{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      r[i][k] = static_cast<std::int64_t>(at[t[i + 1]][k] - at[t[0]][k]);
    }
  }
  return r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
         r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
         r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
}

int sign(std::int64_t value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// A mesh whose vertices were moved by up to two voxels of four units: some tets are flat or turned
/// over already.
SmallMesh shaken_mesh(std::mt19937& random) {
  SmallMesh mesh = five_tet_mesh(random_volume(random));
  for (Position& p : mesh.vertices) {
    for (double& x : p) x = 4 * x + below(random, 9) - 4.0;
  }
  return mesh;
}

/// Vertices in the world: x and y exchanged, which is a mirror, or turned by half; then rounded.
std::vector<Position> written_as(std::mt19937& random, const SmallMesh& mesh, bool mirrored) {
  std::vector<Position> out;
  for (const Position& p : mesh.vertices) {
    out.push_back(mirrored ? Position{p[1], p[0], p[2]} : Position{-p[0], -p[1], p[2]});
    if (below(random, 6) == 0) out.back()[below(random, 3)] += below(random, 5) - 2.0;
  }
  return out;
}

/// The tets, by number, that are not as positive in the world as in the array.
std::set<std::uint64_t> changed(const SmallMesh& mesh, const std::vector<Position>& written,
                                bool mirrored) {
  std::set<std::uint64_t> out;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const int in_array = sign(determinant(mesh.vertices, mesh.tets[t]));
    const int in_world = sign(determinant(written, mesh.tets[t]));
    if (in_world != (mirrored ? -in_array : in_array)) out.insert(t);
  }
  return out;
}

TEST(KeptOrientation, CountsTetsOfAnotherSign) {
  std::mt19937 random(2301);
  std::size_t all = 0, sound = 0;
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    const SmallMesh mesh = shaken_mesh(random);
    const bool mirrored = i % 2 == 0;
    const std::vector<Position> written = written_as(random, mesh, mirrored);
    const auto expected = changed(mesh, written, mirrored);
    const Offenders found = changed_orientations({mesh.view(), {}, {}, {}}, written, mirrored);
    EXPECT_EQ(found.count(), expected.size());
    EXPECT_EQ(kept_orientation(found).passed, expected.empty());
    if (!expected.empty()) {
      const std::string first = "(" + std::to_string(*expected.begin());
      EXPECT_NE(kept_orientation(found).detail.find(first), std::string::npos) << found.text();
    }
    all += expected.size();
    sound += expected.empty() ? 1U : 0U;
  }
  EXPECT_GT(all, 1000U);
  EXPECT_GT(sound, 0U);
}

TEST(KeptOrientation, TilesCountEachTetOnce) {
  std::mt19937 random(2302);
  for (int i = 0; i < 100 && !HasFailure(); ++i) {
    const SmallMesh mesh = shaken_mesh(random);
    const std::vector<Position> written = written_as(random, mesh, false);
    std::vector<std::uint32_t> owner;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) owner.push_back(below(random, 3));
    Offenders found("tets");
    for (std::uint32_t tile = 0; tile < 3; ++tile) {
      const OwnedPart part = part_of_owner(mesh, owner, tile);
      std::vector<Position> rows;
      for (const std::uint64_t v : part.vertex_ids) rows.push_back(written[v]);
      found.add(changed_orientations(part.view(), rows, false));
    }
    EXPECT_EQ(found.count(), changed(mesh, written, false).size());
  }
}

TEST(KeptOrientation, LeavesPositionsThatAreNoNumbersToOtherChecks) {
  std::mt19937 random(2303);
  const SmallMesh mesh = shaken_mesh(random);
  std::vector<Position> written(mesh.vertices.size(), Position{0, 0, 0});
  EXPECT_GT(changed_orientations({mesh.view(), {}, {}, {}}, written, false).count(), 0U);
  written.back()[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(changed_orientations({mesh.view(), {}, {}, {}}, written, false).count(), 0U);
}

}  // namespace
}  // namespace mw::audit
