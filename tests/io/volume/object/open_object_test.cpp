// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Objects of random volumes, against a flood over all voxels.
#include "io/volume/object/open_object.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "kernels/core/error.h"

namespace mw::io {
namespace {

/// Voxels in memory, x fastest; notes which were read.
class MemoryVolume : public LabelVolume {
 public:
  MemoryVolume(Index3 shape, std::vector<RawLabel> voxels, Index3 chunk = {16, 16, 16})
      : voxels_(std::move(voxels)), is_read(voxels_.size()) {
    info_.shape = shape;
    info_.type = VoxelType::kU64;
    info_.chunk = chunk;
  }
  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  void set_far() { info_.is_far = true; }
  void read(const Box3& box, std::span<RawLabel> out) const override {
    const Box3 all{{0, 0, 0}, info_.shape};
    std::size_t at = 0;
    for_each_index(box, [&](Index3 v) {
      const auto place = static_cast<std::size_t>(all.offset(v));
      out[at++] = voxels_[place];
      is_read[place] = true;
    });
  }

 private:
  VolumeInfo info_;
  std::vector<RawLabel> voxels_;

 public:
  mutable std::vector<bool> is_read;
};

constexpr RawLabel kOne = 1'000'000'007, kTwo = 5, kOther = 9;

struct Sample {
  Index3 shape;
  std::vector<RawLabel> voxels;

  [[nodiscard]] Box3 box() const { return {{0, 0, 0}, shape}; }
  [[nodiscard]] RawLabel& at(Index3 v) { return voxels[static_cast<std::size_t>(box().offset(v))]; }
  [[nodiscard]] RawLabel at(Index3 v) const {
    return voxels[static_cast<std::size_t>(box().offset(v))];
  }
};

std::int64_t below(std::mt19937& random, std::int64_t n) {
  return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n));
}

/// A thick start, and a walk of single voxels from there, that may leave by corners.
void walk(std::mt19937& random, Sample& sample, RawLabel label) {
  const Index3 s = sample.shape;
  Index3 at{below(random, s.x), below(random, s.y), below(random, s.z)};
  for_each_index(intersection(grown({at, at + Index3{1, 1, 1}}, 4), sample.box()),
                 [&](Index3 v) { sample.at(v) = label; });
  const Index3 step{below(random, 3) - 1, below(random, 3) - 1, below(random, 3) - 1};
  for (int i = 0; i < 60; ++i) {
    const Index3 next = at + step + Index3{below(random, 3) - 1, below(random, 3) - 1, 0};
    if (!sample.box().contains(next)) continue;
    const Index3 way = next - at;
    if (std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)}) > 1) continue;
    at = next;
    sample.at(at) = label;
  }
}

Sample random_sample(std::mt19937& random) {
  Sample out;
  out.shape = {40 + below(random, 50), 40 + below(random, 40), 40 + below(random, 30)};
  out.voxels.resize(static_cast<std::size_t>(out.box().voxels()));
  for (RawLabel& label : out.voxels) label = random() % 4 == 0 ? kOther : 0;
  walk(random, out, kTwo);
  walk(random, out, kOne);
  return out;
}

/// Every f-th voxel, so that thin parts are lost.
Sample coarser(const Sample& fine, std::int64_t f) {
  Sample out;
  out.shape = {(fine.shape.x + f - 1) / f, (fine.shape.y + f - 1) / f, (fine.shape.z + f - 1) / f};
  out.voxels.resize(static_cast<std::size_t>(out.box().voxels()));
  for_each_index(out.shape, [&](Index3 v) { out.at(v) = fine.at({v.x * f, v.y * f, v.z * f}); });
  return out;
}

bool has_all(const Sample& sample, const ObjectLabels& labels) {
  return std::all_of(labels.begin(), labels.end(), [&](RawLabel label) {
    return std::find(sample.voxels.begin(), sample.voxels.end(), label) != sample.voxels.end();
  });
}

