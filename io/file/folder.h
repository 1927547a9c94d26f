// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lists folders.  The iterator of std::filesystem ends the process where memory is out while it
// goes on, which a library must not do to its caller.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace mw::io {

/// Returns the names of all that a folder holds, without "." and "..", in the order of their bytes.
/// ENSURES: `error` is clear, or says why the folder could not be read to its end; then the names
/// are those that were read.
/// ERRORS: std::bad_alloc.
[[nodiscard]] std::vector<std::string> entries_in(const std::filesystem::path& folder,
                                                  std::error_code& error);

/// Returns entries_in(folder).  ERRORS: mw::Error(kInput) where the folder cannot be read.
[[nodiscard]] std::vector<std::string> entries_in(const std::filesystem::path& folder);

}  // namespace mw::io
