// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Longest edges of labels from text and back.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/settings/settings.h"

namespace mw::engine {

/// "7=4,1=2.5", ascending by label; nothing of an empty text.  "@FILE", alone or between those, is
/// a table of such sizes.
/// ERRORS: mw::Error(kUsage) saying what was expected, and for a label that has two sizes; those of
///         reading the file, and of parse_size_table().
[[nodiscard]] std::vector<LabelSize> parse_sizes(std::string_view text);

/// The files that are named in it.
[[nodiscard]] std::vector<std::string> size_tables(std::string_view text);

/// Lines "label,size" of a table (CsvRecords); the first may be a header.
/// ERRORS: mw::Error(kInput) naming file and line.
[[nodiscard]] std::vector<LabelSize> parse_size_table(std::string_view text, std::string_view file);

/// What parse_sizes() reads back as the same, without any file.
[[nodiscard]] std::string format_sizes(const std::vector<LabelSize>& sizes);

}  // namespace mw::engine
