// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in tables of names, and tables that have one label a line.
#include "io/names/colour_table.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"

namespace mw::io {

std::optional<RawLabel> label_of(std::string_view text) {
  text = trimmed(text);
  if (text.ends_with(".0")) text.remove_suffix(2);
  if (!text.starts_with('-')) return parse_count(text);
  const auto below = parse_integer(text);
  if (!below) return std::nullopt;
  return static_cast<RawLabel>(*below);
}

std::optional<double> number_of(std::string_view text) {
  const auto number = parse_real(trimmed(text));
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::uint8_t> byte_of(std::string_view text) {
  const auto number = parse_count(trimmed(text));
  if (!number || *number > 255) return std::nullopt;
  return static_cast<std::uint8_t>(*number);
}

std::optional<std::uint8_t> byte_of_share(double share) {
  if (!(share >= 0 && share <= 1)) return std::nullopt;
  return static_cast<std::uint8_t>(std::lround(255 * share));
}

void fail_line(std::string_view file, std::size_t line, std::string_view reason,
               std::string_view way_out) {
  fail_input(file, text("line ", line), reason, way_out);
}

LabelNames names_of_rows(const std::vector<ReadName>& rows, std::string_view file) {
  std::map<RawLabel, std::size_t> labels;
  std::map<std::string_view, std::size_t> names;
  std::vector<LabelName> out;
  for (const ReadName& row : rows) {
    const auto [label, is_new] = labels.emplace(row.name.label, row.line);
    if (!is_new) {
      fail_line(file, row.line,
                text("label ", static_cast<std::int64_t>(row.name.label), " is in line ",
                     label->second, ", too"),
                "name each label once");
    }
    const auto [name, has_new_name] = names.emplace(row.name.name, row.line);
    if (!has_new_name && !row.name.name.empty()) {
      fail_line(file, row.line,
                text("the name '", row.name.name, "' is in line ", name->second, ", too"),
                "give each label a name of its own");
    }
    out.push_back(row.name);
  }
  return LabelNames(std::move(out));
}

namespace {

struct Row {
  LabelName name;
  std::size_t line = 0;
  bool has_opacity = false;  ///< it has an A from 0 to 255
};

using Words = std::span<const std::string_view>;

std::optional<Colour> colour_of(Words rgb) {
  Colour colour{0, 0, 0, 255};
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const auto byte = byte_of(rgb[i]);
    if (!byte) return std::nullopt;
    colour[i] = *byte;
  }
  return colour;
}

/// Parses IDX R G B A VIS MSH "NAME".
std::optional<Row> parse_snap_line(std::string_view line) {
  const std::size_t quote = line.find('"');
  const std::vector<std::string_view> words = words_of(line.substr(0, quote));
  if (words.size() != 7 || quote + 1 == line.size()) return std::nullopt;
  if (!number_of(words[5]) || !number_of(words[6])) return std::nullopt;
  const auto label = label_of(words[0]);
  auto colour = colour_of(Words(words).subspan(1, 3));
  const auto share = number_of(words[4]);
  const auto opacity = share ? byte_of_share(*share) : std::nullopt;
  if (!label || !colour || !opacity) return std::nullopt;
  (*colour)[3] = *opacity;
  const std::string_view name = line.substr(quote + 1, line.size() - quote - 2);
  return Row{.name = {*label, std::string(name), colour}};
}

/// Whether the last word is the class of a tissue, 1 to 9, behind the A of 0 that FreeSurfer 8 has
/// in some rows of its table.
bool ends_with_tissue(Words words) {
  return words.size() == 7 && number_of(words[2]) && words[5] == "0" && words[6].size() == 1 &&
         words[6][0] >= '1' && words[6][0] <= '9';
}

/// Parses ID NAME R G B A, ID NAME R G B, ID NAME CODE (of the AAL atlas) or ID NAME.
std::optional<Row> parse_table_line(std::string_view line) {
  std::vector<std::string_view> words = words_of(line);
  if (ends_with_tissue(words)) words.pop_back();
  const std::size_t count = words.size();
  const auto label = count < 2 ? std::nullopt : label_of(words[0]);
  if (!label) return std::nullopt;
  if (count == 2 || (count == 3 && number_of(words[2])))
    return Row{.name = {*label, std::string(words[1]), {}}};
  if (count < 5) return std::nullopt;
  const std::size_t numbers = count == 5 ? 3 : 4;
  const auto colour = colour_of(Words(words).last(numbers));
  if (!colour) return std::nullopt;
  const std::string_view last = words[count - numbers - 1];
  const std::string_view name(words[1].data(),
                              static_cast<std::size_t>(last.end() - words[1].begin()));
  return Row{.name = {*label, std::string(name), colour}, .has_opacity = numbers == 4};
}

std::optional<Row> parse_line(std::string_view line) {
  return line.ends_with('"') ? parse_snap_line(line) : parse_table_line(line);
}

/// Whether the table says that it is one of 3D Slicer, by a comment in front of its rows or by its
/// name.
bool is_of_slicer(std::string_view text, std::string_view file) {
  std::string name = lower_case(file);
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  if (name.ends_with(".ctbl")) return true;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = lower_case(trimmed(text.substr(at, end - at)));
    at = end + 1;
    if (!is_comment_line(line)) return false;
    if (line.starts_with("# color table file")) return true;
  }
  return false;
}

/// Whether A is the transparency, as FreeSurfer has it: then most labels have 0, since nobody hides
/// most labels.  The background does not count, which tables of opacities hide.
bool has_transparency(const std::vector<Row>& rows) {
  std::size_t hidden = 0, all = 0;
  for (const Row& row : rows) {
    if (!row.has_opacity || row.name.label == 0) continue;
    ++all;
    if ((*row.name.colour)[3] == 0) ++hidden;
  }
  return 2 * hidden > all;
}

/// Makes opacities of all A.
void turn_transparency(std::vector<Row>& rows) {
  for (Row& row : rows) {
    if (!row.has_opacity) continue;
    std::uint8_t& a = (*row.name.colour)[3];
    a = static_cast<std::uint8_t>(255 - a);
  }
}

}  // namespace

bool is_comment_line(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line.starts_with('#') || line.starts_with("//");
}

bool is_colour_table_line(std::string_view line) {
  return parse_line(trimmed(line)).has_value();
}

LabelNames parse_colour_table(std::string_view text, std::string_view file) {
  std::vector<Row> rows;
  for (std::size_t at = 0, number = 1; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = trimmed(text.substr(at, end - at));
    at = end + 1;
    if (is_comment_line(line)) continue;
    std::optional<Row> row = parse_line(line);
    if (!row) {
      fail_line(file, number, "neither 'ID NAME R G B A' nor 'IDX R G B A VIS MSH \"NAME\"'",
                "colours are whole numbers from 0 to 255, an A in front of VIS is from 0 to 1; "
                "comments begin with #");
    }
    row->line = number;
    rows.push_back(std::move(*row));
  }
  if (!is_of_slicer(text, file) && has_transparency(rows)) turn_transparency(rows);
  std::vector<ReadName> names;
  for (Row& row : rows) names.push_back({std::move(row.name), row.line});
  return names_of_rows(names, file);
}

}  // namespace mw::io
