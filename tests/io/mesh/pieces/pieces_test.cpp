// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Meshes in pieces: which tets a piece has, what comes back, and where pieces are not written.
#include "io/mesh/open_mesh.h"
#include "io/mesh/pieces/pvtu.h"
#include "tests/expect_error.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/temp_folder.h"

namespace mw::io {
namespace {

/// Each tet once, pieces of one size give or take a tet, and the same again.
TEST(MeshParts, ShareOutAllTetsEvenly) {
  std::mt19937 random(411);
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    const auto edge = [&] { return std::uint64_t{1 + random() % 6}; };
    const MeshData mesh = grid_mesh({edge(), edge(), edge()}, 412 + static_cast<unsigned>(i));
    const std::uint64_t tets = mesh.tets.size();
    const std::uint64_t pieces = 1 + random() % std::min<std::uint64_t>(tets, 40);
    const auto parts = mesh_parts(mesh, pieces);
    ASSERT_EQ(parts.size(), pieces);
    std::set<std::uint64_t> all;
    for (const auto& part : parts) {
      EXPECT_TRUE(part.size() == tets / pieces || part.size() == (tets + pieces - 1) / pieces);
      EXPECT_TRUE(std::is_sorted(part.begin(), part.end()));
      all.insert(part.begin(), part.end());
    }
    EXPECT_EQ(all.size(), tets);
    EXPECT_EQ(*all.rbegin(), tets - 1);
    EXPECT_EQ(mesh_parts(mesh, pieces), parts);
  }
  const MeshData cube = grid_mesh({1, 1, 1}, 413);
  EXPECT_EQ(mesh_parts(cube, cube.tets.size()).size(), cube.tets.size());
}

/// Eight pieces of a cube are its octants.
TEST(MeshParts, AreCompact) {
  const MeshData mesh = grid_mesh({8, 8, 8}, 414);
  for (const auto& part : mesh_parts(mesh, 8)) {
    Position lo = mesh.vertices[mesh.tets[part.front()][0]], hi = lo;
    for (const std::uint64_t t : part) {
      for (const std::uint64_t v : mesh.tets[t]) {
        for (std::size_t k = 0; k < 3; ++k) {
          lo[k] = std::min(lo[k], mesh.vertices[v][k]);
          hi[k] = std::max(hi[k], mesh.vertices[v][k]);
        }
      }
    }
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(hi[k] - lo[k], 4);
  }
}

// Meshes in pieces come back as one; indices and pieces that are damaged or of others do not.

namespace fs = std::filesystem;

std::vector<std::pair<TetRows, RawLabel>> sorted_tets(const MeshData& mesh) {
  std::vector<std::pair<TetRows, RawLabel>> out;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    out.emplace_back(mesh.tets[t], mesh.labels[t]);
  }
  std::sort(out.begin(), out.end());
  return out;
}

