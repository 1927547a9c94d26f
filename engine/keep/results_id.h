// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which sources decide on results: facts of other ones are not to be believed.
#pragma once

namespace mw::engine {

/// 16 hexadecimal digits, another number for other sources; the file that has it is made by
/// results_id.cmake.
[[nodiscard]] const char* results_id();

}  // namespace mw::engine
