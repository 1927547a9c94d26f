// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Gmsh files: what we write comes back, what others write is read, damage is refused.
#include "io/file/text_numbers.h"
#include "io/mesh/gmsh/msh_common.h"
#include "io/mesh/gmsh/node_classes.h"
#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/grouped/plain_names.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/mesh/mesh_digest.h"
#include "tests/io/mesh/sample_mesh.h"
#include "tests/io/mesh/written_mesh.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

struct Way {
  Element element;
  Encoding encoding;
};

constexpr Way kWays[] = {{Element::kTet4, Encoding::kUsual},
                         {Element::kTet4, Encoding::kText},
                         {Element::kTet10, Encoding::kUsual},
                         {Element::kTet10, Encoding::kText}};

class Msh : public testing::Test {
 protected:
  std::filesystem::path path() const { return dir_.path() / "m.msh"; }

  TempDir dir_;
};

TEST_F(Msh, ComesBackWithVerticesInTheirRows) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const MeshData mesh = named_grid(seed, seed % 2 == 1);
    for (const auto& [element, encoding] : kWays) {
      save(mesh, path(), element, encoding);
      const MeshData back = read_mesh(path());
      EXPECT_EQ(back.vertices, mesh.vertices);
      EXPECT_EQ(mesh_digest(back), mesh_digest(mesh));
      EXPECT_EQ(back.labels_signed, mesh.labels_signed);
      EXPECT_TRUE(std::ranges::equal(back.names.rows(), mesh.names.rows()));
    }
  }
  EXPECT_EQ(dir_.entries(), 2U);
}

TEST_F(Msh, LargeSmallAndEmptyOnes) {
  for (const std::size_t tets : {0U, 1U, 2U, 20000U}) {
    const MeshData mesh = tets == 0 ? MeshData{} : sample_mesh(tets, false);
    for (const auto& [element, encoding] : kWays) {
      save(mesh, path(), element, encoding);
      const std::string first = content_of(path());
      EXPECT_EQ(mesh_digest(read_mesh(path())), mesh_digest(mesh));
      save(mesh, path(), element, encoding);
      EXPECT_TRUE(content_of(path()) == first);
    }
  }
}

TEST_F(Msh, WithoutATableNamesAndNumbersAreThoseOfPhysicalVolumes) {
  MeshData mesh = named_grid(1, false);
  save(mesh, path());
  std::filesystem::remove(path().string() + ".labels.csv");
  const MeshData back = read_mesh(path());
  // 0, 2^40 and 2^64 - 1 are no tags: they became those behind 3.
  EXPECT_EQ(back.names.name(4), "air 'outside'");
  EXPECT_EQ(back.names.name(3), "");
  EXPECT_EQ(back.names.name(5), "Größe, 漢字");
  EXPECT_EQ(std::ranges::count(back.labels, 6U), std::ranges::count(mesh.labels, ~0ULL));
}

TEST_F(Msh, NamesTooLongForGmshAreReplacedThereAlone) {
  MeshData mesh = named_grid(1, false);
  const std::string name(500, 'x');
  mesh.names = LabelNames({{3, name, std::nullopt}});
  save(mesh, path());
  EXPECT_EQ(content_of(path()).find("xxx"), std::string::npos);
  EXPECT_NE(content_of(path()).find("3 3 \"LABEL_3\""), std::string::npos);
  EXPECT_EQ(read_mesh(path()).names.name(3), name);
}

TEST_F(Msh, NamesThatMeetWithoutTheirQuotesHaveTheirLabels) {
  MeshData mesh = grid_mesh({2, 2, 2}, 5);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.labels[t] = 1 + t % 3;
  mesh.names = LabelNames({{1, "a\"b", {}}, {2, "a'b", {}}, {3, "c\"", {}}});
  save(mesh, path(), Element::kTet4, Encoding::kText);
  const std::string content = content_of(path());
  for (const char* const line : {"3 1 \"a'b (1)\"\n", "3 2 \"a'b (2)\"\n", "3 3 \"c'\"\n",
                                 " \"a'b (1)|a'b (2)\"\n", " \"a'b (2)|c'\"\n"}) {
    EXPECT_THAT(content, testing::HasSubstr(line));
  }
  EXPECT_TRUE(std::ranges::equal(read_mesh(path()).names.rows(), mesh.names.rows()));
}

