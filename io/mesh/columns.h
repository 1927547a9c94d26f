// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Meshes as columns of numbers, each in one piece of a file, as VTK's formats store them.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "io/file/sink/atomic_file.h"
#include "io/mesh/element.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {

/// Writes numbers one behind the other, from an address on.  T is as wide as the numbers in the
/// file.  Cost: 65,536 numbers.
template <class T>
class FileColumn {
 public:
  FileColumn() = default;
  /// From address on, the bytes that will be added are reserved, or are the next to be reserved.
  /// REQUIRES: output outlives the column.
  FileColumn(AtomicFile& output, std::uint64_t address) : output_(&output), address_(address) {
    buffer_.reserve(kBuffered);
  }
  [[nodiscard]] std::uint64_t address() const { return address_; }
  /// ERRORS (all members): those of the output.
  void add(T value) {
    buffer_.push_back(value);
    if (buffer_.size() == kBuffered) flush();
  }
  void flush() {
    if (buffer_.empty()) return;
    output_->write_at(address_ + written_ * sizeof(T), std::as_bytes(std::span(buffer_)));
    written_ += buffer_.size();
    buffer_.clear();
  }

 private:
  static_assert(std::endian::native == std::endian::little, "numbers are written as they are");
  static constexpr std::size_t kBuffered = std::size_t{1} << 16;

  AtomicFile* output_ = nullptr;
  std::uint64_t address_ = 0;
  std::uint64_t written_ = 0;  ///< numbers before those that are buffered
  std::vector<T> buffer_;
};

/// Addresses of the columns of a mesh.
struct ColumnPlaces {
  std::uint64_t connectivity = 0;
  std::uint64_t offsets = 0;  ///< the first is 0; the others say where each cell's nodes end
  std::uint64_t types = 0;
  std::uint64_t labels = 0;
  std::uint64_t points = 0;             ///< behind all others, since their number is known last
  std::vector<std::uint64_t> values{};  ///< one for each of MeshHeader::values
  std::uint64_t cohesive = 0;           ///< with wedges only: their interface, 0 for a tet
  std::vector<std::uint64_t> masks{};   ///< one for each of MeshRecord::masks
};

/// How many rows are written.
struct RowPlace {
  std::uint64_t vertex = 0;
  std::uint64_t tet = 0;
};

/// Writes the rows of a mesh.  Cost: 3 MiB of buffers, half a MiB for each column
/// of values, and 64 KiB for each mask.  ERRORS: those of the output.
class MeshColumns {
 public:
  MeshColumns() = default;
  /// REQUIRES: output outlives it.
  MeshColumns(AtomicFile& output, const ColumnPlaces& places, Element element,
              const MeshHeader& header);

  void write_vertices(std::span<const Position> positions);
  /// Writes a tet; rows are those of its node_count(element) nodes.
  void write_cell(std::span<const std::uint64_t> rows, RawLabel label);
  /// Writes a wedge; rows are those of its wedge_node_count(element) nodes, in the order of
  /// NodeRows, and label is that under it.  REQUIRES: made for wedges; all tets were written.
  void write_wedge(std::span<const std::uint64_t> rows, RawLabel label, std::uint64_t interface);
  /// REQUIRES: tets.size() == labels.size(); made for kTet4.
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels);
  /// rows holds, tet by tet, a number for each column of values.
  void write_values(std::span<const double> rows);
  void flush();

  [[nodiscard]] const RowPlace& place() const { return place_; }
  [[nodiscard]] std::uint64_t wedges() const { return wedges_; }

 private:
  using Column = FileColumn<std::uint64_t>;

  void end_cell(std::uint8_t type, RawLabel label);

  /// 1 for each cell with one of the mask's labels, and 0 for others.
  struct MaskColumn {
    MaskLabels mask;
    FileColumn<std::uint8_t> cells;
  };

  Element element_ = Element::kTet4;
  RowPlace place_;
  std::uint64_t wedges_ = 0;
  Column connectivity_;
  Column offsets_;
  FileColumn<std::uint8_t> types_;
  Column labels_;
  FileColumn<double> points_;
  std::vector<FileColumn<double>> values_;
  std::optional<Column> cohesive_;
  std::vector<MaskColumn> masks_;
};

/// The common part of the sinks of such formats, which write rows into columns as they come.
class ColumnSink : public MeshSink {
 public:
  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  /// Takes the nodes of a tet, in the place of write_tets().
  void write_cell(std::span<const std::uint64_t> rows, RawLabel label);
  /// Takes the nodes of a wedge (NodeRows), the label under it, and the number of its interface
  /// from 1 on.  REQUIRES: all tets were written; header.wedges tells of it.
  void write_wedge(std::span<const std::uint64_t> rows, RawLabel bottom, std::uint64_t interface);
  void write_values(std::span<const double> rows) override { columns_.write_values(rows); }

 protected:
  explicit ColumnSink(Element element) : element_(element) {}
  [[nodiscard]] Element element() const { return element_; }
  [[nodiscard]] const MeshHeader& header() const { return header_; }
  /// Makes rows go into these columns.
  void place_columns(const MeshHeader& header, AtomicFile& output, const ColumnPlaces& places);
  /// Writes what is buffered; returns how many rows there were.  ERRORS: see check_sink_counts().
  [[nodiscard]] RowPlace finish_columns(std::string_view file);

 private:
  [[nodiscard]] bool has_room(std::size_t tets) const;

  Element element_;
  MeshHeader header_;
  MeshColumns columns_;
};

/// Writes a grouped mesh, from begin() to finish(), with wedges behind the tets.  A wedge has the
/// values of the tet under it.
void write_cells(GroupedMesh& mesh, ColumnSink& sink);

}  // namespace mw::io
