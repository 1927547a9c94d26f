// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels between thick slices: what is kept, whatever is read, and bodies whose shape is known.
#include "io/labels/interpolated_volume.h"

#include <map>
#include <set>

#include "kernels/core/metric.h"
#include "tests/expect_error.h"
#include "tests/io/labels/memory_volume.h"

namespace mw::io {
namespace {

using audit::test::below;
using audit::test::random_volume_of;
using audit::test::SmallVolume;
using audit::test::VolumeKind;

std::int64_t& along(Index3& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

std::vector<RawLabel> read_all(const LabelVolume& volume) {
  const Box3 whole{{0, 0, 0}, volume.info().shape};
  std::vector<RawLabel> out(static_cast<std::size_t>(whole.voxels()));
  volume.read(whole, out);
  return out;
}

/// A random volume whose slices along `axis` are `layers` times as thick as voxels are wide.
MemoryVolume random_slices(std::mt19937& random, int axis, int layers) {
  const auto kind = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
  const Index3 shape{3 + below(random, 8), 3 + below(random, 8), 3 + below(random, 8)};
  const SmallVolume small = random_volume_of(random, kind, shape, 2 + below(random, 3));
  MemoryVolume out = volume_of(small, VoxelType::kU16, {7, 0, 300, 12});
  out.info().space.spacing[static_cast<std::size_t>(axis)] = layers;
  return out;
}

/// Calls use(volume below, interpolated volume, its labels, axis, layers) for random volumes.
template <typename Use>
void each_random(std::uint32_t seed, Use use) {
  std::mt19937 random(seed);
  for (int i = 0; i < 120 && !testing::Test::HasFailure(); ++i) {
    const int axis = i % 3, layers = 2 + static_cast<int>(below(random, 6));
    const MemoryVolume below_it = random_slices(random, axis, layers);
    const InterpolatedVolume volume(below_it);
    use(below_it, volume, read_all(volume), axis, layers);
  }
}

RawLabel label_at(const InterpolatedVolume& volume, const std::vector<RawLabel>& all, Index3 v) {
  return all[static_cast<std::size_t>(Box3{{0, 0, 0}, volume.info().shape}.offset(v))];
}

TEST(InterpolatedVolume, HasThinSlicesInPlaceOfThickOnes) {
  each_random(701, [](const MemoryVolume& thick, const InterpolatedVolume& volume, const auto&,
                      int axis, int layers) {
    Index3 shape = thick.info().shape;
    along(shape, axis) *= layers;
    EXPECT_EQ(volume.info().shape, shape);
    EXPECT_EQ(volume.info().space.spacing, (Vector3{1, 1, 1}));
    EXPECT_EQ(volume.facts().layers, layers);
    EXPECT_EQ(volume.facts().axis, axis);
  });
}

/// So labels that are in a slice are in the volume, too, with all their parts.
TEST(InterpolatedVolume, KeepsTheLabelsOfEachSliceInItsMiddle) {
  each_random(702, [](const MemoryVolume& thick, const InterpolatedVolume& volume, const auto& all,
                      int axis, int layers) {
    for_each_index(thick.info().shape, [&](Index3 v) {
      Index3 middle = v;
      along(middle, axis) = along(middle, axis) * layers + (layers - 1) / 2;
      EXPECT_EQ(label_at(volume, all, middle), thick.at(v));
    });
  });
}

/// Between the middles of two slices a pixel has the label of the one, then that of the other.
TEST(InterpolatedVolume, ChangesOnceBetweenSlicesAndOnlyToTheirLabels) {
  each_random(703, [](const MemoryVolume& thick, const InterpolatedVolume& volume, const auto& all,
                      int axis, int layers) {
    for_each_index(volume.info().shape, [&](Index3 v) {
      const std::int64_t place = along(v, axis), middle = (layers - 1) / 2;
      Index3 lower = v;
      along(lower, axis) = std::max<std::int64_t>(place - middle, 0) / layers;
      Index3 upper = lower;
      const Index3 shape = thick.info().shape;
      const std::int64_t last = (axis == 0 ? shape.x : axis == 1 ? shape.y : shape.z) - 1;
      along(upper, axis) = std::min(along(upper, axis) + 1, last);
      if (place < middle) upper = lower;
      const RawLabel here = label_at(volume, all, v);
      EXPECT_TRUE(here == thick.at(lower) || here == thick.at(upper));
      Index3 next = v;
      along(next, axis) += 1;
      const bool in_gap = (place - middle) % layers != layers - 1 && place >= middle;
      if (!in_gap || along(next, axis) >= (last + 1) * layers) return;
      if (here == thick.at(upper)) {
        EXPECT_EQ(label_at(volume, all, next), here);
      }
    });
  });
}

TEST(InterpolatedVolume, Promise5ReadsTheSameInAnyBox) {
  std::mt19937 random(704);
  each_random(
      705, [&](const MemoryVolume&, const InterpolatedVolume& volume, const auto& all, int, int) {
        for (int i = 0; i < 4; ++i) expect_box(volume, all, random);
      });
}

TEST(InterpolatedVolume, IsMirroredWithItsSlices) {
  each_random(706, [](const MemoryVolume& thick, const InterpolatedVolume& volume, const auto& all,
                      int axis, int layers) {
    if (layers % 2 == 0) return;
    const Index3 shape = thick.info().shape, thin = volume.info().shape;
    const auto mirrored = [axis](Index3 v, Index3 in) {
      along(v, axis) = along(in, axis) - 1 - along(v, axis);
      return v;
    };
    MemoryVolume other(shape, thick.info().type, thick.labels());
    other.info().space = thick.info().space;
    for_each_index(shape, [&](Index3 v) { other.set(v, thick.at(mirrored(v, shape))); });
    const InterpolatedVolume view(other);
    const std::vector<RawLabel> found = read_all(view);
    for_each_index(thin, [&](Index3 v) {
      EXPECT_EQ(label_at(view, found, v), label_at(volume, all, mirrored(v, thin)));
    });
  });
}

/// Samples a body, whose middle is that of the volume, in slices `layers` times as thick.
template <typename Inside>
MemoryVolume sampled(Index3 shape, int layers, Inside inside) {
  std::vector<RawLabel> labels;
  for_each_index(shape, [&](Index3 v) {
    const Vec3 middle(static_cast<double>(shape.x) / 2, static_cast<double>(shape.y) / 2,
                      static_cast<double>(shape.z * layers) / 2);
    const Vec3 centre(static_cast<double>(v.x) + 0.5, static_cast<double>(v.y) + 0.5,
                      (static_cast<double>(v.z) + 0.5) * layers);
    labels.push_back(inside(Vec3(centre - middle)) ? 1 : 0);
  });
  MemoryVolume out(shape, VoxelType::kU8, std::move(labels));
  out.info().space.spacing[2] = layers;
  return out;
}

struct Share {
  double wrong = 0;   ///< voxels with the wrong label, in those of the body
  double volume = 0;  ///< of the body, in the true one
};

/// Compares thin slices, interpolated or repeated, with the body sampled in them.
Share compare(const MemoryVolume& thick, const MemoryVolume& truth, bool interpolated) {
  const InterpolatedVolume volume(thick);
  const std::vector<RawLabel> all = read_all(volume);
  const std::int64_t layers = volume.facts().layers;
  double wrong = 0, found = 0, wanted = 0;
  for_each_index(truth.info().shape, [&](Index3 v) {
    const RawLabel repeated = thick.at({v.x, v.y, v.z / layers});
    const RawLabel here = interpolated ? label_at(volume, all, v) : repeated;
    wrong += here == truth.at(v) ? 0 : 1;
    found += here == 1 ? 1 : 0;
    wanted += truth.at(v) == 1 ? 1 : 0;
  });
  return {wrong / wanted, found / wanted};
}

TEST(InterpolatedVolume, IsMuchNearerToSmoothBodiesThanSlicesAre) {
  const auto ellipsoid = [](const Vec3& p) {
    const Vec3 tilted(0.8 * p[0] + 0.6 * p[2], p[1], 0.8 * p[2] - 0.6 * p[0]);
    return tilted.cwiseQuotient(Vec3(26, 16, 20)).squaredNorm() < 1;
  };
  const auto torus = [](const Vec3& p) {
    const double ring = std::hypot(p[0], p[2]) - 18;
    return ring * ring + p[1] * p[1] < 64;
  };
  const auto ball = [](const Vec3& p) { return p.squaredNorm() < 22 * 22; };
  const auto check = [](auto body) {
    for (const int layers : {3, 4, 6}) {
      const std::int64_t slices = 60 / layers;
      const MemoryVolume thick = sampled({60, 60, slices}, layers, body);
      const MemoryVolume truth = sampled({60, 60, slices * layers}, 1, body);
      const Share as_it_is = compare(thick, truth, false), smooth = compare(thick, truth, true);
      EXPECT_LT(smooth.wrong, 0.6 * as_it_is.wrong) << layers;
      EXPECT_NEAR(smooth.volume, 1.0, 0.02) << layers;
    }
  };
  check(ellipsoid);
  check(torus);
  check(ball);
}

TEST(InterpolatedVolume, IsRefusedWhereThereIsNothingBetweenSlices) {
  MemoryVolume cubes({4, 4, 4}, VoxelType::kU8, std::vector<RawLabel>(64, 1));
  const auto expect_refused = [](const MemoryVolume& volume, const std::string& piece) {
    expect_error(ErrorKind::kUsage, {"--interpolate-slices:", piece},
                 [&] { const InterpolatedVolume view(volume); });
  };
  expect_refused(cubes, "voxels of 1 x 1 x 1 are no thick slices");
  cubes.info().space.spacing = {1, 1, 1.4};
  expect_refused(cubes, "no thick slices");
  MemoryVolume one({4, 1, 4}, VoxelType::kU8, std::vector<RawLabel>(16, 1));
  one.info().space.spacing = {1, 3, 1};
  expect_refused(one, "there is one slice only along y");
}

}  // namespace
}  // namespace mw::io
