// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Formats for solvers, and tets of ten nodes, hold the mesh that was written.
#include <map>
#include <set>

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
    auto path = dir_.path() / (stem + GetParam().extension);
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
