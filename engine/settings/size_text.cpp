// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sizes of edges from text and back, and materials from text.
#include "engine/settings/size_text.h"

#include <algorithm>

#include "engine/settings/number_text.h"
#include "io/file/errors.h"
#include "io/file/source/inflated_source.h"
#include "io/file/text_numbers.h"
#include "io/names/csv_names.h"

namespace mw::engine {
namespace {

/// The largest table, in unpacked bytes.
constexpr std::uint64_t kMaxTableBytes = 64 << 20;
/// What follows a size in voxels.
constexpr std::string_view kVoxels = "vox";
constexpr const char* kAdvice = "write label,size in each line";

bool has_ending(std::string_view part, std::initializer_list<const char*> endings) {
  return std::any_of(endings.begin(), endings.end(),
                     [&](const char* ending) { return part.ends_with(ending); });
}

/// Returns whether a part of the text is a size alone.
bool is_number(std::string_view part) {
  if (part.ends_with(kVoxels)) part.remove_suffix(kVoxels.size());
  return part.find_first_not_of("0123456789.eE+-") == part.npos;
}

bool names_table(std::string_view part) {
  return part.starts_with('@') && !names_image(part);
}

[[noreturn]] void fail_twice(std::string_view where) {
  io::fail_usage(where, " has two sizes");
}

/// Returns the label of a side of faces; none for "*", which is any label.
std::optional<RawLabel> parse_side(std::string_view text) {
  if (text == "*") return std::nullopt;
  return parse_label(text);
}

/// Returns whether some size is listed, beside an image.
bool lists_sizes(const SizeRules& rules) {
  return rules.others || !rules.labels.empty() || !rules.interfaces.empty();
}

/// Sets the unit of sizes that are added.
void set_unit(SizeRules& rules, bool in_voxels) {
  if (lists_sizes(rules) && rules.in_voxels != in_voxels) {
    io::fail_usage(
        "some sizes are in voxels and others are not; give all of them with vox or none");
  }
  rules.in_voxels = in_voxels;
}

/// Adds the rule of a place, which is "7", "3|5" or "*".
void add_rule(SizeRules& rules, std::string_view where, std::string_view size_text) {
  const SizeText size = parse_size(size_text);
  set_unit(rules, size.in_voxels);
  const std::size_t bar = where.find('|');
  if (where == "*") {
    if (rules.others) fail_twice("*");
    rules.others = size.edge;
  } else if (bar == where.npos) {
    rules.labels.push_back({parse_label(where), size.edge});
  } else {
    const auto [low, high] =
        std::minmax({parse_side(where.substr(0, bar)), parse_side(where.substr(bar + 1))});
    if (low && low == high) fail_expected("two labels", where);
    rules.interfaces.push_back({low, high, size.edge});
  }
}

std::string side_text(const std::optional<RawLabel>& side) {
  return side ? std::to_string(*side) : "*";
}

std::string pair_text(const InterfaceSize& s) {
  return side_text(s.low) + "|" + side_text(s.high);
}

SizeRules read_size_table(std::string_view file) {
  const std::unique_ptr<io::ByteSource> source = io::open_bytes(std::filesystem::path(file));
  if (const auto content = io::read_whole(*source, kMaxTableBytes)) {
    return parse_size_table(*content, file);
  }
  io::fail_input(source->name(), {},
                 io::text("is no table of sizes: it has more than ", kMaxTableBytes, " bytes"),
                 kAdvice);
}

/// Sorts the rules, ascending.  ERRORS: kUsage for a place that is there twice.
void sort_rules(SizeRules& rules) {
  const auto by_label = [](const LabelSize& s) { return s.label; };
  const auto by_pair = [](const InterfaceSize& s) { return std::pair(s.low, s.high); };
  std::ranges::sort(rules.labels, {}, by_label);
  std::ranges::sort(rules.interfaces, {}, by_pair);
  const auto label = std::ranges::adjacent_find(rules.labels, {}, by_label);
  if (label != rules.labels.end()) fail_twice(io::text("label ", label->label));
  const auto pair = std::ranges::adjacent_find(rules.interfaces, {}, by_pair);
  if (pair != rules.interfaces.end()) fail_twice(pair_text(*pair));
}

/// Adds the rules of a table to those beside it.
void join(SizeRules& rules, const SizeRules& more) {
  if (rules.others && more.others) fail_twice("*");
  if (lists_sizes(more)) set_unit(rules, more.in_voxels);
  if (more.others) rules.others = more.others;
  rules.labels.insert(rules.labels.end(), more.labels.begin(), more.labels.end());
  rules.interfaces.insert(rules.interfaces.end(), more.interfaces.begin(), more.interfaces.end());
}

}  // namespace

bool names_image(std::string_view part) {
  return has_ending(part, {".nii", ".nii.gz", ".nrrd", ".nhdr", ".mha", ".mhd", ".npy"});
}

SizeText parse_size(std::string_view text) {
  const bool in_voxels = text.ends_with(kVoxels);
  if (in_voxels) text.remove_suffix(kVoxels.size());
  const double edge = parse_number(text);
  if (edge > 0.0) return {edge, in_voxels};
  io::fail_usage("a size must be positive, got '", text, "'");
}

SizeRules parse_sizes(std::string_view text) {
  SizeRules out;
  if (text.empty()) return out;
  for (const std::string_view part : io::split_at(',', text)) {
    const std::size_t equals = names_image(part) ? part.npos : part.find('=');
    if (names_table(part)) {
      join(out, read_size_table(part.substr(1)));
    } else if (equals != part.npos) {
      add_rule(out, part.substr(0, equals), part.substr(equals + 1));
    } else if (names_image(part)) {
      if (!out.image.empty()) io::fail_usage("sizes come from two images");
      out.image = part.substr(part.starts_with('@') ? 1 : 0);
    } else {
      if (!is_number(part)) fail_expected("H, LABEL=H, A|B=H or a file of sizes", part);
      add_rule(out, "*", part);
    }
  }
  sort_rules(out);
  return out;
}

std::vector<std::string> size_tables(std::string_view text) {
  std::vector<std::string> out;
  for (const std::string_view part : io::split_at(',', text)) {
    if (names_table(part)) out.emplace_back(part.substr(1));
  }
  return out;
}

SizeRules parse_size_table(std::string_view text, std::string_view file) {
  SizeRules out;
  io::CsvRecords records(text, io::csv_separator(text), file);
  io::CsvRecord record;
  for (bool first = true; records.next(record); first = false) {
    const auto& fields = record.fields;
    if (first && fields.size() == 2 && fields[0] == "label" && fields[1] == "size") continue;
    const std::string line = io::text("line ", record.line);
    if (fields.size() != 2) {
      io::fail_input(file, line, io::text("has ", fields.size(), " values"), kAdvice);
    }
    try {
      add_rule(out, fields[0], fields[1]);
    } catch (const Error& error) {
      io::fail_input(file, line, error.what(), kAdvice);
    }
  }
  if (!out.any()) io::fail_input(file, {}, "has no sizes", kAdvice);
  return out;
}

std::string format_sizes(const SizeRules& rules) {
  const std::string_view unit = rules.in_voxels ? kVoxels : "";
  std::string out;
  const auto add = [&out](const auto&... parts) {
    out += io::text(out.empty() ? "" : ",", parts...);
  };
  for (const LabelSize& s : rules.labels) add(s.label, "=", s.edge, unit);
  for (const InterfaceSize& s : rules.interfaces) add(pair_text(s), "=", s.edge, unit);
  if (rules.others) add("*=", *rules.others, unit);
  if (!rules.image.empty()) add("@", rules.image);
  return out;
}

io::MaterialRule parse_materials(std::string_view text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::size_t colon = std::min(text.find(':', equals), text.size());
  const std::size_t second = std::min(text.find(':', colon + 1), text.size());
  if (equals == text.size() || (colon < text.size() && second == text.size())) {
    io::fail_usage("expected NAME=N or NAME=N:LO:HI, got '", text, "'");
  }
  const std::int64_t count = parse_integer(text.substr(equals + 1, colon - equals - 1));
  if (count < 1 || count > io::kMostMaterials) {
    io::fail_usage("expected 1 to ", io::kMostMaterials, " materials");
  }
  io::MaterialRule out{.values = std::string(text.substr(0, equals)),
                       .count = static_cast<std::uint32_t>(count)};
  if (colon == text.size()) return out;
  out.range = {parse_number(text.substr(colon + 1, second - colon - 1)),
               parse_number(text.substr(second + 1))};
  if ((*out.range)[0] < (*out.range)[1]) return out;
  io::fail_usage("the first value of a range is below the last");
}

}  // namespace mw::engine
