// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sizes from the command line and from a table.
#include "engine/cli/size_options.h"

#include <algorithm>
#include <span>

#include "engine/cli/values.h"
#include "io/file/errors.h"
#include "io/file/open_bytes.h"
#include "io/names/csv_records.h"

namespace mw::cli {
namespace {

using engine::LabelSize;

/// Largest table, unpacked.
constexpr std::uint64_t kMaxTableBytes = 64 << 20;

LabelSize label_size(std::string_view label, std::string_view size) {
  const LabelSize out{parse_label(label), parse_number(size)};
  if (out.longest_edge > 0.0) return out;
  throw Error(ErrorKind::kUsage, "a size must be positive, got '" + std::string(size) + "'");
}

std::string read_table(const std::filesystem::path& path) {
  const std::unique_ptr<io::ByteSource> source = io::open_bytes(path);
  if (auto content = io::read_whole(*source, kMaxTableBytes)) return *std::move(content);
  io::fail_input(source->name(), {},
                 io::text("is no table of sizes: it has more than ", kMaxTableBytes, " bytes"),
                 "give a line label,size for each label");
}

void sort_by_label(std::vector<LabelSize>& sizes) {
  std::sort(sizes.begin(), sizes.end(),
            [](const LabelSize& a, const LabelSize& b) { return a.label < b.label; });
  const auto twice =
      std::adjacent_find(sizes.begin(), sizes.end(),
                         [](const LabelSize& a, const LabelSize& b) { return a.label == b.label; });
  if (twice == sizes.end()) return;
  throw Error(ErrorKind::kUsage,
              io::text("--size, --size-file: label ", twice->label, " has two sizes"));
}

}  // namespace

void add_size_options(OptionSet& options, SizeRequest& request) {
  options.add({.name = "size",
               .value = "LABEL=H,..",
               .help = "edges of these labels' tets are no longer than H, physical units; not "
                       "below the diagonal of a voxel of the lattice",
               .assign = [&](const std::string& text) {
                 request.labels = text.empty() ? std::vector<LabelSize>{} : parse_sizes(text);
               }});
  options.add({.name = "size-file",
               .value = "FILE.csv",
               .help = "more of the same: a line label,size each",
               .assign = [&](const std::string& text) { request.file = text; }});
  options.add({.name = "gradation",
               .value = "G",
               .help = "limits on edges grow by G times the distance to those labels, 0 to 10; 0: "
                       "the least holds everywhere [0.5]",
               .kind = ValueKind::kNumber,
               .assign = [&](const std::string& text) {
                 if (!text.empty()) request.gradation = parse_number(text);
               }});
  options.add(
      {.name = "inner-vertices",
       .help = "gives tets with all corners on interfaces a vertex inside their label, where "
               "the quality floor allows it; those of the labels of --size, else all",
       .kind = ValueKind::kSwitch,
       .fallback = "false",
       .assign = [&](const std::string& text) { request.inner_vertices = parse_switch(text); }});
}

std::vector<LabelSize> parse_sizes(std::string_view text) {
  std::vector<LabelSize> out;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view part = text.substr(begin, end - begin);
    const std::size_t equals = part.find('=');
    if (equals == part.npos) {
      throw Error(ErrorKind::kUsage, "expected LABEL=H, got '" + std::string(part) + "'");
    }
    out.push_back(label_size(part.substr(0, equals), part.substr(equals + 1)));
    begin = end + 1;
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
      io::fail_input(file, line, io::text("has ", fields.size(), " values"),
                     "write label,size in each line");
    }
    try {
      out.push_back(label_size(fields[0], fields[1]));
    } catch (const Error& error) {
      io::fail_input(file, line, error.what(), "write label,size in each line");
    }
  }
  if (out.empty()) io::fail_input(file, {}, "has no sizes", "write label,size in each line");
  return out;
}

engine::SizeSettings size_settings(const SizeRequest& request) {
  engine::SizeSettings out{.labels = request.labels, .inner_vertices = request.inner_vertices};
  if (!request.file.empty()) {
    const auto more = parse_size_table(read_table(request.file), request.file.string());
    out.labels.insert(out.labels.end(), more.begin(), more.end());
  }
  sort_by_label(out.labels);
  if (!request.gradation) return out;
  if (out.labels.empty()) {
    throw Error(ErrorKind::kUsage, "--gradation: there is nothing to grade, give --size as well");
  }
  out.gradation = *request.gradation;
  return out;
}

}  // namespace mw::cli
