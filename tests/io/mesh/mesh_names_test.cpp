// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels survive every mesh format; without names nothing changes; damage is told.
#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/mesh_digest.h"
#include "tests/io/mesh/sample_mesh.h"
#include "tests/io/names/random_names.h"

namespace mw::io {
namespace {

constexpr const char* kFiles[] = {"m.vtkhdf", "m.vtu", "m.mesh"};

void save(const MeshData& mesh, const std::filesystem::path& path) {
  write_mesh(mesh, *open_mesh_sink(path));
}

MeshData named_mesh(std::mt19937& random, std::size_t names, bool labels_signed) {
  MeshData mesh = sample_mesh(5, labels_signed);
  mesh.names = random_names(random, names);
  return mesh;
}

TEST(MeshNames, RandomNamesAreReadBack) {
  const TempDir dir;
  std::mt19937 random(51);
  for (int i = 0; i < 60; ++i) {
    const MeshData mesh = named_mesh(random, below(random, 40), i % 2 == 1);
    for (const char* file : kFiles) {
      SCOPED_TRACE(file);
      save(mesh, dir.path() / file);
      const MeshData back = read_mesh(dir.path() / file);
      expect_same(back, mesh);
      expect_same_names(back.names, mesh.names);
    }
  }
}

TEST(MeshNames, ManyNamesAndLongOnes) {
  const TempDir dir;
  MeshData mesh = sample_mesh(2, false);
  std::vector<LabelName> rows;
  for (RawLabel label = 0; label < 20000; ++label) {
    rows.push_back({label, "label number " + std::to_string(label), Colour{1, 2, 3, 4}});
  }
  rows[7].name = std::string(kMaxNameBytes, '"');
  mesh.names = LabelNames(rows);
  for (const char* file : kFiles) {
    save(mesh, dir.path() / file);
    expect_same_names(read_mesh(dir.path() / file).names, mesh.names);
  }
}

TEST(MeshNames, DigestDoesNotDependOnThem) {
  std::mt19937 random(53);
  const MeshData mesh = named_mesh(random, 20, false);
  EXPECT_EQ(mesh_digest(mesh), mesh_digest(sample_mesh(5, false)));
}

/// The text between the two, both included, taken out.
std::string without(std::string text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from);
  const std::size_t end = text.find(to, begin);
  if (begin == std::string::npos || end == std::string::npos) return {};
  return text.erase(begin, end + to.size() - begin);
}

TEST(MeshNames, AreAllThatIsAdded) {
  const TempDir dir;
  std::mt19937 random(54);
  const MeshData plain = sample_mesh(5, false);
  MeshData named = plain;
  named.names = LabelNames({{3, "x", Colour{1, 2, 3, 4}}});
  for (const char* file : kFiles) {
    save(named, dir.path() / (std::string("named_") + file));
    save(plain, dir.path() / file);
  }
  EXPECT_EQ(without(content_of(dir.path() / "named_m.vtu"), "    <FieldData>", "</FieldData>\n"),
            content_of(dir.path() / "m.vtu"));
  EXPECT_EQ(without(content_of(dir.path() / "named_m.mesh"), "# label", "\n"),
            content_of(dir.path() / "m.mesh"));
  EXPECT_EQ(content_of(dir.path() / "m.vtkhdf").find("FieldData"), std::string::npos);
}

TEST(MeshNames, SameBytesEveryTime) {
  const TempDir dir;
  std::mt19937 random(55);
  const MeshData mesh = named_mesh(random, 300, false);
  for (const char* file : kFiles) {
    save(mesh, dir.path() / file);
    const std::string first = content_of(dir.path() / file);
    const std::string noise(100000, 'n');  // other content where the next one allocates
    save(mesh, dir.path() / file);
    EXPECT_TRUE(content_of(dir.path() / file) == first) << file << noise.size();
  }
}

TEST(MeshNames, MeditCommentsOfOthersAreNoNames) {
  const TempDir dir;
  const std::string rest =
      "Vertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTetrahedra\n1\n1 2 3 4 7\nEnd\n";
  const auto names_of_comments = [&](const std::string& comments) {
    return read_mesh(dir.file("a.mesh", "MeshVersionFormatted 2\nDimension 3\n" + comments + rest))
        .names;
  };
  for (const char* comment :
       {"# label", "# label x \"a\"", "# label 7", "# label 7 \"a", "# label 7 \"a\" 1 2 3",
        "# label 7 \"a\" 1 2 3 256", "# labels 7 \"a\"", "# label 7 \"a\\"}) {
    EXPECT_TRUE(names_of_comments(comment + std::string("\n")).empty()) << comment;
  }
  EXPECT_EQ(names_of_comments("#label 7 \"a\\\"\\\\\"\r\n").name(7), "a\"\\");
  EXPECT_TRUE(names_of_comments("# label 7 \"" + std::string(100000, 'a') + "\"\n").empty());
}

std::string vtu_with(const std::string& field_data) {
  return "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\"><UnstructuredGrid><FieldData>" +
         field_data +
         "</FieldData><Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/>"
         "</UnstructuredGrid></VTKFile>";
}

const std::string kIds =
    "<DataArray type=\"Int32\" Name=\"label_id\" NumberOfTuples=\"2\" format=\"ascii\">7 -9"
    "</DataArray>";

TEST(MeshNames, VtuFieldDataAsVtkWritesIt) {
  const TempDir dir;
  const auto read = [&](const std::string& fields) {
    return read_mesh(dir.file("a.vtu", vtu_with(fields))).names;
  };
  // VTK writes bytes above 127 as negative numbers, and strings in base64 with their NULs.
  expect_same_names(read(kIds + "<Array type=\"String\" Name=\"label_name\" NumberOfTuples=\"2\" "
                                "format=\"ascii\">97 -61 -87 0 98 0</Array>"),
                    LabelNames({{7, "aé", {}}, {static_cast<RawLabel>(-9), "b", {}}}));
  expect_same_names(read(kIds + "<Array type=\"String\" Name=\"label_name\" NumberOfTuples=\"2\" "
                                "format=\"binary\">BAAAAAAAAABhAGIA</Array>"),
                    LabelNames({{7, "a", {}}, {static_cast<RawLabel>(-9), "b", {}}}));
  // The first is what we write, the second what VTK makes of it.
  for (const char* array :
       {"format=\"ascii\">97 195 169 0 98 0", "format=\"binary\">BgAAAAAAAABhw6kAYgA="}) {
    expect_same_names(
        read(kIds + "<DataArray type=\"UInt8\" Name=\"label_name\" NumberOfTuples=\"6\" " + array +
             "</DataArray>"),
        LabelNames({{7, "aé", {}}, {static_cast<RawLabel>(-9), "b", {}}}));
  }
  EXPECT_TRUE(read(kIds).empty());
  EXPECT_TRUE(read("<DataArray type=\"Float64\" Name=\"label_id\" NumberOfTuples=\"1\" "
                   "format=\"ascii\">7</DataArray><Array type=\"String\" Name=\"label_name\" "
                   "NumberOfTuples=\"1\" format=\"ascii\">97 0</Array>")
                  .empty());
}

TEST(MeshNames, VtuFieldDataThatIsDamaged) {
  const TempDir dir;
  const auto refuse = [&](const std::string& strings, std::vector<std::string> pieces) {
    const auto path = dir.file("a.vtu", vtu_with(kIds +
                                                 "<Array type=\"String\" "
                                                 "Name=\"label_name\" " +
                                                 strings));
    pieces.push_back(path.string());
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(read_mesh(path)); });
  };
  refuse("format=\"ascii\">97 0</Array>", {"2 numbers, 1 names"});
  refuse("format=\"ascii\">97 0 98</Array>", {"label_name", "does not end"});
  refuse("format=\"ascii\">97 x</Array>", {"label_name", "x"});
  refuse("format=\"binary\">/////////38=</Array>", {"label_name"});
  refuse("format=\"appended\" offset=\"0\"/>", {"label_name"});
}

