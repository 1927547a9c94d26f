// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options that several jobs share: settings, the machine, labels.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/output/label_selection.h"
#include "engine/request/option_set.h"
#include "engine/settings/settings.h"

namespace mw::request {

/// Headings of help.
inline constexpr const char* kInputGroup = "Input";
inline constexpr const char* kLabelGroup = "What to mesh";
inline constexpr const char* kShapeGroup = "Shape and size";
inline constexpr const char* kRunGroup = "Run";
inline constexpr const char* kOutputGroup = "Output";

/// Adds an option for each entry of engine::setting_table(), with the default of MeshSettings, and
/// --preset.  Each value is checked as it is set, so that errors name its place.
/// REQUIRES (all that follow): what is written to outlives options.
void add_setting_options(OptionSet& options, engine::MeshSettings& settings);

/// Adds --memory and --threads.  threads becomes 0 for all cores, and memory stays empty unless
/// given; budget says in the help what the memory is.
void add_resource_options(OptionSet& options, int& threads, std::optional<std::uint64_t>& memory,
                          const std::string& budget);

/// Adds --labels and --background.
void add_choice_options(OptionSet& options, engine::LabelChoice& choice);

}  // namespace mw::request
