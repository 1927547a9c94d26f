// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tets and volumes of the labels of a finished mesh, in whole numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/finish/tet_ranges.h"
#include "io/labels/label_table.h"
#include "io/mesh/scratch_mesh.h"
#include "io/volume/volume_space.h"
#include "kernels/core/index.h"
#include "kernels/core/lattice.h"

namespace mw::engine {

/// What the volumes of a mesh refer to.  The table outlives the task.
struct VolumesTask {
  const io::LabelTable& table;  ///< labels of the volume
  io::VolumeSpace space{};      ///< of the volume
  Index3 layers{1, 1, 1};       ///< into which each of its voxels was cut
};

/// What a mesh has of each label, by dense label.
struct LabelAmounts {
  std::vector<Int128> volumes6;  ///< six times the volume in cubic units of the lattice
  std::vector<std::uint64_t> tets;
};

/// Corners of tets count as the nearest points of the lattice, where those of the marches lie.
/// Memory: 24 bytes a label, and the work on ranges.  ERRORS: those of ScratchMesh.
[[nodiscard]] LabelAmounts label_amounts(io::ScratchMesh& mesh, const VolumesTask& task,
                                         const TetWork& work = {});

}  // namespace mw::engine
