// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Label coarsening: what it keeps, what it guards, and that it does something.
#include "kernels/start/coarsen/coarsen.h"

#include "kernels/start/carrier_faces.h"
#include "tests/kernels/start/coarsen/coarse_volume.h"
#include "tests/oracle/whole_audit.h"

namespace mw::test {
namespace {

constexpr std::array<double, 4> kBounds{0.8, 1.0, 1.5, 3.0};

Label label_at(const SmallVolume& volume, Index3 v) {
  const Box3 all{{0, 0, 0}, volume.shape};
  return all.contains(v) ? volume.labels[static_cast<std::size_t>(all.offset(v))] : kExterior;
}

/// A volume of any kind, but most often of the one where most can be coarsened.
SmallVolume random_of(std::mt19937& random, std::uint32_t min, std::uint32_t max) {
  const Index3 shape = random_shape(random, min, max);
  const VolumeKind any = random_kind(random);
  const VolumeKind kind = below(random, 3) == 0 ? any : VolumeKind::kBlobs;
  return random_volume_of(random, kind, shape, 1 + below(random, 6));
}

TEST(Promise1Topology, CoarseningKeepsItByRanks) {
  std::mt19937 random(1021);
  int changed = 0;
  for (std::size_t i = 0; i < 500 && !HasFailure(); ++i) {
    const SmallVolume volume = random_of(random, 2, 6);
    SCOPED_TRACE(volume.text());
    const SmallVolume coarse = coarsened(volume, kBounds[i % 4]);
    if (coarse.labels == volume.labels) continue;
    EXPECT_TRUE(betti(coarse) == betti(volume));
    ++changed;
  }
  EXPECT_GT(changed, 60);
}

/// A plate of one voxel keeps all of its voxels, at any place and across any axis.
TEST(Coarsen, LeavesNoNotchInAPlate) {
  const auto is_inside = [](std::int64_t i) { return i >= 3 && i < 10; };
  for (unsigned axis = 0; axis < 3; ++axis) {
    for (const std::int64_t place : {5, 6}) {
      SmallVolume plate{{13, 13, 13}, 2, {}};
      for_each_index(plate.shape, [&](Index3 v) {
        const std::array<std::int64_t, 3> at{v.x, v.y, v.z};
        const bool inside = is_inside(at[(axis + 1) % 3]) && is_inside(at[(axis + 2) % 3]);
        plate.labels.push_back(at[axis] == place && inside ? 1 : 0);
      });
      const SmallVolume coarse = coarsened(plate, 1.5);
      EXPECT_NE(coarse.labels, plate.labels);
      int lost = 0;
      for (std::size_t i = 0; i < plate.labels.size(); ++i) {
        lost += plate.labels[i] == 1 && coarse.labels[i] == 0 ? 1 : 0;
      }
      // Corners have two neighbours in the plate only.
      EXPECT_LE(lost, 4);
    }
  }
}

/// Where cells of four voxels are too large labels stay as they are; elsewhere sizes change
/// nothing.
TEST(Coarsen, LeavesLabelsAloneWhereEdgesAreToBeShort) {
  std::mt19937 random(1030);
  const double diagonal = 4.0 * std::sqrt(3.0);
  int changed = 0;
  for (int i = 0; i < 50; ++i) {
    const SmallVolume volume = random_of(random, 6, 12);
    const Box3 all{{0, 0, 0}, volume.shape};
    const LabelBox before = labels_in(volume, grown(all, kCoarsenHalo));
    const auto with_limit = [&](double limit) {
      SizeField sizes(volume.shape, Metric(), std::vector<double>(volume.label_count, limit), 0.3);
      for_each_index(all, [&](Index3 v) {
        const Label label = label_at(volume, v);
        sizes.add({v, v + Index3{1, 1, 1}}, std::span(&label, 1));
      });
      sizes.spread();
      LabelBox after = before;
      coarsen(before, after, all, {.within = all}, 1.5, &sizes);
      return after.labels;
    };
    LabelBox free = before;
    coarsen(before, free, all, {.within = all}, 1.5);
    EXPECT_EQ(with_limit(diagonal - 0.01), before.labels);
    EXPECT_EQ(with_limit(diagonal + 0.01), free.labels);
    changed += free.labels != before.labels ? 1 : 0;
  }
  EXPECT_GT(changed, 20);
}

/// Cubes that are not in a box stay, and those in it do not see what is farther away than
/// kCoarsenReach.
TEST(Coarsen, WithinABoxSeesNothingBeyondItsReach) {
  std::mt19937 random(1031);
  int changed = 0;
  for (std::size_t i = 0; i < 200 && !HasFailure(); ++i) {
    const SmallVolume volume = random_of(random, 8, 16);
    SCOPED_TRACE(volume.text());
    const Box3 all{{0, 0, 0}, volume.shape};
    const Box3 within{{4, 4, 4}, volume.shape - Index3{3, 3, 3}},
        seen = grown(within, kCoarsenReach);
    const LabelBox before = labels_in(volume, grown(all, kCoarsenHalo));
    LabelBox other = before;
    for_each_index(other.box, [&](Index3 v) {
      if (seen.contains(v)) return;
      other.labels[static_cast<std::size_t>(other.box.offset(v))] = below(random, 6);
    });
    const CoarsenRegion region{.within = within, .keeps_flat = i % 2 == 1};
    LabelBox after = before, after_other = other;
    coarsen(before, after, all, region, kBounds[i % 4]);
    coarsen(other, after_other, all, region, kBounds[i % 4]);
    for_each_index(all, [&](Index3 v) {
      EXPECT_EQ(after.at(v), within.contains(v) ? after_other.at(v) : before.at(v));
    });
    changed += after.labels != before.labels ? 1 : 0;
  }
  EXPECT_GT(changed, 15);
}

/// Bands along an axis stay where they are, at even and odd places; a ball does not.
TEST(Coarsen, KeepsFlatInterfacesWhereThatIsAsked) {
  const Index3 shape{14, 12, 16};
  const auto is_changed = [&](const SmallVolume& volume) {
    const Box3 all{{0, 0, 0}, shape};
    const LabelBox before = labels_in(volume, grown(all, kCoarsenHalo));
    LabelBox after = before;
    coarsen(before, after, all, {.within = all, .keeps_flat = true}, 1.5);
    return after.labels != before.labels;
  };
  for (unsigned axis = 0; axis < 3; ++axis) {
    for (std::int64_t at = 1; at < 8; ++at) {
      SmallVolume bands{shape, 2, {}};
      for_each_index(shape, [&](Index3 v) {
        bands.labels.push_back(along(v, axis) >= at && along(v, axis) < at + 3 ? 1 : 0);
      });
      EXPECT_FALSE(is_changed(bands)) << axis << " " << at;
    }
  }
  SmallVolume ball{shape, 2, {}};
  for_each_index(shape, [&](Index3 v) {
    const Index3 d = v - Index3{6, 6, 7};
    ball.labels.push_back(d.x * d.x + d.y * d.y + d.z * d.z < 20 ? 1 : 0);
  });
  EXPECT_TRUE(is_changed(ball));
}

TEST(Promise1Topology, CoarseningKeepsItOnLargerVolumes) {
  std::mt19937 random(1022);
  int changed = 0;
  for (std::size_t i = 0; i < 800 && !HasFailure(); ++i) {
    const SmallVolume volume = random_of(random, 4, 15);
    SCOPED_TRACE(volume.text());
    const SmallVolume coarse = coarsened(volume, kBounds[i % 4]);
    EXPECT_TRUE(audit::test::voxel_betti(coarse.view(), volume.label_count) ==
                audit::test::voxel_betti(volume.view(), volume.label_count));
    changed += coarse.labels != volume.labels ? 1 : 0;
  }
  EXPECT_GT(changed, 200);
}

/// Tiles of any even size, each from its own part of the volume, fit together to the whole.
TEST(Promise5SameBytes, CoarseningForgetsTheTiles) {
  std::mt19937 random(1023);
  constexpr std::array<Index3, 4> kTiles{{{2, 4, 6}, {8, 8, 8}, {16, 4, 2}, {22, 12, 30}}};
  constexpr std::array<Index3, 4> kShapes{{{61, 7, 9}, {6, 57, 11}, {9, 8, 60}, {38, 37, 5}}};
  int changed = 0;
  for (std::size_t i = 0; i < 24 && !HasFailure(); ++i) {
    const auto kind = static_cast<VolumeKind>(i % audit::test::kVolumeKinds);
    const SmallVolume volume =
        random_volume_of(random, kind, kShapes[i / 4 % 4], 2 + below(random, 4));
    CoarsenStats at_once, tiled;
    const SmallVolume whole = coarsened(volume, 1.5, at_once);
    changed += whole.labels != volume.labels ? 1 : 0;
    const Index3 step = kTiles[i % 4], s = volume.shape;
    for (Index3 lo; lo.z < s.z; lo.z += step.z) {
      for (lo.y = 0; lo.y < s.y; lo.y += step.y) {
        for (lo.x = 0; lo.x < s.x; lo.x += step.x) {
          const Index3 hi = lo + step;
          const Box3 tile{lo, {std::min(hi.x, s.x), std::min(hi.y, s.y), std::min(hi.z, s.z)}};
          ASSERT_EQ(coarsened(volume, tile, 1.5, tiled).labels, labels_in(whole, tile).labels);
        }
      }
    }
    EXPECT_EQ(tiled.mixed_cubes, at_once.mixed_cubes);
    EXPECT_EQ(tiled.made_uniform, at_once.made_uniform);
  }
  EXPECT_GT(changed, 12);
}

/// Output to input, as all voxels of the neighbourhood tell.
void expect_near_its_label(const SmallVolume& before, const SmallVolume& after, double bound) {
  for_each_index(after.shape, [&](Index3 v) {
    bool near = false;
    for_each_index(Box3{v - Index3{3, 3, 3}, v + Index3{4, 4, 4}}, [&](Index3 w) {
      const Index3 d = w - v;
      const double distance = std::sqrt(static_cast<double>(d.x * d.x + d.y * d.y + d.z * d.z));
      near |= distance <= bound && label_at(before, w) == label_at(after, v);
    });
    ASSERT_TRUE(near);
  });
}

/// Distance from a point to a voxel face, in voxels.
double distance_to(const VoxelFace& face, Point p) {
  const std::array<std::int64_t, 3> lo{face.lower.x, face.lower.y, face.lower.z};
  const std::array<std::int32_t, 3> x{p.x, p.y, p.z};
  double sum = 0.0;
  for (unsigned k = 0; k < 3; ++k) {
    const double at = static_cast<double>(x[k]) / kUnitsPerVoxel;
    const double high = static_cast<double>(lo[k]) + 1.0;
    const double low = k == face.axis ? high : high - 1.0;
    sum += std::pow(std::max({low - at, at - high, 0.0}), 2);
  }
  return std::sqrt(sum);
}

/// Calls visit(face, labels) for the faces between labels of the volume.
template <typename Visit>
void each_interface_face(const SmallVolume& volume, Visit visit) {
  for_each_index(volume.shape, [&](Index3 v) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const VoxelFace face{v, axis};
      const Label a = label_at(volume, v), b = label_at(volume, face.upper());
      if (a != b && b != kExterior) visit(face, label_pair(a, b));
    }
  });
}

