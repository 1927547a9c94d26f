// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lets the HDF5 library read a file from a ByteSource, and tells where its raw data are.
#pragma once

#include <optional>

#include "io/file/byte_source.h"
#include "io/hdf5/hdf5_handle.h"

namespace mw::io {

/// A file that the library reads.
struct Hdf5Source {
  const ByteSource* bytes = nullptr;
  /// Raw data (not metadata) are not read; where they would have been is noted.  The library has no
  /// other quick way to tell: H5Dget_chunk_info_by_coord goes through all chunks for each.
  bool only_note_data = false;

  struct Place {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
  };
  std::optional<Place> noted;  ///< the last one
};

/// A file access property list for H5Fopen to read, whose file name is then ignored.
/// REQUIRES: source and its bytes outlive the HDF5 file.
[[nodiscard]] Hdf5Handle access_from(Hdf5Source& source);

}  // namespace mw::io
