// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The rows of a .vtkhdf file: where they lie, and their writing.
#pragma once

#include "io/mesh/element.h"
#include "io/mesh/shared_mesh.h"
#include "io/mesh/vtkhdf/hdf5_column.h"

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

}  // namespace mw::io
