// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the standard library throws when it cannot look at a file, as an error of ours.
#pragma once

#include <filesystem>

#include "kernels/core/error.h"

namespace mw::engine {

/// Returns an error that names the path: of kInput where the path is to blame (missing, too long, a
/// loop of links, not permitted), else of kResource.
[[nodiscard]] Error file_failure(const std::filesystem::filesystem_error& failure);

}  // namespace mw::engine
