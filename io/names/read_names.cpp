// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads what labels are called from a file.
#include "io/names/read_names.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/file/source/inflated_source.h"
#include "io/names/colour_table.h"
#include "io/names/csv_names.h"
#include "io/names/json_names.h"

namespace mw::io {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Whether the table is of separated values.  A first line of neither kind counts as one of a
/// colour table, whose reader tells what is wrong with it.
bool is_csv(std::string_view text) {
  return !is_colour_table_line(first_row(text)) && csv_separator(text) != '\0';
}

LabelNames names_of_table(std::string_view text, std::string_view file) {
  if (is_json_object(text)) return parse_json_names(text, file);
  return is_csv(text) ? parse_csv_names(text, file) : parse_colour_table(text, file);
}

}  // namespace

LabelNames parse_names(std::string_view text, std::string_view file, std::string* note) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (text.find('\0') != std::string_view::npos) {
    fail_input(file, {}, "holds binary data or text in UTF-16, no table of names",
               "save it as text in UTF-8");
  }
  if (!is_utf8(text)) {
    if (note != nullptr) *note = io::text(file, ": is not in UTF-8, and is read as Latin-1");
    return parse_names(utf8_of_latin1(text), file);
  }
  LabelNames names = names_of_table(text, file);
  if (!names.empty()) return names;
  fail_input(file, {}, "names no label",
             "give an ITK-SNAP label description, a FreeSurfer or Slicer colour table, CSV with "
             "columns id and name, or nnU-Net's dataset.json");
}

LabelNames read_names(const std::filesystem::path& path, std::string* note) {
  const std::unique_ptr<ByteSource> source = open_bytes(path);
  const std::optional<std::string> content = read_whole(*source, kMaxNamesBytes);
  if (!content) {
    fail_input(source->name(), {},
               text("is no table of names: it has more than ", kMaxNamesBytes, " bytes"),
               "give a table of the labels alone");
  }
  return parse_names(*content, source->name(), note);
}

}  // namespace mw::io
