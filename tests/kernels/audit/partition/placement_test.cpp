// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Centres of voxels in tets, against exact orientations of doubles; meshes in each mirror; labels
// exchanged.
#include "kernels/audit/partition/placement.h"

#include <set>

#include "kernels/audit/partition/centres.h"
#include "kernels/audit/partition/orientation.h"
#include "kernels/core/lattice.h"
#include "tests/kernels/audit/topology/mesh_parts_by_owner.h"
#include "tests/oracle/small_volumes.h"
#include "tests/testing.h"

namespace mw::audit {
namespace {

using namespace test;

std::vector<Label> centres_in(const SmallMesh& mesh, Index3 shape, std::size_t label_count,
                              const Frame& frame = {}, Index3 layers = {1, 1, 1}) {
  return centre_labels(centre_runs({.mesh = mesh.view()}, label_count, frame, shape, layers),
                       {{0, 0, 0}, shape}, shape);
}

/// 1 inside of the tet, -1 outside, 0 on its surface.
int side_of(const std::array<Position, 4>& tet, const Position& p) {
  const int whole = exact_orientation(tet[0], tet[1], tet[2], tet[3]);
  int out = whole == 0 ? -1 : 1;
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<Position, 4> other = tet;
    other[i] = p;
    out = std::min(out, whole * exact_orientation(other[0], other[1], other[2], other[3]));
  }
  return out;
}

/// A tet whose corners are multiples of a 2^-bits part of a voxel.
std::array<Position, 4> random_tet(std::mt19937& random, Index3 shape, unsigned bits,
                                   double units) {
  std::array<Position, 4> out{};
  const std::array<std::int64_t, 3> ends{shape.x, shape.y, shape.z};
  for (Position& p : out) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto steps = static_cast<std::uint32_t>((ends[k] + 2) << bits);
      p[k] = std::ldexp(below(random, steps), -static_cast<int>(bits)) - 1;
    }
    p[2] = std::nearbyint(p[2] * units) / units;
  }
  return out;
}

TEST(Centres, AreInTheTetThatHoldsThem) {
  std::mt19937 random(57);
  int inside = 0, on_surface = 0;
  for (int trial = 0; trial < 3000 && !HasFailure(); ++trial) {
    const Index3 shape{1 + below(random, 9), 1 + below(random, 9), 1 + below(random, 5)};
    const Index3 layers{1, 1, 1 + below(random, 3)};
    const unsigned bits = trial % 2 == 0 ? 1 : 10;
    const auto units = static_cast<double>(layers.z * kUnitsPerVoxel);
    const std::array<Position, 4> tet = random_tet(random, shape, bits, units);
    const Frame frame{{0.5, 2, 4}, {-4, 10, 0.25}};
    SmallMesh mesh{{tet.begin(), tet.end()}, {{0, 1, 2, 3}}, {0}};
    std::array<Position, 4> exact = tet;  // in units of the lattice
    for (std::size_t i = 0; i < 4; ++i) {
      exact[i][2] *= static_cast<double>(layers.z);
      for (std::size_t k = 0; k < 3; ++k) {
        mesh.vertices[i][k] = frame.origin[k] + frame.spacing[k] * tet[i][k];
      }
    }
    const std::vector<Label> found = centres_in(mesh, shape, 1, frame, layers);
    std::size_t at = 0;
    for_each_index(shape, [&](Index3 v) {
      const Position centre{static_cast<double>(v.x) + 0.5, static_cast<double>(v.y) + 0.5,
                            static_cast<double>(layers.z) * (static_cast<double>(v.z) + 0.5)};
      const int side = side_of(exact, centre);
      if (side != 0) {
        EXPECT_EQ(found[at] == 0, side > 0) << trial;
      }
      inside += side > 0 ? 1 : 0;
      on_surface += side == 0 ? 1 : 0;
      ++at;
    });
  }
  EXPECT_GT(inside, 3000);
  EXPECT_GT(on_surface, 300);
}

