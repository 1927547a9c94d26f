// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Images are told from labels, however rough these are.
#include "engine/labels/texture_volume.h"

#include <cmath>

#include "engine/labels/label_scan.h"
#include "kernels/synth/synth.h"
#include "tests/io/labels/memory_volume.h"

namespace mw::engine {
namespace {

using io::VoxelType;

constexpr Index3 kShape{40, 36, 30};

/// Returns whether labels from value(voxel), a signed number, are taken for an image.
template <class Value>
bool is_image(VoxelType type, Value value) {
  std::vector<RawLabel> labels;
  for_each_index(kShape, [&](Index3 v) {
    labels.push_back(static_cast<RawLabel>(static_cast<std::int64_t>(value(v))));
  });
  const io::MemoryVolume volume(kShape, type, std::move(labels));
  const TextureVolume texture(volume);
  return texture.is_image(collect_labels(texture, 2));
}

bool is_image(const SynthSpec& spec) {
  std::vector<RawLabel> labels(static_cast<std::size_t>(kShape.product()));
  synth_slab(spec, 0, kShape.z, labels);
  const Box3 all{{0, 0, 0}, kShape};
  return is_image(VoxelType::kU64,
                  [&](Index3 v) { return labels[static_cast<std::size_t>(all.offset(v))]; });
}

/// Two tissues in air, as a scanner sees them, for a noise of 1.
double tissue(Index3 v) {
  const double r = std::hypot(static_cast<double>(v.x) - 20, static_cast<double>(v.y) - 18,
                              static_cast<double>(v.z) - 15);
  return r < 8 ? 12 : (r < 14 ? 4 : -60);
}

TEST(TextureVolume, FindsImagesWithAnyNoise) {
  for (const double sigma : {2.0, 10.0, 40.0}) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, 1);
    const auto grey = [&](Index3 v) { return std::round(sigma * (tissue(v) + noise(random))); };
    EXPECT_TRUE(is_image(VoxelType::kI16, grey)) << sigma;
    const auto with_metal = [&](Index3 v) { return v == Index3{20, 18, 15} ? 30'000 : grey(v); };
    EXPECT_TRUE(is_image(VoxelType::kI16, with_metal)) << sigma;
    const auto cut_out = [&](Index3 v) { return tissue(v) < 0 ? 0 : grey(v); };
    EXPECT_TRUE(is_image(VoxelType::kI16, cut_out)) << sigma;
    EXPECT_TRUE(is_image(VoxelType::kF32, grey)) << sigma;
  }
}

TEST(TextureVolume, LetsAllSynthesisedLabelsPass) {
  int tried = 0;
  for (const SynthKind kind : {SynthKind::kVoronoi, SynthKind::kTubes, SynthKind::kSpheres,
                               SynthKind::kNoise, SynthKind::kCheckerboard}) {
    for (const std::uint64_t labels : {2U, 16U, 17U, 40U, 300U, 20'000U}) {
      EXPECT_FALSE(is_image({.kind = kind, .shape = kShape, .labels = labels, .seed = labels}))
          << labels;
      ++tried;
    }
  }
  EXPECT_EQ(tried, 30);
}

/// Numbers of voxels, layers and ramps have neighbours that differ by one, too.
TEST(TextureVolume, LetsNumbersInOrderPass) {
  const Box3 all{{0, 0, 0}, kShape};
  EXPECT_FALSE(is_image(VoxelType::kU32, [&](Index3 v) { return all.offset(v); }));
  EXPECT_FALSE(is_image(VoxelType::kU8, [](Index3 v) { return v.x; }));
  EXPECT_FALSE(is_image(VoxelType::kU8, [](Index3 v) { return (v.x + 2 * v.y + v.z) % 20; }));
  EXPECT_FALSE(is_image(VoxelType::kI16, [](Index3 v) { return tissue(v); }));
}

/// An edit may give one voxel of noise a number of its own.
TEST(TextureVolume, OneFarLabelMakesNoImageOfNoise) {
  std::mt19937 random(3);
  const auto noise = [&](Index3 v) {
    return v == Index3{1, 2, 3} ? std::int64_t{1} << 60 : static_cast<std::int64_t>(random() % 20);
  };
  EXPECT_FALSE(is_image(VoxelType::kI64, noise));
}

/// Membranes of one voxel and dust between grains.
TEST(TextureVolume, LetsSheetsAndDustPass) {
  std::mt19937 random(5);
  const auto rough = [&](Index3 v) -> std::int64_t {
    if (v.x % 6 == 0 || v.y % 6 == 0) return 0;
    if (random() % 12 == 0) return static_cast<std::int64_t>(1 + random() % 40);
    return 1 + (v.x / 6 + 7 * (v.y / 6)) % 40;
  };
  EXPECT_FALSE(is_image(VoxelType::kU16, rough));
}

}  // namespace
}  // namespace mw::engine
