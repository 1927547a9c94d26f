// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Meshes in pieces come back as one; indices and pieces that are damaged or of others do not.
#include "io/mesh/pieces/pvtu.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/mesh/open_mesh.h"
#include "kernels/core/error.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/temp_folder.h"

namespace mw::io {
namespace {

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
    try {
      static_cast<void>(read_mesh(path));
      ADD_FAILURE() << "read in spite of " << what;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  }
  test::TempFolder folder_;
};

TEST_F(PvtuReaderTest, PiecesComeBackAsTheMesh) {
  for (const std::uint64_t pieces : {1U, 2U, 3U, 16U}) {
    MeshData mesh = grid_mesh({4, 3, 2}, 431);
    mesh.labels_signed = pieces == 3;
    mesh.names = LabelNames({{mesh.labels.front(), "first", {}}});
    const fs::path path = write(mesh, pieces);
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

}  // namespace
}  // namespace mw::io
