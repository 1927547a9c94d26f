// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into a .vtkhdf file.
#pragma once

#include <filesystem>

#include "io/mesh/grouped/ten_node_writer.h"
#include "io/mesh/vtkhdf/vtkhdf_columns.h"

namespace mw::io {

/// VTKHDF 1.0, one UnstructuredGrid of one partition, which VTK 9.1 and ParaView 5.11 read:
///   /VTKHDF              attributes Version = (1, 0), Type = "UnstructuredGrid"
///     NumberOfPoints, NumberOfCells, NumberOfConnectivityIds   Int64, 1 element
///     Points             Float64 [vertices][3]
///     Connectivity       Int64 [4 tets]; of ten nodes [10 tets], those behind the corners the
///                        middles of kTetEdges
///     Offsets            Int64 [tets + 1]
///     Types              UInt8 [tets], all 10; of ten nodes 24
///     CellData/label     UInt64 or Int64 [tets]
///     FieldData          names of labels, where there are any, as in /mwmesh (vtkhdf_names.h)
/// No time stamps: equal meshes are equal bytes.
/// Cost: 4 MiB of buffers.  Thread safety: none.
class VtkhdfSink : public TenNodeSink {
 public:
  explicit VtkhdfSink(const std::filesystem::path& path, Element element = Element::kTet4)
      : output_(path), element_(element) {}

  void begin(const MeshHeader& header) override;
  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  void write_ten_nodes(std::span<const TenRows> tets, std::span<const RawLabel> labels) override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return 4 << 20; }

 private:
  [[nodiscard]] bool has_room(std::size_t tets) const;

  Hdf5Output output_;
  Element element_;
  MeshHeader header_;
  VtkhdfPlaces places_;
  VtkhdfColumns columns_;
};

}  // namespace mw::io
