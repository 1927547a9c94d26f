// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Formats for solvers, and tets of ten nodes, hold the mesh that was written.
#include <gmock/gmock.h>

#include <map>
#include <set>
#include <sstream>

#include "io/mesh/digest.h"
#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

struct Case {
  const char* extension;
  Element element;
  bool labels_signed;
};

std::string case_name(const testing::TestParamInfo<Case>& info) {
  return std::string(info.param.extension + 1) +
         (info.param.element == Element::kTet10 ? "Ten" : "Four") +
         (info.param.labels_signed ? "Signed" : "");
}

/// Labels that no 32 bits hold, coordinates that need all digits, an unused vertex, names.
MeshData random_mesh(unsigned seed, bool labels_signed) {
  const std::array<RawLabel, 4> labels{labels_signed ? static_cast<RawLabel>(-5) : ~0ULL, 0, 3,
                                       1ULL << 40};
  MeshData mesh = grid_mesh({3, 2, 2}, seed);
  mesh.labels_signed = labels_signed;
  for (RawLabel& label : mesh.labels) label = labels[label];
  for (Position& p : mesh.vertices) p = {p[0] / 3, p[1] * 1e-7 - 1, p[2] * 12345.678};
  mesh.vertices.push_back({9, 9, 9});
  mesh.names = LabelNames({{3, "a \"b\" <c>, & d", Colour{1, 2, 3, 4}}, {0, "Größe", {}}});
  return mesh;
}

class SolverFiles : public testing::TestWithParam<Case> {
 protected:
  [[nodiscard]] std::filesystem::path write(const std::string& stem, const MeshData& mesh) const {
    const auto path = dir_.path() / (stem + GetParam().extension);
    write_mesh(mesh, *open_mesh_sink(path, GetParam().element));
    return path;
  }

  TempDir dir_;
};

TEST_P(SolverFiles, HoldTheMesh) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const MeshData mesh = random_mesh(seed, GetParam().labels_signed);
    const MeshData back = read_mesh(write("m", mesh));
    EXPECT_EQ(back.labels_signed, mesh.labels_signed);
    EXPECT_EQ(mesh_digest(back), mesh_digest(mesh)) << seed;
    for (const RawLabel label : std::set(mesh.labels.begin(), mesh.labels.end())) {
      EXPECT_EQ(back.names.name(label), mesh.names.name(label));
    }
  }
}

TEST_P(SolverFiles, AreTheSameBytesEachTime) {
  const MeshData mesh = random_mesh(1, GetParam().labels_signed);
  std::map<std::filesystem::path, std::string> first;
  const std::vector<std::filesystem::path> files = mesh_files(write("m", mesh));
  for (const auto& file : files) first[file] = content_of(file);
  EXPECT_EQ(dir_.entries(), files.size());
  static_cast<void>(write("m", mesh));
  for (const auto& file : files) {
    EXPECT_TRUE(content_of(file) == first[file]) << file;
    EXPECT_FALSE(first[file].empty()) << file;
  }
}

TEST_P(SolverFiles, MayBeEmpty) {
  const MeshData back = read_mesh(write("m", {}));
  EXPECT_TRUE(back.vertices.empty());
  EXPECT_TRUE(back.tets.empty());
}

TEST_P(SolverFiles, LeaveNothingWhenTheyAreNotFinished) {
  const MeshData mesh = random_mesh(1, false);
  {
    const auto sink =
        open_mesh_sink(dir_.path() / (std::string("m") + GetParam().extension), GetParam().element);
    sink->begin({.tets = mesh.tets.size()});
    sink->write_vertices(mesh.vertices);
  }
  EXPECT_EQ(dir_.entries(), 0U);
}

