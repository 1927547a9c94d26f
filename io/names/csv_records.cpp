// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The records of a text of separated values.
#include "io/names/csv_records.h"

#include <algorithm>

#include "io/file/text_numbers.h"
#include "io/names/colour_table.h"
#include "io/names/name_fields.h"

namespace mw::io {

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

/// Leaves at_ at the separator or line end behind the field.
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

}  // namespace mw::io
