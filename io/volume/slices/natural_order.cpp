// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The natural order of numbered names, and the gaps in it.
#include "io/volume/slices/slice_folder.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "io/file/text_numbers.h"

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

}  // namespace mw::io
