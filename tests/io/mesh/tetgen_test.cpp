// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// TetGen's files: how nodes and markers are numbered, files of others, and damaged ones.
#include <gmock/gmock.h>

#include <map>
#include <set>
#include <sstream>

#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

/// The rows of a text file of numbers, its first line apart.
std::vector<std::vector<double>> table_of(const std::filesystem::path& path) {
  std::istringstream lines(content_of(path));
  std::vector<std::vector<double>> out;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream numbers(line);
    out.emplace_back();
    for (double number = 0; numbers >> number;) out.back().push_back(number);
  }
  return out;
}

/// As the library of TetGen 1.5 numbers them with -o2: nodes 5 to 10 of a tet lie in the middle of
/// these corners.
TEST(Tetgen, TenNodesAreInItsOrder) {
  constexpr std::size_t kMiddles[6][2] = {{2, 3}, {0, 3}, {0, 1}, {1, 2}, {1, 3}, {0, 2}};
  const TempDir dir;
  write_mesh(grid_mesh({3, 2, 2}, 5), *open_mesh_sink(dir.path() / "m.node", Element::kTet10));
  const auto nodes = table_of(dir.path() / "m.node");
  const auto tets = table_of(dir.path() / "m.ele");
  ASSERT_EQ(tets.size(), 12 * 6 + 1U);
  EXPECT_EQ(tets[0], (std::vector<double>{72, 10, 1}));
  const auto at = [&](double row) { return nodes.at(static_cast<std::size_t>(row)); };
  for (std::size_t t = 1; t < tets.size(); ++t) {
    ASSERT_EQ(tets[t].size(), 12U);
    for (std::size_t m = 0; m < 6; ++m) {
      const auto a = at(tets[t][1 + kMiddles[m][0]]);
      const auto b = at(tets[t][1 + kMiddles[m][1]]);
      const auto middle = at(tets[t][5 + m]);
      for (std::size_t k = 1; k <= 3; ++k) {
        EXPECT_NEAR(middle[k], (a[k] + b[k]) / 2, 1e-12 * (std::abs(a[k]) + std::abs(b[k])));
      }
    }
  }
}

/// TetGen's own reader takes three nodes more before the marker when tets have ten.
TEST(Tetgen, FacesOfTenNodesHaveTheirMiddles) {
  const TempDir dir;
  write_mesh(grid_mesh({3, 2, 2}, 5), *open_mesh_sink(dir.path() / "m.node", Element::kTet10));
  const auto nodes = table_of(dir.path() / "m.node");
  const auto faces = table_of(dir.path() / "m.face");
  const auto at = [&](double row) { return nodes.at(static_cast<std::size_t>(row)); };
  ASSERT_GT(faces.size(), 32U);
  for (std::size_t f = 1; f < faces.size(); ++f) {
    ASSERT_EQ(faces[f].size(), 8U);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = at(faces[f][1 + i]);
      const auto b = at(faces[f][1 + (i + 1) % 3]);
      const auto middle = at(faces[f][4 + i]);
      for (std::size_t k = 1; k <= 3; ++k) {
        EXPECT_NEAR(middle[k], (a[k] + b[k]) / 2, 1e-12 * (std::abs(a[k]) + std::abs(b[k])));
      }
    }
  }
}

