// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Distances between the cubes of a grid.
#pragma once

#include <span>

#include "kernels/core/index.h"
#include "kernels/core/metric.h"

namespace mw {

/// Squared distances from each cube of a grid to the nearest marked one, as closed boxes: 0 for
/// neighbours too.
/// squared: x fastest; 0 at marked cubes, else infinity; replaced by the result, infinity when
/// nothing is marked.  edges: of a cube.
/// Cost: a few comparisons a cube, whatever is marked; one line of scratch.
void spread_squared_gaps(Index3 cubes, const Vec3& edges, std::span<float> squared);

}  // namespace mw
