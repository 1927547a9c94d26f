// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads and writes meshes, the format chosen by extension.
#include "io/mesh/open_mesh.h"

#include "io/file/errors.h"
#include "io/file/open_bytes.h"
#include "io/mesh/medit/medit_reader.h"
#include "io/mesh/medit/medit_sink.h"
#include "io/mesh/vtu/vtu_reader.h"
#include "io/mesh/vtu/vtu_sink.h"

namespace mw::io {
namespace {

[[noreturn]] void fail_extension(const std::filesystem::path& path) {
  throw Error(ErrorKind::kUsage,
              text(path.string(), ": extension '", path.extension().string(),
                   "' is no mesh format known here; supported are .vtu and .mesh (MEDIT)"));
}

}  // namespace

MeshData read_mesh(const std::filesystem::path& path) {
  const std::filesystem::path extension = path.extension();
  if (extension != ".vtu" && extension != ".mesh") fail_extension(path);
  const std::unique_ptr<ByteSource> source = open_bytes(path);
  return extension == ".vtu" ? read_vtu(*source) : read_medit(*source);
}

std::unique_ptr<MeshSink> open_mesh_sink(const std::filesystem::path& path) {
  if (path.extension() == ".vtu") return std::make_unique<VtuSink>(path);
  if (path.extension() == ".mesh") return std::make_unique<MeditSink>(path);
  fail_extension(path);
}

void write_mesh(const MeshData& mesh, MeshSink& sink) {
  sink.begin({.vertices = mesh.vertices.size(),
              .tets = mesh.tets.size(),
              .labels_signed = mesh.labels_signed});
  sink.write_vertices(mesh.vertices);
  sink.write_tets(mesh.tets, mesh.labels);
  sink.finish();
}

}  // namespace mw::io
