// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The graded start mesh: conforming, exact, of the voxels' topology, the same from every block.
#include "kernels/start/graded_start.h"

#include "kernels/distance/point_triangle.h"
#include "kernels/quality/quality.h"
#include "kernels/start/carrier_faces.h"
#include "kernels/start/cells/cell_template.h"
#include "tests/kernels/start/cells/large_cells.h"
#include "tests/kernels/start/coarsen/coarse_volume.h"

namespace mw::test {
namespace {

BlockMesh graded_whole(const SmallVolume& volume, int level) {
  return start_block(volume, level_map(volume), {{0, 0, 0}, volume.shape}, {.max_level = level});
}

/// Mostly uniform, so that there are larger cells.
SmallVolume random_coarse(std::mt19937& random, std::int64_t edge) {
  constexpr std::array<VolumeKind, 4> kKinds{VolumeKind::kBlobs, VolumeKind::kShells,
                                             VolumeKind::kSpecks, VolumeKind::kRings};
  const Index3 shape{edge + below(random, 4), edge + below(random, 3), edge + below(random, 2)};
  SmallVolume volume =
      random_volume_of(random, kKinds[below(random, 4)], shape, 1 + below(random, 3));
  // Uniform from the middle on, for larger cells next to small ones.
  Index3 v;
  for (std::size_t i = 0; i < volume.labels.size(); ++i) {
    v = {static_cast<std::int64_t>(i) % shape.x, static_cast<std::int64_t>(i) / shape.x % shape.y,
         static_cast<std::int64_t>(i) / shape.x / shape.y};
    if (v.x + v.y > edge) volume.labels[i] = 0;
  }
  return volume;
}

TEST(Sec51GradedStart, FillsTheBoxExactlyWithConformingGoodTets) {
  std::mt19937 random(511);
  std::size_t tets = 0, dense_tets = 0;
  double worst = 1.0;
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    const int level = 1 + i % 3;
    const SmallVolume volume = random_coarse(random, level == 3 ? 16 : 9);
    BlockMesh block = graded_whole(volume, level);
    const TetMesh mesh(block.vertices, block.tets, far_corner(volume.shape));
    std::int64_t sum = 0;
    for (const LocalTet& t : mesh.tets()) {
      sum += volume6_of(mesh, t);
      worst = std::min(worst, radius_ratio(mesh, Metric(), t));
    }
    EXPECT_EQ(sum, (6 * volume.shape.product()) << 30);
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) EXPECT_TRUE(mesh.is_free(v));
    for (const auto& [key, stars] : tets_by_stars(mesh)) {
      ASSERT_EQ(stars, key.label == kExterior ? 3 : 4);
    }
    tets += mesh.tets().size();
    dense_tets += volume.labels.size() * 5;
  }
  EXPECT_LT(tets, dense_tets * 3 / 4);
  EXPECT_GE(worst, 0.25) << "the default quality floor could not be promised";
}

