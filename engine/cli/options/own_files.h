// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which files may be replaced without asking.
#pragma once

#include <filesystem>

namespace mw::cli {

/// Returns whether a file of some bytes is there.
[[nodiscard]] bool is_filled(const std::filesystem::path& path);

/// Returns whether a file of some bytes is there that does not say that this program wrote it.
[[nodiscard]] bool is_foreign(const std::filesystem::path& path);

}  // namespace mw::cli