/// Input to output, over all faces of the output.
void expect_samples_carried(const SmallVolume& before, const SmallVolume& after, double bound) {
  std::map<std::pair<Label, Label>, std::vector<VoxelFace>> faces;
  each_interface_face(after, [&](const VoxelFace& face, LabelPair labels) {
    faces[{labels.low, labels.high}].push_back(face);
  });
  each_interface_face(before, [&](const VoxelFace& face, LabelPair labels) {
    for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
      const Point p = sample_position(face_samples(face.lower, face.axis, kAllQuarters), quarter);
      double nearest = 1e9;
      for (const VoxelFace& f : faces[{labels.low, labels.high}]) {
        nearest = std::min(nearest, distance_to(f, p));
      }
      ASSERT_LE(nearest, bound - kSampleCoveringRadius + 1e-12);
    }
  });
}

TEST(Promise4Distance, CoarseningKeepsTheBoundBothWays) {
  std::mt19937 random(1024);
  int changed = 0;
  for (std::size_t i = 0; i < 1200 && !HasFailure(); ++i) {
    const SmallVolume volume = random_of(random, 2, 10);
    SCOPED_TRACE(volume.text());
    const double bound = kBounds[i % 4];
    const SmallVolume coarse = coarsened(volume, bound);
    if (coarse.labels == volume.labels) continue;
    ++changed;
    expect_near_its_label(volume, coarse, bound);
    expect_samples_carried(volume, coarse, bound);
  }
  EXPECT_GT(changed, 250);
}

