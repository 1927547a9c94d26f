// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cells that repeat themselves: P1 to P3 and P5 hold, opposite faces match, and the labels of the
// torus keep their topology, too.
#include "tests/promises/whole_runs.h"

namespace mw::engine {
namespace {

using namespace test;
using namespace audit::test;

constexpr unsigned kAllAxes = 7;

/// The places of a triangle's corners along the two axes of its face, ascending.
using FaceTriangle = std::array<std::array<double, 2>, 3>;

/// Returns the triangles of tets with all three corners at a place along an axis.
std::multiset<FaceTriangle> triangles_at(const SmallMesh& mesh, unsigned axis, double place) {
  std::multiset<FaceTriangle> out;
  for (const auto& tet : mesh.tets) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      FaceTriangle triangle;
      std::size_t on_face = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const auto& p = mesh.vertices[tet[i]];
        if (i == left_out || p[axis] != place) continue;
        triangle[on_face++] = {p[(axis + 1) % 3], p[(axis + 2) % 3]};
      }
      if (on_face < 3) continue;
      std::sort(triangle.begin(), triangle.end());
      out.insert(triangle);
    }
  }
  return out;
}

double end_of(const Trial& trial, unsigned axis) {
  const Index3 s = trial.volume.shape;
  const std::int64_t voxels = axis == 0 ? s.x : axis == 1 ? s.y : s.z;
  return trial.frame.origin[axis] + trial.frame.spacing[axis] * static_cast<double>(voxels);
}

/// Returns how many triangles the faces of periodic axes have.
std::size_t expect_matching_faces(const Trial& trial, const SmallMesh& mesh) {
  std::size_t count = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    if ((trial.settings.periodic >> axis & 1U) == 0) continue;
    const auto low = triangles_at(mesh, axis, trial.frame.origin[axis]);
    EXPECT_TRUE(low == triangles_at(mesh, axis, end_of(trial, axis))) << "axis " << axis;
    EXPECT_FALSE(low.empty());
    count += low.size();
  }
  return count;
}

/// Returns the mesh of two cells side by side along an axis, whose common nodes are one.
SmallMesh two_cells(const Trial& trial, const SmallMesh& cell, unsigned axis) {
  SmallMesh out = cell;
  const double low = trial.frame.origin[axis], high = end_of(trial, axis);
  std::map<audit::Position, std::uint64_t> at_high;
  for (std::uint64_t v = 0; v < cell.vertices.size(); ++v) {
    if (cell.vertices[v][axis] == high) at_high.emplace(cell.vertices[v], v);
  }
  std::vector<std::uint64_t> row;
  for (auto p : cell.vertices) {
    const bool is_common = p[axis] == low;
    p[axis] = is_common ? high : p[axis] + (high - low);
    row.push_back(is_common ? at_high.at(p) : out.vertices.size());
    if (!is_common) out.vertices.push_back(p);
  }
  for (std::size_t t = 0; t < cell.tets.size(); ++t) {
    auto tet = cell.tets[t];
    for (auto& v : tet) v = row[v];
    out.tets.push_back(tet);
    out.labels.push_back(cell.labels[t]);
  }
  return out;
}

SmallVolume two_cells(const SmallVolume& cell, unsigned axis) {
  Index3 shape = cell.shape;
  (axis == 0 ? shape.x : axis == 1 ? shape.y : shape.z) *= 2;
  const Box3 all{{0, 0, 0}, cell.shape};
  return volume_from(shape, cell.label_count, [&](auto x, auto y, auto z) {
    const Index3 voxel{x % cell.shape.x, y % cell.shape.y, z % cell.shape.z};
    return cell.labels[static_cast<std::size_t>(all.offset(voxel))];
  });
}

Trial periodic_trial(std::mt19937& random, std::uint32_t max_half) {
  Index3 shape = random_shape(random, 1, max_half);
  shape = {2 * shape.x, 2 * shape.y, 2 * shape.z};
  Trial trial = random_trial(
      random, random_volume_of(random, random_kind(random), shape, 1 + below(random, 5)));
  trial.settings.edge_variance.reset();
  trial.settings.target_reduction.reset();
  trial.settings.periodic = below(random, 2) == 0 ? kAllAxes : 1 + below(random, 6);
  if (below(random, 4) == 0) trial.settings.topology = KeptTopology::kInterfaces;
  return trial;
}

