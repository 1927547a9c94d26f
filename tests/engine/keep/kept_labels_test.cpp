// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels that were kept, and a volume that is read only where it has changed.
#include "engine/keep/kept_labels.h"

#include <gtest/gtest.h>

#include <fstream>

#include "engine/store/journal/work_file.h"
#include "tests/engine/keep/edits.h"
#include "tests/engine/memory_run.h"
#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using audit::test::random_shape;
using audit::test::random_volume_of;
using audit::test::VolumeKind;
using mw::test::TempFolder;
using test::below;
using test::MemoryVolume;

std::vector<RawLabel> read_all(const io::LabelVolume& volume, const Box3& box) {
  std::vector<RawLabel> out(static_cast<std::size_t>(box.voxels()));
  volume.read(box, out);
  return out;
}

Box3 random_box(std::mt19937& random, Index3 shape) {
  const auto span = [&](std::int64_t n) {
    const auto lo = std::int64_t{below(random, static_cast<std::uint32_t>(n))};
    return std::pair(lo, lo + 1 + below(random, static_cast<std::uint32_t>(n - lo)));
  };
  const auto x = span(shape.x), y = span(shape.y), z = span(shape.z);
  return {{x.first, y.first, z.first}, {x.second, y.second, z.second}};
}

TEST(PatchedVolume, IsTheNewVolumeWhereTheBoxesHaveAllChanges) {
  std::mt19937 random(3513);
  for (int i = 0; i < 20; ++i) {
    const Index3 shape = random_shape(random, 1, 70);
    const test::SmallVolume before =
        test::with_room(random_volume_of(random, VolumeKind::kBlobs, shape, 9));
    const TempFolder folder;
    const auto path = folder.path() / "labels";
    const MemoryVolume old_volume(before, {});
    io::AtomicFile file(path);
    write_kept_labels(old_volume, file);
    const std::string note(below(random, 10'000), 'n');
    append_note(file, note);
    file.commit();
    const auto kept = KeptLabels::open(path, before.shape);
    ASSERT_TRUE(kept.has_value());
    EXPECT_EQ(kept->note(), note);
    test::SmallVolume after = before;
    Box3 changed;
    const std::string done = test::Editor(random).edit(after, changed);
    SCOPED_TRACE(done + " in " + std::to_string(shape.x) + "," + std::to_string(shape.y) + "," +
                 std::to_string(shape.z));
    const MemoryVolume volume(after, {});
    const PatchedVolume patched(volume, *kept, {changed}), unpatched(volume, *kept, {});
    for (int k = 0; k < 5; ++k) {
      const Box3 box = random_box(random, before.shape);
      EXPECT_EQ(read_all(patched, box), read_all(volume, box));
      EXPECT_EQ(read_all(unpatched, box), read_all(old_volume, box));
    }
    EXPECT_FALSE(KeptLabels::open(path, before.shape + Index3{1, 0, 0}).has_value());
  }
}

/// Returns whether the file is refused, or taken for one of another shape.
bool is_refused(const std::filesystem::path& path, Index3 shape) {
  try {
    const auto kept = KeptLabels::open(path, shape);
    if (!kept) return true;
    for_each_index(kept->tiles().count(),
                   [&](Index3 tile) { static_cast<void>(kept->read(tile)); });
    static_cast<void>(kept->note());
    return false;
  } catch (const DamagedWork&) {
    return true;
  }
}

TEST(KeptLabels, AreTheSameFileFromAnyNumberOfThreads) {
  std::mt19937 random(3515);
  const test::SmallVolume volume = random_volume_of(random, VolumeKind::kBlobs, {300, 90, 90}, 9);
  const TempFolder folder;
  std::vector<std::string> files;
  for (const int threads : {1, 8}) {
    const auto path = folder.path() / std::to_string(threads);
    io::AtomicFile file(path);
    write_kept_labels(MemoryVolume(volume, {}), file, threads);
    file.commit();
    files.push_back(mw::test::content_of(path));
  }
  EXPECT_EQ(files[0], files[1]);
}

TEST(KeptLabels, TellDamage) {
  std::mt19937 random(3514);
  const test::SmallVolume volume = random_volume_of(random, VolumeKind::kNoise, {20, 20, 20}, 50);
  const TempFolder folder;
  const auto path = folder.path() / "labels";
  io::AtomicFile file(path);
  write_kept_labels(MemoryVolume(volume, {}), file);
  append_note(file, "a note");
  file.commit();
  const std::string whole = mw::test::content_of(path);
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 500) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 1 << below(random, 8));
    std::ofstream(path, std::ios::binary) << damaged;
    EXPECT_TRUE(is_refused(path, volume.shape)) << at;
  }
  std::ofstream(path, std::ios::binary) << whole;
  EXPECT_FALSE(is_refused(path, volume.shape));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  const auto kept = KeptLabels::open(path, volume.shape);
  ASSERT_TRUE(kept.has_value());
  EXPECT_THROW(static_cast<void>(kept->read({0, 0, 0})), DamagedWork);
  std::filesystem::resize_file(path, 90);
  EXPECT_THROW(static_cast<void>(KeptLabels::open(path, volume.shape)), DamagedWork);
}

}  // namespace
}  // namespace mw::engine
