// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Passes over a finished mesh: each by itself, against a mesh that was made so, or a brute force.
#include "engine/finish/passes.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "engine/finish/sample.h"
#include "engine/finish/select_labels.h"
#include "io/mesh/mesh_data.h"
#include "io/mesh/open_mesh.h"
#include "tests/engine/memory_run.h"
#include "tests/io/mesh/mesh_digest.h"
#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using namespace audit::test;
using namespace test;
using ::mw::test::content_of;
using ::mw::test::TempFolder;

io::MeshData copied(io::ScratchMesh& mesh) {
  io::MeshDataSink out;
  mesh.copy_to(out);
  return std::move(out.mesh());
}

void fill(io::ScratchMesh& mesh, const io::MeshData& data) {
  io::ScratchMeshSink into(mesh);
  io::write_mesh(data, into);
}

/// A mesh without a label is the one that a run without that label writes.
TEST(SelectLabels, LeavesTheMeshThatARunLeaves) {
  std::mt19937 random(411);
  std::size_t left_out = 0;
  for (std::uint32_t i = 0; i < 12 && !HasFailure(); ++i) {
    const auto kind = static_cast<VolumeKind>(i % kVolumeKinds);
    const Trial trial =
        random_trial(random, random_volume_of(random, kind, random_shape(random, 6, 14), 4));
    SCOPED_TRACE(trial.text());
    const auto& labels = trial.volume.labels;
    const RawLabel label = raw_label(labels.front());
    if (std::count(labels.begin(), labels.end(), labels.front()) == std::ssize(labels)) continue;
    io::MeshDataSink whole, chosen;
    run_into(whole, trial);
    RunHooks hooks;
    hooks.output.wanted = [label](RawLabel l) { return l != label; };
    run_into(chosen, trial, hooks);
    const TempFolder folder;
    io::ScratchMesh mesh(folder.path());
    fill(mesh, whole.mesh());
    select_labels(mesh, {.background = label}, [] {});
    const io::MeshData left = copied(mesh);
    EXPECT_EQ(io::mesh_digest(left), io::mesh_digest(chosen.mesh()));
    EXPECT_EQ(left.record, chosen.mesh().record);
    left_out += whole.mesh().tets.size() - left.tets.size();
  }
  EXPECT_GT(left_out, 100U);
}

/// Values are those of single tets, whatever the order of tets, and come behind earlier ones.
TEST(Sample, GivesEachTetTheValueThatItHasAlone) {
  std::mt19937 random(412);
  SmallVolume numbers{.shape = {150, 9, 70}};
  numbers.labels.resize(static_cast<std::size_t>(numbers.shape.product()));
  std::iota(numbers.labels.begin(), numbers.labels.end(), 0);
  const auto image = std::make_shared<MemoryVolume>(numbers, Frame{});
  SmallVolume labels{.shape = numbers.shape, .label_count = 1};
  labels.labels.resize(numbers.labels.size());
  const MemoryVolume volume(labels, {});
  io::MeshData data;
  data.values = {{"number", {}}};
  for (int t = 0; t < 300; ++t) {
    const auto within = [&](std::int64_t most) {
      return static_cast<double>(below(random, static_cast<std::uint32_t>(most - 4)));
    };
    const io::Position at{within(150), within(9), within(70)};
    const std::uint64_t row = data.vertices.size();
    data.vertices.insert(
        data.vertices.end(),
        {at, {at[0] + 3, at[1], at[2]}, {at[0], at[1] + 3, at[2]}, {at[0], at[1], at[2] + 3}});
    data.tets.push_back({row, row + 1, row + 2, row + 3});
    data.labels.push_back(0);
    data.values[0].numbers.push_back(t);
  }
  for (const Statistic statistic : {Statistic::kMean, Statistic::kMode}) {
    const std::vector<SampleImage> images{{.name = "x", .statistic = statistic, .image = image}};
    ImageSampler sampler(images, volume.info(), 2), alone(images, volume.info(), 1);
    const TempFolder folder;
    io::ScratchMesh mesh(folder.path());
    fill(mesh, data);
    sample(mesh, sampler, 1 << 12, [] {});
    const io::MeshData found = copied(mesh);
    ASSERT_EQ(found.values.size(), 2U);
    EXPECT_EQ(found.values[0].numbers, data.values[0].numbers);
    EXPECT_EQ(found.values[1].name, "x");
    for (std::size_t t = 0; t < data.tets.size(); ++t) {
      const std::vector<double> expected =
          alone.of(std::span(data.vertices).subspan(data.tets[t][0], 4),
                   std::vector{io::TetRows{0, 1, 2, 3}});
      EXPECT_EQ(found.values[1].numbers.at(t), expected.at(0)) << t;
    }
  }
}

/// The files of a mesh that the pass has curved are those of a sink that finds the curves itself.
TEST(Curve, GivesWritersTheNodesThatTheyWouldFind) {
  std::mt19937 random(412);
  const TempFolder folder;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const Trial trial =
        random_trial(random, random_volume_of(random, static_cast<VolumeKind>(i), {10, 9, 8}, 3));
    io::MeshDataSink made;
    run_into(made, trial);
    const auto path = [&](const char* name) { return folder.path() / name; };
    io::write_mesh(made.mesh(), *io::open_mesh_sink(path("a.vtu"), io::Element::kCurvedTet10));
    io::ScratchMesh mesh(folder.path());
    fill(mesh, made.mesh());
    const auto curved = io::open_mesh_sink(path("b.vtu"), io::Element::kCurvedTet10);
    io::MeshDataSink straight;
    const std::array<io::MeshSink*, 2> sinks{&straight, &*curved};
    FinishTask task;
    task.is_curved = true;
    static_cast<void>(apply_passes(mesh, task, sinks));
    ASSERT_NE(mesh.curved_nodes(), nullptr);
    EXPECT_GT(mesh.curved_nodes()->size(), mesh.vertex_count());
    EXPECT_TRUE(content_of(path("a.vtu")) == content_of(path("b.vtu")));
    EXPECT_EQ(straight.mesh().vertices, made.mesh().vertices);
    EXPECT_FALSE(straight.mesh().record.curved);
  }
}

/// A sink that tells when it is finished.
class ToldSink : public io::NoSink {
 public:
  ToldSink(std::vector<int>& told, int number) : told_(told), number_(number) {}
  void finish() override { told_.push_back(number_); }

 private:
  std::vector<int>& told_;
  int number_;
};

/// No sink gets a mesh that a pass refuses; else all get it, the last one last.
TEST(Passes, SinksGetTheMeshBehindAllOfThem) {
  io::MeshData data;
  data.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  data.tets = {{0, 1, 2, 3}};
  data.labels = {7};
  const TempFolder folder;
  for (const std::uint64_t least : {1U, 2U}) {
    std::vector<int> told;
    ToldSink first(told, 1), second(told, 2);
    FinishTask task;
    task.connect.options.parts.least_tets = least;
    io::ScratchMesh mesh(folder.path());
    const std::array<io::MeshSink*, 2> sinks{&first, &second};
    fill(mesh, data);
    if (least == 2) {
      EXPECT_THROW(static_cast<void>(apply_passes(mesh, task, sinks)), Error);
      EXPECT_TRUE(told.empty());
      continue;
    }
    const FinishFacts facts = apply_passes(mesh, task, sinks);
    EXPECT_EQ(told, (std::vector{1, 2}));
    EXPECT_EQ(facts.tets, 1U);
    EXPECT_EQ(facts.connected.value().found, 1U);
  }
}

}  // namespace
}  // namespace mw::engine
