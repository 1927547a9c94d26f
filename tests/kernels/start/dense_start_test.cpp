// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sec 5.1: the five-tet start mesh, alone and between neighbouring blocks.
#include "kernels/start/graded_start.h"

#include "kernels/quality/quality.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

constexpr std::int64_t kVoxel6 = std::int64_t{6} << 30;  // 6 * 1024^3

Box3 random_block(std::mt19937& random, Index3 shape) {
  const auto part = [&](std::int64_t edge) {
    const std::int64_t lo = below(random, static_cast<std::uint32_t>(edge));
    const std::int64_t hi = lo + 1 + below(random, static_cast<std::uint32_t>(edge - lo));
    return std::pair(lo, hi);
  };
  const auto x = part(shape.x), y = part(shape.y), z = part(shape.z);
  return {{x.first, y.first, z.first}, {x.second, y.second, z.second}};
}

/// Which voxel a tet of a start mesh lies in.
Index3 voxel_of(const BlockMesh& mesh, const BlockTet& t) {
  std::array<std::int64_t, 3> sum{};
  for (std::uint32_t v : t.vertices) {
    const Point p = mesh.vertices[v].position;
    sum[0] += p.x;
    sum[1] += p.y;
    sum[2] += p.z;
  }
  return {sum[0] / (4 * kUnitsPerVoxel), sum[1] / (4 * kUnitsPerVoxel),
          sum[2] / (4 * kUnitsPerVoxel)};
}

std::array<Point, 4> corners_of(const BlockMesh& mesh, const BlockTet& t) {
  std::array<Point, 4> out;
  for (std::size_t i = 0; i < 4; ++i) out[i] = mesh.vertices[t.vertices[i]].position;
  if (volume6(out[0], out[1], out[2], out[3]) < 0) std::swap(out[2], out[3]);
  return out;
}

TEST(Sec51StartMesh, HasFiveGoodTetsAVoxelOfExactVolume) {
  std::mt19937 random(501);
  const Metric metric;
  for (int i = 0; i < 100 && !HasFailure(); ++i) {
    const Index3 shape = random_shape(random, 1, 5);
    const SmallVolume volume = random_volume_of(random, VolumeKind::kNoise, shape, 5);
    const Box3 block = random_block(random, shape);
    const BlockMesh mesh = dense_block(volume, block);
    std::map<std::array<std::int64_t, 3>, std::pair<int, std::int64_t>> voxels;
    for (const BlockTet& t : mesh.tets) {
      const Index3 v = voxel_of(mesh, t);
      const auto [a, b, c, d] = corners_of(mesh, t);
      auto& [count, volume6_sum] = voxels[{v.x, v.y, v.z}];
      ++count;
      volume6_sum += volume6(a, b, c, d);
      ASSERT_TRUE(block.contains(v));
      EXPECT_EQ(t.label, labels_in(volume, block).at(v));
      const double ratio =
          radius_ratio({metric.vector(a, b), metric.vector(a, c), metric.vector(a, d)});
      EXPECT_GT(ratio, 0.73);
      EXPECT_LE(ratio, 1.0 + 1e-12);
    }
    EXPECT_EQ(voxels.size(), static_cast<std::size_t>(block.voxels()));
    for (const auto& [voxel, found] : voxels) EXPECT_EQ(found, std::pair(5, kVoxel6));
  }
}

void expect_canonical(const BlockMesh& mesh) {
  std::set<std::uint32_t> used;
  for (const BlockTet& t : mesh.tets) {
    EXPECT_TRUE(std::is_sorted(t.vertices.begin(), t.vertices.end()));
    used.insert(t.vertices.begin(), t.vertices.end());
  }
  EXPECT_EQ(used.size(), mesh.vertices.size());
  for (std::size_t i = 1; i < mesh.vertices.size(); ++i) {
    EXPECT_LT(mesh.vertices[i - 1].id, mesh.vertices[i].id);
  }
  EXPECT_TRUE(std::is_sorted(mesh.tets.begin(), mesh.tets.end()));
}

/// Tets by global ids.
std::multiset<std::pair<std::array<VertexId, 4>, Label>> tets_by_id(const BlockMesh& mesh) {
  std::multiset<std::pair<std::array<VertexId, 4>, Label>> out;
  for (const BlockTet& t : mesh.tets) {
    std::array<VertexId, 4> ids{};
    for (std::size_t i = 0; i < 4; ++i) ids[i] = mesh.vertices[t.vertices[i]].id;
    out.insert({ids, t.label});
  }
  return out;
}

/// Cut at a plane into two blocks, the mesh is the same, and copies of vertices are equal.  (That
/// the whole is conforming is tested with TetMesh.)
TEST(Sec51StartMesh, IsTheSameHoweverItIsCutIntoBlocks) {
  std::mt19937 random(502);
  for (int i = 0; i < 100 && !HasFailure(); ++i) {
    const Index3 shape = random_shape(random, 1, 5) + Index3{1, 1, 1};
    const SmallVolume volume = random_volume_of(random, VolumeKind::kNoise, shape, 4);
    const Box3 all{{0, 0, 0}, shape};
    Box3 low = all, high = all;
    const std::uint32_t axis = below(random, 3);
    const auto along = [&](Index3& v) -> std::int64_t& {
      return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
    };
    const std::int64_t cut = 1 + below(random, static_cast<std::uint32_t>(along(low.hi) - 1));
    along(low.hi) = cut;
    along(high.lo) = cut;
    const BlockMesh whole = dense_block(volume, all);
    auto parts = tets_by_id(dense_block(volume, low));
    parts.merge(tets_by_id(dense_block(volume, high)));
    EXPECT_TRUE(parts == tets_by_id(whole));
    for (const Box3& part : {low, high}) {
      const BlockMesh mesh = dense_block(volume, part);
      expect_canonical(mesh);
      for (const BlockVertex& v : mesh.vertices) EXPECT_EQ(v, whole.vertices[v.id]);
    }
  }
}

