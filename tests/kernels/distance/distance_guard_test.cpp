// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Samples after many changes: none lost, all near, on triangles that look their way.
#include "kernels/distance/distance_guard.h"

#include "kernels/core/index.h"
#include "kernels/optimise/flips.h"
#include "kernels/topology/link_condition.h"
#include "tests/kernels/surface/interface_triangles.h"

namespace mw::test {
namespace {

constexpr double kRounding = 1e-8;

/// One quarter of one face, and the labels on its sides.
struct Sample {
  FaceSamples quarter = 0;  ///< one bit
  Label lower = 0;
  Label upper = 0;

  [[nodiscard]] Vec3 position() const {
    unsigned bit = 0;
    while (quarters_of(quarter) != 1U << bit) ++bit;
    return in_voxels(sample_position(quarter, bit));
  }
  /// From the smaller label to the larger.
  [[nodiscard]] Vec3 way() const {
    return (lower < upper ? 1.0 : -1.0) * Vec3(Vec3::Unit(static_cast<int>(axis_of(quarter))));
  }
};

/// All of a volume, by the voxels.
std::vector<Sample> samples_of(const SmallVolume& volume) {
  std::vector<Sample> out;
  const Box3 all{{0, 0, 0}, volume.shape};
  const auto label = [&](Index3 v) {
    return volume.labels[static_cast<std::size_t>(all.offset(v))];
  };
  for_each_index(all, [&](Index3 v) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const Index3 w = v + Index3{axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0};
      if (!all.contains(w) || label(v) == label(w)) continue;
      for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
        out.push_back({face_samples(v, axis, 1U << quarter), label(v), label(w)});
      }
    }
  });
  return out;
}

using Carriers = std::map<FaceSamples, InterfaceTriangle>;

/// Who carries each quarter; what hangs on no interface triangle of the mesh is not found.
Carriers carriers_of(const GuardedMesh& guarded) {
  Carriers out;
  for (const InterfaceTriangle& t : interface_triangles(guarded.mesh)) {
    for (const FaceSamples s : guarded.samples.of(t.key())) {
      EXPECT_TRUE(guarded.samples.has(t.key(), t.low));
      for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
        if ((quarters_of(s) >> quarter & 1U) == 0) continue;
        EXPECT_TRUE(out.emplace(with_quarters(s, 1U << quarter), t).second) << "twice";
      }
    }
  }
  return out;
}

DistanceTriangle shape(const TetMesh& mesh, const InterfaceTriangle& t) {
  const auto at = [&](std::size_t i) { return in_voxels(mesh.position(t.corners[i])); };
  return DistanceTriangle({at(0), at(1), at(2)});
}

double distance(const TetMesh& mesh, const InterfaceTriangle& t, const Sample& s) {
  return std::sqrt(shape(mesh, t).squared_distance(s.position()));
}

bool looks_its_way(const TetMesh& mesh, const InterfaceTriangle& t, const Sample& s) {
  return s.way().dot(shape(mesh, t).unit_normal()) >= -0.1;
}

/// None lost, each on a triangle of its labels that is near.
void expect_carried(const GuardedMesh& guarded, const std::vector<Sample>& samples, double bound) {
  const Carriers carriers = carriers_of(guarded);
  ASSERT_EQ(carriers.size(), samples.size());
  for (const Sample& s : samples) {
    const auto found = carriers.find(s.quarter);
    ASSERT_NE(found, carriers.end());
    const auto [low, high] = std::minmax(s.lower, s.upper);
    ASSERT_EQ(found->second.low, low);
    ASSERT_EQ(found->second.high, high);
    ASSERT_LE(distance(guarded.mesh, found->second, s), bound - kSampleCoveringRadius + kRounding);
  }
}

