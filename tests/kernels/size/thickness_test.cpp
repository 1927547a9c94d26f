// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Thicknesses of shapes whose thickness is known, and of random labels by their definition.
#include "kernels/size/thickness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <tuple>

#include "kernels/core/index.h"

namespace mw::test {
namespace {

using Place = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
using Found = std::map<Place, double>;
using LabelAt = std::function<Label(Index3)>;

LabelBox labels_of(const Box3& box, const LabelAt& label_at) {
  LabelBox out{box, {}};
  for_each_index(box, [&](Index3 v) { out.labels.push_back(label_at(v)); });
  return out;
}

Found thin_in(const Box3& asked, const LabelAt& label_at, const Metric& metric = {}) {
  Found out;
  for_each_thin_voxel(labels_of(grown(asked, kThinHalo), label_at), asked, metric,
                      [&](Index3 v, double t) {
                        out[{v.x, v.y, v.z}] = t;
                      });
  return out;
}

/// A plate of any number of steps of a direction is found all over its middle.
TEST(Thickness, OfPlatesInEachDirection) {
  const Box3 asked{{-12, -12, -12}, {12, 12, 12}};
  for (const Index3 normal : {Index3{1, 0, 0}, Index3{0, 1, 0}, Index3{0, 0, 1}, Index3{1, 1, 0},
                              Index3{0, 1, -1}, Index3{1, 1, 1}, Index3{1, -1, 1}}) {
    const auto height = [&](Index3 v) { return v.x * normal.x + v.y * normal.y + v.z * normal.z; };
    const std::int64_t step2 = normal.x * normal.x + normal.y * normal.y + normal.z * normal.z;
    for (const std::int64_t steps : {1, 2, 5, 8}) {
      const std::int64_t thick = steps * step2;
      const auto label_at = [&](Index3 v) -> Label {
        return height(v) >= 0 && height(v) < thick ? 1 : 0;
      };
      const Found found = thin_in(asked, label_at);
      const double length = static_cast<double>(steps) * std::sqrt(static_cast<double>(step2));
      std::size_t in_plate = 0;
      for (const auto& [place, t] : found) {
        const auto [x, y, z] = place;
        if (label_at({x, y, z}) != 1) continue;
        ++in_plate;
        EXPECT_NEAR(t, length, std::max(0.15 * length, 0.6)) << steps;
      }
      EXPECT_GE(in_plate, 24U * 24U / 2U) << steps << " " << normal.x << normal.y << normal.z;
    }
  }
}

TEST(Thickness, IsLengthOfTheMetric) {
  const auto label_at = [](Index3 v) -> Label { return v.z >= 0 && v.z < 3 ? 1 : 0; };
  const Found found = thin_in({{0, 0, 0}, {4, 4, 4}}, label_at, Metric({1, 1, 2.5}));
  ASSERT_EQ(found.size(), 16U);
  for (const auto& [place, t] : found) {
    EXPECT_EQ(std::get<2>(place), 1);
    EXPECT_NEAR(t, 7.5, 1e-5);
  }
}

/// A bar of 4 x 4 voxels that is the whole volume, and one that lies along its end.
TEST(Thickness, EndsAtTheEndOfTheVolume) {
  const Box3 volume{{0, 0, 0}, {4, 4, 40}};
  const Found all = thin_in(volume, [&](Index3 v) { return volume.contains(v) ? 0U : kExterior; });
  const Found layer = thin_in({{0, 0, 0}, {40, 40, 40}}, [](Index3 v) -> Label {
    return v.z < 0 ? kExterior : v.z < 5 ? 1 : 0;
  });
  EXPECT_GE(all.size(), 100U);
  for (const auto& [place, t] : all) EXPECT_NEAR(t, 4.0, 1e-5);
  ASSERT_EQ(layer.size(), 1600U);
  for (const auto& [place, t] : layer) {
    EXPECT_EQ(std::get<2>(place), 2);
    EXPECT_NEAR(t, 5.0, 1e-5);
  }
}

/// Corners and edges of a thick part are not thin, and neither is one voxel that sticks out.
TEST(Thickness, OfThickPartsIsNotFound) {
  const Box3 asked{{0, 0, 0}, {60, 60, 60}};
  const auto is_in = [](Index3 v, std::int64_t lo, std::int64_t hi) {
    return v.x >= lo && v.x < hi && v.y >= lo && v.y < hi && v.z >= lo && v.z < hi;
  };
  EXPECT_TRUE(thin_in(asked, [&](Index3 v) -> Label { return is_in(v, 10, 50) ? 1 : 0; }).empty());
  EXPECT_TRUE(thin_in(asked, [&](Index3 v) -> Label {
                return is_in(v, 10, 50) || v == Index3{20, 20, 50} ? 1 : 0;
              }).empty());
  const auto ball = [](double radius) {
    return [radius](Index3 v) -> Label {
      const double x = static_cast<double>(v.x) - 29.5, y = static_cast<double>(v.y) - 29.5,
                   z = static_cast<double>(v.z) - 29.5;
      return x * x + y * y + z * z <= radius * radius ? 1 : 0;
    };
  };
  EXPECT_TRUE(thin_in(asked, ball(20)).empty());
  for (const auto& [place, t] : thin_in(asked, ball(9))) {
    EXPECT_NEAR(t, 18, 2) << "only the middle of a ball is between two sides";
  }
}

/// What is told of a voxel does not depend on the box that was asked.
TEST(Thickness, IsTheSameByTiles) {
  std::mt19937 random(5);
  const Index3 shape{40, 36, 24};
  std::vector<Index3> seeds;
  for (int i = 0; i < 60; ++i) {
    seeds.push_back({static_cast<std::int64_t>(random() % 40),
                     static_cast<std::int64_t>(random() % 36),
                     static_cast<std::int64_t>(random() % 24)});
  }
  const auto label_at = [&](Index3 v) -> Label {
    if (!Box3{{0, 0, 0}, shape}.contains(v)) return kExterior;
    Label best = 0;
    std::int64_t least = 1 << 20;
    for (Label l = 0; l < seeds.size(); ++l) {
      const Index3 d = v - seeds[l];
      const std::int64_t distance = d.x * d.x + d.y * d.y + d.z * d.z;
      if (distance < least) {
        least = distance;
        best = l;
      }
    }
    return best % 3;
  };
  const Found whole = thin_in({{0, 0, 0}, shape}, label_at);
  EXPECT_GT(whole.size(), 100U);
  Found parts;
  for (std::int64_t x = 0; x < shape.x; x += 13) {
    for (std::int64_t z = 0; z < shape.z; z += 7) {
      const Box3 tile{{x, 0, z}, {std::min(x + 13, shape.x), shape.y, std::min(z + 7, shape.z)}};
      parts.merge(thin_in(tile, label_at));
    }
  }
  EXPECT_EQ(parts, whole);
  for (const auto& [place, t] : whole) {
    const auto [x, y, z] = place;
    EXPECT_NE(label_at({x, y, z}), kExterior);
    EXPECT_LE(t, 2.0 * kThinReach + std::sqrt(3.0));
  }
}

}  // namespace
}  // namespace mw::test
