// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Keyword and data lines of an Abaqus input file.
#include "io/mesh/abaqus/inp_lines.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"

namespace mw::io {
namespace {

/// Abaqus allows 256; other tools write more.
constexpr std::size_t kMaxLineBytes = 1 << 20;

/// What commas part, without blanks at the ends.
std::vector<std::string> items_of(std::string_view line) {
  std::vector<std::string> items;
  while (true) {
    const std::size_t comma = line.find(',');
    items.emplace_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return items;
    line.remove_prefix(comma + 1);
  }
}

std::string_view without_quotes(std::string_view value) {
  if (value.size() < 2 || value.front() != '"' || value.back() != '"') return value;
  return value.substr(1, value.size() - 2);
}

}  // namespace

std::string in_capitals(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

/// The next line that is neither blank nor a comment.
bool InpLines::read() {
  do {
    const std::uint64_t line = cursor_.line();
    if (!cursor_.read_line(text_, kMaxLineBytes)) return false;
    line_ = line;
    if (text_.size() == kMaxLineBytes) fail("no line of an input file is that long");
    if (text_.starts_with("**")) comment_(text_);
  } while (text_.starts_with("**") || trimmed(text_).empty());
  return true;
}

bool InpLines::next(InpLine& line) {
  line.keyword.clear();
  line.values.clear();
  line.items.clear();
  if (!read()) return false;
  if (trimmed(text_).starts_with('*')) {
    read_keyword(line);
  } else {
    line.items = items_of(text_);
  }
  return true;
}

/// A comma at its end says that the line goes on.
void InpLines::read_keyword(InpLine& line) {
  std::string whole(trimmed(text_));
  while (whole.ends_with(',') && read()) {
    whole += trimmed(text_);
    if (whole.size() > kMaxLineBytes) fail("no keyword is that long");
  }
  const std::vector<std::string> items = items_of(whole);
  line.keyword = in_capitals(trimmed(std::string_view(items[0]).substr(1)));
  // Without one it would be taken for a line of data, which has items.
  if (line.keyword.empty()) fail("'*' without a keyword");
  for (std::size_t i = 1; i < items.size(); ++i) {
    const std::string_view item = items[i];
    const std::size_t equals = std::min(item.find('='), item.size());
    const std::string_view value = item.substr(std::min(equals + 1, item.size()));
    line.values[in_capitals(trimmed(item.substr(0, equals)))] = without_quotes(trimmed(value));
  }
}

std::uint64_t InpLines::integer(std::string_view item, std::string_view expected) const {
  const auto number = parse_integer(item);
  if (number && *number >= 0) return static_cast<std::uint64_t>(*number);
  fail(text("'", item, "' stands where ", expected, " is expected"));
}

double InpLines::real(std::string_view item) const {
  std::string plain(item);
  for (char& c : plain) {
    if (c == 'd' || c == 'D') c = 'e';
  }
  const auto number = parse_real(plain);
  if (number && std::isfinite(*number)) return *number;
  fail(text("'", item, "' stands where a coordinate is expected"));
}

void InpLines::fail(std::string_view reason) const {
  fail_input(cursor_.source().name(), text("line ", line_), reason,
             "write the mesh anew, as nodes, elements and sets in one file");
}

}  // namespace mw::io
