// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which word was meant by a mistyped one.
#include "engine/cli/nearest.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace mw::cli {
namespace {

constexpr std::size_t kMinLetters = 3;

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

std::size_t allowed_edits(std::string_view a, std::string_view b) {
  return std::max<std::size_t>(1, std::max(a.size(), b.size()) / 3);
}

bool may_be_near(std::string_view a, std::string_view b) {
  const std::size_t longer = std::max(a.size(), b.size()), shorter = std::min(a.size(), b.size());
  return longer - shorter <= allowed_edits(a, b);
}

bool begins_with(std::string_view word, std::string_view start) {
  return word.size() >= start.size() && edit_distance(word.substr(0, start.size()), start) == 0;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  using Row = std::vector<std::size_t>;
  Row before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);  // of two, one, no letter less
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const char p = lower(a[i - 1]), q = lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (p == q ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && p == lower(b[j - 2]) && lower(a[i - 2]) == q;
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& words) {
  if (word.size() < kMinLetters) return std::nullopt;
  const std::string* best = nullptr;
  std::size_t fewest = 0;
  for (const std::string& other : words) {
    if (!may_be_near(word, other)) continue;
    const std::size_t edits = edit_distance(word, other);
    if (edits > allowed_edits(word, other) || (best != nullptr && edits >= fewest)) continue;
    best = &other;
    fewest = edits;
  }
  if (best != nullptr) return *best;
  const auto start = std::find_if(words.begin(), words.end(), [&](const std::string& other) {
    return begins_with(other, word);
  });
  return start == words.end() ? std::nullopt : std::optional(*start);
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& words,
                         const std::string& prefix) {
  const std::optional<std::string> meant = nearest(word, words);
  return meant ? "; did you mean " + prefix + *meant + "?" : "";
}

}  // namespace mw::cli
