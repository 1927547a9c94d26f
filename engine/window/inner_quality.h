// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How good tets around inner vertices have to stay where the user does not say.
#pragma once

#include "engine/labels/boundary_faces.h"

namespace mw::engine {

/// The radius ratio where interfaces are everywhere (bench/parameters.md, "Constants").
inline constexpr double kInnerQuality = 0.44;
/// The radius ratio where most of a mesh is far from them (bench/parameters.md, "Constants").
inline constexpr double kSparseInnerQuality = 0.38;

/// Returns MeshSettings::inner_quality for a volume that has these faces and no others.  It is a
/// function of the labels alone, so any number of threads and processes gives the same.
///
/// There are about as many vertices far from interfaces as bricks of 16^3 voxels without a face,
/// and a few vertices near interfaces for each hundred faces.  Where the first outnumber the
/// second, fewer of them give a mesh of half the size whose shape is about the same
/// (bench/parameters.md); elsewhere a lower inner quality shows in the mean at once.
[[nodiscard]] double inner_quality_for(const BoundaryFaces& faces);

}  // namespace mw::engine
