// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An id of the sources that decide on results: facts from other sources are not used.
#pragma once

namespace mw::engine {

/// Returns 16 hexadecimal digits, which differ for other sources.  results_id.cmake makes the file
/// that defines it.
[[nodiscard]] const char* results_id();

}  // namespace mw::engine