/// Vertices are where centres are, so that these are on vertices, edges and triangles.
TEST(Centres, AreInOneTetOfEach) {
  std::mt19937 random(58);
  for (int trial = 0; trial < 200 && !HasFailure(); ++trial) {
    const SmallVolume v = random_volume(random);
    SmallMesh mesh = five_tet_mesh(v);
    for (Position& p : mesh.vertices) {
      for (double& x : p) x = (trial % 2 == 0 ? 1.5 : 2) * x - 0.5;
    }
    const auto runs = centre_runs({.mesh = mesh.view()}, v.label_count, {}, v.shape, {1, 1, 1});
    std::set<std::uint64_t> seen;
    for (const CentreRun& run : runs) {
      for (std::uint64_t i = 0; i < run.count; ++i) {
        EXPECT_TRUE(seen.insert(run.first + i).second);
      }
    }
    EXPECT_EQ(seen.size(), v.labels.size());
  }
}

TEST(Centres, AreFoundInLargeTets) {
  const Index3 shape{2000, 2, 2};
  SmallMesh mesh{
      {{-9e9, -9e9, -9e9}, {9e9, -9e9, -9e9}, {0, 9e9, -9e9}, {0, 0, 9e9}}, {{0, 1, 2, 3}}, {3}};
  for (const Label label : centres_in(mesh, shape, 4)) EXPECT_EQ(label, 3U);
  mesh.vertices = {{0, -5000, -5000}, {0, 10000, -5000}, {0, 0, 5000}, {4000, 0, 0}};
  for (const Label label : centres_in(mesh, shape, 4)) EXPECT_EQ(label, 3U);
  for (const Label label : centres_in(mesh, shape, 3)) EXPECT_EQ(label, kLeftOut);
}

TEST(Centres, OfTilesAreThoseOfTheWhole) {
  std::mt19937 random(59);
  for (int trial = 0; trial < 50; ++trial) {
    const SmallVolume v = random_volume(random);
    const SmallMesh mesh = five_tet_mesh(v);
    std::vector<std::uint32_t> owner;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) owner.push_back(below(random, 3));
    std::vector<CentreRun> runs;
    for (std::uint32_t tile = 0; tile < 3; ++tile) {
      const OwnedPart part = part_of_owner(mesh, owner, tile);
      const auto more = centre_runs(part.view(), v.label_count, {}, v.shape, {1, 1, 1});
      runs.insert(runs.end(), more.begin(), more.end());
    }
    EXPECT_EQ(centre_labels(runs, {{0, 0, 0}, v.shape}, v.shape), v.labels);
  }
}

PlaceSamples samples_of(Index3 shape, const std::vector<Label>& labels,
                        const std::vector<Label>& centres, const WantedCentres& wanted) {
  PlaceSamples out(shape);
  out.put({{0, 0, 0}, shape}, labels, centres, wanted);
  return out;
}

Check judged_place(const SmallVolume& v, const std::vector<Label>& centres) {
  const WantedCentres all = wanted_centres(v.label_count, {}, {});
  const LabelText names;
  return judge_places(tally_places(v.labels, centres, all),
                      samples_of(v.shape, v.labels, centres, all), ExchangedLabels(names));
}

/// The labels where a symmetry of a cube puts them.
std::vector<Label> turned(const SmallVolume& v, const std::array<std::size_t, 3>& axes,
                          unsigned flips) {
  std::vector<Label> out;
  const Box3 all{{0, 0, 0}, v.shape};
  for_each_index(v.shape, [&](Index3 i) {
    const std::array<std::int64_t, 3> at{i.x, i.y, i.z};
    std::array<std::int64_t, 3> from{at[axes[0]], at[axes[1]], at[axes[2]]};
    for (std::size_t k = 0; k < 3; ++k) {
      if ((flips >> k & 1U) != 0) from[k] = v.shape.x - 1 - from[k];
    }
    out.push_back(v.labels[static_cast<std::size_t>(all.offset({from[0], from[1], from[2]}))]);
  });
  return out;
}

