// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of files that are to survive a power cut.
#pragma once

#include <filesystem>

namespace mw::io {

/// ENSURES: names made, given and removed in this folder before are so on the disk.  File systems
/// that cannot sync a folder say so, and that is not the user's problem: nothing else would help.
void sync_folder(const std::filesystem::path& folder);

}  // namespace mw::io
