// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Samples by triangle against std::map, and where samples lie.
#include "kernels/distance/carried_samples.h"

#include "tests/oracle/small_volumes.h"
#include "tests/testing.h"

namespace mw::test {
namespace {

using audit::test::below;

/// What the table should hold.
struct Carried {
  Label side = 0;
  std::vector<FaceSamples> samples;  ///< in the order in which they came
};
using Expected = std::map<TriangleKey, Carried>;

std::vector<FaceSamples> listed(const CarriedSamples& samples, const TriangleKey& key) {
  const auto list = samples.of(key);
  return {list.begin(), list.end()};
}

void expect_same(const CarriedSamples& samples, const Expected& expected, const TriangleKey& key) {
  const auto found = expected.find(key);
  if (found == expected.end()) {
    ASSERT_TRUE(listed(samples, key).empty());
    for (Label side : {0U, 1U, 2U}) ASSERT_FALSE(samples.has(key, side));
    return;
  }
  ASSERT_EQ(listed(samples, key), found->second.samples);
  for (Label side : {0U, 1U, 2U}) ASSERT_EQ(samples.has(key, side), side == found->second.side);
}

/// Rows beyond 21 bits once shared a list with smaller ones.
TEST(CarriedSamples, TellLargeRowsApart) {
  CarriedSamples samples;
  samples.add(triangle_key(1, 2, (1U << 21) | 5U), 0, 7);
  EXPECT_FALSE(samples.has(triangle_key(1, 3, 5), 0));
  EXPECT_TRUE(samples.has(triangle_key((1U << 21) | 5U, 1, 2), 0));
}

/// Few triangles and many samples, or many triangles of which most go again; the table fills, grows
/// and empties several times.
TEST(CarriedSamples, FindWhatWasAddedAndNotErased) {
  std::mt19937 random(921);
  for (const std::uint32_t rows : {3U, 6U, 12U, 40U}) {
    for (const std::uint32_t erased_of_10 : {1U, 5U, 8U}) {
      CarriedSamples samples;
      Expected expected;
      std::set<TriangleKey> seen;
      for (FaceSamples s = 0; s < 4000; ++s) {
        const auto row = [&] { return below(random, rows); };
        const auto a = row(), b = row(), c = row();
        const TriangleKey key = triangle_key(a, b, c);
        seen.insert(key);
        // Phases: mostly growing, then mostly shrinking.
        const std::uint32_t erased = s / 1000 % 2 == 0 ? 1 : erased_of_10;
        if (below(random, 10) < erased) {
          samples.erase(key);
          expected.erase(key);
        } else {
          const Label side = below(random, 3);
          samples.add(key, side, s % 7);
          expected.try_emplace(key, Carried{side, {}}).first->second.samples.push_back(s % 7);
        }
        ASSERT_EQ(samples.empty(), expected.empty());
        expect_same(samples, expected, key);
        if (s % 500 != 499) continue;
        for (const TriangleKey& k : seen) expect_same(samples, expected, k);
      }
      for (const TriangleKey& k : seen) samples.erase(k);
      EXPECT_TRUE(samples.empty());
    }
  }
}

/// Every removal from a table as full as it gets: each of the others must still be found.
TEST(CarriedSamples, FindTheOthersAfterEachRemovalFromAFullTable) {
  std::mt19937 random(922);
  for (int round = 0; round < 60; ++round) {
    CarriedSamples samples;
    Expected expected;
    while (expected.size() < 32) {
      const auto a = below(random, 1000), b = below(random, 1000), c = below(random, 1000);
      const TriangleKey key = triangle_key(a, b, c);
      samples.add(key, 1, 5);
      expected.try_emplace(key, Carried{1, {}}).first->second.samples.push_back(5);
    }
    while (!expected.empty()) {
      const auto gone =
          std::next(expected.begin(), below(random, static_cast<std::uint32_t>(expected.size())));
      const TriangleKey key = gone->first;
      samples.erase(key);
      expected.erase(gone);
      expect_same(samples, expected, key);
      for (const auto& [other, carried] : expected) expect_same(samples, expected, other);
    }
  }
}

/// Lists that wander from name to name, lose some of their samples and get others.
TEST(CarriedSamples, FollowTheirTriangles) {
  std::mt19937 random(923);
  CarriedSamples samples;
  Expected expected;
  const auto any_key = [&] {
    const auto a = below(random, 9), b = below(random, 9), c = below(random, 9);
    return triangle_key(a, b, c);
  };
  for (FaceSamples s = 0; s < 30000; ++s) {
    const TriangleKey key = any_key(), other = any_key();
    Carried& list = expected[key];
    if (list.samples.empty()) list.side = below(random, 3);
    const auto kind = below(random, 8);
    if (kind < 5) {
      samples.add(key, list.side, s);
      list.samples.push_back(s);
    } else if (kind == 5) {
      std::vector<bool> kept(list.samples.size());
      std::vector<FaceSamples> left;
      for (std::size_t i = 0; i < kept.size(); ++i) {
        kept[i] = below(random, 3) != 0;
        if (kept[i]) left.push_back(list.samples[i]);
      }
      samples.keep(key, kept);
      list.samples = left;
    } else {
      const Carried taken = std::exchange(list, Carried{});
      const CarriedSamples::Taken own = samples.take(key);
      const CarriedSamples::Taken theirs = samples.take(other);
      EXPECT_TRUE(samples.of(key).empty());
      samples.give(other, own);
      if (kind == 6) samples.give(other, theirs);
      Carried& there = expected[other];
      const auto behind = key == other || kind == 7 ? std::vector<FaceSamples>{} : there.samples;
      const Label side = taken.samples.empty() ? there.side : taken.side;
      there = {side, taken.samples};
      there.samples.insert(there.samples.end(), behind.begin(), behind.end());
    }
    for (const TriangleKey& k : {key, other}) {
      if (expected[k].samples.empty()) expected.erase(k);
      expect_same(samples, expected, k);
    }
    if (s % 500 != 499) continue;
    for (const auto& [k, list_of_k] : expected) expect_same(samples, expected, k);
  }
}

/// Samples lie on the face of their voxel, however far out that voxel lies.
TEST(FaceSamples, LieInTheirQuartersOfTheirFace) {
  constexpr std::int64_t kLast = kMaxSampledVoxels - 1;
  for (const Index3 voxel : {Index3{3, 6, 1},
                             {0, 0, 0},
                             {kLast, 0, 5},
                             {1, kLast, 0},
                             {0, 2, kLast},
                             {kLast, kLast, kLast}}) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
        const Point p = sample_position(face_samples(voxel, axis, kAllQuarters), quarter);
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
}

}  // namespace
}  // namespace mw::test
