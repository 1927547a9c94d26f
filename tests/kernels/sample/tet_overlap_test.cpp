// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes of tets and voxels together against tets that are split along all planes of the grid.
#include "kernels/sample/tet_overlap.h"

#include <cmath>
#include <map>
#include <random>

#include "tests/testing.h"

namespace mw {
namespace {

using Corners = std::array<ImagePoint, 4>;
using Volumes = std::map<std::array<std::int64_t, 3>, double>;

double volume_of(const Corners& t) {
  ImagePoint e[3];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) e[i][k] = t[i + 1][k] - t[0][k];
  }
  return std::abs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
                  e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
                  e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         6;
}

/// A prism of two triangles, corner by corner, in three tets.
void add_prism(const std::array<ImagePoint, 6>& p, std::vector<Corners>& out) {
  out.push_back({p[0], p[1], p[2], p[5]});
  out.push_back({p[0], p[1], p[4], p[5]});
  out.push_back({p[0], p[3], p[4], p[5]});
}

/// The parts of a tet on both sides of a plane.
void split(const Corners& tet, std::size_t axis, double bound, std::vector<Corners>& out) {
  std::vector<ImagePoint> below, above;
  for (const ImagePoint& p : tet) (p[axis] < bound ? below : above).push_back(p);
  const auto cut = [&](const ImagePoint& a, const ImagePoint& b) {
    ImagePoint c;
    const double share = (bound - a[axis]) / (b[axis] - a[axis]);
    for (std::size_t k = 0; k < 3; ++k) c[k] = a[k] + share * (b[k] - a[k]);
    c[axis] = bound;
    return c;
  };
  if (below.size() > above.size()) std::swap(below, above);
  if (below.empty()) return out.push_back(tet);
  if (below.size() == 1) {
    const ImagePoint &a = below[0], p = cut(a, above[0]), q = cut(a, above[1]),
                     r = cut(a, above[2]);
    out.push_back({a, p, q, r});
    return add_prism({p, q, r, above[0], above[1], above[2]}, out);
  }
  const ImagePoint &a = below[0], &b = below[1], &c = above[0], &d = above[1];
  add_prism({a, cut(a, c), cut(a, d), b, cut(b, c), cut(b, d)}, out);
  add_prism({c, cut(a, c), cut(b, c), d, cut(a, d), cut(b, d)}, out);
}

Volumes by_splitting(const Corners& tet) {
  std::vector<Corners> parts{tet};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (double bound = -3; bound <= 9; ++bound) {
      std::vector<Corners> next;
      for (const Corners& part : parts) split(part, axis, bound, next);
      std::erase_if(next, [](const Corners& part) { return volume_of(part) < 1e-17; });
      parts = std::move(next);
    }
  }
  Volumes out;
  for (const Corners& part : parts) {
    std::array<std::int64_t, 3> voxel{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double middle = (part[0][k] + part[1][k] + part[2][k] + part[3][k]) / 4;
      voxel[k] = static_cast<std::int64_t>(std::floor(middle));
    }
    out[voxel] += volume_of(part);
  }
  return out;
}

Volumes by_overlap(const TetOverlap& tet, const Box3& box) {
  Volumes out;
  tet.cut(box, [&](const CoveredRow& row) {
    for (std::size_t i = 0; i < row.volumes.size(); ++i) {
      const auto x = row.first.x + static_cast<std::int64_t>(i);
      EXPECT_TRUE(box.contains({x, row.first.y, row.first.z}));
      EXPECT_TRUE(out.insert({{x, row.first.y, row.first.z}, row.volumes[i]}).second);
    }
  });
  return out;
}

/// Corners anywhere, on halves of voxels, or on their corners, where most of what could go wrong
/// is.
Corners random_tet(std::mt19937& random) {
  std::uniform_real_distribution<double> anywhere(-3.0, 9.0);
  const int kind = static_cast<int>(random() % 4);
  Corners out;
  for (ImagePoint& p : out) {
    for (double& x : p) {
      x = anywhere(random);
      if (kind == 1) x = std::round(x);
      if (kind == 2) x = std::round(2 * x) / 2;
      if (kind == 3) x = 2 + x / 100;
    }
  }
  return out;
}

TEST(TetOverlap, IsWhatSplittingAlongAllPlanesFinds) {
  constexpr double kRounding = 1e-12;
  std::mt19937 random(7);
  const Box3 all{{-8, -8, -8}, {16, 16, 16}};
  std::size_t voxels = 0;
  for (int i = 0; i < 100; ++i) {
    const Corners tet = random_tet(random);
    const TetOverlap overlap(tet);
    EXPECT_NEAR(overlap.volume(), volume_of(tet), kRounding);
    Volumes expected = by_splitting(tet);
    for (const auto& [voxel, volume] : by_overlap(overlap, all)) expected[voxel] -= volume;
    for (const auto& [voxel, error] : expected) ASSERT_NEAR(error, 0, kRounding) << i;
    voxels += expected.size();
  }
  EXPECT_GT(voxels, 3000U);
}

TEST(TetOverlap, TellsThePartsOfABoxAsTheWhole) {
  std::mt19937 random(8);
  const Box3 all{{0, 0, 0}, {6, 7, 8}};
  for (int i = 0; i < 100; ++i) {
    const TetOverlap overlap(random_tet(random));
    const Volumes whole = by_overlap(overlap, all);
    Volumes parts;
    for (const Box3& part : {Box3{{0, 0, 0}, {6, 7, 3}}, Box3{{0, 0, 3}, {6, 4, 8}},
                             Box3{{0, 4, 3}, {2, 7, 8}}, Box3{{2, 4, 3}, {6, 7, 8}}}) {
      parts.merge(by_overlap(overlap, part));
    }
    for (const auto& [voxel, volume] : whole) {
      const auto found = parts.find(voxel);
      ASSERT_NEAR(found == parts.end() ? 0.0 : found->second, volume, 1e-13);
    }
    const Box3 box = overlap.box(all.shape());
    for (const auto& [voxel, volume] : whole) {
      ASSERT_TRUE(volume < 1e-9 || box.contains({voxel[0], voxel[1], voxel[2]}));
    }
  }
}

TEST(TetOverlap, FarOutsideThereIsNothing) {
  const TetOverlap overlap({{{1e30, 0, 0}, {1e30, 1, 0}, {1e30, 0, 1}, {2e30, 0, 0}}});
  EXPECT_TRUE(is_empty(overlap.box({10, 10, 10})));
  const TetOverlap around({{{-1e9, -1e9, -1e9}, {3e9, 0, 0}, {0, 3e9, 0}, {0, 0, 3e9}}});
  EXPECT_EQ(around.box({2, 3, 4}), (Box3{{0, 0, 0}, {2, 3, 4}}));
  double sum = 0;
  around.cut({{0, 0, 0}, {2, 3, 4}}, [&](const CoveredRow& row) {
    for (const double volume : row.volumes) sum += volume;
  });
  EXPECT_NEAR(sum, 24, 1e-4);  // corners so far away leave 1e-6 of a voxel
}

}  // namespace
}  // namespace mw
