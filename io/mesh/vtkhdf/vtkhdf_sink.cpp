// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into a .vtkhdf file.
#include "io/file/errors.h"
#include "io/mesh/grouped/group_names.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/vtkhdf/vtkhdf.h"

namespace mw::io {
namespace {

std::uint64_t cells_of(const MeshHeader& header) {
  return header.tets + header.wedges.count;
}

std::uint64_t nodes_of_cells(const MeshHeader& header, Element element) {
  return node_count(element) * header.tets + wedge_node_count(element) * header.wedges.count;
}

// Lists of groups and data sets are filled one by one: when memory runs out within a braced list of
// them, GCC 12 destroys members that were never made.

/// Writes a data set of one number.
Hdf5DataSet one(Hdf5Output& output, const char* name, std::uint64_t count) {
  return output.add({.name = name, .kind = Hdf5Kind::kInt64, .shape = {1}},
                    std::as_bytes(std::span(&count, 1)));
}

/// Adds a data set whose numbers are in the file.
void add_set(Hdf5Group& group, std::string name, Hdf5Kind kind, std::vector<std::uint64_t> shape,
             std::uint64_t address) {
  Hdf5DataSet& set = group.sets.emplace_back();
  set.name = std::move(name);
  set.kind = kind;
  set.shape = std::move(shape);
  set.address = address;
}

Hdf5Group cell_data(const ColumnPlaces& places, const MeshHeader& header) {
  const std::uint64_t cells = cells_of(header);
  Hdf5Group out{.name = "CellData"};
  add_set(out, "label", header.labels_signed ? Hdf5Kind::kInt64 : Hdf5Kind::kUint64, {cells},
          places.labels);
  for (std::size_t i = 0; i < header.values.size(); ++i) {
    add_set(out, header.values[i], Hdf5Kind::kFloat64, {cells}, places.values[i]);
  }
  if (header.wedges.count > 0) {
    add_set(out, kCohesive, Hdf5Kind::kUint64, {cells}, places.cohesive);
  }
  const std::vector<std::string> masks = mask_arrays(header);
  for (std::size_t i = 0; i < masks.size(); ++i) {
    add_set(out, masks[i], Hdf5Kind::kUint8, {cells}, places.masks[i]);
  }
  return out;
}

/// Reserves the first rooms of a file, for all columns but the points, whose room comes next.
ColumnPlaces place_vtkhdf(Hdf5Output& output, Element element, const MeshHeader& header) {
  ColumnPlaces out;
  const std::uint64_t cells = cells_of(header);
  out.connectivity = output.reserve(nodes_of_cells(header, element) * sizeof(std::uint64_t));
  out.offsets = output.reserve((cells + 1) * sizeof(std::uint64_t));
  out.types = output.reserve(cells);
  out.labels = output.reserve(cells * sizeof(RawLabel));
  for (std::size_t i = 0; i < header.values.size(); ++i) {
    out.values.push_back(output.reserve(cells * sizeof(double)));
  }
  if (header.wedges.count > 0) out.cohesive = output.reserve(cells * sizeof(std::uint64_t));
  for (std::size_t i = 0; i < header.record.masks.size(); ++i) {
    out.masks.push_back(output.reserve(cells));
  }
  out.points = output.next();
  return out;
}

/// Writes all that tells of the columns, and gives the file its name.
/// REQUIRES: all rows are in the file, and the points' room is reserved.
void commit_vtkhdf(Hdf5Output& output, const ColumnPlaces& places, Element element,
                   const MeshHeader& header, std::uint64_t vertices) {
  const std::uint64_t cells = cells_of(header), corners = nodes_of_cells(header, element);
  Hdf5Group grid{.name = "VTKHDF"};
  grid.attributes.push_back({"Version", std::vector<std::int64_t>{1, 0}});
  grid.attributes.push_back({"Type", std::string("UnstructuredGrid")});
  add_set(grid, "Points", Hdf5Kind::kFloat64, {vertices, 3}, places.points);
  add_set(grid, "Connectivity", Hdf5Kind::kInt64, {corners}, places.connectivity);
  add_set(grid, "Offsets", Hdf5Kind::kInt64, {cells + 1}, places.offsets);
  add_set(grid, "Types", Hdf5Kind::kUint8, {cells}, places.types);
  grid.sets.push_back(one(output, "NumberOfPoints", vertices));
  grid.sets.push_back(one(output, "NumberOfCells", cells));
  grid.sets.push_back(one(output, "NumberOfConnectivityIds", corners));
  grid.groups.push_back(cell_data(places, header));
  Hdf5Group root;
  add_vtkhdf_facts(output, header, root, grid);
  root.groups.push_back(std::move(grid));
  output.commit(root);
}

}  // namespace

void VtkhdfSink::begin(const MeshHeader& header) {
  places_ = place_vtkhdf(output_, element(), header);
  place_columns(header, output_.file(), places_);
}

void VtkhdfSink::finish() {
  const std::uint64_t vertices = finish_columns(output_.name()).vertex;
  static_cast<void>(output_.reserve(vertices * sizeof(Position)));
  commit_vtkhdf(output_, places_, element(), header(), vertices);
}

}  // namespace mw::io
