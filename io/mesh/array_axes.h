// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A vertex in the world, brought back to the axes of the array that it was made from.
#pragma once

#include "io/mesh/mesh_sink.h"
#include "io/volume/volume_space.h"

namespace mw::io {

/// Undoes the space of a volume for a vertex, and returns spacing * corner.  (Where the world sees
/// the array in a mirror, the caller swaps two corners of each tet, so that positive tets stay so.)
/// A vertex that was written from a point of the lattice (1/1024 of a voxel that is cut into
/// `layers`) comes back as that point exactly: it is taken for one when the point's place in the
/// world is the vertex to within rounding, some 10 units in the last place of the largest number
/// that its coordinate is the sum of.  Other vertices come back as the rounded inverse has them.
[[nodiscard]] Position array_position(const VolumeSpace& space, const Position& p, Index3 layers);

}  // namespace mw::io
