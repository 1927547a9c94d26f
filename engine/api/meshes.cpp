// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Meshes in memory, their files and digests.
#include "engine/api/meshes.h"

#include "engine/api/guarded.h"
#include "engine/api/spaces.h"
#include "io/file/scratch/scratch_file.h"
#include "io/mesh/digest.h"
#include "io/mesh/open_mesh.h"

namespace mw::api {

mwmesh::Mesh library_mesh(io::MeshData&& mesh) {
  return {.points = std::move(mesh.vertices),
          .tets = std::move(mesh.tets),
          .labels = std::move(mesh.labels),
          .labels_are_signed = mesh.labels_signed,
          .names = library_names(mesh.names),
          .report = {},
          .record = io::record_text(mesh.record)};
}

void deliver(const mwmesh::Mesh& mesh, io::MeshSink& sink) {
  if (mesh.labels.size() != mesh.tets.size()) {
    throw Error(ErrorKind::kUsage, "mesh: there must be one label a tet");
  }
  for (const auto& tet : mesh.tets) {
    for (const std::uint64_t row : tet) {
      if (row < mesh.points.size()) continue;
      throw Error(ErrorKind::kUsage, "mesh: a tet names point " + std::to_string(row) + " of " +
                                         std::to_string(mesh.points.size()));
    }
  }
  sink.begin({.tets = mesh.tets.size(),
              .labels_signed = mesh.labels_are_signed,
              .names = io_names(mesh.names),
              .record = io::parse_record(mesh.record, "mesh")});
  sink.write_vertices(mesh.points);
  sink.write_tets(mesh.tets, mesh.labels);
  sink.finish();
}

}  // namespace mw::api

namespace mwmesh {

Mesh read_mesh(const std::filesystem::path& path) {
  return mw::api::guarded([&] { return mw::api::library_mesh(mw::io::read_mesh(path)); });
}

void write_mesh(const Mesh& mesh, const std::filesystem::path& path, std::string_view element) {
  mw::api::guarded([&] {
    const auto sink = mw::io::open_mesh_sink(path, mw::io::parse_element(element));
    mw::api::deliver(mesh, *sink);
  });
}

std::string digest(const Mesh& mesh) {
  return mw::api::guarded([&] {
    mw::io::DigestSink sink(mw::io::scratch_folder());
    mw::api::deliver(mesh, sink);
    return sink.digest();
  });
}

}  // namespace mwmesh
