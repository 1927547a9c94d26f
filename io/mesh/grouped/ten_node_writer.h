// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tets of ten nodes into sinks that know them.
#pragma once

#include <memory>

#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

using TenRows = std::array<std::uint64_t, 10>;  ///< corners, then the middles of kTetEdges

/// A sink that writes tets of one kind or the other.
class TenNodeSink : public MeshSink {
 public:
  /// In the place of write_tets().  REQUIRES: as that; the sink was made for kTet10.
  virtual void write_ten_nodes(std::span<const TenRows> tets, std::span<const RawLabel> labels) = 0;
};

/// The corners of a tet and the middles of its edges.
[[nodiscard]] TenRows ten_rows(GroupedMesh& mesh, std::uint64_t tet);

/// Streams a grouped mesh of kTet10 into such a sink.
class TenNodeWriter : public GroupedWriter {
 public:
  explicit TenNodeWriter(std::unique_ptr<TenNodeSink> sink) : sink_(std::move(sink)) {}
  void write(GroupedMesh& mesh) override;

 private:
  std::unique_ptr<TenNodeSink> sink_;
};

}  // namespace mw::io
