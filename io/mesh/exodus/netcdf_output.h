// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A netCDF file that is written through the library and gets its name when it is whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/file/sink/atomic_file.h"

namespace mw::io {

/// A file of netCDF's 64-bit offset form, which all versions of the library read.  First dimensions
/// and variables are defined, then begin_data() is called, then values are written in any order.
/// Thread safety: none.
/// ERRORS (all members): mw::Error(kResource) when the disk is full, and kUsage when the path
/// cannot be written or the mesh is too large for the form; both name the file.
class NetcdfOutput {
 public:
  explicit NetcdfOutput(const std::filesystem::path& path);
  ~NetcdfOutput();
  NetcdfOutput(const NetcdfOutput&) = delete;
  NetcdfOutput& operator=(const NetcdfOutput&) = delete;

  /// Returns the id of a dimension.  length: 0 for the one that may grow.
  int add_dimension(const std::string& name, std::uint64_t length);
  /// Return the id of a variable over those dimensions.
  int add_integers(const std::string& name, const std::vector<int>& dimensions);
  int add_doubles(const std::string& name, const std::vector<int>& dimensions);
  int add_texts(const std::string& name, const std::vector<int>& dimensions);

  static constexpr int kWholeFile = -1;
  /// Add an attribute to a variable, or to the whole file (kWholeFile).
  void add_attribute(int variable, const std::string& name, const std::string& value);
  void add_attribute(int variable, const std::string& name, int value);
  void add_attribute(int variable, const std::string& name, float value);

  void begin_data();
  /// Write rows from `first` on.  columns: values of a row.
  void put(int variable, std::uint64_t first, std::span<const int> values, std::size_t columns = 1);
  void put(int variable, std::uint64_t first, std::span<const double> values);
  /// Writes one text; what is longer than max_bytes is cut.
  void put_text(int variable, std::uint64_t row, const std::string& value, std::size_t max_bytes);
  /// Closes the file and gives it its name together with `beside`, a file that belongs to it.
  void commit(AtomicFile& beside);

 private:
  void check(int status) const;
  int add_variable(const std::string& name, int type, const std::vector<int>& dimensions);

  std::string name_;  ///< what errors call the file
  AtomicFile file_;
  int netcdf_ = -1;  ///< the library's id; -1: closed
};

}  // namespace mw::io
