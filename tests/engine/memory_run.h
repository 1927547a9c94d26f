// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A whole run in memory: small volume in, mesh out, for tests of the engine's promises.
#pragma once

#include "engine/run/run.h"
#include "io/mesh/mesh_data.h"
#include "tests/oracle/small_volumes.h"
#include "tests/testing.h"

namespace mw::engine::test {

using audit::Frame;
using audit::test::SmallMesh;
using audit::test::SmallVolume;

/// Raw labels of tests: sparse, so that the way to dense labels and back is part of the test.
[[nodiscard]] inline RawLabel raw_label(Label label) {
  return 1000003ULL * label + 17;
}
[[nodiscard]] inline Label test_label(RawLabel raw) {
  return static_cast<Label>((raw - 17) / 1000003ULL);
}

/// A SmallVolume as a file would show it.
class MemoryVolume : public io::LabelVolume {
 public:
  MemoryVolume(const SmallVolume& volume, const Frame& frame) : volume_(&volume) {
    info_.shape = volume.shape;
    info_.space.spacing = frame.spacing;
    info_.space.origin = frame.origin;
    info_.type = io::VoxelType::kU64;
    info_.format = "memory";
  }
  MemoryVolume(SmallVolume&& volume, const Frame& frame) = delete;  // the voxels are not kept

  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }

  void read(const Box3& box, std::span<RawLabel> out) const override {
    const Box3 all{{0, 0, 0}, volume_->shape};
    std::size_t next = 0;
    for (Index3 v = box.lo; v.z < box.hi.z; ++v.z) {
      for (v.y = box.lo.y; v.y < box.hi.y; ++v.y) {
        for (v.x = box.lo.x; v.x < box.hi.x; ++v.x) {
          ASSERT_TRUE(all.contains(v)) << "read outside the volume";
          out[next++] = raw_label(volume_->labels[static_cast<std::size_t>(all.offset(v))]);
        }
      }
    }
    EXPECT_EQ(next, out.size());
  }

 private:
  const SmallVolume* volume_;
  io::VolumeInfo info_;
};

/// Keeps what it receives, and holds the writer to the sink's protocol.
class MemorySink : public io::MeshSink {
 public:
  void begin(const io::MeshHeader& header) override {
    EXPECT_EQ(begun_++, 0);
    header_ = header;
    mesh_.labels_signed = header.labels_signed;
  }
  void write_vertices(std::span<const io::Position> positions) override {
    EXPECT_TRUE(begun_ == 1 && finished_ == 0);
    mesh_.vertices.insert(mesh_.vertices.end(), positions.begin(), positions.end());
  }
  void write_tets(std::span<const io::TetRows> tets, std::span<const RawLabel> labels) override {
    EXPECT_EQ(tets.size(), labels.size());
    for (const io::TetRows& tet : tets) {
      for (const std::uint64_t row : tet) ASSERT_LT(row, mesh_.vertices.size());
    }
    mesh_.tets.insert(mesh_.tets.end(), tets.begin(), tets.end());
    mesh_.labels.insert(mesh_.labels.end(), labels.begin(), labels.end());
  }
  void finish() override {
    EXPECT_EQ(finished_++, 0);
    EXPECT_EQ(mesh_.tets.size(), header_.tets);
  }

  /// REQUIRES: finished.
  [[nodiscard]] const io::MeshData& mesh() const {
    EXPECT_EQ(finished_, 1);
    return mesh_;
  }

 private:
  io::MeshHeader header_;
  io::MeshData mesh_;
  int begun_ = 0;
  int finished_ = 0;
};

/// Everything that decides about a run's result.
struct Trial {
  SmallVolume volume;
  MeshSettings settings;
  Frame frame;

