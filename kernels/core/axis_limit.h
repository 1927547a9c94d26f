// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How long volumes may be.
#pragma once

#include <cstdint>

namespace mw {

/// Voxels along an axis of a volume that is made, read or described.  It is twice what one run can
/// mesh (kMaxSampledVoxels in face_sample.h, where samples number voxels in 19 bits): a run may
/// take a part of the file (--crop), and says so before any work when its part is too long.
/// Within it coordinates fit int32 in units of 1/1024 voxel, and no product of extents overflows.
inline constexpr std::int64_t kMaxAxisVoxels = std::int64_t{1} << 20;

}  // namespace mw
