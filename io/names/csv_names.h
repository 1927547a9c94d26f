// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels in a table of separated values.
// Format: https://www.rfc-editor.org/rfc/rfc4180
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/names/label_names.h"

namespace mw::io {

struct CsvRecord {
  std::size_t line = 0;             ///< where it begins, from 1
  std::vector<std::string> fields;  ///< without quotes, and without blanks around unquoted ones
};

/// Reads records, whose fields in double quotes may hold separators, line ends and, doubled, quotes
/// (RFC 4180).  Lines that are empty or comments (is_comment_line) are skipped, and so is the mark
/// of UTF-8 that spreadsheets put in front of the text.
class CsvRecords {
 public:
  CsvRecords(std::string_view text, char separator, std::string_view file);

  /// Reads the next record into `record`; false when there is none.
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

/// Returns the field in quotes, with those inside doubled; an empty field stays empty.
[[nodiscard]] std::string csv_quoted(std::string_view field);

/// The separator is the first of tab, semicolon and comma that the first row has.  A first row that
/// does not begin with a number names the columns, in any case and order, by titles like these:
///   the label   id, index, value, label value or label;
///   its name    name, region, structure, label name, or label beside an id;
///   its colour  r, g, b (red, ...; a or alpha) from 0 to 255, or from 0 to 1 where there is a
///               point in the number, or color, colour, hex: #rrggbb or #rrggbbaa.
/// Other columns are ignored.  Without such a row the first column is the label, the second its
/// name, and only numbers may follow, which are ignored.  Names with separators in them are in
/// double quotes. ERRORS: mw::Error(kInput) naming file and line, also where a row has more fields
/// than the header,
///         or words behind the name without one; without `repeats`, as mesh files have them, also
///         those of names_of_rows().
[[nodiscard]] LabelNames parse_csv_names(std::string_view text, std::string_view file,
                                         bool repeats = false);

/// Returns the first of tab, semicolon and comma that the first row of the text has, or NUL.
[[nodiscard]] char csv_separator(std::string_view text);

/// Returns the first line that is no comment and not empty; nothing when there is none.
[[nodiscard]] std::string_view first_row(std::string_view text);

}  // namespace mw::io
