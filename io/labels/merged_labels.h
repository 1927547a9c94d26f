// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What labels are called once some have become others (--merge).
#pragma once

#include <vector>

#include "io/labels/merged_volume.h"

namespace mw::io {

/// Returns the labels that these become by the rules, ascending and each once.
[[nodiscard]] std::vector<RawLabel> merged_labels(std::vector<RawLabel> labels,
                                                  const std::vector<MergeRule>& rules);

}  // namespace mw::io