/// Returns the sample with all but the labels 0, and the box of what is left.
std::pair<Sample, Box3> alone(const Sample& sample, const ObjectLabels& labels) {
  Sample out = sample;
  Box3 box{};
  for_each_index(out.shape, [&](Index3 v) {
    const bool is_it = std::find(labels.begin(), labels.end(), out.at(v)) != labels.end();
    if (!is_it) {
      out.at(v) = 0;
      return;
    }
    const Box3 one{v, v + Index3{1, 1, 1}};
    box = is_empty(box) ? one : hull(box, one);
  });
  return {out, box};
}

ScaledVolume scaled(const Sample& sample, const std::vector<std::int64_t>& factors) {
  return {.name = "sample",
          .volume = std::make_unique<MemoryVolume>(sample.shape, sample.voxels),
          .copies = static_cast<int>(factors.size()),
          .open_copy =
              [&sample, factors](int copy) {
                const Sample coarse = coarser(sample, factors[static_cast<std::size_t>(copy)]);
                return std::make_unique<MemoryVolume>(coarse.shape, coarse.voxels);
              },
          .cheap_voxels = 0};
}

TEST(OpenObject, IsTheVolumeWithOneObjectAlone) {
  int all = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Sample sample = random_sample(random);
    const ObjectLabels labels = seed % 3 == 0 ? ObjectLabels{kTwo, kOne} : ObjectLabels{kOne};
    const std::vector<std::int64_t> factors =
        seed % 4 == 0 ? std::vector<std::int64_t>{} : std::vector<std::int64_t>{7, 3};
    if (!has_all(sample, labels)) continue;
    const ObjectView view = open_object(scaled(sample, factors), labels, sample.box());
    const auto [expected, box] = alone(sample, labels);
    EXPECT_EQ(view.box, intersection(grown(box, kObjectMargin), sample.box()));
    EXPECT_EQ(view.volume->info().shape, sample.shape);
    std::vector<RawLabel> voxels(sample.voxels.size());
    view.volume->read(sample.box(), voxels);
    EXPECT_EQ(voxels, expected.voxels);
    ++all;
  }
  EXPECT_GT(all, 50);
}

TEST(OpenObject, ReadsOnlyCellsAroundTheObject) {
  Sample sample;
  sample.shape = {128, 96, 80};
  sample.voxels.resize(static_cast<std::size_t>(sample.box().voxels()));
  for_each_index({{60, 40, 40}, {70, 50, 50}}, [&](Index3 v) { sample.at(v) = kOne; });
  ScaledVolume source = scaled(sample, {4});
  const auto& voxels = dynamic_cast<const MemoryVolume&>(*source.volume);
  const ObjectView view = open_object(std::move(source), {kOne}, sample.box());
  std::vector<RawLabel> out(static_cast<std::size_t>(view.box.voxels()));
  view.volume->read(view.box, out);
  // Cells of 16 voxels that the object, with a voxel of the copy around, may be in.
  const Box3 near{{48, 32, 32}, {80, 64, 64}};
  for_each_index(sample.shape, [&](Index3 v) {
    if (near.contains(v)) return;
    ASSERT_FALSE(voxels.is_read[static_cast<std::size_t>(sample.box().offset(v))])
        << v.x << " " << v.y << " " << v.z;
  });
}

/// A second part that only the finer copy shows is found where that copy is cheap.
TEST(OpenObject, LooksThroughTheFinestCopyThatIsCheap) {
  Sample sample;
  sample.shape = {96, 96, 96};
  sample.voxels.resize(static_cast<std::size_t>(sample.box().voxels()));
  for_each_index({{8, 8, 8}, {40, 40, 40}}, [&](Index3 v) { sample.at(v) = kOne; });
  for_each_index({{81, 81, 81}, {88, 88, 88}}, [&](Index3 v) { sample.at(v) = kOne; });
  for (const bool is_cheap : {false, true}) {
    ScaledVolume source = scaled(sample, {16, 4});
    source.cheap_voxels = is_cheap ? 24 * 24 * 24 : 0;
    const ObjectView view = open_object(std::move(source), {kOne}, sample.box());
    EXPECT_EQ(view.box.lo, (Index3{4, 4, 4}));
    EXPECT_EQ(view.box.hi, (is_cheap ? Index3{92, 92, 92} : Index3{44, 44, 44}));
  }
}

