// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Streams a mesh into a .vtkhdf file.
#include "io/mesh/vtkhdf/vtkhdf_sink.h"

#include <algorithm>
#include <array>

#include "io/file/errors.h"
#include "io/mesh/sink_counts.h"
#include "io/mesh/vtkhdf/vtkhdf_names.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kMaxChunkRows = 1 << 16;

Hdf5Handle make_space(hsize_t size) {
  return {H5Screate_simple(1, &size, nullptr), &H5Sclose};
}

bool write_attribute(hid_t place, const char* name, hid_t file_type, hid_t memory_type,
                     const Hdf5Handle& space, const void* data) {
  const Hdf5Handle attribute(
      H5Acreate2(place, name, file_type, space.get(), H5P_DEFAULT, H5P_DEFAULT), &H5Aclose);
  return attribute.valid() && H5Awrite(attribute.get(), memory_type, data) >= 0;
}

}  // namespace

void VtkhdfSink::begin(const MeshHeader& header) {
  header_ = header;
  output_.open();
  group_ = output_.make_group(output_.file(), "VTKHDF");
  const Hdf5Handle cell_data = output_.make_group(group_.get(), "CellData");
  write_attributes();
  output_.require(write_vtkhdf_facts(output_.file(), group_.get(), header));
  // Small meshes are small files.  There are 5 to 6 tets a vertex, and an offset more than tets.
  const std::uint64_t rows = std::clamp<std::uint64_t>(header.tets + 1, 4, kMaxChunkRows);
  const Hdf5Type real{H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE};
  const Hdf5Type index{H5T_STD_I64LE, H5T_NATIVE_INT64};
  const Hdf5Type byte{H5T_STD_U8LE, H5T_NATIVE_UINT8};
  const Hdf5Type label = header.labels_signed ? index : Hdf5Type{H5T_STD_U64LE, H5T_NATIVE_UINT64};
  points_ = Hdf5Column<double>(group_.get(), "Points", real, rows / 4, 3);
  connectivity_ =
      Hdf5Column<std::uint64_t>(group_.get(), "Connectivity", index, node_count(element_) * rows);
  offsets_ = Hdf5Column<std::uint64_t>(group_.get(), "Offsets", index, rows);
  types_ = Hdf5Column<std::uint8_t>(group_.get(), "Types", byte, rows);
  labels_ = Hdf5Column<std::uint64_t>(cell_data.get(), "label", label, rows);
  offsets_.add(0);
  offsets_.end_row();
}

void VtkhdfSink::write_attributes() const {
  constexpr std::array<std::int64_t, 2> kVersion{1, 0};
  constexpr std::string_view kType = "UnstructuredGrid";
  const Hdf5Handle string(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(string.get(), kType.size());
  H5Tset_strpad(string.get(), H5T_STR_NULLPAD);
  const Hdf5Handle scalar(H5Screate(H5S_SCALAR), &H5Sclose);
  output_.require(write_attribute(group_.get(), "Version", H5T_STD_I64LE, H5T_NATIVE_INT64,
                                  make_space(2), kVersion.data()));
  output_.require(
      write_attribute(group_.get(), "Type", string.get(), string.get(), scalar, kType.data()));
}

void VtkhdfSink::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    for (const double x : position) points_.add(x);
    points_.end_row();
  }
  vertices_ += positions.size();
  output_.check();
}

void VtkhdfSink::write_cell(std::span<const std::uint64_t> rows, RawLabel label) {
  for (const std::uint64_t row : rows) connectivity_.add(row);
  connectivity_.end_row();
  corners_ += rows.size();
  offsets_.add(corners_);
  offsets_.end_row();
  types_.add(vtk_type(element_));
  types_.end_row();
  labels_.add(label);
  labels_.end_row();
  ++tets_;
}

void VtkhdfSink::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && element_ == Element::kTet4);
  for (std::size_t i = 0; i < tets.size(); ++i) write_cell(tets[i], labels[i]);
  output_.check();
}

void VtkhdfSink::write_ten_nodes(std::span<const TenRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size() && element_ == Element::kTet10);
  for (std::size_t i = 0; i < tets.size(); ++i) write_cell(tets[i], labels[i]);
  output_.check();
}

void VtkhdfSink::write_count(const char* name, std::uint64_t count) const {
  const Hdf5Handle properties = hdf5_creation(H5P_DATASET_CREATE);
  const Hdf5Handle set(H5Dcreate2(group_.get(), name, H5T_STD_I64LE, make_space(1).get(),
                                  H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                       &H5Dclose);
  output_.require(set.valid() && H5Dwrite(set.get(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL,
                                          H5P_DEFAULT, &count) >= 0);
}

void VtkhdfSink::finish() {
  check_sink_counts(output_.name(), header_, tets_);
  write_count("NumberOfPoints", vertices_);
  write_count("NumberOfCells", tets_);
  write_count("NumberOfConnectivityIds", corners_);
  bool done = points_.finish();
  done = connectivity_.finish() && done;
  done = offsets_.finish() && done;
  done = types_.finish() && done;
  done = labels_.finish() && done;
  done = group_.close() && done;
  output_.require(done);
  output_.commit();
}

}  // namespace mw::io
