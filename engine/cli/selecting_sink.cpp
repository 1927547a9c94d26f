// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Leaves labels out of the written mesh.
#include "engine/cli/selecting_sink.h"

#include "io/mesh/open_mesh.h"

namespace mw::cli {

void SelectingSink::begin(const io::MeshHeader& header) {
  mesh_.labels_signed = header.labels_signed;
  mesh_.vertices.reserve(header.vertices);
}

void SelectingSink::write_vertices(std::span<const io::Position> positions) {
  mesh_.vertices.insert(mesh_.vertices.end(), positions.begin(), positions.end());
}

void SelectingSink::write_tets(std::span<const io::TetRows> tets,
                               std::span<const RawLabel> labels) {
  for (std::size_t i = 0; i < tets.size(); ++i) {
    if (!wanted_(labels[i])) continue;
    mesh_.tets.push_back(tets[i]);
    mesh_.labels.push_back(labels[i]);
  }
}

void SelectingSink::finish() {
  drop_unused_vertices();
  io::write_mesh(mesh_, *next_);
}

void SelectingSink::drop_unused_vertices() {
  std::vector<std::uint64_t> row(mesh_.vertices.size(), 0);
  for (const io::TetRows& tet : mesh_.tets) {
    for (const std::uint64_t v : tet) row[v] = 1;
  }
  std::uint64_t kept = 0;
  for (std::size_t v = 0; v < row.size(); ++v) {
    if (row[v] == 0) continue;
    mesh_.vertices[kept] = mesh_.vertices[v];
    row[v] = kept++;
  }
  mesh_.vertices.resize(kept);
  for (io::TetRows& tet : mesh_.tets) {
    for (std::uint64_t& v : tet) v = row[v];
  }
}

}  // namespace mw::cli
