// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The files of a folder by the paths of requests.
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

}  // namespace
}  // namespace mw::cli
