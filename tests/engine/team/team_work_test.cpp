// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a folder has to be before processes share it.
#include "engine/team/saved/team_work.h"

#include <fstream>

#include "engine/team/saved/saved_run.h"
#include "tests/engine/store/fake_run.h"
#include "tests/engine/store/work_folder.h"
#include "tests/engine/team/crowd.h"
#include "tests/expect_error.h"

namespace mw::engine {
namespace {

namespace fs = std::filesystem;

using TeamWorkTest = test::FolderTest;

TEST_F(TeamWorkTest, NeedsAFolderThatCanBeMade) {
  std::ofstream(folder() / "file") << "no folder";
  for (const fs::path& path : {folder() / "file", folder() / "file" / "work"}) {
    test::for_ranks({.ranks = 2}, [&](Team& team) {
      expect_error(ErrorKind::kUsage, {path.string(), "is not a folder", "--workdir"}, [&] {
        try {
          const TeamWork work(team, path, false, "");
        } catch (...) {
          team.fail(std::current_exception());
          throw;
        }
      });
    });
  }
}

TEST_F(TeamWorkTest, MakesNoFileWhereSavedWorkIsMissing) {
  const RunLayout layout = test::fake_layout();
  const fs::path rank = folder() / "rank-0000";
  fs::create_directories(rank);
  expect_error(ErrorKind::kInput, {rank.string(), "journal"},
               [&] { const SavedRun run(layout, {rank}, 1); });
  EXPECT_TRUE(fs::is_empty(rank));
}

}  // namespace
}  // namespace mw::engine
