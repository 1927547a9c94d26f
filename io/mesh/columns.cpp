// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Rows of a mesh go into columns.
#include "io/mesh/columns.h"

#include "io/mesh/grouped/grouped_mesh.h"
#include "kernels/core/assert.h"

namespace mw::io {

MeshColumns::MeshColumns(AtomicFile& output, const ColumnPlaces& places, Element element,
                         const MeshHeader& header)
    : element_(element),
      connectivity_(output, places.connectivity),
      offsets_(output, places.offsets),
      types_(output, places.types),
      labels_(output, places.labels),
      points_(output, places.points) {
  offsets_.add(0);  // also where there are no cells
  for (const std::uint64_t place : places.values) values_.emplace_back(output, place);
  if (header.wedges.count > 0) cohesive_.emplace(output, places.cohesive);
  for (std::size_t i = 0; i < places.masks.size(); ++i) {
    masks_.push_back({header.record.masks[i], {output, places.masks[i]}});
  }
}

void MeshColumns::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    for (const double x : position) points_.add(x);
  }
  place_.vertex += positions.size();
}

void MeshColumns::write_cell(std::span<const std::uint64_t> rows, RawLabel label) {
  for (const std::uint64_t row : rows) connectivity_.add(row);
  ++place_.tet;
  end_cell(vtk_type(element_), label);
  if (cohesive_) cohesive_->add(0);
}

void MeshColumns::write_wedge(std::span<const std::uint64_t> rows, RawLabel label,
                              std::uint64_t interface) {
  for (std::size_t i = 0; i < rows.size(); ++i) connectivity_.add(rows[kVtkWedgeOrder[i]]);
  ++wedges_;
  end_cell(vtk_wedge_type(element_), label);
  cohesive_->add(interface);
}

void MeshColumns::end_cell(std::uint8_t type, RawLabel label) {
  types_.add(type);
  labels_.add(label);
  for (auto& [mask, cells] : masks_) cells.add(mask.has(label) ? 1 : 0);
  offsets_.add(node_count(element_) * place_.tet + wedge_node_count(element_) * wedges_);
}

void MeshColumns::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && element_ == Element::kTet4);
  for (std::size_t i = 0; i < tets.size(); ++i) write_cell(tets[i], labels[i]);
}

void MeshColumns::write_values(std::span<const double> rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) values_[i % values_.size()].add(rows[i]);
}

void MeshColumns::flush() {
  for (auto& column : values_) column.flush();
  for (MaskColumn& mask : masks_) mask.cells.flush();
  if (cohesive_) cohesive_->flush();
  connectivity_.flush();
  offsets_.flush();
  types_.flush();
  labels_.flush();
  points_.flush();
}

void ColumnSink::place_columns(const MeshHeader& header, AtomicFile& output,
                               const ColumnPlaces& places) {
  header_ = header;
  columns_ = MeshColumns(output, places, element_, header);
}

void ColumnSink::write_vertices(std::span<const Position> positions) {
  columns_.write_vertices(positions);
}

/// Returns whether these tets were announced; rows beyond those would be written over others.
bool ColumnSink::has_room(std::size_t tets) const {
  return columns_.place().tet + tets <= header_.tets;
}

void ColumnSink::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && has_room(tets.size()));
  columns_.write_tets(tets, labels);
}

void ColumnSink::write_cell(std::span<const std::uint64_t> rows, RawLabel label) {
  MW_ASSERT(rows.size() == node_count(element_) && has_room(1));
  columns_.write_cell(rows, label);
}

void ColumnSink::write_wedge(std::span<const std::uint64_t> rows, RawLabel bottom,
                             std::uint64_t interface) {
  MW_ASSERT(rows.size() == wedge_node_count(element_) && columns_.wedges() < header_.wedges.count &&
            columns_.place().tet == header_.tets);
  columns_.write_wedge(rows, bottom, interface);
}

RowPlace ColumnSink::finish_columns(std::string_view file) {
  check_sink_counts(file, header_, columns_.place().tet);
  MW_ASSERT(columns_.wedges() == header_.wedges.count);
  columns_.flush();
  return columns_.place();
}

namespace {

void write_values_of(GroupedMesh& mesh, std::uint64_t tet, MeshSink& sink) {
  std::vector<double> row(mesh.header().values.size());
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = mesh.value(tet, i);
  sink.write_values(row);
}

void write_cells_of(GroupedMesh& mesh, Label rank, ColumnSink& sink) {
  const RowRange range = mesh.label_tets()[rank];
  for (std::uint64_t tet = range.begin; tet < range.end; ++tet) {
    sink.write_cell(mesh.tet_nodes(tet), mesh.table().raw(rank));
    write_values_of(mesh, tet, sink);
  }
}

void write_wedges(GroupedMesh& mesh, ColumnSink& sink) {
  std::uint64_t interface = 0;
  for (const WedgeGroup& group : mesh.wedge_groups()) {
    ++interface;
    for (std::uint64_t w = group.wedges.begin; w < group.wedges.end; ++w) {
      const Wedge wedge = mesh.wedge(w);
      sink.write_wedge(mesh.wedge_nodes(wedge), mesh.table().raw(group.bottom), interface);
      write_values_of(mesh, wedge.bottom_tet, sink);
    }
  }
}

}  // namespace

void write_cells(GroupedMesh& mesh, ColumnSink& sink) {
  MeshHeader header = mesh.header();
  header.wedges.count = mesh.wedge_count();
  for (const WedgeGroup& group : mesh.wedge_groups()) {
    header.wedges.interfaces.push_back(
        {mesh.table().raw(group.bottom), mesh.table().raw(group.top)});
  }
  sink.begin(header);
  write_nodes(mesh, sink);
  for (Label rank = 0; rank < mesh.table().size(); ++rank) write_cells_of(mesh, rank, sink);
  write_wedges(mesh, sink);
  sink.finish();
}

}  // namespace mw::io