/// Tries to move a random interface vertex; the vertex, or infinity.
LocalVertex random_move(GuardedMesh& guarded, std::mt19937& random) {
  TetMesh& mesh = guarded.mesh;
  const LocalVertex v = below(random, mesh.vertex_count());
  if (!mesh.is_alive(v) || !mesh.is_free(v) || !mesh.on_interface(v)) return mesh.infinity();
  const Point x = point_near(mesh, v, random, 600);
  if (!is_positive_at(mesh, v, x)) return mesh.infinity();
  std::vector<FanTriangle> fan;
  InterfaceFan().collect(mesh, v, fan);
  if (!guarded.guard.allows_move(mesh, v, fan, x)) return mesh.infinity();
  mesh.move(v, x, mesh.quadric(v));
  guarded.guard.commit();
  return v;
}

/// Tries to contract a random interface edge.
bool random_contraction(GuardedMesh& guarded, LinkCondition& topology, std::mt19937& random) {
  TetMesh& mesh = guarded.mesh;
  const auto [p, q] = random_edge(mesh, random);
  if (p == q || !mesh.on_interface(p) || !mesh.on_interface(q)) return false;
  const auto target = contraction_target(mesh, p, q, below(random, 3));
  if (!target || !stays_positive(mesh, p, q, *target)) return false;
  if (!topology.keeps_topology(mesh, p, q)) return false;
  if (!guarded.guard.allows_contraction(mesh, p, q, *target)) return false;
  mesh.contract(p, q, *target, mesh.quadric(p));
  guarded.guard.commit();
  return true;
}

bool random_flip(GuardedMesh& guarded, Flipper& flipper, std::mt19937& random) {
  const auto [p, q] = random_edge(guarded.mesh, random);
  return p != q && flipper.flip_surface(p, q, 5.0);
}

TEST(Promise4Distance, SamplesSurviveRandomChanges) {
  std::mt19937 random(941);
  int moves = 0, contractions = 0, flips = 0;
  for (std::uint32_t i = 0; i < 64 && !HasFailure(); ++i) {
    const auto kind =
        i % 3 == 0 ? VolumeKind::kBlobs : static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    const SmallVolume volume = random_volume_of(random, kind, {5, 6, 5}, 2 + below(random, 3));
    SCOPED_TRACE(volume.text());
    const double bound = std::array{0.75, 1.0, 1.5, 2.5}[i % 4];
    const std::vector<Sample> samples = samples_of(volume);
    GuardedMesh guarded(volume, bound);
    expect_carried(guarded, samples, bound);
    LinkCondition topology(guarded.mesh);
    const Metric metric;
    Flipper flipper(guarded.mesh, metric, 0.0, &guarded.guard);
    for (int round = 0; round < 5; ++round) {
      for (int k = 0; k < 60; ++k) {
        moves += random_move(guarded, random) != guarded.mesh.infinity() ? 1 : 0;
        contractions += random_contraction(guarded, topology, random) ? 1 : 0;
        flips += random_flip(guarded, flipper, random) ? 1 : 0;
      }
      expect_carried(guarded, samples, bound);
    }
  }
  EXPECT_GT(moves, 1000);
  EXPECT_GT(contractions, 300);
  EXPECT_GT(flips, 50);
}

/// How near the triangles at v are that may carry a sample.
struct Nearest {
  double any = 1e9;
  double looking = 1e9;  ///< its way

  Nearest(const TetMesh& mesh, const Sample& s, const Vec3& position, LocalVertex v,
          const std::set<InterfaceTriangle>& triangles) {
    const auto [low, high] = std::minmax(s.lower, s.upper);
    for (const InterfaceTriangle& t : triangles) {
      if (!t.has(v) || t.low != low || t.high != high) continue;
      const double d = std::sqrt(shape(mesh, t).squared_distance(position));
      any = std::min(any, d);
      if (looks_its_way(mesh, t, s)) looking = std::min(looking, d);
    }
  }
};

