// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Area and bends of the interfaces of a finished mesh.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/finish/tet_ranges.h"
#include "io/mesh/scratch_mesh.h"
#include "kernels/audit/shape/shape.h"

namespace mw::engine {

/// Measures the triangles between two labels, in double, as they are where no vertex is doubled.
/// Memory: sort_bytes and kLeastShapeBytes beside what `work` has.  Disk: some 26 bytes a tet.
/// ERRORS: those of ScratchMesh.
[[nodiscard]] audit::ShapeReport interface_shape(io::ScratchMesh& mesh, std::size_t sort_bytes,
                                                 const TetWork& work = {});

inline constexpr std::uint64_t kLeastShapeBytes = std::uint64_t{1} << 20U;

}  // namespace mw::engine
