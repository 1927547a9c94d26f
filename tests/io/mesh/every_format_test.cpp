// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Every format that is read to every one that is written: the same content, by its digest, with
// names and labels.
#include "io/file/errors.h"
#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/grid_mesh.h"
#include "tests/io/mesh/mesh_digest.h"
#include "tests/io/mesh/mesh_endings.h"
#include "tests/io/mesh/read_back.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

/// Labels of 64 bits, some of them named; every vertex is in a tet.
MeshData solid(bool labels_signed) {
  MeshData mesh = grid_mesh({3, 3, 2}, 8);
  mesh.labels_signed = labels_signed;
  const std::array<RawLabel, 4> labels{0, 7, 1ULL << 40,
                                       labels_signed ? static_cast<RawLabel>(-3) : ~0ULL};
  for (RawLabel& label : mesh.labels) label = labels[label];
  mesh.names = LabelNames({{7, "left \"upper\" <half>, & more", Colour{250, 1, 2, 255}}});
  return mesh;
}

/// Formats without room for the middles of edges say so.
bool takes_ten_nodes(const std::filesystem::path& path) {
  try {
    static_cast<void>(open_mesh_sink(path, Element::kTet10));
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage) << error.what();
    return false;
  }
}

TEST(EveryFormat, ToEveryOther) {
  EXPECT_GE(mesh_endings().size(), 7U);
  for (const bool labels_signed : {false, true}) {
    const TempDir dir;
    const MeshData mesh = solid(labels_signed);
    const std::string digest = mesh_digest(mesh);
    for (const std::string& from : mesh_endings(read_mesh_extensions())) {
      if (from == kPiecesExtension) continue;
      const auto path = dir.path() / ("a" + from);
      write_mesh(mesh, *open_mesh_sink(path));
      for (const std::string& to : mesh_endings()) {
        SCOPED_TRACE(text(from, " to ", to));
        const auto copy = dir.path() / ("b" + to);
        copy_mesh(path, *open_mesh_sink(copy));
        const MeshData back = read_back(copy);
        EXPECT_EQ(mesh_digest(back), digest);
        ASSERT_NE(back.names.find(7), nullptr);
        EXPECT_EQ(*back.names.find(7), *mesh.names.find(7));
      }
    }
  }
}

/// Middles of edges are a matter of the file, not of the mesh.
TEST(EveryFormat, OfTenNodesIsTheSameMesh) {
  const TempDir dir;
  const MeshData mesh = solid(false);
  int tried = 0;
  for (const std::string& extension : mesh_endings()) {
    SCOPED_TRACE(extension);
    const auto path = dir.path() / ("a" + extension);
    if (!takes_ten_nodes(path)) continue;
    // These have ten or fourteen digits, and no sign of which nodes are middles.
    if (std::set<std::string>{".bdf", ".k", ".cdb"}.contains(extension)) continue;
    ++tried;
    write_mesh(mesh, *open_mesh_sink(path, Element::kTet10));
    const std::uintmax_t bytes = std::filesystem::file_size(path);
    EXPECT_EQ(mesh_digest(read_back(path)), mesh_digest(mesh));
    write_mesh(mesh, *open_mesh_sink(path));
    EXPECT_TRUE(extension == ".xdmf" || std::filesystem::file_size(path) < bytes);
  }
  EXPECT_GE(tried, 6);
}

/// Solvers' formats are written only, which is said with those that are read.
TEST(EveryFormat, SolversAreNotRead) {
  const TempDir dir;
  for (const std::string ending : {".inp", ".feb", ".xdmf", ".exo", ".bdf", ".k", ".cdb"}) {
    const auto path = dir.path() / ("a" + ending);
    write_mesh(solid(false), *open_mesh_sink(path));
    EXPECT_TRUE(is_mesh_path(path));
    expect_error(ErrorKind::kUsage,
                 {path.string(), ending + " is written here, but not read",
                  ".vtkhdf, .vtu, .mesh, .msh, .msh2, .pvtu"},
                 [&] { static_cast<void>(read_mesh(path)); });
  }
  expect_error(ErrorKind::kUsage, {"a.node", "no mesh format"},
               [] { static_cast<void>(read_mesh("a.node")); });
}

}  // namespace
}  // namespace mw::io