/// Thin sheets and all else: of the samples that v's triangles carried when it moved, those that go
/// to a neighbour find no changed triangle within reach, and those that hang on one that looks the
/// other way no changed one that looks theirs.  The four of a face stay together where the middle
/// of the face is near enough for all of them.
TEST(DistanceGuard, PrefersChangedTrianglesThatLookTheSamplesWay) {
  std::mt19937 random(942);
  int to_neighbours = 0, other_way = 0, carried = 0;
  for (std::uint32_t i = 0; i < 60 && !HasFailure(); ++i) {
    const auto kind =
        std::array{VolumeKind::kSheets, VolumeKind::kBlobs, VolumeKind::kNoise}[i % 3];
    const SmallVolume volume = random_volume_of(random, kind, {4, 5, 4}, 2 + below(random, 2));
    const std::vector<Sample> samples = samples_of(volume);
    const double bound = i % 4 == 0 ? 1.1 : 0.75, reach = bound - kSampleCoveringRadius;
    GuardedMesh guarded(volume, bound);
    TetMesh& mesh = guarded.mesh;
    for (int k = 0; k < 120 && !HasFailure(); ++k) {
      const Carriers before = carriers_of(guarded);
      const LocalVertex v = random_move(guarded, random);
      if (v == mesh.infinity()) continue;
      const Carriers after = carriers_of(guarded);
      const auto triangles = interface_triangles(mesh);
      for (const Sample& s : samples) {
        const InterfaceTriangle &from = before.at(s.quarter), &to = after.at(s.quarter);
        if (!from.has(v)) {
          ASSERT_EQ(from, to);
          continue;
        }
        ++carried;
        const Nearest to_sample(mesh, s, s.position(), v, triangles);
        const Nearest to_face(mesh, s, in_voxels(face_centre(s.quarter)), v, triangles);
        const bool together = to_face.any <= reach - kSampleCoveringRadius;
        if (!to.has(v)) {
          EXPECT_FALSE(together);
          EXPECT_GT(to_sample.any, reach - kRounding);
          ++to_neighbours;
        } else if (!looks_its_way(mesh, to, s)) {
          EXPECT_GT(together ? to_face.looking : to_sample.looking,
                    reach - (together ? kSampleCoveringRadius : 0.0) - kRounding);
          ++other_way;
        }
      }
    }
  }
  EXPECT_GT(carried, 5000);
  EXPECT_GT(to_neighbours, 10);
  EXPECT_GT(other_way, 10);
}

/// Point of a mesh, in tenths of a voxel.
BlockVertex vertex_at(VertexId id, int x, int y, int z) {
  const auto lattice = [](int tenths) { return tenths * kUnitsPerVoxel / 10; };
  return {id, {lattice(x), lattice(y), lattice(z)}, {}};
}

/// A flip that makes a fold: of the new triangles (a, b, q) looks up and (b, a, p) down, one of
/// them farther from the face at height 2 than the other.  The face goes to the one that looks its
/// way, whichever label is above it, and near or far.
TEST(DistanceGuard, HandsAFlippedFaceToTheTriangleThatLooksItsWay) {
  for (const bool q_is_far : {false, true}) {
    for (const Label above : {0U, 1U}) {
      for (const Label towards : {0U, 1U}) {
        const SmallVolume volume = volume_from(
            {4, 4, 4}, 2, [&](auto, auto, auto z) { return z < 2 ? 1 - above : above; });
        const LabelBox labels = labels_in(volume, {{-8, -8, -8}, {12, 12, 12}});
        const LocalVertex p = 0, q = 1, a = 2, b = 3;
        const std::array<BlockVertex, 6> vertices{vertex_at(p, 10, 20, q_is_far ? 19 : 10),
                                                  vertex_at(q, 10, 20, q_is_far ? 30 : 21),
                                                  vertex_at(a, 20, 10, 20),
                                                  vertex_at(b, 20, 30, 20),
                                                  vertex_at(4, 30, 20, 35),
                                                  vertex_at(5, 30, 20, 5)};
        const std::array<BlockTet, 2> tets{{{{p, a, b, 5}, 0}, {{q, a, b, 4}, 1}}};
        const TetMesh mesh(vertices, tets, {1 << 20, 1 << 20, 1 << 20});
        CarriedSamples samples;
        samples.add(triangle_key(p, q, a), 0, face_samples({1, 1, 1}, 2, kAllQuarters));
        DistanceGuard guard(labels, 3.0, samples);
        const std::array<TriangleKey, 2> old{triangle_key(p, q, a), triangle_key(p, q, b)};
        const std::array<FlippedTriangle, 2> fresh{{{b, a, p}, {a, b, q}}};
        ASSERT_TRUE(guard.allows_flip(mesh, old, fresh, towards, 1 - towards));
        guard.commit();
        EXPECT_FALSE(samples.has(triangle_key(p, q, a), 0));
        EXPECT_EQ(samples.has(triangle_key(a, b, q), 0), towards == above);
        EXPECT_EQ(samples.has(triangle_key(a, b, p), 0), towards != above);
      }
    }
  }
}

