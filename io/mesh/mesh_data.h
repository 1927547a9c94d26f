// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A whole mesh in memory, as verify, digest, info and convert read it.
#pragma once

#include <algorithm>
#include <vector>

#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// A number for each tet, NaN where it is unknown.
struct TetValues {
  std::string name;  ///< see MeshHeader::values
  std::vector<double> numbers;
};

/// Vertices by row, tets as rows of vertices, and a raw label for each tet.
struct MeshData {
  std::vector<Position> vertices;
  std::vector<TetRows> tets;
  std::vector<RawLabel> labels;
  bool labels_signed = false;
  LabelNames names;
  MeshRecord record;
  std::vector<TetValues> values;
  bool in_parts = false;   ///< see MeshHeader
  bool ten_nodes = false;  ///< see MeshHeader
};

/// Writes the tets of a mesh, in batches with their values where they have some.
inline void write_tets(const MeshData& mesh, MeshSink& sink) {
  if (mesh.values.empty()) return sink.write_tets(mesh.tets, mesh.labels);
  constexpr std::size_t kBatchRows = 4096;
  std::vector<double> rows;
  for (std::size_t at = 0; at < mesh.tets.size(); at += kBatchRows) {
    const std::size_t count = std::min(kBatchRows, mesh.tets.size() - at);
    sink.write_tets(std::span(mesh.tets).subspan(at, count),
                    std::span(mesh.labels).subspan(at, count));
    rows.clear();
    for (std::size_t t = at; t < at + count; ++t) {
      for (const TetValues& column : mesh.values) rows.push_back(column.numbers[t]);
    }
    sink.write_values(rows);
  }
}

/// Writes a whole mesh, from begin() to finish().
inline void write_mesh(const MeshData& mesh, MeshSink& sink) {
  MeshHeader header{.tets = mesh.tets.size(),
                    .labels_signed = mesh.labels_signed,
                    .names = mesh.names,
                    .record = mesh.record,
                    .in_parts = mesh.in_parts,
                    .ten_nodes = mesh.ten_nodes};
  for (const TetValues& column : mesh.values) header.values.push_back(column.name);
  sink.begin(header);
  sink.write_vertices(mesh.vertices);
  write_tets(mesh, sink);
  sink.finish();
}

/// Collects a mesh in memory.
class MeshDataSink : public MeshSink {
 public:
  void begin(const MeshHeader& header) override {
    mesh_.labels_signed = header.labels_signed;
    mesh_.names = header.names;
    mesh_.record = header.record;
    mesh_.in_parts = header.in_parts;
    mesh_.ten_nodes = header.ten_nodes;
    for (const std::string& name : header.values) mesh_.values.push_back({name, {}});
    mesh_.tets.reserve(header.tets);
    mesh_.labels.reserve(header.tets);
  }
  void write_vertices(std::span<const Position> positions) override {
    mesh_.vertices.insert(mesh_.vertices.end(), positions.begin(), positions.end());
  }
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override {
    mesh_.tets.insert(mesh_.tets.end(), tets.begin(), tets.end());
    mesh_.labels.insert(mesh_.labels.end(), labels.begin(), labels.end());
  }
  void write_values(std::span<const double> rows) override {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      mesh_.values[i % mesh_.values.size()].numbers.push_back(rows[i]);
    }
  }
  void finish() override {}

  [[nodiscard]] MeshData& mesh() { return mesh_; }

 private:
  MeshData mesh_;
};

}  // namespace mw::io