/// Returns the names of section PhysicalNames.
std::vector<std::string> physical_names(const std::string& content) {
  std::vector<std::string> out;
  std::istringstream lines(content.substr(content.find("$PhysicalNames\n")));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  const std::size_t count = std::stoul(line);
  while (std::getline(lines, line) && line != "$EndPhysicalNames") {
    out.push_back(line.substr(line.find('"')));
  }
  EXPECT_EQ(out.size(), count);
  return out;
}

TEST_F(Msh, NoTwoGroupsHaveOneName) {
  MeshData mesh = grid_mesh({3, 3, 3}, 5);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.labels[t] = 1 + t % 8;
  mesh.names = LabelNames({{2, "label_1", {}},
                           {3, "LABEL_4", {}},
                           {4, std::string(200, 'x'), {}},
                           {5, "a|b", {}},
                           {6, "c", {}},
                           {7, "a", {}},
                           {8, "b|c", {}}});
  for (const char* const file : {"m.msh", "m.msh2"}) {
    save(mesh, dir_.path() / file);
    std::vector<std::string> names = physical_names(content_of(dir_.path() / file));
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end()) << file;
    if (std::string_view(file).ends_with('2')) continue;
    EXPECT_THAT(names, testing::IsSupersetOf({"\"label_1\"", "\"LABEL_4\"", "\"a|b\""}));
  }
}

TEST_F(Msh, NamesOfVersion2ArePlainAndDifferInAnyCase) {
  MeshData mesh = grid_mesh({3, 3, 3}, 5);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.labels[t] = 1 + t % 6;
  mesh.names = LabelNames({{1, "Left kidney; (upper)", {}},
                           {2, "left kidney/upper", {}},
                           {3, "x_min", {}},
                           {4, "Größe \"4\"", {}},
                           {5, "7", {}}});
  const auto path = dir_.path() / "m.msh2";
  save(mesh, path);
  std::set<std::string> seen;
  for (const std::string& name : physical_names(content_of(path))) {
    const std::string plain = name.substr(1, name.size() - 2);
    EXPECT_EQ(name, "\"" + plain + "\"");
    EXPECT_EQ(plain, plain_name(plain));
    EXPECT_TRUE(seen.insert(lower_case(plain)).second) << plain;
  }
  EXPECT_GT(seen.size(), 20U);
  for (const char* name : {"left_kidney_upper_1", "x_min", "x_min_3", "gr_e_4", "l_7", "label_6"}) {
    EXPECT_TRUE(seen.contains(name)) << name;
  }
  EXPECT_TRUE(std::ranges::equal(read_mesh(path).names.rows(), mesh.names.rows()));
}

TEST(MshElementData, RefusesNumbersThatBinaryFilesCannotHold) {
  const TempDir dir;
  const auto path = dir.path() / "m.msh";
  check_element_data(MshEncoder(path, true), 2147483648);
  check_element_data(MshEncoder(path, false), 2147483647);
  expect_error(ErrorKind::kUsage, {path.string(), "2147483648", "--ascii"},
               [&] { check_element_data(MshEncoder(path, false), 2147483648); });
}

constexpr const char* kHead4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";

