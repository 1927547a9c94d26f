// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Area and bends of the interfaces of a finished mesh.
#pragma once

#include <cstddef>
#include <functional>

#include "io/mesh/scratch_mesh.h"
#include "kernels/audit/shape/shape.h"

namespace mw::engine {

/// Measures the triangles between two labels, in double, as they are where no vertex is doubled.
/// Calls between(), which may throw, often.
/// Memory: twice sort_bytes.  Disk: that of the mesh's facets, and 120 bytes a triangle.
/// ERRORS: those of ScratchMesh.
[[nodiscard]] audit::ShapeReport interface_shape(
    io::ScratchMesh& mesh, std::size_t sort_bytes, const std::function<void()>& between = [] {});

}  // namespace mw::engine
