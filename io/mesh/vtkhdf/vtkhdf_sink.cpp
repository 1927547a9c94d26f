// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into a .vtkhdf file, of one process or of several that write it together.

#include "io/file/errors.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/vtkhdf/vtkhdf.h"

namespace mw::io {
namespace {

/// A data set of one number.
Hdf5DataSet one(Hdf5Output& output, const char* name, std::uint64_t count) {
  return output.add({.name = name, .kind = Hdf5Kind::kInt64, .shape = {1}},
                    std::as_bytes(std::span(&count, 1)));
}

}  // namespace

ColumnPlaces place_vtkhdf(Hdf5Rooms& rooms, Element element, std::uint64_t tets,
                          std::size_t values) {
  ColumnPlaces out;
  out.connectivity = rooms.reserve(node_count(element) * tets * sizeof(std::uint64_t));
  out.offsets = rooms.reserve((tets + 1) * sizeof(std::uint64_t));
  out.types = rooms.reserve(tets);
  out.labels = rooms.reserve(tets * sizeof(RawLabel));
  for (std::size_t i = 0; i < values; ++i) {
    out.values.push_back(rooms.reserve(tets * sizeof(double)));
  }
  out.points = rooms.next();
  return out;
}

void commit_vtkhdf(Hdf5Output& output, const ColumnPlaces& places, Element element,
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
  for (std::size_t i = 0; i < header.values.size(); ++i) {
    grid.groups[0].sets.push_back({header.values[i], Hdf5Kind::kFloat64, {tets}, places.values[i]});
  }
  Hdf5Group root;
  add_vtkhdf_facts(output, header, root, grid);
  root.groups.push_back(std::move(grid));
  output.commit(root);
}

void VtkhdfSink::begin(const MeshHeader& header) {
  places_ = place_vtkhdf(output_.rooms(), element(), header.tets, header.values.size());
  place_columns(header, output_.file(), places_);
}

void VtkhdfSink::finish() {
  const std::uint64_t vertices = finish_columns(output_.name()).vertex;
  static_cast<void>(output_.reserve(vertices * sizeof(Position)));
  commit_vtkhdf(output_, places_, element(), header(), vertices);
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
  columns_ = MeshColumns(*part_, place_vtkhdf(rooms, Element::kTet4, tets), Element::kTet4);
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
