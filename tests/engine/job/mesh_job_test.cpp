// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels that change under a run end it with one error, whenever they do.
#include "engine/job/mesh_job.h"

#include "kernels/core/error.h"
#include "tests/engine/memory_run.h"
#include "tests/expect_error.h"
#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using namespace test;

/// Has the labels of one volume until `voxels` voxels have been read, then those of another.
class ChangingVolume : public MemoryVolume {
 public:
  ChangingVolume(const MemoryVolume& before, const MemoryVolume& after, std::int64_t voxels)
      : MemoryVolume(before), after_(after), left_(voxels) {}

  void read(const Box3& box, std::span<RawLabel> out) const override {
    const bool has_changed = left_.fetch_sub(box.voxels()) <= 0;
    has_changed ? after_.read(box, out) : MemoryVolume::read(box, out);
  }

 private:
  const MemoryVolume& after_;
  mutable std::atomic<std::int64_t> left_;
};

/// Returns what a run says when labels change after `readings` readings of the whole volume.
std::string said(const audit::test::SmallVolume& before, const audit::test::SmallVolume& after,
                 double readings, const io::InputSteps& steps = {}) {
  const ::mw::test::TempFolder folder;
  const MemoryVolume first(before, {});
  const MemoryVolume second(after, {});
  const auto voxels = static_cast<double>(before.shape.product());
  const ChangingVolume volume(first, second, static_cast<std::int64_t>(readings * voxels));
  MeshJob job;
  job.steps = steps;
  job.folder = folder.path();
  job.run.threads = 2;
  job.run.store.memory = std::uint64_t{1} << 30U;
  MemorySink sink;
  try {
    static_cast<void>(mesh(volume, job, std::array<io::MeshSink*, 1>{&sink}));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    return error.what();
  }
  return "";
}

constexpr const char* kChanged = "changed while it was read";

class MeshJobTest : public testing::Test {
 protected:
  const audit::test::SmallVolume volume_ = audit::test::volume_from(
      {20, 18, 16}, 4, [](auto x, auto y, auto z) { return (x > 9) + (y + z > 17); });
};

TEST_F(MeshJobTest, RefusesNewLabelsInEachLaterReading) {
  auto other = volume_;
  for (Label& label : other.labels) label += 40'000;
  for (const double readings : {1.0, 1.5, 2.0}) {
    EXPECT_NE(said(volume_, other, readings).find(kChanged), std::string::npos) << readings;
  }
  auto one = volume_;
  one.labels[1234] = 3;
  for (const double readings : {1.0, 2.0}) {
    EXPECT_NE(said(volume_, one, readings).find(kChanged), std::string::npos) << readings;
  }
}

/// They are in the table, so only the check of the mesh finds them.
/// Counts the voxels that are read.
class CountedVolume : public MemoryVolume {
 public:
  using MemoryVolume::MemoryVolume;
  void read(const Box3& box, std::span<RawLabel> out) const override {
    voxels += box.voxels();
    MemoryVolume::read(box, out);
  }

  mutable std::atomic<std::int64_t> voxels = 0;
};

/// Refuses the mesh when all work is done.
class RefusingSink : public MemorySink {
 public:
  void begin(const io::MeshHeader& /*header*/) override { io::fail_usage("refused"); }
};

/// A pilot would read the volume again.
TEST_F(MeshJobTest, RefusesWorkOfAnotherRunBeforeThePilotOfACount) {
  const ::mw::test::TempFolder folder;
  const CountedVolume volume(volume_, {});
  MeshJob job;
  job.folder = folder.path();
  job.run.threads = 1;
  job.run.store = {.memory = std::uint64_t{1} << 30U, .workdir = folder.path() / "work"};
  RefusingSink refuses;
  EXPECT_THROW(static_cast<void>(mesh(volume, job, std::array<io::MeshSink*, 1>{&refuses})), Error);
  ASSERT_TRUE(std::filesystem::exists(job.run.store.workdir / "journal"));
  job.settings.sizes.count = 3000;
  for (const bool resume : {false, true}) {
    volume.voxels = 0;
    job.run.store.resume = resume;
    MemorySink sink;
    expect_error(ErrorKind::kUsage, {"work", resume ? "count was 0 and is 3000" : "--resume"}, [&] {
      static_cast<void>(mesh(volume, job, std::array<io::MeshSink*, 1>{&sink}));
    });
    EXPECT_LE(volume.voxels, volume_.shape.product());
  }
}

TEST_F(MeshJobTest, TellsPermutedLabelsFromAWrongMesh) {
  auto other = volume_;
  for (Label& label : other.labels) label = 2 - label;
  for (const double readings : {1.5, 2.0}) {
    EXPECT_NE(said(volume_, other, readings).find(kChanged), std::string::npos) << readings;
  }
  EXPECT_EQ(said(volume_, volume_, 2.0), "");
}

TEST_F(MeshJobTest, RefusesSpecksThatAreGone) {
  auto other = volume_;
  for (const std::size_t at : {100U, 2000U, 4000U}) other.labels[at] = 3;
  io::InputSteps steps;
  steps.specks = io::SpeckRule{.min = 5};
  EXPECT_NE(said(other, volume_, 1.0, steps).find(kChanged), std::string::npos);
}

}  // namespace
}  // namespace mw::engine
