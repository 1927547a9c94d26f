// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The names of the files that a MetaImage header lists or makes from a pattern.
#include "io/volume/metaimage/open_metaimage.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/volume/numbered_name.h"

namespace mw::io {
namespace {

constexpr const char* kField = "MetaImage field 'ElementDataFile'";

std::vector<std::string> names_of_pattern(const std::vector<std::string_view>& words,
                                          std::int64_t count, std::string_view file) {
  const NumberedName pattern(words[0], file, kField);
  std::vector<std::int64_t> numbers{1, 0, 1};  // first, last, step
  for (std::size_t i = 1; i < words.size() && i < 4; ++i) {
    const auto number = parse_integer(words[i]);
    constexpr std::int64_t kMax = 1'000'000'000;
    if (!number || *number < 0 || *number > kMax) {
      fail_input(file, kField, text("'", words[i], "' is no number of a slice"));
    }
    numbers[i - 1] = *number;
  }
  const std::int64_t last = numbers[0] + (count - 1) * numbers[2];
  if (words.size() > 2 && numbers[1] != last) {
    fail_input(file, kField,
               text(count, " slices from ", numbers[0], " in steps of ", numbers[2], " end at ",
                    last, ", not at ", numbers[1]),
               "correct the range or DimSize");
  }
  std::vector<std::string> names;
  for (std::int64_t i = 0; i < count; ++i) {
    names.push_back(pattern.with(numbers[0] + i * numbers[2]));
  }
  return names;
}

std::vector<std::string> names_of_list(std::string_view lines, std::int64_t count,
                                       std::string_view file) {
  std::vector<std::string> names;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    const std::string_view line = trimmed(lines.substr(0, end));
    if (!line.empty()) names.emplace_back(line);
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
  if (names.size() != static_cast<std::size_t>(count)) {
    fail_input(file, kField,
               text("the list has ", names.size(), " files, the volume ", count, " slices"),
               "list one file a slice");
  }
  return names;
}

}  // namespace

bool names_many_files(std::string_view data_file) {
  const auto words = words_of(data_file);
  return (!words.empty() && words[0] == "LIST") || data_file.find('%') != std::string_view::npos;
}

std::vector<std::string> slice_names(std::string_view data_file, std::string_view behind_header,
                                     std::int64_t count, std::string_view file) {
  const auto words = words_of(data_file);
  if (words[0] != "LIST") return names_of_pattern(words, count, file);
  if (words.size() > 1 && !words[1].starts_with('2')) {
    fail_input(file, kField, text("files of ", words[1], " axes are not supported"),
               "list one file a slice");
  }
  return names_of_list(behind_header, count, file);
}

}  // namespace mw::io