TEST(OpenObject, EndsAtTheBounds) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Sample sample = random_sample(random);
    const Box3 bounds{{5, 9, 11}, {sample.shape.x - 7, sample.shape.y - 4, sample.shape.z - 3}};
    Sample inside = sample;
    for_each_index(inside.shape, [&](Index3 v) {
      if (!bounds.contains(v)) inside.at(v) = 0;
    });
    if (!has_all(inside, {kOne})) continue;
    const ObjectView view = open_object(scaled(sample, {3}), {kOne}, bounds);
    const Box3 box = alone(inside, {kOne}).second;
    // The object may come in again from outside the bounds, so pieces of it may be missing.
    EXPECT_EQ(intersection(view.box, bounds), view.box);
    EXPECT_EQ(intersection(view.box, grown(box, kObjectMargin)), view.box);
  }
}

void expect_refused(const Sample& sample, const ObjectLabels& labels, ErrorKind kind,
                    const std::string& words) {
  try {
    (void)open_object(scaled(sample, {5}), labels, sample.box());
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

/// Visits in no order that cells have, and notes how many were to be visited at once.
VisitAtOnce shuffled(std::mt19937& random, int& most) {
  return [&](int threads, Index3 shape, const std::function<void(Index3)>& visit) {
    most = std::max(most, threads);
    std::vector<Index3> all;
    for_each_index(shape, [&](Index3 i) { all.push_back(i); });
    std::shuffle(all.begin(), all.end(), random);
    for (const Index3 i : all) visit(i);
  };
}

TEST(OpenObject, IsTheSameWhereSeveralCellsAreReadAtOnce) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Sample sample = random_sample(random);
    if (!has_all(sample, {kOne})) continue;
    int most = 0;
    ScaledVolume source = scaled(sample, {7, 3});
    dynamic_cast<MemoryVolume&>(*source.volume).set_far();
    source.at_once = shuffled(random, most);
    const ObjectView view = open_object(std::move(source), {kOne}, sample.box());
    EXPECT_EQ(most, 8);
    const ObjectView in_turn = open_object(scaled(sample, {7, 3}), {kOne}, sample.box());
    EXPECT_EQ(view.box, in_turn.box);
    std::vector<RawLabel> voxels(sample.voxels.size()), expected(sample.voxels.size());
    view.volume->read(sample.box(), voxels);
    in_turn.volume->read(sample.box(), expected);
    EXPECT_EQ(voxels, expected);
  }
}

TEST(OpenObject, ReadsFewerCellsAtOnceWhereMemoryIsLittle) {
  MemoryVolume volume({64, 64, 64}, {});
  constexpr std::uint64_t kCell = 16 * 16 * 16 * sizeof(RawLabel);
  EXPECT_EQ(cell_readers(volume, 1000 * kCell), 1);
  volume.set_far();
  EXPECT_EQ(cell_readers(volume, 1000 * kCell), 8);
  EXPECT_EQ(cell_readers(volume, 12 * kCell), 3);
  EXPECT_EQ(cell_readers(volume, kCell), 1);
}

TEST(OpenObject, RefusesWhatIsNotThere) {
  std::mt19937 random(3);
  const Sample sample = random_sample(random);
  expect_refused(sample, {0}, ErrorKind::kUsage, "label 0");
  expect_refused(sample, {kOne, 77}, ErrorKind::kInput, "77");
}

}  // namespace
}  // namespace mw::io
