// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bulk data there and back; counts that do not fit are seen.
#include <unistd.h>

#include "engine/codt/wire.h"
#include "kernels/core/error.h"
#include "tests/testing.h"

namespace mw::engine::codt {
namespace {

const Plc kPlc{{{0.5, -1.0, 3e9}, {1, 2, 3}}, {{0, 1, 0xffffffff}}, {{4, 5, 6}, {7, 8, 9}}};
const Triangulation kMade{{{1, 2, 3}}, {{0, 1, 2, 3}, {3, 2, 1, 4}}, {7, 0xffffffff}};

TEST(Wire, CarriesRequestsAndAnswers) {
  for (std::size_t room : {0U, 100U}) {  // memory is longer than what is in it
    std::vector<std::byte> bytes(bytes_of(kPlc) + room);
    put(kPlc, bytes);
    const std::optional<Plc> plc = get_plc(bytes);
    ASSERT_TRUE(plc);
    EXPECT_EQ(plc->points, kPlc.points);
    EXPECT_EQ(plc->facets, kPlc.facets);
    EXPECT_EQ(plc->seeds, kPlc.seeds);
    bytes.resize(bytes_of(kMade) + room);
    put(kMade, bytes);
    const std::optional<Triangulation> made = get_triangulation(bytes);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->added, kMade.added);
    EXPECT_EQ(made->tets, kMade.tets);
    EXPECT_EQ(made->regions, kMade.regions);
  }
  std::vector<std::byte> empty(bytes_of(Plc{}));
  put(Plc{}, empty);
  EXPECT_TRUE(get_plc(empty));
}

TEST(Wire, SeesShortBytes) {
  std::vector<std::byte> bytes(bytes_of(kMade));
  put(kMade, bytes);
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_FALSE(get_triangulation(std::span(bytes).first(n))) << n;
  }
  for (std::size_t count = 0; count < 3; ++count) {
    for (const std::uint64_t wrong :
         {std::uint64_t{1000}, ~std::uint64_t{0}, std::uint64_t{1} << 62}) {
      std::vector<std::byte> spoiled = bytes;
      std::memcpy(spoiled.data() + 8 * count, &wrong, 8);
      EXPECT_FALSE(get_triangulation(spoiled));
      EXPECT_FALSE(get_plc(spoiled));
    }
  }
}

// Memory that workers share, and what is left of it where there is none.

/// Names of this process in /dev/shm.
std::size_t names_left() {
  std::size_t out = 0;
  const std::string ours = "mwmesh-" + std::to_string(::getpid()) + "-";
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm")) {
    if (entry.path().filename().string().starts_with(ours)) ++out;
  }
  return out;
}

// The pages are taken at once: a worker that writes where no page is would die of a signal.
TEST(SharedMemory, MoreThanThereIsIsAnErrorAndLeavesNoName) {
  constexpr std::size_t kTooMuch = std::size_t{1} << 60U;  // bytes
  try {
    const SharedMemory memory = SharedMemory::create(kTooMuch);
    FAIL() << "there was so much";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
    const std::string text = error.what();
    EXPECT_NE(text.find(std::to_string(kTooMuch) + " bytes"), std::string::npos) << text;
    EXPECT_NE(text.find("/dev/shm"), std::string::npos) << text;
  }
  EXPECT_EQ(names_left(), 0U);
}

TEST(SharedMemory, OfAnUnknownNameIsAnError) {
  EXPECT_THROW(static_cast<void>(SharedMemory::open("mwmesh-no-such-name")), Error);
}

}  // namespace
}  // namespace mw::engine::codt
