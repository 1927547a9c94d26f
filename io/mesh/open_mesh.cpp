// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads and writes meshes, the format chosen by extension.
#include "io/mesh/open_mesh.h"

#include "io/file/errors.h"
#include "io/file/open_bytes.h"
#include "io/mesh/medit/medit_reader.h"
#include "io/mesh/medit/medit_sink.h"
#include "io/mesh/vtkhdf/vtkhdf_reader.h"
#include "io/mesh/vtkhdf/vtkhdf_sink.h"
#include "io/mesh/vtu/vtu_reader.h"
#include "io/mesh/vtu/vtu_sink.h"

namespace mw::io {
namespace {

[[noreturn]] void fail_extension(const std::filesystem::path& path) {
  throw Error(
      ErrorKind::kUsage,
      text(path.string(), ": extension '", path.extension().string(),
           "' is no mesh format known here; supported are .vtkhdf, .vtu and .mesh (MEDIT)"));
}

}  // namespace

MeshData read_mesh(const std::filesystem::path& path) {
  const std::filesystem::path extension = path.extension();
  if (extension == ".vtu") return read_vtu(*open_bytes(path));
  if (extension == ".mesh") return read_medit(*open_bytes(path));
  if (extension != ".vtkhdf") fail_extension(path);
  MeshDataSink sink;
  read_vtkhdf(path, sink);
  return std::move(sink.mesh());
}

void copy_mesh(const std::filesystem::path& path, MeshSink& sink) {
  if (path.extension() == ".vtkhdf") {
    read_vtkhdf(path, sink);
  } else {
    write_mesh(read_mesh(path), sink);
  }
}

std::unique_ptr<MeshSink> open_mesh_sink(const std::filesystem::path& path) {
  if (path.extension() == ".vtkhdf") return std::make_unique<VtkhdfSink>(path);
  if (path.extension() == ".vtu") return std::make_unique<VtuSink>(path);
  if (path.extension() == ".mesh") return std::make_unique<MeditSink>(path);
  fail_extension(path);
}

}  // namespace mw::io