/// In cubes of 2 voxels, middles of edges and faces are vertices where labels change across them.
TEST(Sec51GradedStart, HasOnlyTheVerticesThatLabelsNeed) {
  std::mt19937 random(518);
  std::int64_t left_out = 0;
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    const Index3 shape{2 + 2 * below(random, 3), 4, 6};
    const SmallVolume volume =
        random_volume_of(random, VolumeKind::kBlobs, shape, 2 + below(random, 3));
    const BlockMesh mesh = graded_whole(volume, 1);
    std::set<VertexId> found;
    for (const BlockVertex& v : mesh.vertices) found.insert(v.id);
    const LabelBox labels = labels_in(volume, {{-1, -1, -1}, shape + Index3{1, 1, 1}});
    VertexId id = 0;
    for_each_index(shape + Index3{1, 1, 1}, [&](Index3 corner) {
      const std::array<bool, 3> odd{corner.x % 2 != 0, corner.y % 2 != 0, corner.z % 2 != 0};
      // Voxels around the corner, bit by bit on the upper side along x, y and z.
      std::array<Label, 8> around{};
      for (std::int64_t k = 0; k < 8; ++k) {
        around[static_cast<std::size_t>(k)] =
            labels.at(corner + Index3{(k & 1) - 1, (k >> 1 & 1) - 1, (k >> 2) - 1});
      }
      bool changes = !odd[0] && !odd[1] && !odd[2];
      for (std::size_t k = 0; k < 8; ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          changes = changes || (odd[axis] && around[k] != around[k ^ (1U << axis)]);
        }
      }
      const bool centre = odd[0] && odd[1] && odd[2];
      if (!centre) {
        EXPECT_EQ(found.contains(id), changes) << id;
      }
      if (centre && changes) {
        EXPECT_TRUE(found.contains(id));
      }
      left_out += found.contains(id) ? 0 : 1;
      ++id;
    });
  }
  EXPECT_GT(left_out, 500);
}

TEST(Promise1Topology, HoldsInGradedStartMeshes) {
  std::mt19937 random(512);
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    const SmallVolume volume = random_coarse(random, 4);
    SCOPED_TRACE(volume.text());
    const BlockMesh block = graded_whole(volume, 1 + i % 2);
    const TetMesh mesh(block.vertices, block.tets, far_corner(volume.shape));
    EXPECT_TRUE(betti(mesh, volume.label_count) == betti(volume));
  }
}

TEST(Sec51GradedStart, IsTheSameHoweverItIsCutIntoBlocks) {
  std::mt19937 random(514);
  CellTemplates lent{Metric()};
  for (int i = 0; i < 30 && !HasFailure(); ++i) {
    const int level = 1 + i % 3;
    const SmallVolume volume = random_coarse(random, level == 3 ? 17 : 9);
    const BlockMesh whole = graded_whole(volume, level);
    const LevelMap levels = level_map(volume);
    std::map<VertexId, BlockVertex> vertices;
    for (const BlockVertex& v : whole.vertices) vertices[v.id] = v;
    GlobalTets expected, found;
    add_global(expected, whole);
    const std::int64_t edge = std::int64_t{1} << level;
    const Index3 s = volume.shape;
    for (Index3 lo; lo.z < s.z; lo.z += edge) {
      for (lo.y = 0; lo.y < s.y; lo.y += edge) {
        for (lo.x = 0; lo.x < s.x; lo.x += edge) {
          const Box3 box{
              lo,
              {std::min(lo.x + edge, s.x), std::min(lo.y + edge, s.y), std::min(lo.z + edge, s.z)}};
          const BlockMesh block =
              start_block(volume, levels, box, {.max_level = level, .templates = &lent});
          add_global(found, block);
          for (const BlockVertex& v : block.vertices) EXPECT_EQ(vertices.at(v.id), v);
        }
      }
    }
    EXPECT_TRUE(found == expected);
  }
}

/// A volume with the labels that its start mesh takes its shape from.
struct CoarseVolume {
  SmallVolume original;
  SmallVolume shape;
  LevelMap levels;
  StartOptions options;

  [[nodiscard]] BlockMesh block(const Box3& box) const {
    const Index3 halo{kStartHalo, kStartHalo, kStartHalo};
    const Box3 wide{box.lo - halo, box.hi + halo};
    const LabelBox shape_labels = labels_in(shape, wide), labels = labels_in(original, wide);
    return graded_start({.shape = shape_labels, .original = labels}, levels, box, shape.shape,
                        options);
  }
  [[nodiscard]] BlockMesh whole() const { return block({{0, 0, 0}, shape.shape}); }
};

