// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Mesh files: what is read is a mesh, and comes back from a file of our own bit by bit.
#include <algorithm>
#include <bit>

#include "io/file/source/file_source.h"
#include "io/mesh/gmsh/msh.h"
#include "io/mesh/medit/medit.h"
#include "io/mesh/pieces/pvtu.h"
#include "io/mesh/vtu/vtu.h"
#include "tests/fuzz/all_targets.h"
#include "tests/fuzz/byte_file.h"
#include "tests/fuzz/file_tree.h"

namespace mw::fuzz {
namespace {

using io::MeshData;

bool same_bits(const io::Position& a, const io::Position& b) {
  using Bits = std::array<std::uint64_t, 3>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

bool same_names(const io::LabelNames& a, const io::LabelNames& b) {
  return std::equal(a.rows().begin(), a.rows().end(), b.rows().begin(), b.rows().end());
}

void check(const MeshData& mesh) {
  require(mesh.labels.size() == mesh.tets.size(), "each tet has a label");
  for (const io::TetRows& tet : mesh.tets) {
    for (const std::uint64_t row : tet) require(row < mesh.vertices.size(), "rows exist");
  }
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "again.vtu";
  io::VtuSink sink(path);
  io::write_mesh(mesh, sink);
  const MeshData again = io::read_vtu(io::FileSource(path));
  require(std::equal(mesh.vertices.begin(), mesh.vertices.end(), again.vertices.begin(),
                     again.vertices.end(), same_bits),
          "vertices come back");
  require(mesh.tets == again.tets && mesh.labels == again.labels, "tets come back");
  require(mesh.labels_signed == again.labels_signed, "labels stay signed or not");
  require(same_names(mesh.names, again.names), "names come back");
}

/// What is refused is refused while it is read.
template <class Read>
void read_and_check(Read read) {
  MeshData mesh;
  if (ends_well([&] { mesh = read(); })) check(mesh);
}

using ReadPath = MeshData (*)(const std::filesystem::path& path);

void read_tree(Bytes bytes, const char* name, ReadPath read) {
  const FileTree files(bytes);
  read_and_check([&] { return read(files.path() / name); });
}

}  // namespace

void fuzz_vtu(Bytes bytes) {
  read_and_check([&] { return io::read_vtu(ByteFile(bytes)); });
}

void fuzz_pvtu(Bytes bytes) {
  read_tree(bytes, "m.pvtu", io::read_pvtu);
}

void fuzz_medit(Bytes bytes) {
  read_and_check([&] { return io::read_medit(ByteFile(bytes)); });
}

void fuzz_gmsh(Bytes bytes) {
  read_tree(bytes, "m.msh", io::read_msh);
}

}  // namespace mw::fuzz
