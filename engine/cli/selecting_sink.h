// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Leaves labels out of the written mesh (--labels, --background).
#pragma once

#include <functional>

#include "io/mesh/mesh_data.h"

namespace mw::cli {

/// Passes on the tets of the wanted labels and the vertices they use, in the order received.
/// Holds the mesh until finish(), since the counts are known only then.
class SelectingSink : public io::MeshSink {
 public:
  using Wanted = std::function<bool(RawLabel)>;

  SelectingSink(io::MeshSink& next, Wanted wanted) : next_(&next), wanted_(std::move(wanted)) {}
  void begin(const io::MeshHeader& header) override;
  void write_vertices(std::span<const io::Position> positions) override;
  void write_tets(std::span<const io::TetRows> tets, std::span<const RawLabel> labels) override;
  void finish() override;
  /// What has been passed on.
  [[nodiscard]] const io::MeshData& mesh() const { return mesh_; }

 private:
  void drop_unused_vertices();

  io::MeshSink* next_;
  Wanted wanted_;
  io::MeshData mesh_;
};

}  // namespace mw::cli
