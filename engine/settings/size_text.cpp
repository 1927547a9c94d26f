// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Longest edges of labels from text and back.
#include "engine/settings/size_text.h"

#include <algorithm>

#include "engine/settings/number_text.h"
#include "io/file/errors.h"
#include "io/file/source/inflated_source.h"
#include "io/names/csv_names.h"

namespace mw::engine {
namespace {

/// Largest table, unpacked.
constexpr std::uint64_t kMaxTableBytes = 64 << 20;
constexpr const char* kAdvice = "write label,size in each line";

std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> out;
  for (std::size_t begin = 0; begin <= text.size() && !text.empty();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    out.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return out;
}

LabelSize parse_label_size(std::string_view label, std::string_view size) {
  const LabelSize out{parse_label(label), parse_number(size)};
  if (out.longest_edge > 0.0) return out;
  throw Error(ErrorKind::kUsage, io::text("a size must be positive, got '", size, "'"));
}

std::vector<LabelSize> read_size_table(std::string_view file) {
  const std::unique_ptr<io::ByteSource> source = io::open_bytes(std::filesystem::path(file));
  if (const auto content = io::read_whole(*source, kMaxTableBytes)) {
    return parse_size_table(*content, file);
  }
  io::fail_input(source->name(), {},
                 io::text("is no table of sizes: it has more than ", kMaxTableBytes, " bytes"),
                 kAdvice);
}

/// ENSURES: ascending by label.
void sort_sizes(std::vector<LabelSize>& sizes) {
  std::sort(sizes.begin(), sizes.end(),
            [](const LabelSize& a, const LabelSize& b) { return a.label < b.label; });
  const auto twice =
      std::adjacent_find(sizes.begin(), sizes.end(),
                         [](const LabelSize& a, const LabelSize& b) { return a.label == b.label; });
  if (twice == sizes.end()) return;
  throw Error(ErrorKind::kUsage, io::text("label ", twice->label, " has two sizes"));
}

}  // namespace

std::vector<LabelSize> parse_sizes(std::string_view text) {
  std::vector<LabelSize> out;
  for (const std::string_view part : parts_of(text)) {
    if (part.starts_with('@')) {
      const std::vector<LabelSize> listed = read_size_table(part.substr(1));
      out.insert(out.end(), listed.begin(), listed.end());
      continue;
    }
    const std::size_t equals = part.find('=');
    if (equals == part.npos) fail_expected("LABEL=H", part);
    out.push_back(parse_label_size(part.substr(0, equals), part.substr(equals + 1)));
  }
  sort_sizes(out);
  return out;
}

std::vector<std::string> size_tables(std::string_view text) {
  std::vector<std::string> out;
  for (const std::string_view part : parts_of(text)) {
    if (part.starts_with('@')) out.emplace_back(part.substr(1));
  }
  return out;
}

std::vector<LabelSize> parse_size_table(std::string_view text, std::string_view file) {
  std::vector<LabelSize> out;
  io::CsvRecords records(text, ',', file);
  io::CsvRecord record;
  for (bool first = true; records.next(record); first = false) {
    const auto& fields = record.fields;
    if (first && fields.size() == 2 && fields[0] == "label" && fields[1] == "size") continue;
    const std::string line = io::text("line ", record.line);
    if (fields.size() != 2) {
      io::fail_input(file, line, io::text("has ", fields.size(), " values"), kAdvice);
    }
    try {
      out.push_back(parse_label_size(fields[0], fields[1]));
    } catch (const Error& error) {
      io::fail_input(file, line, error.what(), kAdvice);
    }
  }
  if (out.empty()) io::fail_input(file, {}, "has no sizes", kAdvice);
  return out;
}

std::string format_sizes(const std::vector<LabelSize>& sizes) {
  std::string out;
  for (const LabelSize& s : sizes) {
    out += io::text(out.empty() ? "" : ",", s.label, "=", s.longest_edge);
  }
  return out;
}

}  // namespace mw::engine
