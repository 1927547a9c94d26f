// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The order of numbered names, and the folder that is read in it.
#include "io/volume/slices/slice_folder.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/volume/checks.h"
#include "io/volume/png/open_png.h"
#include "io/volume/tiff/open_tiff.h"

namespace mw::io {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Takes the first run of digits, or of other letters, off the text, and returns it.
std::string_view take_run(std::string_view& rest) {
  const bool digits = is_digit(rest.front());
  const auto end =
      std::find_if(rest.begin(), rest.end(), [&](char c) { return is_digit(c) != digits; });
  const auto length = static_cast<std::size_t>(end - rest.begin());
  const std::string_view run = rest.substr(0, length);
  rest.remove_prefix(length);
  return run;
}

std::string_view without_zeros(std::string_view digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

/// Returns a negative number where a comes before b, 0 where they are equal, else a positive one.
int compare_runs(std::string_view a, std::string_view b) {
  if (!is_digit(a.front()) || !is_digit(b.front())) return a.compare(b);
  a = without_zeros(a);
  b = without_zeros(b);
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  return a.compare(b);
}

std::vector<std::string_view> runs_of(std::string_view name) {
  std::vector<std::string_view> runs;
  while (!name.empty()) runs.push_back(take_run(name));
  return runs;
}

/// Returns the only run in which the names differ, if it is a number in all of them.
std::optional<std::size_t> numbered_run(const std::vector<std::string>& names) {
  const auto first = runs_of(names.front());
  std::optional<std::size_t> found;
  for (const std::string& name : names) {
    const auto runs = runs_of(name);
    if (runs.size() != first.size()) return std::nullopt;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (runs[i] == first[i]) continue;
      if (!parse_integer(runs[i]) || !parse_integer(first[i]) || found.value_or(i) != i) {
        return std::nullopt;
      }
      found = i;
    }
  }
  return found;
}

}  // namespace

bool comes_before(std::string_view a, std::string_view b) {
  std::string_view x = a, y = b;
  while (!x.empty() && !y.empty()) {
    const int order = compare_runs(take_run(x), take_run(y));
    if (order != 0) return order < 0;
  }
  if (x.empty() != y.empty()) return x.empty();
  return a < b;
}

std::filesystem::directory_iterator entries_of(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::directory_iterator found(folder, failure);
  if (!failure) return found;
  fail_input(folder.string(), {}, "cannot list: " + failure.message(), "check the path");
}

std::optional<NumberGap> find_gap(const std::vector<std::string>& names) {
  if (names.size() < 3) return std::nullopt;
  const auto run = numbered_run(names);
  if (!run) return std::nullopt;
  std::vector<std::int64_t> numbers;
  for (const std::string& name : names) numbers.push_back(*parse_integer(runs_of(name)[*run]));
  std::int64_t step = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    step = std::min(step, numbers[i] - numbers[i - 1]);
  }
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    if (numbers[i] - numbers[i - 1] != step) return NumberGap{names[i - 1], names[i]};
  }
  return std::nullopt;
}

namespace {

std::string lower_extension(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

bool is_png(const std::filesystem::path& path) {
  return lower_extension(path) == ".png";
}

bool is_slice(const std::filesystem::directory_entry& entry) {
  const std::filesystem::path& path = entry.path();
  const std::string extension = lower_extension(path);
  std::error_code ignored;
  return (extension == ".tif" || extension == ".tiff" || extension == ".png") &&
         path.filename().string().front() != '.' && entry.is_regular_file(ignored);
}

std::vector<std::string> slice_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : entries_of(folder)) {
    if (is_slice(entry)) names.push_back(entry.path().filename().string());
    if (static_cast<std::int64_t>(names.size()) > kMaxAxisVoxels) {
      fail_input(folder.string(), {}, text("more than ", kMaxAxisVoxels, " slices"),
                 "cut the volume into parts");
    }
  }
  std::sort(names.begin(), names.end(), comes_before);
  return names;
}

void check_names(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  const auto other = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
    return is_png(name) != is_png(names.front());
  });
  if (other != names.end()) {
    fail_input(folder.string(), {},
               text("it holds TIFF and PNG files: ", names.front(), " and ", *other),
               "keep those of one volume in it");
  }
  if (const auto gap = find_gap(names)) {
    fail_input((folder / gap->b).string(), {},
               text("it follows ", gap->a, ", by another step than the others do"),
               "put the missing slice there, or number them in even steps");
  }
}

}  // namespace

bool is_slice_folder(const std::filesystem::path& folder) {
  const auto found = entries_of(folder);
  return std::any_of(begin(found), end(found), is_slice);
}

std::unique_ptr<LabelVolume> open_slice_folder(const std::filesystem::path& folder,
                                               const OpenOptions& options) {
  const std::vector<std::string> names = slice_names(folder);
  check_names(folder, names);
  std::vector<std::filesystem::path> files;
  for (const std::string& name : names) files.push_back(folder / name);
  return is_png(files.front()) ? open_png_slices(std::move(files), options)
                               : open_tiff_slices(std::move(files), options);
}

}  // namespace mw::io
