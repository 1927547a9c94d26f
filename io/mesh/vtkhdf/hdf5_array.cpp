// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A data set of numbers in an HDF5 file.
#include "io/mesh/vtkhdf/hdf5_array.h"

#include <array>

#include "io/file/errors.h"

namespace mw::io {
namespace {

/// No filter of HDF5's own packs tighter than this.
constexpr std::uint64_t kMaxPacking = 1040;
/// Keeps products of counts and sizes within 64 bits.
constexpr std::uint64_t kMaxRows = std::uint64_t{1} << 56;

}  // namespace

Hdf5Array::Hdf5Array(hid_t where, const std::string& path, const std::string& file)
    : file_(file), path_(path), set_(H5Dopen2(where, path.c_str(), H5P_DEFAULT), &H5Dclose) {
  if (!set_.valid()) fail("missing or damaged");
  inspect();
}

void Hdf5Array::inspect() {
  const Hdf5Handle type(H5Dget_type(set_.get()), &H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) fail("holds no numbers");
  is_integer_ = kind == H5T_INTEGER;
  is_signed_ = is_integer_ && H5Tget_sign(type.get()) == H5T_SGN_2;
  const Hdf5Handle space(H5Dget_space(set_.get()), &H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank != 1 && rank != 2) fail(text("has ", rank, " dimensions"));
  std::array<hsize_t, 2> size{0, 1};
  H5Sget_simple_extent_dims(space.get(), size.data(), nullptr);
  rows_ = size[0];
  components_ = size[1];
  if (rows_ >= kMaxRows || components_ > 16) fail("its size is not credible");
  check_storage(H5Tget_size(type.get()));
}

void Hdf5Array::check_storage(std::size_t number_bytes) const {
  const std::uint64_t bytes = rows_ * components_ * number_bytes;
  if (bytes / kMaxPacking > H5Dget_storage_size(set_.get())) {
    fail(text("announces ", rows_, " rows, its bytes in the file cannot hold them"));
  }
}

void Hdf5Array::read(std::uint64_t first, std::uint64_t count, double* out) const {
  read_as(first, count, H5T_NATIVE_DOUBLE, out);
}
void Hdf5Array::read(std::uint64_t first, std::uint64_t count, std::int64_t* out) const {
  read_as(first, count, H5T_NATIVE_INT64, out);
}
void Hdf5Array::read(std::uint64_t first, std::uint64_t count, std::uint64_t* out) const {
  read_as(first, count, H5T_NATIVE_UINT64, out);
}

void Hdf5Array::read_as(std::uint64_t first, std::uint64_t count, hid_t type, void* out) const {
  if (first > rows_ || count > rows_ - first) {
    fail(text("holds ", rows_, " rows, ", first + count, " are needed"));
  }
  if (count == 0) return;
  const std::array<hsize_t, 2> start{first, 0};
  const std::array<hsize_t, 2> size{count, components_};
  const Hdf5Handle where(H5Dget_space(set_.get()), &H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(where.get());
  const Hdf5Handle memory(H5Screate_simple(rank, size.data(), nullptr), &H5Sclose);
  if (H5Sselect_hyperslab(where.get(), H5S_SELECT_SET, start.data(), nullptr, size.data(),
                          nullptr) < 0 ||
      H5Dread(set_.get(), type, memory.get(), where.get(), H5P_DEFAULT, out) < 0) {
    fail(text("cannot read rows ", first, " to ", first + count));
  }
}

void Hdf5Array::fail(const std::string& reason) const {
  fail_input(file_, text("data set '", path_, "'"), reason, "the file is truncated or damaged");
}

}  // namespace mw::io
