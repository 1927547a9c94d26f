// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of files in ZIP archives: found, listed by folder, and refused where they are damaged.
#include "io/store/zip_directory.h"

#include "io/file/byte_order.h"
#include "io/file/source/file_source.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

/// The directory of an archive whose files are these names, of as many bytes as their number.
std::string directory_of(const std::vector<std::string>& names) {
  std::string out;
  std::uint32_t number = 0;
  for (const std::string& name : names) {
    out += std::string("PK\1\2\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 20);
    for (int i = 0; i < 2; ++i) append_little(out, number);  // packed and not
    append_little(out, static_cast<std::uint16_t>(name.size()));
    out += std::string(12, '\0');
    append_little(out, 100 + number++);
    out += name;
  }
  const auto count = static_cast<std::uint16_t>(names.size());
  const auto bytes = static_cast<std::uint32_t>(out.size());
  out += std::string("PK\5\6\0\0\0\0", 8);
  for (int i = 0; i < 2; ++i) append_little(out, count);
  append_little(out, bytes);
  append_little(out, std::uint32_t{0});
  return out + std::string(2, '\0');
}

TEST(ZipDirectory, FindsFilesAndFolders) {
  const TempDir dir;
  const FileSource source(dir.file(
      "a.zip", directory_of({"z", "a/b/c", "a/b-", "a/b/d/e", "a0", "a/x", "b", "../up", "z"})));
  const ZipDirectory archive(source);
  ASSERT_NE(archive.find("a/b/c"), nullptr);
  EXPECT_EQ(archive.find("a/b/c")->size, 1U);
  EXPECT_EQ(archive.find("a/b/c")->header, 101U);
  EXPECT_EQ(archive.find("z")->size, 8U) << "the last of two counts";
  for (const char* none : {"", "a", "a/b", "a/b/", "c", "A/B/C"}) {
    EXPECT_EQ(archive.find(none), nullptr) << none;
  }
  using Names = std::vector<std::string>;
  EXPECT_EQ(archive.folders_in(""), (Names{"..", "a"}));
  EXPECT_EQ(archive.folders_in("a"), Names{"b"});
  EXPECT_EQ(archive.folders_in("a/b"), Names{"d"});
  EXPECT_EQ(archive.folders_in("a/b/d"), Names{});
  for (const char* folder : {"", "a", "a/b", "a/b/d"}) EXPECT_TRUE(archive.has_folder(folder));
  for (const char* none : {"z", "a/b-", "a/b/c", "x"}) EXPECT_FALSE(archive.has_folder(none));
}

TEST(ZipDirectory, DamageIsRefusedOrGivesOtherNames) {
  const TempDir dir;
  const std::string good = directory_of({"a", "b/c"});
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (const char changed : {'\0', '\xff'}) {
      std::string bad = good;
      bad[at] = changed;
      const FileSource source(dir.file("b.zip", bad));
      try {
        static_cast<void>(ZipDirectory(source).folders_in(""));
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::kInput);
        EXPECT_NE(std::string(error.what()).find("b.zip"), std::string::npos);
        ++refused;
      }
    }
    const FileSource cut(dir.file("c.zip", good.substr(0, at)));
    expect_error(ErrorKind::kInput, {"c.zip", "ZIP directory"}, [&] { ZipDirectory archive(cut); });
  }
  EXPECT_GT(refused, 30);
}

}  // namespace
}  // namespace mw::io
