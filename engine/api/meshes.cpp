// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Meshes in memory, their columns, files and digests.
#include <algorithm>
#include <cstring>

#include "engine/api/asked.h"
#include "engine/api/errors.h"
#include "engine/api/mesh_file.h"
#include "engine/picture/draw.h"
#include "engine/settings/named_labels.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/mesh/digest.h"
#include "io/mesh/field_names.h"
#include "io/mesh/grouped/grouped_sink.h"
#include "io/mesh/open_mesh.h"
#include "io/names/read_names.h"

void mw_mesh::settle() {
  record = mw::io::record_text(data.record);
  names = mw::api::name_rows(data.names);
  std::ranges::sort(data.values, {}, &mw::io::TetValues::name);
}

namespace mw::api {
namespace {

/// Writes points, tets and values in batches, between which a sink may ask whether to go on.
void write_rows(const io::MeshData& mesh, bool values, io::MeshSink& sink) {
  constexpr std::size_t kBatch = 1 << 16;  // a multiple of the parts of a curved tet
  const std::span points(mesh.vertices);
  for (std::size_t at = 0; at < points.size(); at += kBatch) {
    sink.write_vertices(points.subspan(at, std::min(kBatch, points.size() - at)));
  }
  const std::span tets(mesh.tets);
  const std::span labels(mesh.labels);
  std::vector<double> rows;
  for (std::size_t at = 0; at < tets.size(); at += kBatch) {
    const std::size_t count = std::min(kBatch, tets.size() - at);
    sink.write_tets(tets.subspan(at, count), labels.subspan(at, count));
    if (!values) continue;
    rows.clear();
    for (std::size_t t = at; t < at + count; ++t) {
      for (const io::TetValues& column : mesh.values) rows.push_back(column.numbers[t]);
    }
    sink.write_values(rows);
  }
}

/// Fills the columns of wedges.
void find_wedges(const mw_mesh& mesh) {
  io::GroupedSink sink(io::scratch_folder(), nullptr);
  deliver(mesh, sink);
  io::GroupedMesh& grouped = sink.mesh();
  for (const io::WedgeGroup& group : grouped.wedge_groups()) {
    for (std::uint64_t w = group.wedges.begin; w < group.wedges.end; ++w) {
      const auto& [bottom, top, under, above] = grouped.wedge(w);
      mesh.wedges.insert(mesh.wedges.end(), bottom.begin(), bottom.end());
      mesh.wedges.insert(mesh.wedges.end(), top.begin(), top.end());
      mesh.wedge_labels.push_back(grouped.table().raw(group.bottom));
      mesh.wedge_labels.push_back(grouped.table().raw(group.top));
    }
  }
}

mw_column column_of_wedges(const mw_mesh& mesh, bool is_labels) {
  const std::lock_guard lock(mesh.wedges_mutex);
  if (!mesh.has_wedges) {
    mesh.wedges.clear();
    mesh.wedge_labels.clear();
    find_wedges(mesh);
    mesh.has_wedges = true;
  }
  const std::size_t width = is_labels ? 2 : 6;
  const std::vector<std::uint64_t>& column = is_labels ? mesh.wedge_labels : mesh.wedges;
  return {.data = column.data(), .rows = column.size() / width, .width = width, .type = MW_U64};
}

mw_column column_of(const mw_mesh& mesh, const std::string& name) {
  const io::MeshData& data = mesh.data;
  if (name == "points") {
    return {.data = data.vertices.data(), .rows = data.vertices.size(), .width = 3, .type = MW_F64};
  }
  if (name == "tets") {
    return {.data = data.tets.data(), .rows = data.tets.size(), .width = 4, .type = MW_U64};
  }
  const mw_type label_type = data.labels_signed ? MW_I64 : MW_U64;
  if (name == "labels") {
    return {.data = data.labels.data(), .rows = data.labels.size(), .width = 1, .type = label_type};
  }
  if (name == "wedges") return column_of_wedges(mesh, false);
  if (name != "wedge_labels") {
    io::fail_usage("column ", name, ": expected points, tets, labels, wedges or wedge_labels");
  }
  mw_column out = column_of_wedges(mesh, true);
  out.type = label_type;
  return out;
}

std::string picture_of(const mw_mesh& mesh, int width, int height) {
  picture::check_sides(width, height);
  io::GroupedSink sink(io::scratch_folder(), nullptr);
  deliver(mesh, sink);
  io::GroupedMesh& grouped = sink.mesh();
  std::vector<bool> shown(grouped.table().size(), true);
  if (const auto around = picture::surrounding_label(grouped)) shown[*around] = false;
  picture::Legend legend = picture::legend_of(grouped, shown, grouped.names());
  picture::MeshScene scene(grouped, std::move(shown), grouped.names());
  std::string png;
  picture::draw(scene,
                {.width = width,
                 .height = height,
                 .view = picture::default_view({}),
                 .legend = std::move(legend)},
                [&](std::span<const std::byte> bytes) {
                  png.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
                });
  return png;
}

/// ERRORS: mw::Error(kUsage) for a tet that names a point which is not there.
void check_rows(const io::MeshData& mesh) {
  for (const io::TetRows& tet : mesh.tets) {
    for (const std::uint64_t row : tet) {
      if (row < mesh.vertices.size()) continue;
      io::fail_usage("mesh: a tet names point ", row, " of ", mesh.vertices.size());
    }
  }
}

}  // namespace

void deliver(const mw_mesh& mesh, io::MeshSink& sink, bool values) {
  const io::MeshData& data = mesh.data;
  io::MeshHeader header{.tets = data.tets.size(),
                        .labels_signed = data.labels_signed,
                        .names = data.names,
                        .record = data.record};
  header.in_parts = data.in_parts;
  if (values) {
    for (const io::TetValues& column : data.values) header.values.push_back(column.name);
    header.values = io::value_names(header.values);
  }
  sink.begin(header);
  write_rows(data, !header.values.empty(), sink);
  sink.finish();
}

std::unique_ptr<io::MeshSink> open_file(const std::filesystem::path& path,
                                        const request::MeshRequest& request, bool has_values) {
  io::MeshExtras extras = request.extras;
  extras.wedges = request.job.connect.cohesive.any();
  if (!extras.materials && has_values) io::require_place_for_values(path);
  auto sink = io::open_mesh_sink(path, request.element, extras);
  if (extras.materials && !request.write_values && io::why_no_values(path).empty()) {
    io::fail_usage("values: ", path.string(),
                   " has values of tets where it has materials; write them, too, or give an .inp, "
                   "which has materials alone");
  }
  return sink;
}

}  // namespace mw::api

