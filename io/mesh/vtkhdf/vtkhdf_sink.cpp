// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into a .vtkhdf file.
#include "io/mesh/vtkhdf/vtkhdf_sink.h"

#include "io/mesh/sink_counts.h"
#include "io/mesh/vtkhdf/vtkhdf_names.h"
#include "kernels/core/assert.h"

namespace mw::io {

void VtkhdfSink::begin(const MeshHeader& header) {
  header_ = header;
  const std::uint64_t numbers = node_count(element_) * header.tets;
  connectivity_ = Column(output_, output_.reserve(numbers * sizeof(std::uint64_t)));
  offsets_ = Column(output_, output_.reserve((header.tets + 1) * sizeof(std::uint64_t)));
  types_ = Hdf5Column<std::uint8_t>(output_, output_.reserve(header.tets));
  labels_ = Column(output_, output_.reserve(header.tets * sizeof(RawLabel)));
  points_ = Hdf5Column<double>(output_, output_.next());
  offsets_.add(0);
}

void VtkhdfSink::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    for (const double x : position) points_.add(x);
  }
  vertices_ += positions.size();
}

/// Rows beyond those that were announced would be written over others.
void VtkhdfSink::write_cell(std::span<const std::uint64_t> rows, RawLabel label) {
  MW_ASSERT(tets_ < header_.tets);
  for (const std::uint64_t row : rows) connectivity_.add(row);
  corners_ += rows.size();
  offsets_.add(corners_);
  types_.add(vtk_type(element_));
  labels_.add(label);
  ++tets_;
}

void VtkhdfSink::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && element_ == Element::kTet4);
  for (std::size_t i = 0; i < tets.size(); ++i) write_cell(tets[i], labels[i]);
}

void VtkhdfSink::write_ten_nodes(std::span<const TenRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && element_ == Element::kTet10);
  for (std::size_t i = 0; i < tets.size(); ++i) write_cell(tets[i], labels[i]);
}

Hdf5DataSet VtkhdfSink::one(const char* name, std::uint64_t count) {
  return output_.add({.name = name, .kind = Hdf5Kind::kInt64, .shape = {1}},
                     std::as_bytes(std::span(&count, 1)));
}

void VtkhdfSink::finish() {
  check_sink_counts(output_.name(), header_, tets_);
  const Hdf5Kind label = header_.labels_signed ? Hdf5Kind::kInt64 : Hdf5Kind::kUint64;
  Hdf5Group grid{.name = "VTKHDF",
                 .attributes = {{"Version", std::vector<std::int64_t>{1, 0}},
                                {"Type", std::string("UnstructuredGrid")}}};
  grid.sets = {points_.finish("Points", Hdf5Kind::kFloat64, {vertices_, 3}),
               connectivity_.finish("Connectivity", Hdf5Kind::kInt64, {corners_}),
               offsets_.finish("Offsets", Hdf5Kind::kInt64, {tets_ + 1}),
               types_.finish("Types", Hdf5Kind::kUint8, {tets_})};
  static_cast<void>(output_.reserve(vertices_ * sizeof(Position)));
  grid.sets.push_back(one("NumberOfPoints", vertices_));
  grid.sets.push_back(one("NumberOfCells", tets_));
  grid.sets.push_back(one("NumberOfConnectivityIds", corners_));
  grid.groups = {{.name = "CellData", .sets = {labels_.finish("label", label, {tets_})}}};
  Hdf5Group root;
  add_vtkhdf_facts(output_, header_, root, grid);
  root.groups.push_back(std::move(grid));
  output_.commit(root);
}

}  // namespace mw::io
