// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The first half of a verification: the mesh by itself, tile by tile.
#pragma once

#include "engine/verify/junction_ledger.h"
#include "engine/verify/mesh_tiles.h"
#include "engine/verify/tile_grid.h"
#include "engine/verify/verify_mesh.h"
#include "kernels/audit/partition/periodic_faces.h"
#include "kernels/audit/topology/pinches.h"

namespace mw::engine {

/// What the mesh's tiles told.
struct MeshFindings {
  audit::ValidityTally validity;
  std::optional<audit::Check> overlap;  ///< only where labels were left out
  audit::Offenders turned{"tets"};      ///< see audit::changed_orientations()
  std::vector<audit::RegionBetti> betti;
  std::vector<audit::Pinches> pinches;  ///< by dense label
  audit::QualityMeter quality;
  audit::ShapeMeter shape;
  audit::VolumeTally volumes;
  audit::FaceTally faces;  ///< of sides that are to be alike
};

/// Where centres of voxels go, by the tiles of these, and interfaces, if they are asked for.
struct MeshSinks {
  CentreBuckets* centres = nullptr;     ///< never null
  PieceBuckets* pieces = nullptr;       ///< for distances
  JunctionLedger* junctions = nullptr;  ///< null for a mesh with gaps
};

/// Looks at each tile of the mesh; validity says what is asked.  ENSURES: the mesh's side of
/// sinks.junctions is closed.  REQUIRES: mesh.input_check() passed.
[[nodiscard]] MeshFindings look_at_mesh(MeshTiles& mesh, std::size_t label_count,
                                        const audit::ValidityTask& validity, const VerifyTask& task,
                                        const MeshSinks& sinks);

}  // namespace mw::engine
