// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whole runs on small volumes, held against promises 1 to 3.
#pragma once

#include "kernels/core/lattice.h"
#include "tests/engine/memory_run.h"
#include "tests/oracle/cell_complex.h"
#include "tests/oracle/pinches.h"
#include "tests/oracle/whole_audit.h"

namespace mw::engine::test {

using audit::RegionBetti;
using audit::test::below;
using audit::test::betti_of;
using audit::test::complex_of;
using audit::test::random_kind;
using audit::test::random_shape;
using audit::test::random_volume_of;
using audit::test::volume_from;
using audit::test::VolumeKind;

inline constexpr double kRounding = 1e-9;

/// Who counts Betti numbers: ranks of boundary matrices, or the faster audit (itself tested so).
enum class Counter { kRanks, kAudit };

inline void expect_same_topology(const SmallVolume& volume, const SmallMesh& mesh,
                                 Counter counter) {
  const std::size_t n = volume.label_count;
  const bool ranks = counter == Counter::kRanks;
  const std::vector<RegionBetti> expected = ranks ? betti_of(complex_of(volume.view(), n), n)
                                                  : audit::test::voxel_betti(volume.view(), n);
  const std::vector<RegionBetti> actual =
      ranks ? betti_of(complex_of(mesh.view(), n), n) : mesh_betti(mesh.view(), n);
  for (std::size_t label = 0; label <= n; ++label) {
    EXPECT_TRUE(actual[label] == expected[label]) << "label " << label << " of " << n;
  }
}

/// No label has more pinched edges or vertices than its voxels, cut into the layers that the mesh
/// is made from.
inline void expect_no_new_pinches(const Trial& trial, const SmallMesh& mesh) {
  const SmallVolume& volume = trial.volume;
  const Index3 layers = layers_of(trial.frame.spacing);
  const Box3 all{{0, 0, 0}, volume.shape};
  const SmallVolume lattice = volume_from(
      layered_shape(volume.shape, layers), volume.label_count, [&](auto x, auto y, auto z) {
        const Index3 voxel{x / layers.x, y / layers.y, z / layers.z};
        return volume.labels[static_cast<std::size_t>(all.offset(voxel))];
      });
  audit::test::PinchedByLabel voxels = audit::test::pinches_of(lattice.view());
  for (const auto& [label, pinched] : audit::test::pinches_of(mesh.view())) {
    EXPECT_LE(pinched.vertices.size(), voxels[label].vertices.size()) << "label " << label;
    EXPECT_LE(pinched.edges.size(), voxels[label].edges.size()) << "label " << label;
  }
}

inline void expect_valid(const Trial& trial, const SmallMesh& mesh) {
  const auto report = audit::test::check_validity(mesh.view(), trial.volume.view(), trial.frame,
                                                  trial.volume.label_count);
  for (const audit::Check& c : report.checks) EXPECT_TRUE(c.passed) << c.name << ": " << c.detail;
}

inline void expect_floor(const Trial& trial, const SmallMesh& mesh) {
  EXPECT_GE(audit::test::measure_quality(mesh.view()).radius_ratio_min,
            trial.settings.quality_floor - kRounding);
}

/// Checks P1 to P3.
inline void expect_promises(const Trial& trial, const SmallMesh& mesh, Counter counter) {
  expect_same_topology(trial.volume, mesh, counter);
  expect_no_new_pinches(trial, mesh);
  expect_valid(trial, mesh);
  expect_floor(trial, mesh);
}

/// Meshes the volume and checks P1 to P3; returns the number of vertices.
inline std::size_t expect_promises(const Trial& trial, Counter counter) {
  SCOPED_TRACE(trial.text());
  const SmallMesh mesh = small_mesh(run_in_memory(trial));
  expect_promises(trial, mesh, counter);
  return mesh.vertices.size();
}

inline SmallVolume random_small(std::mt19937& random, std::uint32_t min, std::uint32_t max,
                                std::uint32_t labels) {
  const Index3 shape = random_shape(random, min, max);
  const VolumeKind kind = random_kind(random);
  return random_volume_of(random, kind, shape, 1 + below(random, labels));
}

inline std::int64_t corners(Index3 shape) {
  return (shape + Index3{1, 1, 1}).product();
}

}  // namespace mw::engine::test
