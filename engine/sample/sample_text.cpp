// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The text by which users ask for values of images.
#include "engine/sample/sample_text.h"

#include <algorithm>
#include <array>
#include <utility>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"

namespace mw::engine {
namespace {

constexpr std::array<std::pair<Statistic, const char*>, 4> kStatistics{
    {{Statistic::kMean, "mean"},
     {Statistic::kMin, "min"},
     {Statistic::kMax, "max"},
     {Statistic::kMode, "mode"}}};

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_name(std::string_view text) {
  constexpr std::size_t kMostLetters = 31;
  return !text.empty() && text.size() <= kMostLetters && is_letter(text.front()) &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

SampleImage parse_sample(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals + 1 == text.size()) {
    io::fail_usage("expected NAME=FILE or NAME=FILE:mean, got '", text, "'");
  }
  SampleImage out{.name = std::string(text.substr(0, equals)),
                  .file = std::string(text.substr(equals + 1))};
  if (!is_name(out.name)) {
    io::fail_usage("'", out.name,
                   "' is no name for values; a letter and up "
                   "to 30 letters, digits and '_' are");
  }
  for (const auto& [statistic, word] : kStatistics) {
    const std::string ending = io::text(":", word);
    if (!out.file.ends_with(ending)) continue;
    out.file.resize(out.file.size() - ending.size());
    out.statistic = statistic;
    break;
  }
  if (const std::size_t mark = out.file.rfind('#'); mark != std::string::npos) {
    out.dataset = out.file.substr(mark + 1);
    out.file.resize(mark);
  }
  return out;
}

}  // namespace

std::vector<SampleImage> parse_samples(std::string_view text) {
  std::vector<SampleImage> out;
  std::vector<std::string> taken{"label", "cohesive"};
  for (const std::string_view part : io::split_at(';', text)) {
    out.push_back(parse_sample(part));
    const std::string name = io::lower_case(out.back().name);
    if (std::find(taken.begin(), taken.end(), name) != taken.end()) {
      io::fail_usage("the name '", out.back().name, "' is taken");
    }
    taken.push_back(name);
  }
  return out;
}

const char* name(Statistic statistic) {
  return kStatistics[static_cast<std::size_t>(statistic)].second;
}

}  // namespace mw::engine
