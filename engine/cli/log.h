// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where log lines go.
#pragma once

#include <string>

namespace mw::cli {

/// Log lines go to stderr from this level on: debug, info, warn, error, off.
void start_log(const std::string& level);

}  // namespace mw::cli
