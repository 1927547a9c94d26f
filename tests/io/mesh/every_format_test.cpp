// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Every format to every other: the same content, by its digest, with names and labels.
#include <algorithm>

#include "io/mesh/digest.h"
#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/grid_mesh.h"
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

std::vector<std::string> extensions() {
  std::vector<std::string> out;
  std::string all = mesh_extensions() + ",";
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t end = all.find(',', at);
    out.push_back(all.substr(at, end - at));
    at = all.find_first_not_of(", ", end);
    if (at == all.npos) break;
  }
  return out;
}

TEST(EveryFormat, ToEveryOther) {
  EXPECT_GE(extensions().size(), 8U);
  for (const bool labels_signed : {false, true}) {
    const TempDir dir;
    const MeshData mesh = solid(labels_signed);
    const std::string digest = mesh_digest(mesh);
    for (const std::string& from : extensions()) {
      const auto path = dir.path() / ("a" + from);
      write_mesh(mesh, *open_mesh_sink(path));
      for (const std::string& to : extensions()) {
        SCOPED_TRACE(from + " to " + to);
        const auto copy = dir.path() / ("b" + to);
        copy_mesh(path, *open_mesh_sink(copy));
        const MeshData back = read_mesh(copy);
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
  for (const std::string& extension : extensions()) {
    if (extension == ".mesh") continue;
    SCOPED_TRACE(extension);
    const auto path = dir.path() / ("a" + extension);
    write_mesh(mesh, *open_mesh_sink(path, Element::kTet10));
    const std::uintmax_t bytes = std::filesystem::file_size(path);
    EXPECT_EQ(mesh_digest(read_mesh(path)), mesh_digest(mesh));
    write_mesh(mesh, *open_mesh_sink(path));
    EXPECT_TRUE(extension == ".xdmf" || std::filesystem::file_size(path) < bytes);
  }
}

}  // namespace
}  // namespace mw::io