TEST(Sec42Ids, AreVoxelCornersXFastest) {
  const SmallVolume volume = volume_from({2, 3, 4}, 1, [](auto, auto, auto) { return 0; });
  for (const BlockVertex& v : dense_block(volume, {{1, 1, 1}, {2, 3, 4}}).vertices) {
    const auto id = static_cast<std::int32_t>(v.id);
    EXPECT_EQ(v.position, (Point{id % 3 * 1024, id / 3 % 4 * 1024, id / 12 * 1024}));
  }
}

/// The quadric of a corner evaluated at x, face by face of the twelve around it.
double explicit_error(const LabelBox& labels, Index3 corner, const Vec3& x,
                      const QuadricWeights& weights) {
  double error = 0.0;
  bool inner = true;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::int64_t s : {-1, 0}) {
      for (std::int64_t t : {-1, 0}) {
        Index3 low = corner, high = corner;
        if (axis == 0) low = low + Index3{-1, s, t}, high = high + Index3{0, s, t};
        if (axis == 1) low = low + Index3{s, -1, t}, high = high + Index3{s, 0, t};
        if (axis == 2) low = low + Index3{s, t, -1}, high = high + Index3{s, t, 0};
        const Label a = labels.at(low), b = labels.at(high);
        if (a == b) continue;
        inner = false;
        if (a != kExterior && b != kExterior) error += weights.plane * x[axis] * x[axis];
      }
    }
  }
  return error + (inner ? weights.inner_point : weights.boundary_point) * x.squaredNorm();
}

TEST(Sec52Quadrics, OfCornersSumOverTheTwelveFacesAround) {
  std::mt19937 random(503);
  const QuadricWeights weights{.plane = 0.75, .boundary_point = 0.25, .inner_point = 0.5};
  const std::array<Vec3, 4> offsets{{{1, 0, 0}, {0, 0.5, 0}, {0, 0, -2}, {0.25, -0.5, 1.5}}};
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const Index3 shape = random_shape(random, 1, 5);
    const auto kind = below(random, 2) == 0 ? VolumeKind::kNoise : VolumeKind::kSpecks;
    const SmallVolume volume = random_volume_of(random, kind, shape, 3);
    const LabelBox labels = labels_in(volume, {{-1, -1, -1}, shape + Index3{1, 1, 1}});
    for (const BlockVertex& v :
         dense_block(volume, {{0, 0, 0}, shape}, {.weights = weights}).vertices) {
      const Index3 corner{v.position.x / 1024, v.position.y / 1024, v.position.z / 1024};
      for (const Vec3& x : offsets) {
        EXPECT_NEAR(v.quadric.value(x), explicit_error(labels, corner, x, weights), 1e-12);
      }
    }
  }
}

/// Each voxel face between two labels of the volume has its four samples once, whatever the blocks,
/// and each lies on the triangle that carries it.
TEST(Sec51StartMesh, SamplesCoverEveryInterfaceFaceOnce) {
  std::mt19937 random(504);
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    const Index3 shape = random_shape(random, 1, 5) + Index3{1, 0, 0};
    const SmallVolume volume = random_volume_of(random, VolumeKind::kNoise, shape, 3);
    const Box3 all{{0, 0, 0}, shape};
    const LabelBox labels = labels_in(volume, {{-1, -1, -1}, shape + Index3{1, 1, 1}});
    const std::int64_t cut = 1 + below(random, static_cast<std::uint32_t>(shape.x - 1));
    std::multiset<FaceSamples> found, expected;
    for (const Box3& block : {Box3{{0, 0, 0}, {cut, shape.y, shape.z}}, Box3{{cut, 0, 0}, shape}}) {
      const BlockMesh mesh = dense_block(volume, block, {.with_samples = true});
      for (const BlockSample& s : mesh.samples) {
        const auto at = [&](std::size_t k) { return mesh.vertices[s.triangle[k]].position; };
        for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
          if ((quarters_of(s.samples) >> quarter & 1U) == 0) continue;
          found.insert(with_quarters(s.samples, 1U << quarter));
          const Point p = sample_position(s.samples, quarter);
          EXPECT_EQ(volume6(p, at(0), at(1), at(2)), 0);
          for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_LE(Metric().vector(p, at(k)).cwiseAbs().maxCoeff(), 0.75);
          }
        }
      }
    }
    for (Index3 v; v.z < shape.z; ++v.z) {
      for (v.y = 0; v.y < shape.y; ++v.y) {
        for (v.x = 0; v.x < shape.x; ++v.x) {
          for (unsigned axis = 0; axis < 3; ++axis) {
            const Index3 next = v + Index3{axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0};
            if (!all.contains(next) || labels.at(v) == labels.at(next)) continue;
            for (unsigned quarter = 0; quarter < 4; ++quarter) {
              expected.insert(face_samples(v, axis, 1U << quarter));
            }
          }
        }
      }
    }
    EXPECT_TRUE(found == expected);
  }
}

}  // namespace
}  // namespace mw::test
