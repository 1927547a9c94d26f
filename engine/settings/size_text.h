// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Longest edges of labels from text and back.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/settings/settings.h"

namespace mw::engine {

/// "7" and "2.5".  ERRORS: mw::Error(kUsage) saying what was expected.
[[nodiscard]] LabelSize parse_label_size(std::string_view label, std::string_view size);

/// "7=4,1=2.5", ascending by label; nothing of an empty text.
/// ERRORS: mw::Error(kUsage) saying what was expected; those of sort_sizes().
[[nodiscard]] std::vector<LabelSize> parse_sizes(std::string_view text);

/// ENSURES: ascending by label.  ERRORS: mw::Error(kUsage) for a label that has two sizes.
void sort_sizes(std::vector<LabelSize>& sizes);

/// What parse_sizes() reads back as the same.
[[nodiscard]] std::string format_sizes(const std::vector<LabelSize>& sizes);

}  // namespace mw::engine
