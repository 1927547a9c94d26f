// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels as comments of a MEDIT .mesh file, which other readers skip.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/names/label_names.h"

namespace mw::io {

/// The line `# label 7 "name" 255 0 0 255`, with its end; without the four numbers where the colour
/// is unknown.  In the name `"` and `\` have a `\` in front.
[[nodiscard]] std::string medit_comment(const LabelName& row, bool is_signed);

/// What medit_comment() wrote, from behind the '#' to the end of the line; empty for any other
/// comment.
[[nodiscard]] std::optional<LabelName> parse_medit_comment(std::string_view comment);

}  // namespace mw::io
