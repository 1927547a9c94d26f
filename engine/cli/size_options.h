// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sizes of labels from a table (--size-file), beside those of --size.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "engine/cli/option_set.h"
#include "engine/settings/settings.h"

namespace mw::cli {

/// --size-file.
void add_size_file_option(OptionSet& options, std::filesystem::path& file);

/// Lines "label,size" of a table (CsvRecords); the first may be a header.
/// ERRORS: mw::Error(kInput) naming file and line.
[[nodiscard]] std::vector<engine::LabelSize> parse_size_table(std::string_view text,
                                                              std::string_view file);

/// Reads the file, if there is one, and adds its sizes.
/// ERRORS: mw::Error(kUsage) when a label has two sizes, or a gradation is given without sizes;
///         those of parse_size_table().
void add_sizes_of_file(const std::filesystem::path& file, engine::SizeSettings& sizes);

}  // namespace mw::cli