namespace api = mw::api;
namespace io = mw::io;

mw_mesh* mw_mesh_read(const char* path, mw_error** error) {
  return api::made(error, [&] {
    api::require(path, "path");
    auto mesh = std::make_unique<mw_mesh>();
    mesh->data = io::read_mesh(path);
    mesh->settle();
    return mesh.release();
  });
}

mw_mesh* mw_mesh_of_arrays(const double* points, size_t point_count, const uint64_t* tets,
                           const uint64_t* labels, size_t tet_count, int is_signed,
                           mw_error** error) {
  return api::made(error, [&] {
    if (point_count > 0) api::require(points, "points");
    if (tet_count > 0) api::require(tets, "tets");
    if (tet_count > 0) api::require(labels, "labels");
    auto mesh = std::make_unique<mw_mesh>();
    io::MeshData& data = mesh->data;
    data.vertices.resize(point_count);
    data.tets.resize(tet_count);
    if (point_count > 0)
      std::memcpy(data.vertices.data(), points, point_count * sizeof data.vertices[0]);
    if (tet_count > 0) std::memcpy(data.tets.data(), tets, tet_count * sizeof data.tets[0]);
    data.labels.assign(labels, labels + tet_count);
    data.labels_signed = is_signed != 0;
    api::check_rows(data);
    mesh->settle();
    return mesh.release();
  });
}

void mw_mesh_free(mw_mesh* mesh) {
  delete mesh;
}

mw_status mw_mesh_column(const mw_mesh* mesh, const char* name, mw_column* column,
                         mw_error** error) {
  return api::tried(error, [&] {
    api::require(mesh, "mesh");
    api::require(name, "name");
    api::require(column, "column");
    *column = api::column_of(*mesh, name);
  });
}

size_t mw_mesh_value_count(const mw_mesh* mesh) {
  return mesh->data.values.size();
}

