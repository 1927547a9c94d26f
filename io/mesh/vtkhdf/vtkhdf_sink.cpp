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
constexpr std::uint8_t kVtkTetra = 10;

Hdf5Handle creation(hid_t of_what) {
  Hdf5Handle properties(H5Pcreate(of_what), &H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  return properties;
}

Hdf5Handle make_group(hid_t place, const char* name) {
  const Hdf5Handle properties = creation(H5P_GROUP_CREATE);
  return {H5Gcreate2(place, name, H5P_DEFAULT, properties.get(), H5P_DEFAULT), &H5Gclose};
}

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

template <class T>
Hdf5Column<T>::Hdf5Column(hid_t place, const char* name, Hdf5Type type, hsize_t rows_per_chunk,
                          hsize_t components)
    : memory_type_(type.memory), rows_per_chunk_(rows_per_chunk), components_(components) {
  buffer_.reserve(rows_per_chunk * components);
  const int rank = components == 1 ? 1 : 2;
  const std::array<hsize_t, 2> none{0, components};
  const std::array<hsize_t, 2> most{H5S_UNLIMITED, components};
  const std::array<hsize_t, 2> chunk{rows_per_chunk, components};
  const Hdf5Handle space(H5Screate_simple(rank, none.data(), most.data()), &H5Sclose);
  const Hdf5Handle properties = creation(H5P_DATASET_CREATE);
  H5Pset_chunk(properties.get(), rank, chunk.data());
  // The last chunk is whole in the file; what is behind the data must be the same each time.
  H5Pset_fill_time(properties.get(), H5D_FILL_TIME_ALLOC);
  set_ = Hdf5Handle(
      H5Dcreate2(place, name, type.file, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
      &H5Dclose);
  sound_ = set_.valid();
}

template <class T>
void Hdf5Column<T>::flush() {
  const std::array<hsize_t, 2> count{buffer_.size() / components_, components_};
  const std::array<hsize_t, 2> start{rows_, 0};
  rows_ += count[0];
  const std::array<hsize_t, 2> size{rows_, components_};
  const int rank = components_ == 1 ? 1 : 2;
  sound_ = sound_ && H5Dset_extent(set_.get(), size.data()) >= 0;
  const Hdf5Handle place(H5Dget_space(set_.get()), &H5Sclose);
  const Hdf5Handle memory(H5Screate_simple(rank, count.data(), nullptr), &H5Sclose);
  sound_ = sound_ &&
           H5Sselect_hyperslab(place.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                               nullptr) >= 0 &&
           H5Dwrite(set_.get(), memory_type_, memory.get(), place.get(), H5P_DEFAULT,
                    buffer_.data()) >= 0;
  buffer_.clear();
}

template <class T>
bool Hdf5Column<T>::finish() {
  if (!buffer_.empty()) flush();
  return set_.close() && sound_;
}

VtkhdfSink::VtkhdfSink(const std::filesystem::path& path)
    : name_(path.string()), file_(path), target_{.file = &file_, .failure = nullptr} {
  silence_hdf5();
}

void VtkhdfSink::require(bool done) const {
  target_.check();
  if (!done) throw Error(ErrorKind::kResource, name_ + ": the HDF5 library failed to write it");
}

void VtkhdfSink::begin(const MeshHeader& header) {
  header_ = header;
  const Hdf5Handle access = access_through(target_);
  const Hdf5Handle properties = creation(H5P_FILE_CREATE);
  hdf5_ = Hdf5Handle(H5Fcreate(name_.c_str(), H5F_ACC_TRUNC, properties.get(), access.get()),
                     &H5Fclose);
  require(hdf5_.valid());
  group_ = make_group(hdf5_.get(), "VTKHDF");
  const Hdf5Handle cell_data = make_group(group_.get(), "CellData");
  require(group_.valid() && cell_data.valid());
  write_attributes();
  require(write_vtkhdf_facts(hdf5_.get(), group_.get(), header));
  // Small meshes are small files.  There are 5 to 6 tets a vertex, and an offset more than tets.
  const std::uint64_t rows = std::clamp<std::uint64_t>(header.tets + 1, 4, kMaxChunkRows);
  const Hdf5Type real{H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE};
  const Hdf5Type index{H5T_STD_I64LE, H5T_NATIVE_INT64};
  const Hdf5Type byte{H5T_STD_U8LE, H5T_NATIVE_UINT8};
  const Hdf5Type label = header.labels_signed ? index : Hdf5Type{H5T_STD_U64LE, H5T_NATIVE_UINT64};
  points_ = Hdf5Column<double>(group_.get(), "Points", real, rows / 4, 3);
  connectivity_ = Hdf5Column<std::uint64_t>(group_.get(), "Connectivity", index, 4 * rows);
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
  require(write_attribute(group_.get(), "Version", H5T_STD_I64LE, H5T_NATIVE_INT64, make_space(2),
                          kVersion.data()));
  require(write_attribute(group_.get(), "Type", string.get(), string.get(), scalar, kType.data()));
}

void VtkhdfSink::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    for (const double x : position) points_.add(x);
    points_.end_row();
  }
  vertices_ += positions.size();
  target_.check();
}

void VtkhdfSink::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  MW_ASSERT(tets.size() == labels.size());
  for (std::size_t i = 0; i < tets.size(); ++i) {
    for (const std::uint64_t row : tets[i]) connectivity_.add(row);
    connectivity_.end_row();
    offsets_.add(4 * ++tets_);
    offsets_.end_row();
    types_.add(kVtkTetra);
    types_.end_row();
    labels_.add(labels[i]);
    labels_.end_row();
  }
  target_.check();
}

void VtkhdfSink::write_count(const char* name, std::uint64_t count) const {
  const Hdf5Handle properties = creation(H5P_DATASET_CREATE);
  const Hdf5Handle set(H5Dcreate2(group_.get(), name, H5T_STD_I64LE, make_space(1).get(),
                                  H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                       &H5Dclose);
  require(set.valid() &&
          H5Dwrite(set.get(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &count) >= 0);
}

void VtkhdfSink::finish() {
  check_sink_counts(name_, header_, tets_);
  write_count("NumberOfPoints", vertices_);
  write_count("NumberOfCells", tets_);
  write_count("NumberOfConnectivityIds", 4 * tets_);
  bool done = points_.finish();
  done = connectivity_.finish() && done;
  done = offsets_.finish() && done;
  done = types_.finish() && done;
  done = labels_.finish() && done;
  done = group_.close() && done;
  done = hdf5_.close() && done;
  require(done);
  file_.commit();
}

}  // namespace mw::io
