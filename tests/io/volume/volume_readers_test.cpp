// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The budget that an error names is one that works.
#include "io/volume/volume_readers.h"

#include <regex>

#include "kernels/core/error.h"
#include "tests/testing.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

/// A store of one large chunk, whose cache grows with the budget.
class LargeChunk : public LabelVolume {
 public:
  LargeChunk(std::uint64_t chunk, std::uint64_t memory) : bytes_(chunk + memory / 4) {}
  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  void read(const Box3& /*box*/, std::span<RawLabel> /*out*/) const override {}
  [[nodiscard]] std::uint64_t buffer_bytes(int /*threads*/) const override { return bytes_; }

 private:
  VolumeInfo info_;
  std::uint64_t bytes_;
};

/// Returns the MiB that the error names; 0 where there is none.
std::uint64_t named(std::uint64_t chunk, std::uint64_t memory, std::uint64_t beside) {
  try {
    check_unpacking(LargeChunk(chunk, memory), {.memory = memory, .beside = beside});
    return 0;
  } catch (const Error& error) {
    const std::string told = error.what();
    std::smatch found;
    const std::regex least("at least --memory ([0-9]+)MiB");
    EXPECT_TRUE(std::regex_search(told, found, least)) << told;
    return found.empty() ? 0 : std::stoull(found[1]);
  }
}

TEST(CheckUnpacking, NamesTheLeastBudgetThatWorks) {
  std::mt19937_64 random(4411);
  int refused = 0;
  for (int i = 0; i < 200; ++i) {
    const std::uint64_t chunk = random() % (200 * kMiB), beside = (10 + random() % 90) * kMiB;
    const std::uint64_t least = named(chunk, (1 + random() % 100) * kMiB, beside);
    if (least == 0) continue;
    ++refused;
    EXPECT_EQ(named(chunk, least * kMiB, beside), 0U);
    EXPECT_GT(named(chunk, (least - 2) * kMiB, beside), 0U) << "a smaller one works as well";
  }
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace mw::io