/// Markers against brute force: which labels share each triangle of the .ele file.
TEST(Tetgen, FacesHaveTheNumbersOfTheirGroups) {
  const TempDir dir;
  for (unsigned seed = 0; seed < 3; ++seed) {
    MeshData mesh = grid_mesh({3, 2, 4}, seed);
    write_mesh(mesh, *open_mesh_sink(dir.path() / "m.node"));
    const auto nodes = table_of(dir.path() / "m.node");
    std::map<std::set<double>, std::multiset<double>> labels;
    const auto tets = table_of(dir.path() / "m.ele");
    for (std::size_t t = 1; t < tets.size(); ++t) {
      for (std::size_t left_out = 1; left_out <= 4; ++left_out) {
        std::set<double> triangle(tets[t].begin() + 1, tets[t].begin() + 5);
        triangle.erase(tets[t][left_out]);
        labels[triangle].insert(tets[t][5]);
      }
    }
    std::map<double, std::multiset<double>> of_number;
    const auto faces = table_of(dir.path() / "m.face");
    EXPECT_EQ(faces[0], (std::vector<double>{static_cast<double>(faces.size() - 1), 1}));
    for (std::size_t f = 1; f < faces.size(); ++f) {
      const std::set<double> triangle(faces[f].begin() + 1, faces[f].begin() + 4);
      const double marker = faces[f][4];
      const std::multiset<double>& sides = labels.at(triangle);
      if (marker < 8) {
        EXPECT_EQ(sides.size(), 1U);
        const auto axis = static_cast<std::size_t>((marker - 1) / 2);
        const double plane =
            static_cast<int>(marker) % 2 == 1 ? 0 : std::array<double, 3>{3, 2, 4}[axis];
        for (const double row : triangle) {
          EXPECT_EQ(nodes[static_cast<std::size_t>(row)][1 + axis], plane);
        }
      } else {
        ASSERT_EQ(sides.size(), 2U);
        EXPECT_NE(*sides.begin(), *sides.rbegin());
        EXPECT_EQ(of_number.emplace(marker, sides).first->second, sides) << marker;
      }
      labels.erase(triangle);
    }
    // What is left bounds nothing.
    for (const auto& [triangle, sides] : labels) {
      ASSERT_EQ(sides.size(), 2U);
      EXPECT_EQ(*sides.begin(), *sides.rbegin());
    }
    EXPECT_THAT(content_of(dir.path() / "m.facets.csv"),
                testing::StartsWith("number,name,side,first,second\n"));
    EXPECT_THAT(content_of(dir.path() / "m.facets.csv"),
                testing::HasSubstr("1,\"x_min\",x_min,,\n"));
    EXPECT_THAT(content_of(dir.path() / "m.facets.csv"),
                testing::HasSubstr("8,\"label_0|label_1\",interface,0,1\n"));
  }
}

/// Numbers that count from 0, attributes that are reals, comments, blank lines.
TEST(Tetgen, ReadsFilesOfOthers) {
  const TempDir dir;
  dir.file("o.node",
           "# by hand\n4 3 1 1\n\n0 0 0 0 1.5 1\n1 1 0 0 1.5 0 # two\n 2 0 1 0 2 0\n"
           "3 0 0 1 2 1\n");
  dir.file("o.ele", "1  4  2\n0  0 1 2 3  -7.0 0\n# Generated by tetgen\n");
  const MeshData mesh = read_mesh(dir.path() / "o.node");
  ASSERT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.vertices[3], (Position{0, 0, 1}));
  EXPECT_EQ(mesh.tets, (std::vector<TetRows>{{0, 1, 2, 3}}));
  EXPECT_EQ(mesh.labels, (std::vector<RawLabel>{static_cast<RawLabel>(-7)}));
  EXPECT_TRUE(mesh.labels_signed);
}

TEST(Tetgen, RefusesWhatIsWrong) {
  const TempDir dir;
  const std::string nodes = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  const std::string tets = "1 4 1\n1 1 2 3 4 7\n";
  const auto refuse = [&](const std::string& n, const std::string& t,
                          const std::vector<std::string>& pieces) {
    dir.file("b.node", n);
    dir.file("b.ele", t);
    expect_error(ErrorKind::kInput, pieces,
                 [&] { static_cast<void>(read_mesh(dir.path() / "b.node")); });
  };
  refuse("1 2 0 0\n1 0 0\n", tets, {"b.node", "dimension"});
  refuse("99999999999 3 0 0\n1 0 0 0\n", tets, {"b.node", "cannot hold"});
  refuse("2 3 0 0\n1 0 0 0\n3 1 1 1\n", tets, {"row 3", "line 3"});
  refuse("1 3 0 0\n5 0 0 0\n", tets, {"0 or 1"});
  refuse(nodes.substr(0, nodes.size() - 1), tets, {"b.node", "truncated"});
  refuse(nodes, "1 4 0\n1 1 2 3 4\n", {"b.ele", "attribute"});
  refuse(nodes, "1 4 1\n1 1 2 3 5 7\n", {"b.ele", "node 5"});
  refuse(nodes, "1 4 1\n1 0 2 3 4 7\n", {"b.ele", "node 0"});
  refuse(nodes, "1 4 1\n1 1 2 3 4 7.5\n", {"b.ele", "7.5"});
  refuse(nodes, "1 5 1\n1 1 2 3 4 4 7\n", {"b.ele", "5 nodes"});
  refuse(nodes, "99999999999 4 1\n", {"b.ele", "cannot hold"});
  std::filesystem::remove(dir.path() / "b.ele");
  expect_error(ErrorKind::kInput, {"b.ele"},
               [&] { static_cast<void>(read_mesh(dir.path() / "b.node")); });
}

}  // namespace
}  // namespace mw::io
