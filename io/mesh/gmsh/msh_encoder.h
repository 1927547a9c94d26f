// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sections and numbers of a .msh 4.1 file, as text or as bytes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/file/sink/atomic_file.h"

namespace mw::io {

/// Numbers are put in rows; text has a line for each, binary (little-endian) nothing between them.
/// ERRORS: see AtomicFile.
class MshEncoder {
 public:
  MshEncoder(const std::filesystem::path& path, bool ascii) : file_(path), ascii_(ascii) {}

  [[nodiscard]] bool ascii() const { return ascii_; }
  /// "$Nodes".
  void begin_section(std::string_view name) { add_line("$", name); }
  /// "$EndNodes".
  void end_section(std::string_view name);
  /// Text in either kind of file.
  void add_line(std::string_view line, std::string_view more = {});

  /// 4 bytes.
  void put(std::int32_t number);
  /// 8 bytes.
  void put(std::uint64_t number);
  void put(double number);
  void end_row();

  /// To be committed with others.
  [[nodiscard]] AtomicFile& file() { return file_; }

 private:
  template <class T>
  void add(T number);

  AtomicFile file_;
  std::string row_;
  bool ascii_;
};

}  // namespace mw::io