/// The two sides of a sheet of two voxels keep their own samples, as far as it is moved about.
TEST(DistanceGuard, KeepsTheSidesOfASheetApart) {
  std::mt19937 random(943);
  for (unsigned axis = 0; axis < 3; ++axis) {
    const SmallVolume volume = volume_from({6, 6, 6}, 2, [&](auto x, auto y, auto z) {
      const auto along = axis == 0 ? x : axis == 1 ? y : z;
      return along == 2 || along == 3 ? 1 : 0;
    });
    const std::vector<Sample> samples = samples_of(volume);
    GuardedMesh guarded(volume, 3.0);
    LinkCondition topology(guarded.mesh);
    int changes = 0;
    for (int k = 0; k < 2000; ++k) {
      changes += random_move(guarded, random) != guarded.mesh.infinity() ? 1 : 0;
      changes += random_contraction(guarded, topology, random) ? 1 : 0;
    }
    EXPECT_GT(changes, 200);
    expect_carried(guarded, samples, 3.0);
    const Carriers carriers = carriers_of(guarded);
    int other_way = 0;
    for (const Sample& s : samples) {
      other_way += looks_its_way(guarded.mesh, carriers.at(s.quarter), s) ? 0 : 1;
    }
    EXPECT_EQ(other_way, 0);
  }
}

/// Pieces say what is carried: each quarter once, where it is, and which way its face looks.
TEST(DistanceGuard, ListsPieces) {
  std::mt19937 random(944);
  int parts = 0;
  for (std::uint32_t i = 0; i < 24 && !HasFailure(); ++i) {
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    const SmallVolume volume = random_volume_of(random, kind, {4, 5, 4}, 2 + below(random, 3));
    const double bound = 1.0;
    GuardedMesh guarded(volume, bound);
    for (int k = 0; k < 100; ++k) random_move(guarded, random);
    std::map<std::tuple<InterfaceTriangle, unsigned, double>, Vec3> expected, listed;
    std::map<InterfaceTriangle, double> quarters;
    const Carriers carriers = carriers_of(guarded);
    for (const Sample& s : samples_of(volume)) {
      const InterfaceTriangle& t = carriers.at(s.quarter);
      const unsigned axis = axis_of(s.quarter);
      const double sign = s.way()[static_cast<int>(axis)];
      expected.try_emplace({t, axis, sign}, Vec3::Zero()).first->second += s.position();
      quarters[t] += 1.0;
    }
    for (const InterfaceTriangle& t : interface_triangles(guarded.mesh)) {
      double sum = 0.0;
      guarded.guard.for_each_piece(t.key(), t.low, [&](const DistanceGuard::Piece& piece) {
        listed.try_emplace({t, piece.axis, piece.sign}, Vec3::Zero()).first->second +=
            piece.quarters * piece.middle;
        sum += piece.quarters;
        parts += piece.quarters < 4.0 ? 1 : 0;
      });
      EXPECT_EQ(sum, quarters[t]);
    }
    ASSERT_EQ(listed.size(), expected.size());
    for (const auto& [key, sum] : expected) {
      EXPECT_NEAR((listed.at(key) - sum).norm(), 0.0, 1e-9);
    }
  }
  EXPECT_GT(parts, 50);
}

}  // namespace
}  // namespace mw::test
