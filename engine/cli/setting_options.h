// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The settings of the engine as options.
#pragma once

#include "engine/cli/option_set.h"
#include "engine/settings/settings.h"

namespace mw::cli {

/// An option for each entry of engine::setting_table(), with the default of MeshSettings.  Each
/// value is checked as it is set, so that errors name its place.
/// REQUIRES: settings outlives options.
void add_setting_options(OptionSet& options, engine::MeshSettings& settings);

}  // namespace mw::cli
