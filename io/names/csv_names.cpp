// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The records of a text of separated values, and the names in them.
#include "io/names/csv_names.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/names/colour_table.h"

namespace mw::io {

CsvRecords::CsvRecords(std::string_view text, char separator, std::string_view file)
    : text_(text), separator_(separator), file_(file) {
  constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";
  if (text_.starts_with(kUtf8Mark)) text_.remove_prefix(kUtf8Mark.size());
}

void CsvRecords::skip_comments() {
  while (at_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    if (!is_comment_line(text_.substr(at_, end - at_))) return;
    at_ = std::min(end + 1, text_.size());
    ++line_;
  }
}

std::string CsvRecords::quoted_field() {
  const std::size_t first_line = line_;
  std::string field;
  for (++at_; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (c == '\n') ++line_;
    if (c == '"') {
      const bool is_doubled = at_ + 1 < text_.size() && text_[at_ + 1] == '"';
      if (!is_doubled) {
        ++at_;
        return field;
      }
      ++at_;
    }
    field.push_back(c);
  }
  fail_line(file_, first_line, "a quote is not closed",
            "double the quotes that are part of a name");
}

/// Returns a field, and leaves at_ at the separator or line end behind it.
std::string CsvRecords::next_field() {
  const auto ends = [&](char c) { return c == separator_ || c == '\n'; };
  while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  std::string field;
  if (at_ < text_.size() && text_[at_] == '"') field = quoted_field();
  const std::size_t begin = at_;
  while (at_ < text_.size() && !ends(text_[at_])) ++at_;
  return field.append(trimmed(text_.substr(begin, at_ - begin)));
}

bool CsvRecords::next(CsvRecord& record) {
  skip_comments();
  if (at_ >= text_.size()) return false;
  record = {.line = line_, .fields = {}};
  while (true) {
    record.fields.push_back(next_field());
    const bool more = at_ < text_.size() && text_[at_] == separator_;
    ++at_;
    if (!more) break;
  }
  ++line_;
  return true;
}

std::string csv_quoted(std::string_view field) {
  if (field.empty()) return {};
  std::string out = "\"";
  for (const char c : field) {
    out += c;
    if (c == '"') out += c;
  }
  return out + '"';
}

namespace {

using Column = std::optional<std::size_t>;
using Fields = std::vector<std::string>;

struct Columns {
  Column label = 0;
  Column name = 1;
  std::array<Column, 4> rgba;
  Column hex;
};

/// Returns the key of a column; "Label Value" and "label_value" have the same.
std::string column_key(std::string_view title) {
  std::string key;
  for (const char c : title) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0) key.push_back(static_cast<char>(std::tolower(byte)));
  }
  return key;
}

/// Returns the column of the first of the titles that there is.
Column find_column(const Fields& keys, std::initializer_list<const char*> titles) {
  for (const char* title : titles) {
    const auto found = std::find(keys.begin(), keys.end(), title);
    if (found != keys.end()) return static_cast<std::size_t>(found - keys.begin());
  }
  return std::nullopt;
}

Columns columns_of(const CsvRecord& header, std::string_view file) {
  Fields keys;
  for (const std::string& title : header.fields) keys.push_back(column_key(title));
  Columns out;
  out.label = find_column(keys, {"labelvalue", "labelid", "labelindex", "id", "index", "idx",
                                 "value", "key", "number", "no"});
  out.name = find_column(
      keys, {"name", "labelname", "region", "regionname", "structure", "structurename"});
  const Column label = find_column(keys, {"label"});
  if (!out.label) {
    out.label = label;
  } else if (!out.name) {
    out.name = label;
  }
  out.rgba = {find_column(keys, {"r", "red", "colorr", "colourr"}),
              find_column(keys, {"g", "green", "colorg", "colourg"}),
              find_column(keys, {"b", "blue", "colorb", "colourb"}),
              find_column(keys, {"a", "alpha", "opacity", "colora", "coloura"})};
  out.hex = find_column(keys, {"color", "colour", "hex", "hexcolor", "hexcolour", "colorhex",
                               "colourhex", "colorhextriplet"});
  if (!out.label || (!out.name && !out.hex && !out.rgba[0])) {
    fail_line(file, header.line, "no columns of labels and their names",
              "call them id and name; or give rows without a header, label first and name second");
  }
  return out;
}

/// Parses a whole number from 0 to 255, or any from 0 to 1 that has a point in it.
std::optional<std::uint8_t> part_of_colour(const std::string& text) {
  const auto byte = byte_of(text);
  if (byte) return byte;
  const auto number = number_of(text);
  if (!number) return std::nullopt;
  if (*number <= 1) return byte_of_share(*number);
  if (*number > 255 || *number != std::floor(*number)) return std::nullopt;
  return static_cast<std::uint8_t>(*number);
}

