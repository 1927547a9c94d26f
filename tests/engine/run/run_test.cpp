// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The library's face: settings refused, progress told, report and labels right.
#include "engine/run/run.h"

#include "tests/engine/memory_run.h"
#include "tests/expect_error.h"

namespace mw::engine {
namespace {

using audit::test::volume_from;
using namespace test;

Trial small_trial() {
  return {.volume = volume_from({9, 6, 5}, 3, [](auto x, auto y, auto) { return (x / 3 + y) % 3; }),
          .settings = {.window = 4, .marches = 2},
          .frame = {}};
}

void expect_refused(const MeshSettings& settings, const std::string& name) {
  expect_error(ErrorKind::kUsage, {name}, [&] { check(settings); });
}

TEST(MeshSettings, RefusesWhatIsNotAllowedByName) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (int window : {-4, 0, 2, 5, 33, 1000}) expect_refused({.window = window}, "window");
  for (int marches : {-1, 0, 100}) expect_refused({.marches = marches}, "marches");
  for (double floor : {-0.1, 0.51, kNan}) {
    expect_refused({.quality_floor = floor}, "quality-floor");
  }
  for (double tau : {0.0, -1.0, kNan}) expect_refused({.edge_variance = tau}, "edge-variance");
  for (double d : {0.0, -1.0, kNan}) expect_refused({.max_distance = d}, "max-distance");
  EXPECT_NO_THROW(check({}));
  EXPECT_NO_THROW(check(
      {.window = 4, .edge_variance = 0.03, .quality_floor = 0.0, .max_distance = std::nullopt}));
}

TEST(MeshVolume, ChecksItsSettings) {
  Trial trial = small_trial();
  trial.settings.window = 7;
  test::MemorySink sink;
  EXPECT_THROW(run_into(sink, trial), Error);
}

TEST(MeshVolume, TellsProgressAfterEveryWindow) {
  const Trial trial = small_trial();
  // Two marches, the second with windows twice as large.
  const auto windows = [&](int window) {
    return static_cast<std::uint64_t>(WindowGrid(trial.volume.shape, window).windows().product());
  };
  const std::uint64_t total = windows(4) + windows(8);
  std::vector<std::uint64_t> told;
  run_in_memory(trial, {.progress =
                            [&](const RunProgress& at) {
                              EXPECT_EQ(at.total, total);
                              told.push_back(at.done);
                            },
                        .pick = {}});
  // Also while the blocks are read for output, so that a run can be stopped then.
  ASSERT_GT(told.size(), total);
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i], std::min(i + 1, total));
}

TEST(MeshVolume, StopsWhenProgressThrows) {
  const OnProgress stop = [](const RunProgress& at) {
    if (at.done == 3) throw Error(ErrorKind::kInternal, "stopped");
  };
  EXPECT_THROW(run_in_memory(small_trial(), {.progress = stop, .pick = {}}), Error);
}

TEST(MeshVolume, WritesTheLabelsOfTheInput) {
  const io::MeshData mesh = run_in_memory(small_trial());
  EXPECT_EQ(std::set<RawLabel>(mesh.labels.begin(), mesh.labels.end()),
            (std::set<RawLabel>{raw_label(0), raw_label(1), raw_label(2)}));
  EXPECT_FALSE(mesh.labels_signed);
}

/// Spacing and origin scale and shift the result, exactly for powers of two; nothing else changes.
TEST(MeshVolume, FollowsTheFrameOfTheVolume) {
  Trial trial = small_trial();
  const io::MeshData unit = run_in_memory(trial);
  trial.frame = {{0.5, 0.5, 0.5}, {-4, 16, 8}};
  const io::MeshData scaled = run_in_memory(trial);
  EXPECT_TRUE(scaled.tets == unit.tets);
  EXPECT_TRUE(scaled.labels == unit.labels);
  ASSERT_EQ(scaled.vertices.size(), unit.vertices.size());
  for (std::size_t v = 0; v < unit.vertices.size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(scaled.vertices[v][k], trial.frame.origin[k] + 0.5 * unit.vertices[v][k]);
    }
  }
}

}  // namespace
}  // namespace mw::engine