/// Sparse tags, a parametric node, other elements, sections that do not matter, CR LF.
std::string foreign() {
  std::string content = kHead4;
  content +=
      "$Comments\nnode 1 2 3\n$EndComments\n"
      "$PhysicalNames\n2\n2 5 \"skin\"\n3 7 \"liver \"\n$EndPhysicalNames\n"
      "$Entities\n1 0 1 2\n9 0 0 0 0\n4 0 0 0 1 1 1 1 5 0\n"
      "11 0 -nan 0 inf 1 1 2 7 8 1 4\n12 0 0 0 1 1 1 0 1 -4\n$EndEntities\n"
      "$Nodes\n2 6 10 600\n3 11 0 4\n600\n10\n200\n30\n0 0 1\n0 0 0\n0 1 0\n1 0 0\n"
      "2 4 1 2\n400\n500\n1 1 1 0.5 0.25\n0 0 -1e0 0 0\n$EndNodes\n"
      "$Elements\n4 4 1 90\n0 9 15 1\n1 10\n2 4 2 1\n3 10 30 200\n"
      "3 11 4 1\n90 10 30 200 600\n3 12 4 1\n7 30 200 600 400\n$EndElements\n"
      "$NodeData\n1\n\"u\"\n";
  std::string lines;
  for (const char c : content) lines += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return lines;
}

TEST_F(Msh, ReadsWhatOthersWrite) {
  const MeshData mesh = read_mesh(dir_.file("m.msh", foreign()));
  ASSERT_EQ(mesh.vertices.size(), 6U);
  EXPECT_EQ(mesh.vertices[4], (Position{0, 0, -1}));
  EXPECT_EQ(mesh.tets, (std::vector<TetRows>{{0, 1, 2, 5}, {1, 2, 5, 3}}));
  EXPECT_EQ(mesh.labels, (std::vector<RawLabel>{7, 12}));
  EXPECT_EQ(mesh.names.name(7), "liver");
  EXPECT_EQ(mesh.names.rows().size(), 1U);
}

/// The five nodes and two tets of a small mesh in version 2.2.
std::string version_2(bool binary, bool big) {
  const auto i32 = [&](std::uint64_t n) { return number_bytes(n, 4, big); };
  const auto f64 = [&](double x) { return number_bytes(std::bit_cast<std::uint64_t>(x), 8, big); };
  if (!binary) {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 8 \"bone\"\n"
           "$EndPhysicalNames\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n9 1 1 1\n$EndNodes\n"
           "$Elements\n3\n1 2 2 1 1 1 2 3\n2 4 2 8 1 1 2 3 4\n3 4 2 0 6 2 3 4 9\n$EndElements\n";
  }
  std::string out = "$MeshFormat\n2.2 1 8\n" + i32(1) + "\n$EndMeshFormat\n$Nodes\n5\n";
  const std::vector<std::array<double, 4>> nodes{
      {1, 0, 0, 0}, {2, 1, 0, 0}, {3, 0, 1, 0}, {4, 0, 0, 1}, {9, 1, 1, 1}};
  for (const auto& [tag, x, y, z] : nodes) {
    out += i32(static_cast<std::uint64_t>(tag)) + f64(x) + f64(y) + f64(z);
  }
  out += "\n$EndNodes\n$Elements\n3\n";
  for (const unsigned n : {2U, 1U, 2U, 1U, 1U, 1U, 1U, 2U, 3U}) out += i32(n);
  for (const unsigned n : {4U, 2U, 2U, 2U, 8U, 1U, 1U, 2U, 3U, 4U, 3U, 0U, 6U, 2U, 3U, 4U, 9U})
    out += i32(n);
  return out + "\n$EndElements\n";
}

