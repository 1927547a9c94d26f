// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tetrahedral .vtkhdf files: in; out, by one process or by several that write together.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/file/sink/partial_file.h"
#include "io/hdf5/hdf5_file.h"
#include "io/mesh/element.h"
#include "io/mesh/field_names.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/mesh_sink.h"
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
///     FieldData          names of labels, where there are any, as in /mwmesh (add_vtkhdf_facts())
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

/// VTKHDF of type UnstructuredGrid, version 1 or 2 (one time step); partitions are put one after
/// the other.  The label is the cell array `label`, else `Label`, `labels`, `material` or
/// `medit:ref`, else the only integer cell array.
/// The HDF5 library reads in a child process: damaged files crash it.
/// Of tets with ten nodes the corners are read; the middles of edges go.
/// Memory: batches of 65,536 rows, whatever the size of the mesh; of one with ten-node tets a
/// quarter of a byte a node as well.
/// ERRORS: mw::Error(kInput) with file and place when truncated or corrupt, for cells that are not
/// tetrahedra, without label, or when a row does not exist; what the sink throws.
void read_vtkhdf(const std::filesystem::path& path, MeshSink& sink);

/// Writes what VTK reads, in a group FieldData of `grid`: the arrays of field_names.h.  Strings
/// have a variable length and are declared ASCII, though they are UTF-8: VTK 9.1 reads no others.
/// What we read: the numbers there, and in `file` the names once more, `mwmesh/label_name`, bytes
/// with a NUL behind each.  The HDF5 library does not survive damaged strings of variable length.
/// Nothing without names.  The record is `mwmesh/record`, bytes too.
/// ENSURES: file and grid have the groups that there are.  ERRORS: as Hdf5Output.
void add_vtkhdf_facts(Hdf5Output& output, const MeshHeader& header, Hdf5Group& file,
                      Hdf5Group& grid);

/// Nothing when the file has no such arrays.  `name` is what errors call it.
/// ERRORS: mw::Error(kInput) naming file and data set when they are damaged.
[[nodiscard]] LabelNames read_vtkhdf_names(hid_t file, hid_t grid, const std::string& name);
[[nodiscard]] MeshRecord read_vtkhdf_record(hid_t file, const std::string& name);

}  // namespace mw::io
