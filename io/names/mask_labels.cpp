// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The masks that a volume was made of, by the labels that their voxels have.
#include "io/names/mask_labels.h"

#include <algorithm>

#include "kernels/core/sort_distinct.h"

namespace mw::io {
namespace {

/// Returns the labels of the voxels, of which 0 are those without a mask.
std::vector<RawLabel> all_labels(const std::vector<MaskLabels>& masks) {
  std::vector<RawLabel> out{0};
  for (const MaskLabels& mask : masks) {
    out.insert(out.end(), mask.labels.begin(), mask.labels.end());
  }
  sort_distinct(out);
  return out;
}

RawLabel merged_label(RawLabel label, const std::map<RawLabel, RawLabel>& becomes) {
  const auto rule = becomes.find(label);
  return rule == becomes.end() ? label : rule->second;
}

}  // namespace

std::vector<MaskLabels> only_masks(const std::vector<MaskLabels>& masks,
                                   const std::function<bool(RawLabel)>& wanted) {
  std::vector<MaskLabels> out;
  for (MaskLabels mask : masks) {
    std::erase_if(mask.labels, [&](RawLabel label) { return !wanted(label); });
    if (!mask.labels.empty()) out.push_back(std::move(mask));
  }
  return out;
}

std::vector<MaskLabels> merged_masks(const std::vector<MaskLabels>& masks,
                                     const std::map<RawLabel, RawLabel>& becomes) {
  std::vector<MaskLabels> out;
  const std::vector<RawLabel> all = all_labels(masks);
  for (const MaskLabels& mask : masks) {
    MaskLabels merged{mask.name, {}};
    for (const RawLabel label : mask.labels) merged.labels.push_back(merged_label(label, becomes));
    sort_distinct(merged.labels);
    const bool takes_others = std::ranges::any_of(all, [&](RawLabel label) {
      return !mask.has(label) && merged.has(merged_label(label, becomes));
    });
    if (!takes_others) out.push_back(std::move(merged));
  }
  return out;
}

}  // namespace mw::io
