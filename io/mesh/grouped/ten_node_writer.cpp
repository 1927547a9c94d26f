// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tets of ten nodes into sinks that know them.
#include "io/mesh/grouped/ten_node_writer.h"

#include <algorithm>

namespace mw::io {
namespace {

constexpr std::uint64_t kBatchRows = 4096;

void write_nodes(GroupedMesh& mesh, MeshSink& sink) {
  std::vector<Position> batch;
  for (std::uint64_t at = 0; at < mesh.node_count(); at += batch.size()) {
    batch.resize(std::min(kBatchRows, mesh.node_count() - at));
    for (std::size_t i = 0; i < batch.size(); ++i) batch[i] = mesh.node(at + i);
    sink.write_vertices(batch);
  }
}

void write_cells(GroupedMesh& mesh, Label rank, TenNodeSink& sink) {
  const RowRange range = mesh.label_tets()[rank];
  std::vector<TenRows> batch;
  std::vector<RawLabel> labels;
  for (std::uint64_t at = range.begin; at < range.end; at += batch.size()) {
    batch.resize(std::min(kBatchRows, range.end - at));
    labels.assign(batch.size(), mesh.table().raw(rank));
    for (std::size_t i = 0; i < batch.size(); ++i) batch[i] = ten_rows(mesh, at + i);
    sink.write_ten_nodes(batch, labels);
  }
}

}  // namespace

TenRows ten_rows(GroupedMesh& mesh, std::uint64_t tet) {
  TenRows out{};
  const TetRows corners = mesh.tet(tet);
  const std::array<std::uint64_t, 6> middles = mesh.middles(tet);
  std::copy(corners.begin(), corners.end(), out.begin());
  std::copy(middles.begin(), middles.end(), out.begin() + corners.size());
  return out;
}

void TenNodeWriter::write(GroupedMesh& mesh) {
  sink_->begin(mesh.header());
  write_nodes(mesh, *sink_);
  for (Label rank = 0; rank < mesh.table().size(); ++rank) write_cells(mesh, rank, *sink_);
  sink_->finish();
}

}  // namespace mw::io
