// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What every format demands of its numbers, worded the same for all.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "io/volume/label_volume.h"
#include "kernels/core/axis_limit.h"

namespace mw::io {

/// A shape from (x, y, z) extents.  ERRORS: kInput naming field when an axis is not in
/// 1..kMaxAxisVoxels.
[[nodiscard]] Index3 checked_shape(std::string_view file, std::string_view field,
                                   std::array<std::int64_t, 3> extents);

/// ERRORS: kInput naming `field` unless spacing is finite and positive.
void check_spacing(std::string_view file, std::string_view field, double spacing);

/// ERRORS: kInput naming `field` unless the origin is finite.
void check_origin(std::string_view file, std::string_view field, double origin);

/// ERRORS: kInput with both numbers unless `size` bytes hold the voxels from `offset` on; with
/// `exact`, also when bytes are left over.
void check_payload(std::string_view file, const VolumeInfo& info, std::uint64_t offset,
                   std::uint64_t size, bool exact);

/// Bytes of all voxels.
[[nodiscard]] std::uint64_t payload_bytes(const VolumeInfo& info);

}  // namespace mw::io
