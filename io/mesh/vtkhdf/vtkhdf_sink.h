// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into a .vtkhdf file, of one process or of several that write it together.
#pragma once

#include <filesystem>
#include <optional>

#include "io/file/sink/partial_file.h"
#include "io/mesh/element.h"
#include "io/mesh/grouped/ten_node_writer.h"
#include "io/mesh/shared_mesh.h"
#include "io/mesh/vtkhdf/hdf5_output.h"

namespace mw::io {

/// Addresses of the columns.
struct VtkhdfPlaces {
  std::uint64_t connectivity = 0;
  std::uint64_t offsets = 0;
  std::uint64_t types = 0;
  std::uint64_t labels = 0;
  std::uint64_t points = 0;  ///< behind all others: still to be reserved
};

/// The first rooms of a file.
[[nodiscard]] VtkhdfPlaces place_vtkhdf(Hdf5Rooms& rooms, Element element, std::uint64_t tets);

/// Writes rows, from any on.  Cost: 3 MiB of buffers.  ERRORS: as the output.
class VtkhdfColumns {
 public:
  VtkhdfColumns() = default;
  /// output outlives it.
  VtkhdfColumns(PlacedOutput& output, const VtkhdfPlaces& places, Element element);

  /// Before the first rows, too.  With tet 0 goes the first of the offsets, which there is even
  /// without tets.
  void go_to(const RowPlace& place);
  void write_vertices(std::span<const Position> positions);
  /// rows: of node_count(element).
  void write_cell(std::span<const std::uint64_t> rows, RawLabel label);
  /// REQUIRES: tets.size() == labels.size(); made for kTet4.
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels);
  void flush();

  /// The next rows.
  [[nodiscard]] const RowPlace& place() const { return place_; }

 private:
  using Column = Hdf5Column<std::uint64_t>;

  Element element_ = Element::kTet4;
  RowPlace place_;
  Column connectivity_;
  Column offsets_;
  Hdf5Column<std::uint8_t> types_;
  Column labels_;
  Hdf5Column<double> points_;
};

/// Writes all that tells of the columns, and gives the file its name.
/// REQUIRES: all rows are in the file, and the points' room is reserved.
void commit_vtkhdf(Hdf5Output& output, const VtkhdfPlaces& places, Element element,
                   const MeshHeader& header, std::uint64_t vertices);

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

/// The bytes of VtkhdfSink: its columns are in one piece each, so that every row has a place that
/// all processes know once tets and vertices are counted.  Tets of four nodes.
class VtkhdfShared : public SharedMesh {
 public:
  /// Touches no file.
  explicit VtkhdfShared(std::filesystem::path path) : path_(std::move(path)) {}

  void create() override;
  [[nodiscard]] std::string place() const override { return partial_.string(); }
  void join(const std::string& place) override;
  void lay_out(const MeshHeader& header, std::uint64_t vertices) override;
  void begin(std::uint64_t tets) override;
  void go_to(const RowPlace& rows) override { columns_.go_to(rows); }
  void write_vertices(std::span<const Position> positions) override {
    columns_.write_vertices(positions);
  }
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override {
    columns_.write_tets(tets, labels);
  }
  void sync() override;
  void finish() override;
  [[nodiscard]] std::uint64_t buffer_bytes() const override { return 4 << 20; }

 private:
  std::filesystem::path path_;
  std::optional<Hdf5Output> made_;  ///< by the maker
  MeshHeader header_;               ///< the maker's
  std::uint64_t vertices_ = 0;      ///< the maker's
  std::filesystem::path partial_;
  std::optional<JoinedPartial> part_;  ///< what rows are written through
  VtkhdfColumns columns_;
};

}  // namespace mw::io
