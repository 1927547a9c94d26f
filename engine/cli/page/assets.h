// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Files that are part of the program (CMakeLists.txt turns them into strings).
#pragma once

namespace mw::cli {

extern const char* const kPageStyle;   ///< page.css
extern const char* const kPageScript;  ///< viewer.js

}  // namespace mw::cli
