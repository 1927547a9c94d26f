// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Words that are near others, for those who mistyped one.
#include "engine/settings/number_text.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace mw::engine {
namespace {

std::string lower(std::string_view word) {
  std::string out(word);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// Returns how many letters are added, left out or replaced on the shortest way from a to b.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t before = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = before + (a[i] == b[j] ? 0 : 1);
      before = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, before + 1});
    }
  }
  return row.back();
}

}  // namespace

std::vector<std::string> near_words(std::string_view word, const std::vector<std::string>& words) {
  constexpr std::size_t kLeastBeginning = 3;
  const std::string meant = lower(word);
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const std::string& known : words) {
    const std::string other = lower(known);
    const bool begins = std::min(meant.size(), other.size()) >= kLeastBeginning &&
                        (other.starts_with(meant) || meant.starts_with(other));
    const std::size_t off = distance(meant, other);
    // Two letters that changed places count as two that are replaced.
    if (begins || off <= std::max<std::size_t>(meant.size() / 3, 2)) near.emplace_back(off, known);
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> out;
  for (auto& [off, known] : near) out.push_back(std::move(known));
  return out;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& words) {
  const std::vector<std::string> near = near_words(word, words);
  return near.empty() ? "" : "; did you mean " + near.front() + "?";
}

}  // namespace mw::engine
