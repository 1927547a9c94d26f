// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A synthetic volume is the same whatever slabs it is made in, and has the labels asked for.
#include "kernels/synth/synth.h"

#include "kernels/core/error.h"
#include "tests/testing.h"

namespace mw {
namespace {

constexpr SynthKind kKinds[] = {SynthKind::kVoronoi, SynthKind::kTubes, SynthKind::kSpheres,
                                SynthKind::kNoise, SynthKind::kCheckerboard};

std::vector<RawLabel> whole(const SynthSpec& spec, std::int64_t planes) {
  const auto plane = static_cast<std::size_t>(spec.shape.x * spec.shape.y);
  std::vector<RawLabel> out(plane * static_cast<std::size_t>(spec.shape.z));
  for (std::int64_t z = 0; z < spec.shape.z; z += planes) {
    const std::int64_t nz = std::min(planes, spec.shape.z - z);
    synth_slab(spec, z, nz,
               std::span(out).subspan(static_cast<std::size_t>(z) * plane,
                                      static_cast<std::size_t>(nz) * plane));
  }
  return out;
}

TEST(Synth, SlabsDoNotMatter) {
  for (const SynthKind kind : kKinds) {
    for (const std::uint64_t labels : {1U, 2U, 20U, 300U}) {
      const SynthSpec spec{.kind = kind, .shape = {40, 33, 29}, .labels = labels, .seed = 5};
      const auto once = whole(spec, spec.shape.z);
      EXPECT_EQ(whole(spec, 1), once);
      EXPECT_EQ(whole(spec, 7), once);
    }
  }
}

TEST(Synth, HasTheLabelsAskedFor) {
  for (const SynthKind kind : kKinds) {
    const SynthSpec spec{.kind = kind, .shape = {64, 60, 56}, .labels = 30, .seed = 1};
    const auto voxels = whole(spec, 8);
    const std::set<RawLabel> found(voxels.begin(), voxels.end());
    const bool background = kind == SynthKind::kTubes || kind == SynthKind::kSpheres;
    const bool from_zero = kind == SynthKind::kNoise || kind == SynthKind::kCheckerboard;
    EXPECT_LE(*found.rbegin(), from_zero ? 29U : 30U);
    EXPECT_GE(*found.begin(), background || from_zero ? 0U : 1U);
    EXPECT_GE(found.size(), 26U) << static_cast<int>(kind);
  }
}

TEST(Synth, SeedsDiffer) {
  for (const SynthKind kind :
       {SynthKind::kVoronoi, SynthKind::kTubes, SynthKind::kSpheres, SynthKind::kNoise}) {
    const SynthSpec a{.kind = kind, .shape = {40, 40, 40}, .labels = 10, .seed = 1};
    const SynthSpec b{.kind = kind, .shape = {40, 40, 40}, .labels = 10, .seed = 2};
    EXPECT_NE(whole(a, 40), whole(b, 40));
  }
}

/// The 27 cells looked at are enough: every voxel carries the label of the nearest of all seeds,
/// so along a line each label makes one run (cells are convex; one cell a label here).
TEST(Synth, VoronoiCellsAreConvexAlongLines) {
  const SynthSpec spec{.kind = SynthKind::kVoronoi, .shape = {64, 64, 64}, .labels = 64, .seed = 9};
  const auto voxels = whole(spec, 64);
  for (std::size_t row = 0; row < 64 * 64; ++row) {
    std::set<RawLabel> done;
    for (std::size_t x = 1; x < 64; ++x) {
      const RawLabel before = voxels[row * 64 + x - 1];
      const RawLabel here = voxels[row * 64 + x];
      if (here == before) continue;
      done.insert(before);
      ASSERT_FALSE(done.contains(here)) << row << " " << x;
    }
  }
}

TEST(Synth, ThinAndCrowdedVolumes) {
  for (const SynthKind kind : kKinds) {
    for (const Index3 shape : {Index3{1, 1, 1}, Index3{100, 1, 3}, Index3{2, 2, 50}}) {
      const SynthSpec spec{.kind = kind, .shape = shape, .labels = 1000000, .seed = 3};
      EXPECT_EQ(whole(spec, 1), whole(spec, shape.z));
    }
  }
}

TEST(Synth, RefusesSenselessSpecs) {
  EXPECT_THROW(check_synth_spec({.shape = {1, 1, 1}, .labels = 0}), Error);
  EXPECT_THROW(check_synth_spec({.shape = {0, 1, 1}}), Error);
  EXPECT_THROW(check_synth_spec({.shape = {1, 1, 1 << 21}}), Error);
  EXPECT_EQ(parse_synth_kind("tubes"), SynthKind::kTubes);
  EXPECT_FALSE(parse_synth_kind("cubes"));
}

}  // namespace
}  // namespace mw
