// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pieces of text as HTML and JSON in HTML want them.
#include "engine/cli/page/html_text.h"

#include <cmath>

#include "engine/cli/options/values.h"

namespace mw::cli {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string script_json(const io::Json& value) {
  std::string out;
  // '<' occurs in strings alone.
  for (const char c : value.dump_ascii()) {
    c == '<' ? out += "\\u003c" : out += c;
  }
  return out;
}

std::string with_commas(std::uint64_t number) {
  std::string out = std::to_string(number);
  for (std::size_t at = out.size(); at > 3; at -= 3) out.insert(at - 3, ",");
  return out;
}

std::string short_number(double value) {
  return value < 1000 ? format_figure(value)
                      : with_commas(static_cast<std::uint64_t>(std::llround(value)));
}

std::string size_text(std::uint64_t bytes) {
  constexpr std::uint64_t kGiB = std::uint64_t{1} << 30U;
  if (bytes < kGiB) return format_bytes(bytes);
  return format_fixed(static_cast<double>(bytes) / static_cast<double>(kGiB), 1) + " GiB";
}

void Base64::add(std::span<const std::byte> bytes) {
  constexpr std::size_t kPiece = 4096;
  for (const std::byte byte : bytes) {
    bits_ = bits_ << 8U | std::to_integer<std::uint32_t>(byte);
    if (++held_ == 3) encode(4);
    if (text_.size() < kPiece) continue;
    append_(text_);
    text_.clear();
  }
}

void Base64::finish() {
  const std::size_t missing = (3 - held_) % 3;
  if (held_ > 0) {
    bits_ <<= 8 * missing;
    encode(4 - missing);
    text_.append(missing, '=');
  }
  append_(text_);
}

/// Appends the first `count` of the four characters that stand for three bytes.
void Base64::encode(std::size_t count) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < count; ++i) text_ += kDigits[bits_ >> (18 - 6 * i) & 63U];
  bits_ = 0;
  held_ = 0;
}

}  // namespace mw::cli
