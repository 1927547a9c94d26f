// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads and writes tetrahedral .vtu files.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "io/file/sink/atomic_file.h"
#include "io/file/source/byte_source.h"
#include "io/mesh/columns.h"
#include "io/mesh/mesh_data.h"
#include "io/mesh/vtu/vtu_layout.h"

namespace mw::io {

/// Reads a mesh, with its pieces one after the other.  Tets with ten nodes are read by their
/// corners, without the middles of edges; curved ones become kTetParts.  The label is the cell
/// array `label`, else `Label`, `labels`, `material` or `medit:ref`, else the only integer cell
/// array.  Cell arrays of floats with one component are values (value_names()).
/// ERRORS: mw::Error(kInput) with file and place when truncated or corrupt, for cells that are not
/// tetrahedra, without label, or when a row does not exist.
[[nodiscard]] MeshData read_vtu(const ByteSource& source);

/// A mesh that is part of another.
struct VtuPiece {
  MeshData mesh;
  std::vector<std::uint64_t> ids;  ///< PointData/GlobalNodeIds: its vertices in the whole mesh
};

/// Reads a piece.  ERRORS: those of read_vtu(); also without ids, or with tets of ten nodes.
[[nodiscard]] VtuPiece read_vtu_piece(const ByteSource& source);

/// Writes a .vtu file.  Cost: the buffers of MeshColumns; every number is copied once.
class VtuSink : public ColumnSink {
 public:
  explicit VtuSink(const std::filesystem::path& path, Element element = Element::kTet4)
      : ColumnSink(element), name_(path.string()), file_(path) {}

  void begin(const MeshHeader& header) override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return 3 << 20; }

 private:
  std::string name_;
  AtomicFile file_;
};

}  // namespace mw::io
