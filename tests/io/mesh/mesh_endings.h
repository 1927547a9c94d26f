// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Every format that meshes are written in, for tests that hold for all of them.
#pragma once

#include "io/mesh/open_mesh.h"
#include "tests/testing.h"

namespace mw::io {

/// ".vtkhdf", ".vtu" and so on.  all: what mesh_extensions() or read_mesh_extensions() says.
inline std::vector<std::string> mesh_endings(const std::string& all = mesh_extensions()) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at != all.npos;) {
    const std::size_t end = all.find(", ", at);
    out.push_back(all.substr(at, end == all.npos ? end : end - at));
    at = end == all.npos ? end : end + 2;
  }
  return out;
}

}  // namespace mw::io
