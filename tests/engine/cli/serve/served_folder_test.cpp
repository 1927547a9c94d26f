// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The files of a folder by the paths of requests, and the part of a file that a request asks for.
#include "engine/cli/serve/served_folder.h"

#include "tests/temp_folder.h"
#include "tests/testing.h"

namespace mw::cli {
namespace {

namespace fs = std::filesystem;

/// folder/ with files in it and links out of it, other/ and folder-2/ beside it.
class ServedFolderTest : public testing::Test {
 protected:
  ServedFolderTest() {
    for (const char* file : {"folder/in", "folder/sub/in", "folder-2/out", "other/out"}) {
      fs::create_directories((root() / file).parent_path());
      std::ofstream(root() / file) << file;
    }
    fs::create_symlink("sub/in", root() / "folder/link");
    fs::create_symlink("../other/out", root() / "folder/out");
    fs::create_directory_symlink("..", root() / "folder/above");
    fs::create_directory_symlink("folder", root() / "served");
  }

  [[nodiscard]] const fs::path& root() const { return temp_.path(); }

 private:
  mw::test::TempFolder temp_;
};

TEST_F(ServedFolderTest, OpensWhatIsInIt) {
  for (const char* name : {"folder", "folder/", "served", "other/../folder"}) {
    const ServedFolder folder(root() / name);
    for (const char* path : {"/in", "/sub/in", "/link", "/sub/../in", "//in", "/above/folder/in"}) {
      const std::shared_ptr<const io::FileSource> file = folder.open(path);
      ASSERT_TRUE(file) << name << path;
      EXPECT_GE(file->size(), 9U) << name << path;
    }
  }
}

TEST_F(ServedFolderTest, OpensNothingElse) {
  const ServedFolder folder(root() / "folder");
  const std::string other = (root() / "other/out").string();
  for (const std::string& path :
       {std::string("/"), std::string("/none"), std::string("/sub"), std::string("/in/"),
        std::string("/out"), std::string("/above/other/out"), std::string("/../folder-2/out"),
        std::string("/../other/out"), std::string("/.."), std::string(""), other, "/" + other,
        std::string("/in\0", 4), std::string("\0/in", 4), "/" + std::string(5000, 'a')}) {
    EXPECT_FALSE(folder.open(path)) << path;
  }
}

TEST_F(ServedFolderTest, MustBeThere) {
  EXPECT_THROW(ServedFolder(root() / "none"), fs::filesystem_error);
}

using Pair = std::pair<std::uint64_t, std::uint64_t>;

std::optional<Pair> asked(std::string_view header, std::uint64_t size) {
  const std::optional<ByteRange> range = asked_range(header, size);
  if (!range) return std::nullopt;
  return Pair{range->begin, range->end};
}

TEST(ByteRange, IsWithinTheFile) {
  EXPECT_EQ(asked("bytes=3-17", 100), (Pair{3, 18}));
  EXPECT_EQ(asked("bytes=0-0", 100), (Pair{0, 1}));
  EXPECT_EQ(asked("bytes=9-", 100), (Pair{9, 100}));
  EXPECT_EQ(asked("bytes=90-99", 100), (Pair{90, 100}));
  EXPECT_EQ(asked("bytes=90-100", 100), (Pair{90, 100}));
  EXPECT_EQ(asked("bytes=0-18446744073709551615", 100), (Pair{0, 100}));
  EXPECT_EQ(asked("bytes=-5", 100), (Pair{95, 100}));
  EXPECT_EQ(asked("bytes=-101", 100), (Pair{0, 100}));
}

TEST(ByteRange, IsEmptyWhereTheFileHasNoneOfIt) {
  for (const char* header : {"bytes=100-", "bytes=100-200", "bytes=-0",
                             "bytes=18446744073709551615-18446744073709551615"}) {
    const std::optional<ByteRange> range = asked_range(header, 100);
    ASSERT_TRUE(range) << header;
    EXPECT_TRUE(range->empty()) << header;
    EXPECT_LE(range->end, 100U) << header;
  }
  EXPECT_EQ(asked("bytes=0-", 0), (Pair{0, 0}));
  EXPECT_EQ(asked("bytes=-5", 0), (Pair{0, 0}));
}

TEST(ByteRange, OtherHeadersAskForNothing) {
  for (const char* header : {"",
                             "bytes",
                             "bytes=",
                             "bytes=-",
                             "bytes=x-",
                             "bytes=1-x",
                             "bytes=17-3",
                             "bytes=1",
                             "bytes=1-2,4-5",
                             "bytes=0-,0-",
                             "bytes=--5",
                             "bytes=1--5",
                             "bytes=+1-5",
                             "bytes= 1-5",
                             "bytes=1-5 ",
                             "lines=1-5",
                             "-5",
                             "bytes=18446744073709551616-",
                             "bytes=0-18446744073709551616",
                             "bytes=-18446744073709551616"}) {
    EXPECT_FALSE(asked_range(header, 100)) << header;
  }
}

}  // namespace
}  // namespace mw::cli
