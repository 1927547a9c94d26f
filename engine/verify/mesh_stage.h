// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The first half of a verification: the mesh by itself, tile by tile.
#pragma once

#include "engine/verify/mesh_tiles.h"
#include "engine/verify/piece_buckets.h"
#include "engine/verify/verify_task.h"

namespace mw::engine {

/// What the mesh's tiles told.
struct MeshFindings {
  audit::ValidityTally validity;
  std::optional<audit::Check> overlap;  ///< where labels were left out
  audit::Offenders turned{"tets"};      ///< see audit::changed_orientations()
  std::vector<audit::RegionBetti> betti;
  std::optional<audit::Places> places;  ///< if asked for
  audit::QualityMeter quality;
  audit::ShapeMeter shape;
  audit::VolumeTally volumes;
};

/// Fills pieces with the interface if that is asked for.  validity: what is asked.
/// REQUIRES: mesh.input_check() passed.
[[nodiscard]] MeshFindings look_at_mesh(const MeshTiles& mesh, std::size_t label_count,
                                        const audit::ValidityTask& validity, const VerifyTask& task,
                                        PieceBuckets* pieces);

}  // namespace mw::engine
