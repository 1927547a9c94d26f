// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/scratch_mesh.h"

#include "kernels/core/assert.h"

namespace mw::io {

ScratchMesh::ScratchMesh(const std::filesystem::path& folder)
    : folder_(folder), positions_(folder), tets_(folder), labels_(folder), values_(folder) {}

std::array<Position, 4> ScratchMesh::corners(const TetRows& tet) {
  std::array<Position, 4> out{};
  for (std::size_t i = 0; i < tet.size(); ++i) {
    if (tet[i] >= vertex_count()) {
      throw Error(ErrorKind::kInput, text("a tet names vertex ", tet[i], " of ", vertex_count()));
    }
    out[i] = vertex(tet[i]);
  }
  return out;
}

void ScratchMesh::add_vertices(std::span<const Position> positions) {
  for (const Position& p : positions) positions_.append(p);
}

void ScratchMesh::add_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size());
  tets_.append(std::as_bytes(tets));
  labels_.append(std::as_bytes(labels));
}

void ScratchMesh::add_values(std::span<const double> rows) {
  values_.append(std::as_bytes(rows));
}

void ScratchMesh::replace_values(
    std::vector<std::string> names,
    const std::function<void(const TetBatch&, std::vector<double>& rows)>& add_rows) {
  ScratchFile values(folder_);
  std::vector<double> rows;
  each_tet_batch([&](const TetBatch& batch) {
    rows.clear();
    add_rows(batch, rows);
    values.append(std::as_bytes(std::span(rows)));
  });
  header_.values = std::move(names);
  values_ = std::move(values);
}

void ScratchMesh::drop_values() {
  header_.values.clear();
  values_ = ScratchFile(folder_);
}

void ScratchMesh::each_tet_batch(const std::function<void(const TetBatch&)>& visit) {
  std::vector<TetRows> tets;
  std::vector<RawLabel> labels;
  std::vector<double> values;
  const std::size_t width = header_.values.size();
  for (std::uint64_t first = 0; first < tet_count(); first += tets.size()) {
    const std::size_t count = std::min<std::uint64_t>(kBatchTets, tet_count() - first);
    tets.resize(count);
    labels.resize(count);
    values.resize(count * width);
    tets_.read_at(first * sizeof(TetRows), std::as_writable_bytes(std::span(tets)));
    labels_.read_at(first * sizeof(RawLabel), std::as_writable_bytes(std::span(labels)));
    values_.read_at(first * width * sizeof(double), std::as_writable_bytes(std::span(values)));
    visit({first, tets, labels, values});
  }
}

void ScratchMesh::copy_to(MeshSink& sink, const std::function<void()>& between) {
  sink.begin(header_);
  each_vertex_batch([&](std::span<const Position> batch) {
    between();
    sink.write_vertices(batch);
  });
  each_tet_batch([&](const TetBatch& batch) {
    between();
    sink.write_tets(batch.tets, batch.labels);
    if (!header_.values.empty()) sink.write_values(batch.values);
  });
  sink.finish();
}

void ScratchMeshSink::finish() {
  check_sink_counts("mesh", mesh_.header(), mesh_.tet_count());
  complete_();
}

}  // namespace mw::io