/// Coarsened, or with cells of 16 voxels, or both.
CoarseVolume random_start(std::mt19937& random, int i) {
  const bool coarse = i % 3 != 2;
  const double bound = i % 2 == 0 ? 1.5 : 1.0;
  CoarseVolume out;
  if (i % 4 == 3) {
    out.original = random_with_large_cells(random);
  } else {
    const auto any = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
    const VolumeKind kind = below(random, 3) == 0 ? any : VolumeKind::kBlobs;
    const Index3 shape{5 + below(random, 13), 4 + below(random, 12), 2 + below(random, 12)};
    out.original = random_volume_of(random, kind, shape, 1 + below(random, 5));
  }
  out.shape = coarse ? coarsened(out.original, bound) : out.original;
  out.levels = level_map(out.shape);
  out.options = {
      .max_level = 4, .coarse = coarse, .with_samples = true, .max_distance = bound, .weights = {}};
  return out;
}

std::multiset<FaceSamples> samples_of_input(const SmallVolume& volume) {
  std::multiset<FaceSamples> out;
  const LabelBox labels = labels_in(volume, {{0, 0, 0}, volume.shape + Index3{1, 1, 1}});
  for_each_index(volume.shape, [&](Index3 v) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const Label next = labels.at(VoxelFace{v, axis}.upper());
      if (next == kExterior || next == labels.at(v)) continue;
      for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
        out.insert(face_samples(v, axis, 1U << quarter));
      }
    }
  });
  return out;
}

TEST(Sec51GradedStart, OfCoarsenedLabelsAndLargestCellsIsConformingAndExact) {
  std::mt19937 random(515);
  double worst = 1.0;
  int changed = 0;
  for (int i = 0; i < 120 && !HasFailure(); ++i) {
    const CoarseVolume start = random_start(random, i);
    changed += start.shape.labels != start.original.labels ? 1 : 0;
    const BlockMesh block = start.whole();
    const TetMesh mesh(block.vertices, block.tets, far_corner(start.shape.shape));
    std::map<Label, std::int64_t> volume6_by_label, voxels;
    for (const LocalTet& t : mesh.tets()) {
      EXPECT_GT(volume6_of(mesh, t), 0);
      volume6_by_label[t.label] += volume6_of(mesh, t);
      worst = std::min(worst, radius_ratio(mesh, Metric(), t));
    }
    for (const Label l : start.shape.labels) voxels[l] += std::int64_t{6} << 30;
    EXPECT_EQ(volume6_by_label, voxels);
    for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) EXPECT_TRUE(mesh.is_free(v));
    for (const auto& [key, stars] : tets_by_stars(mesh)) {
      ASSERT_EQ(stars, key.label == kExterior ? 3 : 4);
    }
  }
  EXPECT_GT(changed, 25);
  EXPECT_GE(worst, 0.25) << "the default quality floor could not be promised";
}

/// Labels on both sides of each triangle of the mesh, by the ids of its corners.
std::map<std::array<VertexId, 3>, std::set<Label>> labels_at_triangles(const BlockMesh& mesh) {
  std::map<std::array<VertexId, 3>, std::set<Label>> out;
  for (const BlockTet& t : mesh.tets) {
    for (std::size_t skip = 0; skip < 4; ++skip) {
      std::array<VertexId, 3> key{};
      for (std::size_t i = 0, k = 0; i < 4; ++i) {
        if (i != skip) key[k++] = mesh.vertices[t.vertices[i]].id;
      }
      out[key].insert(t.label);
    }
  }
  return out;
}

