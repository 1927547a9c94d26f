// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels as single words and as parts of names of files.
#include "io/surface/surface_names.h"

#include "tests/io/surface/collected_surface.h"

namespace mw::io {
namespace {

TEST(SurfaceWords, HaveNothingThatReadersTakeForSomethingElse) {
  EXPECT_EQ(one_word("left \"big\" one"), "left__big__one");
  EXPECT_EQ(one_word("a\tb\nc\x7f|d=e;f#g\\"), "a_b_c__d_e_f_g_");
  EXPECT_EQ(one_word("Größe-漢字.2 (x)"), "Größe-漢字.2_(x)");
  EXPECT_EQ(file_word("left liver"), "left liver");
  EXPECT_EQ(file_word("../../etc/passwd"), "_._.._etc_passwd");
  EXPECT_EQ(file_word("a:b*c?d<e>f\"g|h\\i"), "a_b_c_d_e_f_g_h_i");
  EXPECT_EQ(file_word("end. "), "end._");
  EXPECT_EQ(file_word("end."), "end_");
}

SurfaceHeader header_of(std::vector<std::string> titles) {
  auto labels = std::make_shared<SurfaceLabels>();
  std::vector<RawLabel> raw;
  SurfaceShell shell;
  for (Label rank = 0; rank < titles.size(); ++rank) {
    raw.push_back(rank + 1);
    shell.runs.push_back({.inside = rank, .outside = rank, .triangles = 1});
  }
  labels->table = LabelTable(raw, false);
  labels->titles = std::move(titles);
  return {.labels = labels, .shells = {shell}};
}

TEST(SurfaceWords, DifferWhereNamesDiffer) {
  const SurfaceHeader header = header_of({"a b", "a_b", "a:b", "a_b_2", "a|b"});
  const SurfaceNames names(header);
  std::set<std::string> labels, runs;
  for (Label a = 0; a < 5; ++a) {
    labels.insert(names.label(a));
    runs.insert(names.run({.side = Side::kOuter, .inside = a}));
    for (Label b = 0; b < 5; ++b) runs.insert(names.run({.inside = a, .outside = b}));
  }
  EXPECT_EQ(labels.size(), 5U);
  EXPECT_EQ(runs.size(), 30U);
  EXPECT_EQ(names.label(0), "a_b");
  EXPECT_EQ(names.run({.side = Side::kOuter, .inside = 0}), "a_b||outer");
  for (const std::string& run : runs) EXPECT_EQ(run.find(' '), run.npos);
}

}  // namespace
}  // namespace mw::io
