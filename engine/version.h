// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which version of mwmesh this is.
#pragma once

namespace mw::engine {

/// "MAJOR.MINOR.PATCH" of CMakeLists.txt.
[[nodiscard]] const char* version();

}  // namespace mw::engine
