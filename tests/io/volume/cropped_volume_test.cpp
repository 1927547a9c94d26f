// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Crops against the whole volume, and where they lie.
#include "io/volume/cropped_volume.h"

#include "io/volume/open_volume.h"
#include "tests/io/labels/memory_volume.h"
#include "tests/io/volume/sample_files.h"

namespace mw::io {
namespace {

constexpr Index3 kShape{7, 5, 6};

std::string npy() {
  const std::vector<RawLabel> labels = sample_labels(kShape, VoxelType::kU16);
  return npy_file("<u2", false, "(6, 5, 7)", voxel_bytes(labels, VoxelType::kU16, false));
}

TEST(CroppedVolume, ReadsItsBoxOfTheWhole) {
  const TempDir dir;
  const auto path = dir.file("v.npy", npy());
  const MemoryVolume whole(kShape, VoxelType::kU16, sample_labels(kShape, VoxelType::kU16));
  std::mt19937 random(8);
  for (int i = 0; i < 300 && !testing::Test::HasFailure(); ++i) {
    OpenOptions options;
    options.crop = random_box(random, kShape);
    const auto volume = open_volume(path, options);
    EXPECT_EQ(volume->info().shape, options.crop->shape());
    std::vector<RawLabel> wanted(static_cast<std::size_t>(options.crop->voxels()));
    whole.read(*options.crop, wanted);
    EXPECT_EQ(read_all(*volume), wanted);
    expect_box(*volume, wanted, random);
  }
}

/// The corner of a voxel stays where it was, unless the origin is given.
TEST(CroppedVolume, LiesWhereItLayInTheWhole) {
  auto whole = std::make_unique<MemoryVolume>(
      kShape, VoxelType::kU16, std::vector<RawLabel>(static_cast<std::size_t>(kShape.product())));
  VolumeSpace& space = whole->info().space;
  space = {.spacing = {0.5, 2, 3}, .origin = {10, 20, 30}};
  space.axes = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
  whole->info().chunk = {4, 4, 4};
  const VolumeSpace before = space;
  OpenOptions options;
  options.crop = Box3{{1, 2, 3}, {4, 4, 4}};
  const auto part = cropped(std::move(whole), "v", options);
  EXPECT_EQ(to_world(part->info().space, {0.5, 1, 0}), to_world(before, {1.5, 3, 3}));
  EXPECT_EQ(part->info().chunk, (Index3{4, 4, 4}));

  const TempDir dir;
  options.origin = {1, 2, 3};
  const auto placed = open_volume(dir.file("v.npy", npy()), options);
  EXPECT_EQ(placed->info().space.origin, (Vector3{1, 2, 3}));
}

TEST(CroppedVolume, RefusesWhatIsNoBoxOfTheVolume) {
  const TempDir dir;
  const auto path = dir.file("v.npy", npy());
  for (const Box3 crop :
       {Box3{{0, 0, 0}, {8, 5, 6}}, Box3{{-1, 0, 0}, {7, 5, 6}}, Box3{{0, 0, 0}, {7, 5, 7}},
        Box3{{3, 0, 0}, {3, 5, 6}}, Box3{{0, 4, 0}, {7, 3, 6}}, Box3{{9, 9, 9}, {10, 10, 10}}}) {
    OpenOptions options;
    options.crop = crop;
    expect_error(ErrorKind::kUsage, {"--crop", "v.npy", "7 x 5 x 6"},
                 [&] { (void)open_volume(path, options); });
  }
}

}  // namespace
}  // namespace mw::io
