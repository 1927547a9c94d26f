// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The source surface of labels that come from scores lies where the scores of two are equal.
#pragma once

#include <cstdint>

#include "io/labels/label_table.h"
#include "io/volume/number_volume.h"
#include "kernels/core/label.h"
#include "kernels/source/source_surface.h"

namespace mw::engine {

/// Returns how many voxels of the lattice a voxel of scores has along each axis.
/// REQUIRES: a volume with scores.
[[nodiscard]] Index3 score_layers(const io::DenseVolume& volume);

/// Finds the crossings of all faces between two labels of a box of the lattice.  Faces whose labels
/// have no scores, or do not follow from the scores, are their own crossings.
/// volume is that of the lattice, whose shape is a multiple of the scores'.  labels are those of
/// the box and a voxel around it, kExterior outside the volume.  Memory: 120 bytes a face, and 16
/// for each voxel of the box and of two around it.  REQUIRES: the volume has scores.
[[nodiscard]] SourceSurface score_crossings(const io::DenseVolume& volume, const LabelBox& labels,
                                            const Box3& box);

/// Returns a hash of all scores.  Cost: they are read once.
[[nodiscard]] std::uint64_t fingerprint(const io::LabelScores& scores);

}  // namespace mw::engine
