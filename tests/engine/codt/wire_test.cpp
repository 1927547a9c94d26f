// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bulk data there and back; counts that do not fit are seen.
#include "engine/codt/wire.h"

#include <gtest/gtest.h>

#include <cstring>

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

}  // namespace
}  // namespace mw::engine::codt
