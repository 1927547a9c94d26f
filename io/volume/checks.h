// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What every format demands of its numbers, worded the same for all.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "io/file/source/byte_source.h"
#include "io/volume/label_volume.h"
#include "kernels/core/index.h"

namespace mw::io {

/// Makes a shape of (x, y, z) extents.  ERRORS: kInput naming field when an axis is not in
/// 1..kMaxAxisVoxels.
[[nodiscard]] Index3 checked_shape(std::string_view file, std::string_view field,
                                   std::array<std::int64_t, 3> extents);

/// ERRORS: kInput naming `field` unless spacing is finite and positive.
void check_spacing(std::string_view file, std::string_view field, double spacing);

/// ERRORS: kInput naming `field` unless the origin is finite.
void check_origin(std::string_view file, std::string_view field, double origin);

enum class BytesBehind { kIgnored, kRefused };

/// ERRORS: kInput with both numbers of bytes unless source holds the voxels, as many times as
/// `copies` says, from `offset` on; with kRefused, also when bytes are left over.
/// ENSURES: a source that is packed is unpacked as far as the voxels go, and not much further.
void check_payload(const ByteSource& source, const VolumeInfo& info, std::uint64_t offset,
                   BytesBehind behind = BytesBehind::kIgnored, std::uint64_t copies = 1);

/// ERRORS: kInput naming `file` unless it has the shape and the place of the volumes before it,
/// which errors call `what`, such as "masks".
void check_same_grid(std::string_view file, const VolumeInfo& info, const VolumeInfo& before,
                     std::string_view what);

/// Returns how many bytes all voxels take.
[[nodiscard]] std::uint64_t payload_bytes(const VolumeInfo& info);

}  // namespace mw::io
