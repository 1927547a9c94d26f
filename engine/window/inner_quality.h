// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How good tets around inner vertices stay where the user does not say.
#pragma once

#include "engine/labels/boundary_faces.h"

namespace mw::engine {

/// Radius ratio where interfaces are everywhere (bench/parameters.md, "Constants").
inline constexpr double kInnerQuality = 0.44;
/// Radius ratio where a mesh is mostly of what is far from them (bench/parameters.md, "Constants").
inline constexpr double kSparseInnerQuality = 0.38;

/// MeshSettings::inner_quality for a volume with these faces, all of them.  A function of its
/// labels alone, hence the same for any number of threads and processes.
///
/// Vertices far from interfaces are as many as bricks of 16^3 voxels without a face; those near
/// them are a few in a hundred faces.  Where the first outnumber the second, fewer of them make a
/// mesh of half the size whose shape is about the same (bench/parameters.md); elsewhere less inner
/// quality is seen in the mean at once.
[[nodiscard]] double inner_quality_for(const BoundaryFaces& faces);

}  // namespace mw::engine