/// Parses "#rrggbb" or "#rrggbbaa"; the '#' may be missing.
std::optional<Colour> hex_colour(std::string_view text) {
  if (text.starts_with('#')) text.remove_prefix(1);
  if (text.size() != 6 && text.size() != 8) return std::nullopt;
  Colour colour{0, 0, 0, 255};
  for (std::size_t i = 0; i < text.size(); i += 2) {
    const char* const end = text.data() + i + 2;
    if (std::from_chars(end - 2, end, colour[i / 2], 16).ptr != end) return std::nullopt;
  }
  return colour;
}

/// The rows of one table.
class Table {
 public:
  Table(std::string_view file, const Columns& columns) : file_(file), columns_(columns) {}

  [[nodiscard]] LabelName row(const CsvRecord& record) const {
    const std::string& number = field(record, columns_.label);
    const auto label = label_of(number);
    if (!label) {
      fail_line(file_, record.line, text("'", number.substr(0, 40), "' is no label"),
                "labels are whole numbers, -2^63 to 2^64 - 1");
    }
    return {.label = *label, .name = field(record, columns_.name), .colour = colour(record)};
  }

 private:
  /// Returns a field of a record; an empty one where the record is shorter.
  static const std::string& field(const CsvRecord& record, Column column) {
    static const std::string none;
    return column && *column < record.fields.size() ? record.fields[*column] : none;
  }

  [[nodiscard]] std::optional<Colour> colour(const CsvRecord& record) const {
    if (const std::string& hex = field(record, columns_.hex); !hex.empty()) {
      const auto colour = hex_colour(hex);
      if (!colour) fail_colour(record, hex);
      return colour;
    }
    Colour colour{0, 0, 0, 255};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::string& part = field(record, columns_.rgba[i]);
      if (part.empty() && i < 3) return std::nullopt;
      if (part.empty()) continue;
      const auto byte = part_of_colour(part);
      if (!byte) fail_colour(record, part);
      colour[i] = *byte;
    }
    return colour;
  }

  [[noreturn]] void fail_colour(const CsvRecord& record, const std::string& part) const {
    fail_line(file_, record.line, text("'", part.substr(0, 40), "' is no colour"),
              "colours are #rrggbb, or r, g, b from 0 to 255");
  }

  std::string_view file_;
  Columns columns_;
};

[[noreturn]] void fail_separator(const CsvRecord& record, std::string_view file,
                                 const std::string& reason) {
  fail_line(file, record.line, reason,
            "put names with a separator in them in double quotes, or let a first row name all "
            "columns");
}

/// A record with more fields than the header has a separator in its name, which would be cut there.
/// Empty fields at its end do not count, as programs append such.
void check_width(const CsvRecord& record, std::size_t columns, std::string_view file) {
  std::size_t fields = record.fields.size();
  while (fields > columns && record.fields[fields - 1].empty()) --fields;
  if (fields <= columns) return;
  fail_separator(record, file, text("has ", fields, " fields, and the header ", columns));
}

/// Without a header numbers behind the name are columns of something else, and words are a part of
/// the name.
void check_columns(const CsvRecord& record, std::string_view file) {
  for (std::size_t i = 2; i < record.fields.size(); ++i) {
    const std::string& field = record.fields[i];
    if (field.empty() || number_of(field)) continue;
    fail_separator(record, file, text("has '", field.substr(0, 40), "' behind the name"));
  }
}

/// Returns the separator of a line; NUL when it has none.
char separator_of(std::string_view line) {
  for (const char separator : {'\t', ';', ','}) {
    bool quoted = false;
    for (const char c : line) {
      if (c == '"') quoted = !quoted;
      if (c == separator && !quoted) return separator;
    }
  }
  return '\0';
}

}  // namespace

std::string_view first_row(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    if (!is_comment_line(line)) return line;
    at = end + 1;
  }
  return {};
}

char csv_separator(std::string_view text) {
  return separator_of(first_row(text));
}

LabelNames parse_csv_names(std::string_view text, std::string_view file, bool repeats) {
  CsvRecords records(text, csv_separator(text), file);
  std::vector<ReadName> rows;
  CsvRecord record;
  if (!records.next(record)) return {};
  Columns columns;
  const bool has_header = !label_of(record.fields.front());
  if (has_header) columns = columns_of(record, file);
  const Table table(file, columns);
  const std::size_t width = record.fields.size();
  bool is_row = !has_header;
  while (is_row || records.next(record)) {
    is_row = false;
    if (has_header) {
      check_width(record, width, file);
    } else {
      check_columns(record, file);
    }
    rows.push_back({table.row(record), record.line});
  }
  if (!repeats) return names_of_rows(rows, file);
  std::vector<LabelName> names;
  for (ReadName& row : rows) names.push_back(std::move(row.name));
  return LabelNames(std::move(names));
}

}  // namespace mw::io
