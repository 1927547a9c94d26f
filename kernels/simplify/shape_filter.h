// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Geometric filters of a contraction: exact positivity, radius ratio floor, edge length variance.
#pragma once

#include "kernels/simplify/contraction.h"
#include "kernels/simplify/simplify.h"

namespace mw {

enum class ShapeVerdict { kGood, kInverted, kLowQuality };

/// Judges the tets that contraction c would leave around the surviving vertex.
/// Positivity is exact and comes first: with it the ambient link condition holds (topology.md D.3)
/// and contractions of Cases 1 and 2 keep every region as a point set.
/// Cost: O(stars); no allocation.
[[nodiscard]] ShapeVerdict judge_shape(const TetMesh& mesh, const Metric& metric,
                                       const Contraction& c, const SimplifyOptions& options);

}  // namespace mw
