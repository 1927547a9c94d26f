// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Abaqus input files: what we write comes back, what others write is read, damage is refused.
#include <algorithm>

#include "io/mesh/abaqus/set_labels.h"
#include "tests/io/mesh/sample_mesh.h"
#include "tests/io/mesh/written_mesh.h"

namespace mw::io {
namespace {

class Inp : public testing::Test {
 protected:
  std::filesystem::path path() const { return dir_.path() / "m.inp"; }
  MeshData read(const std::string& content) const { return read_mesh(dir_.file("m.inp", content)); }

  TempDir dir_;
};

TEST_F(Inp, ComesBackWithVerticesInTheirRows) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const MeshData mesh = named_grid(seed, seed % 2 == 1);
    for (const Element element : {Element::kTet4, Element::kTet10}) {
      save(mesh, path(), element);
      const MeshData back = read_mesh(path());
      EXPECT_EQ(back.vertices, mesh.vertices);
      EXPECT_EQ(mesh_digest(back), mesh_digest(mesh));
      EXPECT_EQ(back.labels_signed, mesh.labels_signed);
      EXPECT_TRUE(std::ranges::equal(back.names.rows(), mesh.names.rows()));
    }
  }
  EXPECT_EQ(dir_.entries(), 1U);
}

TEST_F(Inp, LargeSmallAndEmptyOnes) {
  for (const std::size_t tets : {0U, 1U, 2U, 20000U}) {
    const MeshData mesh = tets == 0 ? MeshData{} : sample_mesh(tets, true);
    for (const Element element : {Element::kTet4, Element::kTet10}) {
      save(mesh, path(), element);
      const std::string first = content_of(path());
      EXPECT_EQ(mesh_digest(read_mesh(path())), mesh_digest(mesh));
      save(mesh, path(), element);
      EXPECT_TRUE(content_of(path()) == first);
    }
  }
}

/// Lines of Abaqus hold 256 characters and 16 items.
TEST_F(Inp, LinesAreWithinTheLimitsOfAbaqus) {
  MeshData mesh = named_grid(2, false);
  mesh.names = LabelNames({{3, std::string(900, 'x'), std::nullopt}});
  save(mesh, path(), Element::kTet10);
  std::istringstream lines(content_of(path()));
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 256U) << line;
    EXPECT_TRUE(line.starts_with('*') || std::ranges::count(line, ',') <= 15) << line;
    EXPECT_FALSE(line.empty() || line.ends_with(','));
  }
}

constexpr const char* kNodes =
    "*Heading\n words, 1, 2\n** comment\n*Part, name=a\n*node, nset = all\n"
    " 40, 0., 0., 1.\n10, 0, 0\n 20, 1.D0, +0, .0\n\n30 , 0, 1e0, 0,\n50, 1, 1, 1\n";

TEST_F(Inp, ReadsWhatOthersWrite) {
  const std::vector<TetRows> tets{{0, 1, 2, 3}, {1, 2, 3, 4}};
  const auto check = [&](const std::string& elements, const std::vector<RawLabel>& labels) {
    const MeshData mesh = read(kNodes + elements);
    EXPECT_EQ(mesh.vertices,
              (std::vector<Position>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}));
    EXPECT_EQ(mesh.tets, tets) << elements;
    EXPECT_EQ(mesh.labels, labels) << elements;
    return mesh.names;
  };
  const std::string two = "1, 10,20,30,40\n7, 20,30,40,50\n";
  check("*ELEMENT,\n** comment\n TYPE = c3d4h ,\n ElSet=label_70\n" + two, {70, 70});
  check("*ELEMENT,TYPE=DC3D4\n1, 10,20,\n30,40\n7,\n 20,30,40,50\n", {1, 1});
  check(
      "*element, type=C3D4, elset=Volume3\n1, 10,20,30,40\n*ELEMENT,TYPE=CPS3,ELSET=S\n3,1,2,3\n"
      "*element, type=C3D4, elset=VOLUME5\n7, 20,30,40,50\n*elset,elset=X9\n1,7\n",
      {3, 5});
  const LabelNames named =
      check("*Element, type=C3D4\n" + two +
                "*Elset, elset=_s, internal\n1, 7\n*Elset, elset=Liver, generate\n 5, 9, 2\n"
                "*Elset, elset=ALL\nLiver, 1, 7,\n*NODE OUTPUT\nU\n*STEP\n",
            {2, 1});
  EXPECT_EQ(named.name(1), "Liver");
  EXPECT_EQ(named.name(2), "ALL");
  check(
      "*Element, type=C3D4, elset=\"a b-1\"\n1, 10,20,30,40\n*Element, type=C3D4, elset=c-1\n"
      "7, 20,30,40,50\n",
      {1, 2});
}

