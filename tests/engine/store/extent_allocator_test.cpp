// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Extents never share a sector, and what is released comes back whole.
#include "engine/store/table/extent_allocator.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace mw::engine {
namespace {

constexpr std::uint64_t kSector = ExtentAllocator::kSectorBytes;
constexpr std::uint64_t kSectors = 256;

/// The reference: which sectors are taken, by a list of all of them.
class Sectors {
 public:
  /// False when one of them is not as it was.
  bool set(const Extent& e, bool taken) {
    if (e.offset % kSector != 0 || e.offset + e.size > kSectors * kSector) return false;
    for (std::uint64_t s = e.offset / kSector; s * kSector < e.offset + e.size; ++s) {
      if (taken_[s] == taken) return false;
      taken_[s] = taken;
    }
    return true;
  }
  [[nodiscard]] std::uint64_t longest_free() const {
    std::uint64_t longest = 0, run = 0;
    for (bool taken : taken_) {
      run = taken ? 0 : run + 1;
      longest = std::max(longest, run);
    }
    return longest * kSector;
  }

 private:
  std::vector<bool> taken_ = std::vector<bool>(kSectors, false);
};

TEST(ExtentAllocator, AgreesWithAListOfSectors) {
  std::mt19937 random(311);
  for (int trial = 0; trial < 20; ++trial) {
    ExtentAllocator allocator;
    allocator.grow(kSectors * kSector / 2);
    allocator.grow(kSectors * kSector);
    Sectors sectors;
    std::vector<Extent> held;
    for (int i = 0; i < 2000; ++i) {
      if (held.empty() || random() % 2 == 0) {
        const std::uint64_t size = 1 + random() % (12 * kSector);
        const auto extent = allocator.allocate(size);
        ASSERT_EQ(extent.has_value(), size <= sectors.longest_free());
        if (!extent) continue;
        ASSERT_EQ(extent->size, size);
        ASSERT_TRUE(sectors.set(*extent, true));
        held.push_back(*extent);
      } else {
        std::swap(held[random() % held.size()], held.back());
        allocator.release(held.back());
        ASSERT_TRUE(sectors.set(held.back(), false));
        held.pop_back();
      }
    }
    for (const Extent& e : held) allocator.release(e);
    EXPECT_EQ(allocator.free_bytes(), kSectors * kSector);
    EXPECT_TRUE(allocator.allocate(kSectors * kSector));
  }
}

TEST(ExtentAllocator, TakesGivenExtentsOnce) {
  ExtentAllocator allocator;
  allocator.grow(16 * kSector);
  EXPECT_TRUE(allocator.take({4 * kSector, 3 * kSector - 5}));
  EXPECT_FALSE(allocator.take({6 * kSector, kSector}));
  EXPECT_FALSE(allocator.take({3 * kSector, 2 * kSector}));
  EXPECT_FALSE(allocator.take({15 * kSector, 2 * kSector}));
  EXPECT_FALSE(allocator.take({99 * kSector, 1}));
  EXPECT_TRUE(allocator.take({7 * kSector, kSector}));
  EXPECT_EQ(allocator.free_bytes(), 12 * kSector);
}

}  // namespace
}  // namespace mw::engine
