// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What shape the tets of any start mesh have, told from the spacing alone.
#pragma once

#include "kernels/core/metric.h"

namespace mw {

/// The quality floor that start meshes keep, whatever the labels: the least radius ratio of the
/// tets that they consist of.
///
/// These are finitely many up to their size: the five tets of Sec 5.1 in both patterns, and, when
/// cells may be larger than a voxel, those between a cell's centre and a triangle of one of its
/// faces, for every set of hanging nodes that a face can have.  Cells with an apex on their surface
/// do not matter: cut_cell() takes one only when its tets reach the floor or those of the centre.
/// max_level: as in StartOptions.
/// ENSURES: no tet of graded_start() is below the floor asked of it, if that is at most the result.
/// Cost: some 2,000 tets.
[[nodiscard]] double min_start_ratio(const Metric& metric, int max_level);

}  // namespace mw
