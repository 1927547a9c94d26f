// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Meshes in memory, their files and digests.
#include "engine/api/guarded.h"
#include "engine/api/types.h"
#include "engine/picture/draw.h"
#include "engine/settings/named_labels.h"
#include "io/file/scratch/scratch_file.h"
#include "io/mesh/digest.h"
#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/open_mesh.h"

namespace mwmesh {

Mesh read_mesh(const std::filesystem::path& path) {
  return mw::api::guarded(
      [&] { return mw::api::library_mesh(mw::io::read_mesh(mw::api::checked_path(path))); });
}

void write_mesh(const Mesh& mesh, const std::filesystem::path& path, const FileOptions& file) {
  mw::api::guarded([&] {
    const bool has_values = file.values && !mesh.values.empty();
    // Materials are made of values, also in a file that has no place for these.
    const bool needs_values = file.values || !file.materials.empty();
    mw::api::deliver(mesh, *mw::api::open_file(path, file, has_values), needs_values);
  });
}

void write_mesh(const Mesh& mesh, const std::filesystem::path& path, std::string_view element) {
  write_mesh(mesh, path, FileOptions{.element = std::string(element)});
}

std::uint64_t find_label(const Mesh& mesh, std::string_view text) {
  return mw::api::guarded([&] {
    return mw::engine::find_label(text, mw::api::io_names(mesh.names), mesh.labels_are_signed);
  });
}

Wedges wedges(const Mesh& mesh) {
  return mw::api::guarded([&] {
    mw::io::GroupedSink sink(mw::io::scratch_folder(), nullptr);
    mw::api::deliver(mesh, sink);
    mw::io::GroupedMesh& grouped = sink.mesh();
    Wedges out;
    for (const mw::io::WedgeGroup& group : grouped.wedge_groups()) {
      for (std::uint64_t w = group.wedges.begin; w < group.wedges.end; ++w) {
        const auto& [bottom, top, under, above] = grouped.wedge(w);
        out.rows.push_back({bottom[0], bottom[1], bottom[2], top[0], top[1], top[2]});
        out.labels.push_back({grouped.table().raw(group.bottom), grouped.table().raw(group.top)});
      }
    }
    return out;
  });
}

std::string picture(const Mesh& mesh, int width, int height) {
  return mw::api::guarded([&] {
    mw::picture::check_sides(width, height);
    mw::io::GroupedSink sink(mw::io::scratch_folder(), nullptr);
    mw::api::deliver(mesh, sink);
    mw::io::GroupedMesh& grouped = sink.mesh();
    std::vector<bool> shown(grouped.table().size(), true);
    if (const auto around = mw::picture::surrounding_label(grouped)) shown[*around] = false;
    mw::picture::MeshScene scene(grouped, std::move(shown), grouped.names());
    std::string png;
    mw::picture::draw(scene,
                      {.width = width, .height = height, .view = mw::picture::default_view({})},
                      [&](std::span<const std::byte> bytes) {
                        png.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
                      });
    return png;
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
