// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Area and bends of interfaces of a mesh that streams by.
#pragma once

#include "io/file/scratch/external_sort.h"
#include "io/file/scratch/scratch_file.h"
#include "io/mesh/mesh_sink.h"
#include "kernels/audit/shape/shape.h"

namespace mw::cli {

/// Measures any mesh whose tets come after their vertices, in double.
/// Memory: 40 MiB, whatever the mesh; what does not fit waits in temporary files in `folder`: 24
/// bytes a vertex, 128 a tet and 120 an interface triangle.  ERRORS: see ScratchFile; kInput when a
/// tet names a vertex that has not come.
class ShapeSink : public io::NoSink {
 public:
  explicit ShapeSink(const std::filesystem::path& folder);

  void write_vertices(std::span<const io::Position> positions) override;
  void write_tets(std::span<const io::TetRows> tets, std::span<const RawLabel> labels) override;

  /// Sorts and measures.  REQUIRES: finished; called once.
  [[nodiscard]] audit::ShapeReport shape();

 private:
  static constexpr std::size_t kSortBytes = 8 << 20;

  void add_tet(const io::TetRows& tet, RawLabel label);

  std::filesystem::path folder_;
  io::PagedFile<io::Position> positions_;
  /// Three ascending rows of a triangle, and the label of its tet.  The last row is doubled, and
  /// odd when the triangle's normal points out of the tet.
  io::ExternalSort<4> faces_;
};

}  // namespace mw::cli