std::vector<Case> cases() {
  std::vector<Case> out;
  for (const char* extension : {".vtkhdf", ".vtu", ".xdmf", ".feb", ".node"}) {
    for (const Element element : {Element::kTet4, Element::kTet10}) {
      for (const bool labels_signed : {false, true}) {
        out.push_back({extension, element, labels_signed});
      }
    }
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(All, SolverFiles, testing::ValuesIn(cases()), case_name);

TEST(SolverFilesTetTen, HaveNoPlaceInMedit) {
  const TempDir dir;
  expect_error(ErrorKind::kUsage, {"m.mesh", "tet4"},
               [&] { static_cast<void>(open_mesh_sink(dir.path() / "m.mesh", Element::kTet10)); });
}

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
  write_mesh(random_mesh(5, false), *open_mesh_sink(dir.path() / "m.node", Element::kTet10));
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
  write_mesh(random_mesh(5, false), *open_mesh_sink(dir.path() / "m.node", Element::kTet10));
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

TEST(Febio, ReadsOlderModels) {
  const TempDir dir;
  const auto path = dir.file(
      "o.feb",
      "<febio_spec version=\"2.5\"><Material><material id=\"3\" name=\"m\"/></Material><Geometry>"
      "<Nodes><node id=\"10\">0,0,0</node><node id=\"20\"> 1, 0, 0</node><node "
      "id=\"5\">0,1,0</node>"
      "</Nodes><Nodes><node id=\"7\">0,0,1e0</node></Nodes>"
      "<Elements type=\"tet4\" mat=\"3\" name=\"p\"><elem id=\"1\">10,20,5,7</elem></Elements>"
      "</Geometry></febio_spec>");
  const MeshData mesh = read_mesh(path);
  EXPECT_EQ(mesh.tets, (std::vector<TetRows>{{0, 1, 2, 3}}));
  EXPECT_EQ(mesh.labels, (std::vector<RawLabel>{3}));
}

TEST(Febio, RefusesWhatIsWrong) {
  const TempDir dir;
  const auto refuse = [&](const std::string& mesh, const std::vector<std::string>& pieces) {
    const auto path = dir.file("b.feb", "<febio_spec version=\"4.0\">" + mesh + "</febio_spec>");
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(read_mesh(path)); });
  };
  refuse("", {"b.feb", "Mesh"});
  refuse("<Mesh><Nodes><node id=\"1\">0,0</node></Nodes></Mesh>", {"node 1", "coordinates"});
  refuse("<Mesh><Nodes><node id=\"1\">0,0,nan</node></Nodes></Mesh>", {"node 1"});
  refuse("<Mesh><Nodes><node id=\"x\">0,0,0</node></Nodes></Mesh>", {"'x'"});
  refuse("<Mesh><Nodes><node id=\"1\">0,0,0</node><node id=\"1\">0,0,0</node></Nodes></Mesh>",
         {"node 1", "twice"});
  refuse("<Mesh><Elements type=\"hex8\" name=\"p\"/></Mesh>", {"hex8"});
  refuse("<Mesh><Elements type=\"tet4\" name=\"p\"/></Mesh>", {"'p'", "material"});
  refuse(
      "<Mesh><Elements type=\"tet4\" name=\"p\" mat=\"1\"><elem id=\"4\">1,2,3,4</elem>"
      "</Elements></Mesh>",
      {"element 4", "node 1"});
  refuse("<Mesh>", {"b.feb", "byte"});
}

TEST(Xdmf, RefusesWhatIsWrong) {
  const TempDir dir;
  write_mesh(random_mesh(1, false), *open_mesh_sink(dir.path() / "m.xdmf"));
  const std::string good = content_of(dir.path() / "m.xdmf");
  const auto refuse = [&](const std::string& from, const std::string& to,
                          const std::vector<std::string>& pieces) {
    std::string bad = good;
    ASSERT_NE(bad.find(from), std::string::npos) << from;
    for (std::size_t at = 0; (at = bad.find(from, at)) != std::string::npos; at += to.size()) {
      bad.replace(at, from.size(), to);
    }
    const auto path = dir.file("b.xdmf", bad);
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(read_mesh(path)); });
  };
  refuse("\"HDF\"", "\"XML\"", {"b.xdmf", "xml", "HDF5"});
  refuse("m.h5", "../m.h5", {"b.xdmf", "leads out"});
  refuse("m.h5", "/m.h5", {"b.xdmf", "leads out"});
  refuse("m.h5", "n.h5", {"b.xdmf", "n.h5"});
  refuse("m.h5:/", "m.h5/", {"FILE:/PATH"});
  refuse("XYZ", "XY", {"'xy'"});
  refuse("\"Tetrahedron\"", "\"Hexahedron\"", {"b.xdmf", "none of 0"});
  refuse("/Mesh/mesh/topology", "/Mesh/mesh/geometry", {"m.h5", "4 or 10"});
  refuse("/Mesh/mesh/geometry", "/Mesh/mesh/label", {"m.h5", "3 components"});
  refuse("/Mesh/mesh/label", "/MeshTags/facet_tags/Values", {"m.h5", "rows"});
  refuse("</Xdmf>", "", {"b.xdmf", "byte"});
}

}  // namespace
}  // namespace mw::io
