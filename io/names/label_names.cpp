// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels, made fit for every output.
#include "io/names/label_names.h"

#include <algorithm>

namespace mw::io {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

/// The character at the beginning of bytes; its length is 0 if they are no UTF-8.
struct Character {
  char32_t code = 0;
  std::size_t length = 0;
};

/// Reads a character of RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF.
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

/// Returns what stands for the character in a name.
std::string_view clean_character(std::string_view bytes, const Character& c) {
  if (c.length == 0 || c.code == 0xFFFE || c.code == 0xFFFF) return kReplacement;
  return is_control(c.code) ? " " : bytes.substr(0, c.length);
}

bool comes_before(const LabelName& a, const LabelName& b) {
  return a.label < b.label;
}

/// Leaves the last row of each label.  REQUIRES: rows of a label are neighbours.
void keep_last_of_each(std::vector<LabelName>& rows) {
  const auto first = std::unique(rows.rbegin(), rows.rend(),
                                 [](const auto& a, const auto& b) { return a.label == b.label; });
  rows.erase(rows.begin(), first.base());
}

}  // namespace

bool is_utf8(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t length = first_character(bytes).length;
    if (length == 0) return false;
    bytes.remove_prefix(length);
  }
  return true;
}

std::string utf8_of_latin1(std::string_view bytes) {
  std::string out;
  for (const char c : bytes) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x80) out += static_cast<char>(0xC0U | code >> 6U);
    out += static_cast<char>(code < 0x80 ? code : 0x80U | (code & 0x3FU));
  }
  return out;
}

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

LabelNames::LabelNames(std::vector<LabelName> rows) {
  for (LabelName& row : rows) {
    row.name = clean_name(row.name);
    if (row.colour == Colour{}) row.colour.reset();
  }
  std::erase_if(rows, [](const LabelName& row) { return row.name.empty() && !row.colour; });
  if (rows.empty()) return;
  std::stable_sort(rows.begin(), rows.end(), comes_before);
  keep_last_of_each(rows);
  rows_ = std::make_shared<const std::vector<LabelName>>(std::move(rows));
}

std::span<const LabelName> LabelNames::rows() const {
  if (!rows_) return {};
  return *rows_;
}

const LabelName* LabelNames::find(RawLabel label) const {
  const auto all = rows();
  const auto found =
      std::lower_bound(all.begin(), all.end(), LabelName{.label = label}, comes_before);
  return found != all.end() && found->label == label ? &*found : nullptr;
}

const std::string& LabelNames::name(RawLabel label) const {
  static const std::string none;
  const LabelName* row = find(label);
  return row == nullptr ? none : row->name;
}

LabelNames LabelNames::merged_with(const LabelNames& others) const {
  if (empty()) return others;
  if (others.empty()) return *this;
  std::vector<LabelName> all(rows().begin(), rows().end());
  for (LabelName row : others.rows()) {
    if (const LabelName* ours = find(row.label)) {
      if (row.name.empty()) row.name = ours->name;
      if (!row.colour) row.colour = ours->colour;
    }
    all.push_back(std::move(row));
  }
  return LabelNames(std::move(all));
}

LabelNames LabelNames::only(const std::function<bool(RawLabel)>& wanted) const {
  std::vector<LabelName> kept;
  for (const LabelName& row : rows()) {
    if (wanted(row.label)) kept.push_back(row);
  }
  return LabelNames(std::move(kept));
}

std::uint64_t LabelNames::bytes() const {
  std::uint64_t sum = 0;
  for (const LabelName& row : rows()) sum += sizeof row + row.name.capacity() + 1;
  return sum;
}

}  // namespace mw::io
