// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes of the labels of a finished mesh, in whole numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

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

/// Returns by dense label six times its volume in cubic units of the lattice.  Corners of tets
/// count as the nearest points of the lattice, where those of the marches lie.  Calls between(),
/// which may throw, often.
/// Memory: 16 bytes a label.  ERRORS: those of ScratchMesh.
[[nodiscard]] std::vector<Int128> label_volumes6(
    io::ScratchMesh& mesh, const VolumesTask& task, const std::function<void()>& between = [] {});

}  // namespace mw::engine
