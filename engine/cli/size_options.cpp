// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sizes of labels from a table (--size-file), beside those of --size.
#include "engine/cli/size_options.h"

#include <span>

#include "engine/settings/size_text.h"
#include "io/file/errors.h"
#include "io/file/source/inflated_source.h"
#include "io/names/csv_names.h"

namespace mw::cli {
namespace {

using engine::LabelSize;

/// Largest table, unpacked.
constexpr std::uint64_t kMaxTableBytes = 64 << 20;

std::string read_table(const std::filesystem::path& path) {
  const std::unique_ptr<io::ByteSource> source = io::open_bytes(path);
  if (auto content = io::read_whole(*source, kMaxTableBytes)) return *std::move(content);
  io::fail_input(source->name(), {},
                 io::text("is no table of sizes: it has more than ", kMaxTableBytes, " bytes"),
                 "give a line label,size for each label");
}

}  // namespace

void add_size_file_option(OptionSet& options, std::filesystem::path& file) {
  options.add({.name = "size-file",
               .value = "FILE.csv",
               .help = "more of --size: a line label,size each",
               .assign = [&](const std::string& text) { file = text; }});
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
      out.push_back(engine::parse_label_size(fields[0], fields[1]));
    } catch (const Error& error) {
      io::fail_input(file, line, error.what(), "write label,size in each line");
    }
  }
  if (out.empty()) io::fail_input(file, {}, "has no sizes", "write label,size in each line");
  return out;
}

void add_sizes_of_file(const std::filesystem::path& file, engine::SizeSettings& sizes) {
  if (!file.empty()) {
    const auto more = parse_size_table(read_table(file), file.string());
    sizes.labels.insert(sizes.labels.end(), more.begin(), more.end());
    try {
      engine::sort_sizes(sizes.labels);
    } catch (const Error& error) {
      throw Error(error.kind(), std::string("--size, --size-file: ") + error.what());
    }
  }
  if (!sizes.labels.empty() || sizes.gradation == engine::SizeSettings{}.gradation) return;
  throw Error(ErrorKind::kUsage, "--gradation: there is nothing to grade, give --size as well");
}

}  // namespace mw::cli
