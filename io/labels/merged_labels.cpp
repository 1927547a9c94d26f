// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What labels are called once some have become others.
#include "io/labels/merged_labels.h"

#include <algorithm>

namespace mw::io {

std::vector<RawLabel> merged_labels(std::vector<RawLabel> labels,
                                    const std::vector<MergeRule>& rules) {
  for (RawLabel& label : labels) {
    const auto rule = std::find_if(rules.begin(), rules.end(), [&](const MergeRule& r) {
      return std::find(r.from.begin(), r.from.end(), label) != r.from.end();
    });
    if (rule != rules.end()) label = rule->to;
  }
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

}  // namespace mw::io