TEST_F(Msh, ReadsVersion2OfEitherByteOrder) {
  for (const bool big : {false, true}) {
    for (const bool binary : {false, true}) {
      const MeshData mesh = read_mesh(dir_.file("m.msh", version_2(binary, big)));
      EXPECT_EQ(mesh.vertices.size(), 5U);
      EXPECT_EQ(mesh.tets, (std::vector<TetRows>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
      EXPECT_EQ(mesh.labels, (std::vector<RawLabel>{8, 6}));
      EXPECT_EQ(mesh.names.name(8), binary ? "" : "bone");
    }
  }
}

TEST_F(Msh, EveryCutIsRefused) {
  for (const auto& [element, encoding] : kWays) {
    save(named_grid(3, false), path(), element, encoding);
    const std::string good = content_of(path());
    const std::size_t step = good.size() / 500 + 1;
    for (std::size_t size = good.size() - 2; size > 0; size -= std::min(size, step)) {
      dir_.file("m.msh", good.substr(0, size));
      expect_error(ErrorKind::kInput, {path().string()},
                   [&] { static_cast<void>(read_mesh(path())); });
    }
  }
}

TEST_F(Msh, DamageIsAnErrorOrAMesh) {
  for (const auto& [element, encoding] : kWays) {
    save(grid_mesh({2, 1, 1}, 3), path(), element, encoding);
    EXPECT_GT(try_damage(dir_, "m.msh", content_of(path())), 100);
  }
  std::filesystem::remove(path().string() + ".labels.csv");
  EXPECT_GT(try_damage(dir_, "m.msh", foreign()), 100);
  EXPECT_GT(try_damage(dir_, "m.msh", version_2(false, false)), 100);
  EXPECT_GT(try_damage(dir_, "m.msh", version_2(true, true)), 100);
}

TEST_F(Msh, RefusesWhatItDoesNotRead) {
  const auto refuse = [&](const std::string& content, std::vector<std::string> pieces) {
    pieces.push_back(path().string());
    dir_.file("m.msh", content);
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(read_mesh(path())); });
  };
  const auto with = [](std::string content, const std::string& from, const std::string& to) {
    return content.replace(content.find(from), from.size(), to);
  };
  refuse("solid stl\n", {"line 1"});
  refuse("$MeshFormat\n4 0 8\n$EndMeshFormat\n", {"version 4 ", "4.1"});
  refuse("$MeshFormat\n4.1 1 4\n$EndMeshFormat\n", {"4 bytes"});
  refuse(with(foreign(), "$Comments", "$PartitionedEntities"), {"partitioned"});
  refuse(with(foreign(), "600 400", "600 401"), {"node 401"});
  refuse(with(foreign(), "\n10\r", "\n600\r"), {"600", "twice"});
  refuse(with(foreign(), "3 12 4 1", "3 12 4 999999999999"), {"999999999999 rows"});
  refuse(with(foreign(), "3 12 4 1", "3 12 77 1"), {"type 77", "line"});
  refuse(with(foreign(), "0 0 1\r\n0 0 0", "0 0 nan\r\n0 0 0"), {"nan"});
  refuse(with(foreign(), "$Nodes\r\n2 6", "$Nodes\r\n2 7"), {"6", "7"});
  refuse(std::string(kHead4) +
             "$Nodes\n0 0 0 0\n$EndNodes\n$Elements\n1 1 1 1\n0 1 15 1\n1 1\n"
             "$EndElements\n",
         {"tetrahedron"});
  constexpr const char* kLeast = "-9223372036854775808";
  refuse(with(foreign(), "1 2 7 8", text("1 2 ", kLeast, " 8")), {kLeast, "group"});
  refuse(with(version_2(false, false), "2 4 2 8 1", text("2 4 2 ", kLeast, " 1")),
         {kLeast, "group"});
  dir_.file("m.msh.labels.csv", "id,number,name\n5,7,x\n");
  refuse(foreign(), {"12", "labels.csv"});
}

TEST_F(Msh, OutOfRoomIsAResourceErrorAndLeavesNothing) {
  expect_full_disk("m.msh", Encoding::kUsual);
  expect_full_disk("m.msh", Encoding::kText);
}

TEST_F(Msh, AsciiIsForMshAlone) {
  expect_error(ErrorKind::kUsage, {"m.vtu", "ascii"}, [&] {
    static_cast<void>(
        open_mesh_sink(dir_.path() / "m.vtu", Element::kTet4, {.encoding = Encoding::kText}));
  });
}

// Entities of nodes against a search of all facets and tets.

