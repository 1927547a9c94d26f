// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Formats for solvers and for views, of four nodes and of ten, hold the mesh that was written.
#include <gmock/gmock.h>

#include "io/file/text_numbers.h"
#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/mesh_digest.h"
#include "tests/io/mesh/read_back.h"
#include "tests/io/mesh/written_mesh.h"

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
    const MeshData back = read_back(write("m", mesh));
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
  const MeshData back = read_back(write("m", {}));
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

/// All formats with both kinds of tets, except Medit, which has four nodes.
std::vector<Case> cases() {
  std::vector<Case> out{{".mesh", Element::kTet4, false}, {".mesh", Element::kTet4, true}};
  for (const char* extension : {".vtkhdf", ".vtu", ".xdmf", ".feb", ".inp", ".exo", ".msh2"}) {
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

TEST(InpWriter, OutOfRoomIsAResourceErrorAndLeavesNothing) {
  expect_full_disk("m.inp", Encoding::kUsual);
}

TEST(ExodusWriter, OutOfRoomIsAResourceErrorAndLeavesNothing) {
  expect_full_disk("m.exo", Encoding::kUsual);
}

/// Formats of cards: real fields have fewer digits than numbers, but all else is as it was.
struct CardFormat {
  std::string extension;
  int digits;  ///< behind the point
  std::size_t columns;
};

double rounded(double value, int digits) {
  std::array<char, 48> out{};
  std::snprintf(out.data(), out.size(), "%.*e", digits, value);
  return std::stod(out.data());
}

class CardFiles : public testing::TestWithParam<CardFormat> {};

/// A mesh whose shortest edge is long enough for ten digits.
MeshData mesh_for_cards(unsigned seed, bool labels_signed) {
  MeshData mesh = random_mesh(seed, labels_signed);
  for (Position& p : mesh.vertices) {
    if (p[1] < 0) p[1] = 1e6 * (p[1] + 1);  // the unused vertex stays
  }
  return mesh;
}

TEST_P(CardFiles, HoldTheMeshToTheirDigits) {
  const TempDir dir;
  const auto path = dir.path() / ("m" + GetParam().extension);
  for (const Element element : {Element::kTet4, Element::kTet10}) {
    for (const bool labels_signed : {false, true}) {
      MeshData mesh = mesh_for_cards(3, labels_signed);
      save(mesh, path, element);
      MeshData back = read_back(path);
      back.vertices.resize(mesh.vertices.size());  // middles of edges come behind
      for (Position& p : mesh.vertices) {
        for (double& x : p) x = rounded(x, GetParam().digits);
      }
      EXPECT_EQ(mesh_digest(back), mesh_digest(mesh));
      EXPECT_EQ(back.labels_signed, labels_signed);
      std::istringstream lines(content_of(path));
      for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(line.size(), GetParam().columns) << line;
      }
    }
  }
}

TEST_P(CardFiles, AreTheSameBytesEachTimeAndMayBeEmpty) {
  const TempDir dir;
  const auto path = dir.path() / ("m" + GetParam().extension);
  save(mesh_for_cards(1, true), path, Element::kTet10);
  const std::string first = content_of(path);
  save(mesh_for_cards(1, true), path, Element::kTet10);
  EXPECT_TRUE(content_of(path) == first);
  save({}, path);
  EXPECT_TRUE(read_back(path).tets.empty());
}

TEST_P(CardFiles, HaveTooFewDigitsFarFromTheOrigin) {
  const TempDir dir;
  const auto path = dir.path() / ("m" + GetParam().extension);
  MeshData mesh = mesh_for_cards(2, false);
  save(mesh, path);
  for (Position& p : mesh.vertices) p[0] += 1e9;
  if (GetParam().digits > 9) return save(mesh, path);
  expect_error(ErrorKind::kUsage, {path.string(), "10 digits", "--origin"},
               [&] { save(mesh, path); });
}

TEST_P(CardFiles, OutOfRoomIsAResourceErrorAndLeavesNothing) {
  expect_full_disk("m" + GetParam().extension, Encoding::kUsual);
}

INSTANTIATE_TEST_SUITE_P(All, CardFiles,
                         testing::Values(CardFormat{".bdf", 9, 80}, CardFormat{".k", 9, 80},
                                         CardFormat{".cdb", 13, 171}),
                         [](const auto& test) { return test.param.extension.substr(1); });

/// Lines of Abaqus hold 256 characters and 16 items.
TEST(InpWriter, LinesAreWithinTheLimitsOfAbaqus) {
  const TempDir dir;
  MeshData mesh = named_grid(2, false);
  mesh.names = LabelNames({{3, std::string(900, 'x'), std::nullopt}});
  save(mesh, dir.path() / "m.inp", Element::kTet10);
  std::istringstream lines(content_of(dir.path() / "m.inp"));
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 256U) << line;
    EXPECT_TRUE(line.starts_with('*') || std::ranges::count(line, ',') <= 15) << line;
    EXPECT_FALSE(line.empty() || line.ends_with(','));
  }
}

/// CalculiX reads 20 characters of a number and drops the rest, with the exponent.
TEST(InpWriter, NumbersAreWithinTheCharactersThatCalculixReads) {
  const TempDir dir;
  MeshData mesh = grid_mesh({2, 2, 2}, 1);
  const double step = 1.040810546875001e-05;
  for (Position& p : mesh.vertices) p = {p[0] * step, p[1] * step, p[2] * step};
  mesh.record.promises.emplace().periodic = 7;
  mesh.record.box = MeshBox{{}, {{{2 * step, 0, 0}, {0, 2 * step, 0}, {0, 0, 2 * step}}}};
  const MeshExtras extras{.deck = Deck::kStatic, .pairs = dir.path() / "pairs.inp"};
  write_mesh(mesh, *open_mesh_sink(dir.path() / "m.inp", Element::kTet4, extras));
  int exponents = 0;
  for (const char* const name : {"m.inp", "pairs.inp"}) {
    std::istringstream lines(content_of(dir.path() / name));
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with('*') || line.starts_with("Tetrahedra")) continue;
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');) {
        field = trimmed(field);
        EXPECT_LE(field.size(), 20U) << field;
        exponents += field.find('e') == std::string::npos ? 0 : 1;
      }
    }
  }
  EXPECT_EQ(exponents, 3 * 18 + 1 + 3);  // coordinates above 0, the pull, and reference nodes
}

