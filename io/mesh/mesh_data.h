// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A whole mesh in memory, as verify, digest, info and convert read it.
#pragma once

#include <vector>

#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// Vertices by row, tets by vertex rows, one raw label a tet.
struct MeshData {
  std::vector<Position> vertices;
  std::vector<TetRows> tets;
  std::vector<RawLabel> labels;
  bool labels_signed = false;
  LabelNames names;
  MeshRecord record;
};

/// Writes all of a mesh: begin to finish.
inline void write_mesh(const MeshData& mesh, MeshSink& sink) {
  sink.begin({.tets = mesh.tets.size(),
              .labels_signed = mesh.labels_signed,
              .names = mesh.names,
              .record = mesh.record});
  sink.write_vertices(mesh.vertices);
  sink.write_tets(mesh.tets, mesh.labels);
  sink.finish();
}

/// Collects a mesh.
class MeshDataSink : public MeshSink {
 public:
  void begin(const MeshHeader& header) override {
    mesh_.labels_signed = header.labels_signed;
    mesh_.names = header.names;
    mesh_.record = header.record;
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
  void finish() override {}

  [[nodiscard]] MeshData& mesh() { return mesh_; }

 private:
  MeshData mesh_;
};

}  // namespace mw::io
