// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into a .vtkhdf file, of one process or of several that write it together.

#include "io/file/errors.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/vtkhdf/vtkhdf.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

/// A data set of one number.
Hdf5DataSet one(Hdf5Output& output, const char* name, std::uint64_t count) {
  return output.add({.name = name, .kind = Hdf5Kind::kInt64, .shape = {1}},
                    std::as_bytes(std::span(&count, 1)));
}

}  // namespace

VtkhdfPlaces place_vtkhdf(Hdf5Rooms& rooms, Element element, std::uint64_t tets) {
  VtkhdfPlaces out;
  out.connectivity = rooms.reserve(node_count(element) * tets * sizeof(std::uint64_t));
  out.offsets = rooms.reserve((tets + 1) * sizeof(std::uint64_t));
  out.types = rooms.reserve(tets);
  out.labels = rooms.reserve(tets * sizeof(RawLabel));
  out.points = rooms.next();
  return out;
}

VtkhdfColumns::VtkhdfColumns(PlacedOutput& output, const VtkhdfPlaces& places, Element element)
    : element_(element),
      connectivity_(output, places.connectivity),
      offsets_(output, places.offsets),
      types_(output, places.types),
      labels_(output, places.labels),
      points_(output, places.points) {}

void VtkhdfColumns::go_to(const RowPlace& place) {
  place_ = place;
  points_.go_to(3 * place.vertex);
  connectivity_.go_to(node_count(element_) * place.tet);
  types_.go_to(place.tet);
  labels_.go_to(place.tet);
  offsets_.go_to(place.tet == 0 ? 0 : place.tet + 1);
  if (place.tet == 0) offsets_.add(0);
}

void VtkhdfColumns::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    for (const double x : position) points_.add(x);
  }
  place_.vertex += positions.size();
}

void VtkhdfColumns::write_cell(std::span<const std::uint64_t> rows, RawLabel label) {
  for (const std::uint64_t row : rows) connectivity_.add(row);
  types_.add(vtk_type(element_));
  labels_.add(label);
  ++place_.tet;
  offsets_.add(node_count(element_) * place_.tet);
}

void VtkhdfColumns::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && element_ == Element::kTet4);
  for (std::size_t i = 0; i < tets.size(); ++i) write_cell(tets[i], labels[i]);
}

void VtkhdfColumns::flush() {
  connectivity_.flush();
  offsets_.flush();
  types_.flush();
  labels_.flush();
  points_.flush();
}

void commit_vtkhdf(Hdf5Output& output, const VtkhdfPlaces& places, Element element,
                   const MeshHeader& header, std::uint64_t vertices) {
  const std::uint64_t tets = header.tets, corners = node_count(element) * tets;
  Hdf5Group grid{.name = "VTKHDF",
                 .attributes = {{"Version", std::vector<std::int64_t>{1, 0}},
                                {"Type", std::string("UnstructuredGrid")}}};
  grid.sets = {{"Points", Hdf5Kind::kFloat64, {vertices, 3}, places.points},
               {"Connectivity", Hdf5Kind::kInt64, {corners}, places.connectivity},
               {"Offsets", Hdf5Kind::kInt64, {tets + 1}, places.offsets},
               {"Types", Hdf5Kind::kUint8, {tets}, places.types},
               one(output, "NumberOfPoints", vertices),
               one(output, "NumberOfCells", tets),
               one(output, "NumberOfConnectivityIds", corners)};
  const Hdf5Kind label = header.labels_signed ? Hdf5Kind::kInt64 : Hdf5Kind::kUint64;
  grid.groups = {{.name = "CellData", .sets = {{"label", label, {tets}, places.labels}}}};
  Hdf5Group root;
  add_vtkhdf_facts(output, header, root, grid);
  root.groups.push_back(std::move(grid));
  output.commit(root);
}

void VtkhdfSink::begin(const MeshHeader& header) {
  header_ = header;
  places_ = place_vtkhdf(output_.rooms(), element_, header.tets);
  columns_ = VtkhdfColumns(output_, places_, element_);
  columns_.go_to({0, 0});
}

void VtkhdfSink::write_vertices(std::span<const Position> positions) {
  columns_.write_vertices(positions);
}

/// Rows beyond those that were announced would be written over others.
bool VtkhdfSink::has_room(std::size_t tets) const {
  return columns_.place().tet + tets <= header_.tets;
}

void VtkhdfSink::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && has_room(tets.size()));
  columns_.write_tets(tets, labels);
}

void VtkhdfSink::write_ten_nodes(std::span<const TenRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && has_room(tets.size()));
  MW_ASSERT(element_ == Element::kTet10);
  for (std::size_t i = 0; i < tets.size(); ++i) columns_.write_cell(tets[i], labels[i]);
}

void VtkhdfSink::finish() {
  check_sink_counts(output_.name(), header_, columns_.place().tet);
  columns_.flush();
  const std::uint64_t vertices = columns_.place().vertex;
  static_cast<void>(output_.reserve(vertices * sizeof(Position)));
  commit_vtkhdf(output_, places_, element_, header_, vertices);
}

void VtkhdfShared::create() {
  made_.emplace(path_);
  partial_ = std::filesystem::absolute(made_->partial());
}

void VtkhdfShared::join(const std::string& place) {
  partial_ = place;
  try {
    const JoinedPartial reachable(partial_);
  } catch (const Error& error) {
    throw Error(error.kind(), text(error.what(), "; every process writes a part of this mesh"));
  }
}

void VtkhdfShared::lay_out(const MeshHeader& header, std::uint64_t vertices) {
  header_ = header;
  vertices_ = vertices;
  static_cast<void>(place_vtkhdf(made_->rooms(), Element::kTet4, header.tets));
  static_cast<void>(made_->reserve(vertices * sizeof(Position)));
  made_->extend();
}

void VtkhdfShared::begin(std::uint64_t tets) {
  Hdf5Rooms rooms;
  part_.emplace(partial_);
  columns_ = VtkhdfColumns(*part_, place_vtkhdf(rooms, Element::kTet4, tets), Element::kTet4);
}

void VtkhdfShared::sync() {
  columns_.flush();
  part_->sync();
  part_.reset();
}

void VtkhdfShared::finish() {
  Hdf5Rooms rooms;
  commit_vtkhdf(*made_, place_vtkhdf(rooms, Element::kTet4, header_.tets), Element::kTet4, header_,
                vertices_);
}

}  // namespace mw::io
