// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lets the HDF5 library write into an AtomicFile.
#pragma once

#include <exception>

#include "io/file/atomic_file.h"
#include "io/hdf5/hdf5_handle.h"

namespace mw::io {

/// Where an HDF5 file goes, and the first error on the way.  The library cannot carry our errors
/// and does not recover from a write that failed (it keeps the file open for ever), so after an
/// error it is told that all went well, and whoever called it must look here.
struct Hdf5Target {
  AtomicFile* file = nullptr;
  std::exception_ptr failure;

  /// ERRORS: that of the first write that failed.
  void check() const {
    if (failure) std::rethrow_exception(failure);
  }
};

/// A file access property list for H5Fcreate, whose file name is then ignored.
/// REQUIRES: target and its file outlive the HDF5 file.
[[nodiscard]] Hdf5Handle access_through(Hdf5Target& target);

}  // namespace mw::io
