// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Keyword and data lines of an Abaqus input file.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/byte_cursor.h"

namespace mw::io {

/// A keyword line with what follows it on further lines, or a data line.
struct InpLine {
  std::string keyword;                        ///< "ELEMENT", in capitals; empty: a data line
  std::map<std::string, std::string> values;  ///< of a keyword: "ELSET" to "Bone", "GENERATE" to ""
  std::vector<std::string> items;             ///< of a data line, without blanks at their ends
};

/// ERRORS of all: mw::Error(kInput) with file and line.
class InpLines {
 public:
  /// comment: gets each comment line as it stands.
  InpLines(const ByteSource& source, std::function<void(std::string_view)> comment)
      : cursor_(source), comment_(std::move(comment)) {}

  /// False at the end of the file.
  [[nodiscard]] bool next(InpLine& line);
  [[nodiscard]] std::uint64_t integer(std::string_view item, std::string_view expected) const;
  /// Finite; the exponent may be that of Fortran, "1.5D3".
  [[nodiscard]] double real(std::string_view item) const;
  [[noreturn]] void fail(std::string_view reason) const;

 private:
  bool read();
  void read_keyword(InpLine& line);

  ByteCursor cursor_;
  std::function<void(std::string_view)> comment_;
  std::string text_;
  std::uint64_t line_ = 1;  ///< of text_
};

[[nodiscard]] std::string in_capitals(std::string_view text);

}  // namespace mw::io
