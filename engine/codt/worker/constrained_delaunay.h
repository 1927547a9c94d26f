// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Constrained Delaunay triangulation by TetGen.
#pragma once

#include "kernels/odt/triangulation.h"

namespace mw::engine::codt {

/// A Triangulate.  It is not thread-safe, and it may crash, hang or end the process.
/// ENSURES: facets are kept as they are, if TetGen does what it promises; the answer does not
///          depend on earlier requests.
[[nodiscard]] std::optional<Triangulation> constrained_delaunay(const Plc& plc);

}  // namespace mw::engine::codt
