// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The masks that a volume was made of, by the labels that their voxels have.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "kernels/core/label.h"

namespace mw::io {

/// A mask that may overlap others: its voxels have one label where no other mask is, and another
/// one for each set of masks that meet there (Overlap::kAll).
struct MaskLabels {
  std::string name;              ///< clean_name(), not empty
  std::vector<RawLabel> labels;  ///< ascending, not empty

  [[nodiscard]] bool has(RawLabel label) const {
    return std::binary_search(labels.begin(), labels.end(), label);
  }

  friend bool operator==(const MaskLabels&, const MaskLabels&) = default;
};

/// Returns the masks with those of their labels for which wanted() is true, without masks that have
/// none of these.
[[nodiscard]] std::vector<MaskLabels> only_masks(const std::vector<MaskLabels>& masks,
                                                 const std::function<bool(RawLabel)>& wanted);

/// Returns the masks after each label that is a key of `becomes` has become the value there.  A
/// mask is left out when one of its labels has become one with a label that is not the mask's, as
/// no set of labels is the mask then.  REQUIRES: the voxels have the labels of these masks and 0.
[[nodiscard]] std::vector<MaskLabels> merged_masks(const std::vector<MaskLabels>& masks,
                                                   const std::map<RawLabel, RawLabel>& becomes);

}  // namespace mw::io
