// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes netCDF files of the classic model.  The library itself is not used, because it crashes
// where memory is refused.
// Format: https://docs.unidata.ucar.edu/netcdf-c/current/file_format_specifications.html
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/file/scratch/scratch_file.h"
#include "io/file/sink/atomic_file.h"

namespace mw::io {

/// A file in netCDF's 64-bit offset form ("CDF-2" of its format specification), which every version
/// of the library reads.  First dimensions, variables and attributes are added, then begin_data()
/// is called, then values are written in any order.  Values that are not written are zeros.
/// Memory: 17 MiB, however many dimensions and variables there are; what tells of them waits in
/// temporary files.  Thread safety: none.
/// ERRORS (all members): those of AtomicFile and ScratchFile; mw::Error(kUsage) in begin_data()
/// where a variable has more than 4 GiB, which the form cannot hold.
class NetcdfOutput {
 public:
  explicit NetcdfOutput(const std::filesystem::path& path)
      : name_(path.string()),
        file_(path),
        dimensions_(path.parent_path()),
        lengths_(path.parent_path()),
        variables_(path.parent_path()),
        places_(path.parent_path()) {}

  /// Adds a dimension and returns its id; length is 0 for the one that may grow.
  int add_dimension(const std::string& name, std::uint64_t length);
  /// Add a variable over dimensions that do not grow, and return its id.
  int add_integers(const std::string& name, const std::vector<int>& dimensions);
  int add_doubles(const std::string& name, const std::vector<int>& dimensions);
  int add_texts(const std::string& name, const std::vector<int>& dimensions);

  static constexpr int kWholeFile = -1;
  /// Add an attribute to the last variable that was added, or to the whole file (kWholeFile).
  void add_attribute(int variable, const std::string& name, const std::string& value);
  void add_attribute(int variable, const std::string& name, int value);
  void add_attribute(int variable, const std::string& name, float value);

  /// Places the variables and writes what tells of them.
  void begin_data();
  /// Write rows from `first` on; columns is the number of values of a row.
  void put(int variable, std::uint64_t first, std::span<const int> values, std::size_t columns = 1);
  void put(int variable, std::uint64_t first, std::span<const double> values);
  /// Writes a text into a row of max_bytes + 1 characters, cut where it is longer than max_bytes.
  void put_text(int variable, std::uint64_t row, const std::string& value, std::size_t max_bytes);
  /// Give the file its name together with files that belong to it.
  void commit(AtomicFile& beside) { commit_together({beside, file_}); }
  void commit(AtomicFile& beside, AtomicFile& other) { commit_together({beside, other, file_}); }

 private:
  enum class Type : std::uint32_t { kText = 2, kInteger = 4, kFloat = 5, kDouble = 6 };
  /// A list of attributes as in the file, without its head.
  struct Attributes {
    std::size_t members = 0;
    std::string bytes;
  };
  /// A variable to which attributes may still be added.
  struct Variable {
    std::string head;  ///< as in the file up to the attributes
    Attributes attributes{};
    Type type = Type::kInteger;
    std::uint64_t bytes = 0;  ///< with padding
  };
  /// Where a variable is told of, and where its values are.
  struct Place {
    std::uint64_t end_of_head = 0;  ///< in variables_
    std::uint64_t begin = 0;        ///< behind the header of the file
  };

  int add_variable(const std::string& name, Type type, const std::vector<int>& dimensions);
  void add(int variable, const std::string& name, Type type, std::uint64_t count,
           const std::string& bytes);
  void close_variable();
  void write_header();
  void write(int variable, std::uint64_t offset, const std::string& bytes);

  std::string name_;  ///< what errors call the file
  AtomicFile file_;
  ScratchFile dimensions_;  ///< as in the file
  PagedFile<std::uint64_t> lengths_;
  ScratchFile variables_;  ///< as in the file, but without the last word of each, its place
  PagedFile<Place> places_;
  std::optional<Variable> open_;  ///< the last one
  Attributes attributes_;         ///< those of the whole file
  std::uint64_t data_bytes_ = 0;
  std::uint64_t header_bytes_ = 0;
};

}  // namespace mw::io
