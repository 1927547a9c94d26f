// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The boxes in which incomplete runs may have seen other labels.
#include "engine/keep/keep_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using mw::test::TempFolder;

bool covers(const std::vector<Box3>& boxes, const Box3& one) {
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const Box3& box) { return hull(box, one) == box; });
}

Box3 box_at(std::int64_t x) {
  return {{x, 0, 0}, {x + 1, 1, 1}};
}

TEST(KeepFolder, RemembersTheBoxesOfIncompleteRuns) {
  const TempFolder temp;
  const KeepFolder folder(temp.path() / "kept", KeepUse::kBegin);
  EXPECT_EQ(folder.begin_change({box_at(1)}).size(), 1U);
  const std::vector<Box3> both = folder.begin_change({box_at(5)});
  EXPECT_TRUE(covers(both, box_at(1)));
  EXPECT_TRUE(covers(both, box_at(5)));
  EXPECT_FALSE(covers(both, box_at(3)));
  folder.end_change();
  EXPECT_EQ(folder.begin_change({box_at(2)}).size(), 1U);
}

TEST(KeepFolder, NeverForgetsABoxHoweverManyThereAre) {
  const TempFolder temp;
  const KeepFolder folder(temp.path() / "kept", KeepUse::kBegin);
  std::vector<Box3> boxes;
  constexpr std::int64_t kFar = std::int64_t{1} << 50;
  for (std::int64_t i = 0; i < 1'000'000; ++i) boxes.push_back(box_at(kFar + i));
  static_cast<void>(folder.begin_change(boxes));
  const std::vector<Box3> all = folder.begin_change({box_at(7)});
  EXPECT_TRUE(covers(all, boxes.front()));
  EXPECT_TRUE(covers(all, boxes.back()));
  EXPECT_TRUE(covers(all, box_at(7)));
}

TEST(KeepFolder, RefusesBoxesThatItCannotRead) {
  const TempFolder temp;
  const KeepFolder folder(temp.path() / "kept", KeepUse::kBegin);
  for (const char* text : {"", "1 2 3 4 5 6\nx"}) {
    std::ofstream(folder.path() / "changing") << text;
    EXPECT_THROW(static_cast<void>(folder.begin_change({box_at(0)})), DamagedWork) << text;
  }
}

}  // namespace
}  // namespace mw::engine
