// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// In which tet the centre of each voxel lies.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/audit/subject.h"

namespace mw::audit {

/// Voxels in a row along x whose centres lie in one tet.
struct CentreRun {
  std::uint64_t first = 0;  ///< the first voxel's place in the array of the whole volume
  std::uint32_t count = 0;
  Label label = 0;
};

/// Returns the voxels of a run.  shape is that of the whole volume.
[[nodiscard]] inline Box3 voxels_of(const CentreRun& run, Index3 shape) {
  const auto at = static_cast<std::int64_t>(run.first);
  const Index3 first{at % shape.x, at / shape.x % shape.y, at / shape.x / shape.y};
  return {first, first + Index3{run.count, 1, 1}};
}

/// Finds the centres in the tets that a tile owns and whose labels are below label_count.  shape is
/// that of the whole volume.  Vertices are taken to the nearest point of the lattice, 1/1024 of a
/// voxel that is cut into `layers`; what follows is in whole numbers.  A centre between tets counts
/// for the one on the side of larger x, else y, else z, so that each point of a mesh without
/// overlaps is in one tet.
/// REQUIRES: finite vertices.  Cost: some operations for each tet and row of voxels that it meets.
[[nodiscard]] std::vector<CentreRun> centre_runs(const MeshTile& tile, std::size_t label_count,
                                                 const Frame& frame, Index3 shape, Index3 layers);

/// Returns by voxel of the box the label of the tet that its centre lies in, or kLeftOut.  Where
/// tets overlap it is the least label.  shape is that of the whole volume; runs may go beyond the
/// box.
[[nodiscard]] std::vector<Label> centre_labels(std::span<const CentreRun> runs, const Box3& box,
                                               Index3 shape);

}  // namespace mw::audit
