// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The bricks of voxels that labels are kept in.
#pragma once

#include <cstdint>

#include "io/labels/brick_volume.h"

namespace mw::engine {

/// Voxels along each edge of a brick.
inline constexpr std::int64_t kBrick = io::BrickVolume::kEdge;

}  // namespace mw::engine
