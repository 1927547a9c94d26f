// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The order of names of slices, and numbers that are missing among them.
#include "io/volume/slices/slice_folder.h"

#include <random>

#include "tests/testing.h"

namespace mw::io {
namespace {

TEST(NaturalOrder, NumbersAreComparedAsNumbers) {
  const std::vector<std::string> ordered{
      "1",     "2",        "10",     "a",       "a1b2",
      "a1b10", "a2",       "a02x",   "a2y",     "a10",
      "b",     "slice001", "slice2", "slice10", "slice99999999999999999999999",
      "t"};
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    for (std::size_t j = 0; j < ordered.size(); ++j) {
      EXPECT_EQ(comes_before(ordered[i], ordered[j]), i < j) << ordered[i] << " " << ordered[j];
    }
  }
}

/// Short names of few letters: any two are ordered, and any three in a row.
TEST(NaturalOrder, IsAStrictTotalOrder) {
  std::mt19937 random(3);
  const auto name = [&] {
    std::string out;
    for (auto i = random() % 5; i > 0; --i) out += "01a."[random() % 4];
    return out;
  };
  for (int i = 0; i < 20000; ++i) {
    const std::string a = name(), b = name(), c = name();
    EXPECT_EQ(comes_before(a, b) || comes_before(b, a), a != b) << a << " " << b;
    EXPECT_FALSE(comes_before(a, b) && comes_before(b, a)) << a << " " << b;
    if (comes_before(a, b) && comes_before(b, c)) {
      EXPECT_TRUE(comes_before(a, c)) << a << " " << b << " " << c;
    }
  }
}

TEST(NaturalOrder, GapsAreFoundWhereOnlyANumberDiffers) {
  const auto gap = [](const std::vector<std::string>& names) {
    const auto found = find_gap(names);
    return found ? found->a + "-" + found->b : "none";
  };
  EXPECT_EQ(gap({"s1", "s2", "s3"}), "none");
  EXPECT_EQ(gap({"s08", "s10", "s12"}), "none");
  EXPECT_EQ(gap({"s1", "s2", "s4"}), "s2-s4");
  EXPECT_EQ(gap({"s1", "s3", "s4"}), "s1-s3");
  EXPECT_EQ(gap({"s1", "s01", "s2"}), "s01-s2");
  EXPECT_EQ(gap({"a1", "a2", "b9"}), "none");
  EXPECT_EQ(gap({"a1b1", "a2b2", "a2b9"}), "none");
  EXPECT_EQ(gap({"a1", "a9"}), "none");
}

}  // namespace
}  // namespace mw::io
