// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Looks through a container of N5 for the array that is meant.
#pragma once

#include <filesystem>
#include <optional>

#include "io/volume/n5/n5_document.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// The folder of the array: options.dataset in the container, or the only array or pyramid that
/// there is; of a pyramid (a group with s0, s1, ...) the level options.scale.
/// ERRORS: mw::Error(kInput) when there is none or several, with their names; kUsage when the
/// options name one that is not there.
[[nodiscard]] std::filesystem::path find_n5_array(const std::filesystem::path& container,
                                                  const OpenOptions& options);

/// The number of a level by the name of its folder, "s2"; empty for other names.
[[nodiscard]] std::optional<std::size_t> level_of(const std::filesystem::path& folder);

}  // namespace mw::io
