// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Flips that the test allows, made in whole small volumes: no Betti number changes.
#include "kernels/start/simple_voxel.h"

#include <gtest/gtest.h>

#include <optional>

#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

Neighbourhood around(const SmallVolume& volume, Index3 v) {
  const Index3 one{1, 1, 1};
  Neighbourhood out;
  const LabelBox box = labels_in(volume, {v - one, v + Index3{2, 2, 2}});
  std::copy(box.labels.begin(), box.labels.end(), out.begin());
  return out;
}

Index3 random_voxel(std::mt19937& random, Index3 shape) {
  const auto x = below(random, static_cast<std::uint32_t>(shape.x));
  const auto y = below(random, static_cast<std::uint32_t>(shape.y));
  return {x, y, below(random, static_cast<std::uint32_t>(shape.z))};
}

/// Giving voxel v the label `to`.
struct Flip {
  Index3 v;
  Label from = 0;
  Label to = 0;
  bool allowed = false;
  bool between_others = false;  ///< a third label is around
};

/// The label of a voxel nearby, at random; none when that is the present one, or the exterior.
std::optional<Flip> random_flip(std::mt19937& random, const SmallVolume& volume, Index3 v) {
  const Neighbourhood labels = around(volume, v);
  const Label from = labels[kSelf], to = labels[below(random, 27)];
  if (to == from || to == kExterior) return std::nullopt;
  const bool others = std::any_of(labels.begin(), labels.end(),
                                  [&](Label l) { return l != from && l != to && l != kExterior; });
  return Flip{v, from, to, relabel_keeps_topology(labels, to), others};
}

bool keeps_betti_numbers(const SmallVolume& volume, const Flip& flip) {
  SmallVolume after = volume;
  after.labels[static_cast<std::size_t>(Box3{{0, 0, 0}, volume.shape}.offset(flip.v))] = flip.to;
  return betti(after) == betti(volume);
}

TEST(Promise1Topology, FlipsOfVoxelsKeepEveryRegionOfEveryLabel) {
  std::mt19937 random(1011);
  constexpr std::array<VolumeKind, 4> kKinds{VolumeKind::kNoise, VolumeKind::kBlobs,
                                             VolumeKind::kSponge, VolumeKind::kBlobs};
  int allowed = 0, between_others = 0;
  for (std::uint32_t i = 0; i < 30000 && !HasFailure(); ++i) {
    const auto edge = [&] { return std::int64_t{i % 8 == 0 ? 4 : 3} + below(random, 2); };
    const auto x = edge(), y = edge(), z = edge();
    const SmallVolume volume =
        random_volume_of(random, kKinds[i % 4], {x, y, z}, 2 + below(random, 5));
    const auto flip = random_flip(random, volume, random_voxel(random, volume.shape));
    if (!flip || !flip->allowed) continue;
    EXPECT_TRUE(keeps_betti_numbers(volume, *flip)) << volume.text() << " to " << flip->to;
    ++allowed;
    between_others += flip->between_others ? 1 : 0;
  }
  EXPECT_GT(allowed, 1000);
  EXPECT_GT(between_others, 500);
}

/// Two labels, the middle of 3^3 voxels: the test is nearly exact.
TEST(SimpleVoxel, RefusesLittleThatWouldKeepTopology) {
  std::mt19937 random(1012);
  int allowed = 0, refused = 0, refused_in_vain = 0;
  for (int i = 0; i < 2400 && !HasFailure(); ++i) {
    const std::uint32_t ones = 1 + below(random, 9);
    const SmallVolume volume = volume_from(
        {3, 3, 3}, 2, [&](auto, auto, auto) { return below(random, 10) < ones ? 1 : 0; });
    const auto flip = random_flip(random, volume, {1, 1, 1});
    if (!flip) continue;
    const bool unchanged = keeps_betti_numbers(volume, *flip);
    if (flip->allowed) {
      EXPECT_TRUE(unchanged);
      ++allowed;
    } else {
      ++refused;
      refused_in_vain += unchanged ? 1 : 0;
    }
  }
  RecordProperty("allowed", allowed);
  RecordProperty("refused", refused);
  RecordProperty("refused_in_vain", refused_in_vain);
  EXPECT_GT(allowed, 80);
  EXPECT_LT(refused_in_vain, refused / 50);
}

}  // namespace
}  // namespace mw::test
