// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sizes of edges from text and back.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/settings/settings.h"

namespace mw::engine {

/// Whether a part of such a text is a file of numbers on the grid of the labels, by its ending.
[[nodiscard]] bool names_image(std::string_view part);

/// "7=4,3|5=1,*=2.5": of a label, of the faces between two, of all other labels; "2.5" is "*=2.5".
/// "@FILE", alone or between those, is a table of such sizes.  Nothing of an empty text.
/// ENSURES: ascending.
/// ERRORS: mw::Error(kUsage) saying what was expected, and for what has two sizes; those of reading
///         the file, and of parse_size_table().
[[nodiscard]] SizeRules parse_sizes(std::string_view text);

/// The files that are named in it.
[[nodiscard]] std::vector<std::string> size_tables(std::string_view text);

/// Lines "label,size" of a table (CsvRecords), where a label is what stands before "=" in the text
/// above; the first may be a header.
/// ERRORS: mw::Error(kInput) naming file and line.
[[nodiscard]] SizeRules parse_size_table(std::string_view text, std::string_view file);

/// What parse_sizes() reads back as the same, without any file.
[[nodiscard]] std::string format_sizes(const SizeRules& rules);

}  // namespace mw::engine
