// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes netCDF files of the classic model.  The library itself is not used, because it crashes
// where memory is refused.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/file/sink/atomic_file.h"

namespace mw::io {

/// A file in netCDF's 64-bit offset form ("CDF-2" of its format specification), which every version
/// of the library reads.  First dimensions, variables and attributes are added, then begin_data()
/// is called, then values are written in any order.  Values that are not written are zeros.
/// Thread safety: none.
/// ERRORS (all members): those of AtomicFile; mw::Error(kUsage) in begin_data() where a variable
/// has more than 4 GiB, which the form cannot hold.
class NetcdfOutput {
 public:
  explicit NetcdfOutput(const std::filesystem::path& path) : name_(path.string()), file_(path) {}

  /// Adds a dimension and returns its id; length is 0 for the one that may grow.
  int add_dimension(const std::string& name, std::uint64_t length);
  /// Add a variable over dimensions that do not grow, and return its id.
  int add_integers(const std::string& name, const std::vector<int>& dimensions);
  int add_doubles(const std::string& name, const std::vector<int>& dimensions);
  int add_texts(const std::string& name, const std::vector<int>& dimensions);

  static constexpr int kWholeFile = -1;
  /// Add an attribute to a variable, or to the whole file (kWholeFile).
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
  struct Attribute {
    std::string name;
    Type type = Type::kText;
    std::uint64_t count = 0;
    std::string bytes;  ///< as in the file, without padding
  };
  struct Dimension {
    std::string name;
    std::uint64_t length = 0;
  };
  struct Variable {
    std::string name;
    Type type = Type::kInteger;
    std::vector<int> dimensions;
    std::vector<Attribute> attributes;
    std::uint64_t bytes = 0;  ///< with padding
    std::uint64_t begin = 0;
  };

  int add_variable(const std::string& name, Type type, const std::vector<int>& dimensions);
  void add(int variable, Attribute attribute);
  [[nodiscard]] std::string header() const;
  void write(int variable, std::uint64_t offset, const std::string& bytes);

  std::string name_;  ///< what errors call the file
  AtomicFile file_;
  std::vector<Dimension> dimensions_;
  std::vector<Variable> variables_;
  std::vector<Attribute> attributes_;  ///< those of the whole file
};

}  // namespace mw::io
