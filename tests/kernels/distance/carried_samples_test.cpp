// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Samples by triangle, and where samples lie.
#include "kernels/distance/carried_samples.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tests/oracle/small_volumes.h"

namespace mw::test {
namespace {

/// Rows beyond 21 bits once shared a list with smaller ones.
TEST(CarriedSamples, TellLargeRowsApart) {
  CarriedSamples samples;
  samples.add(triangle_key(1, 2, (1U << 21) | 5U), 0, 7);
  EXPECT_EQ(samples.find(triangle_key(1, 3, 5)), nullptr);
  ASSERT_NE(samples.find(triangle_key((1U << 21) | 5U, 1, 2)), nullptr);
}

TEST(CarriedSamples, FindWhatWasAddedAndNotErased) {
  std::mt19937 random(921);
  CarriedSamples samples;
  std::map<TriangleKey, std::vector<FaceSample>> expected;
  for (FaceSample s = 0; s < 3000; ++s) {
    const auto row = [&] { return audit::test::below(random, 12); };
    const TriangleKey key = triangle_key(row(), row(), row());
    if (s % 5 == 0) {
      samples.erase(key);
      expected.erase(key);
    } else {
      samples.add(key, 3, s);
      expected[key].push_back(s);
    }
    const CarriedSamples::List* list = samples.find(key);
    ASSERT_EQ(list != nullptr, expected.count(key) == 1);
    if (list != nullptr) {
      ASSERT_EQ(list->samples, expected[key]);
    }
  }
}

TEST(FaceSample, LiesInItsQuarterOfItsFace) {
  const Index3 volume{5, 7, 3};
  for (unsigned axis = 0; axis < 3; ++axis) {
    for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
      const Index3 voxel{3, 6, 1};
      const Point p = position(face_sample(voxel, axis, quarter, volume), volume);
      const std::array<std::int64_t, 3> at{p.x, p.y, p.z}, v{voxel.x, voxel.y, voxel.z};
      unsigned bit = 0;
      for (unsigned i = 0; i < 3; ++i) {
        const std::int64_t inside = at[i] - v[i] * kUnitsPerVoxel;
        if (i == axis) {
          EXPECT_EQ(inside, kUnitsPerVoxel);
        } else {
          EXPECT_EQ(inside, (quarter >> bit++ & 1U) != 0 ? 768 : 256);
        }
      }
    }
  }
}

}  // namespace
}  // namespace mw::test
