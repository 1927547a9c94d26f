// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Meshes as columns of numbers, each in one piece of a file: so VTK's formats have them.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "io/file/sink/partial_file.h"
#include "io/mesh/element.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/shared_mesh.h"

namespace mw::io {

/// Numbers one behind the other, from an address on.  T: as wide as the numbers in the file.
/// Cost: half a MiB.
template <class T>
class FileColumn {
 public:
  FileColumn() = default;
  /// address: reserved for as many bytes as will be added, or the next to be.
  /// REQUIRES: output outlives the column.
  FileColumn(PlacedOutput& output, std::uint64_t address) : output_(&output), address_(address) {
    buffer_.reserve(kBuffered);
  }
  [[nodiscard]] std::uint64_t address() const { return address_; }
  /// ERRORS of all: as the output.
  void add(T value) {
    buffer_.push_back(value);
    if (buffer_.size() == kBuffered) flush();
  }
  /// The next to be added is that number of the column: what is between is another one's to write.
  void go_to(std::uint64_t number) {
    if (number == written_ + buffer_.size()) return;
    flush();
    written_ = number;
  }
  void flush() {
    if (buffer_.empty()) return;
    output_->write_at(address_ + written_ * sizeof(T), std::as_bytes(std::span(buffer_)));
    written_ += buffer_.size();
    buffer_.clear();
  }

 private:
  static_assert(std::endian::native == std::endian::little, "numbers are written as they are");
  static constexpr std::size_t kBuffered = (std::size_t{1} << 19) / sizeof(T);

  PlacedOutput* output_ = nullptr;
  std::uint64_t address_ = 0;
  std::uint64_t written_ = 0;  ///< numbers before those that are buffered
  std::vector<T> buffer_;
};

/// Addresses of the columns of a mesh.
struct ColumnPlaces {
  std::uint64_t connectivity = 0;
  std::uint64_t offsets = 0;  ///< of the first, which is 0: the others say where a cell's nodes end
  std::uint64_t types = 0;
  std::uint64_t labels = 0;
  std::uint64_t points = 0;             ///< behind all others: how many there are is known last
  std::vector<std::uint64_t> values{};  ///< of each of MeshHeader::values
  std::uint64_t cohesive = 0;           ///< only with wedges: their interface; 0 of a tet
};

/// Writes rows, from any on.  Cost: 3 MiB of buffers, half a MiB more for each column of values.
/// ERRORS: as the output.
class MeshColumns {
 public:
  MeshColumns() = default;
  /// output outlives it.
  MeshColumns(PlacedOutput& output, const ColumnPlaces& places, Element element,
              bool has_wedges = false);

  /// Before the first rows, too.  With tet 0 goes the first of the offsets, which there is even
  /// without tets.
  void go_to(const RowPlace& place);
  void write_vertices(std::span<const Position> positions);
  /// rows: of node_count(element).
  void write_cell(std::span<const std::uint64_t> rows, RawLabel label);
  /// Behind all tets.  rows: of wedge_node_count(element), as NodeRows has them; label: that under
  /// the wedge.  REQUIRES: made for wedges.
  void write_wedge(std::span<const std::uint64_t> rows, RawLabel label, std::uint64_t interface);
  /// REQUIRES: tets.size() == labels.size(); made for kTet4.
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels);
  /// rows: a number for each column of values, tet by tet.
  void write_values(std::span<const double> rows);
  void flush();

  /// The next rows.
  [[nodiscard]] const RowPlace& place() const { return place_; }
  [[nodiscard]] std::uint64_t wedges() const { return wedges_; }

 private:
  using Column = FileColumn<std::uint64_t>;

  void end_cell(std::uint8_t type, RawLabel label);

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
};

/// What the sinks of such formats have in common: rows go into columns as they come.
class ColumnSink : public CellSink {
 public:
  void write_vertices(std::span<const Position> positions) override;
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override;
  void write_cell(std::span<const std::uint64_t> rows, RawLabel label) override;
  void write_wedge(std::span<const std::uint64_t> rows, RawLabel bottom,
                   std::uint64_t interface) override;
  void write_values(std::span<const double> rows) override { columns_.write_values(rows); }

 protected:
  explicit ColumnSink(Element element) : element_(element) {}
  [[nodiscard]] Element element() const { return element_; }
  [[nodiscard]] const MeshHeader& header() const { return header_; }
  /// Rows go there from now on.
  void place_columns(const MeshHeader& header, PlacedOutput& output, const ColumnPlaces& places);
  /// All rows are in the file: how many there were.  ERRORS: as check_sink_counts(file, ...).
  [[nodiscard]] RowPlace finish_columns(std::string_view file);

 private:
  [[nodiscard]] bool has_room(std::size_t tets) const;

  Element element_;
  MeshHeader header_;
  MeshColumns columns_;
};

}  // namespace mw::io
