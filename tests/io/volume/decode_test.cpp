// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels in floats and behind a slope and intercept.
#include "io/volume/decode.h"

#include <cmath>
#include <limits>

#include "io/volume/open_volume.h"
#include "tests/io/volume/sample_files.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

template <class Real>
std::string real_bytes(const std::vector<double>& values, bool big) {
  std::string bytes;
  for (const double value : values) {
    const auto real = static_cast<Real>(value);
    std::uint64_t bits = 0;
    std::memcpy(&bits, &real, sizeof real);
    bytes += number_bytes(bits, sizeof real, big);
  }
  return bytes;
}

TEST(Floats, WholeNumbersAreLabels) {
  const TempDir dir;
  const std::vector<double> values{0, 1, -3, 16777215, 255, 1048576, -0.0, 7};
  const std::vector<RawLabel> labels{0, 1, ~std::uint64_t{2}, 16777215, 255, 1048576, 0, 7};
  for (const bool big : {false, true}) {
    const std::string order = big ? ">" : "<";
    const auto narrow = dir.file(
        "a.npy", npy_file(order + "f4", false, "(2, 2, 2)", real_bytes<float>(values, big)));
    const auto wide = dir.file(
        "b.npy", npy_file(order + "f8", false, "(2, 2, 2)", real_bytes<double>(values, big)));
    EXPECT_EQ(read_all(*open_volume(narrow)), labels);
    EXPECT_EQ(read_all(*open_volume(wide)), labels);
    EXPECT_TRUE(has_signed_labels(open_volume(wide)->info()));
  }
}

TEST(Floats, TheFirstThatIsNoLabelIsNamed) {
  const TempDir dir;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {1.5, nan, std::numeric_limits<double>::infinity(), 0x1p63, 1e300}) {
    for (std::size_t position = 0; position < 12; ++position) {
      std::vector<double> values(12, 4);
      values[position] = bad;
      const auto path =
          dir.file("a.npy", npy_file("<f8", false, "(2, 2, 3)", real_bytes<double>(values, false)));
      const std::string where = "voxel (" + std::to_string(position % 3) + ", " +
                                std::to_string(position / 3 % 2) + ", " +
                                std::to_string(position / 6) + ")";
      const std::string why = bad > 2 && std::isfinite(bad) ? "64 bits" : "not a whole number";
      expect_not_read(path, {"a.npy", where, why});
    }
  }
}

TEST(Scaling, KeepsIntegersOrSaysWhichItDoesNot) {
  const TempDir dir;
  NiftiSample sample{.dim = {3, 3, 1, 1, 1, 1, 1, 1}, .slope = 2, .inter = -5, .magic = {}};
  const auto open = [&](const std::string& voxels) {
    return open_volume(dir.file("a.nii", sample.header() + voxels));
  };
  EXPECT_EQ(read_all(*open(std::string("\0\1\7", 3))),
            (std::vector<RawLabel>{static_cast<RawLabel>(-5), static_cast<RawLabel>(-3), 9}));
  EXPECT_TRUE(has_signed_labels(open("abc")->info()));
  sample.slope = 0.5;
  sample.inter = 1;
  EXPECT_EQ(read_all(*open("\4\2\6")), (std::vector<RawLabel>{3, 2, 4}));
  expect_error(ErrorKind::kInput, {"a.nii", "voxel (2, 0, 0)", "times 0.5", "whole"},
               [&] { static_cast<void>(read_all(*open("\4\2\7"))); });
  sample.slope = 0;  // says that nothing is scaled
  EXPECT_EQ(read_all(*open("\4\2\6")), (std::vector<RawLabel>{4, 2, 6}));
}

TEST(Scaling, LargeIntegersLoseNothing) {
  const std::vector<RawLabel> stored{(1ULL << 60) + 1, 3};
  const std::string bytes = voxel_bytes(stored, VoxelType::kU64, false);
  std::vector<RawLabel> out(2);
  const VoxelCoding coding{VoxelType::kU64, ByteOrder::kLittle, {.slope = 2, .intercept = 1}};
  const auto* data = reinterpret_cast<const std::byte*>(bytes.data());
  EXPECT_EQ(decode_voxels(data, 2, 1, coding, out.data(), 1), 2U);
  EXPECT_EQ(out[0], (1ULL << 61) + 3);
  const VoxelCoding much{VoxelType::kU64, ByteOrder::kLittle, {.slope = 1024, .intercept = 0}};
  EXPECT_EQ(decode_voxels(data, 2, 1, much, out.data(), 1), 0U);
}

}  // namespace
}  // namespace mw::io
