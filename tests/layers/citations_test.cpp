// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// No comment cites a document that is not in the tree; no document names a file or test that is
// not.
#include "tests/layers/citations.h"

#include <gmock/gmock.h>

#include <regex>

#include "tests/temp_folder.h"

namespace mw::layers {
namespace {

namespace fs = std::filesystem;
using mw::test::content_of;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

const fs::path kRoot = MW_SOURCE_DIR;

std::vector<fs::path> files_below(std::initializer_list<const char*> folders,
                                  const std::set<std::string>& extensions) {
  std::vector<fs::path> out;
  for (const char* folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (extensions.contains(entry.path().extension().string())) out.push_back(entry.path());
    }
  }
  return out;
}

std::vector<fs::path> documents() {
  return files_below({"kernels", "io", "engine", "bench", ".github"}, {".md"});
}

TEST(Citations, OfCommentsAreInTheTree) {
  std::size_t cited = 0;
  for (const fs::path& source : files_below({"kernels", "io", "engine"}, {".h", ".cpp"})) {
    for (const Citation& citation : citations_of(content_of(source))) {
      ++cited;
      ASSERT_TRUE(fs::exists(kRoot / citation.file)) << source << " cites " << citation.file;
      if (citation.section.empty()) continue;
      EXPECT_THAT(titles_of(content_of(kRoot / citation.file)), Contains(citation.section))
          << source << " cites a section of " << citation.file;
    }
  }
  EXPECT_GE(cited, 5U);
}

TEST(Citations, OfDocumentsAreInTheTree) {
  std::size_t named = 0;
  for (const fs::path& document : documents()) {
    for (const Citation& citation : citations_of(content_of(document))) {
      if (citation.section.empty()) continue;
      EXPECT_THAT(titles_of(content_of(kRoot / citation.file)), Contains(citation.section))
          << document << " cites a section of " << citation.file;
    }
    for (const std::string& path : paths_in(content_of(document))) {
      ++named;
      EXPECT_TRUE(fs::exists(kRoot / path)) << document << " names " << path;
    }
  }
  EXPECT_GE(named, 50U);
}

/// "Suite.Name" of all tests.
std::set<std::string> all_tests() {
  static const std::regex named(R"(^TEST(?:_F|_P)?\((\w+),\s*(\w+)\))");
  std::set<std::string> out;
  std::smatch match;
  for (const fs::path& source : files_below({"tests"}, {".cpp"})) {
    const std::string text = content_of(source);
    for (auto at = text.find("\nTEST"); at != text.npos; at = text.find("\nTEST", at + 1)) {
      const std::string head = text.substr(at + 1, 200);
      if (std::regex_search(head, match, named)) out.insert(match[1].str() + "." + match[2].str());
    }
  }
  return out;
}

TEST(Citations, TestsThatDocumentsNameExist) {
  const std::set<std::string> tests = all_tests();
  std::size_t named = 0;
  for (const fs::path& document : documents()) {
    for (const std::string& test : tests_in(content_of(document))) {
      ++named;
      EXPECT_TRUE(tests.contains(test)) << document << " names " << test;
    }
  }
  EXPECT_GE(named, 10U);
}

TEST(Citations, AreReadAcrossTheLinesOfAComment) {
  EXPECT_THAT(citations_of("/// Why: kernels/a.md, \"A long\n  /// title\", and b.md.\nint x;\n"),
              ElementsAre(Citation{"kernels/a.md", "A long title"}, Citation{"b.md", ""}));
  EXPECT_THAT(citations_of("// see\n// a/b.md,\n// \"T\"\n"), ElementsAre(Citation{"a/b.md", "T"}));
  EXPECT_THAT(citations_of("x.mdb and a.cmd, .md5\n"), IsEmpty());
  EXPECT_THAT(citations_of("// Format: https://a.org/b/c.md\n"), IsEmpty());
}

TEST(Citations, FindTitlesPathsAndTests) {
  EXPECT_THAT(titles_of("# One\ntext # no\n### Two words\n"), ElementsAre("One", "Two words"));
  EXPECT_THAT(paths_in("`kernels/a.h`, `mwmesh verify`, kernels/b.h and `io/mesh/`"),
              ElementsAre("kernels/a.h", "io/mesh/"));
  EXPECT_THAT(tests_in("`Suite.Name`, `mw.Error`, `A.B`"), ElementsAre("Suite.Name"));
}

}  // namespace
}  // namespace mw::layers
