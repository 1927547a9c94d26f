// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which labels a mesh holds.
#pragma once

#include <optional>
#include <vector>

#include "engine/output/label_selection.h"

namespace mw::engine {

struct LabelChoice {
  std::optional<std::vector<RawLabel>> labels;  ///< the only ones that are kept
  std::optional<RawLabel> background;           ///< the one that is not
};

/// ERRORS: mw::Error(kUsage) when both are given.
void check_choice(const LabelChoice& choice);

/// Empty when all labels are kept.
/// ERRORS: mw::Error(kUsage) for a label that the volume does not have, and when none is kept.
[[nodiscard]] WantedLabel wanted_labels(const LabelChoice& choice, const io::LabelTable& table);

}  // namespace mw::engine
