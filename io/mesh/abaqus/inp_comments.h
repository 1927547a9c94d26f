// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Comments that our .inp files have, and other tools skip.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/names/label_names.h"

namespace mw::io {

/// Two lines, "**" in front: the format has no end, so a file that has the first and not the second
/// was cut.
inline constexpr std::string_view kInpBegins = "** This mesh ends with a comment END OF MESH.";
inline constexpr std::string_view kInpEnds = "** END OF MESH";

/// `** label 7 "name" 255 0 0 255`, as in MEDIT files; empty where that is longer than the 256
/// characters that Abaqus allows.
[[nodiscard]] std::string inp_comment(const LabelName& row, bool is_signed);

/// What inp_comment() wrote.
[[nodiscard]] std::optional<LabelName> parse_inp_comment(std::string_view line);

}  // namespace mw::io