/// Each byte from `begin` to `end` in turn has some bits flipped.
void expect_damage_is_told(const std::filesystem::path& path, std::size_t begin, std::size_t end) {
  const std::string good = content_of(path);
  for (std::size_t at = begin; at < std::min(end, good.size()); ++at) {
    for (const unsigned mask : {0x01U, 0x80U, 0xFFU}) {
      std::string bad = good;
      bad[at] = static_cast<char>(static_cast<unsigned char>(bad[at]) ^ mask);
      std::ofstream(path, std::ios::binary) << bad;
      try {
        static_cast<void>(read_mesh(path));
      } catch (const Error& error) {
        ASSERT_EQ(error.kind(), ErrorKind::kInput) << path << " " << at << " " << error.what();
      }
    }
  }
}

TEST(MeshNames, DamagedFilesAreReadOrRefused) {
  const TempDir dir;
  MeshData mesh = sample_mesh(2, false);
  mesh.names = LabelNames({{1, "one", Colour{1, 2, 3, 4}}, {7, "sieben \"ü\"", {}}});
  for (const char* file : kFiles) save(mesh, dir.path() / file);
  expect_damage_is_told(dir.path() / "m.vtu", 0, SIZE_MAX);
  expect_damage_is_told(dir.path() / "m.mesh", 0, SIZE_MAX);
  // The HDF5 library does not survive all damage to what is its own; the names are ours.
  const std::string stored = content_of(dir.path() / "m.vtkhdf");
  const std::size_t bytes = stored.find(std::string("one\0sieben", 10));
  ASSERT_NE(bytes, std::string::npos);
  expect_damage_is_told(dir.path() / "m.vtkhdf", bytes, bytes + 16);
}

TEST(MeshNames, VtkhdfNamesOfAnotherNumberAreRefused) {
  const TempDir dir;
  MeshData mesh = sample_mesh(2, false);
  mesh.names = LabelNames({{1, "one", {}}, {7, "sieben", {}}});
  const auto path = dir.path() / "m.vtkhdf";
  save(mesh, path);
  std::string bytes = content_of(path);
  bytes[bytes.find(std::string("one\0sieben", 10)) + 3] = 'x';
  expect_error(ErrorKind::kInput, {path.string(), "2 numbers, 1 names"},
               [&] { static_cast<void>(read_mesh(dir.file("m.vtkhdf", bytes))); });
}

}  // namespace
}  // namespace mw::io
