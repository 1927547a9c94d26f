// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Makes any bytes a name that every output can hold.
#include "io/names/clean_name.h"

namespace mw::io {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

/// One character at the beginning of the bytes; length 0: they are no UTF-8.
struct Character {
  char32_t code = 0;
  std::size_t length = 0;
};

/// By RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF.
Character first_character(std::string_view bytes) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || bytes.size() < length) return {};
  char32_t code = first & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return {};
    code = code << 6U | (byte(i) & 0x3FU);
  }
  const char32_t min = length == 4 ? 0x10000 : length == 3 ? 0x800 : 0x80;
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < min || code > 0x10FFFF || is_surrogate) return {};
  return {code, length};
}

bool is_control(char32_t code) {
  constexpr char32_t kLineSeparator = 0x2028, kParagraphSeparator = 0x2029;
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == kLineSeparator ||
         code == kParagraphSeparator;
}

/// What stands for the character in a name.
std::string_view clean_character(std::string_view bytes, const Character& c) {
  if (c.length == 0 || c.code == 0xFFFE || c.code == 0xFFFF) return kReplacement;
  return is_control(c.code) ? " " : bytes.substr(0, c.length);
}

}  // namespace

std::string clean_name(std::string_view bytes) {
  std::string out;
  while (!bytes.empty()) {
    const Character c = first_character(bytes);
    const std::string_view clean = clean_character(bytes, c);
    bytes.remove_prefix(c.length == 0 ? 1 : c.length);
    if (out.empty() && clean == " ") continue;
    if (out.size() + clean.size() > kMaxNameBytes) break;
    out.append(clean);
  }
  out.resize(out.find_last_not_of(' ') + 1);  // npos + 1 is 0
  return out;
}

}  // namespace mw::io