/// Each sample of each input face once, on a triangle between the same labels, near enough that the
/// bound holds for all of the face.
TEST(Promise4Distance, SamplesOfTheCoarseStartAreNearTheirTriangles) {
  std::mt19937 random(516);
  std::int64_t samples = 0, moved = 0;
  for (int i = 0; i < 120 && !HasFailure(); ++i) {
    const CoarseVolume start = random_start(random, i);
    const BlockMesh mesh = start.whole();
    const auto labels = labels_at_triangles(mesh);
    const LabelBox input = labels_in(start.original, {{0, 0, 0}, start.original.shape});
    const double reach = start.options.max_distance - kSampleCoveringRadius;
    std::multiset<FaceSamples> found;
    for (const BlockSample& s : mesh.samples) {
      std::array<VertexId, 3> ids{};
      std::array<Vec3, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        ids[k] = mesh.vertices[s.triangle[k]].id;
        corners[k] = Metric().vector({0, 0, 0}, mesh.vertices[s.triangle[k]].position);
      }
      ASSERT_NE(quarters_of(s.samples), 0U);
      for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
        if ((quarters_of(s.samples) >> quarter & 1U) == 0) continue;
        found.insert(with_quarters(s.samples, 1U << quarter));
        const Vec3 p = Metric().vector({0, 0, 0}, sample_position(s.samples, quarter));
        const double distance = std::sqrt(DistanceTriangle(corners).squared_distance(p));
        ASSERT_LE(distance, (start.options.coarse ? reach : 0.0) + 1e-12);
        moved += distance > 1e-12 ? 1 : 0;
      }
      const unsigned axis = axis_of(s.samples);
      const Point p = face_centre(s.samples);
      const std::int64_t unit = kUnitsPerVoxel;
      const VoxelFace face{{p.x / unit - (axis == 0 ? 1 : 0), p.y / unit - (axis == 1 ? 1 : 0),
                            p.z / unit - (axis == 2 ? 1 : 0)},
                           axis};
      const LabelPair pair = labels_beside(input, face);
      ASSERT_EQ(s.side, pair.low);
      ASSERT_EQ(labels.at(ids), (std::set<Label>{pair.low, pair.high}));
    }
    EXPECT_TRUE(found == samples_of_input(start.original));
    samples += std::ssize(found);
  }
  EXPECT_GT(samples, 20000);
  EXPECT_GT(moved, 2000);
}

using GlobalSamples = std::multiset<std::tuple<std::array<VertexId, 3>, Label, FaceSamples>>;

void add_samples(GlobalSamples& out, const BlockMesh& block) {
  for (const BlockSample& s : block.samples) {
    std::array<VertexId, 3> ids{};
    for (std::size_t k = 0; k < 3; ++k) ids[k] = block.vertices[s.triangle[k]].id;
    out.insert({ids, s.side, s.samples});
  }
}

TEST(Promise5SameBytes, CoarseStartIsTheSameHoweverItIsCutIntoBlocks) {
  std::mt19937 random(517);
  for (int i = 0; i < 24 && !HasFailure(); ++i) {
    CoarseVolume start = random_start(random, i);
    start.options.max_level = i % 4 == 3 ? 4 : 1 + i % 3;
    const BlockMesh whole = start.whole();
    std::map<VertexId, BlockVertex> vertices;
    for (const BlockVertex& v : whole.vertices) vertices[v.id] = v;
    GlobalTets expected, found;
    GlobalSamples expected_samples, found_samples;
    add_global(expected, whole);
    add_samples(expected_samples, whole);
    const std::int64_t edge = std::int64_t{1} << start.options.max_level;
    const Index3 s = start.shape.shape;
    for_each_index(
        Index3{(s.x + edge - 1) / edge, (s.y + edge - 1) / edge, (s.z + edge - 1) / edge},
        [&](Index3 b) {
          const Index3 lo{b.x * edge, b.y * edge, b.z * edge};
          const Index3 hi = lo + Index3{edge, edge, edge};
          const BlockMesh block =
              start.block({lo, {std::min(hi.x, s.x), std::min(hi.y, s.y), std::min(hi.z, s.z)}});
          add_global(found, block);
          add_samples(found_samples, block);
          for (const BlockVertex& v : block.vertices) EXPECT_EQ(vertices.at(v.id), v);
        });
    EXPECT_TRUE(found == expected);
    EXPECT_TRUE(found_samples == expected_samples);
  }
}

}  // namespace
}  // namespace mw::test