TEST_F(Inp, CornersOfTenNodesAlone) {
  const MeshData mesh = read(
      "*NODE\n1\n2,1\n3,0,1\n4,0,0,1\n5,.5\n6,.5,.5\n7,0,.5\n8,0,0,.5\n9,.5,0,.5\n10,0,.5,.5\n99,"
      "9\n"
      "*ELEMENT, TYPE=C3D10M, ELSET=A\n1, 1,2,3,4,5,6,7,8,\n9,10\n");
  ASSERT_EQ(mesh.vertices.size(), 5U);
  EXPECT_EQ(mesh.vertices[4], (Position{9, 0, 0}));
  EXPECT_EQ(mesh.tets, (std::vector<TetRows>{{0, 1, 2, 3}}));
}

TEST_F(Inp, RefusesWhatItDoesNotRead) {
  const auto refuse = [&](const std::string& content, std::vector<std::string> pieces) {
    pieces.push_back(path().string());
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(read(content)); });
  };
  const std::string nodes = kNodes;
  refuse("solid\n", {"no tetrahedra"});
  refuse(nodes + "*ELEMENT, TYPE=C3D4\n1, 10,20,30\n", {"line 13", "truncated"});
  refuse(nodes + "*ELEMENT, TYPE=C3D4\n1, 10,20,30\n*STEP\n", {"line 14", "lacks nodes"});
  refuse(nodes + "*ELEMENT, TYPE=C3D4\n1, 10,20,30,40,50\n", {"line 13", "too many"});
  refuse(nodes + "*ELEMENT, TYPE=C3D4\n1, 10,20,30,60\n", {"node 60"});
  refuse(nodes + "*ELEMENT, TYPE=C3D4\n1, 10,-20,30,40\n", {"-20"});
  refuse(nodes + "*ELEMENT\n1, 10,20,30,40\n", {"TYPE"});
  refuse(nodes + "*NODE\n10, 1, 1, 1\n*ELEMENT, TYPE=C3D4\n1, 10,20,30,40\n", {"10", "twice"});
  refuse(nodes + "*NODE\n60, 1, x\n", {"line 13", "'x'"});
  refuse(nodes + "*NODE\n60, inf\n", {"'inf'"});
  refuse("*Include, input=mesh.inc\n", {"*INCLUDE"});
  refuse("*Node\n*\n", {"without a keyword"});
  refuse("*Node\n * , nset=all\n", {"without a keyword"});
  refuse("*NODE, INPUT=mesh.inc\n", {"another file"});
  refuse("*NODE, SYSTEM=C\n", {"system"});
  refuse("*ELSET, ELSET=A, GENERATE\n1, 5, 0\n", {"step"});
  refuse("*NODE\n" + std::string(2 << 20, '1') + "\n", {"line 2"});
}

TEST_F(Inp, EveryCutOfOursIsRefused) {
  save(named_grid(3, false), path());
  const std::string good = content_of(path());
  const std::size_t step = good.size() / 700 + 1;
  // The line's end behind the last letter is no loss.
  for (std::size_t size = good.size() - 2; size > 0; size -= std::min(size, step)) {
    int refused = 0;
    try_mesh(dir_.file("m.inp", good.substr(0, size)), size, refused);
    EXPECT_EQ(refused, 1) << size;
  }
}

TEST_F(Inp, DamageIsAnErrorOrAMesh) {
  for (const Element element : {Element::kTet4, Element::kTet10}) {
    save(grid_mesh({2, 1, 1}, 3), path(), element);
    EXPECT_GT(try_damage(dir_, "m.inp", content_of(path())), 100);
  }
}

TEST_F(Inp, OutOfRoomIsAResourceErrorAndLeavesNothing) {
  expect_full_disk("m.inp", Encoding::kUsual);
}

TEST(SetLabels, ByNumberOrInOrder) {
  const auto labels = [](const std::vector<std::string>& sets) {
    return labels_of_sets(sets).labels;
  };
  using Labels = std::vector<RawLabel>;
  EXPECT_EQ(labels({"LABEL_7", "label_18446744073709551615"}), (Labels{7, ~0ULL}));
  EXPECT_EQ(labels({"LABEL_M7", "LABEL_0"}), (Labels{static_cast<RawLabel>(-7), 0}));
  EXPECT_TRUE(labels_of_sets({"LABEL_M7"}).labels_signed);
  EXPECT_EQ(labels({"grain12", "3"}), (Labels{12, 3}));
  EXPECT_EQ(labels({"Liver-1", "Bone-1"}), (Labels{1, 2}));
  EXPECT_EQ(labels({"9", "Bone"}), (Labels{1, 2}));
  EXPECT_EQ(labels({"a99999999999999999999"}), (Labels{1}));
  EXPECT_EQ(labels_of_sets({"grain12", "LABEL_3"}).names.name(12), "grain12");
  EXPECT_TRUE(labels_of_sets({"LABEL_3", ""}).names.name(2).empty());
  EXPECT_TRUE(labels_of_sets({"LABEL_3"}).names.empty());
}

}  // namespace
}  // namespace mw::io
