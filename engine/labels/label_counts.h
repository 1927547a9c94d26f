// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is counted in a volume's labels before windows are visited; parts may be counted apart.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/labels/boundary_faces.h"
#include "engine/labels/reading_tiles.h"
#include "io/labels/label_table.h"

namespace mw::engine {

/// Sums of whole numbers over bricks, each counted once, so that parts add up to the whole.
struct LabelCounts {
  /// Begins with no counts.
  LabelCounts(Index3 shape, std::size_t labels) : faces(shape), voxels(labels) {}

  /// Counts a brick that was read.  mine are the brick's voxels; only is its label if it has just
  /// one.  Thread safety: different bricks may be counted at once.
  void count(Index3 brick, std::span<const Label> mine, std::optional<Label> only);

  BoundaryFaces faces;                ///< shows where there is much to do
  std::vector<std::uint64_t> voxels;  ///< by dense label
};

/// Counts one part of the volume's reading tiles; the number of threads does not change the result.
/// The sum over all parts is what PreparedLabels counts in the whole volume.
/// Memory: 4 MiB a thread, 2 bytes a brick of the volume and 8 a label.
[[nodiscard]] LabelCounts counts_of_part(const io::DenseVolume& volume, int threads,
                                         const SequencePart& part);

}  // namespace mw::engine
