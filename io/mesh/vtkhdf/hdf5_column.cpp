// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A data set that is written row by row.
#include "io/mesh/vtkhdf/hdf5_column.h"

#include <array>
#include <cstdint>

#include "io/mesh/vtkhdf/hdf5_output.h"

namespace mw::io {

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
  const Hdf5Handle properties = hdf5_creation(H5P_DATASET_CREATE);
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

template class Hdf5Column<double>;
template class Hdf5Column<std::uint64_t>;
template class Hdf5Column<std::int32_t>;
template class Hdf5Column<std::uint8_t>;

}  // namespace mw::io
