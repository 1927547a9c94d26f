// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A data set that is written row by row.
#pragma once

#include <vector>

#include "io/hdf5/hdf5_handle.h"

namespace mw::io {

/// How numbers lie in the file and in memory; of one signedness, since HDF5 clamps when it differs.
struct Hdf5Type {
  hid_t file = H5I_INVALID_HID;
  hid_t memory = H5I_INVALID_HID;
};

/// A chunked data set that grows at its end, one whole chunk at a time.
/// T: double, std::uint64_t, std::int32_t or std::uint8_t.
template <class T>
class Hdf5Column {
 public:
  Hdf5Column() = default;
  /// REQUIRES: the HDF5 file is open.  rows_per_chunk >= 1; components 1 means one dimension.
  Hdf5Column(hid_t place, const char* name, Hdf5Type type, hsize_t rows_per_chunk,
             hsize_t components = 1);
  void add(T value) { buffer_.push_back(value); }
  /// After each row.
  void end_row() {
    if (buffer_.size() == rows_per_chunk_ * components_) flush();
  }
  /// Writes what is left; whether all went well.
  bool finish();

 private:
  void flush();

  Hdf5Handle set_;
  hid_t memory_type_ = H5I_INVALID_HID;
  hsize_t rows_per_chunk_ = 0;
  hsize_t components_ = 1;
  hsize_t rows_ = 0;  ///< written
  std::vector<T> buffer_;
  bool sound_ = true;
};

}  // namespace mw::io
