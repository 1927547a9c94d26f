// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A data set of numbers in an HDF5 file, read by rows.
#pragma once

#include <cstdint>
#include <string>

#include "io/hdf5/hdf5_handle.h"

namespace mw::io {

/// Numbers in one or two dimensions, converted to what the reader asks for.
class Hdf5Array {
 public:
  /// ERRORS of all: mw::Error(kInput) naming file and data set; here when it is missing, no array
  /// of numbers, or announces more than its bytes in the file can hold.
  Hdf5Array(hid_t where, const std::string& path, const std::string& file);

  [[nodiscard]] std::uint64_t rows() const { return rows_; }
  [[nodiscard]] std::uint64_t components() const { return components_; }
  [[nodiscard]] bool is_integer() const { return is_integer_; }
  [[nodiscard]] bool is_signed() const { return is_signed_; }

  /// count * components() numbers.  ERRORS: also when there are fewer rows.
  void read(std::uint64_t first, std::uint64_t count, double* out) const;
  /// REQUIRES of both: is_integer().  Numbers outside the type are clamped.
  void read(std::uint64_t first, std::uint64_t count, std::int64_t* out) const;
  void read(std::uint64_t first, std::uint64_t count, std::uint64_t* out) const;

  [[noreturn]] void fail(const std::string& reason) const;

 private:
  void inspect();
  void check_storage(std::size_t number_bytes) const;
  void read_as(std::uint64_t first, std::uint64_t count, hid_t type, void* out) const;

  std::string file_;
  std::string path_;
  Hdf5Handle set_;
  std::uint64_t rows_ = 0;
  std::uint64_t components_ = 1;
  bool is_integer_ = false;
  bool is_signed_ = false;
};

}  // namespace mw::io
