// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How large tets may be in which labels (--size, --size-file, --gradation,
// --inner-vertices).
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/cli/option_set.h"
#include "engine/settings.h"

namespace mw::cli {

struct SizeRequest {
  std::vector<engine::LabelSize> labels;
  std::filesystem::path file;  ///< empty: none
  std::optional<double> gradation;
  bool inner_vertices = false;
};

void add_size_options(OptionSet& options, SizeRequest& request);

/// "1=2.5,7=4".  ERRORS: mw::Error(kUsage) saying what was expected.
[[nodiscard]] std::vector<engine::LabelSize> parse_sizes(std::string_view text);

/// Lines "label,size" of a table (CsvRecords); the first may be a header.
/// ERRORS: mw::Error(kInput) naming file and line.
[[nodiscard]] std::vector<engine::LabelSize> parse_size_table(std::string_view text,
                                                              std::string_view file);

/// Reads the file and puts all together, ascending by label.
/// ERRORS: mw::Error(kUsage) when a label has two sizes, or a gradation is given without sizes;
///         those of parse_size_table().
[[nodiscard]] engine::SizeSettings size_settings(const SizeRequest& request);

}  // namespace mw::cli
