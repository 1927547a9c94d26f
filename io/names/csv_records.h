// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The records of a text of separated values.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mw::io {

struct CsvRecord {
  std::size_t line = 0;             ///< where it begins, from 1
  std::vector<std::string> fields;  ///< without quotes, and without blanks around unquoted ones
};

/// Fields in double quotes may hold separators, line ends and, doubled, quotes (RFC 4180).  Lines
/// that are empty or comments (is_comment_line) are skipped.
class CsvRecords {
 public:
  CsvRecords(std::string_view text, char separator, std::string_view file)
      : text_(text), separator_(separator), file_(file) {}

  /// Whether there is another record; it is put into `record`.
  /// ERRORS: mw::Error(kInput) naming file and line when a quote is not closed.
  [[nodiscard]] bool next(CsvRecord& record);

 private:
  void skip_comments();
  [[nodiscard]] std::string next_field();
  [[nodiscard]] std::string quoted_field();

  std::string_view text_;
  char separator_;
  std::string_view file_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

/// The field in quotes, those inside doubled; nothing when it is empty.
[[nodiscard]] std::string csv_quoted(std::string_view field);

}  // namespace mw::io
