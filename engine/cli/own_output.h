// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Files of others are not replaced unasked.
#pragma once

#include <filesystem>

namespace mw::cli {

/// Checks that a mesh that is to be replaced is empty or was written by this program.
/// ERRORS: mw::Error(kUsage) naming --force.
void require_own_output(const std::filesystem::path& output);

}  // namespace mw::cli
