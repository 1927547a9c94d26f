// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of groups for programs that allow few characters.
#include "io/mesh/grouped/plain_names.h"

#include <gtest/gtest.h>

#include <cctype>
#include <random>
#include <set>

#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/mesh/grouped/grouped.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

/// Every name by the rule, and no two the same.
void expect_plain(const GroupedMesh& mesh, const NameRule& rule) {
  const PlainNames names(mesh, rule);
  std::vector<std::string> all;
  for (Label rank = 0; rank < mesh.table().size(); ++rank) all.push_back(names.volume(rank));
  std::set<std::string> sides;
  for (const FacetGroup& group : mesh.facet_groups()) {
    if (group.side != Side::kInterface) {
      sides.insert(names.facets(group));
      continue;
    }
    all.push_back(names.facets(group));
    all.push_back(names.facets(group, true));
    if (rule.of_triangles.empty()) continue;
    all.push_back(names.triangles(group));
    all.push_back(names.triangles(group, true));
  }
  for (const WedgeGroup& group : mesh.wedge_groups()) all.push_back(names.wedges(group));
  all.insert(all.end(), rule.reserved.begin(), rule.reserved.end());
  all.insert(all.end(), sides.begin(), sides.end());
  std::set<std::string> capitals;
  for (std::string name : all) {
    EXPECT_LE(name.size(), rule.max_bytes);
    EXPECT_EQ(
        name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                               "_-"),
        name.npos)
        << name;
    EXPECT_NE(std::isalpha(static_cast<unsigned char>(name.at(0))), 0) << name;
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    EXPECT_TRUE(capitals.insert(name).second) << name;
  }
}

TEST(PlainNames, AreAllowedAndUniqueWhateverLabelsAreCalled) {
  const std::string longest(200, 'x');
  const std::vector<std::string> known{
      "",    "L",        "l",        "L_3",     "L_3_3",        "x min",       "F_X_MIN", "OUTER",
      "1_2", "1",        "FACE_1_2", "label 2", longest,        longest + "y", "(((",     "Größe",
      "0_1", "F_FACE_3", "1_0_1",    "ALL",     "FACE_0_1_0_1", "LABEL_3"};
  const TempDir dir;
  std::mt19937 random(17);
  for (unsigned seed = 0; seed < 80; ++seed) {
    MeshData mesh = grid_mesh({2, 2, 2}, seed);
    const RawLabel farthest = seed % 2 == 0 ? 1 : 2'000'000'000'000'000'000;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.labels[t] = random() % 7 * farthest;
    std::vector<LabelName> rows;
    for (RawLabel label = 0; label < 7; ++label) {
      rows.push_back({label * farthest, known[random() % known.size()], {}});
    }
    mesh.names = LabelNames(std::move(rows));
    GroupedSink sink(dir.path(), nullptr);
    const GroupedMesh& found = grouped(sink, mesh);
    expect_plain(found, {});
    expect_plain(
        found,
        {.max_bytes = 32, .allows_dash = false, .reserved = {"ALL", "STAT"}, .of_triangles = "F_"});
  }
}

TEST(PlainNames, OfPairsThatWouldBeTheSameEndInTheirNumbers) {
  MeshData mesh = grid_mesh({2, 2, 2}, 5);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.labels[t] = 1 + t % 4;
  mesh.names = LabelNames({{1, "a", {}}, {2, "b_c", {}}, {3, "a_b", {}}, {4, "c", {}}});
  const TempDir dir;
  GroupedSink sink(dir.path(), nullptr);
  const PlainNames names(grouped(sink, mesh));
  EXPECT_EQ(names.facets({.first = 0, .second = 1}), "FACE_a_b_c");
  EXPECT_EQ(names.facets({.first = 2, .second = 3}), "FACE_a_b_c_3_4");
  EXPECT_EQ(names.facets({.first = 0, .second = 1}, true), "FACE_b_c_a");
}

TEST(PlainNames, OfNumbersAlone) {
  const LabelTable table({1, 3}, false);
  EXPECT_EQ(plain_facet_name(table, {.first = 0, .second = 1}), "FACE_1_3");
  EXPECT_EQ(plain_facet_name(table, {.side = Side::kZMin}), "Z_MIN");
  EXPECT_EQ(plain_volume_name(LabelTable({static_cast<RawLabel>(-5)}, true), 0), "LABEL_M5");
}

TEST(PlainNames, SayWhatLabelsAreCalled) {
  MeshData mesh = grid_mesh({2, 2, 2}, 5);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.labels[t] = t % 6;
  mesh.names = LabelNames({{1, "Matrix (epoxy)", {}},
                           {2, "cyst", {}},
                           {3, "CYST", {}},
                           {4, "3rd ventricle", {}},
                           {5, "漢字", {}}});
  const TempDir dir;
  GroupedSink sink(dir.path(), nullptr);
  const GroupedMesh& found = grouped(sink, mesh);
  const PlainNames names(found);
  const std::vector<std::string> expected{"LABEL_0", "Matrix_epoxy",    "cyst_2",
                                          "CYST_3",  "L_3rd_ventricle", "LABEL_5"};
  for (Label rank = 0; rank < 6; ++rank) EXPECT_EQ(names.volume(rank), expected[rank]);
  EXPECT_EQ(names.facets({.first = 0, .second = 1}), "FACE_0_Matrix_epoxy");
  EXPECT_EQ(names.facets({.first = 0, .second = 1}, true), "FACE_Matrix_epoxy_0");
  EXPECT_EQ(names.facets({.first = 0, .second = 5}, true), "FACE_5_0");
  EXPECT_EQ(names.facets({.side = Side::kYMax, .first = 1}), "Y_MAX");
}

}  // namespace
}  // namespace mw::io