void put(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

class PvtuReaderTest : public testing::Test {
 protected:
  fs::path write(const MeshData& mesh, std::uint64_t pieces) {
    fs::path path = folder_.path() / ("m" + std::to_string(pieces) + ".pvtu");
    write_mesh(mesh, *open_mesh_pieces(path, pieces));
    return path;
  }
  /// Replaces the first of `from` in the file.
  void change(const fs::path& file, const std::string& from, const std::string& to) {
    std::string text = test::content_of(file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, text.npos) << from;
    put(file, text.replace(at, from.size(), to));
  }
  void expect_refused(const fs::path& path, const std::string& what) {
    expect_error(ErrorKind::kInput, {what}, [&] { static_cast<void>(read_mesh(path)); });
  }
  test::TempFolder folder_;
};

TEST_F(PvtuReaderTest, PiecesComeBackAsTheMesh) {
  for (const std::uint64_t pieces : {1U, 2U, 3U, 16U}) {
    MeshData mesh = grid_mesh({4, 3, 2}, 431);
    mesh.labels_signed = pieces == 3;
    if (pieces == 3) mesh.labels.back() = static_cast<RawLabel>(-7);
    mesh.names = LabelNames({{mesh.labels.front(), "first", {}}});
    const fs::path path = folder_.path() / ("a & b " + std::to_string(pieces) + ".pvtu");
    write_mesh(mesh, *open_mesh_pieces(path, pieces));
    EXPECT_TRUE(is_mesh_path(path));
    const MeshData back = read_mesh(path);
    EXPECT_EQ(back.vertices, mesh.vertices);
    EXPECT_EQ(sorted_tets(back), sorted_tets(mesh));
    EXPECT_EQ(back.labels_signed, mesh.labels_signed);
    ASSERT_EQ(back.names.rows().size(), 1U);
    EXPECT_EQ(back.names.rows().front().name, "first");
  }
}

TEST_F(PvtuReaderTest, RefusesWhatIsNoMesh) {
  const MeshData mesh = grid_mesh({3, 2, 2}, 432);
  const fs::path path = write(mesh, 4);
  const std::string index = test::content_of(path);
  const auto refused_with = [&](const char* from, const char* to, const char* what) {
    change(path, from, to);
    expect_refused(path, what);
    put(path, index);
  };
  refused_with("GhostLevel=\"0\"", "GhostLevel=\"1\"", "GhostLevel");
  refused_with("m4/m4_0001.vtu", "../m4_0001.vtu", "Source");
  refused_with("m4/m4_0001.vtu", "/etc/hostname", "Source");
  refused_with("m4/m4_0001.vtu", "m4/m4_0007.vtu", "is missing");
  refused_with("Source=\"m4/m4_0001.vtu\"", "", "Source");
  refused_with("type=\"PUnstructuredGrid\"", "type=\"PImageData\"", "PUnstructuredGrid");
  const std::size_t first = index.find("    <Piece");
  put(path, index.substr(0, first) + index.substr(index.find("  </PUnstr")));
  expect_refused(path, "Piece");
}

TEST_F(PvtuReaderTest, RefusesPiecesThatDoNotFit) {
  const MeshData mesh = grid_mesh({3, 2, 2}, 433);
  const fs::path path = write(mesh, 2), piece = folder_.path() / "m2" / "m2_0001.vtu";
  MeshData moved = mesh;
  for (Position& p : moved.vertices) p[0] += 1.0;
  const test::TempFolder other;
  write_mesh(moved, *open_mesh_pieces(other.path() / "m2.pvtu", 2));
  const std::string good = test::content_of(piece);
  put(piece, test::content_of(other.path() / "m2" / "m2_0001.vtu"));
  expect_refused(path, "is at two places");
  write_mesh(mesh, *open_mesh_sink(piece));
  expect_refused(path, "GlobalNodeIds");
  write_mesh(mesh, *open_mesh_sink(piece, Element::kTet10));
  expect_refused(path, "ten nodes");
  put(piece, good);
  EXPECT_EQ(read_mesh(path).vertices, mesh.vertices);
}

TEST_F(PvtuReaderTest, TruncatedIndicesEndInErrors) {
  const fs::path path = write(grid_mesh({2, 1, 1}, 434), 2);
  const std::string index = test::content_of(path);
  for (std::size_t size = 0; size + 2 < index.size(); ++size) {
    put(path, index.substr(0, size));
    EXPECT_THROW(static_cast<void>(read_mesh(path)), Error) << size;
  }
}

TEST_F(PvtuReaderTest, IsNotWrittenWithoutAskingForPieces) {
  EXPECT_THROW(static_cast<void>(open_mesh_sink(folder_.path() / "m.pvtu")), Error);
}

class PvtuSinkTest : public testing::Test {
 protected:
  void write(const MeshData& mesh, const char* name, std::uint64_t pieces) {
    write_mesh(mesh, *open_mesh_pieces(folder_.path() / name, pieces));
  }
  test::TempFolder folder_;
};

TEST_F(PvtuSinkTest, LeavesNothingWhereItCannotBe) {
  const MeshData mesh = grid_mesh({1, 1, 1}, 422);
  EXPECT_THROW(write(mesh, "m.pvtu", mesh.tets.size() + 1), Error);
  EXPECT_THROW(write(mesh, "m.vtu", 2), Error);
  EXPECT_THROW(write(mesh, "m.pvtu", 0), Error);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

/// What is in the folder may be of another mesh.
TEST_F(PvtuSinkTest, TakesNoFolderOfOthers) {
  const MeshData mesh = grid_mesh({2, 1, 1}, 423);
  fs::create_directory(folder_.path() / "m");
  std::ofstream(folder_.path() / "m" / "note") << "kept";
  EXPECT_THROW(write(mesh, "m.pvtu", 2), Error);
  EXPECT_FALSE(fs::exists(folder_.path() / "m.pvtu"));
  EXPECT_TRUE(fs::exists(folder_.path() / "m" / "note"));
}

}  // namespace
}  // namespace mw::io
