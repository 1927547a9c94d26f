// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes the sections and numbers of a .msh file, as text or as bytes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/file/sink/atomic_file.h"

namespace mw::io {

/// Puts numbers in rows, each a line in text; binary (little-endian) has nothing between rows.
/// ERRORS: see AtomicFile.
class MshEncoder {
 public:
  MshEncoder(const std::filesystem::path& path, bool ascii)
      : file_(path), name_(path.string()), ascii_(ascii) {}

  [[nodiscard]] bool ascii() const { return ascii_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Adds a line such as "$Nodes".
  void begin_section(std::string_view name) { add_line("$", name); }
  /// Adds a line such as "$EndNodes".
  void end_section(std::string_view name);
  /// Adds a line, which is text in either kind of file.
  void add_line(std::string_view line, std::string_view more = {}) {
    file_.append_line(line, more);
  }

  /// Puts a number, which has 4 bytes in binary.
  void put(std::int32_t number);
  /// Put a number, which has 8 bytes in binary.
  void put(std::uint64_t number);
  void put(double number);
  void end_row();

  /// Returns the file, which is to be committed with others.
  [[nodiscard]] AtomicFile& file() { return file_; }

 private:
  template <class T>
  void add(T number);

  AtomicFile file_;
  std::string name_;
  std::string row_;
  bool ascii_;
};

}  // namespace mw::io
