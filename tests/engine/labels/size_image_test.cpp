// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// All of an image is read in its order, by pieces of bounded size.
#include "engine/labels/size_image.h"

#include <bit>
#include <cmath>
#include <limits>

#include "tests/testing.h"

namespace mw::engine {
namespace {

/// An image of numbers that are a function of the place; some are no sizes.
class NumberedImage : public io::LabelVolume, public io::NumberVolume {
 public:
  explicit NumberedImage(Index3 shape) { info_.shape = shape; }

  [[nodiscard]] static double number(Index3 v) {
    const auto n = static_cast<double>((v.x * 31 + v.y * 17 + v.z * 101) % 997);
    return n - 20;
  }

  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }
  void read(const Box3& /*box*/, std::span<RawLabel> /*out*/) const override {
    ADD_FAILURE() << "sizes are no labels";
  }
  void read_numbers(const Box3& box, std::span<double> out) const override {
    most_ = std::max(most_, box.voxels());
    all_ += box.voxels();
    for_each_index(box,
                   [&](Index3 v) { out[static_cast<std::size_t>(box.offset(v))] = number(v); });
  }

  [[nodiscard]] std::int64_t most() const { return most_; }
  [[nodiscard]] std::int64_t all() const { return all_; }

 private:
  io::VolumeInfo info_;
  mutable std::int64_t most_ = 0;
  mutable std::int64_t all_ = 0;
};

/// FNV-1a over all sizes, x fastest, which runs have saved and compare.
std::uint64_t hash_of(Index3 shape) {
  std::uint64_t sum = 14695981039346656037U;
  for_each_index(shape, [&](Index3 v) {
    const double n = NumberedImage::number(v);
    const double size = n > 0 ? n : std::numeric_limits<double>::infinity();
    sum = (sum ^ std::bit_cast<std::uint64_t>(size)) * 1099511628211U;
  });
  return sum;
}

double least_of(Index3 shape) {
  double least = std::numeric_limits<double>::infinity();
  for_each_index(shape, [&](Index3 v) {
    const double n = NumberedImage::number(v);
    if (n > 0) least = std::min(least, n);
  });
  return least;
}

TEST(SizeImage, ReadsAllByPiecesInTheSameOrder) {
  constexpr std::int64_t kMostVoxels = 1 << 16;
  for (const Index3 shape : {Index3{7, 5, 3}, Index3{300, 700, 2}, Index3{70'001, 3, 2},
                             Index3{1, 140'000, 1}, Index3{kMostVoxels, 2, 1}}) {
    const NumberedImage image(shape);
    const SizeImage sizes(image, image.info(), "sizes.npy");
    EXPECT_EQ(sizes.fingerprint(), hash_of(shape));
    EXPECT_EQ(image.all(), shape.product()) << "each voxel is read once";
    EXPECT_EQ(sizes.least(), least_of(shape));
    EXPECT_LE(image.most(), kMostVoxels);
  }
}

TEST(SizeImage, APartHasTheSizesOfItsVoxels) {
  const NumberedImage image({9, 8, 7});
  const Box3 voxels{{2, 3, 1}, {7, 8, 5}};
  const SizeImage part = SizeImage(image, image.info(), "sizes.npy").scaled(2).part(voxels);
  const Index3 layers{1, 2, 3}, lattice{5, 10, 12};
  const Box3 box{{1, 3, 2}, {5, 10, 11}};
  const std::vector<double> found = part.read(box, lattice);
  for_each_index(box, [&](Index3 v) {
    const Index3 voxel = voxels.lo + Index3{v.x, v.y / layers.y, v.z / layers.z};
    const double n = NumberedImage::number(voxel);
    const double size = n > 0 ? 2 * n : std::numeric_limits<double>::infinity();
    EXPECT_EQ(found[static_cast<std::size_t>(box.offset(v))], size);
  });
}

}  // namespace
}  // namespace mw::engine
