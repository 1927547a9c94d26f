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
  EXPECT_EQ(folder.with_incomplete({box_at(1)}).size(), 1U);
  folder.begin_change({box_at(1)});
  folder.begin_change({box_at(5)});
  const std::vector<Box3> both = folder.with_incomplete({box_at(5)});
  EXPECT_TRUE(covers(both, box_at(1)));
  EXPECT_TRUE(covers(both, box_at(5)));
  EXPECT_FALSE(covers(both, box_at(3)));
  folder.end_change();
  EXPECT_EQ(folder.with_incomplete({box_at(2)}).size(), 1U);
}

TEST(KeepFolder, NeverForgetsABoxHoweverManyThereAre) {
  const TempFolder temp;
  const KeepFolder folder(temp.path() / "kept", KeepUse::kBegin);
  std::vector<Box3> boxes;
  constexpr std::int64_t kFar = std::int64_t{1} << 50;
  for (std::int64_t i = 0; i < 1'000'000; ++i) boxes.push_back(box_at(kFar + i));
  folder.begin_change(boxes);
  const std::vector<Box3> all = folder.with_incomplete({box_at(7)});
  EXPECT_TRUE(covers(all, boxes.front()));
  EXPECT_TRUE(covers(all, boxes.back()));
  EXPECT_TRUE(covers(all, box_at(7)));
}

TEST(KeepFolder, RefusesBoxesThatItCannotRead) {
  const TempFolder temp;
  const KeepFolder folder(temp.path() / "kept", KeepUse::kBegin);
  for (const char* text : {"", "1 2 3 4 5 6\nx"}) {
    std::ofstream(folder.path() / "changing") << text;
    EXPECT_THROW(folder.begin_change({box_at(0)}), DamagedWork) << text;
  }
}

TEST(KeepFolder, HasANumberThatStaysAndIsNoOthers) {
  const TempFolder temp;
  std::vector<std::uint64_t> numbers;
  for (const char* name : {"a", "b"}) {
    const std::filesystem::path path = temp.path() / name;
    {
      KeepFolder kept(path, KeepUse::kBegin);
      kept.settle("window = 8\n");
      kept.begin_change({box_at(1)});
      kept.stay();
      numbers.push_back(kept.number());
    }
    const KeepFolder again(path, KeepUse::kUpdate);
    EXPECT_EQ(again.number(), numbers.back());
    EXPECT_NO_THROW(again.settle("window = 8\n"));
    EXPECT_THROW(again.settle("window = 9\n"), Error);
  }
  EXPECT_NE(numbers[0], numbers[1]);
  std::filesystem::copy_file(temp.path() / "a" / "changing", temp.path() / "b" / "changing",
                             std::filesystem::copy_options::overwrite_existing);
  const KeepFolder mixed(temp.path() / "b", KeepUse::kUpdate);
  EXPECT_THROW((void)mixed.with_incomplete({}), DamagedWork);
}

TEST(KeepFolder, GoesWithARunThatKeptNothing) {
  const TempFolder temp;
  const std::filesystem::path path = temp.path() / "kept", own = temp.path() / "own";
  std::filesystem::create_directory(own);
  for (const auto& folder : {path, own}) {
    const KeepFolder kept(folder, KeepUse::kBegin);
    kept.settle("window = 8\n");
    kept.begin_change({box_at(1)});
    kept.put_text(kChosenFile, "x");
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(std::filesystem::is_empty(own)) << "a folder that somebody else made stays";
  {
    KeepFolder kept(path, KeepUse::kBegin);
    kept.settle("window = 8\n");
    kept.stay();
  }
  { const KeepFolder kept(path, KeepUse::kUpdate); }
  EXPECT_TRUE(std::filesystem::exists(path / "settings.txt"));
}

}  // namespace
}  // namespace mw::engine