/// Faces of the output by what may carry: labels, axis, and the label on the lower side.
using Carriers = std::map<std::tuple<Label, Label, unsigned, Label>, std::vector<VoxelFace>>;

/// The distance bound again, by faces that look their way where the axis is the same.
void expect_oriented_carriers(const SmallVolume& before, const SmallVolume& after, double bound) {
  Carriers carriers;
  each_interface_face(after, [&](const VoxelFace& face, LabelPair labels) {
    carriers[{labels.low, labels.high, face.axis, label_at(after, face.lower)}].push_back(face);
  });
  const LabelBox original{{{0, 0, 0}, before.shape}, before.labels};
  const LabelBox coarse{{{0, 0, 0}, after.shape}, after.labels};
  each_interface_face(before, [&](const VoxelFace& face, LabelPair labels) {
    double best = 1e9;
    for (const auto& [key, faces] : carriers) {
      const auto [low, high, axis, lower] = key;
      const bool same_labels = LabelPair{low, high} == labels;
      const bool may = same_labels && (axis != face.axis || lower == label_at(before, face.lower));
      for (const VoxelFace& f : faces) {
        ASSERT_EQ(may_carry(coarse, f, original, face), may);
        if (!may) continue;
        double farthest = 0.0;
        for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
          const FaceSamples samples = face_samples(face.lower, face.axis, kAllQuarters);
          farthest = std::max(farthest, distance_to(f, sample_position(samples, quarter)));
        }
        best = std::min(best, farthest);
      }
    }
    ASSERT_LE(best, bound - kSampleCoveringRadius + 1e-12);
  });
}