TEST(InpWriter, DecksOfTetsTooSmallForCalculixAreRefused) {
  const TempDir dir;
  for (const double step : {1e-7, 3e-7}) {  // the Jacobian of each tet is step^3
    MeshData mesh = grid_mesh({2, 2, 2}, 1);
    for (Position& p : mesh.vertices) p = {p[0] * step, p[1] * step, p[2] * step};
    const auto write = [&](bool has_deck) {
      write_mesh(mesh, *open_mesh_sink(dir.path() / "m.inp", Element::kTet4,
                                       {.deck = has_deck ? Deck::kStatic : Deck::kNone}));
    };
    write(false);
    if (step > 2e-7) {
      write(true);
    } else {
      expect_error(ErrorKind::kUsage, {"m.inp", "--spacing in a smaller unit"},
                   [&] { write(true); });
    }
  }
}

/// APDL takes ALL, STAT and DEFA, in letters of any size, for something else than a component.
TEST(CdbFiles, ComponentsHaveNoReservedNames) {
  const TempDir dir;
  MeshData mesh = grid_mesh({2, 2, 2}, 1);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.labels[t] = t % 4;
  mesh.names = LabelNames({{0, "all", {}}, {1, "STAT", {}}, {2, "Defa", {}}, {3, "defa2", {}}});
  save(mesh, dir.path() / "m.cdb");
  const std::string content = content_of(dir.path() / "m.cdb");
  for (const char* const name : {"all_0", "STAT_1", "Defa_2", "defa2"}) {
    EXPECT_THAT(content, testing::HasSubstr(text("CMBLOCK,", name, ",ELEM,")));
  }
}

/// Readers take what is behind a ':' for a path in the HDF5 file.
TEST(XdmfWriter, NamesHaveNoColon) {
  const TempDir dir;
  expect_error(ErrorKind::kUsage, {"a:b.xdmf", "':'"}, [&] {
    save(grid_mesh({1, 1, 1}, 1), dir.path() / "a:b.xdmf");
  });
  EXPECT_EQ(dir.entries(), 0U);
  std::filesystem::create_directory(dir.path() / "a:b");
  save(grid_mesh({1, 1, 1}, 1), dir.path() / "a:b" / "c.xdmf");
}

/// Numbers against brute force: which labels share each triangle of the tets.
TEST(XdmfWriter, FacetsHaveTheNumbersOfTheirGroups) {
  const TempDir dir;
  for (unsigned seed = 0; seed < 3; ++seed) {
    const std::array<double, 3> size{3, 2, 4};
    save(grid_mesh({3, 2, 4}, seed), dir.path() / "m.xdmf");
    const MeshData mesh = read_back(dir.path() / "m.xdmf");
    std::map<std::set<std::uint64_t>, std::multiset<RawLabel>> labels;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      for (const std::uint64_t left_out : mesh.tets[t]) {
        std::set<std::uint64_t> triangle(mesh.tets[t].begin(), mesh.tets[t].end());
        triangle.erase(left_out);
        labels[triangle].insert(mesh.labels[t]);
      }
    }
    const auto rows =
        hdf5_numbers<std::int64_t>(dir.path() / "m.h5", "/MeshTags/facet_tags/topology");
    const auto numbers =
        hdf5_numbers<std::int64_t>(dir.path() / "m.h5", "/MeshTags/facet_tags/Values");
    ASSERT_EQ(rows.size(), 3 * numbers.size());
    std::map<std::int64_t, std::multiset<RawLabel>> of_number;
    for (std::size_t f = 0; f < numbers.size(); ++f) {
      const auto first = rows.begin() + static_cast<std::ptrdiff_t>(3 * f);
      const std::set<std::uint64_t> triangle(first, first + 3);
      const std::multiset<RawLabel>& sides = labels.at(triangle);
      if (numbers[f] < 8) {
        EXPECT_EQ(sides.size(), 1U);
        const auto axis = static_cast<std::size_t>((numbers[f] - 1) / 2);
        const double plane = numbers[f] % 2 == 1 ? 0 : size[axis];
        for (const std::uint64_t row : triangle) EXPECT_EQ(mesh.vertices[row][axis], plane);
      } else {
        ASSERT_EQ(sides.size(), 2U);
        EXPECT_NE(*sides.begin(), *sides.rbegin());
        EXPECT_EQ(of_number.emplace(numbers[f], sides).first->second, sides) << numbers[f];
      }
      labels.erase(triangle);
    }
    // What is left bounds nothing.
    for (const auto& [triangle, sides] : labels) {
      ASSERT_EQ(sides.size(), 2U);
      EXPECT_EQ(*sides.begin(), *sides.rbegin());
    }
    const std::string table = content_of(dir.path() / "m.facets.csv");
    EXPECT_THAT(table, testing::StartsWith("number,name,side,first,second\n"));
    EXPECT_THAT(table, testing::HasSubstr("1,\"x_min\",x_min,,\n"));
    EXPECT_THAT(table, testing::HasSubstr("8,\"label_0|label_1\",interface,0,1\n"));
  }
}

}  // namespace
}  // namespace mw::io
