// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A sink that makes a grouped mesh of a stream of tets.
#pragma once

#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

class MeshGrouping;

/// Collects a mesh; finish() groups it and calls the writer.
/// Memory: 64 MiB, 96 with kTet10, 128 with kCurvedTet10, whatever the mesh; the rest waits in
/// temporary files in `folder`, at most some 400 bytes a tet (1,000 with kTet10, 1,300 with curved
/// ones).
/// ERRORS: see MeshSink; kInput when a tet names a vertex that never came, or three tets share a
/// triangle, which then bounds nothing; begin() throws kUsage where kCurvedTet10 is asked of a mesh
/// with doubled vertices.
class GroupedSink : public MeshSink {
 public:
  /// writer may be empty where the caller takes the mesh.  REQUIRES: folder exists.
  GroupedSink(const std::filesystem::path& folder, std::unique_ptr<GroupedWriter> writer,
              Element element = Element::kTet4);
  ~GroupedSink() override;

  void begin(const MeshHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  void write_values(std::span<const double> rows) override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override;

  /// REQUIRES: finished.
  [[nodiscard]] GroupedMesh& mesh();

 private:
  std::unique_ptr<MeshGrouping> grouping_;
  std::unique_ptr<GroupedWriter> writer_;
  Element element_;
};

}  // namespace mw::io
