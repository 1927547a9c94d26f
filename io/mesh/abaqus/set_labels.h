// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels of element sets, by their names.
#pragma once

#include <string>
#include <vector>

#include "io/names/label_names.h"

namespace mw::io {

struct SetLabels {
  std::vector<RawLabel> labels;  ///< by set
  bool labels_signed = false;
  LabelNames names;
};

/// The label of LABEL_7 is 7, of LABEL_M7 -7, of any other name the number at its end, if every set
/// has one and no two the same; otherwise labels are 1, 2, .. in the order of sets.  A set that is
/// not called LABEL_7 names its label.  Names may be in any case; "" is of no set.
[[nodiscard]] SetLabels labels_of_sets(const std::vector<std::string>& sets);

}  // namespace mw::io
