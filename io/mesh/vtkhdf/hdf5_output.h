// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An HDF5 file that is written, whole or not at all.
#pragma once

#include <filesystem>
#include <string>

#include "io/mesh/vtkhdf/atomic_file_driver.h"

namespace mw::io {

/// No time stamps: equal content is equal bytes.  Thread safety: see Hdf5Handle.
/// ERRORS (all members): mw::Error(kResource) or kUsage as AtomicFile; kResource when the library
/// fails.
class Hdf5Output {
 public:
  /// Makes the file, still without its name.
  explicit Hdf5Output(const std::filesystem::path& path);
  /// Begins its content.
  void open();

  [[nodiscard]] hid_t file() const { return hdf5_.get(); }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Hdf5Handle make_group(hid_t place, const char* name) const;
  /// Throws what went wrong if done is false, or if a write failed before.
  void require(bool done) const;
  void check() const { target_.check(); }
  /// REQUIRES: groups and data sets are closed.
  void commit();

 private:
  std::string name_;
  AtomicFile file_;
  Hdf5Target target_;
  Hdf5Handle hdf5_;
};

/// Properties of a file, group or data set that is made: no time stamps.
[[nodiscard]] Hdf5Handle hdf5_creation(hid_t of_what);

}  // namespace mw::io
