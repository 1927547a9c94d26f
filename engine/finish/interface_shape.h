// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Area and bends of the interfaces of a finished mesh.
#pragma once

#include <cstddef>
#include <functional>

#include "io/mesh/scratch_mesh.h"
#include "kernels/audit/shape/shape.h"

namespace mw::engine {

/// Measures the triangles between two labels, in double.  Calls between(), which may throw, often.
/// Memory: twice sort_bytes.  Disk: 128 bytes a tet and 120 an interface triangle.
/// ERRORS: those of ScratchMesh.
[[nodiscard]] audit::ShapeReport interface_shape(
    io::ScratchMesh& mesh, std::size_t sort_bytes, const std::function<void()>& between = [] {});

}  // namespace mw::engine
