// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Nodes of a tet in a file.
#pragma once

#include <cstdint>

namespace mw::io {

enum class Element : std::uint8_t {
  kTet4,   ///< its corners
  kTet10,  ///< and the middles of its edges, on straight edges
};

}  // namespace mw::io
