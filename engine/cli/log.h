// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lines on stderr that tell how a command goes.  Only log.cpp sees the library that writes them.
#pragma once

#include <string>

namespace mw::cli {

/// Drops the lines below a level (debug, info, warn, error or off) from here on.
void start_log(const std::string& level);

void log_info(const std::string& line);
void log_warning(const std::string& line);

}  // namespace mw::cli