  [[nodiscard]] std::string text() const {
    const auto optional = [](const std::optional<double>& value) {
      return value ? std::to_string(*value) : "none";
    };
    return volume.text() + " window " + std::to_string(settings.window) + " edge variance " +
           optional(settings.edge_variance) + " floor " + std::to_string(settings.quality_floor) +
           " distance " + optional(settings.max_distance) + " target " +
           optional(settings.target_reduction) +
           (settings.start == StartMesh::kDense    ? " dense"
            : settings.start == StartMesh::kOctree ? " octree"
                                                   : " coarse") +
           (settings.order == Order::kRaster ? " raster" : " colour") + " marches " +
           std::to_string(settings.marches) +
           (settings.topology == KeptTopology::kInterfaces ? " interfaces" : "") +
           (settings.optimizer == Optimizer::kNone ? " not optimised" : " optimised") +
           (settings.surface == Surface::kVoxel ? " voxel surface" : "") + " spacing " +
           std::to_string(frame.spacing[0]) + "," + std::to_string(frame.spacing[1]) + "," +
           std::to_string(frame.spacing[2]);
  }
};

/// A run whose mesh goes to the sink.
inline RunReport run_into(io::MeshSink& sink, const Trial& trial, const RunHooks& hooks = {}) {
  const MemoryVolume volume(trial.volume, trial.frame);
  const io::LabelTable table = io::collect_labels(volume);
  return mesh_volume(io::DenseVolume(volume, table), trial.settings, sink, hooks);
}

inline io::MeshData run_in_memory(const Trial& trial, const RunHooks& hooks = {}) {
  MemorySink sink;
  const RunReport report = run_into(sink, trial, hooks);
  EXPECT_EQ(report.vertices, sink.mesh().vertices.size());
  EXPECT_EQ(report.tets, sink.mesh().tets.size());
  return sink.mesh();
}

inline void expect_same(const io::MeshData& actual, const io::MeshData& expected) {
  EXPECT_TRUE(actual.vertices == expected.vertices);
  EXPECT_TRUE(actual.tets == expected.tets);
  EXPECT_TRUE(actual.labels == expected.labels);
  EXPECT_EQ(actual.labels_signed, expected.labels_signed);
}

/// The mesh with the labels of the SmallVolume, as audit and oracle read it.
[[nodiscard]] inline SmallMesh small_mesh(const io::MeshData& mesh) {
  SmallMesh out{mesh.vertices, mesh.tets, {}};
  for (const RawLabel raw : mesh.labels) {
    EXPECT_EQ(raw_label(test_label(raw)), raw);
    out.labels.push_back(test_label(raw));
  }
  return out;
}

/// All settings that tests vary, at random; frames are isotropic.
[[nodiscard]] inline Trial random_trial(std::mt19937& random, SmallVolume volume) {
  using audit::test::below;
  constexpr std::array<int, 5> kWindows{4, 6, 8, 12, 16};
  constexpr std::array<double, 4> kFloors{0.1, 0.05, 0.2, 0.3};
  constexpr std::array<StartMesh, 4> kStarts{StartMesh::kDense, StartMesh::kOctree,
                                             StartMesh::kCoarse, StartMesh::kCoarse};
  constexpr std::array<std::optional<double>, 3> kDistances{std::nullopt, 1.5, 1.0};
  Trial trial{.volume = std::move(volume), .settings = {}, .frame = {}};
  trial.settings.window = kWindows[below(random, 5)];
  trial.settings.marches = static_cast<int>(1 + below(random, 3));
  trial.settings.start = kStarts[below(random, 4)];
  trial.settings.order = below(random, 3) == 0 ? Order::kColour : Order::kRaster;
  trial.settings.optimizer = below(random, 3) != 0 ? Optimizer::kLocal : Optimizer::kNone;
  if (below(random, 3) == 0) trial.settings.edge_variance = 0.1;
  trial.settings.quality_floor = kFloors[below(random, 4)];
  trial.settings.max_distance = kDistances[below(random, 3)];
  if (below(random, 6) == 0) trial.settings.target_reduction = 0.3;
  if (below(random, 4) == 0) trial.settings.surface = Surface::kVoxel;
  if (below(random, 2) == 0) trial.frame = {{0.25, 0.25, 0.25}, {-3, 100, 0.5}};
  return trial;
}

}  // namespace mw::engine::test
