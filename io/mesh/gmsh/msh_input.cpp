// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the sections and numbers of a .msh file, from text or from bytes.
#include "io/mesh/gmsh/msh_sections.h"

#include <array>
#include <cmath>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/mesh/mesh_record.h"

namespace mw::io {
namespace {

/// No number is that long; the bound keeps memory small on other files.
constexpr std::size_t kMaxWordBytes = 256;

}  // namespace

void MshInput::set_binary(ByteOrder order) {
  ascii_ = false;
  order_ = order;
}

std::string_view MshInput::next_line(std::string_view expected) {
  do {
    line_ = cursor_.line();
    if (!cursor_.read_line(text_, kMaxRecordBytes)) {
      text_.clear();
      fail_word(expected);
    }
  } while (trimmed(text_).empty());
  return trimmed(text_);
}

std::string MshInput::next_section() {
  while (is_blank(cursor_.peek())) cursor_.take();
  if (cursor_.peek() < 0) return {};
  const std::string_view line = next_line("a section");
  if (!line.starts_with('$') || line.size() < 2) fail("no section begins here");
  return std::string(line.substr(1));
}

void MshInput::end_section(std::string_view section) {
  const std::string expected = text("$End", section);
  if (next_line(expected) != expected) fail(text("no ", expected, " where it should be"));
}

void MshInput::skip_section(std::string_view section) {
  if (!find_end(section)) fail(text("truncated: no $End", section));
}

bool MshInput::find_end(std::string_view section) {
  // This goes by bytes, since a binary section has lines of any length.
  const std::string end = text("\n$End", section);
  std::size_t matched = 1;  // a line begins here
  for (int c = cursor_.peek(); c >= 0; c = cursor_.peek()) {
    cursor_.take();
    if (c == end[matched]) {
      ++matched;
    } else {
      matched = c == '\n' ? 1 : 0;
    }
    if (matched == end.size()) return true;
  }
  return false;
}

std::string_view MshInput::word() {
  while (is_blank(cursor_.peek())) cursor_.take();
  line_ = cursor_.line();
  text_.clear();
  for (int c = cursor_.peek(); c >= 0 && !is_blank(c); c = cursor_.peek()) {
    if (text_.size() == kMaxWordBytes) fail("no number is that long");
    text_.push_back(static_cast<char>(c));
    cursor_.take();
  }
  return text_;
}

template <class T>
T MshInput::from_bytes(std::string_view expected) {
  std::array<std::byte, sizeof(T)> bytes{};
  if (!cursor_.read(bytes)) fail(text("truncated: the file ends where ", expected, " is expected"));
  return load<T>(bytes.data(), order_);
}

std::int64_t MshInput::integer(std::string_view expected) {
  if (!ascii_) return from_bytes<std::int32_t>(expected);
  const auto number = parse_integer(word());
  if (!number) fail_word(expected);
  return *number;
}

std::uint64_t MshInput::count(std::string_view expected) {
  if (!ascii_) return from_bytes<std::uint64_t>(expected);
  const auto number = parse_integer(word());
  if (!number || *number < 0) fail_word(expected);
  return static_cast<std::uint64_t>(*number);
}

double MshInput::real(std::string_view expected) {
  if (ascii_) {
    const auto number = parse_real(word());
    if (!number || !std::isfinite(*number)) fail_word(expected);
    return *number;
  }
  const auto number = from_bytes<double>(expected);
  if (!std::isfinite(number)) fail(text(expected, " is not finite"));
  return number;
}

double MshInput::real_or_nan(std::string_view expected) {
  if (!ascii_) return from_bytes<double>(expected);
  const auto number = parse_real(word());
  if (!number) fail_word(expected);
  return *number;
}

void MshInput::skip_reals(std::int64_t how_many) {
  for (std::int64_t i = 0; i < how_many; ++i) {
    if (ascii_) {
      if (word().empty()) fail_word("a number");
    } else {
      static_cast<void>(from_bytes<double>("a number"));
    }
  }
}

void MshInput::check_rows(std::uint64_t rows, std::uint64_t bytes, std::uint64_t numbers) const {
  const std::uint64_t min = ascii_ ? 2 * numbers : bytes;  // a digit and a blank
  const std::uint64_t wanted = saturating_product(rows, min);
  const std::uint64_t left = cursor_.left(wanted);
  if (wanted <= left) return;
  fail(text(rows, " rows are announced, the ", left, " bytes left cannot hold them"));
}

void MshInput::fail_word(std::string_view expected) const {
  if (text_.empty()) fail(text("truncated: the file ends where ", expected, " is expected"));
  fail(text("'", text_, "' stands where ", expected, " is expected"));
}

void MshInput::fail(std::string_view reason) const {
  const std::string where = ascii_ ? text("line ", line_) : text("byte ", cursor_.offset());
  fail_input(name(), where, reason, "save the mesh anew, as Gmsh's .msh of version 4.1");
}

}  // namespace mw::io
