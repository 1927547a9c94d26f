// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in formats that have smaller ones.
#include "io/mesh/grouped/label_numbers.h"

#include <algorithm>
#include <set>

#include "io/file/errors.h"
#include "io/file/source/inflated_source.h"
#include "io/mesh/grouped/group_names.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/names/colour_table.h"
#include "io/names/csv_names.h"
#include "kernels/core/elementary.h"

namespace mw::io {
namespace {

bool fits(const LabelTable& table, Label rank, NumberRange range) {
  const RawLabel raw = table.raw(rank);
  const auto number = static_cast<std::int64_t>(raw);
  if (!table.is_signed() && number < 0) return false;  // 2^63 and more
  return number >= range.min && number <= range.max;
}

std::string colour_text(const LabelName* row) {
  if (row == nullptr || !row->colour) return ",,,,";
  std::string out;
  for (const std::uint8_t part : *row->colour) out += text(",", part);
  return out;
}

std::optional<std::int64_t> number_in(const std::string& field) {
  const auto number = label_of(field);
  if (!number) return std::nullopt;
  return static_cast<std::int64_t>(*number);
}

/// Takes one record of a table that append_label_table() made.
void take_record(const CsvRecord& record, std::string_view file, LabelMap& map) {
  const auto label = record.fields.size() < 2 ? std::nullopt : label_of(record.fields[0]);
  const auto number = label ? number_in(record.fields[1]) : std::nullopt;
  if (!number) {
    fail_line(file, record.line, "no label and its number",
              "the table belongs to the mesh beside it; convert that anew, or remove the table");
  }
  if (!map.labels.emplace(*number, *label).second) {
    fail_line(file, record.line, text("number ", *number, " stands for two labels"),
              "convert the mesh anew");
  }
  map.labels_signed = map.labels_signed || record.fields[0].starts_with('-');
}

}  // namespace

LabelNumbers::LabelNumbers(const LabelTable& table, NumberRange range) : numbers_(table.size()) {
  std::set<std::int64_t> taken;
  for (Label rank = 0; rank < table.size(); ++rank) {
    if (fits(table, rank, range)) taken.insert(static_cast<std::int64_t>(table.raw(rank)));
  }
  if (table.size() > static_cast<std::uint64_t>(range.max - range.min) + 1) {
    fail_usage(table.size(), " labels are more than this format has numbers; write .vtkhdf");
  }
  std::int64_t last = taken.empty() ? range.min - 1 : *taken.rbegin();
  std::int64_t low = range.min - 1;
  for (Label rank = 0; rank < table.size(); ++rank) {
    if (fits(table, rank, range)) {
      numbers_[rank] = static_cast<std::int64_t>(table.raw(rank));
      continue;
    }
    if (last < range.max) {
      numbers_[rank] = ++last;
      continue;
    }
    do ++low;
    while (taken.contains(low));
    numbers_[rank] = low;
  }
  if (!numbers_.empty()) largest_ = *std::max_element(numbers_.begin(), numbers_.end());
}

void check_number(std::string_view file, std::uint64_t largest, const NumberLimit& limit) {
  if (largest <= limit.max) return;
  fail_usage(file, ": ", limit.subject, " numbers up to ", limit.max, ", ", largest,
             " are needed; write ", limit.others);
}

void check_rounding(std::string_view file, const Rounding& rounding) {
  if (rounding.loss <= rounding.shortest_edge / 64) return;
  fail_usage(file, ": the format has ", rounding.room, ", too few for edges of ",
             rounding.shortest_edge, " at coordinates of ", rounding.largest, "; ",
             rounding.way_out);
}

void check_digits(std::string_view file, const GroupedMesh& mesh, int digits) {
  const double largest = mesh.largest_coordinate();
  if (largest == 0) return;
  double last_digit = power_of_ten_below(largest);
  for (int i = 1; i < digits; ++i) last_digit /= 10;
  check_rounding(file, {.largest = largest,
                        .shortest_edge = mesh.shortest_edge(),
                        .loss = 0.5 * last_digit,
                        .room = text(digits, " digits"),
                        .way_out = "set --origin nearer to 0, or write .inp, .exo or .vtkhdf"});
}

std::filesystem::path label_table_path(const std::filesystem::path& mesh) {
  return mesh.string() + ".labels.csv";
}

void append_label_table(AtomicFile& file, const LabelTable& table, const MeshHeader& header,
                        const LabelNumbers& numbers) {
  const std::vector<MaskLabels>& masks = header.record.masks;
  file.append(std::string_view("id,number,name,r,g,b,a"));
  for (const MaskLabels& mask : masks) {
    file.append("," + csv_quoted(std::string(kMaskNames) + mask.name));
  }
  file.append(std::string_view("\n"));
  for (Label rank = 0; rank < table.size(); ++rank) {
    const RawLabel label = table.raw(rank);
    file.append(text(label_digits(table, rank), ",", numbers[rank], ",",
                     csv_quoted(header.names.name(label)), colour_text(header.names.find(label))));
    for (const MaskLabels& mask : masks) {
      file.append(mask.has(label) ? ",1" : ",0");
    }
    file.append(std::string_view("\n"));
  }
}

void TabledFile::commit(const GroupedMesh& mesh, const LabelNumbers& numbers) {
  append_label_table(labels_, mesh.table(), mesh.header(), numbers);
  commit_together({labels_, text_});
}

std::optional<LabelMap> read_label_table(const std::filesystem::path& mesh) {
  const std::filesystem::path path = label_table_path(mesh);
  // Where the table cannot be looked at, opening it says why; a name that is too long has none.
  std::error_code failed;
  const auto type = std::filesystem::status(path, failed).type();
  const bool is_too_long = failed == std::errc::filename_too_long;
  if (type == std::filesystem::file_type::not_found || is_too_long) return std::nullopt;
  const std::unique_ptr<ByteSource> source = open_bytes(path);
  constexpr std::uint64_t kMaxBytes = 1 << 30;
  const std::optional<std::string> content = read_whole(*source, kMaxBytes);
  if (!content) {
    fail_input(source->name(), {}, "is too large for a table of labels", "remove it");
  }
  CsvRecords records(*content, ',', source->name());
  LabelMap map;
  CsvRecord record;
  if (!records.next(record)) fail_input(source->name(), {}, "is empty", "convert the mesh anew");
  while (records.next(record)) take_record(record, source->name(), map);
  map.names = parse_csv_names(*content, source->name(), true);
  return map;
}

NumberedLabels::NumberedLabels(const std::filesystem::path& mesh)
    : mesh_(mesh), map_(read_label_table(mesh)) {}

RawLabel NumberedLabels::label(std::int64_t number) {
  negative_ = negative_ || number < 0;
  if (!map_) return static_cast<RawLabel>(number);
  const auto found = map_->labels.find(number);
  if (found != map_->labels.end()) return found->second;
  fail_input(mesh_.string(), "labels",
             text(number, " is not in the table ", label_table_path(mesh_).string()),
             "the table belongs to another mesh; move it away");
}

}  // namespace mw::io
