// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/file/folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "kernels/core/error.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

namespace fs = std::filesystem;

TEST(EntriesIn, AreAllOfThemInTheOrderOfTheirBytes) {
  const TempDir folder;
  EXPECT_EQ(entries_in(folder.path()), std::vector<std::string>());
  const std::vector<std::string> names{".hidden", "10", "9", "B", "a", "a folder", "\xc3\xa4"};
  for (const std::string& name : {names[4], names[2], names[0], names[6], names[1], names[3]}) {
    std::ofstream(folder.path() / name) << "x";
  }
  fs::create_directory(folder.path() / names[5]);
  std::ofstream(folder.path() / names[5] / "below") << "x";
  std::error_code error = std::make_error_code(std::errc::io_error);
  EXPECT_EQ(entries_in(folder.path(), error), names);
  EXPECT_FALSE(error);
}

TEST(EntriesIn, WhatIsNoFolderIsAnError) {
  const TempDir folder;
  const fs::path file = folder.path() / "file", missing = folder.path() / "missing";
  std::ofstream(file) << "x";
  std::error_code error;
  EXPECT_TRUE(entries_in(file, error).empty());
  EXPECT_EQ(error, std::errc::not_a_directory);
  EXPECT_TRUE(entries_in(missing, error).empty());
  EXPECT_EQ(error, std::errc::no_such_file_or_directory);
  try {
    (void)entries_in(missing);
    FAIL() << "a missing folder was listed";
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::kInput);
    EXPECT_NE(std::string(failure.what()).find(missing.string()), std::string::npos);
  }
}

}  // namespace
}  // namespace mw::io
