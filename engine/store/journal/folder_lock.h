// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whose a folder is: the file `lock` in it says that a run made it, and that nobody else is there.
#pragma once

#include <filesystem>
#include <optional>

#include "io/file/file_descriptor.h"

namespace mw::engine {

inline constexpr const char* kLockFile = "lock";

/// True if files in the folder are those of a run: lock_folder() has locked it at some time, or it
/// holds nothing yet, except perhaps a lock that is about to be marked.  In another folder files
/// are somebody else's, whatever their names are.
[[nodiscard]] bool is_of_runs(const std::filesystem::path& folder);

/// Locks the folder (flock) until the descriptor is closed, and marks it durably for is_of_runs().
/// Returns nothing when another process holds the lock, and an invalid descriptor when a run that
/// has just ended removed folder or lock meanwhile.
/// ERRORS: mw::Error(kResource, kUsage) when the file cannot be written.
[[nodiscard]] std::optional<io::FileDescriptor> lock_folder(const std::filesystem::path& folder);

}  // namespace mw::engine