/// Rows of each entity's elements, entities as NodeClasses numbers them.
std::vector<std::set<std::uint64_t>> rows_by_entity(GroupedMesh& mesh) {
  const bool ten = mesh.element() == Element::kTet10;
  std::vector<std::set<std::uint64_t>> out;
  for (const FacetGroup& group : mesh.facet_groups()) {
    std::set<std::uint64_t>& rows = out.emplace_back();
    for (std::uint64_t f = group.facets.begin; f < group.facets.end; ++f) {
      const Facet facet = mesh.facet(f);
      for (const std::uint64_t row : facet.rows) rows.insert(row);
      if (!ten) continue;
      for (const std::uint64_t row : mesh.facet_middles(facet)) rows.insert(row);
    }
  }
  for (const RowRange& tets : mesh.label_tets()) {
    std::set<std::uint64_t>& rows = out.emplace_back();
    for (std::uint64_t t = tets.begin; t < tets.end; ++t) {
      for (const std::uint64_t row : mesh.tet(t)) rows.insert(row);
      if (!ten) continue;
      for (const std::uint64_t row : mesh.middles(t)) rows.insert(row);
    }
  }
  return out;
}

class NodeClassesOfGrids : public testing::TestWithParam<std::tuple<unsigned, Element>> {
 protected:
  NodeClassesOfGrids()
      : mesh_(grid_mesh({4, 3, 3}, std::get<0>(GetParam()))),
        sink_(dir_.path(), nullptr, std::get<1>(GetParam())) {
    // Nodes of no tet, at the beginning, in the middle and at the end.
    mesh_.vertices.push_back({-9, -9, -9});
    std::erase_if(mesh_.tets, [&](const TetRows& tet) {
      return std::ranges::count(tet, 0U) + std::ranges::count(tet, 30U) > 0;
    });
    mesh_.labels.resize(mesh_.tets.size());
    write_mesh(mesh_, sink_);
  }

  TempDir dir_;
  MeshData mesh_;
  GroupedSink sink_;
};

TEST_P(NodeClassesOfGrids, EveryNodeIsOnTheFirstEntityThatHasIt) {
  GroupedMesh& mesh = sink_.mesh();
  NodeClasses classes(mesh);
  const std::vector<std::set<std::uint64_t>> rows = rows_by_entity(mesh);
  ASSERT_EQ(classes.entities(), rows.size());
  std::uint64_t next = 0;
  std::set<std::uint64_t> seen;
  for (std::size_t e = 0; e < rows.size(); ++e) {
    std::vector<std::uint64_t> expected, found;
    for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
      const auto has = [&](const auto& of_entity) { return of_entity.contains(row); };
      const auto first = std::find_if(rows.begin(), rows.end(), has);
      const std::size_t entity = first == rows.end()
                                     ? mesh.facet_groups().size()
                                     : static_cast<std::size_t>(first - rows.begin());
      if (entity == e) expected.push_back(row);
    }
    const RowRange& indices = classes.nodes(e);
    if (indices.size() > 0) {
      EXPECT_EQ(indices.begin, next);
      next = indices.end;
    }
    for (std::uint64_t i = indices.begin; i < indices.end; ++i) found.push_back(classes.row(i));
    EXPECT_EQ(found, expected) << e;
  }
  EXPECT_EQ(next, mesh.node_count());
}

TEST_P(NodeClassesOfGrids, BoxesAreThoseOfAllNodes) {
  GroupedMesh& mesh = sink_.mesh();
  NodeClasses classes(mesh);
  const std::vector<std::set<std::uint64_t>> rows = rows_by_entity(mesh);
  for (std::size_t e = 0; e < rows.size(); ++e) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::set<double> on_axis;
      for (const std::uint64_t row : rows[e]) on_axis.insert(mesh.node(row)[k]);
      EXPECT_EQ(classes.box(e).lo[k], *on_axis.begin());
      EXPECT_EQ(classes.box(e).hi[k], *on_axis.rbegin());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, NodeClassesOfGrids,
                         testing::Combine(testing::Range(0U, 6U),
                                          testing::Values(Element::kTet4, Element::kTet10)));

}  // namespace
}  // namespace mw::io
