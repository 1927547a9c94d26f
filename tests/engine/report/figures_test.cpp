// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lines that tell facts of a tree.
#include "engine/report/figures.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mw::report {
namespace {

using io::Json;

const Json& facts() {
  static const Json out{{"tets", 41247},
                        {"file", "a {tets}.npy"},
                        {"shape", {60, 26, 44}},
                        {"quality", {{"least", 0.20043}, {"mean", 1040.4}, {"share", -0.00001}}},
                        {"bytes", std::uint64_t{11} << 30U},
                        {"count", nullptr}};
  return out;
}

TEST(Told, FactsStandInThePlaceOfTheirNames) {
  EXPECT_EQ(told("", facts()), "");
  EXPECT_EQ(told("no fact\n", facts()), "no fact\n");
  EXPECT_EQ(told("{tets}", facts()), "41247");
  EXPECT_EQ(told("tets {tets:,}, {file}.", facts()), "tets 41,247, a {tets}.npy.");
  EXPECT_EQ(told("{shape} voxels", facts()), "60 x 26 x 44 voxels");
}

TEST(Told, NumbersHaveTheirForms) {
  EXPECT_EQ(told("{quality.least:2} {quality.least:g} {quality.least:1%} {quality.least}", facts()),
            "0.20 0.2004 20.0 % 0.20043");
  EXPECT_EQ(told("{quality.mean:g} {quality.mean:n} {quality.least:n}", facts()),
            "1040 1,040 0.2004");
  EXPECT_EQ(told("{quality.share:2%}", facts()), "0.00 %");
  EXPECT_EQ(short_number(1040.4), "1,040");
  EXPECT_EQ(short_number(2e18), "2e+18");
  EXPECT_EQ(told("{bytes:b} {tets:b}", facts()), "11.0 GiB 0.0 MiB");
}

TEST(Told, NothingIsToldOfWhatIsNotThere) {
  EXPECT_EQ(told("{tets} of {count} tets", facts()), "");
  EXPECT_EQ(told("{tets} of {count.pilot.expected} tets", facts()), "");
  EXPECT_EQ(told("{tets} tets", nullptr), "");
  EXPECT_THROW((void)told("{tet} tets", facts()), std::out_of_range);
  EXPECT_THROW((void)told("{quality.lest:2}", facts()), std::out_of_range);
}

}  // namespace
}  // namespace mw::report
