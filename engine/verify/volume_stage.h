// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The second half of a verification: the volume, and how far the mesh is from it, tile by tile.
#pragma once

#include "engine/verify/junction_ledger.h"
#include "engine/verify/tile_grid.h"
#include "engine/verify/verify_mesh.h"
#include "io/labels/label_table.h"

namespace mw::engine {

/// What the volume's tiles told.
struct VolumeFindings {
  std::vector<audit::RegionBetti> betti;
  std::vector<audit::VoxelPinches> pinches;  ///< by dense label
  std::vector<audit::VoxelCount> voxels;     ///< by dense label
  audit::Check place;  ///< see audit::judge_places(); only with MeshInterface::centres
  std::optional<audit::DistanceReport> distance;
};

/// What the volume is compared with, and where what it tells goes.
struct MeshInterface {
  const CentreBuckets* centres = nullptr;  ///< null if there is no mesh
  const PieceBuckets* pieces = nullptr;    ///< null if no distances are asked for
  JunctionLedger* junctions = nullptr;     ///< takes the volume's; null if not asked for
};

/// Looks at each tile of the volume.  ENSURES: the volume's side of mesh.junctions is closed.
[[nodiscard]] VolumeFindings look_at_volume(const io::DenseVolume& volume, const TileGrid& grid,
                                            const VerifyTask& task, const MeshInterface& mesh);

}  // namespace mw::engine