/// All 47: the most hits are those of the symmetry that undoes it.
TEST(Placement, FailsInEachMirrorAndTurn) {
  std::mt19937 random(60);
  const SmallVolume v = random_volume_of(random, VolumeKind::kNoise, {9, 9, 9}, 3);
  std::array<std::size_t, 3> axes{0, 1, 2};
  int failed = 0;
  do {
    for (unsigned flips = 0; flips < 8; ++flips) {
      const std::vector<Label> centres = turned(v, axes, flips);
      const bool is_same = centres == v.labels;
      const auto hits = samples_of(v.shape, v.labels, centres, {0, 1, 2}).count();
      EXPECT_EQ(std::max(hits.as_it_lies, hits.otherwise), v.labels.size());
      EXPECT_EQ(hits.as_it_lies == v.labels.size(), is_same);
      const Check check = judged_place(v, centres);
      EXPECT_EQ(check.passed, is_same) << check.detail;
      failed += check.passed ? 0 : 1;
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  EXPECT_EQ(failed, 47);
}

/// A mirror of what is the same in the mirror has as many hits, to the voxel, however bad a mesh
/// is.
TEST(Placement, PassesWhatIsSymmetric) {
  std::mt19937 random(61);
  for (const Index3 shape : {Index3{8, 6, 4}, Index3{7, 6, 6}, Index3{400, 90, 130}}) {
    SmallVolume v = volume_from(shape, 3, [&](auto x, auto y, auto z) {
      return (std::abs(2 * x + 1 - shape.x) * 5 + std::abs(2 * y + 1 - shape.y)) / 9 % 3 + 0 * z;
    });
    std::vector<Label> centres = v.labels;
    for (Label& label : centres) {
      if (below(random, 3) == 0) label = below(random, 3);
    }
    const auto hits = samples_of(shape, v.labels, centres, {0, 1, 2}).count();
    EXPECT_EQ(hits.otherwise, hits.as_it_lies);
    EXPECT_TRUE(judged_place(v, centres).passed);
  }
}

/// Each symmetry fits worse where a volume has none, and none is counted to the end.
TEST(Placement, LeavesSymmetriesThatFitWorse) {
  std::mt19937 random(62);
  const SmallVolume v = random_volume_of(random, VolumeKind::kNoise, {9, 9, 9}, 3);
  const auto hits = samples_of(v.shape, v.labels, v.labels, {0, 1, 2}).count();
  EXPECT_EQ(hits.as_it_lies, v.labels.size());
  EXPECT_EQ(hits.otherwise, 0U);
}

TEST(Placement, WantsHalfOfTheVoxels) {
  const SmallVolume v = volume_from({8, 6, 4}, 2, [](auto, auto, auto) { return 0; });
  std::vector<Label> centres = v.labels;
  std::fill(centres.begin(), centres.begin() + 95, kLeftOut);
  EXPECT_TRUE(judged_place(v, centres).passed);
  centres[95] = kLeftOut;
  EXPECT_FALSE(judged_place(v, centres).passed);
}

/// A single voxel that one half has more does not make a mesh that of the mirror, however unlucky
/// the centres near it are; many do.
TEST(Placement, LeavesRoomForChance) {
  const auto hits = [](std::uint64_t more, std::uint64_t changed) {
    return PlaceSamples::Hits{1000, 1000 + more, changed}.is_turned();
  };
  EXPECT_FALSE(hits(0, 0));
  EXPECT_FALSE(hits(2, 2));
  EXPECT_FALSE(hits(6, 6));
  EXPECT_FALSE(hits(24, 64));
  EXPECT_TRUE(hits(25, 64));
  EXPECT_TRUE(hits(10, 10));
  EXPECT_FALSE((PlaceSamples::Hits{1000, 900, 0}.is_turned()));
}

TEST(Placement, KnowsWhatWasLeftOut) {
  const WantedCentres wanted =
      wanted_centres(4, {false, true, true, true}, {false, false, false, true});
  EXPECT_EQ(wanted, (WantedCentres{kLeftOut, 1, 2, kUnknown}));
  const std::vector<Label> labels{0, 0, 1, 2, 3}, centres{1, kLeftOut, 1, 1, 1};
  const PlaceTally tally = tally_places(labels, centres, wanted);
  EXPECT_EQ(tally.voxels, 4U);
  EXPECT_EQ(tally.hits, 2U);
  ASSERT_EQ(tally.missed.size(), 1U);
  EXPECT_EQ(tally.missed[0].label, 2U);
  EXPECT_EQ(tally.missed[0].found, 1U);
  EXPECT_EQ(samples_of({5, 1, 1}, labels, centres, wanted).count().as_it_lies, 2U);
}

TEST(Placement, NamesLabelsThatAreExchanged) {
  const LabelText names;
  ExchangedLabels found(names);
  found.add(0, 1, 100, 50);
  EXPECT_EQ(found.found().count(), 0U);
  found.add(3, 5, 100, 51);
  EXPECT_EQ(found.found().text(), "1 pairs of labels exchanged (dense 3 and dense 5)");
}

}  // namespace
}  // namespace mw::audit
