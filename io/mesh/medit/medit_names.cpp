// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels as comments of a MEDIT .mesh file.
#include "io/mesh/medit/medit_names.h"

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/names/colour_table.h"

namespace mw::io {
namespace {

constexpr std::string_view kWord = "label ";

/// Up to the quote that closes the name; what is behind it stays in `rest`.
std::optional<std::string> take_name(std::string_view& rest) {
  std::string name;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i] == '"') {
      rest.remove_prefix(i + 1);
      return name;
    }
    if (rest[i] == '\\') ++i;
    if (i < rest.size()) name.push_back(rest[i]);
  }
  return std::nullopt;
}

/// Four numbers.
std::optional<Colour> parse_colour(std::string_view numbers) {
  const std::vector<std::string_view> words = words_of(numbers);
  if (words.size() != 4) return std::nullopt;
  Colour colour{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto byte = byte_of(words[i]);
    if (!byte) return std::nullopt;
    colour[i] = *byte;
  }
  return colour;
}

}  // namespace

std::string medit_comment(const LabelName& row, bool is_signed) {
  std::string line = text("# ", kWord);
  if (is_signed) {
    line += text(static_cast<std::int64_t>(row.label));
  } else {
    line += text(row.label);
  }
  line += " \"";
  for (const char c : row.name) {
    if (c == '"' || c == '\\') line += '\\';
    line += c;
  }
  line += '"';
  if (row.colour) {
    for (const std::uint8_t part : *row.colour) line += text(" ", part);
  }
  return line + "\n";
}

std::optional<LabelName> parse_medit_comment(std::string_view comment) {
  comment = trimmed(comment);
  if (!comment.starts_with(kWord)) return std::nullopt;
  const std::size_t quote = comment.find('"');
  if (quote == std::string_view::npos) return std::nullopt;
  const auto label = label_of(comment.substr(kWord.size(), quote - kWord.size()));
  std::string_view rest = comment.substr(quote + 1);
  const auto name = take_name(rest);
  if (!label || !name) return std::nullopt;
  const bool has_colour = !trimmed(rest).empty();
  const auto colour = parse_colour(rest);
  if (has_colour && !colour) return std::nullopt;
  return LabelName{*label, *name, colour};
}

}  // namespace mw::io
