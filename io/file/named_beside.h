// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Files that a header names.
#pragma once

#include <filesystem>
#include <string_view>

namespace mw::io {

/// The file `name` in the folder of the header, or below it.
/// ERRORS: mw::Error(kInput) naming the header and its field for names that lead elsewhere
/// (absolute, or with ".."), and for what is no file: a header from a stranger opens nothing else.
[[nodiscard]] std::filesystem::path named_beside(const std::filesystem::path& header,
                                                 std::string_view field, std::string_view name);

}  // namespace mw::io
