// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A sink that passes one mesh on to two sinks.
#pragma once

#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// Passes everything on to both sinks.  REQUIRES: they outlive it.
class TeeSink : public MeshSink {
 public:
  TeeSink(MeshSink& first, MeshSink& second) : first_(first), second_(second) {}

  void begin(const MeshHeader& header) override {
    first_.begin(header);
    second_.begin(header);
  }
  void write_vertices(std::span<const Position> positions) override {
    first_.write_vertices(positions);
    second_.write_vertices(positions);
  }
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override {
    first_.write_tets(tets, labels);
    second_.write_tets(tets, labels);
  }
  void write_values(std::span<const double> rows) override {
    first_.write_values(rows);
    second_.write_values(rows);
  }
  void finish() override {
    first_.finish();
    second_.finish();
  }
  [[nodiscard]] std::uint64_t buffer_bytes() const override {
    return first_.buffer_bytes() + second_.buffer_bytes();
  }

 private:
  MeshSink& first_;
  MeshSink& second_;
};

}  // namespace mw::io
