// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Surfaces of voxels and tori: what they keep, and how far they go.
#include "kernels/decimate/surface_decimator.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "kernels/core/index.h"
#include "tests/oracle/small_volumes.h"

namespace mw::test {
namespace {

using audit::test::below;
using audit::test::random_volume_of;
using audit::test::SmallVolume;
using audit::test::volume_from;
using audit::test::VolumeKind;
using Surface = SurfaceDecimator::Surface;
using Triangle = SurfaceDecimator::Triangle;

/// The faces between label 1 and the others, halved; normals point out of label 1.
Surface voxel_surface(const SmallVolume& volume) {
  Surface out;
  std::map<std::array<std::int64_t, 3>, std::uint32_t> rows;
  const auto row = [&](Index3 p) {
    const auto [found, is_new] =
        rows.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(out.vertices.size()));
    if (is_new) {
      out.vertices.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y),
                                static_cast<double>(p.z));
    }
    return found->second;
  };
  const auto is_one = [&](Index3 v) {
    return Box3{{0, 0, 0}, volume.shape}.contains(v) &&
           volume.labels[static_cast<std::size_t>(Box3{{0, 0, 0}, volume.shape}.offset(v))] == 1;
  };
  for_each_index(grown({{0, 0, 0}, volume.shape}, 1), [&](Index3 v) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const Index3 next = v + axis_vector(axis);
      if (is_one(v) == is_one(next)) continue;
      Index3 one = axis_vector((axis + 1) % 3), two = axis_vector((axis + 2) % 3);
      if (!is_one(v)) std::swap(one, two);
      const std::uint32_t a = row(next), b = row(next + one), c = row(next + one + two),
                          d = row(next + two);
      out.triangles.insert(out.triangles.end(), {{a, b, c}, {a, c, d}});
    }
  });
  return out;
}

Surface torus(std::uint32_t n) {
  Surface out;
  const auto row = [n](std::uint32_t i, std::uint32_t j) { return i % n * n + j % n; };
  const double step = 2 * std::numbers::pi / n;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const double a = step * i, b = step * j, r = 40 + 15 * std::cos(b);
      out.vertices.emplace_back(r * std::cos(a), r * std::sin(a), 15 * std::sin(b));
      out.triangles.push_back({row(i, j), row(i + 1, j), row(i + 1, j + 1)});
      out.triangles.push_back({row(i, j), row(i + 1, j + 1), row(i, j + 1)});
    }
  }
  return out;
}

struct Counts {
  std::int64_t euler = 0;
  std::size_t parts = 0;
  std::size_t odd_edges = 0;  ///< of another number of triangles than two
  bool is_closed = true;      ///< each edge is gone through as often one way as the other

  friend bool operator==(const Counts&, const Counts&) = default;
};

Counts counts_of(const Surface& s) {
  std::vector<std::size_t> parent(s.vertices.size());
  for (std::size_t v = 0; v < parent.size(); ++v) parent[v] = v;
  const auto root = [&](std::size_t v) {
    while (parent[v] != v) v = parent[v];
    return v;
  };
  std::map<std::array<std::uint32_t, 2>, std::array<int, 2>> edges;
  for (const Triangle& t : s.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      ++edges[{std::min(a, b), std::max(a, b)}][a < b ? 0 : 1];
      parent[root(a)] = root(b);
    }
  }
  Counts out;
  for (std::size_t v = 0; v < parent.size(); ++v) out.parts += parent[v] == v ? 1U : 0U;
  for (const auto& [ends, ways] : edges) {
    out.odd_edges += ways[0] + ways[1] == 2 ? 0U : 1U;
    out.is_closed = out.is_closed && ways[0] == ways[1];
  }
  out.euler = static_cast<std::int64_t>(s.vertices.size()) -
              static_cast<std::int64_t>(edges.size()) +
              static_cast<std::int64_t>(s.triangles.size());
  return out;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double length = (b - a).squaredNorm();
  const double at = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
  return (p - a - at * (b - a)).norm();
}

double distance_to(const Vec3& p, const Surface& s) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : s.triangles) {
    const Vec3 &a = s.vertices[t[0]], &b = s.vertices[t[1]], &c = s.vertices[t[2]];
    const Vec3 n = (b - a).cross(c - a);
    const auto is_left = [&](const Vec3& u, const Vec3& v) {
      return n.dot((v - u).cross(p - u)) >= 0;
    };
    if (is_left(a, b) && is_left(b, c) && is_left(c, a)) {
      least = std::min(least, std::abs(n.normalized().dot(p - a)));
    }
    least = std::min({least, distance_to_segment(p, a, b), distance_to_segment(p, b, c),
                      distance_to_segment(p, c, a)});
  }
  return least;
}

/// The largest distance of some points of a surface from the other one.
double farthest(const Surface& from, const Surface& to, std::mt19937& random) {
  double out = 0;
  for (int i = 0; i < 60; ++i) {
    const Triangle& t =
        from.triangles[below(random, static_cast<std::uint32_t>(from.triangles.size()))];
    double u = below(random, 101) / 100.0, v = below(random, 101) / 100.0;
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vec3 &a = from.vertices[t[0]], &b = from.vertices[t[1]], &c = from.vertices[t[2]];
    out = std::max(out, distance_to(a + u * (b - a) + v * (c - a), to));
  }
  return out;
}

