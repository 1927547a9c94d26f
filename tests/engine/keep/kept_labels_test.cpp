// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels that were kept, and a volume that is read only where it has changed.
#include "engine/keep/kept_labels.h"

#include <gtest/gtest.h>

#include <fstream>
#include <mutex>
#include <set>

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

/// Labels in memory, which can be edited, and what was kept of them before.
class KeptVolume {
 public:
  explicit KeptVolume(const test::SmallVolume& volume) : labels_(volume) {
    const auto path = folder_.path() / "labels";
    io::AtomicFile file(path);
    write_kept_labels(MemoryVolume(labels_, {}), file);
    file.commit();
    kept_ = KeptLabels::open(path, volume.shape);
  }

  [[nodiscard]] const KeptLabels& kept() const { return kept_.value(); }
  [[nodiscard]] Box3 box() const { return {{0, 0, 0}, labels_.shape}; }
  void set(const Box3& voxels, Label label) {
    for_each_index(voxels, [&](Index3 v) {
      labels_.labels[static_cast<std::size_t>(box().offset(v))] = label;
    });
  }
  /// Returns what is found when these boxes are told.
  [[nodiscard]] std::optional<Box3> untold(const std::vector<Box3>& told, int threads = 1) const {
    const MemoryVolume volume(labels_, {});
    return PatchedVolume(volume, kept(), told).untold_change(threads);
  }

 private:
  TempFolder folder_;
  test::SmallVolume labels_;
  std::optional<KeptLabels> kept_;
};

/// All tiles of a small volume are read.
TEST(PatchedVolume, FindsEachUntoldEditOfASmallVolume) {
  std::mt19937 random(3516);
  int found = 0, told = 0;
  for (int i = 0; i < 40; ++i) {
    KeptVolume volume(
        random_volume_of(random, VolumeKind::kBlobs, random_shape(random, 20, 70), 9));
    const Box3 changed = random_box(random, volume.box().hi);
    const Index3 at = random_box(random, volume.box().hi).lo;
    EXPECT_FALSE(volume.untold({changed}).has_value());
    volume.set({at, at + Index3{1, 1, 1}}, 99);
    const ReadingTiles& tiles = volume.kept().tiles();
    const Box3 tile = tiles.box(tiles.over({at, at + Index3{1, 1, 1}}).lo);
    const bool is_told = !is_empty(intersection(tile, changed));
    const std::optional<Box3> seen = volume.untold({changed}, 1 + i % 3);
    EXPECT_EQ(seen, is_told ? std::nullopt : std::optional(tile));
    ++(is_told ? told : found);
  }
  EXPECT_GT(found, 5);
  EXPECT_GT(told, 5);
}

/// Notes where it is read.
class NotingVolume : public io::VolumeView {
 public:
  using VolumeView::VolumeView;
  void read(const Box3& box, std::span<RawLabel> out) const override {
    below().read(box, out);
    const std::lock_guard turn(noting_);
    noted_.insert({box.lo.z, box.lo.y});
  }
  [[nodiscard]] const std::set<std::pair<std::int64_t, std::int64_t>>& noted() const {
    return noted_;
  }

 private:
  mutable std::mutex noting_;
  mutable std::set<std::pair<std::int64_t, std::int64_t>> noted_;
};

/// One tile of each of equal parts of a large one is read, which depends on labels alone.
TEST(PatchedVolume, SamplesALargeVolume) {
  test::SmallVolume labels{.shape = {128, 128, 256}, .label_count = 100, .labels = {}};
  constexpr std::size_t kSamples = 64;  // tiles of 128 x 16 x 16: 8 * ReadingTiles::kMaxVoxels
  constexpr std::int64_t kTold = 1, kTiles = 8 * 16 - kTold;
  std::set<std::set<std::pair<std::int64_t, std::int64_t>>> draws;
  for (const Label label : {1U, 2U, 3U}) {
    labels.labels.assign(std::size_t{1} << 22U, label);
    const KeptVolume kept(labels);
    const MemoryVolume volume(labels, {});
    for (const int threads : {1, 4}) {
      const NotingVolume noting(volume);
      const PatchedVolume patched(noting, kept.kept(), {{{0, 0, 0}, {1, 1, 1}}});
      EXPECT_FALSE(patched.untold_change(threads).has_value());
      EXPECT_EQ(noting.noted().size(), kSamples);
      std::set<std::int64_t> parts;
      for (const auto& [z, y] : noting.noted()) {
        const std::int64_t tile = z / 16 * 8 + y / 16 - kTold;
        EXPECT_GE(tile, 0) << "the tile that is told is read";
        for (int k = 0; k < static_cast<int>(kSamples); ++k) {
          const SequencePart part{k, kSamples};
          if (tile >= part.begin(kTiles) && tile < part.end(kTiles)) parts.insert(k);
        }
      }
      EXPECT_EQ(parts.size(), kSamples);
      draws.insert(noting.noted());
    }
  }
  EXPECT_EQ(draws.size(), 3U);  // threads draw alike, other labels other tiles
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
