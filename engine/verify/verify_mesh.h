// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Promises P1 to P4 and P8 of a mesh of any size, on many threads (`mwmesh verify`).
#pragma once

#include "engine/verify/mesh_tiles.h"
#include "engine/verify/verify_task.h"

namespace mw::engine {

/// A tile of the mesh, then a tile of the volume with what is near it, is all that a thread has in
/// memory.
/// Memory: besides, 24 bytes a part of a label in a tile, and 8 for each other one that it touches;
/// where interfaces are counted, 4 a part of one that goes on in another tile.
/// ENSURES: the report depends on mesh and volume only, but for distances farther than memory lets
/// it look (DistanceReport::far_samples); sums are rounded in the order of the tiles.
/// ERRORS: kResource when a temporary file cannot be written.
/// REQUIRES: mesh is finished, and of that volume.
[[nodiscard]] audit::AuditReport verify_mesh(const io::DenseVolume& volume, const MeshTiles& mesh,
                                             const VerifyTask& task);

}  // namespace mw::engine
