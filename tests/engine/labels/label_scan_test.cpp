// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How many threads read a volume, on a disk and far away.
#include "engine/labels/label_scan.h"

#include <gtest/gtest.h>

namespace mw::engine {
namespace {

/// A volume of which nothing is read.
class ToldVolume : public io::LabelVolume {
 public:
  explicit ToldVolume(bool is_far, std::uint64_t each = 0) : each_(each) {
    info_.shape = {64, 64, 64};
    info_.is_far = is_far;
  }
  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }
  void read(const Box3& /*box*/, std::span<RawLabel> /*out*/) const override { FAIL(); }
  [[nodiscard]] std::uint64_t buffer_bytes(int threads) const override {
    return each_ * static_cast<std::uint64_t>(threads);
  }

 private:
  io::VolumeInfo info_;
  std::uint64_t each_;
};

TEST(ReaderCount, EightReadWhatIsFarWhateverThreadsAre) {
  const ReaderRoom much{.each = 1, .memory = 1 << 20};
  EXPECT_EQ(reader_count(ToldVolume(false), 1, much), 1);
  EXPECT_EQ(reader_count(ToldVolume(true), 1, much), 8);
  EXPECT_EQ(reader_count(ToldVolume(true), 12, much), 12);
  EXPECT_EQ(reader_count(ToldVolume(false), 12, much), 12);
}

TEST(ReaderCount, ReadersStayWithinTheirPartsOfMemory) {
  EXPECT_EQ(reader_count(ToldVolume(true), 1, {.each = 10, .memory = 200}), 5);
  EXPECT_EQ(reader_count(ToldVolume(true), 1, {.each = 10, .memory = 20}), 1);
  EXPECT_EQ(reader_count(ToldVolume(true, 20), 1, {.each = 10, .memory = 200}), 3);
  EXPECT_EQ(reader_count(ToldVolume(true, 500), 1, {.each = 10, .memory = 200}), 1);
}

}  // namespace
}  // namespace mw::engine
