// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Curved tets become straight ones as they are read.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/mesh/mesh_sink.h"
#include "kernels/core/ten_nodes.h"

namespace mw::io {

/// Adds the straight parts of a curved tet; rows are the rows of its ten nodes.
inline void add_parts(std::span<const std::uint64_t, 10> rows, std::vector<TetRows>& out) {
  for (const auto& part : kTetParts) {
    out.push_back({rows[part[0]], rows[part[1]], rows[part[2]], rows[part[3]]});
  }
}

}  // namespace mw::io
