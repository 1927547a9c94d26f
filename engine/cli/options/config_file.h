// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Config files: TOML with a key for each option.
#pragma once

#include <filesystem>

#include "engine/cli/requests.h"

namespace mw::cli {

/// Reads a file for these options.  ERRORS: mw::Error(kUsage) naming the file, or line and key.
[[nodiscard]] ConfigTexts read_config(const std::filesystem::path& path, const OptionSet& options);

}  // namespace mw::cli
