// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One thread has several reads of a volume far away under way, and gets the same labels.
#include "engine/labels/shared_reads.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <numeric>

#include "io/labels/prepared_input.h"
#include "tests/io/labels/memory_volume.h"

namespace mw::engine {
namespace {

constexpr std::uint64_t kBudget = std::uint64_t{256} << 20U;

/// Each read waits until two are under way, as long as it is to be met.
class MeetingVolume : public io::VolumeView {
 public:
  using VolumeView::VolumeView;

  void read(const Box3& box, std::span<RawLabel> out) const override {
    {
      std::unique_lock lock(mutex_);
      ++reads_;
      changed_.notify_all();
      const auto is_met = [this] { return !is_to_meet_ || reads_ > 1; };
      if (!changed_.wait_for(lock, std::chrono::seconds(20), is_met)) {
        throw std::runtime_error("alone");
      }
    }
    below().read(box, out);
  }
  void meet(bool is_to_meet) {
    is_to_meet_ = is_to_meet;
    reads_ = 0;
  }
  [[nodiscard]] int reads() const { return reads_; }

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  mutable int reads_ = 0;
  bool is_to_meet_ = true;
};

io::MemoryVolume far_volume(io::VoxelType type = io::VoxelType::kU64) {
  constexpr Index3 kShape{40, 33, 20};
  std::vector<RawLabel> labels(static_cast<std::size_t>(kShape.product()));
  std::iota(labels.begin(), labels.end(), RawLabel{1});
  io::MemoryVolume out(kShape, type, std::move(labels));
  out.info().is_far = true;
  out.info().chunk = {16, 16, 16};
  return out;
}

std::vector<RawLabel> read_all(const io::LabelVolume& volume, const Box3& box) {
  std::vector<RawLabel> out(static_cast<std::size_t>(box.voxels()));
  volume.read(box, out);
  return out;
}

TEST(SharedReads, SeveralThreadsReadALargeBox) {
  const io::MemoryVolume labels = far_volume();
  const MeetingVolume volume(labels);
  const SharedReads shared(volume, kBudget);
  const Box3 box{{3, 5, 7}, {38, 33, 9}};
  EXPECT_EQ(read_all(shared, box), read_all(labels, box));
  EXPECT_EQ(volume.reads(), 3 * 3);
}

TEST(SharedReads, AThreadReadsAloneAfterTheEnd) {
  const io::MemoryVolume labels = far_volume();
  MeetingVolume volume(labels);
  volume.meet(false);
  SharedReads shared(volume, kBudget);
  shared.end();
  const Box3 box{{0, 0, 0}, labels.info().shape};
  EXPECT_EQ(read_all(shared, box), labels.labels());
  EXPECT_EQ(volume.reads(), 1);
}

/// What is near, what may be no label, and what a little budget has no room for.
TEST(SharedReads, OtherVolumesAreReadAsTheyAre) {
  io::MemoryVolume near = far_volume();
  near.info().is_far = false;
  for (const io::MemoryVolume& labels : {near, far_volume(io::VoxelType::kF32), far_volume()}) {
    MeetingVolume volume(labels);
    volume.meet(false);
    const bool is_budget_little = labels.info().is_far && !is_float(labels.info().type);
    const SharedReads shared(volume, is_budget_little ? 1 << 20 : kBudget);
    (void)read_all(shared, {{0, 0, 0}, labels.info().shape});
    EXPECT_EQ(volume.reads(), 1);
  }
}

TEST(SharedReads, SpecksAndWeldsAreLookedForByThem) {
  const io::MemoryVolume labels = far_volume();
  MeetingVolume volume(labels);
  const SharedReads shared(volume, kBudget);
  for (const io::InputSteps& steps :
       {io::InputSteps{.merge = {}, .specks = io::SpeckRule{1}, .weld = {}},
        io::InputSteps{.merge = {}, .specks = {}, .weld = {1}}}) {
    volume.meet(true);
    EXPECT_NO_THROW(io::PreparedInput(shared, steps));
    EXPECT_GT(volume.reads(), 1);
  }
}

}  // namespace
}  // namespace mw::engine
