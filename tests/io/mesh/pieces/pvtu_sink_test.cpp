// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/pieces/pvtu.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <pugixml.hpp>

#include "io/mesh/open_mesh.h"
#include "kernels/core/error.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/temp_folder.h"

namespace mw::io {
namespace {

namespace fs = std::filesystem;

using Tet = std::pair<std::array<Position, 4>, RawLabel>;

/// Tets by where they are, in the order of the mesh.
std::vector<Tet> tets_of(const MeshData& mesh) {
  std::vector<Tet> out;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Tet& tet = out.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) tet.first[i] = mesh.vertices[mesh.tets[t][i]];
    tet.second = mesh.labels[t];
  }
  return out;
}

std::vector<fs::path> pieces_named_in(const fs::path& index) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_file(index.c_str()));
  std::vector<fs::path> out;
  for (const auto& piece : document.child("VTKFile").child("PUnstructuredGrid").children("Piece")) {
    out.push_back(index.parent_path() / piece.attribute("Source").as_string());
  }
  return out;
}

class PvtuSinkTest : public testing::Test {
 protected:
  void write(const MeshData& mesh, const char* name, std::uint64_t pieces) {
    write_mesh(mesh, *open_mesh_pieces(folder_.path() / name, pieces));
  }
  test::TempFolder folder_;
};

TEST_F(PvtuSinkTest, PiecesTogetherAreTheMesh) {
  for (const std::uint64_t pieces : {1U, 2U, 5U, 16U}) {
    MeshData mesh = grid_mesh({4, 3, 2}, 421);
    mesh.labels_signed = pieces == 2;
    if (pieces == 2) mesh.labels.front() = static_cast<RawLabel>(-7);
    const std::string name = "a & b " + std::to_string(pieces) + ".pvtu";
    write(mesh, name.c_str(), pieces);
    std::vector<Tet> all;
    for (const fs::path& path : pieces_named_in(folder_.path() / name)) {
      const MeshData piece = read_mesh(path);
      EXPECT_EQ(piece.labels_signed, mesh.labels_signed);
      const std::vector<Tet> more = tets_of(piece);
      all.insert(all.end(), more.begin(), more.end());
    }
    std::vector<Tet> expected = tets_of(mesh);
    std::sort(all.begin(), all.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(all, expected);
  }
}

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