TEST(SurfaceDecimator, KeepsTopologyAndDistanceOfVoxelSurfaces) {
  std::mt19937 random(641);
  std::size_t before = 0, after = 0, odd = 0;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    const Surface fine = voxel_surface(random_volume_of(random, kind, {7, 6, 8}, 2));
    if (fine.triangles.empty()) continue;
    SurfaceDecimator decimator(fine.vertices, fine.triangles);
    for (double bound = 0.5; bound < 5; bound *= 2) {
      decimator.decimate(bound);
      const Surface coarse = decimator.surface();
      ASSERT_EQ(coarse.triangles.size(), decimator.triangle_count());
      ASSERT_EQ(counts_of(coarse), counts_of(fine)) << i << " " << bound;
      EXPECT_LE(farthest(coarse, fine, random), bound + 1e-9);
      EXPECT_LE(farthest(fine, coarse, random), bound + 1e-9);
    }
    before += fine.triangles.size();
    after += decimator.triangle_count();
    odd += counts_of(fine).odd_edges;
  }
  EXPECT_GT(odd, 100U);
  EXPECT_LT(after, before);
}

/// At last a ring is left, however far points may be moved.
TEST(SurfaceDecimator, LeavesFewTrianglesAndNoGap) {
  const Surface fine = torus(60);
  SurfaceDecimator decimator(fine.vertices, fine.triangles);
  std::size_t last = fine.triangles.size();
  for (const double bound : {4.0, 8.0}) {
    decimator.decimate(bound);
    EXPECT_LT(2 * decimator.triangle_count(), last);
    last = decimator.triangle_count();
  }
  decimator.decimate(1000);
  EXPECT_LE(decimator.triangle_count(), 40U);
  EXPECT_EQ(counts_of(decimator.surface()), counts_of(fine));
}

double volume_of(const Surface& s) {
  double six = 0;
  for (const auto& [a, b, c] : s.triangles) {
    six += s.vertices[a].dot(s.vertices[b].cross(s.vertices[c]));
  }
  return six / 6;
}

/// A ball of voxels, or a bent tube with round ends that lies aslant.
SmallVolume random_solid(std::mt19937& random, bool is_tube) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * below(random, 1001) / 1000.0;
  };
  const double radius = between(2, 5), start = between(6, 7), end = is_tube ? 53 : start;
  const double rise = between(-0.3, 0.3), bend = between(0, 0.01);
  return volume_from({60, 50, 14}, 2, [=](auto x, auto y, auto z) {
    const double at = std::clamp(static_cast<double>(x), start, end), along = at - start;
    const double middle = 20 + rise * along + bend * along * along;
    const Vec3 off(static_cast<double>(x) - at, static_cast<double>(y) - middle,
                   static_cast<double>(z) - start);
    return off.norm() < radius ? 1 : 0;
  });
}

/// Tubes keep their volume also at levels that have three vertices around them.  Solids with an
/// edge of four triangles are left out, since its ends stay where they are.
TEST(SurfaceDecimator, KeepsTheVolumeOfTubesAndBalls) {
  std::mt19937 random(211);
  std::array<int, 2> solids{};
  for (int i = 0; i < 40; ++i) {
    const Surface fine = voxel_surface(random_solid(random, i % 2 == 0));
    if (counts_of(fine).odd_edges > 0) continue;
    ++solids[i % 2 == 0 ? 0 : 1];
    SurfaceDecimator decimator(fine.vertices, fine.triangles);
    for (double bound = 1; bound < 20; bound *= 2) {
      decimator.decimate(bound);
      EXPECT_NEAR(volume_of(decimator.surface()) / volume_of(fine), 1, 0.01) << i << " " << bound;
    }
  }
  EXPECT_GE(std::min(solids[0], solids[1]), 10);
}

/// The smallest closed surface cannot lose an edge.
TEST(SurfaceDecimator, LeavesATetrahedron) {
  const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  SurfaceDecimator decimator(vertices, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  decimator.decimate(100);
  EXPECT_EQ(decimator.triangle_count(), 4U);
  EXPECT_EQ(decimator.surface().vertices, vertices);
}

TEST(SurfaceDecimator, LeavesRimsAndTrianglesWithoutArea) {
  Surface sheet;
  constexpr std::uint32_t kEdge = 6;
  for (std::uint32_t y = 0; y < kEdge; ++y) {
    for (std::uint32_t x = 0; x < kEdge; ++x) sheet.vertices.emplace_back(x, y, 0);
  }
  for (std::uint32_t y = 0; y + 1 < kEdge; ++y) {
    for (std::uint32_t x = 0; x + 1 < kEdge; ++x) {
      const std::uint32_t a = y * kEdge + x;
      sheet.triangles.push_back({a, a + 1, a + kEdge + 1});
      sheet.triangles.push_back({a, a + kEdge + 1, a + kEdge});
    }
  }
  const auto at = static_cast<std::uint32_t>(sheet.vertices.size());
  sheet.vertices.insert(sheet.vertices.end(), 3, Vec3(9, 9, 9));
  sheet.triangles.push_back({at, at + 1, at + 2});
  SurfaceDecimator decimator(sheet.vertices, sheet.triangles);
  decimator.decimate(100);
  EXPECT_LE(decimator.surface().vertices.size(), 4 * (kEdge - 1) + 4);
  EXPECT_EQ(counts_of(decimator.surface()).odd_edges, 4 * (kEdge - 1) + 3);
}

TEST(SurfaceDecimator, OfNothingIsNothing) {
  SurfaceDecimator decimator({}, {});
  decimator.decimate(1);
  EXPECT_TRUE(decimator.surface().triangles.empty());
}

}  // namespace
}  // namespace mw::test