TEST(Periodic, PromisesHoldAndFacesMatch) {
  std::mt19937 random(951);
  std::size_t triangles = 0, of_voxels = 0;
  for (int i = 0; i < 250 && !HasFailure(); ++i) {
    const Trial trial = periodic_trial(random, i % 10 == 0 ? 12 : 6);
    SCOPED_TRACE(trial.text() + " axes " + std::to_string(trial.settings.periodic));
    const SmallMesh mesh = small_mesh(run_in_memory(trial));
    expect_promises(trial, mesh, Counter::kAudit);
    triangles += expect_matching_faces(trial, mesh);
    const Index3 s = trial.volume.shape;
    const std::array<std::int64_t, 3> faces{s.y * s.z, s.x * s.z, s.x * s.y};
    for (unsigned axis = 0; axis < 3; ++axis) {
      if ((trial.settings.periodic >> axis & 1U) != 0) {
        of_voxels += static_cast<std::size_t>(2 * faces[axis]);
      }
    }
  }
  EXPECT_LT(triangles, of_voxels * 9 / 10) << "the faces were not simplified";
}

/// Two cells side by side show each label as it runs on through a face.
TEST(Periodic, LabelsKeepTheirTopologyThroughFaces) {
  std::mt19937 random(952);
  for (int i = 0; i < 120 && !HasFailure(); ++i) {
    Trial trial = periodic_trial(random, 5);
    const unsigned axis = below(random, 3);
    trial.settings.periodic = 1U << axis;
    SCOPED_TRACE(trial.text());
    const SmallMesh mesh = two_cells(trial, small_mesh(run_in_memory(trial)), axis);
    expect_same_topology(two_cells(trial.volume, axis), mesh, Counter::kAudit);
  }
}

/// Voronoi cells on a torus: lines of the faces are no denser than those inside.
TEST(Periodic, FacesAreAsCoarseAsTheRest) {
  const Index3 shape{48, 48, 48};
  std::mt19937 random(953);
  const SmallVolume cell = random_volume_of(random, VolumeKind::kBlobs, {24, 24, 24}, 6);
  const Box3 all{{0, 0, 0}, cell.shape};
  const auto mirrored = [](std::int64_t v) { return v < 24 ? v : 47 - v; };
  Trial trial{.volume = volume_from(shape, cell.label_count,
                                    [&](auto x, auto y, auto z) {
                                      const Index3 v{mirrored(x), mirrored(y), mirrored(z)};
                                      return cell.labels[static_cast<std::size_t>(all.offset(v))];
                                    }),
              .settings = {},
              .frame = {}};
  const std::size_t plain = run_in_memory(trial).vertices.size();
  trial.settings.periodic = kAllAxes;
  const std::size_t periodic = run_in_memory(trial).vertices.size();
  EXPECT_LT(periodic, plain * 5 / 4);
}

/// Returns the volumes of labels.
std::vector<double> volumes_of(const SmallMesh& mesh, std::size_t labels) {
  std::vector<double> out(labels, 0.0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::array<Vec3, 3> edges;
    const auto& o = mesh.vertices[mesh.tets[t][0]];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& p = mesh.vertices[mesh.tets[t][i + 1]];
      edges[i] = Vec3(p[0] - o[0], p[1] - o[1], p[2] - o[2]);
    }
    out[mesh.labels[t]] += std::abs(edges[0].dot(edges[1].cross(edges[2]))) / 6.0;
  }
  return out;
}

/// Flat interfaces stay where they are, at even and at odd places.
TEST(Periodic, LaminatesAreExact) {
  std::mt19937 random(955);
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    Index3 shape{2 * (4 + below(random, 9)), 2 * (4 + below(random, 9)),
                 2 * (4 + below(random, 9))};
    const unsigned axis = below(random, 3);
    const auto voxels = static_cast<std::uint32_t>(along(shape, axis));
    const std::int64_t begin = below(random, voxels), end = begin + 1 + below(random, voxels);
    Trial trial{.volume = volume_from(shape, 2,
                                      [&](auto x, auto y, auto z) {
                                        const std::int64_t at = along(Index3{x, y, z}, axis);
                                        return at >= begin && at < end ? 1U : 0U;
                                      }),
                .settings = {},
                .frame = {}};
    trial.settings.periodic = 1 + below(random, 7);
    SCOPED_TRACE(trial.text() + " axes " + std::to_string(trial.settings.periodic));
    const std::vector<double> volumes = volumes_of(small_mesh(run_in_memory(trial)), 2);
    const Box3 all{{0, 0, 0}, shape};
    const auto ones =
        static_cast<double>(std::count(trial.volume.labels.begin(), trial.volume.labels.end(), 1U));
    EXPECT_NEAR(volumes[1], ones, 1e-6);
    EXPECT_NEAR(volumes[0] + volumes[1], static_cast<double>(all.voxels()), 1e-6);
  }
}

TEST(Promise5SameBytes, OfCellsThatRepeatThemselves) {
  std::mt19937 random(954);
  for (int i = 0; i < 25 && !HasFailure(); ++i) {
    const Trial trial = periodic_trial(random, 10);
    SCOPED_TRACE(trial.text());
    const io::MeshData reference = run_in_memory(trial);
    for (const int threads : {2, 5}) {
      expect_same(run_in_memory(trial, {.threads = threads}), reference);
    }
  }
}

}  // namespace
}  // namespace mw::engine