const char* mw_mesh_values(const mw_mesh* mesh, size_t index, mw_column* column) {
  const io::TetValues& values = mesh->data.values[index];
  *column = {
      .data = values.numbers.data(), .rows = values.numbers.size(), .width = 1, .type = MW_F64};
  return values.name.c_str();
}

mw_status mw_mesh_set_values(mw_mesh* mesh, const char* name, const double* numbers, size_t count,
                             mw_error** error) {
  return api::tried(error, [&] {
    api::require(mesh, "mesh");
    api::require(name, "name");
    if (count != mesh->data.tets.size()) {
      io::fail_usage("values: there must be one number a tet");
    }
    if (count > 0) api::require(numbers, "numbers");
    std::vector<io::TetValues>& all = mesh->data.values;
    const std::vector<double> column(numbers, numbers + count);
    const auto at = std::ranges::lower_bound(all, name, {}, &io::TetValues::name);
    if (at != all.end() && at->name == name) {
      at->numbers = column;
    } else {
      all.insert(at, {name, column});
    }
  });
}

size_t mw_mesh_names(const mw_mesh* mesh, const mw_name** names) {
  *names = mesh->names.data();
  return mesh->names.size();
}

mw_status mw_mesh_set_names(mw_mesh* mesh, const mw_name* names, size_t count, mw_error** error) {
  return api::tried(error, [&] {
    api::require(mesh, "mesh");
    mesh->data.names = api::label_names(names, count);
    mesh->settle();
  });
}

mw_status mw_mesh_read_names(mw_mesh* mesh, const char* path, mw_error** error) {
  return api::tried(error, [&] {
    api::require(mesh, "mesh");
    api::require(path, "path");
    mesh->data.names = mesh->data.names.merged_with(io::read_names(path));
    mesh->settle();
  });
}

const char* mw_mesh_text(const mw_mesh* mesh, const char* name) {
  if (std::strcmp(name, "report") == 0) return mesh->report.c_str();
  return std::strcmp(name, "record") == 0 ? mesh->record.c_str() : nullptr;
}

int mw_mesh_is_in_parts(const mw_mesh* mesh) {
  return mesh->data.in_parts ? 1 : 0;
}

mw_status mw_mesh_set_record(mw_mesh* mesh, const char* record, int in_parts, mw_error** error) {
  return api::tried(error, [&] {
    api::require(mesh, "mesh");
    api::require(record, "record");
    if (in_parts != 0 && mesh->data.tets.size() % mw::kTetParts.size() != 0) {
      io::fail_usage("mesh: in_parts needs eight tets for each curved one, and there are ",
                     mesh->data.tets.size());
    }
    mesh->data.record = io::parse_record(record, "mesh");
    mesh->data.in_parts = in_parts != 0;
    mesh->settle();
  });
}

mw_status mw_mesh_find_label(const mw_mesh* mesh, const char* text, uint64_t* label,
                             mw_error** error) {
  return api::tried(error, [&] {
    api::require(mesh, "mesh");
    api::require(text, "text");
    api::require(label, "label");
    *label = mw::engine::find_label(text, mesh->data.names, mesh->data.labels_signed);
  });
}

mw_status mw_mesh_write(const mw_mesh* mesh, const char* path, const mw_options* options,
                        mw_error** error) {
  return api::tried(error, [&] {
    api::require(mesh, "mesh");
    api::require(path, "path");
    api::Asked asked(options);
    const mw::request::MeshRequest& request = asked.request();
    const bool has_values = request.write_values && !mesh->data.values.empty();
    // Materials are made of values, also in a file that has no place for these.
    const bool needs_values = request.write_values || request.extras.materials.has_value();
    api::deliver(*mesh, *api::open_file(path, request, has_values), needs_values);
  });
}

char* mw_mesh_digest(const mw_mesh* mesh, mw_error** error) {
  return api::made(error, [&] {
    api::require(mesh, "mesh");
    io::DigestSink sink(io::scratch_folder());
    api::deliver(*mesh, sink);
    return api::text_of(sink.digest());
  });
}

char* mw_mesh_picture(const mw_mesh* mesh, int width, int height, size_t* bytes, mw_error** error) {
  return api::made(error, [&] {
    api::require(mesh, "mesh");
    api::require(bytes, "bytes");
    const std::string png = api::picture_of(*mesh, width, height);
    *bytes = png.size();
    return api::text_of(png);
  });
}
