// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Longest edges of labels from text and back.
#include "engine/settings/size_text.h"

#include <algorithm>

#include "engine/settings/number_text.h"
#include "io/file/errors.h"

namespace mw::engine {

LabelSize parse_label_size(std::string_view label, std::string_view size) {
  const LabelSize out{parse_label(label), parse_number(size)};
  if (out.longest_edge > 0.0) return out;
  throw Error(ErrorKind::kUsage, io::text("a size must be positive, got '", size, "'"));
}

std::vector<LabelSize> parse_sizes(std::string_view text) {
  std::vector<LabelSize> out;
  if (text.empty()) return out;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view part = text.substr(begin, end - begin);
    const std::size_t equals = part.find('=');
    if (equals == part.npos) fail_expected("LABEL=H", part);
    out.push_back(parse_label_size(part.substr(0, equals), part.substr(equals + 1)));
    begin = end + 1;
  }
  sort_sizes(out);
  return out;
}

void sort_sizes(std::vector<LabelSize>& sizes) {
  std::sort(sizes.begin(), sizes.end(),
            [](const LabelSize& a, const LabelSize& b) { return a.label < b.label; });
  const auto twice =
      std::adjacent_find(sizes.begin(), sizes.end(),
                         [](const LabelSize& a, const LabelSize& b) { return a.label == b.label; });
  if (twice == sizes.end()) return;
  throw Error(ErrorKind::kUsage, io::text("label ", twice->label, " has two sizes"));
}

std::string format_sizes(const std::vector<LabelSize>& sizes) {
  std::string out;
  for (const LabelSize& s : sizes) {
    out += io::text(out.empty() ? "" : ",", s.label, "=", s.longest_edge);
  }
  return out;
}

}  // namespace mw::engine