/// One carrier for all four samples of a face.
TEST(Promise4Distance, CoarseningLeavesACarrierThatLooksTheSameWay) {
  std::mt19937 random(1027);
  int changed = 0;
  for (std::size_t i = 0; i < 600 && !HasFailure(); ++i) {
    const SmallVolume volume =
        i % 3 == 0 ? random_volume_of(random, VolumeKind::kSheets, {8, 7, 6}, 2 + below(random, 3))
                   : random_of(random, 2, 8);
    SCOPED_TRACE(volume.text());
    const double bound = kBounds[i % 3];
    const SmallVolume coarse = coarsened(volume, bound);
    if (coarse.labels == volume.labels) continue;
    ++changed;
    expect_oriented_carriers(volume, coarse, bound);
  }
  EXPECT_GT(changed, 100);
}

/// Is the whole cube inside the volume, and of one label there?
struct CubeLabels {
  bool inside = true;
  std::vector<Label> labels;

  CubeLabels(const SmallVolume& volume, Index3 lo) {
    for_each_index(Box3{lo, lo + Index3{2, 2, 2}}, [&](Index3 v) {
      labels.push_back(label_at(volume, v));
      inside &= labels.back() != kExterior;
    });
  }
  [[nodiscard]] bool uniform() const {
    return std::ranges::count(labels, labels[0]) == std::ssize(labels);
  }
};

/// A cube becomes uniform, of a label that it had, or it stays; the statistics count them.
TEST(Coarsen, ChangesWholeCubesOrNothing) {
  std::mt19937 random(1025);
  std::uint64_t uniform_in_all = 0;
  for (int i = 0; i < 400 && !HasFailure(); ++i) {
    const SmallVolume volume = random_of(random, 1, 16);
    CoarsenStats stats;
    const SmallVolume coarse = coarsened(volume, 1.5, stats);
    std::uint64_t mixed = 0, made_uniform = 0;
    const Index3 s = volume.shape;
    for_each_index(Index3{(s.x + 1) / 2, (s.y + 1) / 2, (s.z + 1) / 2}, [&](Index3 c) {
      const Index3 lo{2 * c.x, 2 * c.y, 2 * c.z};
      const CubeLabels before(volume, lo), after(coarse, lo);
      if (before.labels == after.labels) {
        mixed += before.inside && !before.uniform() ? 1U : 0U;
        return;
      }
      ++mixed;
      ++made_uniform;
      EXPECT_TRUE(before.inside && !before.uniform() && after.uniform());
      EXPECT_NE(std::ranges::count(before.labels, after.labels[0]), 0);
    });
    EXPECT_EQ(stats.mixed_cubes, mixed);
    EXPECT_EQ(stats.made_uniform, made_uniform);
    uniform_in_all += made_uniform;
  }
  EXPECT_GT(uniform_in_all, 1000U);
}

TEST(Coarsen, MakesMostCubesOfSmoothShapesUniform) {
  std::mt19937 random(1026);
  CoarsenStats stats;
  for (int i = 0; i < 16; ++i) {
    static_cast<void>(
        coarsened(random_volume_of(random, VolumeKind::kBlobs, {24, 24, 24}, 2 + below(random, 3)),
                  1.5, stats));
  }
  EXPECT_GT(stats.mixed_cubes, 2000U);
  EXPECT_GT(stats.made_uniform, stats.mixed_cubes * 3 / 4);
}

TEST(Coarsen, LeavesWhatHasNoWayToUniformity) {
  const std::array<SmallVolume, 5> volumes{
      volume_from({9, 8, 7}, 2, [](auto x, auto y, auto z) { return (x + y + z) % 2; }),
      volume_from({8, 8, 8}, 1, [](auto, auto, auto) { return 0; }),
      volume_from({1, 1, 1}, 1, [](auto, auto, auto) { return 0; }),
      volume_from({1, 9, 12}, 3, [](auto, auto y, auto z) { return (y / 3 + z / 3) % 3; }),
      // A single voxel would vanish.
      volume_from({6, 6, 6}, 2, [](auto x, auto y, auto z) { return x == 3 && y == 2 && z == 2; })};
  for (const SmallVolume& volume : volumes) {
    for (const double bound : kBounds) EXPECT_EQ(coarsened(volume, bound).labels, volume.labels);
  }
}

}  // namespace
}  // namespace mw::test
