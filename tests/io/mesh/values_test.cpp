// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Values of tets come back from the formats that hold them.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "io/file/errors.h"
#include "io/mesh/field_names.h"
#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

MeshData mesh_with_values(unsigned seed) {
  MeshData mesh = grid_mesh({6, 5, 4}, seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  mesh.values = {{"hu", {}}, {"Tag_2", {}}};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    mesh.values[0].numbers.push_back(random() % 5 == 0 ? std::nan("") : 1e3 * normal(random));
    mesh.values[1].numbers.push_back(static_cast<double>(random() % 3));
  }
  return mesh;
}

/// Values of each tet, with all NaN alike, by the places of its corners: whatever the order.
std::map<std::set<Position>, std::vector<std::string>> by_corners(const MeshData& mesh) {
  std::map<std::set<Position>, std::vector<std::string>> out;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::set<Position> corners;
    for (const std::uint64_t row : mesh.tets[t]) corners.insert(mesh.vertices[row]);
    std::vector<std::string>& values = out[corners];
    for (const TetValues& column : mesh.values) {
      const double x = column.numbers.at(t);
      values.push_back(std::isnan(x) ? "nan" : text(column.name, " ", x));
    }
    std::sort(values.begin(), values.end());  // HDF5 has columns by name
  }
  return out;
}

TEST(Values, ComeBackFromTheFormatsThatHoldThem) {
  const TempDir dir;
  for (unsigned seed = 0; seed < 3; ++seed) {
    const MeshData mesh = mesh_with_values(seed);
    const auto wanted = by_corners(mesh);
    for (const char* const ending : {".vtu", ".vtkhdf", ".msh", ".msh2"}) {
      SCOPED_TRACE(ending);
      const auto path = dir.path() / (std::string("m") + ending);
      for (const Element element : {Element::kTet4, Element::kTet10}) {
        write_mesh(mesh, *open_mesh_sink(path, element));
        EXPECT_EQ(by_corners(read_mesh(path)), wanted);
      }
    }
    write_mesh(
        mesh, *open_mesh_sink(dir.path() / "t.msh", Element::kTet4, {.encoding = Encoding::kText}));
    EXPECT_EQ(by_corners(read_mesh(dir.path() / "t.msh")), wanted);
    const auto pieces = dir.path() / text("m", seed, ".pvtu");
    write_mesh(mesh, *open_mesh_pieces(pieces, 7));
    EXPECT_EQ(by_corners(read_mesh(pieces)), wanted);
  }
}

TEST(Values, OfFormatsWithoutAPlaceForThemAreLeftOut) {
  const TempDir dir;
  const MeshData mesh = mesh_with_values(1);
  for (const char* const ending : {".mesh", ".inp", ".bdf", ".feb"}) {
    const auto path = dir.path() / (std::string("m") + ending);
    write_mesh(mesh, *open_mesh_sink(path));
    EXPECT_TRUE(why_no_values(path).starts_with(path.string())) << ending;
  }
  EXPECT_TRUE(read_mesh(dir.path() / "m.mesh").values.empty());
  for (const char* const path : {"m.vtu", "m.vtkhdf", "m.msh", "m.exo", "m.pvtu"}) {
    EXPECT_EQ(why_no_values(path), "");
  }
}

/// Gmsh and other programs write times, several integers to skip, other sections, and elements
/// that have none.
TEST(Values, OfGmshAreThoseOfTetsByTheNumbersOfElements) {
  const TempDir dir;
  const std::string head =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
      "5 1 1 1\n$EndNodes\n$Elements\n3\n9 2 2 1 1 1 2 3\n7 4 2 3 3 1 2 3 4\n"
      "4 4 2 3 3 2 3 4 5\n$EndElements\n";
  const auto data = [](const std::string& name, const std::string& components,
                       const std::string& rows) {
    return "$ElementData\n1\n\"" + name + "\"\n1\n0.5\n4\n2\n" + components + "\n" +
           std::to_string(std::ranges::count(rows, '\n')) + "\n0\n" + rows + "$EndElementData\n";
  };
  const MeshData mesh = read_mesh(dir.file(
      "m.msh", head + "$NodeData\n1\n\"n\"\n0\n3\n0\n1\n1\n1 8\n$EndNodeData\n" +
                   data("of one", "1", "4 2.5\n9 1\n") + data("a vector", "3", "4 1 2 3\n") +
                   data("label", "1", "7 -1e3\n4 inf\n") + data("of a triangle", "1", "9 1\n")));
  ASSERT_EQ(mesh.values.size(), 2U);
  EXPECT_EQ(mesh.values[0].name, "of_one");
  EXPECT_TRUE(std::isnan(mesh.values[0].numbers.at(0)));
  EXPECT_EQ(mesh.values[0].numbers.at(1), 2.5);
  EXPECT_EQ(mesh.values[1].name, "label_2");
  EXPECT_EQ(mesh.values[1].numbers, (std::vector<double>{-1e3, HUGE_VAL}));
  for (const std::string& bad :
       {data("x", "1", "4 word\n"), data("x", "1", "4 1\n7\n"), std::string("$ElementData\nx\n"),
        std::string("$ElementData\n1\n\"x\"\n1\n0\n3\n0\n1\n999999999\n")}) {
    expect_error(ErrorKind::kInput, {"bad.msh"},
                 [&] { static_cast<void>(read_mesh(dir.file("bad.msh", head + bad))); });
  }
}

TEST(Values, NamesAreMadePlain) {
  const std::vector<std::string> plain{"a", "B_2", "label_2", std::string(31, 'x')};
  EXPECT_EQ(value_names(plain), plain);
  EXPECT_EQ(value_names({"", "1", "A b", "a_B", "Label", "ü;<", std::string(40, 'x'),
                         std::string(50, 'X')}),
            (std::vector<std::string>{"value_", "value_1", "A_b", "a_B_2", "Label_2", "value_____",
                                      std::string(31, 'x'), std::string(29, 'X') + "_2"}));
}

}  // namespace
}  // namespace mw::io
